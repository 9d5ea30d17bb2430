"""Figure 13, the two steps of the proof of Theorem 1 (the paper's Appendix B)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .. import drawing
from ..errors import InputError
from ..graphs import delaunay, gabriel
from .registry import paper_figure

#: Points of figure 13a: triangle 0, 1, 2 is obtuse at 0, and Delaunay edges part it from its circumcentre.
POINTS_A = np.array(
    [
        *[(0.08, 1.0), (-0.56, 0.84), (0.62, 0.79), (-1.02, 0.4), (1.05, 0.3)],
        *[(-0.9, -1.15), (0.8, -1.2), (-1.35, 1.05), (1.3, 0.95)],
    ]
)
#: Points of figure 13b: the corners of a polygon with all its edges in the Gabriel graph; ab is 0-1.
POINTS_B = np.array([(0.0, 1.0), (0.1, -1.0), (-1.9, -0.55), (-1.75, 0.8), (1.8, -0.75), (1.9, 0.6)])


@paper_figure
def figure_13(points_a=None, points_b=None) -> Figure:
    """Figure 13: the path from a circumcentre to its triangle, and the quadrilateral around a Voronoi edge.

    Appendix B of the paper.

    Parameters
    ----------
    points_a : (n, 2) array, optional
        Points 0, 1, 2 are a, b, c: a Delaunay triangle whose circumcentre lies across the line bc.
    points_b : (n, 2) array, optional
        The corners of a convex polygon; points 0 and 1 are a and b, a Delaunay edge inside it.

    Returns
    -------
    Figure

    Raises
    ------
    InputError
        If the points do not have the property asked for.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import figures
    >>> plt.close(figures.figure_13())
    """
    fig, (left, right) = drawing.axes(2, height=3.6, letters=True)
    _path_to_circumcentre(left, POINTS_A if points_a is None else np.asarray(points_a, dtype=float))
    _quadrilateral(right, POINTS_B if points_b is None else np.asarray(points_b, dtype=float))
    return fig


def crossed_edges(tessellation, triangle: int, corner: int) -> list[tuple[int, int, np.ndarray]]:
    """The Delaunay edges that the segment from a triangle's circumcentre to one of its corners crosses.

    Parameters
    ----------
    tessellation : Tessellation
        With N = 2.
    triangle : int
        Index of the triangle.
    corner : int
        Index of the sample.

    Returns
    -------
    list of (e0, e1, m)
        Both ends of the edge and the crossing point, nearest to the corner first.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> from polyskel_lite.figures.proof import crossed_edges
    >>> t = psl.delaunay([(0, 1), (-3, 0), (3, 0), (0, -30)])
    >>> flat = [set(s) == {0, 1, 2} for s in t.simplices.tolist()].index(True)
    >>> [(e0, e1, m.tolist()) for e0, e1, m in crossed_edges(t, flat, 0)]
    [(1, 2, [0.0, 0.0])]
    """
    a, v = tessellation.points[corner], tessellation.circumcenters[triangle]
    found = []
    for e0, e1 in tessellation.edges().tolist():
        p, q = tessellation.points[[e0, e1]]
        matrix = np.column_stack([v - a, p - q])
        if corner in (e0, e1) or np.linalg.det(matrix) == 0:
            continue
        share, along = np.linalg.solve(matrix, p - a)
        if 0 < share < 1 and 0 <= along <= 1:
            found.append((share, e0, e1, a + share * (v - a)))
    return [(e0, e1, m) for _, e0, e1, m in sorted(found, key=lambda crossing: crossing[0])]


def _path_to_circumcentre(ax: Axes, points: np.ndarray) -> None:
    """Panel (a)."""
    tessellation = delaunay(points)
    triangle = [set(simplex) == {0, 1, 2} for simplex in tessellation.simplices.tolist()]
    crossed = crossed_edges(tessellation, triangle.index(True), 0) if any(triangle) else []
    if not crossed:
        raise InputError(
            "Figure 13a needs 0, 1, 2 to be a Delaunay triangle with its circumcentre across the side 1-2."
        )
    v = tessellation.circumcenters[triangle.index(True)]
    e0, e1, m = crossed[-1]
    p, q = sorted(points[[e0, e1]].tolist())
    drawing.draw_delaunay(ax, tessellation, inner=triangle, linewidth=0.8)
    radius = float(np.linalg.norm(np.subtract(p, q))) / 2
    grey = {"facecolor": "#8C8C8C30", "edgecolor": "#8C8C8C", "linewidth": 1.2, "zorder": 1.2}
    drawing.draw_balls(ax, [np.add(p, q) / 2], [radius], **grey)
    circle = {"edgecolor": "#000000", "linestyle": ":", "zorder": 1.3}
    drawing.draw_ball(ax, v, float(np.linalg.norm(v - points[0])), fill=False, **circle)
    drawing.draw_lines(ax, [[p, q]], "delaunay", linewidth=2.4, zorder=3)
    drawing.draw_lines(ax, [[v, points[0]]], "sk0", linestyle=(0, (3, 1.5)), zorder=4)
    drawing.draw_samples(ax, points, markersize=6)
    drawing.draw_samples(ax, [v, m], kind="sk0", marker="o", markersize=5, zorder=8)
    center = points.mean(axis=0)
    for name, at in (("a", points[0]), ("b", points[1]), ("c", points[2]), ("e_0", p), ("e_1", q)):
        _name(ax, name, at, np.subtract(at, center))
    _name(ax, "m", m, (1, -1))
    _name(ax, "v", v, (0, -1))
    drawing.focus(ax, points, [np.add(p, q) / 2 + radius, np.add(p, q) / 2 - radius], margin=0.05)


def _quadrilateral(ax: Axes, points: np.ndarray) -> None:
    """Panel (b)."""
    tessellation = delaunay(points)
    facets, sides = tessellation.facet_table
    middle = [set(facet) == {0, 1} for facet in facets.tolist()]
    hull = {tuple(sorted(facet)) for facet in facets[(sides < 0).any(axis=1)].tolist()}
    kept = {tuple(sorted(edge)) for edge in gabriel(tessellation).tolist()}
    if True not in middle or (sides[middle.index(True)] < 0).any() or not hull <= kept:
        raise InputError(
            "Figure 13b needs a convex polygon in its Gabriel graph with 0-1 a Delaunay edge inside it."
        )
    v, w = sorted(tessellation.circumcenters[sides[middle.index(True)]].tolist())
    a, b = points[0], points[1]
    order = np.argsort(np.arctan2(*(points - points.mean(axis=0)).T[::-1]))
    drawing.draw_shape(ax, points[order], linewidth=2)
    drawing.draw_lines(ax, points[tessellation.edges()], "delaunay", linewidth=0.8)
    drawing.draw_shape(ax, [np.array([v, a, w, b])], kind="delaunay", edgecolor="#0072B2", linewidth=1)
    drawing.draw_lines(ax, [[a, b]], "delaunay", linewidth=2.4, zorder=3)
    drawing.draw_lines(ax, [[v, w]], "sk0", zorder=4)
    drawing.draw_samples(ax, points, markersize=6)
    drawing.draw_samples(ax, [v, w], kind="sk0", marker="o", markersize=5, zorder=8)
    for name, at, away in (("a", a, a - b), ("b", b, b - a), ("v", v, (-1, 0)), ("v'", w, (1, 0))):
        _name(ax, name, at, away)
    drawing.focus(ax, points, margin=0.08)


def _name(ax: Axes, name: str, at, away) -> None:
    """Write a letter beside a point, on the side `away` points to."""
    away = np.asarray(away, dtype=float)
    shift = 9 * away / np.linalg.norm(away)
    ax.annotate(
        f"${name}$", at, shift, textcoords="offset points", ha="center", va="center", fontsize=11, zorder=9
    )
