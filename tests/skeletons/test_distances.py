"""Hausdorff distances."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.distance import directed_hausdorff

import polyskel_lite as psl

cloud = st.lists(st.tuples(st.integers(-9, 9), st.integers(-9, 9)), min_size=1, max_size=12)


@given(cloud, cloud)
def test_point_sets_against_scipy(a, b):
    a, b = np.array(a, dtype=float), np.array(b, dtype=float)
    assert psl.directed_hausdorff(a, b) == pytest.approx(directed_hausdorff(a, b)[0])
    assert psl.hausdorff(a, b) == psl.hausdorff(b, a) >= psl.directed_hausdorff(a, b)


def test_edges_count_between_their_ends():
    outline = psl.Shape.from_rings([[(0, 0), (10, 0), (10, 2), (0, 2)]])
    assert psl.directed_hausdorff([(5, 0)], outline, step=0.01) == pytest.approx(0, abs=0.01)
    assert psl.hausdorff([(5, 1)], outline, step=0.01) == pytest.approx(np.hypot(5, 1), abs=0.01)


@pytest.mark.parametrize("step", [0.1, 0.03, 0.01])
def test_the_error_is_at_most_a_step(step):
    a = psl.Shape.from_rings([[(0, 0), (10, 0), (5, 8)]])
    b = psl.Shape.from_rings([[(0, 0), (10, 0), (5, 9)]])
    # The farthest point is the tip (5, 9), nearest to the tip (5, 8) or to a side of a.
    true = a.boundary_distance([(5, 9)])[0]
    assert psl.hausdorff(a, b, step=step) == pytest.approx(true, abs=step)


def test_a_skeleton_is_at_no_distance_from_itself():
    skeleton = psl.sk2(psl.datasets.load("horse"))
    assert psl.hausdorff(skeleton, skeleton) == 0


@pytest.mark.parametrize(
    ("a", "b", "message"),
    [
        ([(0, 0)], [(0, 0, 0)], "A is in 2D and B in 3D"),
        (np.zeros((0, 2)), [(0, 0)], "A is empty"),
        ([(0, 0)], psl.voronoi([(0, 0), (1, 0), (0, 1)]), "B has rays"),
    ],
)
def test_refusals(a, b, message):
    with pytest.raises(psl.InputError, match=message):
        psl.hausdorff(a, b)


def test_bad_step():
    with pytest.raises(psl.InputError, match="positive length"):
        psl.hausdorff([(0, 0)], [(1, 1)], step=0)
