"""One picture for whatever there is."""

import matplotlib.pyplot as plt
import pytest

import polyskel_lite as psl
from polyskel_lite import drawing

BAR = psl.skeleton([[(0, 0), (20, 0), (20, 4), (0, 4)]])
SOLID = psl.hierarchy(psl.conform(psl.datasets.load("fourbranch")))
BALLS = psl.Polyball([(0, 0, 0), (1, 0, 0)], [1, 1])
#: What is drawn, and how many patches and collections that makes.
THINGS = {
    "shape": (BAR.given, 1, 0),
    "tessellation": (BAR.given.tessellation, 0, 1),
    "Delaunay shape": (BAR.hierarchy.P, 0, 2),
    "skeleton": (BAR.skeleton, 0, 1),
    "hierarchy": (BAR.hierarchy, 1, 1),
    "bones": (BAR, 1, 1),
    "polyball": (BAR.skeleton.balls(), 2, 0),
    "solid": (SOLID.P.to_shape(), 0, 1),
    "solid hierarchy": (SOLID, 0, None),
    "solid region": (SOLID.P, 0, 2),
    "balls": (BALLS, 0, None),
    "tetrahedra": (psl.delaunay([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]), 0, None),
}


@pytest.mark.parametrize("name", THINGS)
def test_every_kind_of_thing_has_its_drawing(name):
    thing, patches, collections = THINGS[name]
    ax = drawing.plot(thing)
    assert (ax.name == "3d") == (name in ("balls", "tetrahedra") or "solid" in name)
    assert len(ax.patches) == patches
    assert len(ax.collections) == collections if collections is not None else len(ax.collections) > 0
    plt.close(ax.figure)


def test_axes_and_style_are_taken():
    _, ax = drawing.axes()
    assert drawing.plot(BAR.skeleton, ax, linewidth=3) is ax
    assert ax.collections[0].get_linewidth() == 3
    assert drawing.plot(psl.branch_counts(BAR.refined, thresholds=[3, 4], copies=1)).has_data()
    plt.close("all")


def test_what_has_no_drawing_is_told():
    with pytest.raises(psl.InputError, match="list"):
        drawing.plot([1, 2])
