"""Closed rings of vertex indices: what a boundary must be before it is a shape."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from .errors import InputError, ShapeError
from .predicates import orientation
from .segments import locate
from .topology import occurrences


def near(points: np.ndarray) -> str:
    return "(" + ", ".join(f"{x:g}" for x in points.mean(axis=0)) + ")"


def as_facets(facets, n: int, corners: int = 2) -> np.ndarray:
    array = np.array(facets)
    if array.ndim != 2 or array.shape[1] != corners or array.dtype.kind not in "iu":
        raise InputError(
            f"facets has shape {array.shape} and type {array.dtype}; pass an (m, {corners}) array of int."
        )
    bad = np.argwhere((array < 0) | (array >= n))
    if len(bad):
        row, column = bad[0]
        raise InputError(f"facets[{row}, {column}] is {array[row, column]}, but vertices are 0 to {n - 1}.")
    return array.astype(np.int64)


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
