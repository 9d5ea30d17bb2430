"""Explorer of sections 2.1 and 3.2: how density, place and noise of the samples change the skeleton."""

from __future__ import annotations

from typing import ClassVar

import ipywidgets
import numpy as np

from ...errors import InputError
from ...graphs import delaunay
from ...shapes import Shape
from ...skeletons import sk2
from ..drawing_board import Board, box_around
from .explorer import Explorer, flat_shape, rings_of, sample_sliders


class Sampling(Explorer):
    """See `sampling`."""

    words: ClassVar[dict[str, str]] = {
        "alt": "A shape, {n} samples, skeleton Sk2 of {pieces} pieces and {loops} loops.",
        "alt_with_balls": "A shape, {n} samples, skeleton Sk2 of {pieces} pieces and {loops} loops, over the "
        "union of the Delaunay balls with centres in the shape.",
    }
    live: ClassVar[dict[str, str]] = {"samples": "points", "skeleton": "lines", "polyball": "circles"}

    def __init__(self, shape: Shape | None = None, n: int = 100, seed: int = 0):
        self.shape = flat_shape(shape, "samples")
        controls = sample_sliders(self.shape, n)
        low, high = controls["n"].min, controls["n"].max
        if not low <= n <= high:
            raise InputError(f"n is {n}; choose from {low} to {high}, the ends of the slider.")
        self._size = float(np.hypot(*np.ptp(self.shape.points, axis=0)))
        # As many as there can be samples: the noise of the first hundred does not depend on the others.
        # Rounded, so that a page without a kernel has the very same in few characters.
        self._shifts = np.random.default_rng(seed).normal(size=(high, 2)).round(4)
        board = Board(box_around(self.shape.points, 0.08))
        rings = [self.shape.points[ring] for ring in self.shape.rings()]
        board.draw("shape", "shape", polygons=rings, label="shape X")
        board.draw("outline", "shape", polygons=rings, fill=False, order=3)  # over the balls
        controls |= {
            "noise": ipywidgets.FloatSlider(0.0, min=0, max=2, step=0.05, description="noise, % of the size"),
            "polyball": ipywidgets.Checkbox(False, description="polyball of Sk2", indent=False),
        }
        super().__init__(
            board,
            controls,
            "Raise n: the skeleton settles down once the samples are dense. Then shift them, and add a "
            "little noise: which branches jump, and which stay?",
        )

    def samples(self) -> np.ndarray:
        """The samples E for the present sliders, (n, 2)."""
        n, start, noise = (self.controls[name].value for name in ("n", "start", "noise"))
        E = self.shape.sample(n, start)
        return E + 0.01 * noise * self._size * self._shifts[: len(E)] if noise else E

    def draw(self) -> None:
        board, polyball = self.board, self.controls["polyball"].value
        graph = delaunay(self.samples())
        skeleton = sk2(self.shape, graph)
        radius = self.shape.covering_radius(graph.points)
        board.draw("samples", "samples", points=graph.points, label="samples E")
        board.draw("skeleton", "sk2", lines=skeleton.segments(), label="Sk_2")
        Y = skeleton.balls() if polyball and len(skeleton.vertices) else None
        board.draw("polyball", "balls", circles=(Y.centers, Y.radii) if Y else ([], []), label="Y_w")
        betti = skeleton.betti()
        alt = self.words["alt_with_balls" if polyball else "alt"]
        board.alt = alt.format(n=len(graph.points), pieces=betti[0], loops=betti[1])
        self.tell(
            n=len(graph.points),
            covering_radius=radius,
            density_w=1 / radius,
            vertices=len(skeleton.vertices),
            edges=len(skeleton.edges),
            ends=len(skeleton.ends()),
            Betti_numbers_of_Sk2=betti,
            those_of_the_shape=self.shape.betti(),
        )

    def given(self) -> dict[str, object]:
        shape, shifts = self.shape, self._shifts
        return rings_of(shape) | {"betti": shape.betti(), "size": self._size, "shifts": shifts.tolist()}


def sampling(shape: Shape | None = None, n: int = 100, seed: int = 0) -> Sampling:
    """Explore what density, place and noise of the samples do to the skeleton Sk2 (sections 2.1, 3.2).

    Parameters
    ----------
    shape : Shape, optional
        Of the plane, by default the horse.
    n : int
        Number of samples at first.
    seed : int
        Of the noise: the same seed moves the same sample the same way.

    Returns
    -------
    Sampling
        An `Explorer`. Controls: ``n``; ``start``, the shift along the boundary as a share of a step;
        ``noise``, the standard deviation in each direction, in percent of the diagonal of the shape's box;
        ``polyball``, the union of the balls of Sk2 (on or off).

    Raises
    ------
    InputError
        If `shape` is not a shape of the plane, or `n` is not on the slider.

    Examples
    --------
    >>> explorer = sampling()
    >>> coarse = explorer.numbers["covering_radius"]
    >>> explorer.controls["n"].value = 200
    >>> round(coarse / explorer.numbers["covering_radius"], 1)
    2.0
    """
    return Sampling(shape, n, seed)
