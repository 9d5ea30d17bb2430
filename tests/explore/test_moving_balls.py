"""Balls that are dragged: their union and its skeleton are those of the library."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import explore
from polyskel_lite.explore.explorers import moving_balls


def moved(explorer, index, place):
    handles = [list(handle) for handle in explorer.board.handles]
    handles[index] = list(place)
    explorer.board.handles = handles


def test_moving_a_centre_takes_the_rim_along():
    explorer = explore.balls(psl.Polyball([(0, 0), (1, 0), (3, 0)], [1, 0.8, 0.5]))
    before = np.array(explorer.board.handles)
    assert explorer.numbers["Betti_numbers"] == (2, 0)
    moved(explorer, 4, (2.0, 0.2))
    after = np.array(explorer.board.handles)
    assert explorer.polyball.centers[2].tolist() == [2.0, 0.2]
    assert explorer.polyball.radii.tolist() == [1, 0.8, 0.5]
    assert after[5] - after[4] == pytest.approx(before[5] - before[4])
    assert (after[:4] == before[:4]).all()
    assert explorer.numbers["Betti_numbers"] == (1, 0)
    assert explorer.controls["ball"].value == 2


def test_dragging_a_rim_and_the_slider_make_a_ball_grow():
    explorer = explore.balls(psl.Polyball([(0, 0), (3, 0)], [1, 1]))
    assert explorer.numbers["singular_points"] == 0
    moved(explorer, 1, (0.0, 2.3))
    assert explorer.polyball.radii == pytest.approx([2.3, 1])
    assert explorer.board.handles[1] == pytest.approx((0.0, 2.3))
    assert explorer.numbers["singular_points"] == 2
    explorer.controls["ball"].value = 1
    assert explorer.controls["radius"].value == pytest.approx(1)
    explorer.controls["radius"].value = 1.5
    assert explorer.polyball.radii == pytest.approx([2.3, 1.5])
    explorer.controls["ball"].value = 0
    assert explorer.controls["radius"].value == pytest.approx(2.3)
    assert explorer.polyball.radii == pytest.approx([2.3, 1.5])


def test_a_slider_that_snaps_to_its_steps_is_not_a_hand():
    explorer = explore.balls(psl.Polyball([(0, 0), (3, 0)], [1, 1]))
    radius = explorer.controls["radius"]
    radius.value = 1 + 0.4 * radius.step  # what a browser does by itself when it shows the slider
    assert explorer.polyball.radii.tolist() == [1, 1]
    radius.value = 1 + 1.4 * radius.step  # one step further, by hand
    assert explorer.polyball.radii.tolist() == [1 + 1.4 * radius.step, 1]


def test_a_rim_dragged_into_the_centre_leaves_a_small_ball():
    explorer = explore.balls(psl.Polyball([(0, 0), (3, 0)], [1, 1]))
    moved(explorer, 1, (0.0, 0.0))
    assert 0 < explorer.polyball.radii[0] < 0.2
    assert explorer.error is None


def test_rims_beyond_the_board_do_not_change_their_balls():
    explorer = explore.balls(psl.Polyball([(0, 0), (1.2, 0)], [1, 1]))
    xmin, _, _, ymax = explorer.board.box
    moved(explorer, 0, (xmin, ymax))
    moved(explorer, 0, (0.1, 0.0))
    assert explorer.polyball.radii.tolist() == [1, 1]


def test_tangent_balls_get_a_sentence_and_moving_on_works():
    explorer = explore.balls(psl.Polyball([(0, 0), (2, 0)], [1, 1]))
    assert isinstance(explorer.error, psl.TangentBallsError)
    assert explorer.board.text == str(explorer.error)
    assert "touch" in explorer.board.text
    assert len(explorer.board.layers["boundary"].arcs[0]) > 0  # the balls themselves are drawn
    assert len(explorer.board.layers["skeleton"].lines) == 0
    assert explorer.numbers == {}
    moved(explorer, 2, (1.7, 0.0))
    assert explorer.error is None
    assert len(explorer.board.layers["skeleton"].lines) == 1


def test_balls_are_added_and_removed():
    explorer = explore.balls()
    count, area = len(explorer.polyball), explorer.numbers["area"]
    explorer.controls["add"].click()
    assert len(explorer.polyball) == count + 1 == explorer.numbers["balls"]
    assert len(explorer.board.handles) == len(explorer.board.handle_labels) == 2 * (count + 1)
    assert explorer.controls["ball"].value == count
    explorer.controls["remove"].click()
    assert explorer.numbers["area"] == pytest.approx(area)
    for _ in range(count + 2):
        explorer.controls["remove"].click()
    assert len(explorer.polyball) == 1
    assert explorer.board.text == "One ball has to stay."
    for _ in range(20):
        explorer.add()
    assert len(explorer.polyball) == moving_balls.MOST
    assert "remove one first" in explorer.board.text


def test_the_skeleton_drawn_is_that_of_the_library():
    explorer = explore.balls()
    rng = np.random.default_rng(3)
    for _ in range(10):
        moved(explorer, 2 * rng.integers(7), rng.uniform(-1, 4, 2))
        Y = explorer.polyball
        if explorer.error:
            continue
        drawn = explorer.board.layers["skeleton"].lines
        assert np.array_equal(drawn, Y.skeleton().segments())
        # In the plane nothing is to be corrected, so there is no switch between the two statements.
        assert np.array_equal(drawn, Y.skeleton(statement="transcript").segments())
        assert explorer.numbers["area"] == Y.area()
        assert len(explorer.board.layers["singular"].points) == len(Y.singular_points())
    explorer.controls["voronoi"].value = False
    assert not explorer.board.visible("voronoi")


def test_balls_in_space_or_too_many_are_refused():
    with pytest.raises(psl.InputError, match="3 coordinates"):
        explore.balls(psl.Polyball([(0, 0, 0)], [1]))
    with pytest.raises(psl.InputError, match="too many"):
        explore.balls(psl.Polyball([(k, 0) for k in range(40)], [0.6] * 40))
