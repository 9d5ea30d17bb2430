"""Balls you add, move and grow: the exact skeleton of their union (appendix A)."""

from __future__ import annotations

from typing import ClassVar

import ipywidgets
import numpy as np

from ...drawing import clip_segments, ray_segments
from ...errors import InputError, PolyskelError, TangentBallsError
from ...polyballs import Polyball
from ...skeletons import Skeleton, voronoi
from ..drawing_board import Board
from .explorer import Explorer

#: Seven discs: a ring around a hole, a tail, and a small disc that others cover.
CENTERS = ((0.0, 0.0), (1.3, 0.75), (2.6, 0.0), (2.2, -1.5), (0.6, -1.6), (4.1, 0.3), (0.65, 0.35))
RADII = (1.0, 0.85, 1.0, 0.8, 1.0, 0.7, 0.35)
#: Two handles a ball are enough for that many.
MOST = 16

LOOK_FOR = (
    "Drag a centre, or drag the dot on a rim to make a ball grow. Look for the black singular points, where "
    "two circles meet on the boundary: the skeleton lies on their Voronoi graph, and changes when one "
    "of them comes or goes. Which ball can go without changing anything?"
)
ALT = (
    "A union of discs with its boundary, the singular points on it as black dots, their Voronoi graph "
    "faintly, and the skeleton of the union as a blue line."
)


def ball_numbers(Y: Polyball, skeleton: Skeleton) -> dict[str, object]:
    """What the line under the board says.

    Parameters
    ----------
    Y : Polyball
        In the plane, without tangent balls.
    skeleton : Skeleton
        Its exact one.

    Returns
    -------
    dict
        ``balls``, how many are ``needed`` for the union, its ``area``, ``singular_points``,
        ``disconnected_balls`` and ``quasi_disconnected_pairs`` (definition 3), and the ``Betti_numbers`` of
        the skeleton.

    Examples
    --------
    >>> Y = Polyball([(-0.5, 0), (0.5, 0)], [1, 1])
    >>> numbers = ball_numbers(Y, Y.skeleton())
    >>> numbers["balls"], numbers["singular_points"], numbers["Betti_numbers"]
    (2, 2, (1, 0))
    """
    return {
        "balls": len(Y),
        "needed": len(Y.minimal()),
        "area": Y.area(),
        "singular_points": len(Y.singular_points()),
        "disconnected_balls": len(Y.disconnected()),
        "quasi_disconnected_pairs": len(Y.quasi_disconnected()),
        "Betti_numbers": skeleton.betti(),
    }


