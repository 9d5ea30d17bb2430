"""Unions of balls (the paper's appendix A): boundary, singular points, generating balls, exact skeleton.

The paper reads Sk2 as the skeleton of a *polyball* Y_w, the union of the Delaunay balls whose centres
lie in the shape (section 3.2). Arcs are computed in `discs` and `spheres`, pairs and triples come from the
power diagram (`power`), and the skeleton is put together in `skeleton`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..checks import as_points, as_radii
from ..errors import InputError, TangentBallsError, TessellationError
from ..skeletons import Skeleton
from .discs import TURN, Arcs, DiscBoundary, disc_boundary, distance_to_arcs
from .distance import distance_to_boundary
from .generating import distinct, isolated_lenses, lonely, needed
from .incidence import Incidence
from .pairs import crossings, in_any, pair_bound
from .power import PowerTriangulation, power_triangulation
from .skeleton import Boundary, ball_skeleton
from .sphere_patches import patches
from .spheres import SphereBoundary, verified_boundary
from .volumes import surface_area, volume

# Where more pairs of discs than this may meet, only those in the power diagram are looked at: less sure if
# discs nearly coincide, but 10,000 discs on one another would have 50 million pairs.
_PAIRS = 10_000_000


@dataclass(frozen=True, eq=False)
class Polyball:
    """A finite union of closed balls in the plane or in space (section 3.2, appendix A).

    Which pairs and triples of balls show on the boundary is read off the power diagram, so that 10,000
    balls take seconds. Equal balls count as one.

    Parameters
    ----------
    centers : (k, N) array-like
        N = 2 or 3, at least one ball.
    radii : (k,) array-like
        Positive, in the unit of the coordinates.

    Raises
    ------
    InputError
        If the arrays do not fit together, a number is not finite, or a radius is not positive.

    Notes
    -----
    Many Delaunay balls pass through one sample, which rounded centres and radii do not keep exactly.
    So a ball is believed to 1e-12 of its radius (plus the rounding of its coordinates), the error
    of a crossing follows from the angle between the spheres, never more than 1e-6 of the
    smaller radius, and crossings that agree within their errors count as one. A ball that leaves
    another one by less than 1e-10 of its radius is part of it. Everything else is exact to rounding.

    References
    ----------
    Attali and Montanvert, Computing and simplifying 2D and 3D continuous skeletons, 1997, appendix A.

    Examples
    --------
    Two unit discs whose circles cross at (0, ±√3/2):

    >>> Y = Polyball([(-0.5, 0), (0.5, 0)], [1, 1])
    >>> Y.contains([(0, 0), (0, 0.9), (1.5, 0)])
    array([ True, False,  True])
    >>> len(Y.singular_points()), round(Y.area(), 4)
    (2, 5.0548)
    """

    centers: np.ndarray
    radii: np.ndarray

    def __post_init__(self):
        centers = as_points(self.centers, name="centers")
        if not len(centers):
            raise InputError("centers is empty; a polyball needs at least one ball.")
        radii = as_radii(self.radii, len(centers))
        centers.setflags(write=False)
        radii.setflags(write=False)
        object.__setattr__(self, "centers", centers)
        object.__setattr__(self, "radii", radii)

    def __len__(self) -> int:
        """The number of balls."""
        return len(self.radii)

    @property
    def dimension(self) -> int:
        """N, the dimension of the space."""
        return self.centers.shape[1]

    def contains(self, queries) -> np.ndarray:
        """Tell which points lie in the closed union of the balls.

        Parameters
        ----------
        queries : (k, N) array-like

        Returns
        -------
        (k,) bool array
            Points on a sphere are inside, as far as rounded coordinates can be on a sphere.

        Raises
        ------
        InputError
            If `queries` is not a finite (k, N) array.

        Examples
        --------
        >>> Polyball([(0, 0, 0), (3, 0, 0)], [1, 1]).contains([(1, 0, 0), (1.5, 0, 0)])
        array([ True, False])
        """
        queries = as_points(queries, name="queries", dimensions=(self.dimension,))
        return in_any(queries, self.centers, self.radii)

    def arcs(self) -> Arcs:
        """List the circular arcs that make up the boundary of a planar polyball.

        A disc inside another one has none; of equal discs the first one has them all.

        Returns
        -------
        Arcs
            The named tuple ``(ball, start, end)`` of three (a,) arrays, sorted by ball, then start:
            the index of the disc and two angles in radians, -π <= start < π, counter-clockwise to
            end <= start + 2π.

        Raises
        ------
        InputError
            If the balls are not discs of the plane.

        Examples
        --------
        >>> ball, start, end = Polyball([(0, 0), (1, 0), (0.1, 0)], [1, 1, 0.2]).arcs()
        >>> ball, np.degrees(start).round(), np.degrees(end).round()
        (array([0, 1]), array([  60., -120.]), array([300., 120.]))
        """
        self._only(2, "arcs", "patches")
        arcs = self._boundary.arcs
        return Arcs(self._rows[arcs.ball], arcs.start, arcs.end)

    def singular_points(self) -> np.ndarray:
        """Find the points of the boundary that lie on N or more spheres (definition 4).

        In space these are the ends of the arcs in which two spheres meet on the boundary. Where two
        discs touch from outside, the touching point is one of them; appendix A leaves such polyballs out.

        Returns
        -------
        (s, N) float array
            In no particular order.

        References
        ----------
        Attali and Montanvert, 1997, appendix A, definition 4.

        Examples
        --------
        All three circles pass through the same two points:

        >>> Y = Polyball([(0, 0), (2, 0), (1, 0)], [5**0.5, 5**0.5, 2])
        >>> sorted(Y.singular_points().round(9).tolist())
        [[1.0, -2.0], [1.0, 2.0]]
        """
        return self._boundary.corners + self._origin

    def exposed(self) -> np.ndarray:
        """Tell which balls have a piece of their own sphere on the boundary.

        Returns
        -------
        (k,) bool array
            Of equal balls only the first one.

        Examples
        --------
        >>> Polyball([(0, 0), (1, 0), (0.5, 0)], [1, 1, 0.5]).exposed().tolist()
        [True, True, False]
        """
        exposed = np.zeros(len(self), dtype=bool)
        exposed[self._rows[self._exposed]] = True
        return exposed

    def exposed_pairs(self) -> np.ndarray:
        """List the pairs of balls whose spheres meet on the boundary: in an arc, or in the plane in a point.

        In space each of them gives a segment of the skeleton (the corrected Theorem 4).

        Returns
        -------
        (m, 2) int array
            Sorted, i < j.

        References
        ----------
        Attali and Montanvert, 1997, appendix A.2; the correction is derived in the book's chapter A.2.

        Examples
        --------
        >>> Polyball([(0, 0, 0), (0.5, 0, 0), (1, 0, 0)], [1, 1, 1]).exposed_pairs().tolist()
        [[0, 1], [1, 2]]
        """
        in_space = self.dimension == 3
        return self._sorted_pairs(self._boundary.circles.pairs if in_space else self._crossing_discs())

    def generating(self) -> np.ndarray:
        """Indices of balls that generate the polyball, none of which can be left out (definition 1).

        Definition 1 asks for the fewest balls. Balls with a piece of the boundary are always needed. Where
        only hidden balls can fill a hole, finding the fewest is a covering problem; then this is *a*
        writing from which no ball can be dropped (smallest balls are dropped first), and it is not unique.

        Returns
        -------
        (g,) int array
            Sorted.

        References
        ----------
        Attali and Montanvert, 1997, appendix A, definition 1.

        Examples
        --------
        The fourth disc fills the gap between the others, the fifth is in the first:

        >>> centers = [(1.1, 0), (-0.55, 0.9526), (-0.55, -0.9526), (0, 0.05), (1, 0)]
        >>> Y = Polyball(centers, [1, 1, 1, 0.3, 0.5])
        >>> Y.generating().tolist(), Y.exposed().tolist()
        ([0, 1, 2, 3], [True, True, True, False, False])
        """
        hidden = np.ones(len(self._rows), dtype=bool)
        hidden[self._power.faces(1)] = False
        return self._rows[needed(*self._balls, self._exposed, hidden, _room_in)]

    def minimal(self) -> Polyball:
        """Drop the balls that are not needed: see `generating`.

        Examples
        --------
        >>> len(Polyball([(0, 0, 0), (0.5, 0, 0), (1, 0, 0)], [1, 0.8, 1]).minimal())
        2
        """
        rows = self.generating()
        return Polyball(self.centers[rows], self.radii[rows])

    def disconnected(self) -> np.ndarray:
        """Indices of the generating balls that meet no other one (definition 2).

        Returns
        -------
        (d,) int array

        References
        ----------
        Attali and Montanvert, 1997, appendix A, definition 2.

        Examples
        --------
        >>> Polyball([(0, 0), (1, 0), (5, 0), (5, 0)], [1, 1, 1, 0.5]).disconnected().tolist()
        [2]
        """
        rows = self.generating()
        return rows[lonely(self.centers[rows], self.radii[rows])]

    def quasi_disconnected(self) -> np.ndarray:
        """Pairs of generating balls whose common part meets no third one (definition 3, as printed).

        Returns
        -------
        (q, 2) int array
            Sorted, i < j.

        References
        ----------
        Attali and Montanvert, 1997, appendix A, definition 3.

        Examples
        --------
        In a row of unit balls at distance 1 every common part meets a third ball:

        >>> Polyball([(0, 0, 0), (1.5, 0, 0), (3, 0, 0)], [1, 1, 1]).quasi_disconnected().tolist()
        [[0, 1], [1, 2]]
        >>> Polyball([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [1, 1, 1]).quasi_disconnected().tolist()
        []
        """
        rows = self.generating()
        centers, radii = self._balls
        # A third ball on the circle is a third ball in the common part: only bare circles are candidates.
        pairs = self._bridges if self.dimension == 3 else self._crossing_discs(bare=True)
        pairs = pairs[np.isin(self._rows[pairs], rows).all(axis=1)]
        number = np.full(len(self), -1)
        number[rows] = np.arange(len(rows))
        among = number[self._rows[pairs]].reshape(-1, 2)
        alone = isolated_lenses(
            self.centers[rows] - self._origin, self.radii[rows], among, *crossings(centers, radii, pairs)
        )
        return self._sorted_pairs(pairs[alone])

    def skeleton(self, statement: str = "corrected") -> Skeleton:
        """Build the exact skeleton: the centres of all maximal balls (appendix A.2, theorems 3 and 4).

        Theorem 3 needs one reading in the plane ("at least one" nearest boundary point is singular).
        Theorem 4 is false as printed: it joins only quasi-disconnected balls. The corrected statement joins
        the centres of every two balls whose circle has an arc on the boundary.

        Parameters
        ----------
        statement : "corrected" or "as printed"

        Returns
        -------
        Skeleton
            Vertices with the radii of their maximal balls, edges and, in space, convex polygons.

        Raises
        ------
        TangentBallsError
            If two balls touch from outside in a point of the boundary; ``.pairs`` lists them.
        InputError
            If the statement is unknown.
        TessellationError
            If so many balls nearly coincide that rounding hides the boundary, or singular points crowd
            together, millions of times closer than the balls are large.

        Notes
        -----
        Singular points are known to rounding. A ball counts as passing through one that it misses by less
        than 1e-9 of its radius, and Voronoi vertices closer than 1e-9 of their radius are one.

        References
        ----------
        Attali and Montanvert, 1997, appendix A; Amenta and Kolluri, The medial axis of a union of balls,
        2001.

        Examples
        --------
        >>> row = Polyball([(0, 0, 0), (0.5, 0, 0), (1, 0, 0)], [1, 1, 1])
        >>> row.skeleton().edges.tolist(), len(row.skeleton("as printed").vertices)
        ([[0, 1], [1, 2]], 0)
        """
        if statement not in ("corrected", "as printed"):
            raise InputError(f"unknown statement {statement!r}; choose corrected or as printed.")
        if len(self._boundary.touching):
            pairs = self._sorted_pairs(self._boundary.touching)
            i, j = pairs[0]
            raise TangentBallsError(
                f"balls {i} and {j} touch without crossing, which appendix A leaves out: the skeleton of the "
                "union would be cut there; enlarge or shrink one of them a little.",
                pairs,
            )
        if self.dimension == 3 and not self._boundary.sound:
            raise TessellationError(
                "too many of these balls nearly coincide, as around samples that lie on one sphere, and "
                "rounding hides which of them are on the boundary; leave out balls that are almost equal."
            )
        alone, bridges = self._exposed, self._bridges
        if statement == "as printed":
            alone = np.isin(self._rows, self.disconnected())
            number = np.full(len(self), -1)
            number[self._rows] = np.arange(len(self._rows))
            bridges = number[self.quasi_disconnected()].reshape(-1, 2)
            if self.dimension == 2:
                bridges = bridges[:0]
        features = Boundary(self._boundary.corners, self._exposed, alone, bridges)
        return ball_skeleton(*self._balls, features, self._origin)

    def boundary_distance(self, queries) -> np.ndarray:
        """Measure the distance from points to the boundary of the polyball.

        Parameters
        ----------
        queries : (k, N) array-like
            Points inside or outside.

        Returns
        -------
        (k,) float array
            Never negative, in the unit of the coordinates.

        Raises
        ------
        InputError
            If `queries` is not a finite (k, N) array.

        Examples
        --------
        >>> Polyball([(0, 0)], [2]).boundary_distance([(0, 0), (1, 0), (0, 5)])
        array([2., 1., 3.])
        """
        queries = as_points(queries, name="queries", dimensions=(self.dimension,)) - self._origin
        if self.dimension == 3:
            return distance_to_boundary(queries, *self._balls, self._power, self._boundary)
        return distance_to_arcs(queries, *self._balls, self._boundary.arcs)

    def area(self) -> float:
        """Compute the area of a planar polyball, or of the surface of one in space.

        In the plane by Green's theorem on the arcs; in space see `polyskel_lite.polyballs.volumes`.

        Returns
        -------
        float
            In squared units of the coordinates.

        Examples
        --------
        >>> round(Polyball([(0, 0), (5, 0), (5, 0)], [1, 1, 0.5]).area() / np.pi, 12)
        2.0
        >>> round(Polyball([(0, 0, 0)], [2]).area() / np.pi, 12)
        16.0
        """
        if self.dimension == 3:
            return surface_area(*self._balls, self._power, self._boundary)
        centers, radii = self._balls
        ball, start, end = self._boundary.arcs
        radius = radii[ball]
        x, y = centers[ball].T
        swing = x * (np.sin(end) - np.sin(start)) - y * (np.cos(end) - np.cos(start))
        return float(np.sum(radius * (radius * (end - start) + swing)) / 2)

    def volume(self) -> float:
        """Compute the volume of a polyball in space, in closed form (see `polyskel_lite.polyballs.volumes`).

        Returns
        -------
        float
            In cubed units of the coordinates.

        Raises
        ------
        InputError
            If the balls are discs of the plane.

        Examples
        --------
        >>> round(Polyball([(0, 0, 0), (9, 0, 0)], [3, 3]).volume() / np.pi, 9)
        72.0
        """
        self._only(3, "volume", "area")
        return volume(*self._balls, self._power, self._boundary)

    def patches(self, fineness: float = 0.03) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Triangulate the boundary of a polyball in space, well enough to draw it.

        Parameters
        ----------
        fineness : float
            Length of the edges, as a share of the longest side of the box around the polyball.

        Returns
        -------
        vertices : (v, 3) float array
        triangles : (t, 3) int array
            Facing outward.
        ball : (t,) int array
            The ball on whose sphere each triangle is.

        Raises
        ------
        InputError
            If the balls are discs of the plane.

        Examples
        --------
        >>> vertices, triangles, ball = Polyball([(0, 0, 0), (1, 0, 0)], [1, 1]).patches()
        >>> vertices.shape[1], triangles.shape[1], np.unique(ball).tolist()
        (3, 3, [0, 1])
        """
        self._only(3, "patches", "arcs")
        vertices, triangles, ball = patches(*self._balls, self._power, self._boundary, fineness)
        return vertices + self._origin, triangles, self._rows[ball]

    def boundary(self):
        """The boundary in pieces of spheres: `arcs` in the plane, `patches` in space.

        Examples
        --------
        >>> Polyball([(0, 0)], [1]).boundary().ball.tolist()
        [0]
        """
        return self.arcs() if self.dimension == 2 else self.patches()

    @cached_property
    def _rows(self) -> np.ndarray:
        """The balls that are not copies of others; everything below counts only these."""
        return distinct(self.centers, self.radii)

    @cached_property
    def _origin(self) -> np.ndarray:
        """The middle: everything is computed as seen from it, so that far polyballs lose no digits."""
        return (self.centers.min(axis=0) + self.centers.max(axis=0)) / 2

    @cached_property
    def _balls(self) -> tuple[np.ndarray, np.ndarray]:
        return self.centers[self._rows] - self._origin, self.radii[self._rows]

    @cached_property
    def _power(self) -> PowerTriangulation:
        return power_triangulation(*self._balls) if self.dimension == 2 else self._in_space[0]

    @cached_property
    def _in_space(self) -> tuple[PowerTriangulation, SphereBoundary]:
        centers, radii = self.centers[self._rows], self.radii[self._rows]
        return verified_boundary(centers, radii, power_triangulation(*self._balls))

    @cached_property
    def _boundary(self) -> DiscBoundary | SphereBoundary:
        # Found where the balls stand, because their rounding there says how far crossings are believed.
        centers, radii = self.centers[self._rows], self.radii[self._rows]
        if self.dimension == 2:
            crowded = pair_bound(centers, radii) > _PAIRS
            found = disc_boundary(centers, radii, self._power if crowded else None)
        else:
            found = self._in_space[1]
            circles = found.circles._replace(centers=found.circles.centers - self._origin)
            found = found._replace(circles=circles)
        return found._replace(corners=found.corners - self._origin)

    @cached_property
    def _exposed(self) -> np.ndarray:
        if self.dimension == 3:
            return self._boundary.exposed
        exposed = np.zeros(len(self._rows), dtype=bool)
        exposed[self._boundary.arcs.ball] = True
        return exposed

    @cached_property
    def _generating(self) -> np.ndarray:
        hidden = np.ones(len(self._rows), dtype=bool)
        hidden[self._power.faces(1)] = False
        rows = needed(*self._balls, self._exposed, hidden, lambda c, r: Polyball(c, r).singular_points())
        return self._rows[rows]

    @cached_property
    def _bridges(self) -> np.ndarray:
        """In space the pairs whose circle is on the boundary as a whole."""
        if self.dimension == 2:
            return np.zeros((0, 2), dtype=np.int64)
        circles, arcs = self._boundary.circles, self._boundary.arcs
        whole = np.zeros(len(circles.pairs), dtype=bool)
        whole[arcs.ball[arcs.end - arcs.start >= TURN]] = True
        return circles.pairs[whole]

    def _crossing_discs(self, bare: bool = False) -> np.ndarray:
        """In the plane the pairs whose circles cross on the boundary; once, or (bare) twice."""
        corners = self._boundary.corners
        if not len(corners):
            return np.zeros((0, 2), dtype=np.int64)
        pairs, times = np.unique(
            Incidence(corners, *self._balls, self._origin).pairs(), axis=0, return_counts=True
        )
        return pairs[times >= 2] if bare else pairs

    def _sorted_pairs(self, pairs: np.ndarray) -> np.ndarray:
        pairs = np.sort(self._rows[pairs], axis=1).reshape(-1, 2)
        return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]

    def _only(self, dimension: int, method: str, instead: str) -> None:
        if self.dimension != dimension:
            where = "discs of the plane" if dimension == 2 else "balls in space"
            raise InputError(
                f"Polyball.{method}() is for {where}, and these balls have {self.dimension} coordinates; "
                f"use {instead}()."
            )


Skeleton._polyball = Polyball


def _room_in(centers, radii, point) -> float:
    """Radius of the largest ball around a point in a union of balls, negative if the point is not in it."""
    Y = Polyball(centers, radii)
    return float(Y.boundary_distance([point])[0]) if Y.contains([point])[0] else -1.0
