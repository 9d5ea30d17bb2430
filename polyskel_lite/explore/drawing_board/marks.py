"""SVG of the layers of a drawing board: data in, a string out; the look comes from `drawing.style.KINDS`.

One unit of these strings is a tenth of a pixel, so that coordinates are short whole numbers.
"""

from __future__ import annotations

import html
import re
from dataclasses import dataclass, field, fields, replace
from functools import lru_cache

import numpy as np

from ...drawing import CORE, Kind, clip_segments, kind_of
from ...errors import InputError

#: Units of a picture a pixel has, and those a typographic point has (96 pixels an inch, 72 points).
PIXEL = 10
POINT = PIXEL * 96 / 72

_NONE = np.empty((0, 2))


@dataclass(frozen=True)
class Layer:
    """What one layer of a board shows, in the coordinates of the shape.

    Attributes
    ----------
    kind : str
        Key of `polyskel_lite.drawing.KINDS`: colour, line pattern and marker.
    polygons : list of (k, 2) arrays
        Closed rings, filled together: holes are rings as well (see `rule`).
    lines : (m, 2, 2) array or list of (k, 2) arrays
        Segments, or open polylines.
    points : (k, 2) array
    circles : (centers (k, 2), radii (k,))
        Filled together, so that overlapping discs are one area with one outline; without `fill`
        each has its own.
    arcs : (centers (k, 2), radii (k,), start (k,), end (k,))
        Angles in radians, counter-clockwise from start to end, as in `Polyball.arcs`.
    text : list of (x, y, str)
    label : str or None
        Words for the legend; None: the layer is not in the legend.
    fill, stroke : bool
        Whether polygons and circles are filled, and whether they have an outline.
    rule : "evenodd" or "nonzero"
        Which parts of overlapping polygons are inside; "evenodd" leaves out holes.
    opacity, width : float
        Between 0 and 1; factor of the kind's line width and marker size.
    order : float or None
        Layers with a larger number are drawn over the others; by default the kind's own.
    """

    kind: str
    polygons: list = field(default_factory=list)
    lines: object = ()
    points: object = field(default_factory=lambda: _NONE)
    circles: tuple = (_NONE, np.empty(0))
    arcs: tuple = (_NONE, np.empty(0), np.empty(0), np.empty(0))
    text: list = field(default_factory=list)
    label: str | None = None
    fill: bool = True
    stroke: bool = True
    rule: str = "evenodd"
    opacity: float = 1.0
    width: float = 1.0
    order: float | None = None

    def __post_init__(self):
        kind_of(self.kind)
        if self.rule not in ("evenodd", "nonzero"):
            raise InputError(f"rule is {self.rule!r}; choose 'evenodd' or 'nonzero'.")


OPTIONS = tuple(f.name for f in fields(Layer))


class View:
    """The part of the plane that a board shows, and the way from there to units of the picture.

    Parameters
    ----------
    box : (xmin, ymin, xmax, ymax)
    width : int
        Of the picture, in pixels.

    Examples
    --------
    >>> view = View((0, 0, 2, 1), 640)
    >>> view.size, view.place([(0, 0), (2, 1)]).tolist()
    ((6400, 3200), [[0, 3200], [6400, 0]])
    """

    def __init__(self, box, width: int):
        box = np.asarray(box, dtype=float)
        if box.shape != (4,) or not np.isfinite(box).all() or (box[2:] <= box[:2]).any():
            raise InputError(
                f"box is {box.tolist()}; pass (xmin, ymin, xmax, ymax) with xmin < xmax, ymin < ymax."
            )
        self.box = tuple(box.tolist())
        self.scale = PIXEL * width / (box[2] - box[0])
        self.size = (PIXEL * width, round(self.scale * (box[3] - box[1])))
        room = 0.1 * (box[2] - box[0])
        #: Lower and upper corner of the part that lines are cut to: no end of one is seen at the rim.
        self.around = np.array([box[:2] - room, box[2:] + room])

    def place(self, points) -> np.ndarray:
        """Points (k, 2) of the plane in whole units of the picture, y downward."""
        points = np.asarray(points, dtype=float).reshape(-1, 2)
        xy = np.column_stack([points[:, 0] - self.box[0], self.box[3] - points[:, 1]]) * self.scale
        # Circumcenters may be far away, or nowhere: what is a million pixels off is out of sight anyway.
        return np.rint(np.nan_to_num(np.clip(xy, -1e7, 1e7), nan=1e7)).astype(int)

    def length(self, lengths) -> np.ndarray:
        """Lengths (k,) in whole units of the picture."""
        return np.rint(np.clip(np.asarray(lengths, dtype=float).reshape(-1) * self.scale, 0, 1e7)).astype(int)


