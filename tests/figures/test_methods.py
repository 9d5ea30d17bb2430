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


def test_figure_4_compares_samplings_of_one_density():
    kangaroo = psl.datasets.load("kangaroo")
    first, second = kangaroo.sample(90), kangaroo.sample(90, start=0.5)
    assert kangaroo.covering_radius(second) == pytest.approx(kangaroo.covering_radius(first), rel=0.05)
    assert np.linalg.norm(first[:, None] - second[None], axis=2).min() > 0


def test_figure_5_comes_closer_with_more_samples():
    shape = figures.regular_shape()
    exact = psl.sk2(shape)
    distances = [psl.hausdorff(psl.sk2(shape, shape.sample(n)), exact) for n in (10, 50, 200)]
    assert distances == sorted(distances, reverse=True)
    assert distances[-1] < 0.1 * distances[0]
