"""Figures 8 and 9: simplified skeletons at several thresholds, and what their criterion measures."""

from __future__ import annotations

import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

from .. import datasets, drawing
from ..simplification import behind, hierarchy
from ..skeletons import sk0
from .registry import paper_figure

#: Pale for what goes first, dark for what stays longest.
PILE = LinearSegmentedColormap.from_list("pile", ["#F7CFA5", "#EE9A4D", "#C2561A", "#5A2208"])


@paper_figure
def figure_8(shape=None, thresholds=(0.0, np.pi / 2, np.pi, 2 * np.pi)) -> Figure:
    """Figure 8: simplified skeletons of a shape at four thresholds, and skeletons and shapes piled up.

    Sections 4.1 and 4.3 of the paper.

    Parameters
    ----------
    shape : Shape or DelaunayShape, optional
        By default the leaf of 1308 points.
    thresholds : four floats
        Angles in radians, increasing.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import figures
    >>> plt.close(figures.figure_8(thresholds=(0, 1, 2, 3)))
    """
    shape = datasets.load("leaf") if shape is None else shape
    h = hierarchy(shape, strategy="branch")
    outline = h.P.to_shape()
    fig, axs = drawing.axes(2, 3, height=7.0, letters=True)
    for ax, threshold in zip(axs, thresholds, strict=False):
        drawing.draw_shape(ax, outline, linewidth=0.5)
        drawing.draw_skeleton(ax, h.skeleton(threshold), kind="sk0", linewidth=0.9)
    drawing.draw_shape(axs[4], outline, linewidth=0.5, facecolor="none")
    for k, threshold in enumerate(thresholds):
        # Later ones are parts of the earlier ones and are drawn over them, darker and broader.
        color = PILE(k / (len(thresholds) - 1))
        drawing.draw_skeleton(
            axs[4], h.skeleton(threshold), color=color, linewidth=0.9 + 0.6 * k, zorder=4 + 0.1 * k
        )
        simplified = h.shape(threshold).to_shape()
        drawing.draw_shape(axs[5], simplified, facecolor=color, linewidth=0.5, zorder=1 + 0.1 * k)
    for ax in axs:
        drawing.focus(ax, outline, margin=0.02)
    return fig


@paper_figure
def figure_9(shape=None, near=(0.19, 0.19)) -> Figure:
    """Figure 9: the triangles A(v) that must go before the Voronoi vertex v can.

    Section 4.3 of the paper.

    Parameters
    ----------
    shape : Shape or DelaunayShape, optional
        By default the horse through 160 samples.
    near : pair of floats
        The vertex v is the one nearest to this place.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import figures
    >>> plt.close(figures.figure_9())
    """
    shape = datasets.load("horse", n=160) if shape is None else shape
    h = hierarchy(shape, strategy="branch")
    t, skeleton = h.P.tessellation, sk0(h.P)
    vertex = int(np.argmin(np.linalg.norm(skeleton.vertices - np.asarray(near, dtype=float), axis=1)))
    rows = h.simplices[behind(h, vertex)]
    fig, ax = drawing.axes(height=4.4)
    drawing.draw_delaunay(ax, h.P, edges=False)
    for triangle in t.points[t.simplices[rows]]:
        drawing.draw_shape(
            ax, [triangle], facecolor="#BDBDBD", edgecolor="#8C8C8C", linewidth=0.6, zorder=2.2
        )
    inside = np.append(h.P.inner, False)
    for row in rows:
        for i in np.flatnonzero(~inside[t.neighbors[row]]):
            side = t.points[np.delete(t.simplices[row], i)]
            drawing.draw_lines(ax, [side], "shape", linewidth=2.6, color="#000000", zorder=4.5)
    drawing.draw_skeleton(ax, skeleton, kind="sk0", linewidth=1.3)
    circle = {"fill": False, "linestyle": (0, (3, 1.5)), "zorder": 5}
    drawing.draw_ball(ax, skeleton.vertices[vertex], skeleton.radii[vertex], **circle)
    v = skeleton.vertices[vertex]
    toward = t.points[t.simplices[rows[-1]][0]]
    drawing.draw_lines(ax, [[v, toward]], "balls", linestyle=(0, (3, 1.5)), zorder=5)
    gray = t.points[t.simplices[rows]].mean(axis=1)
    drawing.focus(ax, t.points[t.simplices[rows]].reshape(-1, 2), margin=0.45)
    for word, at, shift in (
        ("$v$", v, (-10, 0)),
        ("$r(v)$", (v + toward) / 2, (0, 8)),
        ("$A(v)$", gray[np.argmin(np.linalg.norm(gray - gray.mean(axis=0), axis=1))], (0, 0)),
    ):
        ax.annotate(
            word, at, shift, textcoords="offset points", ha="center", va="center", fontsize=12, zorder=9
        )
    return fig
