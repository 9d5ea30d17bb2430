"""Explorer of sections 3.1 to 3.4: the four skeletons side by side, and their numbers."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from ...containment import delaunay_shape
from ...errors import ContourContainmentError, InputError, PolyskelError, ShapeError
from ...graphs import delaunay
from ...shapes import Shape
from ...skeletons import Skeleton, sk0, sk1, sk2, sk3
from ..drawing_board import Board, box_around
from .explorer import Explorer, flat_shape, rings_of, sample_sliders

_NAMES = ("sk1", "sk2", "sk3", "sk0")  # in the order of the sections


class FourMethods(Explorer):
    """See `four_methods`."""

    words: ClassVar[dict[str, str]] = {
        "alt": "Four pictures of a shape with {n} samples and a skeleton: {all}.",
        "line": "Shape: Betti {betti}. {all}",
        "crosses": "{name}: none, the polygon through the samples crosses itself",
        "missing_1": "{name}: none, 1 side is not Delaunay",
        "missing": "{name}: none, {missing} sides are not Delaunay",
        "counts": "{name}: {vertices} vertices, {edges} edges, Betti {betti}",
    }
    live: ClassVar[dict[str, str]] = {name: "points" if name == "sk1" else "lines" for name in _NAMES} | {
        **{f"heading_{name}": "text" for name in _NAMES},
        **{"samples": "points", "missing": "lines"},
    }

    def __init__(self, shape: Shape | None = None, n: int = 96, start: float = 0.7):
        self.shape = flat_shape(shape, "the four methods")
        controls = sample_sliders(self.shape, n, start)
        low, high = controls["n"].min, controls["n"].max
        if not (low <= n <= high and 0 <= start < 1):
            raise InputError(
                f"n = {n}, start = {start}; choose n from {low} to {high} and start from 0 to 0.95."
            )
        left, bottom, right, top = box_around(self.shape.points, 0.04)
        room = 0.1 * (right - left)  # for a line of text over each picture
        step = np.array([right - left, top - bottom + room])
        #: What is added to the coordinates in each of the four pictures: two rows of two.
        self.offsets = {name: step * (k % 2, -(k // 2)) for k, name in enumerate(_NAMES)}
        self._heading = left + 0.02 * (right - left), top + 0.35 * room
        board = Board((left, bottom - step[1], right + step[0], top + room), width=760)
        rings = [self.shape.points[ring] for ring in self.shape.rings()]
        copies = [ring + offset for offset in self.offsets.values() for ring in rings]
        board.draw("shape", "shape", polygons=copies, label="shape X")
        super().__init__(
            board,
            controls,
            "Lower n slowly: which skeleton breaks into pieces first, which one gets too many branches, and "
            "which keeps the Betti numbers of the shape as long as it exists?",
        )

    def skeletons(self) -> dict[str, Skeleton | PolyskelError]:
        """The four skeletons for the present sliders; in place of Sk0 the reason why there is none."""
        n, start = (self.controls[name].value for name in ("n", "start"))
        graph = delaunay(self.shape.sample(n, start))  # once for three of them
        found: dict[str, Skeleton | PolyskelError] = {
            f.__name__: f(self.shape, graph) for f in (sk1, sk2, sk3)
        }
        self._missing = np.empty((0, 2, 2))
        try:
            polygon = self.shape.resample(n, start)
            found["sk0"] = sk0(delaunay_shape(polygon))
        except ContourContainmentError as error:
            self._missing = polygon.segments[error.missing]
            found["sk0"] = error
        except ShapeError as error:  # so few samples that the polygon crosses itself
            found["sk0"] = error
        return found

    def draw(self) -> None:
        board, found = self.board, self.skeletons()
        E, betti = found["sk1"].tessellation.points, self.shape.betti()
        everywhere = np.concatenate([E + offset for offset in self.offsets.values()])
        board.draw("samples", "samples", points=everywhere, width=0.7, label="samples E")
        counts = {f"Sk{name[2]}": _counts(found[name]) for name in _NAMES}
        words = []
        for name, (title, numbers) in zip(_NAMES, counts.items(), strict=True):
            words.append(self._draw_one(name, found[name], numbers or {}, title))
            heading = (*(self._heading + self.offsets[name]), words[-1])
            board.draw(f"heading_{name}", "samples", text=[heading])
        shift = self.offsets["sk0"]
        label = "sides that are not Delaunay"
        board.draw("missing", "samples", lines=self._missing + shift, width=3, label=label)
        board.alt = self.words["alt"].format(n=len(E), all="; ".join(words))
        line = self.words["line"].format(betti=betti, all=" · ".join(words))
        self.say(line, counts | {"shape": betti, "n": len(E)})

    def given(self) -> dict[str, object]:
        offsets = {name: offset.tolist() for name, offset in self.offsets.items()}
        about: dict[str, object] = {"betti": self.shape.betti(), "offsets": offsets, "heading": self._heading}
        return rings_of(self.shape) | about

    def _draw_one(self, name: str, skeleton: Skeleton | PolyskelError, counts: dict, title: str) -> str:
        """Draw one skeleton in its own picture, and say its numbers."""
        if isinstance(skeleton, PolyskelError):
            self.board.draw(name, name, label=f"Sk_{name[2]}")
            count = len(self._missing)
            why = {0: "crosses", 1: "missing_1"}.get(count, "missing")
            return self.words[why].format(name=title, missing=count)
        lines, label = skeleton.segments() + self.offsets[name], f"Sk_{name[2]}"
        points = skeleton.vertices + self.offsets[name] if name == "sk1" else ()
        self.board.draw(name, name, lines=lines, points=points, label=label)
        return self.words["counts"].format(name=title, **counts)


def _counts(skeleton: Skeleton | PolyskelError) -> dict | None:
    if isinstance(skeleton, PolyskelError):
        return None
    return {"vertices": len(skeleton.vertices), "edges": len(skeleton.edges), "betti": skeleton.betti()}


def four_methods(shape: Shape | None = None, n: int = 96, start: float = 0.7) -> FourMethods:
    """Explore the four skeletons Sk1, Sk2, Sk3 and Sk0 of one shape side by side (sections 3.1 to 3.4).

    Parameters
    ----------
    shape : Shape, optional
        Of the plane, by default the horse.
    n : int
        Number of samples at first.
    start : float
        Shifts them by this share of a step.

    Returns
    -------
    FourMethods
        An `Explorer`. Controls: ``n`` and ``start``. `numbers` has vertices, edges and Betti numbers of
        each skeleton; Sk0 is None where the polygon through the samples is not in their Delaunay graph.

    Raises
    ------
    InputError
        If `shape` is not a shape of the plane, or `n` or `start` is not on its slider.

    Examples
    --------
    >>> explorer = four_methods()
    >>> explorer.numbers["Sk0"]["betti"], explorer.numbers["shape"]
    ((1, 0), (1, 0))
    >>> explorer.controls["n"].value = 60
    >>> explorer.numbers["Sk0"] is None, explorer.numbers["Sk2"]["betti"][0] > 1
    (True, True)
    """
    return FourMethods(shape, n, start)
