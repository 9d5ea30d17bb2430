"""Where Voronoi edges cross a boundary, and which Voronoi polygons the edges of a mesh go through."""

from __future__ import annotations

import numpy as np

from ..exact import fractions, normals_of, overlapping_pairs
from ..shapes import Shape
from .skeleton import Skeleton

_ROUNDING = 64 * 2.0**-53  # of a distance between points, as a share of the coordinates


def pierced(skeleton: Skeleton, shape: Shape, error: float) -> np.ndarray:
    """Polygons with all sides inside that an edge of the mesh goes through all the same, (k,) bool.

    A point of the dual of the Delaunay edge p q has no sample nearer than p and q. That is checked
    against the samples next to the polygon, which are those that bound it. ``error`` bounds that of its
    corners.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> corner = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    >>> solid = Shape([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], corner)
    >>> pierced(psl.sk2(solid), solid, 0.0).tolist()
    []
    """
    polygons = skeleton.polygons
    tessellation = skeleton.tessellation
    assert tessellation is not None
    points, cells = tessellation.points, tessellation.simplices[skeleton.simplices]
    extent = float(max(np.abs(points).max(), np.abs(shape.points).max()))
    pierced = np.zeros(len(polygons), dtype=bool)
    if not len(polygons):
        return pierced
    begin = np.cumsum(polygons.sizes) - polygons.sizes
    corners = skeleton.vertices[polygons.corners]
    low, high = np.minimum.reduceat(corners, begin), np.maximum.reduceat(corners, begin)
    edges = np.unique(np.sort(shape.facets[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    ends = shape.points[edges]
    pad = _ROUNDING * extent + error
    near = set()
    for i, j in overlapping_pairs(low - pad, high + pad, ends.min(axis=1), ends.max(axis=1)):
        near |= set(zip(i.tolist(), j.tolist(), strict=True))
    samples: dict[int, tuple] = {}
    for i, j in sorted(near):
        if i not in samples:
            around = cells[polygons[i]]
            vertices, count = np.unique(around, return_counts=True)
            samples[i] = vertices[count == len(around)], vertices[count < len(around)]
        pierced[i] |= not pierced[i] and _goes_through(
            ends[j], points[samples[i][0]], points[samples[i][1]], extent
        )
    return pierced


def _goes_through(segment, pair, around, extent) -> bool:
    """Whether a segment meets the inner part of the dual of a Delaunay edge; exact."""
    p, q = pair
    bound = _ROUNDING * (np.abs(segment).max() + extent) ** 2
    start, end = (((x - p) ** 2).sum() - ((x - q) ** 2).sum() for x in segment)
    if start * end > 0 and min(abs(start), abs(end)) > bound:
        return False
    if min(abs(start), abs(end)) > bound:
        x = segment[0] + start / (start - end) * (segment[1] - segment[0])
        gaps = ((around - x) ** 2).sum(axis=1) - ((p - x) ** 2).sum()
        blur = 16 * bound * (1 + np.abs(segment[1] - segment[0]).max() * extent / abs(start - end))
        if gaps.min() < -blur:
            return False
        if gaps.min() > blur:
            return True
    (p, q), (u, v), around = fractions(pair), fractions(segment), fractions(around)
    start, end = (((x - p) ** 2).sum() - ((x - q) ** 2).sum() for x in (u, v))
    if start == end or start * end > 0:
        return False
    x = u + start / (start - end) * (v - u)
    return bool((((around - x) ** 2).sum(axis=1) > ((p - x) ** 2).sum()).all())


def crossing(ends, facets, slack):
    """Where segments (k, 2, N) cross facets (k, N, N): parameter, whether surely, whether in doubt.

    ``slack`` (k,) bounds the error of the ends.

    Examples
    --------
    >>> edge, segment = np.array([[[0.0, 0], [4, 0]]]), np.array([[[1.0, -1], [1, 1]]])
    >>> [array.tolist() for array in crossing(edge, segment, np.zeros(1))]
    [[0.25], [True], [False]]
    >>> edge = np.array([[[0.25, 0.25, -1], [0.25, 0.25, 3]]])
    >>> triangle = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]])
    >>> [array.tolist() for array in crossing(edge, triangle, np.zeros(1))]
    [[0.25], [True], [False]]
    """
    p, way = ends[:, 0], ends[:, 1] - ends[:, 0]
    a, plane = facets[:, 0], facets.shape[1] == 2
    sides = np.roll(facets, -1, axis=1) - facets
    normal = normals_of(facets)
    length = np.linalg.norm(way, axis=1)
    span = length + np.abs(p - a).sum(axis=1) + np.abs(sides).sum(axis=(1, 2))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        size = np.linalg.norm(normal, axis=1)
        normal = normal / size[:, None]
        # Thin triangles have a rounded normal.
        thin = 0 if plane else (sides**2).sum(axis=(1, 2)) / size
        blur = slack + _ROUNDING * span * (1 + thin)
        first = ((p - a) * normal).sum(axis=1)
        second = ((p + way - a) * normal).sum(axis=1)
        t = first / (first - second)
        moved = blur * (2 + 4 * length / np.abs(first - second))
        x = p + t[:, None] * way
        inward = sides if plane else np.cross(normal[:, None], sides)
        inward = inward / np.linalg.norm(sides, axis=2)[..., None]
        depth = ((x[:, None] - facets) * inward).sum(axis=2).min(axis=1)
    sided = (np.abs(first) > blur) & (np.abs(second) > blur)
    apart = sided & (first * second > 0)
    across = sided & (first * second < 0)
    apart |= across & (depth < -moved)
    meets = across & (depth > moved)
    return t, meets, ~(apart | meets)
