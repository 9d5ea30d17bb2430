"""One colour and one line pattern for every kind of object, the same in every picture of the book.

The colours are those of Okabe and Ito, a palette made for readers with any kind of colour vision, with an
indigo of Tol's for the eighth line; a test holds them apart as seen with each kind of colour blindness.
Because a colour is lost on a grey printer, each kind also has its own line pattern, width or marker.
Skeletons are never dashed: a dash cannot be told from a gap, and in how many pieces they are is the question.

References
----------
M. Okabe, K. Ito, "Color universal design: how to make figures and presentations that are friendly to
colorblind people", 2008.
"""

from __future__ import annotations

import string
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import AbstractPathEffect, Normal

from ..errors import InputError
from .pages import show_in_notebooks

#: Width of the book's text column, in inches: every figure is made for it, so that nothing is rescaled.
TEXT_WIDTH = 7.0

#: Width of pictures as they are made now, in inches (see `page_width`).
_WIDTH = ContextVar("width", default=TEXT_WIDTH)

#: Settings of matplotlib for all pictures of the book (see `setup`).
RC = {
    "figure.dpi": 120,
    "savefig.dpi": 200,
    "savefig.bbox": "tight",
    "savefig.pad_inches": 0.02,
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.titlesize": "medium",
    "axes.labelsize": "medium",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.fontsize": "medium",
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
    core : str or None
        Colour of a thinner line along the middle, which makes a double line.
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
    core: str | None = None
    zorder: float = 2.0


#: Width of the core of a double line, as a share of the whole.
CORE = 0.45

#: The kinds of objects, by name. Names are lower case: ``shape``, ``samples``, ``delaunay``, ``sk0`` ...
KINDS = {
    "shape": Kind("shape", "#4D4D4D", "#EEEEEE", "-", 1.0, zorder=1.0),
    "complement": Kind("complement", "#B5B5B5", "#FFFFFF", (0, (1, 1.2)), 1.2, zorder=3.0),
    "samples": Kind("samples", "#000000", None, "none", 0.0, ".", 3.5, zorder=6.0),
    "balls": Kind("balls", "#6B5F00", "#FBF3A9", "-", 1.0, zorder=1.5),
    "delaunay": Kind("Delaunay", "#56B4E9", "#DCEFFA", "-", 0.8, zorder=2.0),
    "voronoi": Kind("Voronoi", "#E69F00", "#FBE7BF", (0, (4, 1)), 0.9, zorder=2.5),
    "gabriel": Kind("Gabriel", "#009E73", "#BFE7DC", (0, (6, 1, 1, 1)), 1.6, zorder=3.0),
    # Broader ones lie below: where two skeletons are one, both are seen.
    "sk0": Kind("$Sk_0$", "#D55E00", None, "-", 1.4, zorder=4.2),
    "sk1": Kind("$Sk_1$", "#CC79A7", None, "none", 0.0, "D", 3.0, zorder=5.0),
    "sk2": Kind("$Sk_2$", "#0072B2", None, "-", 2.0, zorder=4.1),
    "sk3": Kind("$Sk_3$", "#332288", None, "-", 2.4, core="#E4DFF5", zorder=4.0),
}


class Core(AbstractPathEffect):
    """Draws the core of a double line, whatever the width of the line is by then."""

    def __init__(self, color: str):
        super().__init__()
        self.color = color

    def draw_path(self, renderer, gc, *path):
        inner = renderer.new_gc()
        inner.copy_properties(gc)
        inner.set_linewidth(CORE * gc.get_linewidth())
        inner.set_foreground(self.color)
        renderer.draw_path(inner, *path)
        inner.restore()


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

    In a notebook figures are then shown by `polyskel_lite.drawing.picture`: sharp on every screen.

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
    show_in_notebooks()


@contextmanager
def page_width(inches: float) -> Iterator[float]:
    """Make figures for another page: all that `axes` and `panels` are told in inches is scaled to it.

    Letters are not scaled with it: they get 7 points where a page is narrow, else 9. Lines keep their widths
    until `thin` is asked to change them.

    Parameters
    ----------
    inches : float
        What is `TEXT_WIDTH` otherwise.

    Yields
    ------
    float
        By how much a picture is smaller than in the book.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> with drawing.page_width(3.5) as share:
    ...     fig, ax = drawing.axes()
    >>> share, fig.get_size_inches().tolist()[0]
    (0.5, 3.5)
    >>> plt.close(fig)
    """
    token = _WIDTH.set(inches)
    try:
        with plt.rc_context({"font.size": 9 if inches > 5 else 7}):
            yield page_share()
    finally:
        _WIDTH.reset(token)


def page_share() -> float:
    """Width of the page that figures are made for now, as a share of the book's.

    Examples
    --------
    >>> page_share()
    1.0
    """
    return _WIDTH.get() / TEXT_WIDTH


def letter_size() -> float:
    """Size of the letters (a), (b) ... of panels, in points: to be read on a phone, where pictures are small.

    Examples
    --------
    >>> round(letter_size() / plt.rcParams["font.size"], 2)
    1.45
    """
    return 1.45 * plt.rcParams["font.size"]


def thin(figure: Figure, share: float) -> Figure:
    """Scale the widths of all lines and the sizes of all dots of a figure; letters stay as they are.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes()
    >>> line, = ax.plot([0, 1], [0, 1], linewidth=3)
    >>> thin(fig, 0.5) is fig, line.get_linewidth()
    (True, 1.5)
    >>> plt.close(fig)
    """
    for artist in dict.fromkeys(figure.findobj(lambda a: hasattr(a, "set_linewidth"))):
        artist.set_linewidth(share * np.asarray(artist.get_linewidth()))
        if hasattr(artist, "set_markersize"):
            artist.set_markersize(share * artist.get_markersize())
    return figure


def axes(
    ncols: int = 1,
    nrows: int = 1,
    height: float | None = None,
    width: float = TEXT_WIDTH,
    letters: bool = False,
    under: float = 0.3,
) -> tuple[Figure, Any]:
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
    under : float
        Room for a legend under the lowest row, in inches.

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
    over = 0.24 if letters else 0.04  # inches, for a letter
    # On a narrower page panels are smaller, but a line of letters is not.
    share = page_share() * ((height - under) / nrows - over) + over
    under *= 1.4 if page_share() < 0.7 else 1.0  # where a legend may be in two lines
    width, height = page_share() * width, nrows * share + under
    # By hand: matplotlib's layout engines move axes of equal scales a little each time the figure is drawn.
    fig = plt.figure(figsize=(width, height), layout="none")
    room = {"left": 0.0, "right": 1.0, "bottom": under / height, "top": 1 - over / height}
    gaps = {"wspace": 0.04, "hspace": over / (share - over)}
    flat = fig.subplots(nrows, ncols, squeeze=False, gridspec_kw=room | gaps).ravel()
    for ax, letter in zip(flat, string.ascii_lowercase, strict=False):
        ax.set_aspect("equal")
        ax.set_axis_off()
        ax.margins(0.03)
        if letters:
            ax.set_title(f"({letter})", loc="left", pad=2, fontsize=letter_size())
    return fig, flat if flat.size > 1 else flat[0]


def say(ax: Axes, words: str, **style) -> Axes:
    """Write a few words over a panel, beside its letter.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes(letters=True)
    >>> drawing.say(ax, "50 samples").texts[0].get_text()
    '50 samples'
    >>> plt.close(fig)
    """
    shift = (2.2 * letter_size(), 2)
    ax.annotate(words, (0, 1), shift, "axes fraction", "offset points", va="baseline", **style)
    return ax


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
        path_effects=[Normal(), Core(kind.core)] if kind.core else None,
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
    # On a narrow page four names do not fit side by side.
    columns = 2 if len(kinds) > 3 and page_share() < 0.7 else len(kinds)
    below = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0), "ncols": columns}
    options = style if "loc" in style else below | style
    ax.legend(handles=handles, **options)
    return ax
