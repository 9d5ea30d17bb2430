"""Figures of the paper's sections 1 and 2: maximal balls, and the three neighbourhood graphs in 2D and 3D."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from .. import datasets, drawing
from ..containment import delaunay_shape
from ..graphs import delaunay, gabriel
from ..skeletons import sk0, voronoi
from .registry import paper_figure


@paper_figure
def figure_1(shape=None, n: int = 400, balls: int = 7) -> Figure:
    """Figure 1: maximal balls and one that is not, on a shape.

    Section 1 and section 2.1 of the paper.

    Parameters
    ----------
    shape : Shape, optional
        By default the horse. Its boundary must be in Del(E) when sampled with `n` points.
    n : int
        Number of samples from which the skeleton is computed.
    balls : int
        How many maximal balls to show: the largest ones that do not overlap.

    Returns
    -------
    Figure

    Raises
    ------
    ContourContainmentError
        If the sampling is too sparse for the shape.

    Notes
    -----
    The balls drawn are Delaunay balls of the samples; they are maximal up to the width of a line.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import figures
    >>> plt.close(figures.figure_1())
    """
    shape = datasets.load("horse") if shape is None else shape
    skeleton = sk0(delaunay_shape(shape.resample(n)))
    fig, ax = drawing.axes(height=5.6)
    drawing.draw_shape(ax, shape)
    drawing.draw_skeleton(ax, skeleton, linewidth=0.9)
    chosen = _disjoint(skeleton.vertices, skeleton.radii, balls)
    for k in chosen:
        drawing.draw_ball(ax, skeleton.vertices[k], skeleton.radii[k], skeleton.contacts(k))
    center, radius, contact = _smaller_ball(skeleton, chosen[0])
    other = {"edgecolor": "#000000", "facecolor": "#FFFFFF", "linestyle": (0, (3, 1.5)), "zorder": 1.8}
    drawing.draw_ball(ax, center, radius, [contact], **other)
    dashed = Line2D([], [], color="#000000", linestyle=(0, (3, 1.5)), linewidth=1, label="not maximal")
    drawing.legend(ax, "shape", "balls", dashed, "sk0", labels={"balls": "maximal balls", "sk0": "skeleton"})
    return fig


def _disjoint(centers: np.ndarray, radii: np.ndarray, count: int) -> list[int]:
    """Indices of the largest balls that keep a little apart from each other, largest first."""
    chosen: list[int] = []
    for k in np.argsort(-radii, kind="stable"):
        gaps = np.linalg.norm(centers[chosen] - centers[k], axis=1) - radii[chosen] - radii[k]
        if (gaps > 0.02 * radii.max()).all():
            chosen.append(int(k))
        if len(chosen) == count:
            break
    return chosen


def _smaller_ball(skeleton, k: int, share: float = 0.42):
    """A ball inside ball `k` that touches it, and the boundary, at one of its contact points."""
    center, radius, contacts = skeleton.vertices[k], skeleton.radii[k], skeleton.contacts(k)
    # The contact nearest to a diagonal leaves the small ball clear of the spokes of the large one.
    contact = contacts[np.argmax(np.abs(np.sin(2 * np.arctan2(*(contacts - center).T))))]
    return contact + share * (center - contact), share * radius, contact


#: Sample points of figure 2: irregular, with no four on a circle.
POINTS_2D = np.array(
    [
        *[(3.3, 8.9), (9.1, 1.2), (1.3, 2.6), (6.0, 5.3), (9.7, 4.9), (1.8, 6.6), (4.4, 0.2), (3.3, 4.1)],
        *[(8.0, 7.6), (0.6, 0.1), (7.7, 3.6), (5.5, 2.7), (0.2, 4.7), (4.4, 6.9), (6.3, 9.3)],
    ]
)
#: Sample points of figure 2 in space: one point between six others, near the corners of an octahedron.
POINTS_3D = np.array(
    [
        *[(0.05, -0.02, 0.08), (1.1, 0.1, -0.1), (-0.95, 0.15, 0.1), (0.1, 1.05, 0.15)],
        *[(-0.1, -1.1, -0.05), (0.12, -0.1, 1.0), (-0.05, 0.12, -1.05)],
    ]
)


@paper_figure
def figure_2(points=None) -> Figure:
    """Figure 2: Voronoi graph, Delaunay triangulation and Gabriel graph of points in the plane.

    Section 2.2 of the paper.

    Parameters
    ----------
    points : (n, 2) array, optional
        By default fifteen scattered points.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import figures
    >>> plt.close(figures.figure_2([(0, 0), (2, 0), (0, 1), (3, 3), (1, 2)]))
    """
    tessellation = delaunay(POINTS_2D if points is None else points)
    points = tessellation.points
    kept = gabriel(tessellation)
    fig, (a, b, c) = drawing.axes(3, height=2.75, letters=True)
    drawing.draw_voronoi(a, voronoi(tessellation))
    drawing.draw_delaunay(b, tessellation)
    drawing.draw_delaunay(c, tessellation, linewidth=0.5)
    drawing.draw_gabriel(c, points, kept)
    edges = {tuple(sorted(edge)) for edge in tessellation.edges().tolist()}
    dropped = sorted(edges - {tuple(sorted(edge)) for edge in kept.tolist()})
    _show_gabriel_rule(c, points, np.array(sorted(kept.tolist())), np.array(dropped))
    for ax in (a, b, c):
        drawing.draw_samples(ax, points, markersize=5)
        drawing.focus(ax, points, margin=0.08)
    for ax, name in ((a, "voronoi"), (b, "delaunay"), (c, "gabriel")):
        drawing.legend(ax, name)
    return fig


def _show_gabriel_rule(ax, points: np.ndarray, kept: np.ndarray, dropped: np.ndarray) -> None:
    """Two diametral disks: of the most central dropped edge, and of the longest kept edge clear of it."""
    if len(dropped) == 0:
        return
    middles, lengths = _middles_and_lengths(points, dropped)
    k = int(np.argmin(np.linalg.norm(middles - points.mean(axis=0), axis=1)))
    middle, radius = middles[k], lengths[k] / 2
    drawing.draw_lines(ax, [points[dropped[k]]], "delaunay", linewidth=1.8)
    _disk(ax, middle, radius, "#8C8C8C")
    middles, lengths = _middles_and_lengths(points, kept)
    clear = np.linalg.norm(middles - middle, axis=1) > 1.05 * (lengths / 2 + radius)
    if clear.any():
        k = int(np.argmax(np.where(clear, lengths, 0)))
        _disk(ax, middles[k], lengths[k] / 2, "#009E73")


def _middles_and_lengths(points: np.ndarray, edges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    ends = points[edges]
    return ends.mean(axis=1), np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)


def _disk(ax, center, radius, color: str) -> None:
    """A pale disk with a thin outline, under the edges."""
    drawing.draw_balls(
        ax, [center], [radius], facecolor=color + "2A", edgecolor=color, linewidth=0.8, zorder=1.2
    )


@paper_figure
def figure_2_3d(points=None) -> Figure:
    """Figure 2 in space: Voronoi graph, Delaunay tessellation and Gabriel graph of points.

    Section 2.2 of the paper, which shows the plane only.

    Parameters
    ----------
    points : (n, 3) array, optional
        By default seven points, the first one in the middle of the others; its region is filled.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import figures
    >>> plt.close(figures.figure_2_3d())
    """
    tessellation = delaunay(POINTS_3D if points is None else points)
    points, graph = tessellation.points, voronoi(tessellation)
    # A Voronoi polygon bounds the first region where all its tetrahedra have point 0 as a corner.
    has_first = (tessellation.simplices[graph.simplices] == 0).any(axis=1)
    cell = [k for k, polygon in enumerate(graph.polygons) if has_first[polygon].all()]
    fig, (a, b, c) = drawing.axes_3d(3, height=2.6, letters=True)
    drawing.draw_voronoi_3d(a, graph, box=drawing.box_of(points, margin=0.1), polygons=cell, alpha=0.6)
    drawing.draw_tessellation_3d(b, tessellation, spread=0.9, alpha=0.8)
    drawing.draw_lines_3d(c, points[tessellation.edges()], "delaunay")
    drawing.draw_facets_3d(c, points, gabriel(tessellation), kind="gabriel", alpha=0.92)
    for ax in (a, c):
        drawing.draw_samples_3d(ax, points)
    for ax in (a, b, c):
        drawing.focus_3d(ax, points, margin=0.3 if ax is b else 0.0, zoom=1.35 if ax is b else 1.15)
    return fig
