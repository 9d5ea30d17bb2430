"""Refinement step by step: how a boundary gets into the Gabriel graph (section 3.5)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import ipywidgets
import numpy as np

from ... import datasets
from ...containment import Stage, conform_stages, diametral_balls
from ...drawing import chains
from ..drawing_board import Board, box_around
from .explorer import Explorer

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


def refinement_layers(stages: list[Stage], step: int) -> dict[str, dict]:
    """What is drawn of one stage, for `polyskel_lite.explore.Board`.

    Parameters
    ----------
    stages : list of Stage
    step : int
        Which one.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> stages = list(conform_stages(psl.datasets.load("horse", n=40)))
    >>> layers = refinement_layers(stages, 0)
    >>> len(layers["missing"]["lines"]) == len(stages[0].missing), len(layers["added"]["points"])
    (True, 0)
    """
    stage = stages[step]
    first = stages[0]
    before = len(stages[step - 1].points) if step else len(stage.points)
    centers, radii, intruders = diametral_balls(stage)
    there = np.ones(len(stage.facets), dtype=bool)
    there[stage.missing] = False
    return {
        "shape": {"kind": "shape", "polygons": _rings(first), "stroke": False},
        "balls": {"kind": "balls", "circles": (centers, radii), "opacity": 0.6, "label": "smallest ball"},
        "there": {
            "kind": "gabriel",
            "lines": stage.points[stage.facets[there]],
            "label": "side in the graph",
        },
        "missing": {
            "kind": "sk0",
            "lines": stage.points[stage.facets[stage.missing]],
            "width": 1.6,
            "label": "side not in it",
        },
        "samples": {"kind": "samples", "points": stage.points[:before]},
        "added": {
            "kind": "sk2",
            "points": stage.points[before:],
            "width": 1.8,
            "order": 6.2,
            "label": "new in this step",
        },
        "intruders": {
            "kind": "sk1",
            "points": stage.points[intruders],
            "width": 2.2,
            "order": 6.5,
            "label": "sample in a ball",
        },
    }


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
    corners = len(stage.corners)
    halved = int((~np.isin(stage.facets[stage.missing], stage.corners).any(axis=1)).sum())
    todo = [
        f"{count} {one if count == 1 else many}"
        for count, one, many in (
            (corners, "acute corner is cut", "acute corners are cut"),
            (halved, "side is halved", "sides are halved"),
        )
        if count
    ]
    verb = "is" if len(stage.missing) == 1 else "are"
    return (
        f"{head}{len(stage.missing)} of {len(stage.facets)} sides {verb} not in the {graph}. "
        f"Next, {' and '.join(todo)}."
    )


def _rings(stage: Stage) -> list[np.ndarray]:
    return [stage.points[path] for path in chains(stage.facets)]


class Refinement(Explorer):
    """The explorer that `refinement` returns.

    Attributes
    ----------
    stages : list of Stage
        All rounds for the graph chosen.
    """

    def __init__(self, shape: Shape):
        self.shape = shape
        self._made: dict[str, list[Stage]] = {"gabriel": list(conform_stages(shape, "gabriel"))}
        graph = ipywidgets.Dropdown(
            options=[("Gabriel graph", "gabriel"), ("Delaunay triangulation", "delaunay")],
            description="graph to reach",
        )
        step = ipywidgets.IntSlider(0, min=0, max=1, description="step")
        balls = ipywidgets.Checkbox(True, description="balls of the sides that are not in the graph")
        board = Board(box_around(shape.points), alt=ALT)
        super().__init__(board, {"graph": graph, "step": step, "balls": balls}, LOOK_FOR)

    @property
    def stages(self) -> list[Stage]:
        """All rounds, from the given boundary to the refined one."""
        to = self.controls["graph"].value
        if to not in self._made:
            self._made[to] = list(conform_stages(self.shape, to))
        return self._made[to]

    def draw(self) -> None:
        """Draw the chosen stage."""
        step = self.controls["step"]
        step.max = max(len(self.stages) - 1, 0)
        for name, layer in refinement_layers(self.stages, step.value).items():
            self.board.draw(name, **layer, visible=name != "balls" or self.controls["balls"].value)
        stage = self.stages[step.value]
        self.tell(refinement_text(self.stages, step.value, self.controls["graph"].value))
        self.numbers = {
            "step": step.value,
            "samples": len(stage.points),
            "sides": len(stage.facets),
            "missing": len(stage.missing),
            "missing_per_step": [len(stage.missing) for stage in self.stages],
        }


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
