"""Refinement step by step: how a boundary gets into the Gabriel graph (section 3.5)."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, ClassVar

import ipywidgets
import numpy as np

from ... import datasets
from ...containment import Stage, conform_stages, diametral_balls
from ..drawing_board import Board, box_around
from .explorer import Explorer, outline

if TYPE_CHECKING:
    from ...shapes import Shape

LOOK_FOR = (
    "Move the step slider from left to right. Look for the balls that a purple sample has entered: their "
    "sides are cut, at acute corners at one distance from the corner, all others in the middle. Do the balls "
    "run out?"
)
ALT = (
    "Outline of a shape. Sides in the graph are green, sides that are not in it are red, each with the ball "
    "around it and the samples inside that ball as purple diamonds."
)


def refinement_text(stages: list[Stage], step: int, to: str = "gabriel") -> str:
    """One stage in numbers and words.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> acute = psl.Shape.from_rings([[(0, 0), (13, 0), (10 * 3**0.5 / 2, 5)]])
    >>> stages = list(conform_stages(acute))
    >>> print(refinement_text(stages, 0))
    Step 0 of 1: 3 samples, 1 of 3 sides is not in the Gabriel graph. Next, 2 acute corners are cut.
    >>> print(refinement_text(stages, 1))
    Step 1 of 1: 7 samples, all 7 sides are in the Gabriel graph: Theorems 1 and 2 apply.
    """
    stage, graph = stages[step], "Gabriel graph" if to == "gabriel" else "Delaunay triangulation"
    head = f"Step {step} of {len(stages) - 1}: {len(stage.points)} samples, "
    if not len(stage.missing):
        means = "Theorems 1 and 2 apply" if to == "gabriel" else "Sk0 is defined"
        return f"{head}all {len(stage.facets)} sides are in the {graph}: {means}."
    todo = [
        f"{count} {one if count == 1 else many}"
        for count, one, many in (
            (len(stage.corners), "acute corner is cut", "acute corners are cut"),
            (len(stage.halved), "side is halved", "sides are halved"),
        )
        if count
    ]
    verb = "is" if len(stage.missing) == 1 else "are"
    return (
        f"{head}{len(stage.missing)} of {len(stage.facets)} sides {verb} not in the {graph}. "
        f"Next, {' and '.join(todo)}."
    )


class Refinement(Explorer):
    """The explorer that `refinement` returns.

    Attributes
    ----------
    stages : list of Stage
        All rounds for the graph chosen.
    """

    live: ClassVar[dict[str, str]] = {
        **{"balls": "circles", "there": "lines", "missing": "lines"},
        **{"samples": "points", "added": "points", "intruders": "points"},
    }

    def __init__(self, shape: Shape):
        self._stages = cache(lambda to: list(conform_stages(shape, to)))
        self._stages("gabriel")  # here, so that what cannot be refined is refused
        graph = ipywidgets.Dropdown(
            options=[("Gabriel graph", "gabriel"), ("Delaunay triangulation", "delaunay")],
            description="graph to reach",
        )
        step = ipywidgets.IntSlider(0, min=0, max=1, description="step")
        balls = ipywidgets.Checkbox(True, description="balls of the sides that are not in the graph")
        board = Board(box_around(shape.points), alt=ALT)
        super().__init__(board, {"step": step, "graph": graph, "balls": balls}, LOOK_FOR)

    @property
    def stages(self) -> list[Stage]:
        """All rounds, from the given boundary to the refined one."""
        return self._stages(self.controls["graph"].value)

    def draw(self) -> None:
        """Draw the chosen stage."""
        stages, slider = self.stages, self.controls["step"]
        slider.max = len(stages) - 1
        step = slider.value
        self._draw_stage(stages[step], stages[max(step - 1, 0)])
        numbers = {
            "step": step,
            "samples": len(stages[step].points),
            "sides": len(stages[step].facets),
            "missing": len(stages[step].missing),
            "missing_per_step": [len(stage.missing) for stage in stages],
        }
        self.say(refinement_text(stages, step, self.controls["graph"].value), numbers)

    def given(self) -> dict[str, object]:
        """All rounds for both graphs, as they are drawn."""
        return {"rounds": {to: self._rounds(to) for to in ("gabriel", "delaunay")}}

    def _rounds(self, to: str) -> dict[str, list]:
        stages = self._stages(to)
        return {
            "points": stages[-1].points.tolist(),  # every round adds some at the end
            "stages": [
                {
                    "samples": len(stage.points),
                    "facets": stage.facets.tolist(),
                    "missing": stage.missing.tolist(),
                    "intruders": diametral_balls(stage)[2].tolist(),
                    "text": refinement_text(stages, step, to),
                }
                for step, stage in enumerate(stages)
            ],
        }

    def _draw_stage(self, stage: Stage, before: Stage) -> None:
        draw, points, first, old = self.board.draw, stage.points, self.stages[0], len(before.points)
        centers, radii, intruders = diametral_balls(stage)
        there = np.delete(stage.facets, stage.missing, axis=0)
        missing, seen = stage.facets[stage.missing], self.controls["balls"].value
        draw("shape", "shape", polygons=outline(first.points, first.facets), stroke=False)
        draw("balls", "balls", seen, circles=(centers, radii), opacity=0.6, label="smallest ball")
        draw("there", "gabriel", lines=points[there], label="side in the graph")
        draw("missing", "sk0", lines=points[missing], width=1.6, label="side not in it")
        draw("samples", "samples", points=points[:old])
        draw("added", "sk2", points=points[old:], width=1.8, order=6.2, label="new in this step")
        draw("intruders", "sk1", points=points[intruders], width=2.2, order=6.5, label="sample in a ball")


def refinement(shape: Shape | None = None) -> Refinement:
    """Explore how a boundary is refined until it lies in the Gabriel graph (section 3.5).

    Parameters
    ----------
    shape : Shape, optional
        In 2D; by default the horse with 40 samples.

    Returns
    -------
    Refinement
        A widget for JupyterLab. ``.controls["step"].value`` sets the step from Python, ``.numbers`` tells
        what is shown.

    Raises
    ------
    InputError
        If the shape is in space.
    TessellationError
        If the refinement needs too many vertices, see `polyskel_lite.conform`.

    Examples
    --------
    >>> explorer = refinement()
    >>> explorer.controls["step"].value = 1
    >>> explorer.numbers["missing_per_step"][:3], explorer.numbers["missing"]
    ([11, 10, 7], 10)
    """
    return Refinement(datasets.load("horse", n=40) if shape is None else shape)
