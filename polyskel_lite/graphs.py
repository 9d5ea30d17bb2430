"""Delaunay tessellation, Voronoi graph and Gabriel graph (the paper's section 2.2), in 2D and 3D."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from ._triangulate import triangulate
from .complexes import Skeleton, dual_complex
from .predicates import as_integers, as_points, in_ball, in_gabriel_ball
from .shapes import check_distinct
from .topology import components


@dataclass(frozen=True, eq=False)
class Tessellation:
    """A verified Delaunay tessellation of points; made by `delaunay`.

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
    >>> square = delaunay([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> len(square.simplices), square.circumcenters.tolist()
    (2, [[1.0, 1.0], [1.0, 1.0]])
    """

    points: np.ndarray
    simplices: np.ndarray
    neighbors: np.ndarray

    @property
    def dimension(self) -> int:
        """N, the dimension of the space."""
        return self.points.shape[1]

    @cached_property
    def _balls(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        # Laid out so that each coordinate of all corners is contiguous: long loops for NumPy.
        return _circumballs(
            np.take(self.points.T, self.simplices.T.astype(np.intp, copy=False), axis=1).transpose(2, 1, 0)
        )

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
        >>> facets, sides = delaunay([(0, 0), (1, 0), (0, 1)]).facet_table
        >>> facets.tolist(), sides.tolist()
        ([[1, 2], [0, 2], [0, 1]], [[0, -1], [0, -1], [0, -1]])
        """
        t, corners = self.simplices.shape
        first = np.repeat(np.arange(t), corners)
        second = self.neighbors.ravel()
        once = (second < 0) | (first < second)
        opposite = np.tile(np.arange(corners), t)[once]
        others = np.array([[j for j in range(corners) if j != i] for i in range(corners)])
        facets = np.sort(np.take_along_axis(self.simplices[first[once]], others[opposite], axis=1), axis=1)
        return facets, np.stack([first[once], second[once]], axis=1)

    def facets(self) -> np.ndarray:
        """The Delaunay segments (N = 2) or triangles (N = 3), each once, (m, N).

        Examples
        --------
        >>> delaunay([(0, 0), (1, 0), (0, 1)]).facets().tolist()
        [[1, 2], [0, 2], [0, 1]]
        """
        return self.facet_table[0]

    def edges(self) -> np.ndarray:
        """The Delaunay segments, each once, (m, 2), in increasing order.

        Examples
        --------
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
        twice, numerator = _circumcenter_terms(d)
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


def _circumcenter_terms(d):
    """Twice the determinant of the sides d (t, N, N), and that times the way to the circumcenter."""
    lift = (d * d).sum(axis=2)
    if d.shape[2] == 2:
        (ax, ay), (bx, by) = d[:, 0].T, d[:, 1].T
        numerator = [by * lift[:, 0] - ay * lift[:, 1], ax * lift[:, 1] - bx * lift[:, 0]]
        return 2 * (ax * by - ay * bx), np.stack(numerator, axis=1)
    a, b, c = d[:, 0], d[:, 1], d[:, 2]
    bc, ca, ab = _cross(b, c), _cross(c, a), _cross(a, b)
    return 2 * (a * bc).sum(axis=1), lift[:, :1] * bc + lift[:, 1:2] * ca + lift[:, 2:] * ab


def _cross(u, v):
    # numpy.cross does not take Python's unbounded integers.
    (ux, uy, uz), (vx, vy, vz) = u.T, v.T
    return np.stack([uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx], axis=1)


def _exact_offset(simplex):
    # The second array tells what a length of one is in the common unit of the integers.
    corners, unit = as_integers(simplex, np.ones(1))
    twice, numerator = _circumcenter_terms((corners[1:] - corners[:1])[None])
    try:
        return [float(Fraction(x, twice[0] * unit[0])) for x in numerator[0]]
    except (ZeroDivisionError, OverflowError):
        return np.full(simplex.shape[1], np.inf)


def delaunay(points, facets=None) -> Tessellation:
    """Delaunay tessellation of points, checked exactly (section 2.2).

    Parameters
    ----------
    points : (n, N) array-like, N = 2 or 3
        All different, not all in one line or plane; any unit, any distance from the origin.
    facets : (m, 2) array-like of int, optional
        Segments to prefer among the diagonals of cocircular samples (2D): a boundary that is in
        one of the possible tessellations is then in this one.

    Returns
    -------
    Tessellation
        Cocircular or cospherical points get one of their possible tessellations, without flat simplices.

    Raises
    ------
    InputError, DuplicatePointError
        If the array is not one of distinct finite points.
    TessellationError
        If there are fewer than N+1 points, if all are in one line or plane, or if no tessellation
        passed the check.

    Notes
    -----
    Qhull does the work on centred and scaled copies. Then every point must be used, every simplex
    positively oriented, every neighbouring vertex outside the open ball, the hull convex: signs by
    `predicates`, so they are those of the points as given.

    References
    ----------
    Barber, Dobkin and Huhdanpaa, The Quickhull algorithm for convex hulls, 1996.

    Examples
    --------
    >>> grid = [(1e8 + x, y) for x in range(5) for y in range(5)]
    >>> len(delaunay(grid).simplices)
    32
    """
    points = as_points(points)
    check_distinct(points)
    points.setflags(write=False)
    return Tessellation(points, *triangulate(points, None if facets is None else np.asarray(facets)))


def facet_rows(tessellation: Tessellation, facets: np.ndarray) -> np.ndarray:
    """The row of ``tessellation.facet_table`` of each facet, in any vertex order; -1 if it is not Delaunay.

    Examples
    --------
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


def as_tessellation(points_or_tessellation) -> Tessellation:
    """Return a `Tessellation` as it is, or that of an array of points.

    Examples
    --------
    >>> as_tessellation([(0, 0), (1, 0), (0, 1)]).dimension
    2
    """
    if isinstance(points_or_tessellation, Tessellation):
        return points_or_tessellation
    return delaunay(points_or_tessellation)


def gabriel_mask(
    tessellation: Tessellation, closed: bool = True, rows: np.ndarray | None = None
) -> np.ndarray:
    """Which rows of ``tessellation.facet_table`` are Gabriel facets, exactly.

    Among the samples strictly on one side of a facet, the Delaunay apex is the last to leave the
    growing balls through the facet, so testing the two apexes tests them all. A sample in the plane of
    the facet can only be on its circle; that takes four cocircular samples in space.

    Examples
    --------
    >>> gabriel_mask(delaunay([(0, 0), (4, 0), (2, 1)])).tolist()
    [True, True, False]
    """
    facets, apexes = tessellation.facets(), tessellation.apexes()
    if rows is not None:
        facets, apexes = facets[rows], apexes[rows]
    keep = np.ones(len(facets), dtype=bool)
    limit = 0 if closed else 1
    for side in range(2):
        there = np.flatnonzero(apexes[:, side] >= 0)
        corners = tessellation.points[facets[there]]
        keep[there] &= in_gabriel_ball(corners, tessellation.points[apexes[there, side]]) < limit
    if closed and tessellation.dimension == 3:
        sides = tessellation.facet_table[1] if rows is None else tessellation.facet_table[1][rows]
        keep[keep] = ~_cocircular(tessellation, facets[keep], sides[keep, 0])
    return keep


def _cocircular(tessellation: Tessellation, facets: np.ndarray, behind: np.ndarray) -> np.ndarray:
    """Whether a fourth sample is on the circle through each triangle; ``behind`` is a simplex of each."""
    (_, sides), points = tessellation.facet_table, tessellation.points
    inner = sides[:, 1] >= 0
    first, apex = sides[inner, 0], tessellation.apexes()[inner, 1]
    tie = in_ball(points[tessellation.simplices[first]], points[apex]) == 0
    # Such a sample is on the sphere of the simplex behind: look among simplices that share a sphere.
    _, label = components(len(tessellation.simplices), sides[inner][tie])
    shared = np.bincount(label)[label] > 1
    found = np.zeros(len(facets), dtype=bool)
    members: dict[int, np.ndarray] = {}
    for sphere in np.unique(label[behind[shared[behind]]]).tolist():
        members[sphere] = np.unique(tessellation.simplices[label == sphere])
    for k in np.flatnonzero(shared[behind]).tolist():
        others = np.setdiff1d(members[int(label[behind[k]])], facets[k])
        corners = np.broadcast_to(points[facets[k]], (len(others), 3, 3))
        found[k] = (in_gabriel_ball(corners, points[others]) == 0).any()
    return found


def gabriel(points_or_tessellation, closed: bool = True) -> np.ndarray:
    """Gabriel graph GG(E): Delaunay facets whose smallest ball holds no other sample (section 2.2).

    Parameters
    ----------
    points_or_tessellation : (n, N) array-like or Tessellation
    closed : bool
        True asks for an empty *closed* ball, which Theorem 2 needs; False for an empty open ball,
        as the paper prints it.

    Returns
    -------
    (m, N) int array
        Segments (N = 2) or triangles (N = 3), vertices in increasing order.

    Notes
    -----
    With the open ball, cocircular samples can have Gabriel segments that cross; only those in the
    tessellation at hand are returned.

    References
    ----------
    Gabriel and Sokal, A new statistical approach to geographic variation analysis, 1969.

    Examples
    --------
    >>> corner = [(0, 0), (0, 1), (1, 0)]
    >>> gabriel(corner).tolist(), gabriel(corner, closed=False).tolist()
    ([[0, 1], [0, 2]], [[1, 2], [0, 1], [0, 2]])
    """
    tessellation = as_tessellation(points_or_tessellation)
    return tessellation.facets()[gabriel_mask(tessellation, closed)]


def voronoi(points_or_tessellation) -> Skeleton:
    """Voronoi graph Vor(E): the dual of the whole Delaunay tessellation (section 2.2).

    Parameters
    ----------
    points_or_tessellation : (n, N) array-like or Tessellation

    Returns
    -------
    Skeleton
        One vertex per Delaunay simplex (so cocircular samples give several at one place), an edge
        per inner facet, a ray per facet of the convex hull, in 3D a polygon per inner Delaunay edge.

    Examples
    --------
    >>> graph = voronoi([(0, 0), (2, 0), (0, 2)])
    >>> graph.vertices.tolist(), len(graph.edges), len(graph.rays)
    ([[1.0, 1.0]], 0, 3)
    """
    tessellation = as_tessellation(points_or_tessellation)
    return dual_complex(tessellation, np.ones(len(tessellation.simplices), dtype=bool), rays=True)
