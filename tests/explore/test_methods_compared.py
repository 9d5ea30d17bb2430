"""The four methods side by side are those of the public functions."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import explore

HORSE = psl.datasets.load("horse")


@pytest.mark.parametrize(("name", "n", "start"), [("horse", 96, 0.7), ("lake", 400, 0.0), ("gear", 150, 0.5)])
def test_four_methods_show_what_the_functions_return(name, n, start):
    shape = psl.datasets.load(name)
    explorer = explore.four_methods(shape, n=n, start=start)
    E = shape.sample(n, start)
    expected = {
        "sk0": psl.sk0(shape.resample(n, start)),
        "sk1": psl.sk1(shape, E),
        "sk2": psl.sk2(shape, E),
        "sk3": psl.sk3(shape, E),
    }
    for key, skeleton in expected.items():
        layer = explorer.board.layers[key]
        assert np.allclose(layer.lines, skeleton.segments() + explorer.offsets[key], rtol=0, atol=1e-15)
        numbers = explorer.numbers[f"Sk{key[2]}"]
        assert numbers == {
            "vertices": len(skeleton.vertices),
            "edges": len(skeleton.edges),
            "betti": skeleton.betti(),
        }
        assert f"Betti {skeleton.betti()}" in explorer.board.layers[f"heading_{key}"].text[0][2]
    assert explorer.numbers["shape"] == shape.betti()
    assert len(explorer.board.layers["sk1"].points) == len(expected["sk1"].vertices)


def test_four_methods_without_sk0():
    explorer = explore.four_methods(HORSE, n=60)
    polygon = HORSE.resample(60, 0.7)
    missing = psl.missing_facets(polygon, of="delaunay")
    assert explorer.numbers["Sk0"] is None
    assert f"none, {len(missing)} sides are not Delaunay" in explorer.board.text
    sides = explorer.board.layers["missing"].lines - explorer.offsets["sk0"]
    assert np.allclose(sides, polygon.segments[missing])
    explorer.controls["n"].value = 96
    assert explorer.numbers["Sk0"]["betti"] == (1, 0)
    assert explorer.board.picture("missing") == ""


def test_four_methods_on_a_polygon_that_crosses_itself():
    with pytest.raises(psl.ShapeError):
        HORSE.resample(9)
    explorer = explore.four_methods(HORSE, n=9, start=0)
    assert explorer.numbers["Sk0"] is None
    assert "crosses itself" in explorer.board.text


@pytest.mark.parametrize("wrong", [{"n": 2}, {"n": 1000}, {"start": 1.0}])
def test_four_methods_refuse_what_is_not_on_a_slider(wrong):
    with pytest.raises(psl.InputError, match="choose n from 3 to 400"):
        explore.four_methods(HORSE, **wrong)
