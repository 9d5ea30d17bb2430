"""Delaunay tessellation, Voronoi graph and Gabriel graph (the paper's section 2.2), in 2D and 3D."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import coo_array, csr_array

from ..checks import as_indices, as_points
from ..errors import InputError
from ..exact import as_integers, circumcenter_terms
from ..tables import Described, bounds_and_betti

_BLOCK = 2**14

#: By the number of corners: the facets opposite them, all seen from the same side in a positive simplex.
OPPOSITE = {3: np.array([(1, 2), (2, 0), (0, 1)]), 4: np.array([(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)])}


@dataclass(frozen=True, eq=False, repr=False)
class Tessellation(Described):
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

    points: NDArray[np.float64]
    simplices: NDArray[np.int64]
    neighbors: NDArray[np.int64]

    if TYPE_CHECKING:  # what is given may be any array-like, what is kept is an array

        def __init__(self, points: ArrayLike, simplices: ArrayLike, neighbors: ArrayLike) -> None: ...

    def _facts(self) -> Iterator[tuple[str, object]]:
        yield "points", len(self.points)
        yield "triangles" if self.dimension == 2 else "tetrahedra", len(self.simplices)
        yield next(bounds_and_betti(self.points, tuple))

    def __post_init__(self):
        points = as_points(self.points)
        corners = points.shape[1] + 1
        simplices = as_indices(self.simplices, "simplices", len(points), corners)
        neighbors = as_indices(self.neighbors, "neighbors", len(simplices), corners, -1)
        if len(simplices) != len(neighbors) or not len(simplices):
            raise InputError(f"there are {len(neighbors)} rows of neighbors for {len(simplices)} simplices.")
        row = np.arange(len(simplices))[:, None]
        mutual = neighbors < 0
        for column in neighbors.T.copy():
            mutual |= column[neighbors] == row
        if not mutual.all():
            k, side = np.argwhere(~mutual)[0]
            raise InputError(
                f"simplex {k} has the neighbor {neighbors[k, side]}, which has not {k}; "
                "compute the tessellation again."
            )
        self._keep(points, simplices, neighbors)

    @classmethod
    def trusted(cls, points: np.ndarray, simplices: np.ndarray, neighbors: np.ndarray) -> Tessellation:
        """The same without a check or a copy, for arrays that the library has made itself.

        Examples
        --------
        >>> nothing = np.full((1, 3), -1)
        >>> Tessellation.trusted(np.eye(3, 2), np.array([(0, 1, 2)]), nothing).circumradii.round(3).tolist()
        [0.707]
        """
        new = object.__new__(cls)
        new._keep(points, simplices.astype(np.int64, copy=False), neighbors.astype(np.int64, copy=False))
        return new

    def __getstate__(self):
        # What it was read off grows with one tessellation only, and its loops cannot be pickled.
        return {name: value for name, value in self.__dict__.items() if name != "_growing"}

    def _keep(self, points, simplices, neighbors):
        for array in (points, simplices, neighbors):
            array.setflags(write=False)
        self.__dict__.update(points=points, simplices=simplices, neighbors=neighbors)  # it is frozen

    @property
    def dimension(self) -> int:
        """N, the dimension of the space."""
        return self.points.shape[1]

    @cached_property
    def _balls(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        scaled, exponent = ordinary(self)
        centers, radii, errors = in_blocks(
            lambda rows: circumballs(corners_of(scaled.points, rows)), self.simplices
        )
        return np.ldexp(centers, exponent), np.ldexp(radii, exponent), np.ldexp(errors, exponent)

    @property
    def circumcenters(self) -> NDArray[np.float64]:
        """Centres of the Delaunay balls, (t, N)."""
        return self._balls[0]

    @property
    def circumradii(self) -> NDArray[np.float64]:
        """Radii of the Delaunay balls, (t,)."""
        return self._balls[1]

    @property
    def circumcenter_errors(self) -> NDArray[np.float64]:
        """Bounds on the distance from each circumcenter to the true one, (t,); not finite if it overflows."""
        return self._balls[2]

    @cached_property
    def facet_table(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Every facet once: its vertices (m, N), increasing, and its two simplices (m, 2), -1 for none.

        Examples
        --------
        >>> from polyskel_lite import delaunay
        >>> facets, sides = delaunay([(0, 0), (1, 0), (0, 1)]).facet_table
        >>> facets.tolist(), sides.tolist()
        ([[1, 2], [0, 2], [0, 1]], [[0, -1], [0, -1], [0, -1]])
        """
        t, corners = self.simplices.shape
        place = np.flatnonzero((self.neighbors < 0) | (np.arange(t)[:, None] < self.neighbors))
        first, opposite = np.divmod(place, corners)
        a, b, *c = (self.simplices.ravel()[corners * first + k[opposite]] for k in OPPOSITE[corners].T)
        facets = np.empty((len(place), corners - 1), dtype=np.int64)
        low, high = np.minimum(a, b), np.maximum(a, b)
        facets[:, 0], facets[:, -1] = (np.minimum(low, *c), np.maximum(high, *c)) if c else (low, high)
        if c:
            facets[:, 1] = np.maximum(low, np.minimum(high, *c))
        return facets, np.stack([first, self.neighbors.ravel()[place]], axis=1)

    def facets(self) -> NDArray[np.int64]:
        """The Delaunay segments (N = 2) or triangles (N = 3), each once, (m, N).

        Examples
        --------
        >>> from polyskel_lite import delaunay
        >>> delaunay([(0, 0), (1, 0), (0, 1)]).facets().tolist()
        [[1, 2], [0, 2], [0, 1]]
        """
        return self.facet_table[0]

    def edges(self, rows: slice | NDArray = slice(None)) -> NDArray[np.int64]:
        """The Delaunay segments, each once, (m, 2), in increasing order; of all simplices or some rows.

        Examples
        --------
        >>> from polyskel_lite import delaunay
        >>> delaunay([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]).edges().shape
        (6, 2)
        """
        n, columns = len(self.points), self.simplices[rows].T.copy()
        pairs = [(a, b) for k, a in enumerate(columns) for b in columns[:k]]
        keys = np.sort(np.concatenate([np.minimum(a, b) * n + np.maximum(a, b) for a, b in pairs]))
        return np.stack(np.divmod(keys[np.diff(keys, prepend=-1) > 0], n), axis=1)

    def apexes(self) -> NDArray[np.int64]:
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
        whole, part = self.simplices.sum(axis=1), facets.sum(axis=1)
        return np.where(sides >= 0, whole[sides] - part[:, None], -1)

    @cached_property
    def _rows(self) -> csr_array:
        """One more than the row of each facet, by its first vertex and the others as one number."""
        first, rest = _halves(self.facets(), len(self.points))
        shape = len(self.points), len(self.points) ** (self.dimension - 1)
        table = coo_array((np.arange(1, len(first) + 1), (first, rest)), shape=shape)
        table.has_canonical_format = True  # no facet is there twice: nothing to sort or to add
        return table.tocsr()


