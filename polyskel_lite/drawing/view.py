"""What part of the plane or of space is seen: panels side by side, the camera, limits, magnifying glasses.

A few Voronoi vertices of any boundary sampling lie thousands of times farther away than the samples, and rays
have no end at all. Pictures are therefore framed by the samples, and everything is cut to that frame before
it is drawn: a renderer that dashes a line from here to 10⁹ is slow at best.
"""

from __future__ import annotations

import string
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d import proj3d

from .lines import box_of
from .style import TEXT_WIDTH, letter_size, page_share

#: Where the camera of every 3D picture stands: elevation and azimuth, in degrees.
VIEW = {"elev": 22.0, "azim": -52.0}


def axes_3d(
    ncols: int = 1,
    nrows: int = 1,
    height: float | None = None,
    width: float = TEXT_WIDTH,
    letters: bool = False,
) -> tuple[Figure, Any]:
    """Make a figure with one or more empty 3D axes: equal scales, no frame, the camera at `VIEW`.

    Parameters and returns are those of `polyskel_lite.drawing.axes`.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, axs = drawing.axes_3d(3, letters=True)
    >>> [ax.name for ax in axs]
    ['3d', '3d', '3d']
    >>> plt.close(fig)
    """
    height = 0.95 * width / ncols * nrows if height is None else height
    fig, axs = panels([3] * (nrows * ncols), nrows, height, width)
    for letter, ax in zip(string.ascii_lowercase if letters else "", axs, strict=False):
        place = ax.get_position()  # not of the axes, which may be moved
        at = {"transform": fig.transFigure, "va": "top", "size": letter_size()}
        ax.text2D(place.x0 + 0.005, place.y1 - 0.015, f"({letter})", **at)
    return fig, axs if axs.size > 1 else axs[0]


def panels(
    dimensions, nrows: int, height: float, width: float = TEXT_WIDTH, lift: float = 0.0, **view
) -> tuple[Figure, np.ndarray]:
    """Make a figure with empty axes side by side, each flat or in space as asked for: equal scales, no frame.

    Parameters
    ----------
    dimensions : sequence of 2 and 3
        Of the axes, in reading order.
    nrows : int
    height, width : float
        Of the whole figure, in inches.
    lift : float
        Room under every row, as a share of the figure's height.
    **view
        Where the cameras stand, if not at `VIEW`.

    Returns
    -------
    fig : Figure
    axs : flat array of Axes

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, axs = drawing.panels([2, 3], nrows=1, height=2, elev=33)
    >>> [ax.name for ax in axs], axs[1].elev
    (['rectilinear', '3d'], 33)
    >>> plt.close(fig)
    """
    # 3D axes ask the layout engine for no room; they are set side by side by hand.
    size = (page_share() * width, page_share() * height)
    fig, ncols = plt.figure(figsize=size, layout="none"), len(dimensions) // nrows
    axs = np.empty(len(dimensions), dtype=object)
    for k, dimension in enumerate(dimensions):
        row, column = divmod(k, ncols)
        place = (column / ncols, 1 - (row + 1) / nrows + lift, 1 / ncols, 1 / nrows - lift)
        if dimension == 3:
            axs[k] = fig.add_axes(place, projection="3d", computed_zorder=False)
            axs[k].view_init(**VIEW | view)
            axs[k].patch.set_visible(False)  # a panel that has been moved must not cover its neighbour
        else:
            axs[k] = fig.add_axes(place, aspect="equal")
        axs[k].set_axis_off()
    return fig, axs


def focus_3d(ax: Axes, *things, margin: float = 0.0, zoom: float = 1.25) -> Axes:
    """Set the limits of a 3D axes to some points, with equal scales along the three axes.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    *things
        As in `polyskel_lite.drawing.box_of`.
    zoom : float
        More fills the panel more.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes_3d()
    >>> ax = drawing.focus_3d(ax, [(0, 0, 0), (1, 2, 3)])
    >>> [float(z) for z in ax.get_zlim()]
    [0.0, 3.0]
    >>> plt.close(fig)
    """
    low, high = box_of(*things, margin=margin)
    for name, a, b in zip("xyz", low, high, strict=True):
        getattr(ax, f"set_{name}lim")(a, b)
    ax.set_box_aspect(high - low, zoom=zoom)
    return ax


