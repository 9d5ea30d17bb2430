"""Unions of balls (the paper's appendix A): boundary, singular points, generating balls, exact skeleton.

The paper reads Sk2 as the skeleton of a *polyball* Y_w, the union of the Delaunay balls whose centres
lie in the shape (section 3.2). What is on its boundary is in `boundary`, computed once for each polyball
(`union`), and the skeleton is put together in `skeleton`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..checks import as_choice, as_points, as_radii
from ..errors import InputError, TangentBallsError
from ..skeletons import Skeleton
from ..tables import bounds_and_betti
from .boundary import BallBoundary
from .generating import isolated_lenses, lonely, needed
from .pairs import in_any
from .skeleton import ball_skeleton, verified_skeleton


@dataclass(frozen=True, eq=False, repr=False)
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

    centers: NDArray[np.float64]
    radii: NDArray[np.float64]

    if TYPE_CHECKING:  # what is given may be any array-like, what is kept is an array

        def __init__(self, centers: ArrayLike, radii: ArrayLike) -> None: ...

    def _facts(self) -> Iterator[tuple[str, object]]:
        # Betti numbers, those of its skeleton, take longer than a repr should.
        yield "balls", len(self.radii)
        ends = np.concatenate([self.centers - self.radii[:, None], self.centers + self.radii[:, None]])
        yield next(bounds_and_betti(ends, tuple))

    def __post_init__(self):
        centers = as_points(self.centers, name="centers")
        if not len(centers):
            raise InputError("centers is empty; a polyball needs at least one ball.")
        radii = as_radii(self.radii, len(centers))
        for name, array in (("centers", centers), ("radii", radii)):
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    def __len__(self) -> int:
        """The number of balls."""
        return len(self.radii)

    def contains(self, queries: ArrayLike) -> NDArray[np.bool_]:
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
        return in_any(self.in_unit(queries), self.in_unit(self.centers), self.in_unit(self.radii))

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
        return self.union.rows[self._needed]

    @cached_property
    def _needed(self) -> np.ndarray:
        """The generating balls by their numbers in the union."""
        union = self.union
        hidden = ~np.isin(np.arange(len(union.rows)), union.power.faces(1))
        return needed(union.centers, union.radii, union.exposed, hidden, _room_in)

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
        union, rows = self.union, self._needed
        return union.rows[rows[lonely(union.centers[rows], union.radii[rows])]]

    def quasi_disconnected(self) -> np.ndarray:
        """Pairs of generating balls whose common part meets no third one (definition 3, read for the lens).

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
        union, rows = self.union, self._needed
        # A third ball on the circle is a third ball in the common part: only bare circles are candidates.
        pairs = union.crossing(bare=True)
        pairs = pairs[np.isin(pairs, rows).all(axis=1)]
        alone = isolated_lenses(union.centers[rows], union.radii[rows], np.searchsorted(rows, pairs))
        return union.as_given(pairs[alone])

    def skeleton(self, statement: str = "corrected") -> Skeleton:
        """Build the exact skeleton: the centres of all maximal balls (appendix A.2, theorems 3 and 4).

        Theorem 3 needs one reading in the plane ("at least one" nearest boundary point is singular).
        Theorem 4 joins the centres of quasi-disconnected balls. It holds if that is read for the circle in
        which two spheres meet; read for their lens, as a transcript has it, balls that overlap well have no
        skeleton. The statement used here needs no such word: it joins every two balls whose circle has an arc
        on the boundary.

        Parameters
        ----------
        statement : "corrected" or "transcript"
            "transcript" reads Definition 3 for the lens.

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
        than 1e-9 of its radius, and Voronoi vertices closer than 1e-9 of their radius are one. The corrected
        skeleton has the Betti numbers of the dual shape of the balls. Where it takes that, balls that differ
        by less than 1e-8 (1e-7, 1e-6, 1e-5 if need be) of their radius are taken as one.

        References
        ----------
        Attali and Montanvert, 1997, appendix A; Amenta and Kolluri, The medial axis of a union of balls,
        2001.

        Examples
        --------
        >>> row = Polyball([(0, 0, 0), (0.5, 0, 0), (1, 0, 0)], [1, 1, 1])
        >>> row.skeleton().edges.tolist(), len(row.skeleton("transcript").vertices)
        ([[0, 1], [1, 2]], 0)
        """
        as_choice(statement, "statement", ("corrected", "transcript"))
        pairs = self.touching()
        if len(pairs):
            i, j = pairs[0]
            raise TangentBallsError(
                f"balls {i} and {j} touch without crossing, which appendix A leaves out: the skeleton of the "
                "union would be cut there; enlarge or shrink one of them a little.",
                pairs,
            )
        skeleton = verified_skeleton(self.union) if statement == "corrected" else self._by_lenses()
        places, sizes = self.from_unit(skeleton.vertices), self.from_unit(skeleton.radii)
        return replace(skeleton, vertices=places, radii=sizes)

    def _by_lenses(self) -> Skeleton:
        """The skeleton by theorems 3 and 4, definition 3 read for lenses, in the unit of the union."""
        union = self.union
        alone, bridges = np.isin(union.rows, self.disconnected()), np.zeros((0, 2), dtype=np.int64)
        if union.in_space:
            bridges = np.searchsorted(union.rows, self.quasi_disconnected())
        return ball_skeleton(union, alone, bridges)


Skeleton._polyball = Polyball


def _room_in(centers, radii, point) -> float:
    """Radius of the largest ball around a point in a union of balls, negative if the point is not in it."""
    Y = Polyball(centers, radii)
    return float(Y.boundary_distance([point])[0]) if Y.contains([point])[0] else -1.0
