"""Elementary removals one at a time: which triangle may go, and what the skeleton loses (section 4.2)."""

from __future__ import annotations

from typing import ClassVar

import ipywidgets
import numpy as np

from ... import datasets
from ...containment import DelaunayShape
from ...errors import InputError
from ...shapes import Shape
from ...simplification import Hierarchy, Removal, hierarchy, state_at, try_removal
from ...skeletons import sk0
from ..drawing_board import Board, box_around
from .explorer import Explorer, refined

LOOK_FOR = (
    "Move the slider: the orange triangle goes next, and with it its vertex and its edge of the skeleton. "
    "Look at the Betti numbers: they never change. Then choose a triangle that shares two or three sides, "
    "and see what its removal would do."
)
ALT = (
    "Left, a shape cut into triangles, one of them marked with its ball. Right, the skeleton of the "
    "triangles left, with the vertex and the edges that go with the marked triangle in blue."
)

#: What is said of a removal; a page without a kernel says the same. Kinds by the number of shared sides.
WORDS = {
    "gone": "{step} of {all} triangles are gone.",
    "no_hat": "No hat is left: what remains cannot go without a change of topology.",
    "not_there": "Triangle {triangle} is not there any more; choose another one.",
    "kind_0": "the last triangle of a part",
    "kind_1": "a hat triangle",
    "kind_2": "a triangle in a strip",
    "kind_3": "a triangle at a junction",
    "may": "Triangle {triangle} is {kind}: it shares 1 side with the others, so it may go.",
    "must": "Triangle {triangle} is {kind}: it shares {shared} sides with the others, so it must stay.",
    "value": "p/r = {length} / {radius} = {value} π",
    "goes": "{value}: it goes at a threshold above that.",
    "waited": "{value}; it waited for others, and goes at a threshold above {level} π.",
    "betti": "Betti numbers {before} with it, {after} without it: the topology {verdict}.",
    "stays": "stays",
    "changes": "changes",
}


def removal_text(h: Hierarchy, step: int, triangle: int | None, removal: Removal | None) -> str:
    """A removal in numbers and words, for the triangle asked for (None: the next one).

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> h = psl.hierarchy(psl.datasets.load("gear", n=40))
    >>> print(removal_text(h, 0, None, try_removal(h, 0)))  # doctest: +ELLIPSIS
    0 of 18 triangles are gone. Triangle ... is a hat triangle: it shares 1 side with the others, so it may
    go. p/r = ... = 0.79 π: it goes at a threshold above that. Betti numbers (1, 1) with it, (1, 1) without
    it: the topology stays.
    """
    said = [WORDS["gone"].format(step=step, all=len(h.order))]
    if removal is None:
        why = WORDS["no_hat" if triangle is None else "not_there"]
        return " ".join([*said, why.format(triangle=triangle)])
    facts = removal._asdict() | {"kind": WORDS[f"kind_{removal.shared}"]}
    hat = removal.shared == 1
    said.append(WORDS["may" if hat else "must"].format(**facts))
    if hat:
        length, radius = f"{removal.length:.3g}", f"{removal.radius:.3g}"
        value = WORDS["value"].format(length=length, radius=radius, value=f"{removal.value / np.pi:.2f}")
        level = float(h.level[np.searchsorted(h.simplices, removal.triangle)])
        # Where the hats before it had larger values it waits for them, and goes with the largest.
        way = "waited" if level > removal.value * (1 + 1e-9) else "goes"
        said.append(WORDS[way].format(value=value, level=f"{level / np.pi:.2f}"))
    verdict = WORDS["stays" if removal.before == removal.after else "changes"]
    return " ".join([*said, WORDS["betti"].format(**facts, verdict=verdict)])


class Removals(Explorer):
    """The explorer that `removals` returns.

    Attributes
    ----------
    hierarchy : Hierarchy
    """

    words: ClassVar[dict[str, str]] = WORDS
    live: ClassVar[dict[str, str]] = {
        **{"triangles": "polygons", "marked": "polygons", "ball": "circles"},
        **{"skeleton": "lines", "goes": "lines"},
    }

    def __init__(self, h: Hierarchy):
        self.hierarchy = h
        points = h.P.tessellation.points
        self._aside = np.array([1.15 * np.ptp(points[:, 0]), 0.0])  # from the triangles to the skeleton
        step = ipywidgets.IntSlider(0, min=0, max=len(h.order), description="triangles gone")
        other = ipywidgets.Dropdown(
            options=[("the next one", -1), *((f"triangle {row}", row) for row in h.simplices.tolist())],
            description="triangle in question",
        )
        board = Board(box_around(np.concatenate([points, points + self._aside]), 0.02), alt=ALT, width=800)
        super().__init__(board, {"step": step, "triangle": other}, LOOK_FOR)

    def draw(self) -> None:
        """Draw the state after the chosen number of removals."""
        h, step, chosen = self.hierarchy, self.controls["step"].value, self.controls["triangle"].value
        triangle = None if chosen < 0 else chosen
        removal = try_removal(h, step, triangle)
        self._draw_state(state_at(h, step)[0], removal)
        numbers = {"gone": step, "left": len(h.level) - step}
        if removal:
            numbers |= removal._asdict() | {"value": removal.value}
        self.say(removal_text(h, step, triangle, removal), numbers)

    def given(self) -> dict[str, object]:
        """The triangles of the shape, numbered as in ``hierarchy.level``, and the order in which they go."""
        h, t, rows = self.hierarchy, self.hierarchy.P.tessellation, self.hierarchy.simplices
        number = np.full(len(t.simplices) + 1, -1)
        number[rows] = np.arange(len(rows))
        about = {
            "points": t.points,
            "corners": t.simplices[rows],
            "near": number[t.neighbors[rows]],
            "centers": t.circumcenters[rows],
            "radii": t.circumradii[rows],
            "lengths": state_at(h, 0)[1],
            "order": h.order,
            "level": np.where(np.isfinite(h.level), h.level, -1.0),  # of those that never go, which no hat is
            "simplices": rows,
            "aside": self._aside,
        }
        return {name: value.tolist() for name, value in about.items()}

    def _draw_state(self, P: DelaunayShape, removal: Removal | None) -> None:
        """The triangles that are left with one marked, and to the right of them the skeleton."""
        draw, aside, t, whole = self.board.draw, self._aside, P.tessellation, self.hierarchy.P
        corners, outline, skeleton = t.points[t.simplices], t.points[whole.boundary()], sk0(P)
        lines, row = skeleton.segments() + aside, [] if removal is None else [removal.triangle]
        going = np.isin(skeleton.simplices[skeleton.edges], row).any(axis=1)
        center, ball = t.circumcenters[row], (t.circumcenters[row], t.circumradii[row])
        draw("outline", "shape", lines=np.concatenate([outline, outline + aside]))
        draw("triangles", "delaunay", polygons=list(corners[P.inner]), label="triangles left")
        draw("marked", "voronoi", polygons=list(corners[row]), label="triangle in question", order=2.6)
        draw("ball", "balls", circles=ball, fill=False, label="its ball", order=2.7)
        draw("gone", "complement", lines=sk0(whole).segments() + aside, label="skeleton at the start")
        draw("skeleton", "sk0", lines=lines, points=skeleton.vertices + aside, label="Sk_0 of what is left")
        goes = {"lines": lines[going], "points": center + aside, "label": "what goes with the triangle"}
        draw("goes", "sk2", **goes, width=1.5, order=5.0)


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
    return Removals(hierarchy(refined(shape, to="delaunay")))
