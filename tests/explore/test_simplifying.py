"""The explorer of thresholds shows what the hierarchy has."""

from itertools import pairwise

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import explore
from polyskel_lite.simplification import end_vertices, paths_back


@pytest.mark.parametrize("name", psl.datasets.names())
def test_thresholds_show_what_the_hierarchy_has(name):
    explorer = explore.thresholds(psl.datasets.load(name))
    for criterion in ("corrected", "transcript"):
        explorer.controls["criterion"].value = criterion
        h = psl.hierarchy(explorer.P, criterion=criterion)
        for value in (0, 0.5, 1, 2.5, 6):
            explorer.controls["threshold"].value = value
            skeleton = h.skeleton(value * np.pi)
            drawn = explorer.board.layers["skeleton"].lines
            assert np.array_equal(drawn, skeleton.segments())
            assert explorer.numbers["Betti_numbers"] == skeleton.betti()
            assert explorer.numbers["ends"] == h.branches(value * np.pi).graph["branches"]
            assert explorer.numbers["simplices"] == len(skeleton.vertices)
            assert len(explorer.board.layers["ends"].points) == explorer.numbers["ends"]


def test_ends_come_back_along_the_whole_skeleton():
    h = psl.hierarchy(psl.datasets.load("leaf"))
    whole = psl.sk0(h.P)
    edges = {frozenset(map(tuple, segment)) for segment in whole.segments().tolist()}
    first = set(map(tuple, whole.vertices[end_vertices(h, 0)].tolist()))
    for threshold in (0, np.pi, 2 * np.pi):
        paths = paths_back(h, threshold)
        for path in paths:
            steps = pairwise(map(tuple, path.tolist()))
            assert all(frozenset(step) in edges or step[0] == step[1] for step in steps)
            assert tuple(path[-1].tolist()) in first  # where a branch of the whole skeleton ends
    explorer = explore.thresholds(h.P)
    for choice, seen in (("nothing", None), ("their balls", "balls"), ("the way they have come", "ways")):
        explorer.controls["ends"].value = choice
        assert [layer for layer in ("balls", "ways") if explorer.board.visible(layer)] == [seen] * bool(seen)


def test_thresholds_of_solids_are_those_of_the_viewer():
    explorer = explore.thresholds(psl.datasets.load("fourbranch"))
    assert len(explorer.hierarchies) == 4
    seen = set()
    for h in explorer.hierarchies:
        explorer.picture.strategy = f"{h.strategy}, {h.criterion}"
        explorer.picture.threshold = 1.0
        assert explorer.hierarchy is h
        assert explorer.numbers["simplices"] == explorer.picture.counts()["vertices"]
        assert explorer.numbers["ends"] == explorer.picture.counts()["branches"]
        assert explorer.numbers["Betti_numbers"] == (1, 0, 0)
        seen.add(explorer.numbers["simplices"])
    assert len(seen) == 4
    assert "psl-viewer" in explorer._repr_mimebundle_()["text/html"]
