"""The Gabriel graph: Delaunay facets whose smallest ball is empty (section 2.2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..checks import as_flag
from ..exact import components, in_ball, in_gabriel_ball
from .delaunay_graph import as_tessellation
from .tessellation import Tessellation


def gabriel_mask(
    tessellation: Tessellation, closed: bool = True, rows: np.ndarray | None = None
) -> np.ndarray:
    """Which rows of ``tessellation.facet_table`` are Gabriel facets, exactly.

    Among the samples strictly on one side of a facet, the Delaunay apex is the last to leave the
    growing balls through the facet, so testing the two apexes tests them all. A sample in the plane of
    the facet can only be on its circle; that takes four cocircular samples in space.

    Examples
    --------
    >>> from polyskel_lite import delaunay
    >>> gabriel_mask(delaunay([(0, 0), (4, 0), (2, 1)])).tolist()
    [True, True, False]
    """
    closed = as_flag(closed, "closed")
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


def gabriel(points_or_tessellation: ArrayLike | Tessellation, closed: bool = True) -> NDArray[np.int64]:
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
