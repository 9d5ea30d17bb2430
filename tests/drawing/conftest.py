"""Axes to draw on, closed after the test, and two shapes to draw."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import drawing


@pytest.fixture
def ax():
    figure, axes = drawing.axes()
    yield axes
    plt.close(figure)


@pytest.fixture
def ax3():
    figure, axes = drawing.axes_3d()
    yield axes
    plt.close(figure)


@pytest.fixture(scope="module")
def frame():
    """A square with a square hole: its skeletons have one loop."""
    outer, hole = [(0, 0), (6, 0), (6, 6), (0, 6)], [(2, 2), (4, 2), (4, 4), (2, 4)]
    return psl.Shape.from_rings([outer, hole]).resample(48)


@pytest.fixture(scope="module")
def slab():
    """A flat block, full of tetrahedra: its skeleton has polygons."""
    points = np.random.default_rng(0).random((60, 3)) * [4, 3, 1]
    tessellation = psl.delaunay(points)
    return psl.DelaunayShape(tessellation, np.ones(len(tessellation.simplices), dtype=bool))
