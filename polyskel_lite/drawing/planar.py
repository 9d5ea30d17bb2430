"""Pictures in the plane: shapes, samples, lines.

Every function takes an axes first and the data second, adds to the axes, and returns it. Keyword arguments
(``color``, ``linewidth`` ...) go to matplotlib and win over the style of the kind.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from .lines import points_of
from .style import CORE, kind_of


def draw_shape(ax: Axes, shape, fill: bool = True, kind: str = "shape", **style) -> Axes:
    """Draw a shape: its boundary as a line, its interior in a light tint, its holes left open.

    Parameters
    ----------
    ax : Axes
    shape : Shape, or list of (k, 2) arrays, or one (k, 2) array
        Outer rings counterclockwise, holes clockwise (a `Shape` has them so); implicitly closed.
    fill : bool
        Tint the interior.
    kind : str
        A key of `KINDS`.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes()
    >>> ax = drawing.draw_shape(ax, [[(0, 0), (3, 0), (0, 3)], [(0.5, 0.5), (0.5, 1), (1, 0.5)]])
    >>> len(ax.patches)
    1
    >>> plt.close(fig)
    """
    look = kind_of(kind)
    rings = [np.asarray(ring, dtype=float) for ring in _rings(shape)]
    path = Path.make_compound_path(*(Path(np.vstack([ring, ring[:1]]), closed=True) for ring in rings))
    options = {
        "facecolor": look.fill if fill else "none",
        "edgecolor": look.color,
        "linewidth": look.linewidth,
        "linestyle": look.linestyle,
        "zorder": look.zorder,
        "joinstyle": "round",
    }
    ax.add_patch(PathPatch(path, **options | style))
    ax.autoscale_view()
    return ax


def _rings(shape) -> list:
    """The coordinates of each ring of a shape, a list of rings, or a single ring."""
    if hasattr(shape, "rings"):
        return [shape.points[ring] for ring in shape.rings()]
    single = np.ndim(shape[0][0]) == 0
    return [shape] if single else list(shape)


def draw_samples(ax: Axes, points, kind: str = "samples", **style) -> Axes:
    """Draw points as dots.

    Parameters
    ----------
    ax : Axes
        Of the plane, or three-dimensional.
    points : (n, 2) or (n, 3) array, or an object that has ``points``

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes()
    >>> ax = drawing.draw_samples(ax, [(0, 0), (1, 0), (0, 1)])
    >>> len(ax.lines[0].get_xdata())
    3
    >>> plt.close(fig)
    """
    look = kind_of(kind)
    points = np.asarray(points_of(points), dtype=float).reshape(-1, 3 if ax.name == "3d" else 2)
    options = {
        "color": look.color,
        "linestyle": "none",
        "marker": look.marker,
        "markersize": look.markersize,
        "markeredgewidth": 0,
        "zorder": look.zorder,
    }
    ax.plot(*points.T, **options | style)
    return ax


def draw_lines(ax: Axes, lines, kind: str, **style) -> Axes:
    """Draw segments or longer paths in the style of a kind.

    Parameters
    ----------
    ax : Axes
    lines : (m, 2, 2) array, or list of (k, 2) arrays
    kind : str
        A key of `KINDS`.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes()
    >>> ax = drawing.draw_lines(ax, [[(0, 0), (1, 0)], [(0, 1), (1, 1), (2, 2)]], "gabriel")
    >>> len(ax.collections[0].get_segments())
    2
    >>> plt.close(fig)
    """
    look = kind_of(kind)
    if len(lines) == 0:
        return ax
    options = {
        "colors": style.pop("color", look.color),
        "linestyles": style.pop("linestyle", [look.linestyle]),
        "linewidths": style.pop("linewidth", look.linewidth),
        "zorder": look.zorder,
        "joinstyle": "round",
    }
    options |= style
    ax.add_collection(LineCollection(list(lines), **options))
    if look.core:  # over all of them, so that a double line runs on where lines meet
        core = {"colors": look.core, "linewidths": CORE * options["linewidths"]}
        ax.add_collection(LineCollection(list(lines), **options | core))
    ax.autoscale_view()
    return ax
