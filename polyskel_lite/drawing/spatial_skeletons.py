"""Pictures in space: skeletons, their polygons and wires, inside a shape of glass (sections 3 and 4).

`matplotlib` paints collections one after the other, so that a shape around a skeleton has to be drawn in two:
`draw_glass` puts the faces that look away from the camera under the skeleton, those that look at it over it.
"""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, Normalize, to_rgb
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from ..errors import InputError
from ..skeletons import free_edges
from .light import normals_of, shades, unit, view_direction
from .lines import box_of, in_box
from .style import kind_of
from .view import focus_3d

#: Colours for numbers along a skeleton: viridis, without the yellow end that a white page swallows. It is
#: made for readers with any kind of colour vision, and turns into a grey scale in print.
RAMP = ListedColormap(plt.get_cmap("viridis")(np.linspace(0, 0.88, 256)), name="ramp")


def draw_glass(ax: Axes, mesh, alpha: float = 0.10, color: str = "#6E7B85") -> Axes:
    """Draw a closed surface of triangles as glass, behind and before what is inside, and set the view to it.

    Faces seen at a glancing angle are less clear, as in real glass, so that the outline shows. Point the
    camera (``ax.view_init``) first: which faces are in front depends on it.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    mesh : DelaunayShape, or object with ``points`` (n, 3) and ``facets`` (m, 3), outward
    alpha : float
        Opacity of a face seen squarely; at the outline it is three times as much.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import drawing
    >>> t = psl.delaunay([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    >>> fig, ax = drawing.axes_3d()
    >>> ax = drawing.draw_glass(ax, psl.DelaunayShape(t, [True]))
    >>> [len(layer.get_facecolor()) for layer in ax.collections]     # back, front
    [2, 2]
    >>> plt.close(fig)
    """
    if hasattr(mesh, "boundary"):
        points, facets = mesh.tessellation.points, mesh.boundary()
    else:
        points, facets = np.asarray(mesh.points, dtype=float), np.asarray(mesh.facets)
    corners = points[facets]
    towards = unit(normals_of(corners)) @ view_direction(ax)
    rim = (1 - np.abs(towards)) ** 3
    rgba = np.column_stack([np.tile(to_rgb(color), (len(corners), 1)), alpha * (1 + 2 * rim)])
    for layer, zorder in ((towards <= 0, 1.0), (towards > 0, 7.0)):
        faces = Poly3DCollection(
            corners[layer], facecolors=rgba[layer], edgecolors="none", zorder=zorder, antialiaseds=False
        )
        faces.set_rasterized(True)  # in a file of lines thousands of clear triangles are lighter as a picture
        ax.add_collection3d(faces)
    return focus_3d(ax, points[np.unique(facets)])


def draw_skeleton_3d(
    ax: Axes,
    skeleton,
    kind: str = "sk0",
    values=None,
    limits: tuple[float, float] | None = None,
    box=None,
    wires: str = "free",
    **style,
) -> Axes:
    """Draw a skeleton in space: polygons shaded by the direction they face, and wires.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    skeleton : Skeleton
    kind : str
        A key of `KINDS`: its colour, where `values` are not given.
    values : (k,) array, optional
        A number for each vertex, such as ``skeleton.radii``; polygons and edges take the colour of the mean
        of their vertices on `RAMP`.
    limits : (low, high), optional
        The numbers at both ends of the colours; by default the smallest and the largest.
    box : (2, 3) array, optional
        Polygons and edges with a vertex outside are left out (some Voronoi vertices are far away); by
        default the box of the samples.
    wires : "free", "all" or "none"
        Draw the edges that bound no polygon; all edges; no edge.
    **style
        For the wires (``linewidths`` ...).

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import drawing
    >>> ring = psl.delaunay([(0, 0, -1), (0, 0, 1), (1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0.1)])
    >>> skeleton = psl.sk0(psl.DelaunayShape(ring, [True] * len(ring.simplices)))
    >>> fig, ax = drawing.axes_3d()
    >>> ax = drawing.draw_skeleton_3d(ax, skeleton, values=skeleton.radii)
    >>> len(skeleton.polygons), len(ax.collections)
    (1, 1)
    >>> plt.close(fig)
    """
    if wires not in ("free", "all", "none"):
        raise InputError(f'wires is {wires!r}; choose "free", "all" or "none".')
    look, nodes = kind_of(kind), np.asarray(skeleton.vertices, dtype=float)
    if box is None and skeleton.tessellation is not None:
        box = box_of(skeleton.tessellation, margin=0.02)
    seen = np.isfinite(nodes).all(axis=1)
    if box is not None:
        seen &= in_box(nodes, box)
    colors = _colors_of(values, limits, look.color)
    cells = [p for p in skeleton.polygons if seen[p].all()]
    if cells:
        # All of one length, by repeating the last corner: matplotlib fills others up with memory that it
        # has not set, and may warn of overflow there.
        longest = max(map(len, cells))
        corners = nodes[[[*p, *[p[-1]] * (longest - len(p))] for p in cells]]
        # Newell's normal: that of the mean plane, safe for repeated vertices (cospherical samples).
        normals = np.cross(corners, np.roll(corners, -1, axis=1)).sum(axis=1)
        tint = colors(cells) * shades(normals, 0.62)
        flat = {"facecolors": tint, "edgecolors": tint * 0.75, "linewidths": 0.25, "zorder": look.zorder}
        ax.add_collection3d(Poly3DCollection(corners, **flat))
    edges = skeleton.edges[free_edges(skeleton)] if wires == "free" else skeleton.edges
    edges = edges[seen[edges].all(axis=1)]
    if wires != "none" and len(edges):
        look_of = {
            "colors": colors(edges),
            "linewidths": look.linewidth if wires == "free" else 0.3,
            "zorder": look.zorder + 0.1,
            "capstyle": "round",
        }
        ax.add_collection3d(Line3DCollection(list(nodes[edges]), **look_of | style))
    return ax


def draw_color_bar(ax: Axes, limits: tuple[float, float], label: str, **style) -> Axes:
    """Draw the scale of `RAMP` into a plain axes of its own, lying.

    Parameters
    ----------
    ax : Axes
        Two-dimensional; it is filled.
    limits : (low, high)
        As in `draw_skeleton_3d`.
    label : str

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = plt.subplots()
    >>> drawing.draw_color_bar(ax, (0, 2), "radius").get_xlabel()
    'radius'
    >>> plt.close(fig)
    """
    mappable = plt.cm.ScalarMappable(Normalize(*limits), RAMP)
    ax.figure.colorbar(mappable, cax=ax, orientation="horizontal", **style)
    ax.set_xlabel(label)
    return ax


def _colors_of(values, limits, plain: str):
    """A function from the vertices of polygons or edges to a colour for each."""
    if values is None:
        return lambda parts: np.tile(to_rgb(plain), (len(parts), 1))
    values = np.asarray(values, dtype=float)
    low, high = (values.min(), values.max()) if limits is None else limits
    scale = Normalize(low, high, clip=True)
    return lambda parts: RAMP(scale(np.array([values[vertices].mean() for vertices in parts])))[:, :3]
