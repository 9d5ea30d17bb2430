"""The Voronoi graph of samples seen from a shape: what Sk1, Sk2 and Sk3 keep of it (sections 3.1-3.3).

One class for the plane and for space. Floats with an error bound decide nearly everything; an edge or vertex
within its error of the boundary is decided again with rational numbers.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np

from ..errors import InputError
from ..exact import (
    Polygons,
    clip_rational,
    facet_distance,
    fractions,
    locate,
    normals_of,
    overlapping_pairs,
    rational_circumcenter,
)
from ..graphs import as_tessellation
from ..shapes import Shape
from .crossings import crossing, pierced
from .skeleton import Skeleton
from .voronoi_graph import dual_complex, outward_normals

_ROUNDING = 64 * 2.0**-53  # of a distance between points, as a share of the coordinates


class VoronoiInside:
    """The Voronoi graph of E seen from the shape: what is inside, and where the boundary cuts.

    Parameters
    ----------
    shape : Shape
    E : (n, N) array-like, Tessellation or None
        The samples; None for the vertices of the shape.
    side : +1 or -1
        Of the boundary: inside, or the closure of the complement.

    Examples
    --------
    >>> square = Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]])
    >>> VoronoiInside(square, None, 1).vertices().vertices.tolist()
    [[1.0, 1.0], [1.0, 1.0]]
    """

    def __init__(self, shape: Shape, E, side: int):
        self.side, self.shape, self.boundary = side, shape, shape.segments
        # Among cocircular samples the diagonals of the boundary: the tessellation of `delaunay_shape`.
        self.tessellation = shape.tessellation if E is None else as_tessellation(E)
        n = self.tessellation.dimension
        if n != shape.dimension:
            raise InputError(
                f"E is in {n}D and the shape in {shape.dimension}D; pass an (n, {shape.dimension}) array."
            )
        self.low, self.high = self.boundary.min(axis=1), self.boundary.max(axis=1)
        # A ray cut at some of these lengths ends outside the box of the shape, wherever it begins.
        self.extent = float(max(np.abs(self.tessellation.points).max(), np.abs(shape.points).max()))
        # No boundary point is farther from the samples: w⁻¹ is found to a millionth of itself.
        self.reach = shape.covering_radius(self.tessellation.points) * (1 + 4e-6) + 1e-12 * self.extent
        centers, error = self.tessellation.circumcenters, self.tessellation.circumcenter_errors
        self.sure = np.isfinite(error) & np.isfinite(centers).all(axis=1)
        self.error = np.where(self.sure, error, 0.0)
        self.inside = self._vertices_inside()

    def vertices(self) -> Skeleton:
        """Sk1."""
        nothing = np.ones(len(self.tessellation.facet_table[0]), dtype=bool)
        return dual_complex(self.tessellation, self.inside, cut=nothing)

    def elements(self) -> Skeleton:
        """Sk2; in space without the polygons that an edge of the mesh goes through."""
        skeleton = dual_complex(self.tessellation, self.inside, cut=~self._whole(), rays=self.side < 0)
        if not len(skeleton.polygons):
            return skeleton
        bad = pierced(skeleton, self.shape, self.error.max(where=self.inside, initial=0.0))
        kept = [skeleton.polygons[k] for k in np.flatnonzero(~bad)]
        return replace(skeleton, polygons=Polygons.of(kept)) if bad.any() else skeleton

    def intersection(self) -> Skeleton:
        """Sk3: Sk2 and the pieces of cut edges that are inside, with a vertex at every cut."""
        sk2 = self.elements()
        tessellation, n = self.tessellation, sk2.dimension
        number = np.where(self.inside, np.cumsum(self.inside) - 1, -1)
        facets, sides = tessellation.facet_table
        points, radii, edges, rays, ray_vertices = [], [], [], [], []

        def add(row, t):
            points.append(self._at(row, t))
            # All samples of the facet are at this distance, and none is nearer.
            radii.append(np.linalg.norm(points[-1] - tessellation.points[facets[row, 0]], axis=0))
            return len(sk2.vertices) + len(points) - 1

        for row, intervals in sorted(self.pieces.items()):
            first, second = sides[row].tolist()
            for t0, t1 in intervals:
                begin = int(number[first]) if t0 == 0 else add(row, t0)
                if t1 == 1 and second < 0:
                    rays.append(outward_normals(tessellation, np.array([row]))[0])
                    ray_vertices.append(begin)
                else:
                    edges.append((begin, int(number[second]) if t1 == 1 else add(row, t1)))
        return replace(
            sk2,
            vertices=np.concatenate([sk2.vertices, np.reshape(points, (-1, n))]),
            radii=np.concatenate([sk2.radii, radii]),
            simplices=np.concatenate([sk2.simplices, np.full(len(points), -1)]),
            edges=np.concatenate([sk2.edges, np.reshape(edges, (-1, 2)).astype(np.int64)]),
            rays=np.concatenate([sk2.rays, np.reshape(rays, (-1, n))]),
            ray_vertices=np.concatenate([sk2.ray_vertices, np.array(ray_vertices, dtype=np.int64)]),
        )

    def _vertices_inside(self) -> np.ndarray:
        centers, error = self.tessellation.circumcenters, self.error
        sure = np.flatnonzero(self.sure)
        low, high = centers[sure] - error[sure, None], centers[sure] + error[sure, None]
        doubt = ~self.sure
        for i, j in overlapping_pairs(low, high, self.low, self.high):
            bound = error[sure[i]] + _ROUNDING * self.extent
            doubt[sure[i[facet_distance(centers[sure[i]], self.boundary[j]) <= bound]]] = True
        inside = np.zeros(len(centers), dtype=bool)
        inside[~doubt] = self.side * locate(self.boundary, centers[~doubt]) >= 0
        if doubt.any():
            exact = np.array([self._center(k) for k in np.flatnonzero(doubt)])
            inside[doubt] = self.side * locate(self.boundary, exact) >= 0
        return inside

    def _whole(self) -> np.ndarray:
        """Voronoi edges (rows of ``facet_table``) wholly inside; fills ``pieces`` of those partly inside."""
        sides = self.tessellation.facet_table[1]
        second = np.where(sides[:, 1] >= 0, sides[:, 1], sides[:, 0])
        doubt = ~self.sure[sides[:, 0]] | ~self.sure[second]
        slack = np.maximum(self.error[sides[:, 0]], self.error[second])
        self.ends = self._float_ends(sides, second, ~doubt)
        low, high = self._meeting_boxes()
        clear = np.flatnonzero(~doubt)
        low[clear] = np.maximum(low[clear], self.ends[clear].min(axis=1) - slack[clear, None])
        high[clear] = np.minimum(high[clear], self.ends[clear].max(axis=1) + slack[clear, None])
        meet = clear[(low[clear] <= high[clear]).all(axis=1)]
        hits = [(np.zeros(0, dtype=np.int64), np.zeros(0), np.zeros(0, dtype=np.int64))]
        for i, j in overlapping_pairs(low[meet], high[meet], self.low, self.high):
            i = meet[i]
            t, meets, unsure = crossing(self.ends[i], self.boundary[j], slack[i])
            doubt[i[unsure]] = True
            hits.append((i[meets], t[meets], j[meets]))
        rows, times, facets = (np.concatenate(column) for column in zip(*hits, strict=True))
        order = np.lexsort((times, rows))
        rows, times = rows[order], times[order]
        self.met = dict(
            zip(zip(rows.tolist(), times.tolist(), strict=True), facets[order].tolist(), strict=True)
        )
        starts_inside = self.inside[sides[:, 0]]
        whole = starts_inside & ~doubt
        whole[rows] = False
        self.pieces: dict[int, list[tuple]] = {}
        for row in np.unique(rows[~doubt[rows]]).tolist():
            begin, end = np.searchsorted(rows, [row, row + 1])
            # The side changes at every crossing.
            cuts = pairwise([0.0, *times[begin:end].tolist(), 1.0])
            self.pieces[row] = list(cuts)[0 if starts_inside[row] else 1 :: 2]
        for row in np.flatnonzero(doubt).tolist():
            near = np.flatnonzero(((low[row] <= self.high) & (self.low <= high[row])).all(axis=1))
            start, end = self._exact_ends(row)
            pieces = clip_rational(self.boundary, near, start, end, self.side)
            whole[row] = pieces == [(0, 1)]
            if pieces and not whole[row]:
                self.pieces[row] = pieces
        return whole

    def _meeting_boxes(self):
        """Boxes that hold every boundary point of each Voronoi edge.

        Such a point is as far from the samples of the edge as from all samples: at most w⁻¹.
        """
        corners = self.tessellation.points[self.tessellation.facets()]
        return corners.max(axis=1) - self.reach, corners.min(axis=1) + self.reach

    def _float_ends(self, sides, second, clear):
        centers = self.tessellation.circumcenters
        ends = np.zeros((len(sides), 2, self.shape.dimension))
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
        normal = normals_of(fractions(self.tessellation.points[self.tessellation.facets()[[row]]]))[0]
        outward = fractions(outward_normals(self.tessellation, np.array([row]))[0])
        far = 8 * (Fraction(self.extent) + np.abs(start).max()) / np.abs(normal).max()
        return start, start + (far if normal @ outward > 0 else -far) * normal

    def _at(self, row, t) -> np.ndarray:
        if isinstance(t, Fraction):
            start, end = self._exact_ends(row)
            return (start + t * (end - start)).astype(float)
        # Circumcenters far away are rounded coarsely. The point of the facet that is as far from all samples
        # of the edge is not.
        samples = self.tessellation.points[self.tessellation.facets()[row]]
        corner, *others = self.boundary[self.met[row, t]]
        along, ways = np.array(others) - corner, samples[1:] - samples[0]
        half = (ways * ways).sum(axis=1) / 2
        return corner + np.linalg.solve(ways @ along.T, half - ways @ (corner - samples[0])) @ along
