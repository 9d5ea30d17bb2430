"""Explorer of chapter 1: a ball grows from a centre that the reader drags until it is maximal."""

from __future__ import annotations

from typing import ClassVar

import ipywidgets
import numpy as np

from ...shapes import Shape
from ...skeletons import contact_points, grown_ball, sk1, sk2
from ..drawing_board import Board, box_around
from .explorer import Explorer, flat_shape, rings_of, said

#: A centre counts as on the skeleton when it is nearer to it than this share of the picture's width (three
#: pixels).
SNAP = 3 / 640
#: A centre that is nearer to the boundary than this share of the width is on it.
EDGE = 1e-6


class MaximalBall(Explorer):
    """See `maximal_ball`."""

    words: ClassVar[dict[str, str]] = {
        "alt": "A shape, a ball of radius {radius} in it that touches the boundary in {contacts} points.",
        "alt_with_trace": "A shape, a ball of radius {radius} in it that touches the boundary in {contacts} "
        "points, and {kept} centres of maximal balls.",
        "alt_outside": "A shape; the chosen centre is not inside it.",
        "outside": "No ball: the centre is not inside the shape. Drag it back in.",
        "there": "The centre is on the skeleton: its ball is maximal, it cannot grow.",
        "grown": "Grown until it is maximal: the centre has moved onto the skeleton.",
        "growing": "Not maximal: a larger ball in the shape holds this one.",
    }
    live: ClassVar[dict[str, str]] = {
        "ball": "circles",
        "contacts": "points",
        "way": "lines",
        "trace": "points",
    }

    def __init__(self, shape: Shape | None = None, center=None):
        self.shape = flat_shape(shape, "maximal balls")
        self._seen: list[np.ndarray] = []
        board = Board(
            box_around(self.shape.points),
            handles=[_off_the_skeleton(self.shape) if center is None else center],
            handle_labels=["centre of the ball"],
        )
        rings = [self.shape.points[ring] for ring in self.shape.rings()]
        board.draw("shape", "shape", polygons=rings, label="shape X")
        lines = sk2(self.shape).segments()
        board.draw("skeleton", "sk2", False, lines=lines, label="Sk_2 of the corners")
        controls = {
            "growth": ipywidgets.FloatSlider(1.0, min=0, max=1, step=0.02, description="growth"),
            "trace": ipywidgets.Checkbox(
                False, description="keep the centres of maximal balls", indent=False
            ),
            "skeleton": ipywidgets.Checkbox(False, description="show the skeleton", indent=False),
        }
        super().__init__(
            board,
            controls,
            "Drag the white dot: its ball touches the boundary once and grows away from that contact until "
            "a second one stops it. Where do the centres of the balls that cannot grow lie?",
        )

    def draw(self) -> None:
        shape, board = self.shape, self.board
        share, trace, skeleton = (self.controls[name].value for name in ("growth", "trace", "skeleton"))
        if not trace:
            self._seen.clear()
        board.show("skeleton", skeleton)
        start, width = np.array(board.handles[0]), board.box[2] - board.box[0]
        if not shape.contains([start])[0] or shape.boundary_distance([start])[0] < EDGE * width:
            self._draw_ball(start, None)
            board.alt = self.words["alt_outside"]
            self.tell(self.words["outside"])
            return
        radius, center, full = grown_ball(shape, start)
        moved = float(np.hypot(*(center - start)))
        if moved <= SNAP * width:
            remark, share = "there", 1.0
        else:
            remark = "grown" if share == 1 else "growing"
        if trace:
            self._seen = [*self._seen[-1999:], center]
        size = radius + share * (full - radius)
        contacts = self._draw_ball(start + share * (center - start), size)
        alt = self.words["alt_with_trace" if self._seen else "alt"]
        board.alt = alt.format(radius=said(size), contacts=contacts, kept=len(self._seen))
        self.tell(
            self.words[remark],
            contacts=contacts,
            radius=size,
            radius_at_the_dot=radius,
            distance_from_the_dot_to_the_skeleton=moved,
        )

    def _draw_ball(self, center: np.ndarray, radius: float | None) -> int:
        """Draw the ball, its way and the trace; the number of its contacts."""
        board, contacts, way = self.board, np.zeros((0, 2)), []
        ball: tuple[list, list] = ([], [])
        if radius is not None:
            ball, contacts = ([center], [radius]), contact_points(self.shape, center, radius)
            way = [[board.handles[0], center]]
        board.draw("ball", "balls", circles=ball, label="ball")
        board.draw("contacts", "samples", points=contacts, width=2.5, label="contacts")
        board.draw("way", "samples", lines=way, width=1.5)
        trace = np.reshape(self._seen, (-1, 2))
        board.draw("trace", "sk0", points=trace, width=1.5, label="centres of maximal balls")
        return len(contacts)

    def given(self) -> dict[str, object]:
        return rings_of(self.shape) | {"snap": SNAP, "edge": EDGE}


def maximal_ball(shape: Shape | None = None, center=None) -> MaximalBall:
    """Explore the maximal balls of a shape, and find its skeleton with them (chapter 1).

    Parameters
    ----------
    shape : Shape, optional
        A polygon, by default the horse; its balls are those of the polygon itself, not of samples.
    center : (x, y), optional
        Where the dot is at first.

    Returns
    -------
    MaximalBall
        An `Explorer`; its handle is the centre. Controls: ``growth``, from the ball around the handle (0) to
        the maximal ball with the same first contact (1), ``trace`` and ``skeleton`` (on or off).

    Raises
    ------
    InputError
        If `shape` is not a shape of the plane.

    Examples
    --------
    In a bar the balls grow until they touch both long sides:

    >>> from polyskel_lite import Shape
    >>> explorer = maximal_ball(Shape.from_rings([[(0, 0), (6, 0), (6, 2), (0, 2)]]), center=(3, 0.5))
    >>> explorer.numbers["contacts"], round(explorer.numbers["radius"], 6)
    (2, 1.0)
    >>> explorer.controls["growth"].value = 0
    >>> explorer.numbers["contacts"], explorer.numbers["radius"]
    (1, 0.5)
    """
    return MaximalBall(shape, center)


def _off_the_skeleton(shape: Shape) -> np.ndarray:
    """Halfway from the centre of the largest ball to one of its contacts."""
    found = sk1(shape)
    largest = int(found.radii.argmax())
    return (found.vertices[largest] + found.contacts(largest)[0]) / 2
