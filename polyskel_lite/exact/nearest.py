"""The nearest of many segments or triangles, by trees over their middles."""

from __future__ import annotations

from itertools import chain

import numpy as np
from scipy.spatial import cKDTree

from .segments import nearest_on_segments
from .triangles import nearest_on_triangles

_CHUNK = 500_000  # pairs of points and facets looked at together: bounds the memory, not the result


def nearest_on_facets(queries: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """The nearest point of a segment (k, 2, 2) or triangle (k, 3, 3), row by row; both may be points.

    Examples
    --------
    >>> nearest_on_facets(np.array([[1.0, 2]]), np.array([[[0.0, 0], [4, 0]]])).tolist()
    [[1.0, 0.0]]
    """
    return (nearest_on_segments if facets.shape[1] == 2 else nearest_on_triangles)(queries, facets)


def facet_distance(queries: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Distance from point to segment (k, 2, 2) or triangle (k, 3, 3), row by row; both may be points.

    Examples
    --------
    >>> facet_distance(np.array([[1.0, 2]]), np.array([[[0.0, 0], [4, 0]]])).tolist()
    [2.0]
    """
    return np.linalg.norm(queries - nearest_on_facets(queries, facets), axis=1)


def nearest_facets(facets: np.ndarray, queries: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distance from each query to the nearest facet, and which facet that is.

    Parameters
    ----------
    facets : (m, N, N) float array
        Segments (N = 2) or triangles (N = 3), at least one.
    queries : (k, N) float array

    Returns
    -------
    distance : (k,) float array
    facet : (k,) int array
        Of several at one distance any.

    Examples
    --------
    >>> floor = np.array([[[0, 0, 0], [4, 0, 0], [0, 4, 0]]], dtype=float)
    >>> nearest_facets(floor, np.array([[1, 1, 2], [7, 0, 4]]))[0].tolist()
    [2.0, 5.0]
    """
    facets, queries = np.asarray(facets, dtype=np.float64), np.asarray(queries, dtype=np.float64)
    exponent = int(np.frexp(max(np.abs(facets).max(), np.abs(queries).max(initial=0)))[1])
    if abs(exponent) > 200:  # in a unit in which squares are ordinary floats
        distance, facet = nearest_facets(np.ldexp(facets, -exponent), np.ldexp(queries, -exponent))
        return np.ldexp(distance, exponent), facet
    n = facets.shape[1]
    best, corner = cKDTree(facets.reshape(-1, n)).query(queries)
    facet = corner // n
    center = (facets.min(axis=1) + facets.max(axis=1)) / 2
    radius = np.linalg.norm(facets - center[:, None], axis=2).max(axis=1)
    normal = _normals(facets, radius)
    # Facets of one size together: large ones do not make the search around small ones coarse.
    size = np.frexp(radius)[1]
    for k in np.unique(size[radius > 0]):
        members = np.flatnonzero((size == k) & (radius > 0))
        tree, reach = cKDTree(center[members]), radius[members].max() * (1 + 1e-12)
        # One good guess leaves few facets to look at.
        first = members[tree.query(queries)[1]]
        distance = facet_distance(queries, facets[first])
        facet, best = np.where(distance < best, first, facet), np.minimum(distance, best)
        begin, count = 0, tree.query_ball_point(queries, best + reach, return_length=True)
        total = np.cumsum(count)
        while begin < len(queries):
            done = total[begin - 1] if begin else 0
            end = max(begin + 1, int(np.searchsorted(total, done + _CHUNK, side="right")))
            rows = tree.query_ball_point(queries[begin:end], best[begin:end] + reach)
            i = np.repeat(np.arange(begin, end), count[begin:end])
            j = members[np.fromiter(chain.from_iterable(rows), dtype=np.int64)]
            height = np.abs(((queries[i] - facets[j, 0]) * normal[j]).sum(axis=1))
            near = height <= best[i] + 1e-6 * (best[i] + radius[j])
            i, j = i[near], j[near]
            distance = facet_distance(queries[i], facets[j])
            order = np.lexsort((distance, i))
            first = order[np.flatnonzero(np.diff(i[order], prepend=-1))]
            first = first[distance[first] < best[i[first]]]
            best[i[first]], facet[i[first]] = distance[first], j[first]
            begin = end
    return best, facet


def _normals(facets, radius):
    """Unit normals of lines and planes, zero where rounding leaves none."""
    u = facets[:, 1:] - facets[:, :1]
    normal = u[:, 0, ::-1] * (1, -1) if len(u[0]) == 1 else np.cross(u[:, 0], u[:, 1])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    sure = length > 1e-8 * radius[:, None] ** len(u[0])
    return np.divide(normal, length, out=np.zeros_like(normal), where=sure)
