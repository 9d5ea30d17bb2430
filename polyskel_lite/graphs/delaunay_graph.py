"""The Delaunay tessellation of points (section 2.2)."""

from __future__ import annotations

from ..checks import MOST_POINTS, as_indices, as_points, check_distinct
from ..errors import InputError
from .tessellation import Tessellation
from .triangulation import triangulate


def delaunay(points, facets=None) -> Tessellation:
    """Delaunay tessellation of points, checked exactly (section 2.2).

    Parameters
    ----------
    points : (n, N) array-like, N = 2 or 3
        All different, not all in one line or plane; any unit, any distance from the origin.
    facets : (m, N) array-like of int, optional
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
    if len(points) >= MOST_POINTS:
        raise InputError(f"there are {len(points):,} points, and {MOST_POINTS:,} are too many; thin them.")
    check_distinct(points)
    if facets is not None:
        facets = as_indices(facets, "facets", len(points), points.shape[1])
    return Tessellation.trusted(points, *triangulate(points, facets))


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
