"""Figure 10, the results in space (the paper's section 4.3)."""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from .. import datasets, drawing
from ..containment import DelaunayShape, delaunay_shape
from ..simplification import hierarchy
from ..skeletons import branch_graph, sk0
from .registry import paper_figure

#: From where each shape is seen: arguments of ``view_init``.
CAMERAS = {
    "fourbranch": {"elev": 66, "azim": -30},  # all four arms, none of them shorter than 86 % of its length
    "chromosome": {"elev": 15, "azim": 18, "vertical_axis": "y"},
    "vertebra": {"elev": 28, "azim": -52},
}
#: How the end of a branch is marked.
RING = {"color": "none", "markeredgecolor": "#000000", "markeredgewidth": 0.9}
#: Names of the rows, in the paper's order.
ROWS = (
    "shape",
    "samples",
    "$Sk_0$",
    "surface\n" r"$\alpha_0 = \pi/3$",
    "wireframe\n" r"$\beta_0 = 2\pi$",
)


@paper_figure
def figure_10(shapes: Mapping[str, DelaunayShape] | None = None) -> Figure:
    """Figure 10: three solids, their samples, Sk0, a surface skeleton and a wireframe skeleton of each.

    Section 4.3 of the paper.

    Parameters
    ----------
    shapes : mapping of DelaunayShape or Shape in 3D, optional
        One column each; by default the shapes of `polyskel_lite.datasets` that have the paper's numbers of
        samples: 1191, 2290 and 2011.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import figures
    >>> t = psl.delaunay(np.random.default_rng(0).random((40, 3)))
    >>> plt.close(figures.figure_10({"a box": psl.DelaunayShape(t, np.ones(len(t.simplices), dtype=bool))}))
    """
    if shapes is None:
        shapes = {name: datasets.load(name) for name in CAMERAS}
    n = len(shapes)
    fig, axs = drawing.axes_3d(n, 5, height=10.0)
    grid = np.reshape(axs, (5, n))
    line = plt.rcParams["font.size"] / 72  # room for names of rows and columns, and for numbers and colours
    (left, over), (_, under) = 3 * line / fig.get_size_inches(), 6 * line / fig.get_size_inches()
    low, high = under, 1 - over
    for row, column in np.ndindex(grid.shape):
        width, height = (1 - left) / n, (high - low) / 5
        place = (left + column * width, high - (row + 1) * height, width, height)
        grid[row, column].set_position(place)
    for column, (name, shape) in enumerate(shapes.items()):
        P = shape if isinstance(shape, DelaunayShape) else delaunay_shape(shape)
        for ax in grid[:, column]:
            ax.view_init(**CAMERAS.get(name, drawing.VIEW))
        branches = _column(grid[:, column], P)
        outline = P.tessellation.points[np.unique(P.boundary())]
        for ax in grid[:, column]:
            drawing.focus_3d(ax, outline)
            drawing.fill_panel(ax, outline, share=0.97)
        middle = left + (column + 0.5) * (1 - left) / n
        _write(grid[0, column], middle, 0.998, f"{name}\n{len(outline)} samples", va="top")
        _write(grid[4, column], middle, 0.99 * under, f"{branches} branches", va="top")
    for row, (letter, name) in enumerate(zip("abcde", ROWS, strict=True)):
        top = high - row * (high - low) / 5
        _write(grid[row, 0], 0.006, top, f"({letter})", va="top", size=drawing.letter_size())
        _write(grid[row, 0], 0.006, top - (high - low) / 10, name, va="center", rotation=90)
    scale = fig.add_axes((0.3, 0.58 * under, 0.4, 0.1 * under))
    words = "radius of the ball, in % of the largest in (e)"
    drawing.draw_color_bar(scale, (0, 100), words, ticks=[0, 50, 100])
    scale.tick_params(pad=1, length=2)
    return fig


def _write(ax, x: float, y: float, words: str, **style) -> None:
    """Write at a place of the figure, whichever panel it is."""
    ha = "left" if x < 0.1 else "center"
    ax.text2D(x, y, words, transform=ax.figure.transFigure, ha=ha, ma="center", **style)


def _column(axs, P: DelaunayShape) -> int:
    """The five pictures of one solid, from top to bottom; returns the number of branches found."""
    points, facets = P.tessellation.points, P.boundary()
    drawing.draw_facets_3d(axs[0], points, facets, color="#CDD3D8", linewidths=0.12)
    # Samples on the far side would show through: only those with a face towards the camera.
    near = np.unique(facets[drawing.normals_of(points[facets]) @ drawing.view_direction(axs[1]) > 0])
    drawing.draw_samples_3d(axs[1], points[near], markersize=0.9)
    whole = sk0(P)
    surface = hierarchy(P, "surface").skeleton(np.pi / 3)
    wires = hierarchy(P, "wireframe").skeleton(2 * np.pi)
    drawing.draw_facets_3d(axs[1], points, facets, color="#F2F2F2", edges=False)
    limits = (0.0, float(np.max(wires.radii)))
    for ax, skeleton in zip(axs[2:], (whole, surface, wires), strict=True):
        drawing.draw_glass(ax, P)
        drawing.draw_skeleton_3d(ax, skeleton, values=skeleton.radii, limits=limits)
    for ax in axs:
        for layer in ax.collections:
            layer.set_rasterized(len(layer.get_facecolor()) > 200)  # in files of lines: a picture
    graph = branch_graph(wires)
    ends = [v for v, kind in graph.nodes(data="kind") if kind == "end"]
    drawing.draw_samples_3d(axs[4], wires.vertices[ends], marker="o", markersize=4, zorder=9, **RING)
    return graph.graph["branches"]
