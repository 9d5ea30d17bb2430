"""Betti numbers and Euler characteristic of complexes of vertices, edges and polygons."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components


def components(n: int, edges: np.ndarray) -> tuple[int, np.ndarray]:
    """Number of connected components of a graph, and the component of each vertex.

    Parameters
    ----------
    n : int
        Number of vertices.
    edges : (e, 2) int array

    Returns
    -------
    tuple of int and (n,) int array

    Examples
    --------
    >>> components(4, np.array([[0, 1], [2, 3]]))[0]
    2
    """
    if n == 0:
        return 0, np.zeros(0, dtype=int)
    edges = np.asarray(edges, dtype=np.int64).reshape(-1, 2)
    graph = coo_array((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(n, n))
    count, label = connected_components(graph, directed=False)
    return int(count), label


def occurrences(index: np.ndarray, n: int) -> np.ndarray:
    """How often each of 0 to n - 1 occurs, also where the machine's own integer has 32 bits (a browser).

    Examples
    --------
    >>> occurrences(np.array([0, 2, 2]), 4).tolist()
    [1, 0, 2, 0]
    """
    return np.bincount(np.asarray(index).ravel().astype(np.intp, copy=False), minlength=n)


def betti_numbers(n: int, edges: np.ndarray, polygons: Sequence[np.ndarray] | None = None) -> tuple[int, ...]:
    """Betti numbers (b0, b1), or (b0, b1, b2) if polygons are given, over the field of two elements.

    Parameters
    ----------
    n : int
        Number of vertices.
    edges : (e, 2) int array
        Each edge once; two edges may join the same vertices.
    polygons : list of int arrays, optional
        Vertices of each polygon in order; every side must be one of the edges, without doubles.

    Returns
    -------
    tuple of int
        Components, independent loops and, with polygons, closed surfaces.

    References
    ----------
    Edelsbrunner and Harer, Computational Topology, 2010, chapter IV.

    Examples
    --------
    A square outline, and the same filled:

    >>> square = np.array([(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> betti_numbers(4, square), betti_numbers(4, square, [np.array([0, 1, 2, 3])])
    ((1, 1), (1, 0, 0))
    """
    b0, _ = components(n, edges)
    if polygons is None:
        return b0, len(edges) - n + b0
    b2 = len(polygons) - _boundary_rank(edges, polygons)
    characteristic = n - len(edges) + len(polygons)  # b0 - b1 + b2
    return b0, b0 + b2 - characteristic, b2


def _boundary_rank(edges, polygons) -> int:
    """Rank of the map from polygons to edges, mod 2: collapse free polygons first, eliminate the rest."""
    index = {tuple(sorted(edge)): k for k, edge in enumerate(np.asarray(edges).tolist())}
    sides = [
        {index[tuple(sorted(side))] for side in zip(p, [*p[1:], p[0]], strict=True)}
        for p in (list(map(int, polygon)) for polygon in polygons)
    ]
    around: dict[int, set[int]] = {}
    for k, polygon in enumerate(sides):
        for edge in polygon:
            around.setdefault(edge, set()).add(k)
    free = [edge for edge, owners in around.items() if len(owners) == 1]
    alive, rank = set(range(len(sides))), 0
    while free:
        owners = around[free.pop()]
        if len(owners) != 1:
            continue
        polygon = next(iter(owners))
        alive.discard(polygon)
        rank += 1
        for edge in sides[polygon]:
            around[edge].discard(polygon)
            if len(around[edge]) == 1:
                free.append(edge)
    pivots: dict[int, int] = {}
    for polygon in alive:
        column = sum(1 << edge for edge in sides[polygon])
        while column:
            top = column.bit_length() - 1
            if top not in pivots:
                pivots[top] = column
                rank += 1
                break
            column ^= pivots[top]
    return rank
