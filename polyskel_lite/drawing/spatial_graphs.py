"""Pictures in space: Delaunay tessellations and Voronoi graphs (for Gabriel graphs: `draw_facets_3d`)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from .lines import box_of, clip_segments, in_box, ray_segments
from .spatial import draw_facets_3d, draw_lines_3d

#: Corners of the facet opposite each corner of a tetrahedron.
OPPOSITE = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))


def draw_tessellation_3d(
    ax: Axes, tessellation, shrink: float = 1.0, spread: float = 0.0, alpha: float = 0.55
) -> Axes:
    """Draw the tetrahedra of a Delaunay tessellation, moved apart if wanted so that each can be seen.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    tessellation : Tessellation
        With N = 3.
    shrink : float
        Each tetrahedron is scaled by it about its own centroid.
    spread : float
        Each tetrahedron is moved away from the common centre by this share of its distance to it (0: where it
        is).
    alpha : float
        Opacity.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes_3d()
    >>> tessellation = psl.delaunay([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 2)])
    >>> ax = drawing.draw_tessellation_3d(ax, tessellation, spread=0.5)
    >>> len(ax.collections[0].get_facecolor()) == 4 * len(tessellation.simplices)
    True
    >>> plt.close(fig)
    """
    corners = np.asarray(tessellation.points)[tessellation.simplices]
    centroids = corners.mean(axis=1, keepdims=True)
    middle = np.asarray(tessellation.points).mean(axis=0)
    moved = centroids + spread * (centroids - middle) + shrink * (corners - centroids)
    index = 4 * np.arange(len(corners))[:, None, None] + np.array(OPPOSITE)
    return draw_facets_3d(ax, moved.reshape(-1, 3), index.reshape(-1, 3), kind="delaunay", alpha=alpha)


def draw_voronoi_3d(ax: Axes, voronoi, box=None, polygons=False, alpha: float = 0.35, **style) -> Axes:
    """Draw a Voronoi graph in space: edges and rays cut to a box, and polygons that lie in it if wanted.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    voronoi : Skeleton
        As `polyskel_lite.voronoi` returns it.
    box : (2, 3) array, optional
        By default the samples' bounding box and 8 % more on each side.
    polygons : bool, or sequence of int
        Fill the bounded polygons, all or those of these indices.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes_3d()
    >>> ax = drawing.draw_voronoi_3d(ax, psl.voronoi([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 2)]))
    >>> len(ax.collections)
    1
    >>> plt.close(fig)
    """
    box = box_of(voronoi.tessellation) if box is None else np.asarray(box, dtype=float)
    nodes = np.asarray(voronoi.vertices, dtype=float)
    chosen = range(len(voronoi.polygons)) if polygons is True else (polygons or ())
    seen = [voronoi.polygons[k] for k in chosen]
    seen = [p for p in seen if in_box(nodes[p], box).all()]
    draw_facets_3d(ax, nodes, seen, kind="voronoi", alpha=alpha, edges=False)
    segments = clip_segments(nodes[np.asarray(voronoi.edges, dtype=int).reshape(-1, 2)], box)
    return draw_lines_3d(ax, np.concatenate([segments, ray_segments(voronoi, box)]), "voronoi", **style)
