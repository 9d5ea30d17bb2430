"""Explorer of chapter 1: a ball grows from a centre that the reader drags until it is maximal."""

from __future__ import annotations

import ipywidgets
import numpy as np

from ...datasets import load
from ...errors import InputError
from ...shapes import Shape, check_shape
from ...skeletons import sk1, sk2
from ..drawing_board import Board, box_around
from .explorer import Explorer

#: Distinct contacts are found up to this share of the radius, and a centre counts as on the skeleton when
#: it is nearer to it than this share of the picture's width (three pixels).
TOUCH, SNAP = 1e-6, 3 / 640
#: A centre that is nearer to the boundary than this share of the width is on it.
EDGE = 1e-6


class MaximalBall(Explorer):
    """See `maximal_ball`."""

    def __init__(self, shape: Shape | None = None, center=None):
        self.shape = load("horse") if shape is None else shape
        check_shape(self.shape)
        if self.shape.dimension != 2:
            raise InputError("the explorer of maximal balls is for shapes of the plane; this one is a solid.")
        self._seen: list[np.ndarray] = []
        board = Board(
            box_around(self.shape.points),
            handles=[_off_the_skeleton(self.shape) if center is None else center],
            handle_labels=["centre of the ball"],
        )
        rings = [self.shape.points[ring] for ring in self.shape.rings()]
        board.draw("shape", "shape", polygons=rings, label="shape X")
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
        self._draw_skeleton(skeleton)
        start, width = np.array(board.handles[0]), board.box[2] - board.box[0]
        if not shape.contains([start])[0] or shape.boundary_distance([start])[0] < EDGE * width:
            self._draw_ball(start, None)
            board.alt = "A shape; the chosen centre is not inside it."
            self.tell("No ball: the centre is not inside the shape. Drag it back in.")
            return
        radius, center, full = grow(shape, start)
        moved = float(np.hypot(*(center - start)))
        if moved <= SNAP * width:
            remark, share = "The centre is on the skeleton: its ball is maximal, it cannot grow.", 1.0
        elif share == 1:
            remark = "Grown until it is maximal: the centre has moved onto the skeleton."
        else:
            remark = "Not maximal: a larger ball in the shape holds this one."
        if trace:
            self._seen = [*self._seen[-1999:], center]
        size = radius + share * (full - radius)
        contacts = self._draw_ball(start + share * (center - start), size)
        board.alt = (
            f"A shape, a ball of radius {size:.3g} in it that touches the boundary in {contacts} points"
            + (f", and {len(self._seen)} centres of maximal balls." if self._seen else ".")
        )
        self.tell(
            remark,
            contacts=contacts,
            radius=size,
            radius_at_the_dot=radius,
            distance_from_the_dot_to_the_skeleton=moved,
        )

    def _draw_ball(self, center: np.ndarray, radius: float | None) -> int:
        """Draw the ball, its way and the trace; the number of its contacts."""
        board, ball, contacts, way = self.board, ([], []), (), ()
        if radius is not None:
            ball, contacts = ([center], [radius]), _contacts(self.shape, center, radius)
            way = [[board.handles[0], center]]
        board.draw("ball", "balls", circles=ball, label="ball")
        board.draw("contacts", "samples", points=contacts, width=2.5, label="contacts")
        board.draw("way", "samples", lines=way, width=1.5)
        trace = np.reshape(self._seen, (-1, 2))
        board.draw("trace", "sk0", points=trace, width=1.5, label="centres of maximal balls")
        return len(contacts)

    def _draw_skeleton(self, wanted: bool) -> None:
        if wanted and "skeleton" not in self.board.layers:
            self.board.draw("skeleton", "sk2", lines=sk2(self.shape).segments(), label="Sk_2 of the corners")
        elif "skeleton" in self.board.layers:
            self.board.show("skeleton", wanted)


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


def grow(shape: Shape, center) -> tuple[float, np.ndarray, float]:
    """Radius of the ball around a centre, and centre and radius of the maximal ball with its first contact.

    Parameters
    ----------
    shape : Shape
    center : (x, y)
        Inside the shape, not on its boundary.

    Returns
    -------
    radius : float
    center : (2,) float array
    radius of the maximal ball : float

    References
    ----------
    The shrinking ball of J. Ma, S. W. Bae, S. Choi, 3D medial axis point approximation using nearest
    neighbors and the normal field, 2012.

    Examples
    --------
    >>> from polyskel_lite import Shape
    >>> radius, center, full = grow(Shape.from_rings([[(0, 0), (6, 0), (6, 2), (0, 2)]]), (3, 0.5))
    >>> radius, center.round(6).tolist(), round(full, 6)
    (0.5, [3.0, 1.0], 1.0)
    """
    center = np.asarray(center, dtype=float)
    feet, distances = _feet(shape, center)
    first = distances.argmin()
    radius = float(distances[first])
    away = (center - feet[first]) / radius
    # The ball around center + t * away with radius + t keeps its first contact. Shrink it to the nearest
    # point of the boundary as long as that is inside.
    t = float(np.ptp(shape.points, axis=0).sum())
    for _ in range(100):
        feet, distances = _feet(shape, center + t * away)
        nearest = distances.argmin()
        if distances[nearest] >= (radius + t) * (1 - 1e-12):
            break
        gap = center - feet[nearest]
        t = max(0.0, float((gap @ gap - radius**2) / (2 * (radius - gap @ away))))
    return radius, center + t * away, radius + t


def _feet(shape: Shape, center: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The point of each side that is nearest to the centre, and its distance."""
    a, along = shape.segments[:, 0], shape.segments[:, 1] - shape.segments[:, 0]
    t = ((center - a) * along).sum(axis=1) / (along**2).sum(axis=1)
    feet = a + np.clip(t, 0, 1)[:, None] * along
    return feet, np.hypot(*(feet - center).T)


def _contacts(shape: Shape, center: np.ndarray, radius: float) -> np.ndarray:
    """The points of the boundary that the ball touches, each once."""
    feet, distances = _feet(shape, center)
    near = feet[distances <= radius * (1 + TOUCH)]
    kept: list[np.ndarray] = []
    for point in near:  # two sides share the corner that they touch the ball with
        if all(np.hypot(*(point - other)) > 1e-3 * radius for other in kept):
            kept.append(point)
    return np.array(kept)


def _off_the_skeleton(shape: Shape) -> np.ndarray:
    """Halfway from the centre of the largest ball to one of its contacts."""
    vertices = sk1(shape)
    largest = int(vertices.radii.argmax())
    center, contact = (
        vertices.vertices[largest],
        shape.points[vertices.tessellation.simplices[vertices.simplices[largest], 0]],
    )
    return (center + contact) / 2
