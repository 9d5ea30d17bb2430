"""Figure 10, the results in space (the paper's section 4.3)."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure

from .. import datasets, drawing
from ..containment import DelaunayShape, delaunay_shape
from ..simplification import hierarchy
from ..skeletons import branch_graph, sk0
from .registry import paper_figure

#: From where each shape is seen, and how much it is enlarged: arguments of ``view_init``, and zoom.
CAMERAS = {
    "fourbranch": ({"elev": 22, "azim": -52}, 1.18),
    "chromosome": ({"elev": 15, "azim": 18, "vertical_axis": "y"}, 0.88),
    "vertebra": ({"elev": 28, "azim": -52}, 1.04),
}


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
    fig, axs = drawing.axes_3d(n, 5, height=9.8)
    grid = np.reshape(axs, (5, n))
    for column, (name, shape) in enumerate(shapes.items()):
        view, zoom = CAMERAS.get(name, (drawing.VIEW, 1.3))
        P = shape if isinstance(shape, DelaunayShape) else delaunay_shape(shape)
        for ax in grid[:, column]:
            ax.view_init(**view)
        branches = _column(grid[:, column], P)
        for ax in grid[:, column]:
            drawing.focus_3d(ax, P.tessellation.points[np.unique(P.boundary())], zoom=zoom)
        heading = f"{name}, {len(np.unique(P.boundary()))} samples"
        grid[0, column].text2D(0.5, 1.0, heading, transform=grid[0, column].transAxes, ha="center", va="top")
        found = f"{branches} branches"
        grid[4, column].text2D(0.5, 0.0, found, transform=grid[4, column].transAxes, ha="center", va="bottom")
    for letter, ax in zip("abcde", grid[:, 0], strict=True):
        ax.text2D(0.0, 0.5, f"({letter})", transform=ax.transAxes, va="top")
    return fig


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
    return branch_graph(wires).graph["branches"]
