"""Betti numbers of unions of balls by their nerve: which balls have a common point."""

from __future__ import annotations

from itertools import combinations, pairwise

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from .complexes import lengths


def common_power(centers, weights):
    """The least value of max_i |x - c_i|^2 - w_i over all x, for each row of up to four balls.

    It is <= 0 iff the balls have a common point. (s, n, N) and (s, n); the optimum is the point of equal
    power of a subset if that point is a convex combination of its centres (Lagrange), and the value never
    falls when balls are added: so it is the largest value of such a subset.
    """
    n = centers.shape[1]
    value = (-weights).max(axis=1)
    for m in range(2, n + 1):
        for subset in map(list, combinations(range(n), m)):
            c, w = centers[:, subset], weights[:, subset]
            edges = c[:, 1:] - c[:, :1]
            right = ((edges**2).sum(axis=-1) - w[:, 1:] + w[:, :1]) / 2
            gram = edges @ edges.transpose(0, 2, 1)
            good = np.abs(np.linalg.det(gram)) > 1e-12 * np.prod((edges**2).sum(axis=-1), axis=1)
            if not good.any():
                continue
            part = np.linalg.solve(gram[good], right[good][..., None])[..., 0]
            share = np.column_stack([1 - part.sum(axis=1), part])
            x = (part[..., None] * edges[good]).sum(axis=1)
            power = (x**2).sum(axis=1) - w[good, 0]
            value[good] = np.maximum(value[good], np.where((share >= 0).all(axis=1), power, -np.inf))
    return value


def nerve(centers, radii):
    """Simplices of the nerve by dimension 0..N: lists of (s, d + 1) arrays."""
    k, N = centers.shape
    weights = radii**2
    found = [np.arange(k)[:, None]]
    present = {(i,) for i in range(k)}
    for m in range(2, N + 2):
        rows = [
            (*simplex, j)
            for simplex in map(tuple, found[-1].tolist())
            for j in range(simplex[-1] + 1, k)
            if all((*f, j) in present for f in combinations(simplex, m - 2))
        ]
        rows = np.array(rows, dtype=int).reshape(-1, m)
        if len(rows):
            rows = rows[common_power(centers[rows], weights[rows]) <= 0]
        found.append(rows)
        present = set(map(tuple, rows.tolist()))
    return found


def rank_mod_2(columns) -> int:
    pivots: dict[int, int] = {}
    for column in columns:
        while column:
            top = column.bit_length()
            if top not in pivots:
                pivots[top] = column
                break
            column ^= pivots[top]
    return len(pivots)


def nerve_betti(centers, radii):
    """Betti numbers b0 .. b(N-1) of a union of closed balls."""
    inside = lengths(centers[:, None] - centers) + radii[:, None] <= radii
    inside &= ~((inside & inside.T) & np.tri(len(radii), dtype=bool).T)  # of equal balls keep the first
    np.fill_diagonal(inside, False)
    keep = ~inside.any(axis=1)
    simplices = nerve(centers[keep], radii[keep])
    ranks = [0]
    for faces, rows in pairwise(simplices):
        number = {face: 1 << n for n, face in enumerate(map(tuple, faces.tolist()))}
        ranks.append(
            rank_mod_2(
                sum(number[f] for f in combinations(row, len(row) - 1)) for row in map(tuple, rows.tolist())
            )
        )
    return tuple(len(simplices[d]) - ranks[d] - ranks[d + 1] for d in range(len(simplices) - 1))


def components(k, pairs) -> int:
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(k, k))
    return connected_components(graph, directed=False)[0]
