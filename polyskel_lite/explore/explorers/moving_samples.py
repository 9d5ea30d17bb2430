"""Explorer of section 2.2: Delaunay, Voronoi and Gabriel graph over points that the reader moves."""

from __future__ import annotations

from typing import ClassVar

import ipywidgets
import numpy as np

from ...checks import as_points
from ...errors import InputError
from ...graphs import Tessellation, delaunay, gabriel
from ...skeletons import voronoi
from ..drawing_board import Board, box_around
from .explorer import Explorer

_WORDS = {"delaunay": "Delaunay", "voronoi": "Voronoi", "gabriel": "Gabriel"}
#: Ten points with acute and obtuse triangles, so that each graph has something to show.
START = (
    *((1, 2.2), (2.4, 0.9), (3.1, 3.4), (4.6, 2.0), (5.2, 4.3)),
    *((6.3, 0.8), (7.0, 3.0), (8.4, 4.4), (8.9, 1.6), (2.0, 4.6)),
)


class Graphs(Explorer):
    """See `graphs`."""

    words: ClassVar[dict[str, str]] = {
        "alt": "{n} dots; graphs: {graphs}.",
        "alt_with_ball": "{n} dots; graphs: {graphs}; the empty disc through the corners of triangle "
        "{number}.",
        "none": "none",
        "lost": "Samples {rest} and {last} are no triangle any more: a sample came into their ball.",
        "in_line": "All samples are on one line: there is no triangle.",
        "twice": "Samples {i} and {j} are at one place; move one of them.",
    }
    live: ClassVar[dict[str, str]] = dict.fromkeys(_WORDS, "lines") | {"ball": "circles", "center": "points"}

    def __init__(self, points=START):
        points = as_points(points, dimensions=(2,))
        if len(points) > 40:
            raise InputError(f"{len(points)} points are too many to move by hand; pass at most 40.")
        names = [f"sample {i}" for i in range(len(points))]
        board = Board(box_around(points, 0.2), handles=points, handle_labels=names)
        controls = {
            name: ipywidgets.Checkbox(name != "gabriel", description=f"{word} graph", indent=False)
            for name, word in _WORDS.items()
        }
        count = len(delaunay(points).simplices)
        controls["triangle"] = ipywidgets.IntSlider(
            count // 2, min=-1, max=count - 1, description="ball of triangle (-1: none)"
        )
        self._number, self._corners = -1, frozenset()
        super().__init__(
            board,
            controls,
            "Move a sample: a Delaunay triangle flips just when another sample enters its ball, and two "
            "Voronoi vertices meet there; a segment is Gabriel while its own Voronoi edge crosses it.",
        )

    def draw(self) -> None:
        board = self.board
        graph = delaunay(board.handles)
        dual = voronoi(graph)
        remark = self._follow(graph)
        lines = {
            "delaunay": graph.points[graph.facets()],
            "voronoi": np.concatenate([dual.segments(), _rays(dual, board.box)]),
            "gabriel": graph.points[gabriel(graph)],
        }
        chosen = [name for name in lines if self.controls[name].value]
        for name, segments in lines.items():
            board.draw(name, name, name in chosen, lines=segments, label=_WORDS[name])
        number = self.controls["triangle"].value
        ball = self._rows[number : number + 1 if number >= 0 else number]
        center, radius = graph.circumcenters[ball], graph.circumradii[ball]
        board.draw("ball", "balls", circles=(center, radius), label="ball of one triangle")
        board.draw("center", "voronoi", points=center, width=2)
        names = ", ".join(_WORDS[name] for name in chosen) or self.words["none"]
        alt = self.words["alt_with_ball" if len(radius) else "alt"]
        board.alt = alt.format(n=len(graph.points), graphs=names, number=number)
        self.tell(
            remark,
            samples=len(graph.points),
            triangles=len(graph.simplices),
            Delaunay_segments=len(lines["delaunay"]),
            Gabriel_segments=len(lines["gabriel"]),
            Voronoi_vertices=len(dual.vertices),
            **({"radius_of_the_ball": float(radius[0])} if len(radius) else {}),
        )

    def given(self) -> dict[str, object]:
        return {"graphs": _WORDS}

    def _follow(self, graph: Tessellation) -> str:
        """Keep the ball on its triangle while samples move; a sentence when that triangle is gone."""
        slider = self.controls["triangle"]
        # By their corners, so that a triangle has one number wherever it was computed.
        triples = np.sort(graph.simplices, axis=1)
        self._rows = np.lexsort(triples.T[::-1])
        triangles = [frozenset(corners) for corners in triples[self._rows].tolist()]
        moved = slider.value != self._number  # by the reader's hand
        slider.max = len(triangles) - 1
        if slider.value < 0:
            self._number = -1
            return ""
        lost = ""
        if not moved:
            if self._corners in triangles:
                slider.value = triangles.index(self._corners)
            else:
                *rest, last = map(str, sorted(self._corners))
                lost = self.words["lost"].format(rest=", ".join(rest), last=last)
        self._number, self._corners = slider.value, triangles[slider.value]
        return lost


def graphs(points=START) -> Graphs:
    """Explore the three graphs of section 2.2 over points that can be moved.

    Parameters
    ----------
    points : (n, 2) array-like
        At least three, not on one line, at most 40.

    Returns
    -------
    Graphs
        An `Explorer`; its handles are the points. Controls: ``delaunay``, ``voronoi``, ``gabriel`` (on or
        off) and ``triangle``, whose empty ball is shown.

    Raises
    ------
    InputError, TessellationError
        As `polyskel_lite.delaunay`.

    Examples
    --------
    >>> explorer = graphs([(0, 0), (4, 0), (4, 3), (0, 3)])
    >>> explorer.numbers["triangles"], explorer.numbers["radius_of_the_ball"]
    (2, 2.5)
    >>> explorer.board.handles = [(0, 0), (4, 0), (4, 3), (1, 1)]
    >>> explorer.numbers["Gabriel_segments"]
    4
    """
    return Graphs(points)


def _rays(dual, box) -> np.ndarray:
    """The unbounded Voronoi edges as segments that leave the box."""
    start = dual.vertices[dual.ray_vertices]
    far = np.hypot(box[2] - box[0], box[3] - box[1]) + np.abs(start).max(axis=1, initial=0)
    return np.stack([start, start + far[:, None] * dual.rays], axis=1)
