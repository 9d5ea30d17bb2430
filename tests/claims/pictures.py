"""Figures looked at by the checks: against the stored pictures, and for what their panels must show."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.testing.compare import compare_images
from mpl_toolkits.mplot3d.art3d import Line3D, Line3DCollection, Poly3DCollection

from polyskel_lite.figures import FIGURES

BASELINE = Path(__file__).resolve().parents[1] / "figures" / "baseline"


def figure_is(name: str, panels: int, shows: Callable[[Figure, list[Axes]], bool]) -> bool:
    """Whether a figure has its panels, caption and alternative text, shows what it must, and is as stored.

    ``shows`` gets the figure and its panels that have something on them.
    """
    matplotlib.use("Agg")  # not at import: the claims page shows pictures of its own
    draw = FIGURES[name]
    with plt.style.context("default"):
        figure = draw()
        try:
            full = [ax for ax in figure.axes if ax.has_data()]
            complete = len(full) >= panels and bool(draw.caption and draw.alt)
            return complete and _as_stored(name, figure) and bool(shows(figure, full))
        finally:
            plt.close(figure)


def _as_stored(name: str, figure: Figure) -> bool:
    """Whether the picture is the one in tests/figures/baseline; another matplotlib draws it otherwise.

    The browser site has no stored pictures: there only what the panels hold is looked at.
    """
    if not BASELINE.exists():
        return True
    from figures.test_pictures import BASELINE_VERSION, SAVED, TOLERANCE

    if not matplotlib.__version__.startswith(BASELINE_VERSION + "."):
        return True
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.png"
        figure.savefig(path, **SAVED)
        return compare_images(BASELINE / path.name, path, TOLERANCE) is None


def lines(ax: Axes) -> set[frozenset]:
    """All straight pieces of the line collections on a panel, by their rounded ends."""
    found = set()
    for artist in ax.collections:
        if isinstance(artist, Line3DCollection):
            chains = artist._segments3d
        elif isinstance(artist, LineCollection):
            chains = artist.get_segments()
        else:
            continue
        for chain in chains:
            found |= pieces(pairwise(chain))
    return found


def pieces(segments) -> set[frozenset]:
    """Segments by their rounded ends; those without a length are left out."""
    named = (frozenset(tuple(p) for p in np.round(np.asarray(s) + 0.0, 9).tolist()) for s in segments)
    return {s for s in named if len(s) == 2}


def dots(ax: Axes, marker: str | None = None) -> np.ndarray:
    """Points drawn with markers, all or those with one marker."""
    chosen = [a for a in ax.lines if a.get_marker() not in ("None", None, "")]
    chosen = [a for a in chosen if marker is None or a.get_marker() == marker]
    data = [np.stack(a.get_data_3d() if isinstance(a, Line3D) else a.get_data(), axis=1) for a in chosen]
    return np.concatenate(data) if data else np.zeros((0, 2))


def faces(ax: Axes) -> list[int]:
    """How many polygons each collection in space has."""
    return [len(a._faces) for a in ax.collections if isinstance(a, Poly3DCollection)]


def default(name: str, parameter: str):
    """The default of a parameter of a figure function."""
    return inspect.signature(FIGURES[name]).parameters[parameter].default


def eight_dots(name: str) -> Callable[[], Figure]:
    """A figure function that draws nothing but dots, under the caption of another one."""

    @functools.wraps(FIGURES[name])
    def draw() -> Figure:
        figure, axs = plt.subplots(3, 5)
        for ax in axs.ravel():
            ax.plot([0, 1], [0, 1], ".")
        return figure

    return draw