def _halves(facets, n):
    # n**2 fits in 63 bits for two million points, and a row of a sparse matrix is found without sorting.
    return facets[:, 0], facets[:, 1] if facets.shape[1] == 2 else facets[:, 1] * n + facets[:, 2]


def corners_of(points: np.ndarray, simplices: np.ndarray) -> np.ndarray:
    """The same as ``points[simplices]``, (t, N+1, N), so that each coordinate of all corners is contiguous.

    Examples
    --------
    >>> corners_of(np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]), np.array([(0, 1, 2)])).tolist()
    [[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]]
    """
    return np.take(points.T, simplices.T.astype(np.intp, copy=False), axis=1).transpose(2, 1, 0)


def in_blocks(function, rows: np.ndarray) -> tuple[np.ndarray, ...]:
    """The arrays that a function makes of some rows, computed in blocks that stay in the processor's cache.

    Examples
    --------
    >>> in_blocks(lambda rows: (rows**2,), np.arange(4))[0].tolist()
    [0, 1, 4, 9]
    """
    blocks = [function(rows[k : k + _BLOCK]) for k in range(0, max(len(rows), 1), _BLOCK)]
    # In the order of C, whatever that of the blocks.
    return tuple(np.ascontiguousarray(np.concatenate(parts)) for parts in zip(*blocks, strict=True))


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
    return Tessellation.trusted(points, tessellation.simplices, tessellation.neighbors), exponent


def moved_back(tessellation: Tessellation, exponent: int, given: np.ndarray) -> Tessellation | None:
    """A tessellation in a power of two of its unit; the first points are those given, digit by digit.

    None where the smallest floats have too few digits: there it is to be made anew.

    Examples
    --------
    >>> from polyskel_lite import delaunay
    >>> large = 2.0**900 * np.eye(3, 2)
    >>> bool((moved_back(delaunay(np.eye(3, 2)), 900, large).points == large).all())
    True
    """
    points = np.ldexp(tessellation.points, exponent)
    points[: len(given)] = given
    if not np.array_equal(np.ldexp(points, -exponent), tessellation.points):
        return None
    return Tessellation.trusted(points, tessellation.simplices, tessellation.neighbors)


def circumballs(simplices: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Circumcenters and circumradii of simplices with corners (t, N+1, N), and bounds on the centers' errors.

    Returns
    -------
    centers : (t, N) float array
        Infinite for flat simplices.
    radii, errors : (t,) float arrays

    Examples
    --------
    >>> centers, radii, _ = circumballs(np.array([[[0.0, 0.0], [8.0, 0.0], [0.0, 6.0]]]))
    >>> centers.tolist(), radii.tolist()
    ([[4.0, 3.0]], [5.0])
    """
    corners = simplices.transpose(2, 1, 0)  # of which, by `corners_of`, each coordinate is contiguous
    d = corners[:, 1:] - corners[:, :1]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):
        twice, numerator = circumcenter_terms(d.transpose(2, 1, 0))
        sides = np.sqrt((d * d).sum(axis=0))
        size = sides.prod(axis=0)
        offset = np.where(twice != 0, numerator.T / twice, np.inf)
        # Thin simplices: rounding would move, or lose, their centre. Integers do not round.
        thin = np.flatnonzero(~(np.abs(twice) > 1e-6 * size))
        for k in thin:
            offset[:, k] = _exact_offset(simplices[k])
        centers, radii = corners[:, 0] + offset, np.sqrt((offset**2).sum(axis=0))
        # Numerator and denominator are sums of products that are at most ``size`` (times a length): each is
        # rounded fewer than 64 times. The exact ones are rounded once. Then the base is added.
        error = 64 * 2.0**-53 * (sides.max(axis=0) + radii) * size / np.abs(twice)
        error[thin] = 0
        error += 4 * 2.0**-53 * (np.abs(centers).max(axis=0) + radii)
        return np.ascontiguousarray(centers.T), radii, error


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
    facets = np.sort(np.asarray(facets, dtype=np.int64), axis=1)
    if not len(facets):
        return np.zeros(0, dtype=np.int64)
    return tessellation._rows[_halves(facets, len(tessellation.points))].astype(np.int64) - 1
