"""What part of the plane or of space is seen: boxes, clipping, zoom; and edges chained into long lines.

A few Voronoi vertices of any boundary sampling lie thousands of times farther away than the samples, and rays
have no end at all. Pictures are therefore framed by the samples, and everything is cut to that frame before
it is drawn: a renderer that dashes a line from here to 10⁹ is slow at best.
"""

from __future__ import annotations

from matplotlib.axes import Axes

from .lines import box_of


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
