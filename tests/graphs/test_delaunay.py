"""Delaunay tessellations against their definition."""

import copy
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull, QhullError
from truth.points import distinct

import polyskel_lite as psl
from polyskel_lite.exact.predicates import in_ball
from polyskel_lite.graphs.tessellation import circumballs
from polyskel_lite.graphs.triangulation import problem


@pytest.mark.parametrize("n", [2, 3])
@given(data=st.data())
def test_every_open_delaunay_ball_is_empty(n, data):
    """On lattice points, where cocircular and cospherical sets are the rule."""
    points = data.draw(distinct(n, n + 2, 14))
    try:
        hull = ConvexHull(points)
    except QhullError:
        with pytest.raises(psl.TessellationError, match="are in one"):
            psl.delaunay(points)
        return
    t = psl.delaunay(points)
    for simplex in t.simplices:
        cells = np.broadcast_to(points[simplex], (len(points), n + 1, n))
        assert in_ball(cells, points).max() <= 0
    corners = points[t.simplices]
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / (2 if n == 2 else 6)
    assert volume == pytest.approx(hull.volume)


@pytest.mark.parametrize("seed", range(3))
def test_nearly_cospherical_points(seed):
    """Points on a sphere, off it by rounding: Qhull alone does not pass the check."""
    points = np.random.default_rng(seed).normal(size=(150, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    t = psl.delaunay(points)
    assert problem(t.points, t.simplices, t.neighbors) == ""
    assert np.unique(t.simplices).size == 150


@pytest.mark.parametrize("shift", [0, 1e8, 1e15])
def test_far_grid_keeps_every_point(shift):
    grid = np.stack(np.meshgrid(np.arange(5.0), np.arange(5.0)), axis=-1).reshape(-1, 2) + shift
    t = psl.delaunay(grid)
    assert np.unique(t.simplices).size == 25
    assert len(t.simplices) == 32


def test_the_check_finds_what_is_wrong():
    points = np.array([(0, 0), (4, 0), (2, 1), (2, -1), (2, 3)], dtype=float)
    t = psl.delaunay(points)
    assert problem(points, t.simplices, t.neighbors) == ""
    assert "used" in problem(points, t.simplices[:1], np.full((1, 3), -1))
    wrong = np.array([[0, 1, 2], [1, 0, 3], [1, 4, 2], [0, 2, 4]])
    across = np.array([[2, 3, 1], [-1, -1, 0], [3, 0, -1], [2, -1, 0]])
    assert problem(points, wrong, across) == "a sample is inside a Delaunay ball"
    turned = t.simplices[:, [1, 0, 2]]
    assert problem(points, turned, t.neighbors[:, [1, 0, 2]]) == "a simplex is flat"


@pytest.mark.parametrize(
    ("points", "error", "message"),
    [
        ([(0, 0), (1, 1)], psl.TessellationError, "at least 3"),
        ([(0, 0), (1, 1), (2, 2), (3, 3)], psl.TessellationError, "in one line"),
        ([(0, 0, 0), (1, 1, 0), (2, 2, 0), (0, 1, 0), (5, 0, 0)], psl.TessellationError, "in one plane"),
        ([(0, 0), (1, 1), (2, 0), (1, 1)], psl.DuplicatePointError, "points 1 and 3"),
    ],
)
def test_refused_point_sets(points, error, message):
    with pytest.raises(error, match=message):
        psl.delaunay(points)


def test_the_order_does_not_depend_on_qhull():
    points = np.random.default_rng(0).random((40, 2))
    simplices = psl.delaunay(points).simplices.tolist()
    assert simplices == sorted(simplices)
    assert all(simplex[0] == min(simplex) for simplex in simplices)


def test_circumcenters_of_needles():
    """A triangle of height 1e-17 has its centre at 1/(8 x its height); floats alone lose it."""
    height = 2.0**-56
    centers, radii, _ = circumballs(np.array([[(0.0, 0.0), (1.0, 0.0), (0.5, height)]]))
    assert centers[0] == pytest.approx([0.5, height / 2 - 1 / (8 * height)], rel=1e-12)
    assert radii[0] == pytest.approx(1 / (8 * height), rel=1e-12)
    flat, *_ = circumballs(np.array([[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)]]))
    assert not np.isfinite(flat).any()


def test_copies_and_pickles():
    """What a tessellation was read off has loops that cannot be pickled, and serves one tessellation only."""
    square = psl.delaunay([(0, 0), (2, 0), (2, 2), (0, 2)])
    for again in (pickle.loads(pickle.dumps(square)), copy.deepcopy(square), copy.copy(square)):
        assert np.array_equal(again.simplices, square.simplices)
        assert "_growing" not in again.__dict__


def test_arrays_stay_as_they_were_checked():
    """A shape keeps its tessellation: whoever could write into it would change later results."""
    shape = psl.Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]])
    inner = np.ones(2, dtype=bool)
    region = psl.DelaunayShape(shape.tessellation, inner)
    inner[:] = False
    assert region.inner.all()
    for array in (shape.points, shape.tessellation.simplices, shape.tessellation.neighbors, region.inner):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
