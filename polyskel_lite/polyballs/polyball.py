"""Unions of balls (the paper's appendix A): boundary, singular points, generating balls, exact skeleton.

The paper reads Sk2 as the skeleton of a *polyball* Y_w, the union of the Delaunay balls whose centres
lie in the shape (section 3.2). What is on its boundary is in `boundary`, computed once for each polyball
(`union`), and the skeleton is put together in `skeleton`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..checks import as_choice, as_points, as_radii, check_squares
from ..errors import InputError, TangentBallsError, TessellationError
from ..skeletons import Skeleton
from .boundary import BallBoundary
from .generating import isolated_lenses, lonely, needed
from .pairs import in_any
from .skeleton import ball_skeleton


@dataclass(frozen=True, eq=False)
class Polyball(BallBoundary):
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
        check_squares(centers, radii)
        centers.setflags(write=False)
        radii.setflags(write=False)
        object.__setattr__(self, "centers", centers)
        object.__setattr__(self, "radii", radii)

    def __len__(self) -> int:
        """The number of balls."""
        return len(self.radii)

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
        check_squares(queries)
        return in_any(queries, self.centers, self.radii)

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
        union = self.union
        hidden = ~np.isin(np.arange(len(union.rows)), union.power.faces(1))
        return union.rows[needed(union.centers, union.radii, union.exposed, hidden, _room_in)]

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
        # A third ball on the circle is a third ball in the common part: only bare circles are candidates.
        pairs = self.union.as_given(self.union.crossing(bare=True))
        pairs = pairs[np.isin(pairs, rows).all(axis=1)]
        among = np.searchsorted(rows, pairs)
        return pairs[isolated_lenses(self.centers[rows] - self.union.origin, self.radii[rows], among)]

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
        as_choice(statement, "statement", ("corrected", "as printed"))
        union = self.union
        if len(union.boundary.touching):
            pairs = union.as_given(union.boundary.touching)
            i, j = pairs[0]
            raise TangentBallsError(
                f"balls {i} and {j} touch without crossing, which appendix A leaves out: the skeleton of the "
                "union would be cut there; enlarge or shrink one of them a little.",
                pairs,
            )
        if union.in_space and not union.boundary.sound:
            raise TessellationError(
                "too many of these balls nearly coincide, as around samples that lie on one sphere, and "
                "rounding hides which of them are on the boundary; leave out balls that are almost equal."
            )
        printed = statement == "as printed"
        alone = np.isin(union.rows, self.disconnected()) if printed else union.exposed
        bridges = np.zeros((0, 2), dtype=np.int64)
        if union.in_space:
            given = self.quasi_disconnected() if printed else union.as_given(union.crossing(bare=True))
            bridges = np.searchsorted(union.rows, given)
        return ball_skeleton(union, alone, bridges)


Skeleton._polyball = Polyball


def _room_in(centers, radii, point) -> float:
    """Radius of the largest ball around a point in a union of balls, negative if the point is not in it."""
    Y = Polyball(centers, radii)
    return float(Y.boundary_distance([point])[0]) if Y.contains([point])[0] else -1.0
