"""Edges of a closed triangle mesh, and vertices put on their middles."""

from __future__ import annotations

import numpy as np

from .meshes import twin_sides


def edge_keys(edges: np.ndarray, n: int) -> np.ndarray:
    """One number for each edge (k, 2), whichever way it runs.

    Examples
    --------
    >>> edge_keys(np.array([[3, 1], [1, 3]]), 10).tolist()
    [13, 13]
    """
    edges = np.asarray(edges, dtype=np.int64)
    return edges.min(axis=1) * n + edges.max(axis=1)


def quads(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Every edge once: its two faces (e, 2), and (e, 4) corners a, b, c, d of faces a b c and b a d.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    >>> owners, corners = quads(points, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    >>> owners[0].tolist(), corners[0].tolist()
    ([0, 2], [0, 2, 1, 3])
    """
    twins = twin_sides(points, faces)
    side = np.flatnonzero(np.arange(len(twins)) < twins)
    other = twins[side]
    f, i, g, j = side // 3, side % 3, other // 3, other % 3
    c, d = faces[f, (i + 2) % 3], faces[g, (j + 2) % 3]
    return np.stack([f, g], axis=1), np.stack([faces[f, i], faces[f, (i + 1) % 3], c, d], axis=1)


def split_edges(points: np.ndarray, faces: np.ndarray, wish: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Put a vertex on the middle of edges, the longest first, at most one a face.

    Parameters
    ----------
    points : (n, 3) float array
    faces : (m, 3) int array
    wish : (k, 2) int array
        Edges to halve.

    Returns
    -------
    points, faces
        The old points first; each halved edge adds one and two faces.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [2, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    >>> faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> split_edges(points, faces, np.array([[0, 1]]))[0][4:].tolist()
    [[1.0, 0.0, 0.0]]
    """
    n = len(points)
    owners, corners = quads(points, faces)
    keys = edge_keys(corners[:, :2], n)
    length = ((points[corners[:, 0]] - points[corners[:, 1]]) ** 2).sum(axis=1)
    wanted = np.flatnonzero(np.isin(keys, edge_keys(wish, n)))
    chosen = independent(wanted[np.argsort(-length[wanted], kind="stable")], owners, keys)
    a, b, c, d = corners[chosen].T
    middle = (points[a] + points[b]) / 2
    # Where floats leave no room, the middle is a vertex that is there already.
    _, place, count = np.unique(
        np.concatenate([points, middle]), axis=0, return_inverse=True, return_counts=True
    )
    moved = count[place.ravel()[n:]] == 1
    chosen, a, b, c, d = chosen[moved], a[moved], b[moved], c[moved], d[moved]
    m = n + np.arange(len(chosen))
    out = faces.copy()
    out[owners[chosen, 0]], out[owners[chosen, 1]] = np.stack([a, m, c], axis=1), np.stack([b, m, d], axis=1)
    added = [np.stack([m, b, c], axis=1), np.stack([m, a, d], axis=1)]
    return np.concatenate([points, middle[moved]]), np.concatenate([out, *added])


def independent(candidates: np.ndarray, owners: np.ndarray, keys: np.ndarray) -> np.ndarray:
    """Those of some edges whose faces (e, 2) and keys (e,) no earlier one has taken.

    Examples
    --------
    >>> independent(np.array([0, 1, 2]), np.array([(0, 1), (1, 2), (2, 3)]), np.array([7, 8, 9])).tolist()
    [0, 2]
    """
    _, number = np.unique(keys[candidates], return_inverse=True)
    taken = np.column_stack([owners[candidates], number + owners.max(initial=0) + 1])
    left, chosen = np.arange(len(candidates)), np.zeros(len(candidates), dtype=bool)
    while len(left):
        # The first of all that want it: so it is the first of those that are left, too.
        first = np.full(taken.max() + 1, len(candidates))
        np.minimum.at(first, taken[left].ravel(), np.repeat(left, 3))
        wins = left[(first[taken[left]] == left[:, None]).all(axis=1)]
        chosen[wins] = True
        gone = np.zeros(len(first), dtype=bool)
        gone[taken[wins]] = True
        left = left[~gone[taken[left]].any(axis=1)]
    return candidates[chosen]
