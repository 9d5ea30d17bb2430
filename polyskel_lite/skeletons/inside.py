"""From Sk2 to Sk3: the pieces of the Voronoi edges that the boundary cuts (section 3.3), in 2D and 3D."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from .skeleton import Skeleton
from .voronoi_graph import outward_normals


def with_cut_edges(sk2: Skeleton, inside: np.ndarray, pieces: dict, point_at: Callable) -> Skeleton:
    """Add to Sk2 the pieces of edges that are inside, with a vertex at every cut.

    Parameters
    ----------
    sk2 : Skeleton
        With its tessellation.
    inside : (t,) bool array
        Which Voronoi vertices are in Sk2.
    pieces : dict
        From a row of ``facet_table`` to the intervals (t0, t1) of its Voronoi edge that are inside.
    point_at : callable
        From a row and a parameter to the point of the edge, (N,).

    Returns
    -------
    Skeleton

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> sk2 = psl.voronoi([(0, 0), (4, 0), (0, 2), (4, 3)])
    >>> with_cut_edges(sk2, np.array([True, True]), {}, None).edges.tolist()
    [[0, 1]]
    """
    tessellation, n = sk2.tessellation, sk2.dimension
    number = np.where(inside, np.cumsum(inside) - 1, -1)
    facets, sides = tessellation.facet_table
    points, radii, edges, rays, ray_vertices = [], [], [], [], []

    def add(row, t):
        points.append(point_at(row, t))
        # All samples of the facet are at this distance, and none is nearer.
        radii.append(np.sqrt(((points[-1] - tessellation.points[facets[row, 0]]) ** 2).sum()))
        return len(sk2.vertices) + len(points) - 1

    for row, intervals in sorted(pieces.items()):
        first, second = sides[row].tolist()
        for t0, t1 in intervals:
            begin = int(number[first]) if t0 == 0 else add(row, t0)
            if t1 == 1 and second < 0:
                rays.append(outward_normals(tessellation, np.array([row]))[0])
                ray_vertices.append(begin)
            else:
                edges.append((begin, int(number[second]) if t1 == 1 else add(row, t1)))
    return replace(
        sk2,
        vertices=np.concatenate([sk2.vertices, np.reshape(points, (-1, n))]),
        radii=np.concatenate([sk2.radii, radii]),
        simplices=np.concatenate([sk2.simplices, np.full(len(points), -1)]),
        edges=np.concatenate([sk2.edges, np.reshape(edges, (-1, 2)).astype(np.int64)]),
        rays=np.concatenate([sk2.rays, np.reshape(rays, (-1, n))]),
        ray_vertices=np.concatenate([sk2.ray_vertices, np.array(ray_vertices, dtype=np.int64)]),
    )