def fill_panel(ax: Axes, points, share: float = 0.96) -> Axes:
    """Move and enlarge what a 3D axes shows until some points fill the place that the axes has in its figure.

    Point the camera and set the limits (`focus_3d`) first.

    Parameters
    ----------
    ax : Axes
        Three-dimensional, with all that it shows. It becomes a square, moved so that the points are in the
        middle of its old place.
    points : (n, 3) array
    share : float
        Of the width or the height of the place, whichever is filled first.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes_3d()
    >>> corners = [(0, 0, 0), (1, 2, 3), (4, 0, 1)]
    >>> ax = drawing.fill_panel(drawing.focus_3d(ax, corners), corners, share=0.9)
    >>> low, high = seen_between(ax, corners)
    >>> round(float(((high - low) / fig.get_size_inches()).max()), 2)
    0.9
    >>> plt.close(fig)
    """
    size = ax.figure.get_size_inches()
    place = ax.get_position(original=True).get_points() * size
    middle, side = place.mean(axis=0), (place[1] - place[0]).min()
    ax.set_position([*((middle - side / 2) / size), *(side / size)])
    box = np.ptp([ax.get_xlim(), ax.get_ylim(), ax.get_zlim()], axis=1)
    zoom = 1.0
    for _ in range(4):  # what is nearer grows faster, so that once is not enough
        ax.set_box_aspect(box, zoom=zoom)
        low, high = seen_between(ax, points)
        zoom *= share * ((place[1] - place[0]) / (high - low)).min()
    corner = middle - side / 2 + middle - (low + high) / 2
    ax.set_position([*(corner / size), *(side / size)])
    for artist in ax.get_children():
        artist.set_clip_on(False)  # the place may be longer than the square
    return ax


def seen_between(ax: Axes, points) -> tuple[np.ndarray, np.ndarray]:
    """Lower left and upper right corner of points as a 3D axes shows them, in inches of its figure."""
    ax.apply_aspect()
    x, y, _ = proj3d.proj_transform(*np.asarray(points, dtype=float).T, ax.get_proj())
    seen = ax.transData.transform(np.column_stack([x, y])) / ax.figure.dpi
    return seen.min(axis=0), seen.max(axis=0)


def focus(ax: Axes, *things, margin: float = 0.05) -> Axes:
    """Set the limits of an axes to some points: to a whole object, or to a detail.

    Parameters
    ----------
    ax : Axes
    *things
        As in `box_of`; two opposite corners will do.
    margin : float
        Share of the longest side left free on every side.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes()
    >>> ax = drawing.focus(ax, [(0, 0), (2, 1)], margin=0)
    >>> [float(x) for x in ax.get_xlim()], [float(y) for y in ax.get_ylim()]
    ([0.0, 2.0], [0.0, 1.0])
    >>> plt.close(fig)
    """
    low, high = box_of(*things, margin=margin)
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
    return ax


def inset(ax: Axes, box, place=(0.62, 0.62, 0.38, 0.38)) -> Axes:
    """Open a magnifying glass on a detail: a framed axes inside `ax`, to be drawn into like any other.

    Parameters
    ----------
    ax : Axes
        The picture; it gets a thin frame around the detail.
    box : (2, 2) array
        Lower left and upper right corner of the detail, in data coordinates.
    place : tuple of float
        Left, bottom, width, height of the glass, as shares of `ax`.

    Returns
    -------
    Axes
        The new axes (the one function here that does not return the axes it was given).

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes()
    >>> glass = drawing.inset(drawing.focus(ax, [(0, 0), (8, 6)]), [(1, 1), (2, 2)])
    >>> glass in ax.child_axes
    True
    >>> plt.close(fig)
    """
    glass = ax.inset_axes(place, xticks=[], yticks=[])
    glass.set_aspect("equal", adjustable="datalim")
    focus(glass, box, margin=0)
    glass.set_autoscale_on(False)
    for spine in glass.spines.values():
        spine.set(visible=True, color="#666666", linewidth=0.8)
    ax.indicate_inset_zoom(glass, edgecolor="#666666", alpha=1, linewidth=0.8)
    return glass
