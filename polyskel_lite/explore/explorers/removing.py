"""Elementary removals one at a time: which triangle may go, and what the skeleton loses (section 4.2)."""

from __future__ import annotations

import ipywidgets
import numpy as np

from ... import datasets
from ...containment import DelaunayShape, conform, delaunay_shape
from ...errors import InputError
from ...shapes import Shape
from ...simplification import Hierarchy, hierarchy, state_at, try_removal
from ...skeletons import sk0
from ..drawing_board import Board, box_around
from .explorer import Explorer

LOOK_FOR = (
    "Move the slider: the orange triangle goes next, and with it its vertex and its edge of the skeleton. "
    "Look at the Betti numbers: they never change. Then choose a triangle that shares two or three sides, "
    "and see what its removal would do."
)
ALT = (
    "Left, a shape cut into triangles, one of them marked with its ball. Right, the skeleton of the "
    "triangles left, with the vertex and the edges that go with the marked triangle in blue."
)

#: What removing a triangle does, by the number of its sides that it shares with the shape that is left.
_KINDS = {
    0: "the last triangle of a part",
    1: "a hat triangle",
    2: "a triangle in a strip",
    3: "a triangle at a junction",
}


def removal_layers(h: Hierarchy, step: int, triangle: int | None = None) -> dict[str, dict]:
    """What is drawn: the triangles that are left with one marked, and to the right of them the skeleton.

    Returns
    -------
    dict of layers for `polyskel_lite.explore.Board`

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> h = psl.hierarchy(psl.datasets.load("gear", n=40))
    >>> layers = removal_layers(h, 2)
    >>> len(layers["triangles"]["polygons"]) - int(h.P.inner.sum()), len(layers["marked"]["polygons"])
    (-2, 1)
    """
    P, _ = state_at(h, step)
    t, removal, aside = P.tessellation, try_removal(h, step, triangle), beside(h)
    corners, outline = t.points[t.simplices], t.points[h.P.boundary()]
    skeleton, whole = sk0(P), sk0(h.P)
    row = [] if removal is None else [removal.triangle]
    going = np.isin(skeleton.simplices[skeleton.edges], row).any(axis=1)
    return {
        "outline": {"kind": "shape", "lines": np.concatenate([outline, outline + aside])},
        "triangles": {"kind": "delaunay", "polygons": list(corners[P.inner]), "label": "triangles left"},
        "marked": {
            "kind": "voronoi",
            "polygons": list(corners[row]),
            "label": "triangle in question",
            "order": 2.6,
        },
        "ball": {
            "kind": "balls",
            "circles": (t.circumcenters[row], t.circumradii[row]),
            "fill": False,
            "label": "its ball",
            "order": 2.7,
        },
        "gone": {"kind": "complement", "lines": whole.segments() + aside, "label": "skeleton at the start"},
        "skeleton": {
            "kind": "sk0",
            "lines": skeleton.segments() + aside,
            "points": skeleton.vertices + aside,
            "label": "Sk_0 of what is left",
        },
        "goes": {
            "kind": "sk2",
            "lines": skeleton.segments()[going] + aside,
            "points": t.circumcenters[row] + aside,
            "width": 2.0,
            "label": "what goes with the triangle",
            "order": 5.0,
        },
    }


def beside(h: Hierarchy) -> np.ndarray:
    """The way from the picture of the triangles to that of the skeleton, (2,) float array.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> beside(psl.hierarchy(psl.Shape.from_rings([[(0, 0), (10, 0), (0, 10)]]))).tolist()
    [11.5, 0.0]
    """
    return np.array([1.15 * np.ptp(h.P.tessellation.points[:, 0]), 0.0])


