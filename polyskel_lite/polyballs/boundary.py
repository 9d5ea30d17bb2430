"""The boundary of a union of balls: its pieces, where they meet, its distance, and what it encloses."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..checks import as_points
from ..errors import InputError
from ..shapes import only_in
from ..tables import Described
from .discs import Arcs
from .distance import distance_to_boundary
from .sphere_patches import patches
from .union import BallUnion
from .volumes import surface_area, volume

# From so many units of length away the whole union is one point.
_FAR = 1e100


class BallBoundary(Described):
    """A union of balls as what is on its boundary and can be measured there; `Polyball` checks the balls.

    Attributes
    ----------
    centers : (k, N) float array
    radii : (k,) float array

    Examples
    --------
    >>> from polyskel_lite import Polyball
    >>> isinstance(Polyball([(0, 0)], [1]), BallBoundary)
    True
    """

    centers: NDArray[np.float64]
    radii: NDArray[np.float64]

    @property
    def dimension(self) -> int:
        """N, the dimension of the space."""
        return self.centers.shape[1]

    @cached_property
    def union(self) -> BallUnion:
        """What the other modules compute with: the balls without copies, and all that is found only once.

        Its unit of length is a power of two near the largest number (see `in_unit`), so that no square is too
        large or too small for floating-point numbers, and no digit is lost.

        Examples
        --------
        >>> from polyskel_lite import Polyball
        >>> Polyball([(0, 0), (0, 0)], [1, 1]).union.rows.tolist()
        [0]
        """
        return BallUnion(self.in_unit(self.centers), self.in_unit(self.radii))

    @cached_property
    def _exponent(self) -> int:
        return int(np.frexp(max(np.abs(self.centers).max(), self.radii.max()))[1])

    def in_unit(self, lengths: ArrayLike) -> np.ndarray:
        """Lengths and places in the unit of length of `union`.

        Examples
        --------
        >>> from polyskel_lite import Polyball
        >>> Polyball([(0, 0)], [2.0**900]).in_unit(np.array([2.0**900])).tolist()
        [0.5]
        """
        with np.errstate(over="ignore"):  # places this far away are far away
            return np.ldexp(lengths, -self._exponent)

    def from_unit(self, lengths: ArrayLike) -> np.ndarray:
        """Lengths and places of `union` in the unit of the coordinates.

        Examples
        --------
        >>> from polyskel_lite import Polyball
        >>> Polyball([(0, 0)], [2.0**900]).from_unit(np.array([0.5])).tolist() == [2.0**900]
        True
        """
        return np.ldexp(lengths, self._exponent)

    def _measure(self, value: float, power: int, name: str) -> float:
        """An area or volume in the unit of the coordinates."""
        with np.errstate(over="ignore"):
            found = float(np.ldexp(value, power * self._exponent))
        if value and not np.finfo(float).tiny <= abs(found) < np.inf:
            raise InputError(
                f"the {name} of these balls, {value:.6g} times 2**{power * self._exponent}, is beyond the "
                f"range of floating-point numbers; scale them by 2.0**{-self._exponent} first."
            )
        return found

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
        >>> from polyskel_lite import Polyball
        >>> ball, start, end = Polyball([(0, 0), (1, 0), (0.1, 0)], [1, 1, 0.2]).arcs()
        >>> ball, np.degrees(start).round(), np.degrees(end).round()
        (array([0, 1]), array([  60., -120.]), array([300., 120.]))
        """
        only_in(2, self, "arcs", "patches()", "polyballs")
        ball, start, end = self.union.boundary.arcs
        return Arcs(self.union.rows[ball], start, end)

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
        >>> from polyskel_lite import Polyball
        >>> vertices, triangles, ball = Polyball([(0, 0, 0), (1, 0, 0)], [1, 1]).patches()
        >>> vertices.shape[1], triangles.shape[1], np.unique(ball).tolist()
        (3, 3, [0, 1])
        """
        only_in(3, self, "patches", "arcs()", "polyballs")
        vertices, triangles, ball = patches(self.union, fineness)
        return self.from_unit(vertices + self.union.origin), triangles, self.union.rows[ball]

    def boundary(self) -> Any:
        """The boundary in pieces of spheres: `arcs` in the plane, `patches` in space.

        Examples
        --------
        >>> from polyskel_lite import Polyball
        >>> Polyball([(0, 0)], [1]).boundary().ball.tolist()
        [0]
        """
        return self.arcs() if self.dimension == 2 else self.patches()

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

        >>> from polyskel_lite import Polyball
        >>> Y = Polyball([(0, 0), (2, 0), (1, 0)], [5**0.5, 5**0.5, 2])
        >>> sorted(Y.singular_points().round(9).tolist())
        [[1.0, -2.0], [1.0, 2.0]]
        """
        return self.from_unit(self.union.boundary.corners + self.union.origin)

    def exposed(self) -> np.ndarray:
        """Tell which balls have a piece of their own sphere on the boundary.

        Returns
        -------
        (k,) bool array
            Of equal balls only the first one.

        Examples
        --------
        >>> from polyskel_lite import Polyball
        >>> Polyball([(0, 0), (1, 0), (0.5, 0)], [1, 1, 0.5]).exposed().tolist()
        [True, True, False]
        """
        return np.isin(np.arange(len(self.radii)), self.union.rows[self.union.exposed])

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
        >>> from polyskel_lite import Polyball
        >>> Polyball([(0, 0, 0), (0.5, 0, 0), (1, 0, 0)], [1, 1, 1]).exposed_pairs().tolist()
        [[0, 1], [1, 2]]
        """
        return self.union.as_given(self.union.crossing())

    def touching(self) -> np.ndarray:
        """List the pairs of balls that touch from outside in a point of the boundary.

        Appendix A leaves such polyballs out. A point that other balls cover all around does not count.

        Returns
        -------
        (q, 2) int array
            Sorted, i < j.

        References
        ----------
        Attali and Montanvert, 1997, appendix A.2.

        Examples
        --------
        >>> from polyskel_lite import Polyball
        >>> discs = [(-1, 0), (1, 0), (0, 0)]
        >>> Polyball(discs[:2], [1, 1]).touching().tolist(), len(Polyball(discs, [1, 1, 0.5]).touching())
        ([[0, 1]], 0)
        """
        return self.union.as_given(self.union.boundary.touching)

    def boundary_distance(self, queries: ArrayLike) -> NDArray[np.float64]:
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
        >>> from polyskel_lite import Polyball
        >>> Polyball([(0, 0)], [2]).boundary_distance([(0, 0), (1, 0), (0, 5)])
        array([2., 1., 3.])
        """
        union = self.union
        queries = as_points(queries, name="queries", dimensions=(self.dimension,))
        places = self.in_unit(queries) - union.origin
        near = np.abs(places).max(axis=1, initial=0) < _FAR
        distance = np.hypot.reduce(queries, axis=1)
        distance[near] = self.from_unit(distance_to_boundary(places[near], union))
        return distance

    def area(self) -> float:
        """Compute the area of a planar polyball, or of the surface of one in space.

        In the plane by Green's theorem on the arcs; in space see `polyskel_lite.polyballs.volumes`.

        Returns
        -------
        float
            In squared units of the coordinates.

        Examples
        --------
        >>> from polyskel_lite import Polyball
        >>> round(Polyball([(0, 0), (5, 0), (5, 0)], [1, 1, 0.5]).area() / np.pi, 12)
        2.0
        >>> round(Polyball([(0, 0, 0)], [2]).area() / np.pi, 12)
        16.0
        """
        if self.union.in_space:
            return self._measure(surface_area(self.union), 2, "area")
        ball, start, end = self.union.boundary.arcs
        radius = self.union.radii[ball]
        x, y = self.union.centers[ball].T
        swing = x * (np.sin(end) - np.sin(start)) - y * (np.cos(end) - np.cos(start))
        area = float(np.sum(radius * (radius * (end - start) + swing)) / 2)
        return self._measure(area, 2, "area")

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
        >>> from polyskel_lite import Polyball
        >>> round(Polyball([(0, 0, 0), (9, 0, 0)], [3, 3]).volume() / np.pi, 9)
        72.0
        """
        only_in(3, self, "volume", "area()", "polyballs")
        return self._measure(volume(self.union), 3, "volume")