class Balls(Explorer):
    """The explorer that `balls` returns.

    Attributes
    ----------
    polyball : Polyball
        As it is now.
    """

    words: ClassVar[dict[str, str]] = {
        "full": f"{MOST} balls are as many as can be moved by hand; remove one first.",
        "last": "One ball has to stay.",
        "tangent": "Balls {i} and {j} touch without crossing, which appendix A leaves out: the skeleton "
        "of the union would be cut there. Enlarge or shrink one of them a little.",
        "crowded": "Too many of these balls nearly coincide, or meet in nearly one point; move one of them.",
        "ball": "ball {i}",
        "centre": "centre of ball {i}",
        "rim": "rim of ball {i}",
    }
    live: ClassVar[dict[str, str]] = {
        **{"spokes": "lines", "balls": "circles", "rims": "circles", "boundary": "lines"},
        **{"voronoi": "lines", "singular": "points", "skeleton": "lines"},
    }

    def __init__(self, Y: Polyball):
        self._centers, self._radii = Y.centers.copy(), Y.radii.copy()
        self._angles = np.full(len(Y), np.pi / 4)
        self._placed = np.empty((0, 2))
        low, high = (Y.centers - Y.radii[:, None]).min(axis=0), (Y.centers + Y.radii[:, None]).max(axis=0)
        room = 0.35 * (high - low).max()
        board = Board((*(low - room), *(high + room)), alt=ALT)
        chosen = ipywidgets.Dropdown(options=_ball_names(len(Y)), description="ball")
        radius = ipywidgets.FloatSlider(
            Y.radii[0], min=0.02 * room, max=3 * room, step=0.01 * room, description="its radius"
        )
        graph = ipywidgets.Checkbox(True, description="Voronoi graph of the singular points", indent=False)
        add = ipywidgets.Button(description="add a ball", tooltip="Add a ball in the middle of the board")
        remove = ipywidgets.Button(description="remove this ball", tooltip="Remove the chosen ball")
        add.on_click(lambda _: self.add())
        remove.on_click(lambda _: self.remove(self.controls["ball"].value))
        self._shown = (0, float(Y.radii[0]))
        controls = {"ball": chosen, "radius": radius, "voronoi": graph, "add": add, "remove": remove}
        super().__init__(board, controls, LOOK_FOR)

    @property
    def polyball(self) -> Polyball:
        """The balls as they are now."""
        return Polyball(self._centers, self._radii)

    def add(self, center=None, radius: float | None = None) -> None:
        """Add a ball, by default a small one near the middle of the board, and choose it.

        Raises
        ------
        InputError
            If this is no ball.
        """
        xmin, ymin, xmax, ymax = self.board.box
        if len(self._radii) >= MOST:
            self.board.text = self.words["full"]
            return
        if center is None:  # beside the last one that was added
            aside = 0.06 * (ymax - ymin) * (len(self._radii) % 5 - 2)
            center = ((xmin + xmax) / 2 + aside, (ymin + ymax) / 2 + aside)
        radius = 0.12 * (ymax - ymin) if radius is None else radius
        Y = Polyball([*self._centers, center], [*self._radii, radius])  # refuses what is no ball
        self._centers, self._radii = Y.centers.copy(), Y.radii.copy()
        self._angles = np.append(self._angles, np.pi / 4)
        self._choose(len(Y) - 1)

    def remove(self, index: int) -> None:
        """Remove a ball; the last one stays."""
        if len(self._radii) == 1:
            self.board.text = self.words["last"]
            return
        self._centers, self._radii, self._angles = (
            np.delete(array, index, axis=0) for array in (self._centers, self._radii, self._angles)
        )
        self._choose(min(index, len(self._radii) - 1))

    def _choose(self, index: int) -> None:
        """Choose a ball after the number of balls has changed."""
        with self.together():
            self._placed = np.empty((0, 2))
            chosen = self.controls["ball"]
            chosen.options = _ball_names(len(self._radii))
            chosen.value = index

    def draw(self) -> None:
        """Take over what was moved, and draw the union and its skeleton."""
        self._take_over()
        Y, board = self.polyball, self.board
        numbers = range(1, len(Y) + 1)
        board.handle_labels = [self.words[part].format(i=i) for i in numbers for part in ("centre", "rim")]
        board.handles = self._handles()
        self._placed = np.array(board.handles)
        board.draw("spokes", "balls", lines=self._placed.reshape(-1, 2, 2), width=0.7, order=1.7)
        self._draw_boundary(Y)
        try:
            skeleton = Y.skeleton()
        except PolyskelError as error:
            board.draw("skeleton", "sk2", label="skeleton of the union")
            self.numbers = {}
            if not isinstance(error, TangentBallsError):
                raise  # its sentence is shown under the board
            i, j = min(np.sort(error.pairs, axis=1).tolist())  # numbered as on the board
            raise TangentBallsError(self.words["tangent"].format(i=i + 1, j=j + 1), error.pairs) from None
        lines, dots = skeleton.segments(), skeleton.vertices
        board.draw("skeleton", "sk2", lines=lines, points=dots, label="skeleton of the union")
        self.tell(**ball_numbers(Y, skeleton))

    def given(self) -> dict[str, object]:
        return {"centers": self._centers.tolist(), "radii": self._radii.tolist(), "most": MOST}

    def _draw_boundary(self, Y: Polyball) -> None:
        """The balls, their union, its singular points and their Voronoi graph."""
        draw, discs, singular = self.board.draw, (Y.centers, Y.radii), Y.singular_points()
        ball, start, end = Y.arcs()
        arcs = (Y.centers[ball], Y.radii[ball], start, end)
        graph = {"lines": _voronoi_lines(singular, self.board.view.around), "opacity": 0.45}
        shown, label = self.controls["voronoi"].value, "Voronoi graph of the singular points"
        draw("balls", "balls", circles=discs, opacity=0.9, stroke=False)
        draw("rims", "complement", circles=discs, fill=False, order=1.6, label="circles")
        draw("boundary", "balls", arcs=arcs, width=1.8, order=1.8, label="exposed arcs")
        draw("voronoi", "voronoi", shown, **graph, label=label)
        draw("singular", "samples", points=singular, width=1.8, label="singular points")

    def _take_over(self) -> None:
        """Read the handle that was dragged, or the slider that was moved."""
        places, chosen, radius = np.array(self.board.handles), self.controls["ball"], self.controls["radius"]
        if len(places) == len(self._placed) > 0:
            for k in np.flatnonzero((places != self._placed).any(axis=1)).tolist():
                i, rim = divmod(k, 2)
                if rim:
                    way = places[k] - self._centers[i]
                    self._angles[i] = np.arctan2(way[1], way[0])
                    self._radii[i] = max(float(np.hypot(*way)), radius.min)
                else:
                    self._centers[i] = places[k]
                chosen.value = i
        i = chosen.value
        # The browser moves the slider to the nearest of its steps by itself: that is not the reader's hand.
        if self._shown[0] == i and abs(radius.value - self._shown[1]) > 0.51 * radius.step:
            self._radii[i] = radius.value
        elif self._shown[0] != i or self._radii[i] != self._shown[1]:
            radius.value = float(np.clip(self._radii[i], radius.min, radius.max))
        self._shown = (i, float(np.clip(self._radii[i], radius.min, radius.max)))

    def _handles(self) -> np.ndarray:
        """Centre and rim of every ball; a rim whose place is off the board is turned to where it is on it."""
        xmin, ymin, xmax, ymax = self.board.box
        handles = []
        for center, radius, angle in zip(self._centers, self._radii, self._angles, strict=True):
            turns = angle + np.arange(8) * np.pi / 4
            rims = center + radius * np.column_stack([np.cos(turns), np.sin(turns)])
            inside = ((rims >= (xmin, ymin)) & (rims <= (xmax, ymax))).all(axis=1)
            handles += [center, rims[np.argmax(inside)]]
        return np.array(handles)


