"""Delaunay tessellation, Voronoi graph and Gabriel graph (the paper's section 2.2), in 2D and 3D."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from ..checks import as_indices, as_points
from ..errors import InputError
from ..exact import as_integers, circumcenter_terms

#: By the number of corners: the facets opposite them, all seen from the same side in a positive simplex.
OPPOSITE = {3: np.array([(1, 2), (2, 0), (0, 1)]), 4: np.array([(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)])}


@dataclass(frozen=True, eq=False)
class Tessellation:
    """A verified Delaunay tessellation of points; made by `delaunay`.

    Given arrays are checked as far as that is quick: what they are, and that neighbors are so both ways.

    Attributes
    ----------
    points : (n, N) float array
        The samples E.
    simplices : (t, N+1) int array
        Triangles (N = 2) or tetrahedra (N = 3), positively oriented.
    neighbors : (t, N+1) int array
        The simplex opposite each vertex, -1 beyond the convex hull.
    circumcenters : (t, N) float array
        The Voronoi vertices. Far away, or even infinite, for simplices that are nearly flat.
    circumradii : (t,) float array
        Radii of the Delaunay balls, a length.

    Examples
    --------
    >>> from polyskel_lite import delaunay
    >>> square = delaunay([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> len(square.simplices), square.circumcenters.tolist()
    (2, [[1.0, 1.0], [1.0, 1.0]])
    """

    points: np.ndarray
    simplices: np.ndarray
    neighbors: np.ndarray

    def __post_init__(self):
        points = as_points(self.points)
        corners = points.shape[1] + 1
        simplices = as_indices(self.simplices, "simplices", len(points), corners)
        neighbors = as_indices(self.neighbors, "neighbors", len(simplices), corners, -1)
        if len(simplices) != len(neighbors) or not len(simplices):
            raise InputError(f"there are {len(neighbors)} rows of neighbors for {len(simplices)} simplices.")
        t, side = np.nonzero(neighbors >= 0)
        lonely = (neighbors[neighbors[t, side]] != t[:, None]).all(axis=1)
        if lonely.any():
            k = np.argmax(lonely)
            raise InputError(
                f"simplex {t[k]} has the neighbor {neighbors[t[k], side[k]]}, which has not {t[k]}; "
                "compute the tessellation again."
            )
        points.setflags(write=False)
        for name, array in (("points", points), ("simplices", simplices), ("neighbors", neighbors)):
            object.__setattr__(self, name, array)

    @property
    def dimension(self) -> int:
        """N, the dimension of the space."""
        return self.points.shape[1]

    @cached_property
    def _balls(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        scaled, exponent = ordinary(self)
        # Laid out so that each coordinate of all corners is contiguous: long loops for NumPy.
        corners = np.take(scaled.points.T, scaled.simplices.T.astype(np.intp, copy=False), axis=1)
        return tuple(np.ldexp(array, exponent) for array in _circumballs(corners.transpose(2, 1, 0)))

    @property
    def circumcenters(self) -> np.ndarray:
        """Centres of the Delaunay balls, (t, N)."""
        return self._balls[0]

    @property
    def circumradii(self) -> np.ndarray:
        """Radii of the Delaunay balls, (t,)."""
        return self._balls[1]

    @property
    def circumcenter_errors(self) -> np.ndarray:
        """Bounds on the distance from each circumcenter to the true one, (t,); not finite if it overflows."""
        return self._balls[2]

    @cached_property
    def facet_table(self) -> tuple[np.ndarray, np.ndarray]:
        """Every facet once: its vertices (m, N), increasing, and its two simplices (m, 2), -1 for none.

        Examples
        --------
        >>> from polyskel_lite import delaunay
        >>> facets, sides = delaunay([(0, 0), (1, 0), (0, 1)]).facet_table
        >>> facets.tolist(), sides.tolist()
        ([[1, 2], [0, 2], [0, 1]], [[0, -1], [0, -1], [0, -1]])
        """
        t, corners = self.simplices.shape
        first = np.repeat(np.arange(t), corners)
        second = self.neighbors.ravel()
        once = (second < 0) | (first < second)
        opposite = np.tile(np.arange(corners), t)[once]
        facets = np.sort(
            np.take_along_axis(self.simplices[first[once]], OPPOSITE[corners][opposite], axis=1), axis=1
        )
        return facets, np.stack([first[once], second[once]], axis=1)

    def facets(self) -> np.ndarray:
        """The Delaunay segments (N = 2) or triangles (N = 3), each once, (m, N).

        Examples
        --------
        >>> from polyskel_lite import delaunay
        >>> delaunay([(0, 0), (1, 0), (0, 1)]).facets().tolist()
        [[1, 2], [0, 2], [0, 1]]
        """
        return self.facet_table[0]

    def edges(self) -> np.ndarray:
        """The Delaunay segments, each once, (m, 2), in increasing order.

        Examples
        --------
        >>> from polyskel_lite import delaunay
        >>> delaunay([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]).edges().shape
        (6, 2)
        """
        corners = self.simplices.shape[1]
        pairs = [self.simplices[:, [i, j]] for i in range(corners) for j in range(i)]
        return np.unique(np.sort(np.concatenate(pairs), axis=1), axis=0)

    def apexes(self) -> np.ndarray:
        """The vertices that complete each facet of `facet_table` to its two simplices, (m, 2), -1 for none.

        Examples
        --------
        >>> from polyskel_lite import delaunay
        >>> delaunay([(0, 0), (1, 0), (0, 1)]).apexes().tolist()
        [[0, -1], [1, -1], [2, -1]]
        """
        return self._apexes

    @cached_property
    def _apexes(self) -> np.ndarray:
        facets, sides = self.facet_table
        # A simplex's vertices sum up to its facet's vertices plus the apex.
        apex = self.simplices.sum(axis=1)[sides] - facets.sum(axis=1)[:, None]
        return np.where(sides >= 0, apex, -1)


def ordinary(tessellation: Tessellation) -> tuple[Tessellation, int]:
    """The same in a unit in which fourth powers of coordinates are ordinary floats, and its exponent of two.

    A power of two changes no digit. Where coordinates are below 2**200 and above 2**-200, nothing is done.

    Examples
    --------
    >>> from polyskel_lite import delaunay
    >>> small, exponent = ordinary(delaunay([(0, 0), (1e90, 0), (0, 1e90)]))
    >>> exponent, bool((np.ldexp(small.points, exponent) == [(0, 0), (1e90, 0), (0, 1e90)]).all())
    (299, True)
    """
    exponent = int(np.frexp(np.abs(tessellation.points).max(initial=0.0))[1])
    if abs(exponent) <= 200:
        return tessellation, 0
    points = np.ldexp(tessellation.points, -exponent)
    return Tessellation(points, tessellation.simplices, tessellation.neighbors), exponent


def circumballs(simplices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Circumcenters and circumradii of simplices with corners (t, N+1, N).

    Returns
    -------
    centers : (t, N) float array
        Infinite for flat simplices.
    radii : (t,) float array

    Examples
    --------
    >>> centers, radii = circumballs(np.array([[[0.0, 0.0], [8.0, 0.0], [0.0, 6.0]]]))
    >>> centers.tolist(), radii.tolist()
    ([[4.0, 3.0]], [5.0])
    """
    return _circumballs(np.asarray(simplices, dtype=np.float64))[:2]


def _circumballs(simplices):
    """Centers, radii, and a bound on the error of each center."""
    base, d = simplices[:, 0], simplices[:, 1:] - simplices[:, :1]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):
        twice, numerator = circumcenter_terms(d)
        sides = np.sqrt((d**2).sum(axis=2))
        size = sides.prod(axis=1)
        offset = np.where(twice[:, None] != 0, numerator / twice[:, None], np.inf)
        # Thin simplices: rounding would move, or lose, their centre. Integers do not round.
        thin = np.flatnonzero(~(np.abs(twice) > 1e-6 * size))
        for k in thin:
            offset[k] = _exact_offset(simplices[k])
        centers, radii = base + offset, np.sqrt((offset**2).sum(axis=1))
        # Numerator and denominator are sums of products that are at most ``size`` (times a length): each is
        # rounded fewer than 64 times. The exact ones are rounded once. Then the base is added.
        error = 64 * 2.0**-53 * (sides.max(axis=1) + radii) * size / np.abs(twice)
        error[thin] = 0
        error += 4 * 2.0**-53 * (np.abs(centers).max(axis=1) + radii)
        return centers, radii, error


def _exact_offset(simplex):
    # The second array tells what a length of one is in the common unit of the integers.
    corners, unit = as_integers(simplex, np.ones(1))
    twice, numerator = circumcenter_terms((corners[1:] - corners[:1])[None])
    try:
        return [float(Fraction(x, twice[0] * unit[0])) for x in numerator[0]]
    except (ZeroDivisionError, OverflowError):
        return np.full(simplex.shape[1], np.inf)


def facet_rows(tessellation: Tessellation, facets: np.ndarray) -> np.ndarray:
    """The row of ``tessellation.facet_table`` of each facet, in any vertex order; -1 if it is not Delaunay.

    Examples
    --------
    >>> from polyskel_lite import delaunay
    >>> facet_rows(delaunay([(0, 0), (4, 0), (4, 1), (0, 1), (2, 3)]), np.array([[1, 0], [0, 4]])).tolist()[1]
    -1
    """
    n = len(tessellation.points)

    def keys(rows):
        rows = np.sort(np.asarray(rows, dtype=np.int64), axis=1)
        # n**3 fits in 63 bits for two million points.
        return (rows * n ** np.arange(rows.shape[1])[::-1]).sum(axis=1)

    table = keys(tessellation.facets())
    order = np.argsort(table)
    wanted = keys(facets)
    at = np.searchsorted(table[order], wanted)
    at[at == len(table)] = 0
    row = order[at]
    return np.where(table[row] == wanted, row, -1)
