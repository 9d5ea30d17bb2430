"""How firmly a shape has a number of branches: counts over thresholds and shaken copies, and their map."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import drawing


def test_row_zero_is_the_shape_itself():
    shape = psl.datasets.load("fourbranch")
    thresholds = np.pi * np.array([0.5, 1, 2])
    found = psl.branch_counts(shape, thresholds=thresholds, copies=1)
    h = psl.hierarchy(shape, "wireframe")
    assert found.counts[0].tolist() == [h.branches(t).graph["branches"] for t in thresholds]
    assert found.counts[1, -1] == found.counts[0, -1] == 4
    assert found.counts[1, 0] > found.counts[0, 0]  # shaken samples grow bristles


def test_counts_do_not_depend_on_scale_and_repeat():
    shape = psl.datasets.load("leaf", n=300)
    large = psl.Shape(1024 * shape.points, shape.facets)
    first, again, scaled = (psl.branch_counts(s, copies=2) for s in (shape, shape, large))
    assert (first.counts == again.counts).all()
    assert (first.counts == scaled.counts).all()
    assert (psl.branch_counts(shape, copies=2, seed=1).counts != first.counts).any()


def test_a_copy_that_would_cross_itself_is_shaken_less():
    """Two sides a hundredth of an edge apart: a tenth of an edge is too much."""
    shape = psl.Shape.from_rings([[(0, 0), (1, 0), (2, 0), (2, 0.01), (1, 0.01), (0, 0.01)]])
    assert psl.branch_counts(shape, thresholds=[3.0], copies=5).counts.shape == (6, 1)


@pytest.mark.parametrize(
    "wrong", [{"strategy": "surface"}, {"copies": -1}, {"shake": 1.5}, {"shake": np.nan}]
)
def test_wrong_options(wrong):
    with pytest.raises(psl.InputError):
        psl.branch_counts(psl.datasets.load("leaf", n=300), **wrong)


def test_the_map_tells_each_run_once():
    found = psl.BranchCounts(
        np.pi * np.arange(1, 9) / 4, np.array([[9, 4, 4, 4, 4, 4, 4, 4], [9, 9, 9, 9, 4, 4, 4, 4]])
    )
    fig, ax = plt.subplots()
    drawing.draw_branch_counts(ax, found)
    words = [text.get_text() for text in ax.texts]
    assert sorted(words) == ["4", "4", "9", "9"]
    assert [text.get_weight() == "bold" for text in ax.texts] == [word == "4" for word in words]
    assert [label.get_text() for label in ax.get_yticklabels()] == ["as it is", "1"]
    plt.close(fig)


@pytest.mark.parametrize("power", [-1000, -600, 600, 1000])
def test_any_size_has_the_same_counts(power):
    shape = psl.datasets.load("hawaii", n=200)
    scaled = psl.Shape(np.ldexp(shape.points, power), shape.facets)
    first, second = (psl.branch_counts(s, thresholds=[0.3, 1], copies=2) for s in (shape, scaled))
    assert (first.counts == second.counts).all()
    assert (first.counts[1] != first.counts[0]).any()


@pytest.mark.parametrize(
    "wrong",
    [
        {"copies": 2.5},
        {"copies": "3"},
        {"shake": "a"},
        {"seed": -1},
        {"thresholds": []},
        {"thresholds": "abc"},
        {"thresholds": [np.inf]},
        {"thresholds": [[1, 2]]},
        {"strategy": ["branch"]},
    ],
)
def test_what_is_no_option_is_told(wrong):
    with pytest.raises(psl.InputError):
        psl.branch_counts([[(0, 0), (4, 0), (4, 3)]], **wrong)


def test_an_option_that_is_none_is_told():
    with pytest.raises(psl.InputError, match="treshold"):
        psl.skeleton([[(0, 0), (4, 0), (4, 3)]], treshold=3)


def test_one_threshold_and_no_branches_are_drawn():
    fig, ax = plt.subplots()
    drawing.draw_branch_counts(ax, psl.BranchCounts(np.array([2.0]), np.array([[0], [0], [9]])))
    assert sorted(text.get_text() for text in ax.texts) == ["0", "0", "9"]
    drawing.draw_branch_counts(ax, psl.BranchCounts(np.array([3.0, 1, 2]), np.array([[1, 5, 3]])))
    assert [text.get_text() for text in ax.texts[3:]] == ["5", "3", "1"]
    plt.close(fig)
