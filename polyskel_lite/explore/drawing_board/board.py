"""`Board`: a drawing board for the plane with layers that Python draws and handles that a reader moves."""

from __future__ import annotations

import html
from collections.abc import Iterable
from pathlib import Path

import anywidget
import numpy as np
import traitlets

from ...checks import as_points
from ...errors import InputError
from ..bundle import BOARD, one_module
from .marks import OPTIONS, PIXEL, Layer, View, fragment, kind_of, swatch

_HERE = Path(__file__).parent


class Board(anywidget.AnyWidget):
    """A picture of the plane made of layers, with handles over it for mouse, touch and keyboard.

    Parameters
    ----------
    box : (xmin, ymin, xmax, ymax)
        The part of the plane that is shown, see `box_around`.
    layers : iterable of dict
        Arguments of `draw`, each with a ``name``.
    handles : (k, 2) array-like, optional
        Places of the handles.
    alt : str
        What is seen, for readers who do not see it.
    handle_labels : sequence of str
        Names of the handles, "centre of the ball" for example.
    width : int
        Of the picture in pixels, at most: it is never wider than the page.

    Attributes
    ----------
    handles : tuple of (float, float)
        Where the handles are, kept in the box; set it, or `observe` it.
    layers : dict of str to `Layer`
        What is drawn, by name.
    text : str
        A line under the picture, read out when it changes.
    step : float
        How far an arrow key moves a handle; ten times as far with Shift.

    Notes
    -----
    A layer travels to the browser only when its picture changed. While Python works on a move, the
    browser keeps the newest place of the handle to itself, so that moves never queue up.

    Examples
    --------
    >>> board = Board((0, 0, 4, 3), handles=[(1, 1)], alt="A segment.")
    >>> board.draw("edge", kind="gabriel", lines=[[(0, 0), (4, 3)]])
    >>> board.handles = [(9, 1)]
    >>> board.handles
    ((4.0, 1.0),)
    >>> board.svg().count("<path")
    1
    """

    _esm = one_module(BOARD)
    _css = _HERE / "board.css"

    handles = traitlets.Any(default_value=()).tag(sync=True)
    handle_labels = traitlets.List(traitlets.Unicode()).tag(sync=True)
    alt = traitlets.Unicode().tag(sync=True)
    text = traitlets.Unicode().tag(sync=True)
    step = traitlets.Float(1.0).tag(sync=True)
    _view = traitlets.Dict().tag(sync=True)
    _layers = traitlets.List(traitlets.Unicode()).tag(sync=True)
    _legend = traitlets.Unicode().tag(sync=True)

    def __init__(
        self,
        box,
        layers: Iterable[dict] = (),
        handles=None,
        alt: str = "",
        handle_labels=(),
        width: int = 640,
    ):
        self.layers: dict[str, Layer] = {}
        self._seen: dict[str, bool] = {}
        self.view = View(box, width)
        super().__init__(alt=alt, handle_labels=list(handle_labels), **self._frame())
        self.handles = () if handles is None else handles
        self.on_msg(self._receive)
        for layer in layers:
            self.draw(**layer)

    @property
    def box(self) -> tuple[float, float, float, float]:
        """The part of the plane that is shown, (xmin, ymin, xmax, ymax); settable."""
        return self.view.box

    @box.setter
    def box(self, box) -> None:
        self.view = View(box, self.view.size[0] // PIXEL)
        with self.hold_sync():
            for name, value in self._frame().items():
                setattr(self, name, value)
            self.handles = self.handles
            for name in self.layers:
                self._show(name)

    def _frame(self) -> dict[str, object]:
        """The traits that follow from the part of the plane shown."""
        xmin, ymin, xmax, ymax = box = self.view.box
        step = (xmax - xmin + ymax - ymin) / 400
        return {"step": step, "_view": {"box": list(box), "size": list(self.view.size)}}

    def draw(self, name: str, kind: str, visible: bool = True, **contents) -> None:
        """Draw a layer, or draw it anew.

        Parameters
        ----------
        name : str
            Of the layer: letters, digits and ``_``.
        kind : str
            Key of `polyskel_lite.drawing.KINDS`: colour, line pattern, marker.
        visible : bool
        **contents
            ``polygons``, ``lines``, ``points``, ``circles``, ``arcs``, ``text``, one or more of them, and the
            options ``label``, ``fill``, ``stroke``, ``rule``, ``opacity``, ``width``, ``order``: see `Layer`.

        Raises
        ------
        InputError
            If there is no such kind or option, or the name is not one.

        Examples
        --------
        >>> board = Board((0, 0, 2, 2))
        >>> board.draw("discs", kind="balls", circles=([(1, 1), (1.5, 1)], [0.5, 0.4]), label="two discs")
        >>> board.layers["discs"].label
        'two discs'
        """
        if not str(name).isidentifier():
            raise InputError(f"a layer cannot be called {name!r}; use letters, digits and _.")
        unknown = set(contents) - set(OPTIONS)
        if unknown:
            raise InputError(f"a layer has no {sorted(unknown)[0]!r}; choose from {', '.join(OPTIONS)}.")
        new = name not in self.layers
        self.layers[name], self._seen[name] = Layer(kind, **contents), bool(visible)
        if new:
            self.add_traits(**{f"_svg_{name}": traitlets.Unicode().tag(sync=True)})
        self._show(name)
        self._arrange()

    def show(self, name: str, visible: bool = True) -> None:
        """Show a layer, or hide it; what it holds is kept.

        Examples
        --------
        >>> board = Board((0, 0, 2, 2), [{"name": "dots", "kind": "samples", "points": [(1, 1)]}])
        >>> board.show("dots", False)
        >>> "path" in board.svg()
        False
        """
        if name not in self.layers:
            raise InputError(f"there is no layer {name!r}; there are {', '.join(self.layers) or 'none'}.")
        if self._seen[name] != bool(visible):
            self._seen[name] = bool(visible)
            self._show(name)
            self._arrange()

    def visible(self, name: str) -> bool:
        """Whether a layer is there and shown.

        Examples
        --------
        >>> Board((0, 0, 2, 2)).visible("dots")
        False
        """
        return self._seen.get(name, False)

    def svg(self, alt: str | None = None) -> str:
        """The picture as it is now, as one SVG element for a page without a kernel.

        Parameters
        ----------
        alt : str, optional
            What is seen, by default the board's `alt`.

        Returns
        -------
        str
            With a title and no ids, so that several of them fit on a page.

        Examples
        --------
        >>> Board((0, 0, 2, 1), width=100).svg("Nothing yet.")  # doctest: +ELLIPSIS
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1000 500" role="img" ...
        """
        alt = html.escape(self.alt if alt is None else alt)
        width, height = self.view.size
        body = "".join(f"<g>{picture}</g>" for name in self._layers if (picture := self.picture(name)))
        dots = "".join(f'<circle cx="{x}" cy="{y}" r="70"/>' for x, y in self.view.place(self.handles))
        if dots:
            body += f'<g fill="#ffffff" stroke="#000000" stroke-width="25">{dots}</g>'
        style = f"width:100%;max-width:{width // PIXEL}px;height:auto;background:#ffffff"
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img" '
            f'aria-label="{alt}" style="{style}">'
            f"<title>{alt}</title>{body}</svg>"
        )

    def picture(self, name: str) -> str:
        """SVG elements of one layer as they are in the browser, "" if it is hidden."""
        return getattr(self, f"_svg_{name}")

    @property
    def legend(self) -> str:
        """HTML of the legend: the layers that have a label and something to be seen."""
        return self._legend

    def _show(self, name: str) -> None:
        picture = fragment(self.layers[name], self.view) if self._seen[name] else ""
        setattr(self, f"_svg_{name}", picture)

    def _arrange(self) -> None:
        def height(name):
            layer = self.layers[name]
            return kind_of(layer.kind).zorder if layer.order is None else layer.order

        self._layers = sorted(self.layers, key=height)
        shown = [layer for name, layer in self.layers.items() if layer.label and self.picture(name)]
        self._legend = "".join(dict.fromkeys(map(swatch, shown)))

    @traitlets.validate("handles")
    def _keep_in_box(self, proposal):
        value = proposal["value"]
        if len(value) == 0:
            return ()
        xmin, ymin, xmax, ymax = self.view.box
        places = np.clip(as_points(value, name="handles", dimensions=(2,)), [xmin, ymin], [xmax, ymax])
        return tuple(map(tuple, places.tolist()))

    def _receive(self, _, content, buffers) -> None:
        if content.get("type") != "move":
            return
        try:
            if len(content["handles"]) == len(self.handles):  # not a late message about others
                self.handles = content["handles"]
        finally:
            self.send({"type": "answer", "serial": content["serial"]})


def box_around(points, margin: float = 0.05) -> tuple[float, float, float, float]:
    """The box of some points with a margin, for `Board`.

    Parameters
    ----------
    points : (k, 2) array-like
    margin : float
        As a share of the longer side.

    Returns
    -------
    (xmin, ymin, xmax, ymax)

    Examples
    --------
    >>> box_around([(0, 0), (10, 5)], margin=0.1)
    (-1.0, -1.0, 11.0, 6.0)
    """
    points = as_points(points, dimensions=(2,))
    low, high = points.min(axis=0), points.max(axis=0)
    room = margin * ((high - low).max() or 1.0)
    return tuple(np.concatenate([low - room, high + room]).tolist())
