"""Figures 3 to 5 show what their captions say."""

from __future__ import annotations

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import figures


def test_figure_3_shows_where_the_methods_differ():
    """So few samples that inner triangles have outer centres, outer ones inner, and Sk2 falls apart."""
    horse = psl.datasets.load("horse")
    polygon = horse.resample(96, 0.7)
    P = psl.delaunay_shape(polygon)
    assert (~horse.contains(psl.sk0(P).vertices)).sum() == 3
    assert (~P.inner[psl.sk1(horse, polygon.points).simplices]).sum() == 9
    assert psl.sk2(horse, polygon.points).betti() == (3, 0)
    assert psl.sk0(P).betti() == (1, 0)


def gaps(figure, panel: int) -> list:
    """Line patterns in a panel; None is a solid line."""
    styles = [c.get_linestyles() for c in figure.axes[panel].collections if hasattr(c, "get_segments")]
    return [dash for style in styles for _, dash in style]


def test_figure_3_draws_pieces_without_gaps_of_their_own():
    """Sk2 is in three pieces, which one can count only where no dash is taken for a gap."""
    figure = figures.figure_3()
    assert {dash for panel in (5, 6) for dash in gaps(figure, panel)} == {None}


def test_figure_4_compares_gabriel_samplings_of_one_density():
    """The polygons are strictly Gabriel, as the paper says, and no sample is shared."""
    first, second = figures.samplings_4()
    shape = figures.regular_shape(4000)
    for polygon in (first, second):
        assert psl.delaunay_shape(polygon).is_gabriel()
    one, two = (shape.covering_radius(polygon.points) for polygon in (first, second))
    assert two == pytest.approx(one, rel=0.05)
    assert np.linalg.norm(first.points[:, None] - second.points[None], axis=2).min() > 0


def test_figure_5_tells_samples_and_noise():
    figure = figures.figure_5(counts=(10, 50), noise=0.01, reference=400)
    words = [text.get_text() for ax in figure.axes for text in ax.texts if text.get_text()]
    assert words == ["10 samples", "50 samples", "noise 1.00%"]


def test_figure_5_has_the_noise_that_it_tells():
    shape = figures.regular_shape(2000)
    figure = figures.figure_5()
    clean, rough = (figure.axes[k].lines[-1].get_xydata() for k in (4, 5))
    moved = (rough - clean) / np.sqrt(shape.area())
    assert moved.std() == pytest.approx(0.0025, rel=0.1)


def test_figure_5_comes_closer_with_more_samples():
    shape = figures.regular_shape()
    exact = psl.sk2(shape)
    distances = [psl.hausdorff(psl.sk2(shape, shape.sample(n)), exact) for n in (10, 50, 200)]
    assert distances == sorted(distances, reverse=True)
    assert distances[-1] < 0.1 * distances[0]
