"""Figures 8 and 9: simplified skeletons at several thresholds, and what their criterion measures."""

from __future__ import annotations

import itertools
from fractions import Fraction

import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from scipy.spatial import cKDTree

from .. import datasets, drawing
from ..containment import DelaunayShape
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
        drawing.say(ax, f"$\\beta_0$ = {angle(threshold)}")
        drawing.draw_shape(ax, outline, linewidth=0.5)
        drawing.draw_skeleton(ax, h.skeleton(threshold), kind="sk0", linewidth=0.9)
    drawing.draw_shape(axs[4], outline, linewidth=0.5, facecolor="none")
    pile = []
    for k, threshold in enumerate(thresholds):
        # Later ones are parts of the earlier ones and are drawn over them, darker and broader.
        color = PILE(k / (len(thresholds) - 1))
        drawing.draw_skeleton(
            axs[4], h.skeleton(threshold), color=color, linewidth=0.9 + 0.6 * k, zorder=4 + 0.1 * k
        )
        pile.append(Line2D([], [], color=color, linewidth=0.9 + 0.6 * k, label=angle(threshold)))
        simplified = h.shape(threshold).to_shape()
        drawing.draw_shape(axs[5], simplified, facecolor=color, linewidth=0.5, zorder=1 + 0.1 * k)
    for ax in axs:
        drawing.focus(ax, outline, margin=0.02)
    fig.legend(handles=pile, loc="lower center", ncols=len(pile), title=None)
    return fig


def angle(radians: float) -> str:
    """An angle in words of π where it is a simple fraction of it, else as a number.

    Examples
    --------
    >>> [angle(x) for x in (0.0, np.pi / 2, np.pi, 2 * np.pi, 1.0)]
    ['0', 'π/2', 'π', '2π', '1']
    """
    turns = Fraction(radians / np.pi).limit_denominator(12)
    if turns == 0 or abs(float(turns) * np.pi - radians) > 1e-9:
        return f"{radians:.3g}"
    above = "" if turns.numerator == 1 else str(turns.numerator)
    return f"{above}π" + ("" if turns.denominator == 1 else f"/{turns.denominator}")


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
    members = t.points[t.simplices[rows]]
    v, r = skeleton.vertices[vertex], skeleton.radii[vertex]
    box = drawing.box_of(members.reshape(-1, 2), [v - r, v + r], margin=0.03)
    away = np.sign(v - members.mean(axis=(0, 1)))[0]  # some more of the shape, on the side of v
    box[0 if away < 0 else 1, 0] += 0.3 * away * (box[1] - box[0])[0]
    long, high = box[1] - box[0]
    fig, ax = drawing.axes(height=7.0 * high / long + 0.1, under=0.05)
    drawing.draw_delaunay(ax, h.P, edges=False)
    for triangle in members:
        drawing.draw_shape(
            ax, [triangle], facecolor="#BDBDBD", edgecolor="#8C8C8C", linewidth=0.6, zorder=2.2
        )
    inside = np.append(h.P.inner, False)
    open_sides = [(row, i) for row in rows for i in np.flatnonzero(~inside[t.neighbors[row]])]
    rim = np.array([t.points[np.delete(t.simplices[row], i)] for row, i in open_sides])
    drawing.draw_lines(ax, rim, "shape", linewidth=2.6, color="#000000", zorder=4.5)
    drawing.draw_skeleton(ax, skeleton, kind="sk0", linewidth=1.3)
    circle = {"fill": False, "linestyle": (0, (3, 1.5)), "zorder": 5}
    drawing.draw_ball(ax, v, r, **circle)
    toward = members[-1][0]
    drawing.draw_lines(ax, [[v, toward]], "balls", linestyle=(0, (3, 1.5)), zorder=5)
    drawing.focus(ax, box, margin=0)
    turn = np.linspace(0, 2 * np.pi, 100)
    rings = [v + r * np.column_stack([np.cos(turn), np.sin(turn)])]
    sides = t.points[t.edges()]
    drawn = _dots([*sides, *skeleton.segments(), *rim, *rings, (v, toward)])
    grid = np.stack(np.meshgrid(*(np.linspace(low, high, 120) for low, high in box.T)), axis=-1).reshape(
        -1, 2
    )
    within = h.P.to_shape().contains(grid)
    part = np.isin(np.arange(len(t.simplices)), rows)
    gray = DelaunayShape(t, part).to_shape().contains(grid)
    for word, near, reach in (("$v$", v, 0.3), ("$r(v)$", (v + toward) / 2, 0.3)):
        close = grid[np.linalg.norm(grid - near, axis=1) < reach * r]
        _write(ax, word, close, drawn)
    _write(ax, "$A(v)$", grid[gray], drawn)
    (x0, y0), (x1, y1) = box
    frame = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)])
    beside = np.linalg.norm(grid[:, None] - _dots(rim)[::5], axis=2).min(axis=1) < 0.25 * r
    _write(ax, "$p(v)$", grid[beside & ~within], np.concatenate([drawn, _dots([frame])]))
    return fig


def _dots(lines) -> np.ndarray:
    """Points along some lines."""
    share = np.linspace(0, 1, 30)[:, None]
    return np.concatenate([a + share * (b - a) for line in lines for a, b in itertools.pairwise(line)])


def _write(ax, word: str, places: np.ndarray, dots: np.ndarray) -> None:
    """Write a word at that one of some places that is farthest from all that is drawn."""
    far, _ = cKDTree(dots).query(places)
    ax.text(*places[np.argmax(far)], word, ha="center", va="center", fontsize="x-large", zorder=9)
