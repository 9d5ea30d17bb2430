"""Edge flips bring any triangulation of a convex region back to Delaunay, exactly."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite.errors import TessellationError
from polyskel_lite.exact.predicates import orientation
from polyskel_lite.graphs import triangulation
from polyskel_lite.graphs.incremental import incremental_delaunay
from polyskel_lite.graphs.mending import _flip, flip_to_delaunay, mended


def spoiled(t: psl.Tessellation, tries: int, seed: int):
    """The tessellation after random flips of convex quadrilaterals."""
    triangles, neighbors = t.simplices.copy(), t.neighbors.copy()
    rng = np.random.default_rng(seed)
    done = 0
    for _ in range(tries):
        s, i = int(rng.integers(len(triangles))), int(rng.integers(3))
        r = int(neighbors[s, i])
        if r < 0:
            continue
        a, b, c = np.roll(triangles[s], -i)
        d = triangles[r, neighbors[r].tolist().index(s)]
        if (orientation(t.points[[[a, b, d], [a, d, c]]]) > 0).all():
            assert _flip(triangles, neighbors, s, r)
            done += 1
    assert done > tries / 10
    return triangles, neighbors


@pytest.mark.parametrize("seed", range(6))
def test_random_flips_are_undone(seed):
    rng = np.random.default_rng(seed)
    points = rng.random((120, 2)) if seed % 2 else rng.integers(0, 12, (90, 2)).astype(float)
    t = psl.delaunay(np.unique(points, axis=0))
    triangles, neighbors = spoiled(t, 400, seed)
    assert "inside" in triangulation.problem(t.points, triangles, neighbors)
    repaired = flip_to_delaunay(t.points, triangles, neighbors)
    assert triangulation.problem(t.points, *repaired) == ""
    if seed % 2:  # no four samples on a circle: only one tessellation
        assert np.array_equal(triangulation._canonical(*repaired)[0], t.simplices)


def test_a_wrong_tessellation_of_qhull_is_repaired_without_starting_again(monkeypatch):
    points = np.random.default_rng(3).random((200, 2))
    right = psl.delaunay(points)
    monkeypatch.setattr(triangulation, "_qhull", lambda _: spoiled(right, 300, 1))
    monkeypatch.setattr(triangulation, "incremental_delaunay", pytest.fail)
    assert np.array_equal(psl.delaunay(points).simplices, right.simplices)


def test_what_is_no_triangulation_is_left_to_the_check(monkeypatch):
    points = np.array([(0.0, 0.0), (1.0, -1.0), (2.0, 0.0), (1.0, 3.0)])
    twice = np.array([[0, 1, 2], [0, 2, 3], [0, 1, 3]]), np.array([[-1, 1, -1], [-1, 2, 0], [-1, 1, -1]])
    assert triangulation.problem(points, *twice)
    assert flip_to_delaunay(points, *twice)[0].shape == (3, 3)
    monkeypatch.setattr(triangulation, "_candidates", lambda _: [lambda: twice])
    with pytest.raises(TessellationError, match="passed the exact check"):
        psl.delaunay(points)


@pytest.mark.parametrize("name", ["horse", "gear", "lake", "kangaroo"])
def test_samples_on_straight_sides_are_mended(name, monkeypatch):
    """Qhull turns needles along the hull inside out there; the slow exact method is not needed."""
    points = psl.datasets.load(name).resample(3000).points
    right = incremental_delaunay(points)
    monkeypatch.setattr(triangulation, "incremental_delaunay", pytest.fail)
    assert triangulation.problem(points, *right) == ""
    assert np.array_equal(psl.delaunay(points).simplices, triangulation._canonical(*right)[0])


@pytest.mark.parametrize("seed", range(4))
def test_nearly_collinear_samples(seed, monkeypatch):
    rng = np.random.default_rng(seed)
    along = np.sort(rng.random(300))
    sides = [np.stack([along, np.full(300, float(k))], axis=1) for k in range(2)]
    turn = np.linalg.qr(rng.normal(size=(2, 2)))[0]
    points = np.unique(np.concatenate(sides) @ turn, axis=0)
    t = psl.delaunay(points)
    assert triangulation.problem(points, t.simplices, t.neighbors) == ""
    triangles, _ = mended(points, *triangulation._qhull(points))
    assert len(triangles) in (0, len(t.simplices))
