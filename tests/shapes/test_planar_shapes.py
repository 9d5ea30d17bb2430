"""Shapes: validation, location, sampling."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import polyskel_lite as psl

SQUARE = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=float)


@pytest.mark.parametrize(
    ("rings", "error", "message"),
    [
        (
            [[(0, 0), (1, 1), (1, 0), (0, 1)]],
            psl.ShapeError,
            "segment 0-1 of ring 0 meets segment 2-3 of ring 0",
        ),
        ([[(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)]], psl.ShapeError, "segment 0-1 of ring 0 meets"),
        (
            [[(0, 0), (6, 0), (4, 0), (0, 4)]],
            psl.ShapeError,
            "segment 0-1 of ring 0 meets segment 1-2 of ring 0",
        ),
        ([[(0, 0), (1, 0), (2, 0)]], psl.ShapeError, "touch itself"),
        (
            [[(0, 0), (1, 0), (1, 0), (0, 1)]],
            psl.DuplicatePointError,
            "vertex 1 of ring 0 and vertex 2 of ring 0 are both at",
        ),
        ([SQUARE, SQUARE + 0.5], psl.ShapeError, "meets"),
        (
            [SQUARE, SQUARE + np.array([1, 0])],
            psl.DuplicatePointError,
            "vertex 1 of ring 0 and vertex 0 of ring 1",
        ),
        ([[(0, 0), (1, 0)]], psl.InputError, "ring 0 has 2 different vertices"),
        ([], psl.InputError, "rings is empty"),
        (None, psl.InputError, "rings is None"),
        (iter([SQUARE]), psl.InputError, "rings is a list_iterator; pass a list of rings"),
        (
            [SQUARE, [(9, 9), (9, 8), (8, 9), (8, 8)]],
            psl.ShapeError,
            "segment 1-2 of ring 1 meets segment 0-3 of ring 1",
        ),
        ([[(0, 0), (1, np.nan), (1, 1)]], psl.InputError, r"ring 0\[1, 1\] is nan"),
        ([np.zeros((4, 3))], psl.InputError, "N = 2"),
    ],
)
def test_bad_rings(rings, error, message):
    with pytest.raises(error, match=message):
        psl.Shape.from_rings(rings)


@pytest.mark.parametrize(
    ("facets", "message"),
    [
        ([(0, 1), (1, 2), (2, 3)], "vertex 0 begins 1 segments and ends 0"),
        ([(0, 1), (1, 2), (2, 3), (3, 9)], r"facets\[3, 1\] is 9"),
        ([(1, 0), (2, 1), (3, 2), (0, 3)], "outer ring runs clockwise"),
        ([(0.0, 1.0)], "array of int"),
        ([(0, 0), (1, 2), (2, 3), (3, 1)], "joins vertex 0 to itself"),
    ],
)
def test_bad_facets(facets, message):
    with pytest.raises(psl.PolyskelError, match=message):
        psl.Shape(SQUARE, facets)


def test_hole_that_runs_the_wrong_way():
    points = np.concatenate([SQUARE * 4, SQUARE + 1])
    with pytest.raises(psl.ShapeError, match="a hole runs counter-clockwise: the ring through vertex 4"):
        psl.Shape(points, [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)])


def test_rings_are_turned_and_nested():
    rings = [SQUARE * 10, (SQUARE * 8 + 1)[::-1], SQUARE * 6 + 2, SQUARE + 20]
    shape = psl.Shape.from_rings(rings[::-1])
    assert shape.betti() == (3, 1)
    assert shape.area() == pytest.approx(100 - 64 + 36 + 1, abs=1e-9)


def test_arrays_are_frozen_and_copied():
    ring = SQUARE.copy()
    shape = psl.Shape.from_rings([ring])
    ring[0] = 9
    assert shape.points[0].tolist() == [0, 0]
    with pytest.raises(ValueError, match="read-only"):
        shape.points[0] = 1


def test_contains_is_exact_on_the_last_bit():
    shape = psl.Shape.from_rings([[(0, 0), (3, 1), (0, 2)]])
    on = np.array([(0.75, 0.25), (0.75, np.nextafter(0.25, 0)), (0.75, np.nextafter(0.25, 1))])
    assert shape.locate(on).tolist() == [0, -1, 1]


@given(st.lists(st.tuples(st.integers(-4, 4), st.integers(-4, 4)), min_size=1, max_size=20))
def test_location_agrees_with_crossing_numbers(queries):
    """Against the definition: a point is inside if a ray that meets no vertex crosses oddly often."""
    shape = psl.Shape.from_rings([[(-4, -4), (4, -4), (4, 4), (0, 0), (-4, 4)], [(-2, -3), (2, -3), (0, -1)]])
    direction = np.array([1.0, 1 / np.pi])
    for q, where in zip(queries, shape.locate(queries).tolist(), strict=True):
        if shape.boundary_distance([q])[0] == 0:
            assert where == 0
            continue
        crossings = 0
        for a, b in shape.segments:
            t, s = np.linalg.solve(np.stack([direction, a - b], axis=1), a - q)
            crossings += t > 0 and 0 < s < 1
        assert where == (1 if crossings % 2 else -1)


@pytest.mark.parametrize("name", ["horse", "lake", "hawaii"])
@pytest.mark.parametrize("n", [100, 333])
def test_samples_are_on_the_boundary_and_evenly_spaced(name, n):
    shape = psl.datasets.load(name)
    E = shape.sample(n, start=0.3)
    assert E.shape == (n, 2)
    # Interpolation along a segment rounds at the scale of the coordinates, which is one.
    assert shape.boundary_distance(E).max() < 1e-14


@pytest.mark.parametrize("n", [2, "a", 4.5, None])
def test_bad_sample_counts(n):
    with pytest.raises(psl.InputError):
        psl.datasets.load("gear").sample(n)


def test_too_few_samples_for_a_polygon():
    with pytest.raises(psl.ShapeError, match="too few for this shape"):
        psl.datasets.load("horse").resample(12)


@given(st.integers(3, 40), st.floats(0, 0.99))
def test_covering_radius_against_a_fine_sampling(n, start):
    shape = psl.Shape.from_rings([[(0, 0), (4, 0), (4, 1), (1, 1), (1, 3), (0, 3)]])
    E = shape.sample(n, start)
    fine = shape.sample(4000)
    brute = np.sqrt(((fine[:, None] - E) ** 2).sum(axis=2)).min(axis=1).max()
    radius = shape.covering_radius(E)
    # A sample of the boundary can miss the maximum by half its own spacing, and never exceeds it.
    assert brute <= radius * (1 + 1e-9) <= brute + shape.length() / 8000 + 1e-9
    assert shape.sampling_density(E) == pytest.approx(1 / radius)


def test_density_of_nothing():
    with pytest.raises(psl.InputError, match="E is empty"):
        psl.datasets.load("horse").sampling_density(np.zeros((0, 2)))


@pytest.mark.parametrize("scale", [1e-300, 1e-12, 1.0, 1e12, 1e200])
@pytest.mark.parametrize("shift", [0.0, 1e6])
def test_tiny_huge_and_far_shapes(scale, shift):
    shape = psl.Shape.from_rings([(SQUARE + shift) * scale])
    assert shape.betti() == (1, 0)
    assert psl.sk0(psl.conform(shape)).betti() == (1, 0)
