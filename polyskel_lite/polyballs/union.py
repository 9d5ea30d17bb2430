"""What is known about a union of balls: its power diagram and what is on its boundary, each found once.

Some balls are copies of others, and squaring coordinates far from 0 loses digits. So whatever measures, draws
or skeletonizes a union of balls starts from a `BallUnion`, which leaves out copies and moves the middle to 0.
"""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np

from .discs import Boundary, disc_boundary
from .generating import alike, distinct
from .incidence import Incidence
from .pairs import circle_offset, lengths, pair_bound, relations
from .power import PowerTriangulation, homotopy, power_triangulation
from .spheres import verified_boundary

# Where more pairs of discs than this may meet, only those in the power diagram are looked at: less sure if
# discs nearly coincide, but 10,000 discs on one another would have 50 million pairs.
_PAIRS = 10_000_000


class Caps(NamedTuple):
    """Caps of all spheres, sphere by sphere, the largest one first.

    Attributes
    ----------
    first : (k + 1,) int array
        Rows ``first[i]`` to ``first[i + 1]`` are the caps of sphere i.
    axes : (m, 3) float array
        Unit vectors to the middles of the caps.
    heights : (m,) float array
        p is in the cap if (p - c) · axis > height · radius.
    ball : (m,) int array
        The sphere of each cap.
    """

    first: np.ndarray
    axes: np.ndarray
    heights: np.ndarray
    ball: np.ndarray


class BallUnion:
    """Different balls of the plane or of space, seen from their middle, and the boundary of their union.

    Parameters
    ----------
    centers : (n, N) float array
        Where the balls stand, in any unit of length, which is then that of everything below.
    radii : (n,) float array
        Positive.

    Attributes
    ----------
    rows : (k,) int array
        The balls that are not copies of ones before them, sorted; only these count from here on.
    origin : (N,) float array
        The middle of the balls, which is taken off all coordinates.
    centers : (k, N) float array
    radii : (k,) float array

    Examples
    --------
    >>> twice = BallUnion(np.array([(4.0, 0, 0), (5, 0, 0), (4, 0, 0)]), np.ones(3))
    >>> twice.rows.tolist(), twice.origin.tolist(), twice.centers[:, 0].tolist()
    ([0, 1], [4.5, 0.0, 0.0], [-0.5, 0.5])
    """

    def __init__(self, centers: np.ndarray, radii: np.ndarray):
        self.rows = distinct(centers, radii)
        self.origin = (centers.min(axis=0) + centers.max(axis=0)) / 2
        self.radii = radii[self.rows]
        self._places = centers[self.rows]
        self.centers = self._places - self.origin

    @property
    def in_space(self) -> bool:
        """Whether these are balls in space, not discs."""
        return len(self.origin) == 3

    @property
    def power(self) -> PowerTriangulation:
        """The dual of the power diagram."""
        return self._verified[0] if self.in_space else self._triangulated

    @cached_property
    def boundary(self) -> Boundary:
        """Arcs and corners of the boundary."""
        # Found where the balls stand, because their rounding there says how far crossings are believed.
        if self.in_space:
            found = self._verified[1]
        else:
            crowded = pair_bound(self._places, self.radii) > _PAIRS
            found = disc_boundary(self._places, self.radii, self.power if crowded else None)
        circles = found.circles._replace(centers=found.circles.centers - self.origin)
        return found._replace(circles=circles, corners=found.corners - self.origin)

    @property
    def exposed(self) -> np.ndarray:
        """Which balls have a piece of their sphere on the boundary, (k,) bool array."""
        return self.boundary.exposed

    @cached_property
    def caps(self) -> Caps:
        """The part of each sphere that other balls cover: a cap for each ball whose sphere crosses it.

        A point of a sphere is on the boundary iff it is in no cap. Only power neighbours are asked, because
        what is left of a sphere is the part in its own power cell. Balls that touch, and balls that stick out
        of another one by nothing but rounding, make no cap; the arcs of the boundary ignore them as well.

        Examples
        --------
        >>> found = BallUnion(np.array([(0.0, 0, 0), (1, 0, 0)]), np.ones(2)).caps
        >>> found.first.tolist(), found.heights.tolist()
        ([0, 1, 2], [0.5, 0.5])
        """
        crossing = relations(self.centers, self.radii, *self.power.faces(2).T)[1]
        i, j = np.concatenate([crossing, crossing[:, ::-1]]).T
        across = self.centers[j] - self.centers[i]
        d = lengths(across)
        heights = circle_offset(d, self.radii[i], self.radii[j]) / self.radii[i]
        order = np.lexsort((heights, i))
        first = np.searchsorted(i[order], np.arange(len(self.radii) + 1))
        return Caps(first, (across / d[:, None])[order], heights[order], i[order])

    @property
    def sound(self) -> bool:
        """Whether the arcs of the boundary close up and no two balls touch on it."""
        return self.boundary.sound and not len(self.boundary.touching)

    def alike(self, share: float) -> BallUnion:
        """Nearly the same union, with one ball for all that differ by less than a share of their radius.

        Examples
        --------
        >>> len(BallUnion(np.array([(0.0, 0), (1e-7, 0)]), np.ones(2)).alike(1e-6).radii)
        1
        """
        rows, radii = alike(self.centers, self.radii, share)
        return BallUnion(self._places[rows], radii)

    def homotopy(self, *slack: float) -> list[tuple[int, ...]]:
        """Betti numbers by the dual shape, with balls a little smaller and a little larger.

        Examples
        --------
        >>> BallUnion(np.array([(0.0, 0), (2, 0)]), np.ones(2)).homotopy()
        [(2, 0), (1, 0)]
        """
        return homotopy(self._triangulated, self.radii, *slack)

    def crossing(self, bare: bool = False) -> np.ndarray:
        """The pairs of balls whose spheres meet on the boundary, (m, 2) int array.

        Bare ones meet nowhere else: all of the circle is on the boundary, or in the plane both points are.

        Examples
        --------
        >>> three = BallUnion(np.array([(0.0, 0), (1, 0), (0.5, 0.8)]), np.ones(3))
        >>> three.crossing().tolist(), len(three.crossing(bare=True))
        ([[0, 1], [0, 2], [1, 2]], 0)
        """
        if self.in_space:
            arcs, pairs = self.boundary.arcs, self.boundary.circles.pairs
            return pairs[np.isin(np.arange(len(pairs)), arcs.ball[arcs.whole])] if bare else pairs
        on = Incidence(self.boundary.corners, self.centers, self.radii, self.origin)
        pairs, times = on.pairs()
        return pairs[times >= 2] if bare else pairs

    def as_given(self, pairs: np.ndarray) -> np.ndarray:
        """Pairs of these balls by their numbers before copies were left out: i < j, sorted, (m, 2).

        Examples
        --------
        >>> twice = BallUnion(np.array([(0.0, 0), (0, 0), (1, 0)]), np.ones(3))
        >>> twice.as_given(np.array([(1, 0)])).tolist()
        [[0, 2]]
        """
        pairs = np.sort(self.rows[pairs], axis=1).reshape(-1, 2)
        return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]

    @cached_property
    def _triangulated(self) -> PowerTriangulation:
        return power_triangulation(self.centers, self.radii)

    @cached_property
    def _verified(self) -> tuple[PowerTriangulation, Boundary]:
        return verified_boundary(self._places, self.radii, self._triangulated)
