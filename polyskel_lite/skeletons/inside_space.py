"""Where Voronoi edges cross the boundary of a solid, and which Voronoi polygons its edges go through."""

from __future__ import annotations

import numpy as np

from ..exact import between, dot, exact, minus, overlapping_pairs
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
    points, cells = skeleton.tessellation.points, skeleton.tessellation.simplices[skeleton.simplices]
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
    p, q, u, v = exact(p), exact(q), *(exact(x) for x in segment)

    def power(x, s):
        return dot(minus(x, s), minus(x, s))

    start, end = (power(x, p) - power(x, q) for x in (u, v))
    if start == end or start * end > 0:
        return False
    x = between(u, v, start / (start - end))
    return all(power(x, exact(s)) > power(x, p) for s in around)


def crossing(ends, triangles, slack):
    """Where segments (k, 2, 3) cross triangles: parameter, whether surely, whether in doubt.

    ``slack`` (k,) bounds the error of the ends.

    Examples
    --------
    >>> edge = np.array([[[0.25, 0.25, -1], [0.25, 0.25, 3]]])
    >>> triangle = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]])
    >>> [array.tolist() for array in crossing(edge, triangle, np.zeros(1))]
    [[0.25], [True], [False]]
    """
    p, way = ends[:, 0], ends[:, 1] - ends[:, 0]
    a = triangles[:, 0]
    sides = np.roll(triangles, -1, axis=1) - triangles
    normal = np.cross(sides[:, 0], sides[:, 1])
    length = np.linalg.norm(way, axis=1)
    span = length + np.abs(p - a).sum(axis=1) + np.abs(sides).sum(axis=(1, 2))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        twice_area = np.linalg.norm(normal, axis=1)
        normal = normal / twice_area[:, None]
        # Thin triangles have a rounded normal.
        blur = slack + _ROUNDING * span * (1 + (sides**2).sum(axis=(1, 2)) / twice_area)
        first = ((p - a) * normal).sum(axis=1)
        second = ((p + way - a) * normal).sum(axis=1)
        t = first / (first - second)
        moved = blur * (2 + 4 * length / np.abs(first - second))
        x = p + t[:, None] * way
        depth = np.full(len(p), np.inf)
        for k in range(3):
            inward = np.cross(normal, sides[:, k])
            inward /= np.linalg.norm(sides[:, k], axis=1)[:, None]
            depth = np.minimum(depth, ((x - triangles[:, k]) * inward).sum(axis=1))
    sided = (np.abs(first) > blur) & (np.abs(second) > blur)
    apart = sided & (first * second > 0)
    across = sided & (first * second < 0)
    apart |= across & (depth < -moved)
    meets = across & (depth > moved)
    return t, meets, ~(apart | meets)
