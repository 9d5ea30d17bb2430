"""Unions of balls (the paper's appendix A): membership, boundary, singular points.

The paper reads Sk2 as the skeleton of a *polyball* Y_w, the union of the Delaunay balls whose centres
lie in the shape (section 3.2). This module describes polyballs themselves; the circles and arcs of
the planar ones are computed in `polyskel_lite.discs`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .discs import Arcs, Boundary, boundary, distance_to_arcs
from .errors import InputError
from .predicates import as_points

_CHUNK = 2_000_000  # point-ball pairs looked at together: bounds the memory, not the result


@dataclass(frozen=True, eq=False)
class Polyball:
    """A finite union of closed balls in the plane or in space (section 3.2, appendix A).

    Membership is for the plane and for space; arcs, singular points, boundary distance and area are
    for the plane.

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
    So a disc is believed to 1e-12 of its radius (plus the rounding of its coordinates), the error
    of a crossing of two circles follows from the angle between them, never more than 1e-6 of the
    smaller radius, and crossings that agree within their errors count as one. A disc that leaves
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
        radii = _as_radii(self.radii, len(centers))
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
        inside = np.zeros(len(queries), dtype=bool)
        # Large balls first: they settle most points, and only the others are asked again.
        order = np.argsort(-self.radii, kind="stable")
        step = max(1, _CHUNK // max(1, len(queries)))
        for first in range(0, len(order), step):
            balls, left = order[first : first + step], np.flatnonzero(~inside)
            square = sum(
                np.square(queries[left, None, axis] - self.centers[balls, axis])
                for axis in range(self.dimension)
            )
            inside[left] = (square <= np.square(self.radii[balls])).any(axis=1)
        return inside

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
        return self._planar("arcs").arcs

    def singular_points(self) -> np.ndarray:
        """Find the points of the boundary that lie on two or more circles (definition 4, in the plane).

        Where two discs touch from outside, the touching point is one of them; appendix A leaves
        such polyballs out.

        Returns
        -------
        (s, 2) float array
            In no particular order.

        Raises
        ------
        InputError
            If the balls are not discs of the plane.

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
        return self._planar("singular_points").corners

    def boundary_distance(self, queries) -> np.ndarray:
        """Measure the distance from points to the boundary of a planar polyball.

        Parameters
        ----------
        queries : (k, 2) array-like
            Points inside or outside.

        Returns
        -------
        (k,) float array
            Distance to the nearest arc, never negative, in the unit of the coordinates.

        Raises
        ------
        InputError
            If the balls are not discs of the plane, or `queries` is not a finite (k, 2) array.

        Examples
        --------
        >>> Polyball([(0, 0)], [2]).boundary_distance([(0, 0), (1, 0), (0, 5)])
        array([2., 1., 3.])
        """
        arcs = self._planar("boundary_distance").arcs
        queries = as_points(queries, name="queries", dimensions=(2,))
        return distance_to_arcs(queries, self.centers, self.radii, arcs)

    def area(self) -> float:
        """Compute the area of a planar polyball by Green's theorem on its arcs.

        Returns
        -------
        float
            In squared units of the coordinates.

        Raises
        ------
        InputError
            If the balls are not discs of the plane.

        Examples
        --------
        >>> round(Polyball([(0, 0), (5, 0), (5, 0)], [1, 1, 0.5]).area() / np.pi, 12)
        2.0
        """
        ball, start, end = self._planar("area").arcs
        radius = self.radii[ball]
        # Seen from the middle of the discs, so that polyballs far from the origin lose no digits.
        x, y = (self.centers[ball] - self.centers.mean(axis=0)).T
        swing = x * (np.sin(end) - np.sin(start)) - y * (np.cos(end) - np.cos(start))
        return float(np.sum(radius * (radius * (end - start) + swing)) / 2)

    @cached_property
    def _boundary(self) -> Boundary:
        return boundary(self.centers, self.radii)

    def _planar(self, method: str) -> Boundary:
        if self.dimension != 2:
            raise InputError(
                f"Polyball.{method}() is for discs of the plane, and these balls have {self.dimension} "
                "coordinates; this version answers only `contains` for them."
            )
        return self._boundary


def _as_radii(radii, count: int) -> np.ndarray:
    try:
        array = np.array(radii, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"radii is not an array of numbers ({error}); pass a (k,) array.") from None
    if array.shape != (count,):
        raise InputError(f"radii has shape {array.shape} for {count} centers; pass a ({count},) array.")
    bad = np.flatnonzero(~(np.isfinite(array) & (array > 0)))
    if len(bad):
        raise InputError(
            f"radii[{bad[0]}] is {array[bad[0]]:g}; radii are positive and finite: leave this ball out."
        )
    return array
