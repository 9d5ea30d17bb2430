"""The ball of chapter 1 that grows to a maximal one, driven from Python."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import explore

HORSE = psl.datasets.load("horse")
FRAME = psl.Shape.from_rings([[(0, 0), (6, 0), (6, 6), (0, 6)], [(2, 2), (4, 2), (4, 4), (2, 4)]])


@pytest.mark.parametrize("name", psl.datasets.names())
def test_ball_grows_to_a_maximal_one(name):
    shape = psl.datasets.load(name)
    explorer, rng = explore.maximal_ball(shape), np.random.default_rng(1)
    low, high = shape.points.min(axis=0), shape.points.max(axis=0)
    places = rng.uniform(low, high, (400, 2))
    for place in places[shape.contains(places)][:15]:
        explorer.board.handles = [place]
        center, radius = (value[0] for value in explorer.board.layers["ball"].circles)
        contacts = explorer.board.layers["contacts"].points
        assert shape.boundary_distance([center])[0] == pytest.approx(radius, rel=1e-9)
        assert np.hypot(*(center - contacts).T) == pytest.approx(radius, rel=1e-5)
        assert explorer.numbers["contacts"] == len(contacts) >= 2
        assert explorer.numbers["radius_at_the_dot"] == pytest.approx(shape.boundary_distance([place])[0])
        # The ball around the handle is in the maximal one.
        apart = np.hypot(*(np.array(explorer.board.handles[0]) - center))
        assert apart + explorer.numbers["radius_at_the_dot"] <= radius * (1 + 1e-9)


def test_growth_slider_stops_on_the_way():
    explorer = explore.maximal_ball(FRAME, center=(3, 0.5))
    assert explorer.numbers["radius"] == pytest.approx(1)
    explorer.controls["growth"].value = 0.5
    assert explorer.numbers["radius"] == pytest.approx(0.75)
    assert explorer.numbers["contacts"] == 1
    assert "Not maximal" in explorer.board.text


def test_centre_on_the_skeleton_is_told():
    explorer = explore.maximal_ball(FRAME, center=(3, 1.001))
    explorer.controls["growth"].value = 0
    assert explorer.numbers["contacts"] == 2
    assert "on the skeleton" in explorer.board.text


@pytest.mark.parametrize("place", [(3, 3), (6.2, 3), (0, 0), (3, 0)])
def test_no_ball_outside(place):
    explorer = explore.maximal_ball(FRAME, center=place)
    assert "not inside" in explorer.board.text
    assert explorer.board.picture("ball") == ""
    explorer.board.handles = [(1, 3)]
    assert explorer.numbers["contacts"] >= 2


def test_trace_keeps_the_centres():
    explorer = explore.maximal_ball(FRAME, center=(3, 0.5))
    explorer.controls["trace"].value = True
    for x in (2.5, 3.0, 3.5):
        explorer.board.handles = [(x, 0.5)]
    trace = explorer.board.layers["trace"].points
    assert np.unique(trace.round(9), axis=0).tolist() == [[2.5, 1], [3, 1], [3.5, 1]]
    explorer.controls["trace"].value = False
    assert len(explorer.board.layers["trace"].points) == 0


def test_skeleton_of_the_shape_on_demand():
    explorer = explore.maximal_ball(HORSE)
    assert not explorer.board.visible("skeleton")
    explorer.controls["skeleton"].value = True
    assert np.array_equal(explorer.board.layers["skeleton"].lines, psl.sk2(HORSE).segments())
    explorer.controls["skeleton"].value = False
    assert explorer.board.picture("skeleton") == ""
