"""Closed rings of vertex indices: what a boundary must be before it is a shape."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ..checks import as_points, near
from ..errors import InputError, ShapeError
from ..exact import first_meeting, locate, occurrences, orientation


def check_closed(n: int, facets: np.ndarray) -> None:
    begins, ends = occurrences(facets[:, 0], n), occurrences(facets[:, 1], n)
    bad = np.flatnonzero((begins != 1) | (ends != 1))
    if len(bad):
        v = bad[0]
        raise ShapeError(
            f"vertex {v} begins {begins[v]} segments and ends {ends[v]}; on a closed boundary without "
            "touching points it does each once: close the gap, split the vertex or drop it."
        )
    loop = np.flatnonzero(facets[:, 0] == facets[:, 1])
    if len(loop):
        raise ShapeError(f"segment {loop[0]} joins vertex {facets[loop[0], 0]} to itself; remove both.")


def ring_facets(sizes: Sequence[int]) -> np.ndarray:
    first = np.concatenate([[0], np.cumsum(sizes)])
    return np.concatenate(
        [np.stack([np.arange(a, b), np.append(np.arange(a + 1, b), a)], axis=1) for a, b in pairwise(first)]
    )


def rings_of(facets: np.ndarray) -> list[np.ndarray]:
    after = np.empty(len(facets), dtype=np.int64)
    after[facets[:, 0]] = facets[:, 1]
    follow, seen, rings = after.tolist(), np.zeros(len(facets), dtype=bool), []
    for start in range(len(facets)):
        if seen[start]:
            continue
        ring = [start]
        while (vertex := follow[ring[-1]]) != start:
            ring.append(vertex)
        seen[ring] = True
        rings.append(np.array(ring))
    return rings


def turn_of(ring: np.ndarray) -> int:
    """+1 for a counter-clockwise simple ring, -1 clockwise, 0 if flat at its lowest vertex; exact."""
    k = int(np.lexsort((ring[:, 0], ring[:, 1]))[0])
    return int(orientation(ring[[[k - 1, k, (k + 1) % len(ring)]]])[0])


def nesting(rings: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """How many other rings surround each ring, and how each one turns."""
    turn = np.array([turn_of(ring) for ring in rings])
    first = np.array([ring[0] for ring in rings])
    depth = np.zeros(len(rings), dtype=int)
    for k, ring in enumerate(rings):
        inside = locate(np.stack([ring, np.roll(ring, -1, axis=0)], axis=1), first) > 0
        inside[k] = False
        depth += inside
    return depth, turn


def oriented(rings: Sequence) -> list[np.ndarray]:
    """Closed rings of any orientation, outer ones turned counter-clockwise, holes clockwise (even-odd).

    Examples
    --------
    >>> oriented([[(0, 0), (0, 2), (2, 0), (0, 0)]])[0].tolist()
    [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]]
    """
    cleaned = []
    for k, ring in enumerate(rings):
        ring = as_points(ring, name=f"ring {k}", dimensions=(2,))
        if len(ring) > 1 and (ring[0] == ring[-1]).all():
            ring = ring[:-1]
        if len(ring) < 3:
            raise InputError(f"ring {k} has {len(ring)} different vertices; a ring needs at least three.")
        cleaned.append(ring)
    depth, turn = nesting(cleaned)
    return [
        ring if (turn[k] > 0) == (depth[k] % 2 == 0) else np.roll(ring[::-1], 1, axis=0)
        for k, ring in enumerate(cleaned)
    ]


def check_meetings(points: np.ndarray, facets: np.ndarray) -> None:
    """Raise `ShapeError` naming the first two segments that meet elsewhere than at a common end.

    Examples
    --------
    >>> check_meetings(np.eye(2), np.array([[0, 1]]))
    """
    meeting = first_meeting(points, facets)
    if meeting:
        i, j = meeting
        (a, b), (c, d) = facets[i], facets[j]
        raise ShapeError(
            f"segment {i} (vertices {a}-{b}) meets segment {j} (vertices {c}-{d}) near "
            f"{near(points[facets[i]])}; a boundary may not cross or touch itself: move a vertex."
        )


def check_turns(points: np.ndarray, facets: np.ndarray) -> None:
    """Raise `ShapeError` naming the first ring that has its interior on the right.

    Examples
    --------
    >>> check_turns(np.array([(0, 0), (1, 0), (0, 1)]), np.array([(0, 1), (1, 2), (2, 0)]))
    """
    rings = rings_of(facets)
    depth, turn = nesting([points[ring] for ring in rings])
    for k, ring in enumerate(rings):
        if (turn[k] > 0) != (depth[k] % 2 == 0):
            kind = "an outer ring runs clockwise" if depth[k] % 2 == 0 else "a hole runs counter-clockwise"
            raise ShapeError(
                f"{kind}: the ring through vertex {ring[0]} at {near(points[ring[:1]])} has its interior on "
                "the right; reverse its segments, or use Shape.from_rings."
            )
