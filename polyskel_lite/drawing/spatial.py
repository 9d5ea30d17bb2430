"""Pictures in space, with matplotlib alone: triangles shaded by their normals, edges, points.

`matplotlib` has no depth buffer: it paints polygons from back to front, each collection as a whole. That is
enough for small sets and for convex or thin objects, seen from a fixed place (`VIEW`).
"""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from .lines import box_of, points_of
from .style import TEXT_WIDTH, kind_of

#: Where the camera of every 3D picture stands: elevation and azimuth, in degrees.
VIEW = {"elev": 22.0, "azim": -52.0}

#: Direction towards the light, for `draw_facets_3d`.
LIGHT = np.array([0.35, -0.6, 0.72])


def axes_3d(
    ncols: int = 1,
    nrows: int = 1,
    height: float | None = None,
    width: float = TEXT_WIDTH,
    letters: bool = False,
) -> tuple[Figure, Axes | np.ndarray]:
    """Make a figure with one or more empty 3D axes: equal scales, no frame, the camera at `VIEW`.

    Parameters and returns are those of `polyskel_lite.drawing.axes`.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, axs = drawing.axes_3d(3, letters=True)
    >>> [ax.name for ax in axs]
    ['3d', '3d', '3d']
    >>> plt.close(fig)
    """
    height = 0.95 * width / ncols * nrows if height is None else height
    # 3D axes ask the layout engine for no room; they are set side by side by hand.
    fig = plt.figure(figsize=(width, height), layout="none")
    axs = np.empty(nrows * ncols, dtype=object)
    for k in range(axs.size):
        row, col = divmod(k, ncols)
        place = (col / ncols, 1 - (row + 1) / nrows, 1 / ncols, 1 / nrows)
        ax = axs[k] = fig.add_axes(place, projection="3d", computed_zorder=False)
        ax.set_axis_off()
        ax.view_init(**VIEW)
        if letters:
            ax.text2D(0.02, 0.98, f"({chr(97 + k)})", transform=ax.transAxes, va="top")
    return fig, axs if axs.size > 1 else axs[0]


def focus_3d(ax: Axes, *things, margin: float = 0.0, zoom: float = 1.25) -> Axes:
    """Set the limits of a 3D axes to some points, with equal scales along the three axes.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    *things
        As in `polyskel_lite.drawing.box_of`.
    zoom : float
        More fills the panel more.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes_3d()
    >>> ax = drawing.focus_3d(ax, [(0, 0, 0), (1, 2, 3)])
    >>> [float(z) for z in ax.get_zlim()]
    [0.0, 3.0]
    >>> plt.close(fig)
    """
    low, high = box_of(*things, margin=margin)
    for name, a, b in zip("xyz", low, high, strict=True):
        getattr(ax, f"set_{name}lim")(a, b)
    ax.set_box_aspect(high - low, zoom=zoom)
    return ax


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
    normals = np.array([np.cross(c[1] - c[0], c[2] - c[0]) for c in corners])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True).clip(np.finfo(float).tiny)
    light = np.abs(normals @ (LIGHT / np.linalg.norm(LIGHT)))
    shade = 0.68 + 0.32 * light[:, None]
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
    look = kind_of(kind)
    points = np.asarray(points_of(points), dtype=float).reshape(-1, 3)
    options = {
        "color": look.color,
        "linestyle": "none",
        "marker": look.marker,
        "markersize": 6,
        "zorder": look.zorder,
    }
    ax.plot(*points.T, **options | style)
    return ax


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
