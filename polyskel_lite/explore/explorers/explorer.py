"""`Explorer`: what all explorers have in common: a shape, controls, a board, what to look for, a stand-in."""

from __future__ import annotations

import html
from collections.abc import Callable, Mapping, Sequence
from contextlib import contextmanager
from typing import ClassVar

import ipywidgets
import numpy as np

from ...containment import DelaunayShape, conform, delaunay_shape
from ...datasets import load
from ...drawing import chains
from ...errors import InputError, PolyskelError
from ...shapes import Shape, check_shape
from ..drawing_board import Board
from ..toys import as_script

#: What the stored page says where the controls would be.
NEEDS_KERNEL = (
    "To use its controls with shapes of yours, open this notebook in JupyterLab (<code>make lab</code>) "
    "and run its cells."
)
#: The same where the page has JavaScript that moves the picture.
NEEDS_SCRIPT = (
    "This picture moves on a page with JavaScript, and in JupyterLab (<code>make lab</code>, or a launch "
    "button of this page)."
)


class WithStandIn(ipywidgets.VBox):
    """A widget that is also a piece of a page where no kernel runs; a subclass has `look_for` and `stand_in`.

    Examples
    --------
    >>> class Word(WithStandIn):
    ...     look_for = "Read it."
    ...
    ...     def stand_in(self):
    ...         return "<p>word</p>"
    >>> bundle = Word()._repr_mimebundle_()
    >>> bundle["text/plain"], bundle["text/html"]
    ('Word: Read it.', '<p>word</p>')
    """

    look_for: str
    stand_in: Callable[[], str]

    def _repr_mimebundle_(self, **kwargs):
        bundle = super()._repr_mimebundle_(**kwargs)
        # The usual text lists all traits with their addresses; this one is the same each time.
        return bundle | {
            "text/plain": f"{type(self).__name__}: {self.look_for}",
            "text/html": self.stand_in(),
        }


class Explorer(WithStandIn):
    """Controls over a drawing board, drawn anew whenever one of them changes.

    A subclass makes its board and controls, calls ``super().__init__`` with them, and says in `draw` what
    is on the board. It computes with the library's public functions only.

    Parameters
    ----------
    board : Board
    controls : dict of str to ipywidgets widget
        By name, in the order of the page; each has a ``description`` that labels it. They are also
        attributes: ``explorer.controls["n"]``.
    look_for : str
        One sentence: what to change, and what to look for.

    Attributes
    ----------
    numbers : dict
        What the line under the board says, as values: for tests, and for readers who go on computing.
    error : PolyskelError or None
        Why the last change could not be drawn; its sentence then stands under the board.
    words : dict of str to str
        Sentences with places for values, ``{n}``; a page without a kernel has them from here.
    live : dict of str to str
        Layers that such a page draws by itself (`polyskel_lite.explore.toys`), and as what the legend shows
        each: "lines", "points", "circles" or "polygons". None: the picture stands still there.

    Examples
    --------
    >>> class Circle(Explorer):
    ...     def __init__(self):
    ...         radius = ipywidgets.FloatSlider(1, min=0.1, max=2, description="radius")
    ...         board = Board((-3, -3, 3, 3), handles=[(0, 0)], alt="A disc.", handle_labels=["centre"])
    ...         super().__init__(board, {"radius": radius}, "Make the disc grow: when does its area double?")
    ...
    ...     def draw(self):
    ...         radius = self.controls["radius"].value
    ...         self.board.draw("disc", kind="balls", circles=(self.board.handles, [radius]))
    ...         self.tell(area=np.pi * radius**2)
    >>> circle = Circle()
    >>> circle.controls["radius"].value = 2
    >>> circle.board.text
    'area 12.57'
    """

    def __init__(self, board: Board, controls: Mapping[str, ipywidgets.Widget], look_for: str):
        self.board, self.controls, self.look_for = board, dict(controls), look_for
        self.numbers: dict[str, object] = {}
        self.error: PolyskelError | None = None
        self._drawing = False
        hint = ipywidgets.HTML(f"<p style='margin:0;line-height:1.5'>{html.escape(look_for)}</p>")
        for control in self.controls.values():
            if not hasattr(control, "value"):  # a button: it observes its clicks itself
                continue
            # Labels are read in full, whatever their length.
            control.style = {"description_width": "initial"}
            room = 0.6 * len(control.description)
            control.layout.width = f"{18 + room:.0f}em" if hasattr(control, "max") else "auto"
            control.layout.margin = "2px 16px 2px 0"
            control.observe(lambda _: self.update(), "value")
        board.observe(lambda _: self.update(), "handles")
        row = ipywidgets.HBox(list(self.controls.values()), layout={"flex_flow": "row wrap"})
        super().__init__([hint, row, board])
        self.add_class("psl-explorer")  # board.js looks for it
        self.update()

    words: ClassVar[dict[str, str]] = {}
    live: ClassVar[dict[str, str]] = {}

    #: Puts everything on the board for the present controls and handles; every explorer says how.
    draw: Callable[[], None]

    def update(self) -> None:
        """Draw anew, and send what changed to the browser in one message.

        A `PolyskelError` does not end the session: its sentence is shown, and the picture stays.
        """
        if self._drawing:  # draw() itself moved a handle or a slider
            return
        self._drawing = True
        try:
            with self.board.hold_sync():
                try:
                    self.draw()
                    self.error = None
                except PolyskelError as error:
                    self.error = error
                    self.board.text = str(error)
        finally:
            self._drawing = False

    @contextmanager
    def together(self):
        """Change several controls or handles and draw once, at the end.

        Examples
        --------
        >>> from polyskel_lite.explore.explorers import graphs
        >>> explorer = graphs()
        >>> with explorer.together():
        ...     explorer.controls["voronoi"].value = False
        ...     explorer.controls["gabriel"].value = True
        """
        self._drawing = True
        try:
            yield
        finally:
            self._drawing = False
        self.update()

    def given(self) -> dict[str, object]:
        """What a page without a kernel needs to draw by itself: numbers and lists."""
        return {}

    def tell(self, remark: str = "", /, **numbers) -> None:
        """Set `numbers`, and the line under the board to a remark and the numbers with their names."""
        line = " · ".join(f"{name.replace('_', ' ')} {said(value)}" for name, value in numbers.items())
        self.say(f"{remark} {line}".strip(), numbers)

    def say(self, sentence: str, numbers: Mapping[str, object]) -> None:
        """Set `numbers`, and the line under the board to a sentence that says them."""
        self.numbers, self.board.text = dict(numbers), sentence

    def stand_in(self) -> str:
        """HTML of the picture and the sentences for a page without a kernel.

        Returns
        -------
        str
            A figure with alternative text, what to look for, the numbers, and where the controls are; with
            it, where there are `live` layers, what the page needs to move them.
        """
        figure = (
            f'<figure class="psl-explorer" style="margin:0">{self.board.svg()}<figcaption>'
            f'<div style="font-size:0.85em">{self.board.legend}</div>'
            f"<p>{html.escape(self.look_for)}</p><p>{html.escape(self.board.text)}</p>"
            f"<p><em>{NEEDS_SCRIPT if self.live else NEEDS_KERNEL}</em></p></figcaption></figure>"
        )
        return f'<div class="psl-toy">{as_script(self)}{figure}</div>' if self.live else figure