def _voronoi_lines(points: np.ndarray, box: np.ndarray) -> np.ndarray:
    try:
        graph = voronoi(points)
    except PolyskelError:
        return np.empty((0, 2, 2))  # fewer than three, or all on a line
    return np.concatenate([clip_segments(graph.segments(), box), ray_segments(graph, box)])


def _ball_names(count: int) -> list[tuple[str, int]]:
    return [(Balls.words["ball"].format(i=i + 1), i) for i in range(count)]


def balls(polyball: Polyball | None = None) -> Balls:
    """Explore the union of balls that you add, move and grow, and its exact skeleton (appendix A).

    In the plane both readings of definition 3 give the same skeleton; in space they differ.

    Parameters
    ----------
    polyball : Polyball, optional
        To begin with: discs of the plane, at most 16.

    Returns
    -------
    Balls
        A widget for JupyterLab. ``.polyball`` is what is shown, ``.add`` and ``.remove`` change it,
        ``.board.handles`` are centre and rim of every ball.

    Raises
    ------
    InputError
        If the balls are not discs of the plane, or more than 16.

    Examples
    --------
    >>> explorer = balls(Polyball([(-0.5, 0), (0.5, 0)], [1, 1]))
    >>> explorer.numbers["singular_points"]
    2
    >>> explorer.add((0.0, 1.2), 0.6)
    >>> explorer.numbers["singular_points"], len(explorer.board.handles)
    (3, 6)
    """
    Y = Polyball(CENTERS, RADII) if polyball is None else polyball
    if Y.dimension != 2:
        raise InputError(
            f"these balls have {Y.dimension} coordinates; the explorer is for discs of the plane."
        )
    if len(Y) > MOST:
        raise InputError(f"{len(Y)} balls are too many to move by hand; pass at most {MOST}.")
    return Balls(Y)
