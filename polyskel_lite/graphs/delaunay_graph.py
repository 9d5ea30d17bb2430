"""The Delaunay tessellation of points (section 2.2)."""

from __future__ import annotations

from numpy.typing import ArrayLike

from ..checks import MOST_POINTS, as_indices, as_points
from ..errors import InputError
from .cocircular import preferring
from .growing import Growing
from .tessellation import Tessellation
from .triangulation import triangulate


def delaunay(points: ArrayLike, facets: ArrayLike | None = None) -> Tessellation:
    """Delaunay tessellation of points, checked exactly (section 2.2).

    Parameters
    ----------
    points : (n, N) array-like, N = 2 or 3
        All different, not all in one line or plane; any unit, any distance from the origin.
    facets : (m, N) array-like of int, optional
        Boundary facets to prefer among the diagonals of cocircular samples. In 2D a boundary that is in one
        of the possible tessellations is in this one. In 3D the diagonals of its flat faces are preferred
        where cones from vertices of cospherical cells give them.

    Returns
    -------
    Tessellation
        Cocircular or cospherical points get one of their possible tessellations, without flat simplices;
        which one, depends on the coordinates and facets only, not on the order of the points.

    Raises
    ------
    InputError, DuplicatePointError
        If the array is not one of distinct finite points.
    TessellationError
        If there are fewer than N+1 points, or if all are in one line or plane.

    Notes
    -----
    Points are inserted one by one, every sign exact; see `polyskel_lite.graphs.insertion`. With the extra
    ``fast`` the loops are compiled, from 2,000 points on or where that was done before. Small sets, and all
    without the extra, go through Qhull first; its answer is taken if it passes an exact check and is the
    only one.

    References
    ----------
    Bowyer 1981; Watson 1981; Barber, Dobkin and Huhdanpaa, The Quickhull algorithm for convex hulls, 1996.

    Examples
    --------
    >>> grid = [(1e8 + x, y) for x in range(5) for y in range(5)]
    >>> len(delaunay(grid).simplices)
    32
    """
    points = as_points(points)
    if len(points) >= MOST_POINTS:
        raise InputError(f"there are {len(points):,} points, and {MOST_POINTS:,} are too many; thin them.")
    if facets is not None:
        facets = as_indices(facets, "facets", len(points), points.shape[1])
    simplices, neighbors, growing = triangulate(points)
    tessellation = Tessellation.trusted(points, simplices, neighbors)
    tessellation.__dict__["_growing"] = growing
    if facets is None:
        return tessellation
    preferred = preferring(tessellation, facets)
    preferred.__dict__["_growing"] = growing  # it goes on without regard to facets
    return preferred


def grown_from(tessellation: Tessellation) -> Growing:
    """The same as a tessellation that can grow; asked first, it is the one that made this.

    Examples
    --------
    >>> len(grown_from(delaunay([(0, 0), (1, 0), (0, 1)])).points)
    3
    """
    growing = tessellation.__dict__.pop("_growing", None)
    return Growing(tessellation.points) if growing is None else growing


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
