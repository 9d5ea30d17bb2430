"""Refinement and Delaunay shapes."""

from itertools import pairwise

import numpy as np
import pytest
from truth.rational import grid_region, rational, strictly_gabriel

import polyskel_lite as psl
from polyskel_lite.containment.conforming import conform_stages


def star(rng, n, spike):
    """A star-shaped polygon with angles as sharp as they come."""
    angle = np.sort(rng.choice(np.arange(360), size=n, replace=False)) * np.pi / 180
    radius = np.where(rng.random(n) < 0.5, 10.0, 10.0 * spike)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


@pytest.mark.parametrize("to", ["delaunay", "gabriel"])
@pytest.mark.parametrize("seed", range(20))
def test_refinement_ends_and_keeps_the_vertices(seed, to):
    rng = np.random.default_rng(seed)
    try:
        shape = psl.Shape.from_rings([star(rng, 14, 0.1)])
    except psl.ShapeError:
        return  # the center is outside the ring: not a star, and perhaps not simple
    fine = psl.conform(shape, to=to)
    assert (fine.points[: len(shape.points)] == shape.points).all()
    assert not len(psl.missing_facets(fine, of=to))
    assert fine.betti() == shape.betti()
    # Inserted points are rounded: on their sides up to the last bits of coordinates of size ten.
    assert shape.boundary_distance(fine.points).max() < 1e-14
    assert fine.length() == pytest.approx(shape.length(), rel=1e-12)


def test_strict_gabriel_by_definition_after_refinement():
    for seed in range(10):
        shape = psl.conform(psl.Shape.from_rings(grid_region(np.random.default_rng(seed), size=4)))
        samples = rational(shape.points)
        assert all(strictly_gabriel(samples[a], samples[b], samples) for a, b in shape.facets.tolist())


def test_the_30_degree_corner_on_which_halving_loops():
    shape = psl.Shape.from_rings([[(0, 0), (13, 0), (10 * np.cos(np.pi / 6), 5)]])
    assert len(psl.conform(shape).points) < 20


@pytest.mark.parametrize("to", ["delaunay", "gabriel"])
@pytest.mark.parametrize("seed", range(8))
def test_stages_lead_from_the_shape_to_the_refined_one(seed, to):
    rng = np.random.default_rng(seed)
    shape = psl.Shape.from_rings(grid_region(rng, size=4))
    stages = list(conform_stages(shape, to))
    assert (stages[0].points == shape.points).all()
    assert (stages[0].facets == shape.facets).all()
    assert stages[0].missing.tolist() == psl.missing_facets(shape, of=to).tolist()
    final = psl.conform(shape, to=to)
    assert (stages[-1].points == final.points).all()
    assert (stages[-1].facets == final.facets).all()
    for before, after in pairwise(stages):
        # Every state is a closed boundary of its own, and the numbers told are those of `missing_facets`.
        state = psl.Shape(after.points, after.facets)
        assert after.missing.tolist() == psl.missing_facets(state, of=to).tolist()
        assert (after.points[: len(before.points)] == before.points).all()
        assert len(after.points) > len(before.points)
    assert [len(stage.missing) == 0 for stage in stages] == [False] * (len(stages) - 1) + [True]


def test_stages_are_for_the_plane_and_for_known_graphs():
    tip = psl.Shape(
        [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 6)], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    )
    with pytest.raises(psl.InputError, match="in the plane"):
        conform_stages(tip)
    with pytest.raises(psl.InputError, match="unknown graph 'voronoi'"):
        conform_stages(psl.datasets.load("gear"), to="voronoi")


def halving_alone(shape, rounds):
    """Midpoint splitting without the cut at acute corners; the number of missing facets after each round."""
    counts = []
    for _ in range(rounds):
        missing = psl.missing_facets(shape, of="gabriel")
        counts.append(len(missing))
        points, facets = shape.points.tolist(), []
        for k, (a, b) in enumerate(shape.facets.tolist()):
            if k in missing:
                points.append(((shape.points[a] + shape.points[b]) / 2).tolist())
                facets += [(a, len(points) - 1), (len(points) - 1, b)]
            else:
                facets.append((a, b))
        shape = psl.Shape(points, facets)
    return counts


def test_halving_alone_does_not_end_there():
    shape = psl.Shape.from_rings([[(0, 0), (13, 0), (10 * np.cos(np.pi / 6), 5)]])
    assert min(halving_alone(shape, 25)) > 0


def test_a_shape_that_conforms_is_returned_as_it_is():
    shape = psl.datasets.load("horse")
    assert psl.conform(shape) is shape


def test_needles_are_given_up_with_a_sentence():
    needle = psl.Shape.from_rings([[(0, 0), (1, 0), (1, 1e-3)]])
    with pytest.raises(psl.TessellationError, match="very thin there"):
        psl.conform(needle, limit=100)
    assert len(psl.conform(needle).points) < 600


def test_missing_facets_are_named():
    pair = psl.Shape.from_rings([[(0, 0), (10, 0), (5, 1)], [(5, -1), (4, -3), (6, -3)]])
    with pytest.raises(psl.ContourContainmentError, match="vertices 0-1") as caught:
        psl.delaunay_shape(pair)
    assert caught.value.missing.tolist() == [0]
    assert psl.delaunay_shape(psl.conform(pair, to="delaunay")).betti() == (2, 0)


@pytest.mark.parametrize(
    "call", [psl.conform, psl.delaunay_shape, psl.missing_facets, psl.sk0, psl.sk1, psl.sk2, psl.sk3]
)
def test_arrays_are_no_shapes(call):
    with pytest.raises(psl.InputError, match="pass a Shape"):
        call(np.zeros((4, 2)))


def test_unknown_names():
    shape = psl.datasets.load("gear")
    with pytest.raises(psl.InputError, match="choose 'delaunay' or 'gabriel'"):
        psl.conform(shape, to="voronoi")
    with pytest.raises(psl.InputError, match="'inner' or 'outer'"):
        psl.sk0(shape, side="left")


def test_a_needle_is_called_one():
    """Nothing has to be merged there, and no other origin would help."""
    with pytest.raises(
        psl.TessellationError, match=r"sides at vertex 0 enclose 1e-12 radians.* Cut the tip off"
    ):
        psl.conform(psl.Shape.from_rings([[(0, 0), (1, 0), (1, 1e-12)]]).densify())