def fragment(layer: Layer, view: View) -> str:
    """SVG elements of one layer, without the group around them.

    Examples
    --------
    >>> view = View((0, 0, 2, 1), 640)
    >>> fragment(Layer("samples", points=[(1, 0.5)]), view)
    '<path d="M3200 1600h0" fill="none" stroke="#000000" stroke-width="47" stroke-linecap="round"/>'
    """
    pen = pens(layer)
    paths = {
        "polygons": _polygons(layer.polygons, view),
        "circles": _circles(*layer.circles, view),
        "lines": _lines(layer.lines, view) + _arcs(*layer.arcs, view),
        "points": _fill_in(f"M%d %d{pen['mark']}", view.place(layer.points)) if len(layer.points) else "",
    }
    parts = [f'<path d="{d}" {pen[name]}/>' for name, d in paths.items() if d]
    if pen["core"] and paths["lines"]:
        parts.append(f'<path d="{paths["lines"]}" {pen["core"]}/>')
    parts += [_text(pen["text"], view, *entry) for entry in layer.text]
    body = "".join(parts)
    return f'<g opacity="{pen["opacity"]}">{body}</g>' if body and layer.opacity != 1 else body


def pens(layer: Layer) -> dict[str, str]:
    """How a layer is drawn, whatever it holds: attributes of its elements, and the way around a point.

    A page without a kernel draws with these (see ``toys/marks.js``), so that looks are said once.

    Examples
    --------
    >>> pens(Layer("samples"))["lines"]
    'fill="none" stroke="#000000" stroke-width="11" stroke-linejoin="round"'
    """
    kind = kind_of(layer.kind)
    paint = f'fill="{kind.fill or kind.color}"' if layer.fill else 'fill="none"'
    rule = f' fill-rule="{layer.rule}"' if layer.fill else ""
    # Outlines of discs first, twice as wide, then all insides over them: the outline of the union is left.
    first, wider = (' paint-order="stroke"', 2) if layer.fill else ("", 1)
    pen = f" {_pen(kind, layer.width)}" if layer.stroke else ""
    rim = f" {_pen(kind, wider * layer.width)}" if layer.stroke else ""
    size = (kind.markersize or 3.5) * layer.width * POINT
    half = round(0.7 * size)
    # A line of length zero with round ends is a dot.
    dot = f'fill="none" stroke="{kind.color}" stroke-width="{size:.0f}" stroke-linecap="round"'
    diamond = f"m0 {-half}l{half} {half} {-half} {half} {-half} {-half}z"
    return {
        "polygons": f"{paint}{rule}{pen}",
        "circles": f"{paint}{first}{rim}",
        "lines": f'fill="none" {_pen(kind, layer.width)}',
        "core": f'fill="none" {_pen(replace(kind, color=kind.core), CORE * layer.width)}'
        if kind.core
        else "",
        "points": f'fill="{kind.color}"' if kind.marker == "D" else dot,
        "mark": diamond if kind.marker == "D" else "h0",
        "text": f'font-size="130" font-family="sans-serif" fill="{kind.color}"',
        "opacity": f"{layer.opacity:g}",
    }


def swatch(layer: Layer, like: str = "") -> str:
    """The entry of one layer in a legend: HTML of a small picture and its label.

    Examples
    --------
    >>> swatch(Layer("sk2", label="Sk_2")).endswith("</svg> Sk<sub>2</sub></span>")
    True
    """
    filled = bool(len(layer.polygons) or len(layer.circles[0])) or like in ("polygons", "circles")
    dotted = bool(len(layer.points) or kind_of(layer.kind).marker) or like == "points"
    dotted = dotted and not len(layer.lines) and like != "lines"
    return _swatch(
        layer.kind, layer.label, filled, dotted, layer.fill, layer.stroke, layer.width, layer.opacity
    )


