"""The Voronoi graph (section 2.2) and the dual of any set of Delaunay simplices."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..exact import Polygons, dual_polygons, normals_of, orientation
from ..graphs import Tessellation, as_tessellation
from .skeleton import Skeleton


def dual_complex(
    tessellation: Tessellation, keep: np.ndarray, cut: np.ndarray | None = None, rays: bool = False
) -> Skeleton:
    """The dual of some Delaunay simplices: a vertex each, an edge per shared facet, a polygon per inner edge.

    Parameters
    ----------
    tessellation : Tessellation
    keep : (t,) bool array
        The simplices that get a vertex.
    cut : (m,) bool array, optional
        Rows of ``tessellation.facet_table`` that get no dual edge though both sides are kept.
    rays : bool
        Whether facets of the convex hull get dual rays.

    Returns
    -------
    Skeleton

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> dual_complex(psl.delaunay([(0, 0), (2, 0), (0, 2), (2, 2)]), np.array([True, True])).edges.tolist()
    [[0, 1]]
    """
    number = np.append(np.where(keep, np.cumsum(keep) - 1, -1), -1)
    simplices = np.flatnonzero(keep)
    crossed = None if cut is None else _local(tessellation, cut)
    beyond = number[tessellation.neighbors[simplices]]
    # As in the table of facets: those of the first simplex first, and each from its first simplex.
    dual = (beyond > np.arange(len(simplices))[:, None]) & (True if crossed is None else ~crossed[simplices])
    edges = np.stack([np.nonzero(dual)[0], beyond[dual]], axis=1)
    polygons = Polygons()
    if tessellation.dimension == 3:
        polygons = dual_polygons(tessellation.simplices, tessellation.neighbors, number, crossed)
    directions, origins = np.zeros((0, tessellation.dimension)), np.zeros(0, dtype=np.int64)
    if rays:
        sides = tessellation.facet_table[1]
        open_side = (sides[:, 1] < 0) & keep[sides[:, 0]] & (True if cut is None else ~cut)
        directions = outward_normals(tessellation, np.flatnonzero(open_side))
        origins = number[sides[open_side, 0]]
    balls = tessellation.circumcenters[simplices], tessellation.circumradii[simplices]
    return Skeleton(*balls, simplices, edges, polygons, directions, origins, tessellation)


def outward_normals(tessellation: Tessellation, rows: np.ndarray) -> np.ndarray:
    """Unit normals of facets, pointing away from the first simplex of their row in ``facet_table``, (k, N).

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> triangle = psl.delaunay([(0, 0), (1, 0), (0, 1)])
    >>> outward_normals(triangle, np.array([1, 2])).tolist()
    [[-1.0, 0.0], [0.0, -1.0]]
    """
    corners = tessellation.points[tessellation.facets()[rows]]
    apex = tessellation.points[tessellation.apexes()[rows, 0]]
    normal = normals_of(corners)
    # Exactly, because the apex of a nearly flat simplex is too near to its facet for rounded signs.
    inward = orientation(np.concatenate([corners, apex[:, None]], axis=1)) > 0
    normal[inward] *= -1
    # Adding zero turns -0.0 into 0.0, which reads better.
    return normal / np.linalg.norm(normal, axis=1, keepdims=True) + 0.0


def _local(tessellation, cut):
    """Rows of ``facet_table`` as a mask over (simplex, opposite vertex)."""
    sides = tessellation.facet_table[1][cut]
    apexes = tessellation.apexes()[cut]
    mask = np.zeros(tessellation.neighbors.shape, dtype=bool)
    for side in range(2):
        there = sides[:, side] >= 0
        s = sides[there, side]
        mask[s, (tessellation.simplices[s] == apexes[there, side][:, None]).argmax(axis=1)] = True
    return mask


def voronoi(points_or_tessellation: ArrayLike | Tessellation) -> Skeleton:
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