def flat_shape(shape: Shape | None, topic: str) -> Shape:
    """The shape that an explorer is given, by default the horse; refused if it is none of the plane.

    Examples
    --------
    >>> flat_shape(load("vertebra"), "samples")
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: the explorer of samples is for shapes of the plane; this one is a solid.
    """
    shape = load("horse") if shape is None else shape
    check_shape(shape)
    if shape.dimension != 2:
        raise InputError(f"the explorer of {topic} is for shapes of the plane; this one is a solid.")
    return shape


def rings_of(shape: Shape) -> dict[str, list]:
    """The rings of a shape of the plane as lists of corners, for `Explorer.given`.

    Examples
    --------
    >>> len(rings_of(load("lake"))["rings"])
    3
    """
    return {"rings": [shape.points[ring].tolist() for ring in shape.rings()]}


def refined(shape: Shape | DelaunayShape, to: str | None = None) -> DelaunayShape:
    """A shape as Delaunay simplices, refined first as `polyskel_lite.conform` does; these stay as they are.

    Examples
    --------
    >>> P = refined(load("gear", n=60))
    >>> P.is_gabriel(), refined(P) is P
    (True, True)
    """
    return shape if isinstance(shape, DelaunayShape) else delaunay_shape(conform(shape, to))


def outline(points: np.ndarray, edges: np.ndarray) -> list[np.ndarray]:
    """The rings that the sides of a boundary make, as polygons for `Board.draw`.

    Examples
    --------
    >>> [len(ring) for ring in outline(np.eye(3, 2), [(0, 1), (1, 2), (2, 0)])]
    [4]
    """
    return [points[path] for path in chains(edges)]


def sample_sliders(shape: Shape, n: int, start: float = 0.0) -> dict[str, ipywidgets.Widget]:
    """Sliders ``n``, for the number of samples from three a ring on, and ``start``, for their shift.

    Examples
    --------
    >>> sample_sliders(load("lake"), 100)["n"].min
    9
    """
    rings = len(shape.rings())
    return {
        "n": ipywidgets.IntSlider(n, min=3 * rings, max=max(400, 6 * rings), description="samples n"),
        "start": ipywidgets.FloatSlider(start, min=0, max=0.95, step=0.05, description="shift, in steps"),
    }


def said(value) -> str:
    """A number as it is read: four digits, yes or no, Betti numbers in brackets.

    Examples
    --------
    >>> said(0.123456), said(12), said(True), said((1, np.int64(2))), said("none")
    ('0.1235', '12', 'yes', '(1, 2)', 'none')
    """
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    if isinstance(value, float | np.floating):
        return f"{value:.4g}"
    if isinstance(value, Sequence) and not isinstance(value, str):
        return "(" + ", ".join(said(entry) for entry in value) + ")"
    return str(value)