@lru_cache(maxsize=256)
def _swatch(kind, label, filled, dotted, fill, stroke, width, opacity) -> str:
    view = View((0, 0, 3, 1), 30)
    sample = {"kind": kind, "fill": fill, "stroke": stroke, "width": width, "opacity": opacity}
    if filled:
        sample |= {"polygons": [[(0.3, 0.1), (2.7, 0.1), (2.7, 0.9), (0.3, 0.9)]]}
    elif dotted:
        sample |= {"points": [(1.5, 0.5)]}
    else:
        sample |= {"lines": [[(0, 0.5), (3, 0.5)]]}
    size = 'viewBox="0 0 300 100" width="30" height="10" aria-hidden="true" style="background:#ffffff"'
    picture = f"<svg {size}>{fragment(Layer(**sample), view)}</svg>"
    return f'<span style="margin-right:1.2em;white-space:nowrap">{picture} {words(label)}</span>'


def words(label: str) -> str:
    """HTML of a label: escaped, with ``Sk_2`` as a subscript.

    Examples
    --------
    >>> words("$Sk_2$ & Y_w")
    'Sk<sub>2</sub> &amp; Y<sub>w</sub>'
    """
    return re.sub(r"_(\w)", r"<sub>\1</sub>", html.escape(label.replace("$", "")))


def _pen(kind: Kind, width: float) -> str:
    # Kinds that are drawn as markers have no line width of their own.
    size = max(kind.linewidth, 0.8) * width * POINT
    pen = f'stroke="{kind.color}" stroke-width="{size:.0f}" stroke-linejoin="round"'
    if isinstance(kind.linestyle, tuple):
        pen += f' stroke-dasharray="{" ".join(f"{size * part:.0f}" for part in kind.linestyle[1])}"'
    return pen


def _text(look: str, view: View, x: float, y: float, text: str) -> str:
    (px, py), words = view.place([(x, y)])[0], html.escape(str(text))
    return f'<text x="{px}" y="{py}" {look}>{words}</text>'


def _fill_in(pattern: str, numbers: np.ndarray) -> str:
    """The pattern once for each row: a single formatting, the fastest way there is from numbers to text."""
    return pattern * len(numbers) % tuple(numbers.ravel().tolist())


def _polygons(rings, view: View) -> str:
    placed = [view.place(ring) for ring in rings]
    return "".join("M" + _fill_in("%d %d ", xy).strip() + "z" for xy in placed if len(xy))


def _lines(lines, view: View) -> str:
    if isinstance(lines, np.ndarray) and lines.ndim == 3 and lines.shape[1:] == (2, 2):
        # Browsers draw lines of a million pixels slowly: what is out of sight is cut off.
        return _fill_in("M%d %dL%d %d", view.place(clip_segments(lines, view.around)).reshape(-1, 4))
    return "".join("M" + _fill_in("%d %d ", view.place(line)).strip() for line in lines)


def _circles(centers, radii, view: View) -> str:
    if not len(centers):
        return ""
    xy, r = view.place(centers), view.length(radii)
    rows = np.column_stack([xy[:, 0] - r, xy[:, 1], r, r, 2 * r, r, r, -2 * r])
    return _fill_in("M%d %da%d %d 0 1 0 %d 0a%d %d 0 1 0 %d 0z", rows)


def _arcs(centers, radii, start, end, view: View) -> str:
    if not len(centers):
        return ""
    centers, radii = np.asarray(centers, dtype=float).reshape(-1, 2), np.asarray(radii, dtype=float)
    start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    r = view.length(radii)
    # In two halves: SVG draws no arc whose ends are one point, and the halves need no flag for their size.
    stops = [
        centers + radii[:, None] * np.column_stack([np.cos(t), np.sin(t)])
        for t in (start, (start + end) / 2, end)
    ]
    first, middle, last = (view.place(stop) for stop in stops)
    rows = np.column_stack([first, r, r, middle, r, r, last])
    return _fill_in("M%d %dA%d %d 0 0 0 %d %dA%d %d 0 0 0 %d %d", rows)
