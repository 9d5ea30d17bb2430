"""Complexes of points, segments and planar polygons: distances to them and points on them."""

from __future__ import annotations

import numpy as np


def lengths(vectors) -> np.ndarray:
    return np.sqrt((vectors * vectors).sum(axis=-1))


def distance_to_complex(points, vertices, edges=(), polygons=()):
    """Distance from points to a complex of vertices, segments and planar polygons (convex or not)."""
    points, vertices = np.asarray(points, dtype=float), np.asarray(vertices, dtype=float)
    best = np.full(len(points), np.inf)
    if len(vertices):
        best = lengths(points[:, None] - vertices).min(axis=1)
    edges = np.asarray(edges, dtype=int).reshape(-1, 2)
    if len(edges):
        best = np.minimum(best, _to_segments(points, vertices[edges[:, 0]], vertices[edges[:, 1]]))
    for polygon in polygons:
        corners = vertices[np.asarray(polygon, dtype=int)]
        best = np.minimum(best, _to_polygon(points, corners))
    return best


def _to_segments(points, a, b):
    along = b - a
    square = np.maximum((along**2).sum(axis=1), 1e-300)
    w = points[:, None] - a
    share = np.clip((w * along).sum(axis=-1) / square, 0, 1)
    return lengths(w - share[..., None] * along).min(axis=1)


def _to_polygon(points, corners):
    after = np.roll(corners, -1, axis=0)
    best = _to_segments(points, corners, after)
    middle = corners.mean(axis=0)
    normal = np.cross(corners - middle, after - middle).sum(axis=0)
    area = lengths(normal)
    if area == 0:
        return best
    normal = normal / area
    drop = np.abs(normal).argmax()
    w = points - middle
    height = w @ normal
    flat = np.delete(w - height[:, None] * normal, drop, axis=1)
    a, b = np.delete(corners - middle, drop, axis=1), np.delete(after - middle, drop, axis=1)
    x, y = flat[:, :1], flat[:, 1:]
    crossing = (a[:, 1] <= y) != (b[:, 1] <= y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = a[:, 0] + (y - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
    inside = (crossing & (at > x)).sum(axis=1) % 2 == 1
    return np.where(inside, np.minimum(best, np.abs(height)), best)


def sample_complex(rng, vertices, edges, polygons, per_edge=2, per_polygon=3):
    """Random points of every vertex, edge and (by triangles from corner 0) convex polygon."""
    vertices = np.asarray(vertices, dtype=float)
    samples = [vertices]
    edges = np.asarray(edges, dtype=int).reshape(-1, 2)
    share = rng.random((len(edges), per_edge, 1))
    a, b = vertices[edges[:, :1]], vertices[edges[:, 1:]]
    samples.append(((1 - share) * a + share * b).reshape(-1, vertices.shape[1]))
    for polygon in polygons:
        polygon = np.asarray(polygon, dtype=int)
        pick = rng.integers(1, len(polygon) - 1, size=per_polygon)
        shares = rng.dirichlet((1, 1, 1), size=per_polygon)
        triangles = np.column_stack([np.full(per_polygon, polygon[0]), polygon[pick], polygon[pick + 1]])
        samples.append((shares[..., None] * vertices[triangles]).sum(axis=1))
    return np.concatenate(samples)
