"""Explorer of section 2.2: Delaunay, Voronoi and Gabriel graph over points that the reader moves."""

from __future__ import annotations

import ipywidgets
import numpy as np

from ..errors import InputError
from ..graphs import delaunay, gabriel, voronoi
from ..predicates import as_points
from .board import Board, box_around
from .explorer import Explorer

_WORDS = {"delaunay": "Delaunay", "voronoi": "Voronoi", "gabriel": "Gabriel"}
#: Ten points with acute and obtuse triangles, so that each graph has something to show.
START = (
    (1, 2.2),
    (2.4, 0.9),
    (3.1, 3.4),
    (4.6, 2.0),
    (5.2, 4.3),
    (6.3, 0.8),
    (7.0, 3.0),
    (8.4, 4.4),
    (8.9, 1.6),
    (2.0, 4.6),
)


class Graphs(Explorer):
    """See `graphs`."""

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
        super().__init__(
            board,
            controls,
            "Move a sample: a Delaunay triangle flips just when another sample enters its ball, and two Voronoi "
            "vertices meet; a segment is Gabriel while its own Voronoi edge crosses it.",
        )

    def draw(self) -> None:
        board, chosen = self.board, self.controls
        graph = delaunay(board.handles)
        segments = graph.facets()
        close = gabriel(graph)
        dual = voronoi(graph)
        slider = chosen["triangle"]
        slider.max = len(graph.simplices) - 1
        board.draw(
            "delaunay", "delaunay", chosen["delaunay"].value, lines=graph.points[segments], label="Delaunay"
        )
        board.draw("gabriel", "gabriel", chosen["gabriel"].value, lines=graph.points[close], label="Gabriel")
        board.draw(
            "voronoi",
            "voronoi",
            chosen["voronoi"].value,
            lines=np.concatenate([dual.segments(), _rays(dual, board.box)]),
            label="Voronoi",
        )
        ball = slice(slider.value, slider.value + 1) if slider.value >= 0 else slice(0)
        center, radius = graph.circumcenters[ball], graph.circumradii[ball]
        board.draw("ball", "balls", circles=(center, radius), label="ball of one triangle")
        board.draw("center", "voronoi", points=center, width=2)
        board.alt = (
            f"{len(graph.points)} movable dots with "
            + _listed([w for k, w in _WORDS.items() if chosen[k].value])
            + (f" and the empty disc through the corners of triangle {slider.value}." if len(radius) else ".")
        )
        self.tell(
            samples=len(graph.points),
            triangles=len(graph.simplices),
            Delaunay_segments=len(segments),
            Gabriel_segments=len(close),
            Voronoi_vertices=len(dual.vertices),
            **({"radius_of_the_ball": float(radius[0])} if len(radius) else {}),
        )


def graphs(points=START) -> Graphs:
    """Explore the three graphs of section 2.2 over points that can be moved.

    Parameters
    ----------
    points : (n, 2) array-like
        At least three, not on one line, at most 40.

    Returns
    -------
    Graphs
        An `Explorer`; its handles are the points. Controls: ``delaunay``, ``voronoi``, ``gabriel`` (on or off)
        and ``triangle``, whose empty ball is shown.

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


def _listed(names: list[str]) -> str:
    return f"their {', '.join(names)} graph" if names else "no graph"
