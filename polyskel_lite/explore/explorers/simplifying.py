"""Thresholds and criteria of the simplification, on shapes in the plane and in space (section 4.3)."""

from __future__ import annotations

from functools import cache

import ipywidgets
import numpy as np

from ... import datasets
from ...containment import DelaunayShape
from ...shapes import Shape
from ...simplification import STRATEGIES, Hierarchy, end_vertices, hierarchy, paths_back, ways
from ...skeletons import sk0
from ..drawing_board import Board, box_around
from ..skeleton_viewer import viewer
from .explorer import Explorer, WithStandIn, outline, refined

LOOK_FOR = (
    "Move the threshold from left to right. Look for the order in which branches go, small ripples of the "
    "boundary first, and for the Betti numbers, which stay. Which threshold leaves what you would draw by "
    "hand? Then choose the criterion of the transcript, at the same threshold."
)
LOOK_FOR_3D = (
    "Move the threshold, once with each strategy. Surface skeletons lose sheets from their rims, wireframes "
    "lose branches. Look for the Betti numbers, which stay, and for what the other readings remove."
)
ALT = "A shape, its simplified shape tinted, its skeleton dotted, and what is left of it as a red line."


def threshold_numbers(h: Hierarchy, threshold: float) -> dict[str, object]:
    """The simplified skeleton in numbers.

    Returns
    -------
    dict
        ``threshold`` as a multiple of π, ``simplices`` kept, ``of`` how many, ``ends`` (the branches that the
        paper counts) and the ``Betti_numbers`` of the skeleton, in 3D of the simplified shape: they are the
        same, and quicker to compute.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> numbers = threshold_numbers(psl.hierarchy(psl.datasets.load("gear")), 2 * np.pi)
    >>> numbers["threshold"], numbers["ends"], numbers["Betti_numbers"]
    (2.0, 0, (1, 1))
    """
    return {
        "threshold": round(threshold / np.pi, 6),
        "simplices": int((h.level >= threshold).sum()),
        "of": len(h.level),
        "ends": h.branches(threshold).graph["branches"],
        "Betti_numbers": (h.skeleton if h.P.dimension == 2 else h.shape)(threshold).betti(),
    }


def threshold_text(numbers: dict[str, object]) -> str:
    """`threshold_numbers` as a sentence.

    Examples
    --------
    >>> threshold_text({"threshold": 0.5, "simplices": 9, "of": 12, "ends": 1, "Betti_numbers": (1, 0)})
    'Threshold 0.50 π: 9 of 12 triangles stay, the skeleton has 1 branch that ends, Betti numbers (1, 0).'
    """
    branches = "1 branch that ends" if numbers["ends"] == 1 else f"{numbers['ends']} branches that end"
    return (
        f"Threshold {numbers['threshold']:.2f} π: {numbers['simplices']} of {numbers['of']} triangles stay, "
        f"the skeleton has {branches}, Betti numbers {numbers['Betti_numbers']}."
    )


