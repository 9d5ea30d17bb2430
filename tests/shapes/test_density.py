"""Samples as dense as the local width asks for: nothing moves, the balls of the samples are the true ones."""

import numpy as np
import pytest
from truth.meshes import extruded

import polyskel_lite as psl
from polyskel_lite.exact import nearest_facets
from polyskel_lite.shapes.density import LIMIT, MOST, local_width

PLANS = {
    "rectangle": [(0, 0), (20, 0), (20, 4), (0, 4)],
    "T": [(0, 0), (100, 0), (100, 10), (60, 10), (60, 60), (40, 60), (40, 10), (0, 10)],
    "L": [(0, 0), (10, 0), (10, 2), (2, 2), (2, 8), (0, 8)],
    "obtuse": [(0, 0), (10, 0), (5, 1)],
    # A spike from the other side comes near a long side, between the places where its width is measured.
    "spike": [(0, 0), (100, 0), (100, 100), (50.2, 100), (50, 0.3), (49.8, 100), (0, 100)],
}


def plan(name):
    return psl.Shape.from_rings([PLANS[name]])


@pytest.mark.parametrize("name", PLANS)
def test_vertices_stay_and_nothing_moves(name):
    shape, dense = plan(name), plan(name).densify()
    assert (dense.points[: len(shape.points)] == shape.points).all()
    assert dense.area() == pytest.approx(shape.area(), rel=1e-12)
    assert psl.hausdorff(shape, dense) < 1e-12 * np.ptp(shape.points)


@pytest.mark.parametrize("name", PLANS)
def test_balls_above_the_floor_are_the_true_ones(name):
    shape = plan(name)
    skeleton = psl.sk0(psl.conform(shape.densify()))
    true = shape.boundary_distance(skeleton.vertices)
    large = true > 1.05 * true.max() / 200
    assert (skeleton.radii[large] / true[large]).max() < 1.02
    coarse = psl.sk0(psl.conform(shape))
    assert (coarse.radii / shape.boundary_distance(coarse.vertices)).max() > 2


def test_a_spacing_is_kept_to():
    dense = plan("L").densify(0.3)
    ends = dense.segments
    assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).max() <= 0.3 * (1 + 1e-12)
    assert dense.betti() == (1, 0)


def test_solids_get_smaller_triangles_of_the_same_surface():
    box = psl.Shape.from_mesh(*cuboid(4, 2, 2))
    dense = box.densify(0.7)
    assert dense.volume() == pytest.approx(16, rel=1e-12)
    assert (dense.points[:8] == box.points).all()
    sides = dense.segments - np.roll(dense.segments, 1, axis=1)
    assert np.linalg.norm(sides, axis=2).max() <= 0.7 * (1 + 1e-12)
    assert len(box.densify().points) > 100


def cuboid(a, b, c):
    V = np.array([(x, y, z) for z in (0, c) for y in (0, b) for x in (0, a)], dtype=float)
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return V, [t for p, q, r, s in quads for t in ((p, q, r), (p, r, s))]


@pytest.mark.parametrize("value", [0, -1, np.nan, np.inf, "1", []])
def test_refusals(value):
    with pytest.raises(psl.InputError, match="positive length"):
        plan("L").densify(value)
    with pytest.raises(psl.InputError, match="positive length"):
        plan("L").densify(floor=value)


def test_needles_end():
    """Where the floor is raised, one more round of halving, which doubles the samples, may be under way."""
    needle = psl.Shape.from_rings([[(0, 0), (1.1, 2e-2), (1.2, 0)]])
    assert MOST[2] / 2 < len(needle.densify().points) < 3 * MOST[2]


@pytest.mark.parametrize(("width", "most"), [(1e-3, LIMIT[2]), (1e-6, 3 * MOST[2]), (1e-12, 3 * MOST[2])])
def test_what_is_far_too_thin_gets_no_more_samples_than_a_corner(width, most):
    bar = psl.Shape.from_rings([[(0, 0), (1, 0), (1, width), (0, width)]])
    assert len(bar.densify().points) < most


