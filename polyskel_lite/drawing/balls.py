"""Pictures of balls in the plane: unions without seams, and single balls with centre and contact points."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.patches import Circle, PathPatch
from matplotlib.path import Path

from ..errors import InputError
from ..polyballs import Polyball
from .planar import draw_samples
from .style import kind_of


def draw_balls(
    ax: Axes, centers, radii=None, union: bool = True, outlines: bool = False, kind: str = "balls", **style
) -> Axes:
    """Draw a union of disks as one area with one outline, each circle too if wanted.

    All circles go into one path: filled by the nonzero rule its inside is exactly the union, so that no seam
    shows even where the filling is translucent. The outline is made of the arcs of the union's boundary.

    Parameters
    ----------
    ax : Axes
    centers : Polyball, or (k, 2) array
    radii : (k,) array, optional
        Only with an array of centres.
    union : bool
        Fill the union and outline it.
    outlines : bool
        Draw every circle as a thin line.

    Raises
    ------
    InputError
        If there are not as many radii as centres, or the balls are not in the plane.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes()
    >>> ax = drawing.draw_balls(ax, [(0, 0), (1, 0)], [1, 0.6], outlines=True)
    >>> len(ax.patches), len(ax.collections[0].get_paths())
    (2, 2)
    >>> plt.close(fig)
    """
    look = kind_of(kind)
    if radii is None:
        centers, radii = getattr(centers, "centers", centers), getattr(centers, "radii", None)
    centers, radii = np.asarray(centers, dtype=float), np.asarray(radii, dtype=float)
    if centers.ndim != 2 or centers.shape[1] != 2 or radii.shape != centers.shape[:1]:
        raise InputError(
            f"Balls in the plane need centres (k, 2) and radii (k,); got {centers.shape} and {radii.shape}."
        )
    if union and len(radii):
        path = Path.make_compound_path(*(Path.circle(c, r) for c, r in zip(centers, radii, strict=True)))
        zorder = style.pop("zorder", look.zorder)
        line = {"edgecolor": style.pop("edgecolor", look.color), "linestyle": style.pop("linestyle", "-")}
        line["linewidth"] = style.pop("linewidth", look.linewidth)
        fill = {"facecolor": look.fill, "edgecolor": "none", "linewidth": 0} | style
        ax.add_patch(PathPatch(path, zorder=zorder, **fill))
        ax.add_patch(PathPatch(_outline(centers, radii), facecolor="none", zorder=zorder + 0.02, **line))
    if outlines:
        circles = [Circle(tuple(c), r) for c, r in zip(centers, radii, strict=True)]
        thin = {"facecolor": "none", "edgecolor": look.color, "linewidth": 0.25}
        ax.add_collection(PatchCollection(circles, zorder=look.zorder + 0.01, **thin))
    ax.autoscale_view()
    return ax


def _outline(centers: np.ndarray, radii: np.ndarray) -> Path:
    """The boundary of a union of disks, as one path of circular arcs."""
    arcs = Polyball(centers, radii).arcs()
    pieces = []
    for k, start, end in zip(*arcs, strict=True):
        unit = Path.arc(*np.degrees([start, end]))
        pieces.append(Path(centers[k] + radii[k] * unit.vertices, unit.codes))
    return Path.make_compound_path(*pieces)


def draw_ball(
    ax: Axes, center, radius: float, contacts=None, fill: bool = True, kind: str = "balls", **style
) -> Axes:
    """Draw one disk with its centre, and the points where it touches a boundary.

    Parameters
    ----------
    ax : Axes
    center : (2,) array
    radius : float
    contacts : (c, 2) array, optional
        Drawn as black dots, and joined to the centre by thin lines.
    fill : bool
        Tint the disk.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes()
    >>> ax = drawing.draw_ball(ax, (0, 0), 1, contacts=[(1, 0), (-1, 0)])
    >>> len(ax.patches), len(ax.collections[0].get_segments())
    (1, 2)
    >>> plt.close(fig)
    """
    look = kind_of(kind)
    options = {
        "facecolor": look.fill if fill else "none",
        "edgecolor": look.color,
        "linewidth": look.linewidth,
        "zorder": look.zorder,
    } | style
    ax.add_patch(Circle(tuple(center), radius, **options))
    above, color = options["zorder"] + 5, options["edgecolor"]
    draw_samples(ax, [center], marker="o", markersize=3.2, color=color, zorder=above)
    if contacts is not None:
        contacts = np.asarray(contacts, dtype=float).reshape(-1, 2)
        spokes = np.stack([np.broadcast_to(center, contacts.shape), contacts], axis=1)
        ax.add_collection(
            LineCollection(spokes, colors=color, linewidths=0.7, linestyles=":", zorder=above - 1)
        )
        draw_samples(ax, contacts, zorder=above, markersize=5)
    ax.autoscale_view()
    return ax
