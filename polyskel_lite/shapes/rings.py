"""Closed rings of vertex indices: what a boundary must be before it is a shape."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from numbers import Real

import numpy as np
from scipy.spatial import cKDTree

from ..checks import as_points, near, shown
from ..errors import InputError, ShapeError
from ..exact import first_meeting, occurrences, odd_around, orientation, spread_out
from ..files import Area

#: Rings of one shape: these take a minute or two. A picture of noise has so many in 1500 x 1500 pixels.
MOST_RINGS = 500_000


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


def wrongly_turned(rings: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Which rings run the wrong way, and which are holes: those with an odd number of others around.

    Examples
    --------
    >>> [x.tolist() for x in wrongly_turned([np.array([(0, 0), (0, 2), (2, 0)])])]
    [[True], [False]]
    """
    turn = np.array([turn_of(ring) for ring in rings])
    first = np.array([ring[0] for ring in rings])
    around = np.flatnonzero(may_surround(rings, first)).tolist()
    segments = [np.stack([rings[k], np.roll(rings[k], -1, axis=0)], axis=1) for k in around]
    owner = np.repeat(around, [len(rings[k]) for k in around]).astype(np.int64)
    hole = odd_around(np.concatenate([np.zeros((0, 2, 2)), *segments]), owner, first)
    return (turn > 0) == hole, hole


def may_surround(rings: list[np.ndarray], first: np.ndarray) -> np.ndarray:
    """Which rings have the first vertex of another one near their box; of thousands of specks few have.

    Examples
    --------
    >>> may_surround([np.eye(3)[:, :2], np.eye(3)[:, :2] + 5], np.array([(1.0, 0), (6, 5)])).tolist()
    [False, False]
    """
    low, high = (np.array([getattr(ring, which)(axis=0) for ring in rings]) for which in ("min", "max"))
    middle, reach = (low + high) / 2, (high - low).max(axis=1)  # twice of what is needed, for rounding
    size = max(np.abs(low).max(), np.abs(high).max()) or 1.0
    tree = cKDTree(first / size)
    return tree.query_ball_point(middle / size, reach / size, p=np.inf, return_length=True) > 1


def oriented(rings, names=None) -> tuple[list[np.ndarray], Callable[[int], tuple[str, int]]]:
    """Closed rings of any orientation, outer ones turned counter-clockwise, holes clockwise (even-odd).

    Parameters
    ----------
    rings : sequence of (k, 2) array-like
    names : sequence of str, optional
        What messages call the rings.

    Returns
    -------
    rings : list of (k, 2) float arrays
    place : callable
        From a vertex of all rings one after the other to the name of its ring, and its number as given.

    Examples
    --------
    >>> rings, place = oriented([[(0, 0), (0, 2), (2, 0), (0, 0)]])
    >>> rings[0].tolist(), place(1)
    ([[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]], ('ring 0', 2))
    """
    rings, names, *_ = cleaned(rings, names)
    wrong, _ = wrongly_turned(rings)
    owner, numbers = spread_out(np.array([*map(len, rings)]))

    def place(vertex: int) -> tuple[str, int]:
        k, number = owner[vertex], int(numbers[vertex])
        return names[k], -number % len(rings[k]) if wrong[k] else number

    return [
        np.roll(ring[::-1], 1, axis=0) if turned else ring for ring, turned in zip(rings, wrong, strict=True)
    ], place


def cleaned(rings, names=None) -> Area:
    """Rings as arrays without the vertex that closes them, and with names.

    Examples
    --------
    >>> area = cleaned([[(0, 0), (0, 2), (2, 0), (0, 0)]])
    >>> area.rings[0].tolist(), area.names
    ([[0.0, 0.0], [0.0, 2.0], [2.0, 0.0]], ['ring 0'])
    """
    rings = _listed(rings)
    if names is None:
        names = [f"ring {k}" for k in range(len(rings))]
    if not isinstance(names, Sequence) or len(names) != len(rings):
        raise InputError(f"names is {shown(names)}; pass one name for each of the {len(rings)} rings.")
    arrays = []
    for name, ring in zip(names, rings, strict=True):
        ring = as_points(ring, name=name, dimensions=(2,))
        if len(ring) > 1 and (ring[0] == ring[-1]).all():
            ring = ring[:-1]
        if len(ring) < 3:
            raise InputError(f"{name} has {len(ring)} different vertices; a ring needs at least three.")
        arrays.append(ring)
    return Area(arrays, list(names), "nested")


def _listed(rings) -> list:
    """The rings in a list, from a sequence or an array of some, and not from what can be read only once."""
    if not isinstance(rings, (Sequence, np.ndarray)) or isinstance(rings, (str, bytes, np.ma.MaskedArray)):
        raise InputError(
            f"rings is {shown(rings)}; pass a list of rings, such as [[(0, 0), (1, 0), (0, 1)]]."
        )
    if (isinstance(rings, np.ndarray) and not rings.ndim) or not len(rings):
        raise InputError("rings is empty; pass at least one ring of three vertices.")
    if len(rings) > MOST_RINGS:
        raise InputError(
            f"there are {len(rings):,} rings, and {MOST_RINGS:,} are the most; leave small ones out."
        )
    if _is_point(rings[0]):
        raise InputError("rings is a list of points, not of rings; for one ring pass [ring].")
    return list(rings)


def _is_point(ring) -> bool:
    """Whether it is two numbers, of which no ring can be made."""
    return (
        isinstance(ring, (list, tuple, np.ndarray))
        and len(ring) == 2
        and all(isinstance(x, Real) for x in ring)
    )


def check_meetings(points: np.ndarray, facets: np.ndarray, place=None, doubtful=None) -> None:
    """Raise `ShapeError` naming the first two segments that meet elsewhere than at a common end.

    Parameters
    ----------
    points : (n, 2) float array
    facets : (m, 2) int array
    place : callable, optional
        From a vertex to the name of its ring and its number there, for the message.
    doubtful : (k,) int array, optional
        The others are known not to meet each other.

    Examples
    --------
    >>> check_meetings(np.eye(2), np.array([[0, 1]]))
    """
    meeting = first_meeting(points, facets, doubtful)
    if meeting:
        one, two = (_called(k, facets[k], place) for k in meeting)
        raise ShapeError(
            f"{one} meets {two} near {near(points[facets[meeting[0]]])}; a boundary may not cross or touch "
            "itself: move a vertex."
        )


def _called(k: int, facet: np.ndarray, place) -> str:
    if place is None:
        return f"segment {k} (vertices {facet[0]}-{facet[1]})"
    (name, a), (_, b) = map(place, facet)
    return f"segment {min(a, b)}-{max(a, b)} of {name}"


def check_turns(points: np.ndarray, facets: np.ndarray) -> None:
    """Raise `ShapeError` naming the first ring that has its interior on the right.

    Examples
    --------
    >>> check_turns(np.array([(0, 0), (1, 0), (0, 1)]), np.array([(0, 1), (1, 2), (2, 0)]))
    """
    rings = rings_of(facets)
    wrong, hole = wrongly_turned([points[ring] for ring in rings])
    if wrong.any():
        k = int(np.argmax(wrong))
        kind = "a hole runs counter-clockwise" if hole[k] else "an outer ring runs clockwise"
        raise ShapeError(
            f"{kind}: the ring through vertex {rings[k][0]} at {near(points[rings[k][:1]])} has its interior "
            "on the right; reverse its segments, or use Shape.from_rings."
        )
