"""The explorer of removals follows the hierarchy, triangle by triangle."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import explore
from polyskel_lite.explore.explorers import removing
from polyskel_lite.simplification import state_at


@pytest.mark.parametrize(("name", "n"), [("gear", 60), ("lake", 80), ("horse", 60)])
def test_removals_follow_the_hierarchy(name, n):
    shape = psl.conform(psl.datasets.load(name, n=n))
    explorer = explore.removals(shape)
    h = explorer.hierarchy
    values = []
    for step in range(len(h.order)):
        explorer.controls["step"].value = step
        numbers = explorer.numbers
        assert numbers["triangle"] == h.simplices[h.order[step]]
        assert numbers["shared"] == 1
        assert numbers["before"] == numbers["after"] == shape.betti()
        assert len(explorer.board.layers["triangles"].polygons) == len(h.level) - step
        values.append(numbers["value"])
    # The threshold at which a triangle goes is the largest criterion met so far.
    assert np.maximum.accumulate(values) == pytest.approx(h.level[h.order], rel=1e-12)
    explorer.controls["step"].value = len(h.order)
    assert "No hat is left" in explorer.board.text
    assert len(explorer.board.layers["marked"].polygons) == 0


def test_only_hats_can_go():
    explorer = explore.removals()
    h, seen = explorer.hierarchy, set()
    for step in (0, 10):
        explorer.controls["step"].value = step
        for row in h.simplices.tolist():
            explorer.controls["triangle"].value = row
            numbers = explorer.numbers
            if "shared" not in numbers:
                assert "not there any more" in explorer.board.text
                continue
            seen.add(numbers["shared"])
            assert (numbers["before"] == numbers["after"]) == (numbers["shared"] == 1)
            assert ("it may go" in explorer.board.text) == (numbers["shared"] == 1)
    assert seen == {1, 2, 3}


def test_removals_want_a_flat_shape_and_a_step_there_is():
    with pytest.raises(psl.InputError, match="in the plane"):
        explore.removals(psl.datasets.load("fourbranch"))
    h = psl.hierarchy(psl.datasets.load("gear", n=60))
    with pytest.raises(psl.InputError, match="step is 99"):
        state_at(h, 99)
    assert removing.try_removal(h, 0, triangle=10**6) is None


def test_waiting_triangles_are_told_with_their_threshold():
    explorer = explore.removals(psl.conform(psl.datasets.load("horse", n=60)))
    texts = []
    for step in range(len(explorer.hierarchy.order)):
        explorer.controls["step"].value = step
        texts.append("it waited for others" in explorer.board.text)
        level = explorer.hierarchy.level[explorer.hierarchy.order[step]]
        assert texts[-1] == (level > explorer.numbers["value"] * (1 + 1e-9))
    assert any(texts)
    assert not all(texts)
