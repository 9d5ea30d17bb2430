"""Figures of the paper's section 3: the four methods side by side, and their dependence on the samples."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from .. import datasets, drawing
from ..containment import delaunay_shape
from ..shapes import Shape
from ..skeletons import sk0, sk1, sk2, sk3, voronoi
from .registry import paper_figure


@paper_figure
def figure_3(shape=None, n: int = 96, start: float = 0.7) -> Figure:
    """Figure 3: one shape, its samples, inner triangles, polyball, and the skeletons of the four methods.

    Sections 3.1 to 3.4 of the paper.

    Parameters
    ----------
    shape : Shape, optional
        The shape X, by default the horse.
    n : int
        Number of samples E, uniform by arc length.
    start : float
        Shifts them by this share of a step.

    Returns
    -------
    Figure

    Raises
    ------
    ContourContainmentError
        If the polygon through the samples is not in Del(E), so that panels (c) and (h) have no meaning.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import figures
    >>> plt.close(figures.figure_3(n=200, start=0))
    """
    shape = datasets.load("horse") if shape is None else shape
    polygon = shape.resample(n, start)
    E, inner = polygon.points, delaunay_shape(polygon)
    second = sk2(shape, E)
    fig, axs = drawing.axes(3, 3, height=7.0, letters=True)
    for ax in axs[[0, 1, 4, 5, 6, 7]]:
        drawing.draw_shape(ax, shape)
    drawing.draw_voronoi(axs[1], voronoi(E), linewidth=0.7)
    drawing.draw_delaunay(axs[2], inner, edges=False)
    drawing.draw_shape(axs[2], polygon, fill=False)
    drawing.draw_balls(axs[3], sk1(shape, E).balls(), outlines=True)
    drawing.draw_skeleton(axs[4], sk1(shape, E), kind="sk1")
    drawing.draw_skeleton(axs[5], second, kind="sk2")
    drawing.draw_skeleton(axs[6], sk3(shape, E), kind="sk3")
    drawing.draw_skeleton(axs[7], sk0(inner), kind="sk0")
    drawing.draw_shape(axs[3], shape, fill=False, zorder=2)
    for ax in axs[1:4]:
        drawing.draw_samples(ax, E)
    for ax in axs[:8]:
        drawing.focus(ax, shape, margin=0.05)
    names = ("shape", "samples", "voronoi", "delaunay", "balls", "sk1", "sk2", "sk3", "sk0")
    axs[8].set_title("", loc="left")
    drawing.legend(axs[8], *names, loc="center", ncols=1, labels={"balls": "$Y_w$"})
    return fig


def regular_shape(n: int = 1000) -> Shape:
    """A smooth shape with three rounded arms, for figure 5: a finely sampled polar curve.

    The paper's own "regular" shape is not published.

    Parameters
    ----------
    n : int
        Number of points.

    Returns
    -------
    Shape

    Examples
    --------
    >>> from polyskel_lite import figures
    >>> figures.regular_shape(300).betti()
    (1, 0)
    """
    t = 2 * np.pi * np.arange(n) / n
    r = 1 + 0.30 * np.cos(3 * t) + 0.10 * np.cos(2 * t + 0.7) + 0.05 * np.sin(t)
    return Shape.from_rings([np.stack([r * np.cos(t), r * np.sin(t)], axis=1)])


def samplings_4(shape=None, n: int = 18) -> tuple[Shape, Shape]:
    """The two polygons of figure 4, of one density: the second is half a step along the boundary.

    Parameters
    ----------
    shape : Shape, optional
        By default `regular_shape` with 4000 points.
    n : int
        Number of samples, uniform by arc length.

    Returns
    -------
    pair of Shape

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> [psl.delaunay_shape(polygon).is_gabriel() for polygon in samplings_4()]
    [True, True]
    """
    shape = regular_shape(4000) if shape is None else shape
    return shape.resample(n), shape.resample(n, start=0.5)


@paper_figure
def figure_4(shape=None, n: int = 18) -> Figure:
    """Figure 4: two samplings of the same density, their polyballs and their skeletons.

    Section 3.2 of the paper, "Sampling influence".

    Parameters
    ----------
    shape : Shape, optional
        By default `regular_shape` with 4000 points.
    n : int
        Number of samples, uniform by arc length (see `samplings_4`).

    Returns
    -------
    Figure

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import figures
    >>> plt.close(figures.figure_4())
    """
    shape = regular_shape(4000) if shape is None else shape
    samplings = [polygon.points for polygon in samplings_4(shape, n)]
    skeletons = [sk2(shape, E) for E in samplings]
    fig, axs = drawing.axes(2, 2, height=6.4, letters=True, under=0.05)
    for column, (E, skeleton) in enumerate(zip(samplings, skeletons, strict=True)):
        above, below = axs[column], axs[2 + column]
        drawing.draw_balls(above, skeleton.balls(), outlines=True)
        drawing.draw_shape(above, shape, fill=False)
        drawing.draw_shape(below, shape)
        drawing.draw_skeleton(below, skeletons[1 - column], color="#B0B0B0", linestyle="-", linewidth=4)
        drawing.draw_skeleton(below, skeleton, kind="sk2")
        for ax in (above, below):
            drawing.draw_samples(ax, E, markersize=4)
            drawing.focus(ax, shape, margin=0.04)
    for ax, letter in zip(axs, ("(a)", "", "(b)", ""), strict=True):
        ax.set_title(letter, loc="left", fontsize=drawing.letter_size())
    return fig


@paper_figure
def figure_5(
    shape=None, counts=(10, 50, 100, 200), noise: float = 0.0025, seed: int = 5, reference: int = 2000
) -> Figure:
    """Figure 5: the skeleton from more and more samples, and from noisy ones.

    Section 3.2 of the paper (convergence), and section 4 (noise).

    Parameters
    ----------
    shape : Shape, optional
        By default `regular_shape`.
    counts : sequence of int
        Numbers of samples, uniform by arc length.
    noise : float
        Standard deviation of normal noise on each coordinate of the last panel's samples, as a share of the
        square root of the shape's area; that panel's shape is the polygon through them.
    seed : int
        Of the random numbers.
    reference : int
        Number of samples of the skeleton drawn in grey.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import figures
    >>> plt.close(figures.figure_5(counts=(10, 50), reference=400))
    """
    shape = regular_shape(reference) if shape is None else shape
    exact = sk2(shape, shape.sample(reference))
    rough = shape.sample(counts[-1])
    rough = rough + np.random.default_rng(seed).normal(0, noise * np.sqrt(shape.area()), rough.shape)
    pictures = [(shape, None, "")] + [(shape, shape.sample(n), f"{n} samples") for n in counts]
    pictures.append((Shape.from_rings([rough]), rough, f"noise {noise:.2%}"))
    rows = -(-len(pictures) // 3)
    fig, axs = drawing.axes(3, rows, letters=True, height=2.35 * rows, under=0.05)
    for ax, (X, E, words) in zip(axs, pictures, strict=False):
        drawing.say(ax, words)
        drawing.draw_shape(ax, X)
        drawing.draw_skeleton(ax, exact, color="#B0B0B0", linestyle="-", linewidth=3.5)
        if E is not None:
            drawing.draw_skeleton(ax, sk2(X, E), kind="sk2", linewidth=1.2)
            drawing.draw_samples(ax, E, markersize=5 if len(E) <= 50 else 2.5)
        drawing.focus(ax, shape, margin=0.05)
    for ax in axs[len(pictures) :]:
        ax.set_title("", loc="left")
    return fig