def test_a_floor_that_takes_too_many_samples_is_refused_with_one_that_does_not():
    box = psl.Shape.from_mesh(*cuboid(12, 4, 4))
    with pytest.raises(psl.InputError, match=r"floor is 1e-05, which takes more than 30,016 vertices; pass"):
        box.densify(floor=1e-5)
    with pytest.raises(psl.InputError, match=r"below the rounding of the coordinates; pass 1e-11 or more"):
        plan("L").densify(floor=1e-30)
    assert len(plan("L").densify(floor=1e-9).points) < MOST[2]


def test_the_width_of_a_solid_is_that_of_its_largest_balls():
    """On triangles of all sizes, against balls that every facet is asked about."""
    rng = np.random.default_rng(3)
    solid = psl.Shape.from_mesh(*extruded(PLANS["L"], [(0, 1, 2), (0, 2, 3), (0, 3, 5), (3, 4, 5)], 3.0))
    boundary = solid.densify(1.5).segments
    facets = boundary[rng.integers(len(boundary), size=200)]
    places = (rng.dirichlet(np.ones(3), 200)[:, :, None] * facets).sum(axis=1)
    normal = -np.cross(facets[:, 1] - facets[:, 0], facets[:, 2] - facets[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    width = local_width(boundary, places, normal)
    for radius, free in ((width * (1 - 1e-6), True), (width * (1 + 1e-3), False)):
        centers = places + radius[:, None] * normal
        every = [nearest_facets(one[None], centers)[0] for one in boundary]
        assert ((np.min(every, axis=0) >= radius * (1 - 1e-8)) == free).all()


@pytest.mark.parametrize("spacing", [1e-9, 1e-200, 10**400])
@pytest.mark.parametrize("dimension", [2, 3])
def test_a_spacing_that_would_take_all_memory(spacing, dimension):
    corner = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    shape = plan("L") if dimension == 2 else psl.Shape.from_mesh(np.eye(4, 3, -1), corner)
    with pytest.raises(psl.InputError, match="spacing is"):
        shape.densify(spacing)


@pytest.mark.parametrize("exponent", [-1040, -700, -300, 300, 1000])
def test_powers_of_two_change_no_digit(exponent):
    unit = 2.0 ** max(exponent, -1022) * 2.0 ** min(exponent + 1022, 0)
    box = psl.Shape.from_mesh(*cuboid(12, 4, 4))
    for one, several in ((plan("T"), ({}, {"floor": 1.0})), (box, ({"spacing": 3.0}, {"floor": 4.0}))):
        other = psl.Shape(one.points * unit, one.facets)
        for given in several:
            dense = one.densify(**given)
            scaled = other.densify(**{name: value * unit for name, value in given.items()})
            assert (scaled.facets == dense.facets).all()
            # The smallest floats have fewer digits.
            assert np.abs(scaled.points / unit - dense.points).max() <= (1e-9 if exponent < -1000 else 0)


@pytest.mark.parametrize("size", [1e-320, 1e-300, 1e-200, 1e-170, 1e150, 1e200, 1e300])
def test_any_size_goes_the_whole_way(size):
    bones = psl.skeleton([size * np.array(PLANS["rectangle"], dtype=float)])
    (axis,) = bones.branches
    assert bones.quality.ratio < 1.02
    assert axis.smooth_length / size == pytest.approx(16, rel=0.01)
    assert axis.mean_radius / size == pytest.approx(2, rel=0.01)
    assert bones.skeleton.length() / size == pytest.approx(16, rel=0.01)
    points, faces = cuboid(12, 4, 4)
    box = psl.Shape.from_mesh(points * size, faces).densify(2 * size)
    with pytest.warns(psl.CoarseSamplingWarning, match="1.94 times"):
        solid = psl.skeleton(box, strategy="wireframe", densify=False)
    assert solid.skeleton.betti() == (1, 0, 0)
    assert solid.skeleton.radii.max() / size == pytest.approx(2.3, rel=0.2)
