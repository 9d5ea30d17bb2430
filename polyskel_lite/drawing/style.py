"""One colour and one line pattern for every kind of object, the same in every picture of the book.

The colours are those of Okabe and Ito, a palette made for readers with any kind of colour vision, with an
indigo of Tol's for the eighth line; a test holds them apart as seen with each kind of colour blindness.
Because a colour is lost on a grey printer, each kind also has its own line pattern or marker.

References
----------
M. Okabe, K. Ito, "Color universal design: how to make figures and presentations that are friendly to
colorblind people", 2008.
"""

from __future__ import annotations

import string
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..errors import InputError

#: Width of the book's text column, in inches: every figure is made for it, so that nothing is rescaled.
TEXT_WIDTH = 7.0

#: Settings of matplotlib for all pictures of the book (see `setup`).
RC = {
    "figure.dpi": 120,
    "savefig.dpi": 200,
    "savefig.bbox": "tight",
    "savefig.pad_inches": 0.02,
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.labelsize": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.fontsize": 9,
    "legend.frameon": False,
    "legend.handlelength": 2.8,
    "lines.dash_capstyle": "butt",
    "lines.solid_capstyle": "round",
    "mathtext.fontset": "dejavusans",
    "pdf.fonttype": 42,  # letters stay letters: searchable, and editable by the reader
    "svg.fonttype": "path",
    "svg.hashsalt": "polyskel_lite",  # the same picture gives the same file
}


@dataclass(frozen=True)
class Kind:
    """How one kind of object looks.

    Attributes
    ----------
    label : str
        Its name in a legend.
    color : str
        Line or marker colour.
    fill : str or None
        Light colour of its interior, if it has one.
    linestyle : str or tuple
        Line pattern, as in matplotlib; ``"none"`` for points.
    linewidth : float
        In points.
    marker : str
        Marker, ``""`` for lines.
    markersize : float
        In points.
    zorder : float
        Kinds with a larger number are drawn over those with a smaller one.

    Examples
    --------
    >>> from polyskel_lite import drawing
    >>> drawing.KINDS["sk2"].label, drawing.KINDS["sk2"].color
    ('$Sk_2$', '#0072B2')
    """

    label: str
    color: str
    fill: str | None = None
    linestyle: str | tuple = "-"
    linewidth: float = 1.0
    marker: str = ""
    markersize: float = 0.0
    zorder: float = 2.0


#: The kinds of objects, by name. Names are lower case: ``shape``, ``samples``, ``delaunay``, ``sk0`` ...
KINDS = {
    "shape": Kind("shape", "#4D4D4D", "#EEEEEE", "-", 1.0, zorder=1.0),
    "complement": Kind("complement", "#B5B5B5", "#FFFFFF", (0, (1, 1.2)), 1.2, zorder=3.0),
    "samples": Kind("samples", "#000000", None, "none", 0.0, ".", 3.5, zorder=6.0),
    "balls": Kind("balls", "#6B5F00", "#FBF3A9", "-", 1.0, zorder=1.5),
    "delaunay": Kind("Delaunay", "#56B4E9", "#DCEFFA", "-", 0.8, zorder=2.0),
    "voronoi": Kind("Voronoi", "#E69F00", "#FBE7BF", (0, (4, 1)), 0.9, zorder=2.5),
    "gabriel": Kind("Gabriel", "#009E73", "#BFE7DC", (0, (6, 1, 1, 1)), 1.6, zorder=3.0),
    "sk0": Kind("$Sk_0$", "#D55E00", None, "-", 1.6, zorder=4.0),
    "sk1": Kind("$Sk_1$", "#CC79A7", None, "none", 0.0, "D", 3.0, zorder=5.0),
    "sk2": Kind("$Sk_2$", "#0072B2", None, (0, (8, 1)), 1.6, zorder=4.2),
    "sk3": Kind("$Sk_3$", "#332288", None, (0, (6, 1, 1, 1)), 1.4, zorder=4.1),
}


def kind_of(name: str) -> Kind:
    """Look up a kind of object by name, with an error that lists the names there are.

    Parameters
    ----------
    name : str
        A key of `KINDS`.

    Raises
    ------
    InputError
        If there is no such kind.

    Examples
    --------
    >>> from polyskel_lite.drawing import style
    >>> style.kind_of("samples").marker
    '.'
    """
    if name not in KINDS:
        raise InputError(f"There is no kind of object called {name!r}; choose one of {', '.join(KINDS)}.")
    return KINDS[name]