class Thresholds(Explorer):
    """The explorer that `thresholds` returns for shapes in the plane."""

    def __init__(self, P: DelaunayShape):
        self.P = P
        self._hierarchy = cache(lambda criterion: hierarchy(P, criterion=criterion))
        self._ways = cache(ways)
        threshold = ipywidgets.FloatSlider(
            1.0, min=0, max=6, step=0.05, readout_format=".2f", description="threshold (multiples of π)"
        )
        criterion = ipywidgets.Dropdown(options=["corrected", "transcript"], description="criterion")
        ends = ipywidgets.Dropdown(
            options=["nothing", "their balls", "the way they have come"], description="show at the ends"
        )
        points = P.tessellation.points
        board = Board(box_around(points, 0.03), alt=ALT)
        board.draw("shape", "shape", polygons=outline(points, P.boundary()), label="shape")
        board.draw("all", "complement", lines=sk0(P).segments(), label="whole skeleton")
        super().__init__(board, {"threshold": threshold, "criterion": criterion, "ends": ends}, LOOK_FOR)

    @property
    def hierarchy(self) -> Hierarchy:
        """That of the chosen criterion."""
        return self._hierarchy(self.controls["criterion"].value)

    def draw(self) -> None:
        """Draw what is left at the chosen threshold."""
        h, draw, shown = self.hierarchy, self.board.draw, self.controls["ends"].value
        threshold = self.controls["threshold"].value * np.pi
        ends = h.simplices[end_vertices(h, threshold)]
        t = self.P.tessellation
        places, radii = t.circumcenters[ends], t.circumradii[ends]
        back, way, ball = paths_back(h, threshold, self._ways(h)), "the way they have come", "their balls"
        left, simplified = h.skeleton(threshold).segments(), outline(t.points, h.shape(threshold).boundary())
        draw("simplified", "delaunay", polygons=simplified, label="simplified shape", order=1.2)
        draw("skeleton", "sk0", lines=left, label="skeleton left")
        draw("ways", "sk2", shown == way, lines=back, label="the way its ends have come")
        draw("balls", "balls", shown == ball, circles=(places, radii), fill=False, label="balls of its ends")
        draw("ends", "sk2", shown in (way, ball), points=places, width=1.4)
        numbers = threshold_numbers(h, threshold)
        self.say(threshold_text(numbers), numbers)


class SolidThresholds(WithStandIn):
    """What `thresholds` returns for solids: the skeleton viewer with both strategies and both criteria.

    Attributes
    ----------
    picture : SkeletonViewer
        Its ``threshold`` and ``strategy`` follow the reader's hand, and it says the numbers.
    hierarchies : list of Hierarchy
    """

    look_for = LOOK_FOR_3D

    def __init__(self, P: DelaunayShape):
        self.hierarchies = [
            hierarchy(P, strategy, criterion)
            for strategy in STRATEGIES[3]
            for criterion in ("corrected", "transcript")
        ]
        about = "A solid and its simplified skeleton."
        self.picture = viewer(self.hierarchies, threshold=np.pi / 3, alt=about, look=self.look_for)
        super().__init__([self.picture])

    @property
    def hierarchy(self) -> Hierarchy:
        """That of the strategy and the criterion chosen."""
        named = {f"{h.strategy}, {h.criterion}": h for h in self.hierarchies}
        return named[self.picture.strategy]

    @property
    def numbers(self) -> dict[str, object]:
        """See `threshold_numbers`."""
        return threshold_numbers(self.hierarchy, self.picture.threshold)

    def stand_in(self) -> str:
        """HTML for a page without a kernel: the viewer works there too."""
        return self.picture.to_html()


def thresholds(shape: Shape | DelaunayShape | None = None) -> Thresholds | SolidThresholds:
    """Explore thresholds, strategies and criteria of the simplification (section 4.3).

    Parameters
    ----------
    shape : Shape or DelaunayShape, optional
        By default the leaf. A `Shape` is refined first, with `polyskel_lite.conform`.

    Returns
    -------
    Thresholds or SolidThresholds
        A widget for JupyterLab; in space it holds a `viewer`. ``.numbers`` tells what is
        shown, ``.hierarchy`` is the one chosen.

    Raises
    ------
    ContourContainmentError
        If a solid cannot be refined.

    Examples
    --------
    >>> explorer = thresholds(datasets.load("lake"))
    >>> explorer.controls["threshold"].value = 2
    >>> explorer.numbers["Betti_numbers"]
    (1, 2)
    >>> solid = thresholds(datasets.load("fourbranch"))
    >>> solid.picture.strategy = "wireframe, corrected"
    >>> solid.picture.threshold = 2 * np.pi
    >>> solid.numbers["ends"]
    4
    """
    P = refined(datasets.load("leaf") if shape is None else shape)
    return Thresholds(P) if P.dimension == 2 else SolidThresholds(P)
