"""Flipping edges of a closed triangle mesh."""

from __future__ import annotations

import numpy as np

from ..exact import meeting_faces, shadow_signs
from ..shapes import edge_keys, independent, quads

# Edges with a sharper bend than this (cosine between the normals of their faces) are never flipped.
_BEND = 0.5


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
        chosen = independent(np.flatnonzero(can)[np.argsort(-gain[can], kind="stable")], owners, keys)
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
    points = np.ldexp(points, -np.frexp(np.abs(points).max())[1])  # areas of any unit are ordinary floats
    for pair in (old, new):
        p = points[pair]
        normal = np.cross(p[:, :, 1] - p[:, :, 0], p[:, :, 2] - p[:, :, 0])
        normals.append(normal / np.maximum(np.linalg.norm(normal, axis=2, keepdims=True), 1e-300))
    normals = np.concatenate(normals, axis=1)
    cosines = (normals[:, :, None] * normals[:, None, :]).sum(axis=3)
    return (cosines.min(axis=(1, 2)) > _BEND) & ~flat.any(axis=1)


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
