"""The explorer of refinement: what is missing, what is in the way, step by step."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import explore
from polyskel_lite.containment import conform_stages, diametral_balls


@pytest.mark.parametrize("to", ["gabriel", "delaunay"])
@pytest.mark.parametrize("name", psl.datasets.names())
def test_refinement_counts_what_is_missing(name, to):
    explorer = explore.refinement(psl.datasets.load(name, n=60))
    explorer.controls["graph"].value = to
    stages = list(conform_stages(psl.datasets.load(name, n=60), to))
    assert explorer.controls["step"].max == max(len(stages) - 1, 0)
    for step, stage in enumerate(stages):
        explorer.controls["step"].value = step
        layers = explorer.board.layers
        assert explorer.numbers["missing"] == len(stage.missing) == len(layers["missing"].lines)
        assert len(layers["balls"].circles[1]) == len(stage.missing)
        assert len(layers["missing"].lines) + len(layers["there"].lines) == len(stage.facets)
        assert len(layers["samples"].points) + len(layers["added"].points) == len(stage.points)
    assert explorer.numbers["missing"] == 0
    assert "all" in explorer.board.text


def test_intruders_are_what_keeps_a_side_out_of_the_gabriel_graph():
    for stage in conform_stages(psl.datasets.load("lake", n=60)):
        centers, radii, intruders = diametral_balls(stage)
        ends = stage.points[stage.facets]
        middle, reach = ends.mean(axis=1), np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) / 2
        found = set()
        for k, (a, b) in enumerate(stage.facets.tolist()):
            near = np.flatnonzero(np.linalg.norm(stage.points - middle[k], axis=1) <= reach[k] * (1 + 1e-12))
            inside = set(near.tolist()) - {a, b}
            assert bool(inside) == (k in stage.missing)
            found |= inside
        assert found == set(intruders.tolist())
        assert len(centers) == len(radii) == len(stage.missing)


def test_refinement_hides_its_balls_and_refuses_solids():
    explorer = explore.refinement()
    explorer.controls["balls"].value = False
    assert not explorer.board.visible("balls")
    with pytest.raises(psl.InputError, match="in the plane"):
        explore.refinement(psl.datasets.load("fourbranch"))
