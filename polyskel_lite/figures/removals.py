"""Figures 6 and 7: which simplices can be removed, and what goes with them (the paper's section 4.2)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .. import drawing
from ..containment import DelaunayShape, delaunay_shape
from ..errors import InputError
from ..shapes import Shape
from ..simplification import simplices_by_type
from ..skeletons import sk0
from .registry import paper_figure
from .solids import REST, THIS, draw_apart, draw_solid, helix, lens, moved_apart, orange, simplex_of, star

#: A polygon with all kinds of triangles, for figures 6 and 7: three arms around a middle.
POLYGON = np.array(
    [
        *[(0.75, 0.3), (0.75, 1.4), (-0.2, 2.2), (-0.62, 0.5), (-1.7, 0.1), (-2.3, -1.1), (0.05, -0.6)],
        *[(1.1, -1.5), (2.4, -0.9)],
    ]
)
OCTAHEDRON = np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], dtype=float)


def examples_6() -> list[tuple[DelaunayShape, int]]:
    """The regions of figure 6, each with the simplex in question: three that can go, three that cannot.

    Examples
    --------
    >>> [P.dimension for P, _ in examples_6()]
    [2, 3, 3, 2, 3, 3]
    """
    polygon = delaunay_shape(Shape.from_rings([POLYGON]))
    kinds = simplices_by_type(polygon)
    row, book, ring = helix(3), orange(3, of=5), orange(5)
    ball = star(OCTAHEDRON, (2, 3, 6))
    return [
        (polygon, int(np.flatnonzero(kinds == 1)[0])),
        (row, simplex_of(row, (2, 3, 4, 5))),
        (ring, simplex_of(ring, (0, 1, 5, 6))),
        (polygon, int(np.flatnonzero(kinds == 2)[0])),
        (book, simplex_of(book, (0, 1, 3, 4))),
        (ball, simplex_of(ball, (0, 1, 4, 5))),
    ]


def _letter(ax: Axes, k: int, place: tuple[float, float], words: str = "") -> None:
    """Write (a), (b) ... and some words at a place of the figure."""
    write = ax.text2D if ax.name == "3d" else ax.text
    size, at = drawing.letter_size(), {"transform": ax.figure.transFigure, "va": "top"}
    beside = 2.2 * size / 72 / ax.figure.get_size_inches()[0]
    write(*place, f"({chr(97 + k)})", size=size, **at)
    write(place[0] + beside, place[1], words, **at)


@paper_figure
def figure_6(examples=None) -> Figure:
    """Figure 6: simplices classified, three kinds that can be removed and three that cannot.

    Section 4.2 of the paper.

    Parameters
    ----------
    examples : list of six (DelaunayShape, int), optional
        Regions, each with the row of a simplex; by default `examples_6`.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import figures
    >>> plt.close(figures.figure_6())
    """
    examples = examples_6() if examples is None else examples
    if len(examples) != 6:
        raise InputError(f"Figure 6 has six panels; got {len(examples)} examples.")
    words = ("hat triangle", "hat tetrahedron", "salient", "cuts", "cuts", "opens a tunnel")
    fig, axs = drawing.panels([P.dimension for P, _ in examples], 2, 4.4, lift=0.01, elev=33)
    for k, (ax, (P, this)) in enumerate(zip(axs, examples, strict=True)):
        if P.dimension == 2:
            _classified_triangle(ax, P, this)
        else:
            _pieces(ax, P, this)
        _letter(ax, k, (k % 3 / 3 + 0.01, 0.985 - k // 3 / 2), words[k])
    return fig


def _pieces(ax: Axes, P: DelaunayShape, this: int) -> None:
    """The tetrahedra of a region moved apart; where one plugs a tunnel we look along it, through the plug."""
    rows, spread, alpha = np.flatnonzero(P.inner), 0.9, 0.95
    if simplices_by_type(P)[this] == 3:
        corners = P.tessellation.points[P.tessellation.simplices[rows]]
        x, y, z = corners[rows == this].mean(axis=(0, 1)) - corners.mean(axis=(0, 1))
        ax.view_init(elev=np.degrees(np.arctan2(z, np.hypot(x, y))), azim=np.degrees(np.arctan2(y, x)))
        spread, alpha = 0.6, np.where(rows == this, 0.3, 0.95)
    draw_apart(ax, P, this, spread, alpha=alpha)
    drawing.fill_panel(ax, moved_apart(P, spread).reshape(-1, 3), share=0.78)


def _classified_triangle(ax: Axes, P: DelaunayShape, this: int) -> None:
    """The triangles of a region moved apart, one of them in blue, the sides it shares in pale red."""
    t = P.tessellation
    corners = t.points[t.simplices]
    middles = corners.mean(axis=1, keepdims=True)
    corners = corners + 0.14 * (middles - middles[P.inner].mean(axis=0))
    for row in np.flatnonzero(P.inner):
        fill = THIS if row == this else REST
        drawing.draw_shape(ax, [corners[row]], facecolor=fill, linewidth=0.6)
    for i in np.flatnonzero(np.append(P.inner, False)[t.neighbors[this]]):
        side = np.delete(corners[this], i, axis=0)
        drawing.draw_lines(ax, [side], "delaunay", color="#E8B08A", linewidth=4, zorder=3)
    drawing.focus(ax, corners[P.inner].reshape(-1, 2), margin=0.09)


def examples_7() -> list[tuple[DelaunayShape, int]]:
    """The regions of figure 7, each with the simplex that goes: hat triangle, hat and salient tetrahedron.

    Examples
    --------
    >>> [len(sk0(P).polygons) for P, _ in examples_7()]
    [0, 0, 2]
    """
    polygon = delaunay_shape(Shape.from_rings([POLYGON]))
    row, sheet = helix(5), lens()
    return [
        (polygon, simplex_of(polygon, (0, 7, 8))),
        (row, simplex_of(row, (0, 1, 2, 3))),
        (sheet, simplex_of(sheet, (0, 1, 6, 7))),
    ]


@paper_figure
def figure_7(examples=None) -> Figure:
    """Figure 7: what the removal of a hat triangle, a hat and a salient tetrahedron does to the skeleton.

    Section 4.2 of the paper.

    Parameters
    ----------
    examples : list of (DelaunayShape, int), optional
        Regions, each with the row of the simplex to be removed; by default `examples_7`.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import figures
    >>> plt.close(figures.figure_7())
    """
    examples = examples_7() if examples is None else examples
    fig, axs = drawing.panels([P.dimension for P, _ in examples] * 2, 2, 4.2, elev=50)
    for k, (P, this) in enumerate(examples):
        without = P.inner.copy()
        without[this] = False
        for ax, inner in ((axs[k], P.inner), (axs[len(examples) + k], without)):
            Q = DelaunayShape(P.tessellation, inner)
            if P.dimension == 3:
                draw_solid(ax, Q, alpha=0.25)
                drawing.focus_3d(ax, P.tessellation.points)
                drawing.fill_panel(ax, P.tessellation.points, share=0.86)
            else:
                drawing.draw_delaunay(ax, Q, edges=False)
                drawing.draw_skeleton(ax, sk0(Q), kind="sk0", linewidth=2.2)
                drawing.draw_samples(ax, sk0(Q).vertices, kind="sk0", marker="o", markersize=5)
                drawing.focus(ax, P.tessellation.points, margin=0.08)
            mark = P.tessellation.simplices[this]
            if inner is P.inner:
                _mark(ax, P.tessellation.points[mark])
        _letter(axs[k], k, ((k + 0.06) / len(examples), 0.985))
    for y, word in ((0.75, "before"), (0.25, "after")):
        fig.text(0.006, y, word, rotation=90, va="center")
    return fig


def _mark(ax: Axes, corners: np.ndarray) -> None:
    """Outline a simplex."""
    pairs = np.array([(i, j) for i in range(len(corners)) for j in range(i)])
    if corners.shape[1] == 2:
        drawing.draw_shape(ax, [corners], facecolor=THIS, edgecolor="#0072B2", linewidth=1.8, zorder=2.5)
    else:
        drawing.draw_lines_3d(
            ax, corners[pairs], "delaunay", colors="#0072B2", linewidths=1.8, linestyles="-", zorder=7
        )
