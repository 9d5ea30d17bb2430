"""Pictures of unions of balls in space: bubbles of glass, with the circles in which they meet."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
from matplotlib.axes import Axes
from mpl_toolkits.mplot3d.art3d import Line3DCollection

from ..errors import InputError
from .light import normals_of, view_direction
from .spatial import draw_samples_3d
from .spatial_skeletons import draw_glass


def draw_polyball_3d(
    ax: Axes,
    polyball,
    alpha: float = 0.10,
    color: str = "#6E7B85",
    circles: bool = True,
    singular: bool = True,
    fineness: float | None = None,
) -> Axes:
    """Draw a polyball in space as glass, behind and before what is inside, and set the view to it.

    Point the camera (``ax.view_init``) first: which patches are in front depends on it.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    polyball : Polyball
    alpha : float
        Opacity, as in `draw_glass`.
    color : str
    circles : bool
        Draw the arcs in which two spheres meet on the boundary; those behind are paler.
    singular : bool
        Draw the singular points.
    fineness : float, optional
        As in `polyskel_lite.polyballs.Polyball.patches`.

    Raises
    ------
    InputError
        If the polyball is in the plane (see `polyskel_lite.drawing.draw_balls`).

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes_3d()
    >>> ax = drawing.draw_polyball_3d(ax, psl.Polyball([(0, 0, 0), (1, 0, 0)], [1, 0.8]))
    >>> len(ax.collections)  # glass and circles, each behind and in front
    4
    >>> plt.close(fig)
    """
    if polyball.dimension != 3:
        raise InputError("This polyball is in the plane; draw it with draw_balls.")
    options = {} if fineness is None else {"fineness": fineness}
    vertices, triangles, ball = polyball.patches(**options)
    draw_glass(ax, SimpleNamespace(points=vertices, facets=triangles), alpha, color)
    for layer in ax.collections[-2:]:
        # On triangles that are so small and clear the seams of antialiasing are too faint to be seen.
        layer.set_antialiased(True)
    if circles:
        _draw_circles(ax, vertices, triangles, ball, color)
    if singular:
        _draw_singular(ax, polyball)
    return ax


def _draw_singular(ax: Axes, polyball) -> None:
    """Black dots before the glass; grey ones behind what is inside, where the surface faces away."""
    points = polyball.singular_points()
    gap = np.linalg.norm(points[:, None] - polyball.centers, axis=2) - polyball.radii
    through = np.abs(gap) < 1e-9 * polyball.radii
    inward = (through[:, :, None] * (polyball.centers - points[:, None])).sum(axis=1)
    behind = inward @ view_direction(ax) > 0
    draw_samples_3d(ax, points[behind], zorder=1.6, color="#9A9A9A")
    draw_samples_3d(ax, points[~behind], zorder=8)


def _draw_circles(ax: Axes, vertices, triangles, ball, color: str) -> None:
    """The edges between patches of different balls: pale where the surface there faces away."""
    edges, owner = _edges_by_side(triangles)
    rim = ball[owner[0]] != ball[owner[1]]
    away = normals_of(vertices[triangles]) @ view_direction(ax) <= 0
    behind = away[owner[0]] & away[owner[1]]
    for chosen, zorder, style in (
        (rim & behind, 1.5, {"colors": color, "alpha": 0.35}),
        (rim & ~behind, 7.5, {"colors": color, "alpha": 0.9}),
    ):
        if chosen.any():
            lines = list(vertices[edges[chosen]])
            ax.add_collection3d(Line3DCollection(lines, linewidths=0.8, zorder=zorder, **style))


def _edges_by_side(triangles) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]:
    """Edges of a closed mesh that are used once in each direction, and the triangles on both sides."""
    half = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    owner = np.repeat(np.arange(len(triangles)), 3)
    low, order = half.min(axis=1), np.lexsort((half[:, 0] > half[:, 1], half.max(axis=1), half.min(axis=1)))
    half, owner, low = half[order], owner[order], low[order]
    first = np.flatnonzero((half[:-1] == half[1:, ::-1]).all(axis=1))
    # A pair follows each edge's first direction; where more than two triangles meet, pairs do not overlap.
    first = first[half[first, 0] == low[first]]
    return half[first], (owner[first], owner[first + 1])
