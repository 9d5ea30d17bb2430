"""The nearest of many segments or triangles, by trees over their middles."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..checks import check_squares
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
    check_squares(facets, queries)
    n = facets.shape[1]
    best, corner = cKDTree(facets.reshape(-1, n)).query(queries)
    facet = corner // n
    center = (facets.min(axis=1) + facets.max(axis=1)) / 2
    radius = np.linalg.norm(facets - center[:, None], axis=2).max(axis=1)
    # Facets of one size together: large ones do not make the search around small ones coarse.
    size = np.frexp(radius)[1]
    for k in np.unique(size[radius > 0]):
        members = np.flatnonzero((size == k) & (radius > 0))
        tree, reach = cKDTree(center[members]), radius[members].max() * (1 + 1e-12)
        begin, count = 0, tree.query_ball_point(queries, best + reach, return_length=True)
        total = np.cumsum(count)
        while begin < len(queries):
            done = total[begin - 1] if begin else 0
            end = max(begin + 1, int(np.searchsorted(total, done + _CHUNK, side="right")))
            near = tree.query_ball_point(queries[begin:end], best[begin:end] + reach)
            i = np.repeat(np.arange(begin, end), count[begin:end])
            j = members[np.concatenate([np.asarray(row, dtype=np.int64) for row in near])]
            distance = facet_distance(queries[i], facets[j])
            order = np.lexsort((distance, i))
            first = order[np.flatnonzero(np.diff(i[order], prepend=-1))]
            first = first[distance[first] < best[i[first]]]
            best[i[first]], facet[i[first]] = distance[first], j[first]
            begin = end
    return best, facet
