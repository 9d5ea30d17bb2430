"""Graphs of samples that are dragged are those of the public functions."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import explore


def test_graphs_of_the_handles():
    explorer = explore.graphs()
    points = np.random.default_rng(3).uniform((1, 1), (8, 4), (len(explorer.board.handles), 2))
    explorer.board.handles = points
    explorer.controls["gabriel"].value = True
    graph, layers = psl.delaunay(points), explorer.board.layers
    assert np.array_equal(layers["delaunay"].lines, points[graph.facets()])
    assert np.array_equal(layers["gabriel"].lines, points[psl.gabriel(graph)])
    dual = psl.voronoi(graph)
    assert np.array_equal(layers["voronoi"].lines[: len(dual.edges)], dual.segments())
    assert len(layers["voronoi"].lines) == len(dual.edges) + len(dual.rays)
    number = explorer.controls["triangle"].value
    assert layers["ball"].circles[1] == [graph.circumradii[number]]
    assert explorer.numbers["triangles"] == len(graph.simplices)
    assert explorer.numbers["Gabriel_segments"] == len(psl.gabriel(graph))


@pytest.mark.parametrize("name", ["delaunay", "voronoi", "gabriel"])
def test_graphs_can_be_switched_off(name):
    explorer = explore.graphs()
    explorer.controls[name].value = True
    assert explorer.board.picture(name)
    explorer.controls[name].value = False
    assert explorer.board.picture(name) == ""
    assert name.title() not in explorer.board.alt
    explorer.controls["triangle"].value = -1
    assert "radius_of_the_ball" not in explorer.numbers
    assert explorer.board.picture("ball") == ""


def test_ball_stays_with_its_triangle_until_a_sample_comes_in():
    explorer = explore.graphs([(0, 0), (4, 0), (2, 3), (2, -5)])
    graph = psl.delaunay(explorer.board.handles)
    upper = next(k for k, corners in enumerate(graph.simplices.tolist()) if 2 in corners)
    explorer.controls["triangle"].value = upper
    for y in (-4, -3, -2):
        explorer.board.handles = [(0, 0), (4, 0), (2, 3), (2, y)]
        assert explorer.numbers["radius_of_the_ball"] == pytest.approx(13 / 6)
        assert "no triangle" not in explorer.board.text
    explorer.board.handles = [(0, 0), (4, 0), (2, 3), (2, -1)]
    assert "Samples 0, 1 and 2 are no triangle any more" in explorer.board.text


def test_handle_on_handle_is_explained_and_undone():
    explorer = explore.graphs([(0, 0), (4, 0), (2, 3), (2, -5)])
    before = explorer.board.picture("delaunay")
    explorer.board.handles = [(0, 0), (4, 0), (0, 0), (2, -5)]
    assert isinstance(explorer.error, psl.DuplicatePointError)
    assert explorer.board.text == str(explorer.error)
    assert explorer.board.picture("delaunay") == before
    explorer.board.handles = [(0, 0), (4, 0), (2, 3), (2, -5)]
    assert explorer.error is None
    assert explorer.board.text.startswith("samples 4")


@pytest.mark.parametrize(
    "points", [[(0, 0), (1, 1)], [(0, 0), (0, 0), (1, 1)], np.zeros((41, 2)), [(0, np.nan)]]
)
def test_graphs_refuses_bad_points(points):
    with pytest.raises(psl.PolyskelError):
        explore.graphs(points)
