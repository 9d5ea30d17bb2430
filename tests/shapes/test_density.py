"""Samples as dense as the local width asks for: nothing moves, the balls of the samples are the true ones."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite.shapes.density import MOST

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
    assert MOST < len(needle.densify().points) < 3 * (MOST + 10 * 3)


@pytest.mark.parametrize("spacing", [1e-9, 1e-200, 10**400])
@pytest.mark.parametrize("dimension", [2, 3])
def test_a_spacing_that_would_take_all_memory(spacing, dimension):
    corner = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    shape = plan("L") if dimension == 2 else psl.Shape.from_mesh(np.eye(4, 3, -1), corner)
    with pytest.raises(psl.InputError, match="spacing is"):
        shape.densify(spacing)
