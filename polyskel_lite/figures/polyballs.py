"""Figures of appendix A: unions of balls in the plane and in space, with their skeletons."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from .. import drawing
from ..errors import InputError
from ..exact import components
from ..polyballs import Polyball
from ..skeletons import free_edges
from .registry import paper_figure

#: Fill of the one ball that a panel is about.
SHOWN = "#F2D64B"

#: Default of figure 11: a body with three arms, and a disc apart from it.
CENTERS_11 = np.array(
    [(0.75, 0.1), (-0.55, 0.72), (-0.4, -0.8), (2.0, 0.35), (2.85, 1.0), (-1.6, 1.35), (3.0, -0.95)]
)
RADII_11 = np.array([1.0, 0.95, 1.02, 0.8, 0.55, 0.6, 0.6])


#: From where a panel of figure 12 is seen, if not as all others are: on its sheet, and not along it.
CAMERAS_12 = {4: {"elev": 40, "azim": -38}}


def examples_12() -> list[Polyball]:
    """Default of figure 12: two balls, three, a row, a ring with one apart, a heap, a cage.

    Examples
    --------
    >>> [Y.skeleton().betti() for Y in examples_12()]
    [(1, 0, 0), (1, 0, 0), (1, 0, 0), (2, 1, 0), (1, 0, 0), (1, 0, 1)]
    """
    turn = np.arange(8) * np.pi / 4
    ring = 1.5 * np.column_stack([np.cos(turn), np.sin(turn), np.zeros(8)])
    golden = (1 + 5**0.5) / 2
    corners = [(0, a, b * golden) for a in (-1, 1) for b in (-1, 1)]
    cage = np.concatenate([np.roll(corners, k, axis=1) for k in range(3)]) / np.hypot(1, golden)
    heap = [(0, 0, 0), (1.3, 0, 0), (0.65, 1.1, 0), (1.95, 1.1, 0), (1.75, -0.95, 0), (0.2, 2.05, 0)]
    return [
        Polyball([(0, 0, 0), (1.3, 0, 0)], [1, 0.8]),
        Polyball([(0, 0, 0), (1.3, 0, 0), (0.65, 1.1, 0)], [1, 0.9, 1]),
        Polyball([(0, 0, 0), (0.6, 0, 0), (1.2, 0, 0), (1.9, 0.1, 0)], [1, 1.02, 1, 0.8]),
        Polyball(np.concatenate([ring, [(3.1, 0, 0)]]), np.append(np.full(8, 0.72), 0.5)),
        Polyball(heap, [0.9, 0.9, 0.9, 0.9, 0.55, 0.55]),
        Polyball(cage, np.full(12, 0.72)),
    ]


def contacts(polyball: Polyball, center, radius: float) -> tuple[np.ndarray, np.ndarray]:
    """Where a maximal ball of a planar polyball touches the boundary: singular points, and whole arcs.

    Parameters
    ----------
    polyball : Polyball
        In the plane.
    center : (2,) array
    radius : float

    Returns
    -------
    points : (c, 2) float array
        Singular points on its circle.
    arcs : (a, 2) float array
        Start and end, in radians, of the boundary arcs that lie on its circle.

    Examples
    --------
    >>> Y = Polyball([(0, 0), (1, 0)], [1, 1])
    >>> points, arcs = contacts(Y, (0, 0), 1.0)
    >>> len(points), np.degrees(arcs).round().tolist()
    (2, [[60.0, 300.0]])
    """
    singular, near = polyball.singular_points(), 1e-9 * radius
    on = np.abs(np.linalg.norm(singular - center, axis=1) - radius) < near
    ball, start, end = polyball.arcs()
    same = np.linalg.norm(polyball.centers[ball] - center, axis=1) + np.abs(polyball.radii[ball] - radius)
    arcs = np.column_stack([start, end])[same < near]
    return singular[on], arcs


def kinds_of_balls(polyball: Polyball) -> list[tuple[np.ndarray, float] | None]:
    """One maximal ball of each kind that the proof of Theorem 3 tells apart, the largest there is.

    Of those stopped by two singular points it is the smallest: it is seen apart from the others.

    Parameters
    ----------
    polyball : Polyball
        In the plane, without tangent discs.

    Returns
    -------
    list of four (center, radius), or None where there is none
        Stopped by two singular points; by three or more; a generating ball that meets others; one that does
        not.

    Examples
    --------
    Two crossing discs have no ball with three contacts, and none that is alone:

    >>> [ball is not None for ball in kinds_of_balls(Polyball([(0, 0), (1, 0)], [1, 1]))]
    [True, False, True, False]
    """
    skeleton = polyball.skeleton()
    found: list[list[tuple[np.ndarray, float]]] = [[], [], [], []]
    middles = skeleton.segments().mean(axis=1)
    for center, radius in zip(middles, polyball.boundary_distance(middles), strict=True):
        found[0].append((center, float(radius)))
    for center, radius in zip(skeleton.vertices, skeleton.radii, strict=True):
        points, arcs = contacts(polyball, center, radius)
        kind = 3 if not len(points) else 2 if len(arcs) else 1 if len(points) > 2 else 0
        found[kind].append((center, float(radius)))
    pick = (min, max, max, max)
    return [
        choose(balls, key=lambda ball: ball[1]) if balls else None
        for choose, balls in zip(pick, found, strict=True)
    ]


@paper_figure
def figure_11(polyball=None) -> Figure:
    """Figure 11: a planar polyball, its skeleton, and a maximal ball of each kind.

    Appendix A of the paper; the panels are the cases of the proof of Theorem 3.

    Parameters
    ----------
    polyball : Polyball, optional
        In the plane. By default a body with three arms, and a disc apart from it.

    Returns
    -------
    Figure
        Four panels. A panel shows no ball if the polyball has none of its kind.

    Raises
    ------
    InputError
        If the polyball is not in the plane.
    TangentBallsError
        If two of its balls touch without crossing.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import figures
    >>> plt.close(figures.figure_11())
    """
    polyball = Polyball(CENTERS_11, RADII_11) if polyball is None else polyball
    if polyball.dimension != 2:
        raise InputError("Figure 11 is about polyballs in the plane; figure 12 shows one in space.")
    skeleton, singular = polyball.skeleton(), polyball.singular_points()
    fig, axs = drawing.axes(2, 2, height=5.3, letters=True)
    for ax, ball in zip(axs, kinds_of_balls(polyball), strict=True):
        drawing.draw_balls(ax, polyball)
        if ball is not None:
            _maximal(ax, polyball, *ball)
        drawing.draw_skeleton(ax, skeleton)
        lone = np.setdiff1d(np.arange(len(skeleton.vertices)), skeleton.edges)
        drawing.draw_samples(ax, skeleton.vertices[lone], kind="sk0", marker="o", markersize=4)
        drawing.draw_samples(ax, singular, markersize=6)
        drawing.focus(
            ax, polyball.centers - polyball.radii[:, None], polyball.centers + polyball.radii[:, None]
        )
    maximal = Patch(facecolor=SHOWN, edgecolor="#000000", linestyle="--", label="maximal ball")
    points = Line2D(
        [], [], color="#000000", linestyle="none", marker=".", markersize=6, label="singular points"
    )
    fig.legend(
        handles=[drawing.handle("balls", "polyball"), maximal, drawing.handle("sk0", "skeleton"), points],
        loc="lower center",
        ncols=2 if fig.get_size_inches()[0] < 5 else 4,
    )
    return fig


def _maximal(ax, polyball: Polyball, center, radius: float) -> None:
    """One ball with its centre, spokes to its contact points, and its contact arcs drawn thick."""
    points, arcs = contacts(polyball, center, radius)
    style = {"facecolor": SHOWN, "edgecolor": "#000000", "linestyle": (0, (3, 1.5)), "zorder": 1.8}
    drawing.draw_ball(ax, center, radius, points, **style)
    for start, end in arcs:
        turn = np.linspace(start, end, 100)
        rim = center + radius * np.column_stack([np.cos(turn), np.sin(turn)])
        drawing.draw_lines(ax, [rim], "samples", linestyle="-", linewidth=2.6, zorder=5)


@paper_figure
def figure_12(polyballs=None) -> Figure:
    """Figure 12: polyballs in space with their skeletons.

    Appendix A of the paper.

    Parameters
    ----------
    polyballs : sequence of up to six Polyballs, optional
        In space. By default those of `examples_12`.

    Returns
    -------
    Figure
        One panel for each.

    Raises
    ------
    InputError
        If there are none or more than six, or one is not in space.
    TangentBallsError
        If two balls of one of them touch without crossing.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import Polyball, figures
    >>> plt.close(figures.figure_12([Polyball([(0, 0, 0), (1, 0, 0)], [1, 1])]))
    """
    polyballs = examples_12() if polyballs is None else list(polyballs)
    if not 1 <= len(polyballs) <= 6 or any(Y.dimension != 3 for Y in polyballs):
        raise InputError("Figure 12 shows one to six polyballs in space.")
    columns = min(3, len(polyballs))
    rows = -(-len(polyballs) // columns)
    fig, axs = drawing.axes_3d(columns, rows, height=2.35 * rows, letters=True)
    for k, (ax, polyball) in enumerate(zip(np.atleast_1d(axs), polyballs, strict=False)):
        ax.view_init(**drawing.VIEW | CAMERAS_12.get(k, {}))
        # Many dots and circles, some of them in a hollow, hide the skeleton.
        few = len(polyball.singular_points()) <= 12
        hollow = polyball.skeleton().betti()[2] > 0
        draw_with_skeleton(ax, polyball, window=hollow, singular=few, circles=few)
        drawing.fill_panel(ax, polyball.patches()[0], share=0.92)
    return fig


def draw_with_skeleton(ax, polyball: Polyball, window: bool = False, **glass):
    """A polyball in space as glass with its skeleton inside: polygons with their sides, lines, lone points.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    polyball : Polyball
    window : bool
        Leave out the polygons in front, all but their sides, so that the hollow of a closed skeleton is seen.
    **glass
        Handed on to `polyskel_lite.drawing.draw_polyball_3d`.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> fig, ax = drawing.axes_3d()
    >>> ax = draw_with_skeleton(ax, Polyball([(0, 0, 0)], [1]))
    >>> plt.close(fig)
    """
    skeleton = polyball.skeleton()
    drawing.draw_polyball_3d(ax, polyball, **glass)
    polygons = list(skeleton.polygons)
    if window:
        up, turn = np.radians([ax.elev, ax.azim])
        depth = skeleton.vertices @ [np.cos(up) * np.cos(turn), np.cos(up) * np.sin(turn), np.sin(up)]
        front = [polygon for polygon in polygons if depth[polygon].mean() > depth.mean()]
        polygons = [polygon for polygon in polygons if depth[polygon].mean() <= depth.mean()]
        drawing.draw_facets_3d(ax, *_enclosed(polyball), color="#AEB8BF", edges=False, zorder=4.2)
        sides = [skeleton.vertices[[*polygon, polygon[0]]] for polygon in front]
        drawing.draw_lines_3d(ax, sides, "sk0", linewidths=0.9, zorder=4.4)
    drawing.draw_facets_3d(ax, skeleton.vertices, polygons, kind="sk0", color="#E98B4E", edges=True, zorder=4)
    drawing.draw_lines_3d(ax, skeleton.segments()[free_edges(skeleton)], "sk0", linewidths=2.2, zorder=4.5)
    lone = np.setdiff1d(np.arange(len(skeleton.vertices)), skeleton.edges)
    drawing.draw_samples_3d(ax, skeleton.vertices[lone], kind="sk0", marker="o", markersize=5, zorder=5)
    return ax


def _enclosed(polyball: Polyball) -> tuple[np.ndarray, np.ndarray]:
    """The parts of the boundary that others enclose: points, and triangles. The highest point is of none."""
    vertices, triangles, _ = polyball.patches()
    # Patches have points of their own: those at one place are one, for this purpose.
    _, place = np.unique(vertices.round(9), axis=0, return_inverse=True)
    label = components(place.max() + 1, place[triangles[:, [0, 1, 1, 2]]].reshape(-1, 2))[1][place]
    return vertices, triangles[label[triangles[:, 0]] != label[vertices[:, 2].argmax()]]
