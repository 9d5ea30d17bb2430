"""One picture for whatever there is: the drawing that fits the type of a thing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from ..errors import InputError
from .balls import draw_balls
from .counts import draw_branch_counts
from .graphs import draw_delaunay, draw_skeleton
from .planar import draw_shape
from .spatial import draw_mesh
from .spatial_balls import draw_polyball_3d
from .spatial_graphs import draw_tessellation_3d
from .spatial_skeletons import draw_glass, draw_skeleton_3d
from .style import axes
from .view import axes_3d


def plot(thing: Any, ax: Axes | None = None, **style) -> Axes:
    """Draw a thing of the library, in axes of its own where none are given.

    Parameters
    ----------
    thing : Shape, Tessellation, DelaunayShape, Skeleton, Hierarchy, Polyball, Bones or BranchCounts
        Bones are drawn as their skeleton in their shape, a hierarchy as the whole skeleton in the shape.
    ax : Axes, optional
        In space three-dimensional ones.
    **style
        For the function that draws it, such as ``color`` or ``linewidth``.

    Returns
    -------
    Axes

    Raises
    ------
    InputError
        If there is no drawing for such a thing.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import drawing
    >>> ax = drawing.plot(psl.skeleton([[(0, 0), (20, 0), (20, 4), (0, 4)]]))
    >>> len(ax.patches), len(ax.collections)
    (1, 1)
    >>> plt.close(ax.figure)
    """
    whole = inner = None
    if hasattr(thing, "hierarchy"):
        whole, inner = thing.given, thing.skeleton
    elif hasattr(thing, "level"):
        whole, inner = thing.P.to_shape(), thing.skeleton(float("-inf"))
    if whole is not None:
        ax = _axes(whole) if ax is None else ax
        (draw_shape if whole.dimension == 2 else draw_glass)(ax, whole)
        return plot(inner, ax, **style)
    if hasattr(thing, "counts"):
        return draw_branch_counts(plt.subplots()[1] if ax is None else ax, thing, **style)
    kinds = [kind.__name__ for kind in type(thing).__mro__ if kind.__name__ in _DRAWINGS]
    if not kinds:
        raise InputError(
            f"there is no drawing for a {type(thing).__name__}; pass a Shape, or what is made of it."
        )
    draw = _DRAWINGS[kinds[0]][thing.dimension - 2]
    return draw(_axes(thing) if ax is None else ax, thing, **style)


def _axes(thing: Any) -> Axes:
    return (axes() if thing.dimension == 2 else axes_3d())[1]


# By name: what draws imports no shape.
_DRAWINGS: dict[str, tuple[Callable[..., Axes], Callable[..., Axes]]] = {
    "Polyball": (draw_balls, draw_polyball_3d),
    "Skeleton": (draw_skeleton, draw_skeleton_3d),
    "Tessellation": (draw_delaunay, draw_tessellation_3d),
    "DelaunayShape": (draw_delaunay, draw_glass),
    "Shape": (draw_shape, draw_mesh),
}
