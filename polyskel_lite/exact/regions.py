"""Where a point lies in a region behind closed facets, in the plane and in space."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .boxes import overlapping_pairs
from .predicates import fractions, orientation
from .triangles import in_facet

_CHUNK = 500_000  # pairs of points and facets looked at together: bounds the memory, not the result


def locate(facets: np.ndarray, queries: np.ndarray) -> np.ndarray:
    """Where each query lies in the region behind closed facets: +1 inside, 0 on them, -1 outside; exact.

    Parameters
    ----------
    facets : (m, N, N) float array
        Closed, without self-crossings: segments or triangles, all turned outward, or all inward.
    queries : (k, N) float array, or one of fractions (dtype object)

    Returns
    -------
    (k,) int8 array

    Notes
    -----
    The crossings of a ray upward are counted with their sign. Where the ray meets an edge or a vertex
    it is shifted, in thought, by an infinitesimal (ε, ε²) in x and y, the same for all facets
    (simulation of simplicity), so that every ray crosses whole facets only.

    References
    ----------
    Edelsbrunner and Mücke, Simulation of simplicity, 1990.

    Examples
    --------
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]], dtype=float)
    >>> locate(np.stack([square, np.roll(square, -1, axis=0)], axis=1), np.array([[1, 1], [2, 1], [3, 1]]))
    array([ 1,  0, -1], dtype=int8)
    >>> points = np.array([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]], dtype=float)
    >>> tetrahedron = points[[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]]
    >>> locate(tetrahedron, np.array([[0.5, 0.5, 0.5], [1, 1, 1], [2, 2, 2]]))
    array([ 1,  0, -1], dtype=int8)
    """
    winding, touching = np.zeros(len(queries), dtype=np.int64), np.zeros(len(queries), dtype=bool)
    for i, _, turn, on in _crossings(facets, np.asarray(queries)):
        np.add.at(winding, i, turn)
        touching[on] = True
    result = np.where(winding != 0, 1, -1).astype(np.int8)
    result[touching] = 0
    return result


def odd_around(segments: np.ndarray, owner: np.ndarray, queries: np.ndarray) -> np.ndarray:
    """Whether an odd number of closed curves runs around each query, (k,) bool; exact.

    Parameters
    ----------
    segments : (m, 2, 2) float array
    owner : (m,) int array
        The curve of each segment. Curve i does not count for query i, which may lie on it.
    queries : (k, 2) float array
        On no other curve.

    Examples
    --------
    >>> square = np.array([[0, 0], [3, 0], [3, 3], [0, 3]], dtype=float)
    >>> rings = np.concatenate([square, square / 3 + 1])
    >>> ends = np.concatenate([np.roll(part, -1, axis=0) for part in (rings[:4], rings[4:])])
    >>> odd_around(np.stack([rings, ends], axis=1), np.repeat([0, 1], 4), rings[[0, 4]]).tolist()
    [False, True]
    """
    odd = np.zeros(len(queries), dtype=bool)
    for i, j, turn, _ in _crossings(segments, queries):
        odd ^= np.bincount(i[(turn != 0) & (owner[j] != i)], minlength=len(queries)) % 2 == 1
    return odd


def _crossings(facets, queries) -> Iterator[tuple[np.ndarray, ...]]:
    """In chunks: queries, facets over them, which way each winds around the ray; and queries on facets."""
    at = queries.astype(np.float64)
    # Fractions are rounded, by far less than this.
    slack = 1e-9 * (1 + np.abs(at)) if queries.dtype == object else 0.0
    low, high, shadow = at - slack, at + slack, slice(0, -1)
    floor, top = facets.min(axis=1), facets.max(axis=1)
    for rows, over in overlapping_pairs(low[:, shadow], high[:, shadow], floor[:, shadow], top[:, shadow]):
        ahead = np.flatnonzero(top[over, -1] >= low[rows, -1])
        for begin in range(0, len(ahead), _CHUNK):
            i, j = rows[ahead[begin : begin + _CHUNK]], over[ahead[begin : begin + _CHUNK]]
            t, q = facets[j], queries[i]
            if q.dtype == object:
                t = fractions(t)
            turns = _turns(t[:, :, shadow], q[:, shadow])
            turn = np.where((turns == turns[0]).all(axis=0), turns[0], 0)
            unsure = np.flatnonzero(floor[j, -1] <= high[i, -1])
            side = orientation(np.concatenate([t[unsure], q[unsure, None]], axis=1))
            # Where a shadow turns left, a ray that meets the facet comes from its right side.
            turn[unsure[side != -turn[unsure]]] = 0
            on = unsure[side == 0]
            yield i, j, turn, i[on[in_facet(t[on], q[on])]]


def _turns(shadows: np.ndarray, queries: np.ndarray) -> np.ndarray:
    """On which side of each side's shadow the query is once it is shifted by (ε, ε²), (N, k)."""
    if shadows.shape[1] == 2:
        return np.where(shadows[:, :, 0] <= queries, (1, -1), (-1, 1)).T
    turns = []
    for a, b in ((0, 1), (1, 2), (2, 0)):
        a, b = shadows[:, a], shadows[:, b]
        turn = orientation(np.stack([a, b, queries], axis=1))
        turn = np.where(turn == 0, np.sign(a[:, 1] - b[:, 1]), turn)
        turns.append(np.where(turn == 0, np.sign(b[:, 0] - a[:, 0]), turn).astype(np.int8))
    return np.stack(turns)
