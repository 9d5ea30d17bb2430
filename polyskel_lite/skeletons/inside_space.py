"""The Voronoi graph of samples seen from a solid: what Sk1, Sk2 and Sk3 keep of it (sections 3.1-3.3).

As `_inside` does in the plane: floats with an error bound decide nearly everything, and what is within
its error of the boundary is decided again with rational numbers.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np

from ..errors import InputError
from ..exact import (
    Polygons,
    between,
    clip_rational,
    dot,
    exact,
    locate_in_mesh,
    locate_rational,
    minus,
    overlapping_pairs,
    point_triangle_distance,
    rational_circumcenter,
)
from ..graphs import Tessellation, delaunay
from ..shapes import Shape
from .inside import with_cut_edges
from .skeleton import Skeleton
from .voronoi_graph import dual_complex, outward_normals

_UNIT = 2.0**-53


class VoronoiInSolid:
    """The Voronoi graph of E seen from the solid: what is inside, and where the boundary cuts."""

    def __init__(self, shape: Shape, E, side: int):
        self.side, self.shape, self.triangles = side, shape, shape.segments
        self.tessellation = E if isinstance(E, Tessellation) else delaunay(shape.points if E is None else E)
        if self.tessellation.dimension != 3:
            raise InputError(
                f"E is in {self.tessellation.dimension}D and the shape in 3D; pass an (n, 3) array."
            )
        self.low, self.high = self.triangles.min(axis=1), self.triangles.max(axis=1)
        self.extent = float(max(np.abs(self.tessellation.points).max(), np.abs(shape.points).max()))
        # No boundary point is farther from the samples; found to a millionth of itself.
        self.reach = shape.covering_radius(self.tessellation.points) * (1 + 4e-6) + 1e-12 * self.extent
        centers, error = self.tessellation.circumcenters, self.tessellation.circumcenter_errors
        self.sure = np.isfinite(error) & np.isfinite(centers).all(axis=1)
        self.error = np.where(self.sure, error, 0.0)
        self.inside = self._vertices_inside()

    def vertices(self) -> Skeleton:
        nothing = np.ones(len(self.tessellation.facet_table[0]), dtype=bool)
        return dual_complex(self.tessellation, self.inside, cut=nothing)

    def elements(self) -> Skeleton:
        skeleton = dual_complex(self.tessellation, self.inside, cut=~self._whole(), rays=self.side < 0)
        pierced = self._pierced(skeleton)
        if not pierced.any():
            return skeleton
        kept = [p for p, bad in zip(skeleton.polygons, pierced, strict=True) if not bad]
        return replace(skeleton, polygons=Polygons.of(kept))

    def intersection(self) -> Skeleton:
        return with_cut_edges(self.elements(), self.inside, self.pieces, self._at)

    def _vertices_inside(self) -> np.ndarray:
        centers, error = self.tessellation.circumcenters, self.error
        sure = np.flatnonzero(self.sure)
        low, high = centers[sure] - error[sure, None], centers[sure] + error[sure, None]
        doubt = ~self.sure
        for i, j in overlapping_pairs(low, high, self.low, self.high):
            # The computed distance is itself rounded, by a few units of the coordinates.
            bound = error[sure[i]] + 64 * _UNIT * self.extent
            near = point_triangle_distance(centers[sure[i]], self.triangles[j]) <= bound
            doubt[sure[i[near]]] = True
        inside = np.zeros(len(centers), dtype=bool)
        inside[~doubt] = self.side * locate_in_mesh(self.triangles, centers[~doubt]) >= 0
        for k in np.flatnonzero(doubt):
            inside[k] = self.side * locate_rational(self.triangles, self._center(k)) >= 0
        return inside

    def _whole(self) -> np.ndarray:
        """Voronoi edges (rows of ``facet_table``) wholly inside; fills ``pieces`` of those partly inside."""
        sides = self.tessellation.facet_table[1]
        there = sides[:, 1] >= 0
        second = np.where(there, sides[:, 1], sides[:, 0])
        doubt = ~self.sure[sides[:, 0]] | ~self.sure[second]
        slack = np.maximum(self.error[sides[:, 0]], self.error[second])
        self.ends = self._float_ends(sides, second, ~doubt)
        low, high = self._meeting_boxes()
        clear = np.flatnonzero(~doubt)
        low[clear] = np.maximum(low[clear], self.ends[clear].min(axis=1) - slack[clear, None])
        high[clear] = np.minimum(high[clear], self.ends[clear].max(axis=1) + slack[clear, None])
        meet = clear[(low[clear] <= high[clear]).all(axis=1)]
        hits = [(np.zeros(0, dtype=np.int64), np.zeros(0))]
        for i, j in overlapping_pairs(low[meet], high[meet], self.low, self.high):
            i = meet[i]
            t, meets, unsure = _crossing(self.ends[i], self.triangles[j], slack[i])
            doubt[i[unsure]] = True
            hits.append((i[meets], t[meets]))
        rows, times = (np.concatenate(column) for column in zip(*hits, strict=True))
        order = np.lexsort((times, rows))
        rows, times = rows[order], times[order]
        starts_inside = self.inside[sides[:, 0]]
        whole = starts_inside & ~doubt
        whole[rows] = False
        self.pieces = {}
        for row in np.unique(rows[~doubt[rows]]).tolist():
            begin, end = np.searchsorted(rows, [row, row + 1])
            # The side changes at every crossing.
            self.pieces[row] = list(pairwise([0.0, *times[begin:end].tolist(), 1.0]))[
                0 if starts_inside[row] else 1 :: 2
            ]
        for row in np.flatnonzero(doubt).tolist():
            near = np.flatnonzero(((low[row] <= self.high) & (self.low <= high[row])).all(axis=1))
            pieces = clip_rational(self.triangles, near, *self._exact_ends(row), self.side)
            whole[row] = pieces == [(0, 1)]
            if pieces and not whole[row]:
                self.pieces[row] = pieces
        return whole

    def _meeting_boxes(self):
        # A boundary point on a Voronoi edge is as far from the edge's three samples as from any other.
        corners = self.tessellation.points[self.tessellation.facets()]
        return corners.max(axis=1) - self.reach, corners.min(axis=1) + self.reach

    def _float_ends(self, sides, second, clear):
        centers = self.tessellation.circumcenters
        ends = np.zeros((len(sides), 2, 3))
        ends[clear, 0], ends[clear, 1] = centers[sides[clear, 0]], centers[second[clear]]
        rays = np.flatnonzero(clear & (sides[:, 1] < 0))
        start = ends[rays, 0]
        far = 4 * (self.extent + np.abs(start).max(axis=1, initial=0.0))
        ends[rays, 1] = start + outward_normals(self.tessellation, rays) * far[:, None]
        return ends

    def _center(self, k):
        return rational_circumcenter(self.tessellation.points[self.tessellation.simplices[k]])

    def _exact_ends(self, row):
        first, second = self.tessellation.facet_table[1][row].tolist()
        start = self._center(first)
        if second >= 0:
            return start, self._center(second)
        a, b, c = (exact(p) for p in self.tessellation.points[self.tessellation.facets()[row]])
        u, v = minus(b, a), minus(c, a)
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        outward = exact(outward_normals(self.tessellation, np.array([row]))[0])
        sign = 1 if dot(normal, outward) > 0 else -1
        far = 8 * (Fraction(self.extent) + max(map(abs, start))) / max(map(abs, normal))
        return start, tuple(x + sign * far * n for x, n in zip(start, normal, strict=True))

    def _at(self, row, t) -> np.ndarray:
        if isinstance(t, Fraction):
            return np.array([float(x) for x in between(*self._exact_ends(row), t)])
        a, b = self.ends[row]
        return a + t * (b - a)

    def _pierced(self, skeleton: Skeleton) -> np.ndarray:
        """Polygons with all sides inside that an edge of the mesh goes through all the same, (k,) bool.

        A point of the dual of the Delaunay edge p q has no sample nearer than p and q. That is checked
        against the samples next to the polygon, which are those that bound it.
        """
        polygons = skeleton.polygons
        pierced = np.zeros(len(polygons), dtype=bool)
        if not len(polygons):
            return pierced
        begin = np.cumsum(polygons.sizes) - polygons.sizes
        corners = skeleton.vertices[polygons.corners]
        low, high = np.minimum.reduceat(corners, begin), np.maximum.reduceat(corners, begin)
        edges = np.unique(np.sort(self.shape.facets[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
        ends = self.shape.points[edges]
        pad = 64 * _UNIT * self.extent + self.error.max(where=self.inside, initial=0.0)
        near = set()
        for i, j in overlapping_pairs(low - pad, high + pad, ends.min(axis=1), ends.max(axis=1)):
            near |= set(zip(i.tolist(), j.tolist(), strict=True))
        cells = self.tessellation.simplices[skeleton.simplices]
        samples: dict[int, tuple] = {}
        for i, j in sorted(near):
            if i not in samples:
                around = cells[polygons[i]]
                vertices, count = np.unique(around, return_counts=True)
                samples[i] = vertices[count == len(around)], vertices[count < len(around)]
            pierced[i] |= not pierced[i] and self._goes_through(ends[j], *samples[i])
        return pierced

    def _goes_through(self, segment, pair, others) -> bool:
        """Whether a segment meets the inner part of the dual of a Delaunay edge; exact."""
        points = self.tessellation.points
        (p, q), around = points[pair], points[others]
        bound = 64 * _UNIT * (np.abs(segment).max() + self.extent) ** 2
        start, end = (((x - p) ** 2).sum() - ((x - q) ** 2).sum() for x in segment)
        if start * end > 0 and min(abs(start), abs(end)) > bound:
            return False
        if min(abs(start), abs(end)) > bound:
            x = segment[0] + start / (start - end) * (segment[1] - segment[0])
            gaps = ((around - x) ** 2).sum(axis=1) - ((p - x) ** 2).sum()
            blur = 16 * bound * (1 + np.abs(segment[1] - segment[0]).max() * self.extent / abs(start - end))
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


def _crossing(ends, triangles, slack):
    """Where segments (k, 2, 3) cross triangles: parameter, whether surely, whether in doubt.

    ``slack`` bounds the error of the ends.
    """
    p, way = ends[:, 0], ends[:, 1] - ends[:, 0]
    a = triangles[:, 0]
    sides = np.roll(triangles, -1, axis=1) - triangles
    normal = np.cross(sides[:, 0], sides[:, 1])
    length = np.sqrt((way**2).sum(axis=1))
    span = length + np.abs(p - a).sum(axis=1) + np.abs(sides).sum(axis=(1, 2))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        twice_area = np.sqrt((normal**2).sum(axis=1))
        normal = normal / twice_area[:, None]
        # Thin triangles have a rounded normal.
        blur = slack + 64 * _UNIT * span * (1 + (sides**2).sum(axis=(1, 2)) / twice_area)
        first = ((p - a) * normal).sum(axis=1)
        second = ((p + way - a) * normal).sum(axis=1)
        t = first / (first - second)
        moved = blur * (2 + 4 * length / np.abs(first - second))
        x = p + t[:, None] * way
        depth = np.full(len(p), np.inf)
        for k in range(3):
            inward = np.cross(normal, sides[:, k])
            inward /= np.sqrt((sides[:, k] ** 2).sum(axis=1))[:, None]
            depth = np.minimum(depth, ((x - triangles[:, k]) * inward).sum(axis=1))
    sided = (np.abs(first) > blur) & (np.abs(second) > blur)
    apart = sided & (first * second > 0)
    across = sided & (first * second < 0)
    apart |= across & (depth < -moved)
    meets = across & (depth > moved)
    return t, meets, ~(apart | meets)
