"""The Voronoi graph of samples seen from a shape: what Sk1, Sk2 and Sk3 keep of it (sections 3.1-3.3).

Floats with an error bound decide nearly everything; an edge or vertex within its error of the
boundary is decided again with rational numbers.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np

from ..errors import InputError
from ..exact import (
    clip_exactly,
    exact_circumcenter,
    locate,
    locate_exactly,
    overlapping_pairs,
    point_segment_distance,
)
from ..graphs import Tessellation, delaunay
from ..shapes import Shape
from .inside import with_cut_edges
from .skeleton import Skeleton
from .voronoi_graph import dual_complex, outward_normals


class VoronoiInShape:
    """The Voronoi graph of E seen from the shape: what is inside, and where the boundary cuts."""

    def __init__(self, shape: Shape, E, side: int):
        self.side = side
        self.segments = shape.segments
        if E is None:
            # Among cocircular samples the diagonals of the boundary: the tessellation of `delaunay_shape`.
            E = delaunay(shape.points, shape.facets)
        self.tessellation = E if isinstance(E, Tessellation) else delaunay(E)
        if self.tessellation.dimension != 2:
            raise InputError(
                f"E is in {self.tessellation.dimension}D and the shape in 2D; pass an (n, 2) array."
            )
        self.error = self.tessellation.circumcenter_errors
        self.reach = shape.covering_radius(self.tessellation.points)
        low, high = shape.points.min(axis=0), shape.points.max(axis=0)
        # A ray cut at this length ends outside the box of the shape, wherever it begins.
        self.extent = float(np.abs(np.concatenate([self.tessellation.points, [low, high]])).max())
        self.inside = self._vertices_inside()

    def vertices(self) -> Skeleton:
        keep = self.inside
        nothing = np.ones(len(self.tessellation.facet_table[0]), dtype=bool)
        return dual_complex(self.tessellation, keep, cut=nothing)

    def elements(self) -> Skeleton:
        crossed = self._crossed()
        return dual_complex(self.tessellation, self.inside, cut=crossed, rays=self.side < 0)

    def intersection(self) -> Skeleton:
        return with_cut_edges(self.elements(), self.inside, self.pieces, self._at)

    def _vertices_inside(self) -> np.ndarray:
        centers, error = self.tessellation.circumcenters, self.error
        sure = np.isfinite(error) & np.isfinite(centers).all(axis=1)
        sure[sure] = ~_near(centers[sure], error[sure], self.segments)
        inside = np.zeros(len(centers), dtype=bool)
        inside[sure] = self.side * locate(self.segments, centers[sure]) >= 0
        for k in np.flatnonzero(~sure):
            inside[k] = self.side * locate_exactly(self.segments, self._center(k)) >= 0
        return inside

    def _crossed(self) -> np.ndarray:
        """Voronoi edges (rows of ``facet_table``) that are not wholly inside; fills ``pieces``."""
        sides = self.tessellation.facet_table[1]
        finite = np.isfinite(self.tessellation.circumcenters).all(axis=1)
        error = np.append(self.error, 0.0)[sides]
        error[sides[:, 1] < 0, 1] = error[sides[:, 1] < 0, 0]
        doubt = ~finite[sides[:, 0]] | ~np.append(finite, True)[sides[:, 1]] | ~np.isfinite(error).all(axis=1)
        ends = np.zeros((len(sides), 2, 2))
        clear = np.flatnonzero(~doubt)
        ends[clear, 0] = self.tessellation.circumcenters[sides[clear, 0]]
        ends[clear, 1] = self._float_ends(clear)
        slack = np.where(doubt, 0.0, error.max(axis=1))
        hits: list[tuple[np.ndarray, np.ndarray]] = []
        low, high = self._meeting_boxes()
        low[clear] = np.maximum(low[clear], ends[clear].min(axis=1) - slack[clear, None])
        high[clear] = np.minimum(high[clear], ends[clear].max(axis=1) + slack[clear, None])
        box_low, box_high = self.segments.min(axis=1), self.segments.max(axis=1)
        meet = clear[(low[clear] <= high[clear]).all(axis=1)]
        for i, j in overlapping_pairs(low[meet], high[meet], box_low, box_high):
            i = meet[i]
            t, meets, unsure = _crossing(ends[i], self.segments[j], slack[i])
            doubt[i[unsure]] = True
            hits.append((i[meets], t[meets]))
        rows = np.concatenate([h[0] for h in hits]) if hits else np.zeros(0, dtype=np.int64)
        times = np.concatenate([h[1] for h in hits]) if hits else np.zeros(0)
        self.ends, self.pieces = ends, {}
        starts_inside = self.inside[sides[:, 0]]
        whole = starts_inside & ~doubt
        whole[rows] = False
        order = np.lexsort((times, rows))
        rows, times = rows[order], times[order]
        for row in np.unique(rows[~doubt[rows]]).tolist():
            begin, end = np.searchsorted(rows, [row, row + 1])
            cuts = [0.0, *times[begin:end].tolist(), 1.0]
            # The side changes at every crossing.
            self.pieces[row] = list(pairwise(cuts))[0 if starts_inside[row] else 1 :: 2]
        for row in np.flatnonzero(doubt).tolist():
            near = ((low[row] <= box_high) & (box_low <= high[row])).all(axis=1)
            pieces = clip_exactly(self.segments, *self._exact_ends(row), self.side, near)
            whole[row] = pieces == [(0, 1)]
            if pieces and not whole[row]:
                self.pieces[row] = pieces
        return ~whole

    def _meeting_boxes(self):
        """Boxes that hold every boundary point of each Voronoi edge.

        Such a point is as far from the edge's two samples as from all samples: at most w⁻¹.
        """
        pair = self.tessellation.points[self.tessellation.facets()]
        # w⁻¹ is right to 1e-9 of itself and to some 1e-15 of the coordinates.
        reach = self.reach * (1 + 1e-6) + 1e-12 * self.extent
        return pair.max(axis=1) - reach, pair.min(axis=1) + reach

    def _float_ends(self, rows):
        sides = self.tessellation.facet_table[1][rows]
        centers = self.tessellation.circumcenters
        out = centers[np.maximum(sides[:, 1], 0)].copy()
        open_rows = np.flatnonzero(sides[:, 1] < 0)
        for k in open_rows.tolist():
            out[k] = self._far(rows[k], centers[sides[k, 0]])
        return out

    def _direction(self, row) -> np.ndarray:
        return outward_normals(self.tessellation, np.array([row]))[0]

    def _far(self, row, start):
        return start + self._direction(row) * 4 * (self.extent + np.abs(start).max())

    def _at(self, row, t) -> np.ndarray:
        if isinstance(t, Fraction):
            (ax, ay), (bx, by) = self._exact_ends(row)
            return np.array([float(ax + t * (bx - ax)), float(ay + t * (by - ay))])
        a, b = self.ends[row]
        return a + t * (b - a)

    def _center(self, k) -> tuple[Fraction, Fraction]:
        return exact_circumcenter(self.tessellation.points[self.tessellation.simplices[k]])

    def _exact_ends(self, row):
        first, second = self.tessellation.facet_table[1][row].tolist()
        start = self._center(first)
        if second >= 0:
            return start, self._center(second)
        (ax, ay), (bx, by) = (
            [Fraction(x) for x in p]
            for p in self.tessellation.points[self.tessellation.facets()[row]].tolist()
        )
        normal = (by - ay, ax - bx)
        outward = self._direction(row)
        if normal[0] * Fraction(outward[0]) + normal[1] * Fraction(outward[1]) < 0:
            normal = (-normal[0], -normal[1])
        reach = (
            4 * (Fraction(self.extent) + abs(start[0]) + abs(start[1])) / max(abs(normal[0]), abs(normal[1]))
        )
        return start, (start[0] + normal[0] * reach, start[1] + normal[1] * reach)


def _near(queries, error, segments) -> np.ndarray:
    """Which queries are within their error of a segment."""
    near = np.zeros(len(queries), dtype=bool)
    low, high = segments.min(axis=1), segments.max(axis=1)
    for i, j in overlapping_pairs(queries - error[:, None], queries + error[:, None], low, high):
        near[i[point_segment_distance(queries[i], segments[j]) <= 2 * error[i]]] = True
    return near


def _crossing(edges, segments, slack):
    """Where edges cross segments: parameter on the edge, whether they cross, whether that is in doubt."""
    p, d = edges[:, 0], edges[:, 1] - edges[:, 0]
    a, e = segments[:, 0], segments[:, 1] - segments[:, 0]

    def cross(u, v):
        return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]

    # Signed distances of each one's ends to the other one's line; rounding and slack blur them.
    length_d, length_e = np.sqrt((d**2).sum(axis=1)), np.sqrt((e**2).sum(axis=1))
    with np.errstate(divide="ignore", invalid="ignore"):
        of_edge = np.stack([cross(e, p - a), cross(e, p + d - a)]) / length_e
        of_segment = np.stack([cross(d, a - p), cross(d, a + e - p)]) / length_d
        span = length_d + length_e + np.sqrt(((a - p) ** 2).sum(axis=1))
        blur = 2 * slack + 16 * 2.0**-53 * span
        # Tilting the edge by its error moves its line at most this much where the segment is.
        blur_segment = blur * (1 + 2 * span / length_d)
        t = of_edge[0] / (of_edge[0] - of_edge[1])
    meets = (of_edge[0] * of_edge[1] < 0) & (of_segment[0] * of_segment[1] < 0)
    apart = (np.abs(of_edge) > blur).all(axis=0) & (of_edge[0] * of_edge[1] > 0)
    apart |= (np.abs(of_segment) > blur_segment).all(axis=0) & (of_segment[0] * of_segment[1] > 0)
    sure = (np.abs(of_edge) > blur).all(axis=0) & (np.abs(of_segment) > blur_segment).all(axis=0)
    return t, meets & sure, ~(apart | sure)