def setup() -> None:
    """Set matplotlib to the style of the book: fonts, sizes, resolution. Call it once, first in a notebook.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> with plt.rc_context():       # in a notebook, without this line
    ...     drawing.setup()
    ...     plt.rcParams["font.size"]
    9.0
    """
    plt.rcParams.update(RC)


def axes(
    ncols: int = 1,
    nrows: int = 1,
    height: float | None = None,
    width: float = TEXT_WIDTH,
    letters: bool = False,
) -> tuple[Figure, Axes | np.ndarray]:
    """Make a figure of the book's width with one or more empty axes: equal scales, no frame.

    Parameters
    ----------
    ncols, nrows : int
        Number of panels in a row, and of rows.
    height : float, optional
        Height of the whole figure in inches; by default each panel is three quarters as high as wide.
    width : float
        Width of the whole figure in inches.
    letters : bool
        Write (a), (b), ... over the panels, in reading order.

    Returns
    -------
    fig : Figure
    axs : Axes, or a flat array of them in reading order when there are several

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, axs = drawing.axes(3, 2, letters=True)
    >>> len(axs), axs[4].get_title(loc="left")
    (6, '(e)')
    >>> plt.close(fig)
    """
    height = 0.75 * width / ncols * nrows if height is None else height
    fig = plt.figure(figsize=(width, height), layout="none")
    # By hand: matplotlib's layout engines move axes of equal scales a little each time the figure is drawn.
    over, under = (0.2 if letters else 0.04), 0.3  # inches, for a letter and for a legend
    share = (height - under) / nrows
    room = {"left": 0.0, "right": 1.0, "bottom": under / height, "top": 1 - over / height}
    gaps = {"wspace": 0.04, "hspace": over / (share - over)}
    flat = fig.subplots(nrows, ncols, squeeze=False, gridspec_kw=room | gaps).ravel()
    for ax, letter in zip(flat, string.ascii_lowercase, strict=False):
        ax.set_aspect("equal")
        ax.set_axis_off()
        ax.margins(0.03)
        if letters:
            ax.set_title(f"({letter})", loc="left", fontsize=9, pad=2)
    return fig, flat if flat.size > 1 else flat[0]


def handle(name: str, label: str | None = None) -> Line2D | Patch:
    """The legend entry of one kind: a line, a marker, or a filled box for shapes and balls.

    Examples
    --------
    >>> from polyskel_lite import drawing
    >>> drawing.handle("voronoi").get_label()
    'Voronoi'
    """
    kind = kind_of(name)
    label = kind.label if label is None else label
    if name in ("shape", "balls"):
        return Patch(facecolor=kind.fill, edgecolor=kind.color, linewidth=kind.linewidth, label=label)
    return Line2D(
        [],
        [],
        color=kind.color,
        linestyle=kind.linestyle,
        linewidth=kind.linewidth,
        marker=kind.marker or None,
        markersize=1.4 * kind.markersize,
        label=label,
    )


def legend(ax: Axes, *kinds: str | Artist, labels: dict[str, str] | None = None, **style) -> Axes:
    """Write a legend of the named kinds, by default in one line under the axes.

    Parameters
    ----------
    ax : Axes
    *kinds : str or Artist
        Names of `KINDS` in the order wanted; a matplotlib artist with a label for anything else.
    labels : dict, optional
        Other words for some kinds, e.g. ``{"balls": "$Y_w$"}``.
    **style
        Handed on to `matplotlib.axes.Axes.legend` (``loc``, ``ncols`` ...).

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes()
    >>> ax = drawing.legend(ax, "shape", "sk0", labels={"shape": "a horse"})
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['a horse', '$Sk_0$']
    >>> plt.close(fig)
    """
    labels = labels or {}
    handles = [handle(k, labels.get(k)) if isinstance(k, str) else k for k in kinds]
    below = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0), "ncols": len(kinds)}
    options = style if "loc" in style else below | style
    ax.legend(handles=handles, **options)
    return ax