def removal_text(h: Hierarchy, step: int, triangle: int | None = None) -> str:
    """The removal in numbers and words.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> h = psl.hierarchy(psl.datasets.load("gear", n=40))
    >>> print(removal_text(h, 0))  # doctest: +ELLIPSIS
    0 of 18 triangles are gone. Triangle ... is a hat triangle: it shares 1 side with the others, so it may
    go. p/r = ... = 0.79 π: it goes at a threshold above that. Betti numbers (1, 1) with it, (1, 1) without
    it: the topology stays.
    """
    removal = try_removal(h, step, triangle)
    gone = f"{step} of {len(h.order)} triangles are gone."
    if removal is None and triangle is None:
        return f"{gone} No hat is left: what remains cannot go without a change of topology."
    if removal is None:
        return f"{gone} Triangle {triangle} is not there any more; choose another one."
    sides = "1 side" if removal.shared == 1 else f"{removal.shared} sides"
    allowed = "it may go" if removal.shared == 1 else "it must stay"
    same = removal.before == removal.after
    value = f"p/r = {removal.length:.3g} / {removal.radius:.3g} = {removal.value / np.pi:.2f} π"
    level = float(h.level[np.searchsorted(h.simplices, removal.triangle)])
    if removal.shared != 1:
        words = ""
    elif level > removal.value * (1 + 1e-9):
        # The hats before it had larger values; it waits for them, and goes with the largest.
        words = f"{value}; it waited for others, and goes at a threshold above {level / np.pi:.2f} π. "
    else:
        words = f"{value}: it goes at a threshold above that. "
    return (
        f"{gone} Triangle {removal.triangle} is {_KINDS[removal.shared]}: it shares {sides} with the others, "
        f"so {allowed}. {words}Betti numbers {removal.before} with it, {removal.after} without it: "
        f"the topology {'stays' if same else 'changes'}."
    )


class Removals(Explorer):
    """The explorer that `removals` returns.

    Attributes
    ----------
    hierarchy : Hierarchy
    """

    def __init__(self, h: Hierarchy):
        self.hierarchy = h
        step = ipywidgets.IntSlider(0, min=0, max=len(h.order), description="triangles gone")
        other = ipywidgets.Dropdown(
            options=[("the next one", -1), *((f"triangle {row}", row) for row in h.simplices.tolist())],
            description="triangle in question",
        )
        points = h.P.tessellation.points
        board = Board(box_around(np.concatenate([points, points + beside(h)]), 0.02), alt=ALT, width=800)
        super().__init__(board, {"step": step, "triangle": other}, LOOK_FOR)

    def draw(self) -> None:
        """Draw the state after the chosen number of removals."""
        step, chosen = self.controls["step"].value, self.controls["triangle"].value
        triangle = None if chosen < 0 else chosen
        for name, layer in removal_layers(self.hierarchy, step, triangle).items():
            self.board.draw(name, **layer)
        removal = try_removal(self.hierarchy, step, triangle)
        self.tell(removal_text(self.hierarchy, step, triangle))
        self.numbers = {"gone": step, "left": len(self.hierarchy.level) - step}
        if removal:
            self.numbers |= removal._asdict() | {"value": removal.value}


def removals(shape: Shape | DelaunayShape | None = None) -> Removals:
    """Explore the elementary removals one at a time, in the order of the hierarchy (section 4.2).

    In the plane all of them are hats; there are salients in space only.

    Parameters
    ----------
    shape : Shape or DelaunayShape, optional
        In 2D and small; by default the gear with 60 samples. A `Shape` is refined until
        it is in Del(E).

    Returns
    -------
    Removals
        A widget for JupyterLab. ``.numbers`` tells what is shown.

    Raises
    ------
    InputError
        If the shape is in space.

    Examples
    --------
    >>> explorer = removals()
    >>> explorer.controls["step"].value = 5
    >>> explorer.numbers["shared"], explorer.numbers["before"], explorer.numbers["after"]
    (1, (1, 1), (1, 1))
    """
    shape = datasets.load("gear", n=60) if shape is None else shape
    if shape.dimension != 2:
        raise InputError("removals are shown one at a time for shapes in the plane; use explore.thresholds.")
    if not isinstance(shape, DelaunayShape):
        shape = delaunay_shape(conform(shape, to="delaunay"))
    return Removals(hierarchy(shape))
