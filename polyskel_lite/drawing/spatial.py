"""Pictures in space, with matplotlib alone: triangles shaded by their normals, edges, points.

`matplotlib` has no depth buffer: it paints polygons from back to front, each collection as a whole. That is
enough for small sets and for convex or thin objects, seen from a fixed place (`VIEW`).
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from .light import normals_of, shades
from .lines import points_of
from .planar import draw_samples
from .style import kind_of
from .view import focus_3d


def draw_facets_3d(
    ax: Axes, points, facets, kind: str = "shape", alpha: float = 1.0, edges: bool = True, **style
) -> Axes:
    """Draw triangles (or other planar polygons) in space, each shaded by the direction it faces.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    points : (n, 3) array, or an object that has ``points``
    facets : (m, 3) int array, or list of int arrays
        Vertex indices. Both sides are lit alike, so that orientation does not matter.
    kind : str
        A key of `KINDS`: its colour is shaded (or the one given as `color`).
    alpha : float
        Opacity.
    edges : bool
        Draw the facets' edges as thin lines.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes_3d()
    >>> ax = drawing.draw_facets_3d(ax, [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3)])
    >>> len(ax.collections[0].get_facecolor())
    2
    >>> plt.close(fig)
    """
    look = kind_of(kind)
    points = np.asarray(points_of(points), dtype=float)
    corners = [points[np.asarray(facet, dtype=int)] for facet in facets]
    if not corners:
        return ax
    shade = shades(normals_of([polygon[:3] for polygon in corners]), 0.68)
    # In space the light tint of the plane looks dirty once shaded; a third of the full colour keeps it clear.
    mixed = 0.65 * np.array(to_rgb(look.fill or look.color)) + 0.35 * np.array(to_rgb(look.color))
    tint = np.array(to_rgb(style.pop("color", tuple(mixed))))
    faces = np.column_stack([shade * tint, np.full(len(corners), alpha)])
    options = {
        "facecolors": faces,
        "edgecolors": look.color if edges else "none",
        "linewidths": 0.5 if edges else 0,
        "zorder": look.zorder,
    }
    ax.add_collection3d(Poly3DCollection(corners, **options | style))
    return ax


def draw_lines_3d(ax: Axes, segments, kind: str = "delaunay", **style) -> Axes:
    """Draw segments in space in the style of a kind.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    segments : (m, 2, 3) array

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes_3d()
    >>> ax = drawing.draw_lines_3d(ax, [[(0, 0, 0), (1, 1, 1)]])
    >>> len(ax.collections)
    1
    >>> plt.close(fig)
    """
    look = kind_of(kind)
    if len(segments) == 0:
        return ax
    options = {
        "colors": look.color,
        "linewidths": look.linewidth,
        "linestyles": [look.linestyle],
        "zorder": look.zorder,
    }
    ax.add_collection3d(Line3DCollection(list(segments), **options | style))
    return ax


def draw_samples_3d(ax: Axes, points, kind: str = "samples", **style) -> Axes:
    """Draw points in space as dots, those behind as clear as those in front.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    points : (n, 3) array, or an object that has ``points``

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes_3d()
    >>> ax = drawing.draw_samples_3d(ax, [(0, 0, 0), (1, 1, 1)])
    >>> len(ax.lines)
    1
    >>> plt.close(fig)
    """
    return draw_samples(ax, points, kind, **{"markersize": 6, "markeredgewidth": None} | style)


def draw_mesh(ax: Axes, mesh, kind: str = "shape", alpha: float = 1.0, **style) -> Axes:
    """Draw a closed surface of triangles, and set the view to it.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    mesh : object with ``points`` (n, 3) and ``facets`` (m, 3)

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from types import SimpleNamespace
    >>> from polyskel_lite import drawing
    >>> points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> mesh = SimpleNamespace(points=points, facets=[(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    >>> fig, ax = drawing.axes_3d()
    >>> len(drawing.draw_mesh(ax, mesh).collections)
    1
    >>> plt.close(fig)
    """
    draw_facets_3d(ax, mesh.points, mesh.facets, kind=kind, alpha=alpha, **{"linewidths": 0.2} | style)
    return focus_3d(ax, mesh.points)
