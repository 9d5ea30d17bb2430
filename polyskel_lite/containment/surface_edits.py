"""Two edits of a closed triangle mesh: flipping edges, and putting a vertex on the middle of an edge."""

from __future__ import annotations

import numpy as np

from ..exact import meeting_faces, shadow_signs
from ..shapes import twin_sides

# Edges with a sharper bend than this (cosine between the normals of their faces) are never flipped.
_BEND = 0.5


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


def flip_toward(points: np.ndarray, faces: np.ndarray, score) -> tuple[np.ndarray, int]:
    """Flip edges as long as that raises a score; the mesh stays closed, manifold and without meetings.

    Parameters
    ----------
    points : (n, 3) float array
    faces : (m, 3) int array
    score : callable
        From faces (k, 2, 3) and the edges (k, 2) between them to (k,) numbers.

    Returns
    -------
    tuple of (m, 3) int array and int
        The new faces and the number of flips.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0], [1, 0.4, -9]], dtype=float)
    >>> faces = np.array([[0, 1, 2], [0, 2, 3], [1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]])
    >>> wanted = lambda pair, edge: (np.sort(edge, axis=1) == (1, 3)).all(axis=1)
    >>> flip_toward(points, faces, wanted)[0][:2].tolist()
    [[1, 2, 3], [3, 0, 1]]
    """
    faces, n, flips = faces.copy(), len(points), 0
    forbidden: set[int] = set()
    while True:
        owners, corners = quads(points, faces)
        a, b, c, d = corners.T
        new = np.stack([np.stack([c, a, d], axis=1), np.stack([d, b, c], axis=1)], axis=1)
        crossing = np.stack([c, d], axis=1)
        gain = np.where(c == d, -1, score(new, crossing) - score(faces[owners], corners[:, :2]).astype(int))
        keys = edge_keys(crossing, n)
        can = (gain > 0) & ~np.isin(keys, edge_keys(corners[:, :2], n))
        if forbidden:
            can &= ~np.isin(keys, list(forbidden))
        can[can] = _gentle(points, faces[owners[can]], new[can])
        chosen = _independent(np.flatnonzero(can)[np.argsort(-gain[can], kind="stable")], owners, keys)
        kept = _without_meetings(points, faces, owners, new, chosen)
        forbidden |= set(keys[np.setdiff1d(chosen, kept)].tolist())
        faces[owners[kept]] = new[kept]
        flips += len(kept)
        if not len(chosen):
            return faces, flips


def _gentle(points, old, new) -> np.ndarray:
    """Whether the four faces have an area and look in about the same direction."""
    flat = ~shadow_signs(points[new.reshape(-1, 3)]).any(axis=1).reshape(-1, 2)
    normals = []
    for pair in (old, new):
        p = points[pair]
        normal = np.cross(p[:, :, 1] - p[:, :, 0], p[:, :, 2] - p[:, :, 0])
        normals.append(normal / np.maximum(np.linalg.norm(normal, axis=2, keepdims=True), 1e-300))
    normals = np.concatenate(normals, axis=1)
    cosines = (normals[:, :, None] * normals[:, None, :]).sum(axis=3)
    return (cosines.min(axis=(1, 2)) > _BEND) & ~flat.any(axis=1)


def _independent(candidates, owners, keys) -> np.ndarray:
    """Those whose faces and new edge no earlier one has taken."""
    faces, edges, chosen = set(), set(), []
    for k in candidates.tolist():
        f, g = owners[k].tolist()
        if f not in faces and g not in faces and keys[k] not in edges:
            faces |= {f, g}
            edges.add(keys[k])
            chosen.append(k)
    return np.array(chosen, dtype=np.int64)


def _without_meetings(points, faces, owners, new, chosen) -> np.ndarray:
    """Take back flips until no two faces meet; the mesh before them has no meetings."""
    while len(chosen):
        trial = faces.copy()
        trial[owners[chosen]] = new[chosen]
        bad = meeting_faces(points, trial, new=owners[chosen].ravel())
        if not len(bad):
            break
        chosen = chosen[~np.isin(owners[chosen], bad).any(axis=1)]
    return chosen


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
    chosen = _independent(wanted[np.argsort(-length[wanted], kind="stable")], owners, keys)
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
