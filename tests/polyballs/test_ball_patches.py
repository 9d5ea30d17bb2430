"""Polyballs in space measured and triangulated: closed forms, sampling, fine meshes, brute force.

Bounds: an exact quantity against a closed form is held to 1e-12, a change of 1e-9 in the input may change it
by a few times 1e-9, and an estimate from samples may be five of its own standard deviations away.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation
from truth.cases import Balls, family_member, of_all_families
from truth.medial import Union

import polyskel_lite as psl
from polyskel_lite.errors import InputError
from polyskel_lite.polyballs.sphere_patches import _fan, _icosphere
from polyskel_lite.polyballs.volumes import patch_areas

PI = np.pi


def hollow_cage(count=60, radius=0.35) -> Balls:
    """Balls on a sphere that they close, with a cavity inside."""
    z = 1 - (2 * np.arange(count) + 1) / count
    turn = np.arange(count) * PI * (3 - np.sqrt(5))
    ring = np.sqrt(1 - z * z)
    return Balls(np.column_stack([ring * np.cos(turn), ring * np.sin(turn), z]), np.full(count, radius))


def far_apart(count):
    """`count` separate pairs of balls and their common measure."""
    x = 10.0 * np.arange(count)
    centers = np.concatenate([np.column_stack([x + s, 0 * x, 0 * x]) for s in (0, 1)])
    return Balls(centers, np.ones(2 * count))


def lens(r, s, d):
    """Volume of the intersection of two balls (Weisstein, MathWorld, Sphere-Sphere Intersection)."""
    return PI * (r + s - d) ** 2 * (d * d + 2 * d * (r + s) - 3 * (r - s) ** 2) / (12 * d)


def cap_area(r, s, d):
    """Area of the sphere of radius r in a ball of radius s whose centre is d away."""
    return 2 * PI * r * (r - (d * d + r * r - s * s) / (2 * d))


def measure(vertices, triangles):
    """Enclosed volume and area of a mesh."""
    a, b, c = (vertices - vertices.mean(axis=0))[triangles].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    return (a * normals).sum() / 6, np.sqrt((normals**2).sum(axis=1)).sum() / 2


def directed_edges(triangles, count):
    a, b = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).T
    return np.sort(a * count + b), np.sort(b * count + a)


# --- closed forms


def test_one_ball():
    Y = Balls([(1, 2, 3)], [2])
    assert Y.volume() == pytest.approx(32 * PI / 3, rel=1e-15)
    assert Y.area() == pytest.approx(16 * PI, rel=1e-15)
    assert Y.distance([(1, 2, 3), (1, 2, 4.5), (1, 7, 3)]).tolist() == [2, 0.5, 3]


@pytest.mark.parametrize(
    ("r", "s", "d"),
    [(1, 1, 1), (1, 1, 1e-3), (1, 1, 1.999999), (2, 1, 1.5), (3, 0.2, 2.95), (1, 1e-3, 1), (5, 4, 1.01)],
)
@pytest.mark.parametrize("far", [0, 1e5])
def test_two_balls(r, s, d, far):
    axis = np.array([0.48, 0.6, 0.64])
    Y = Balls([far * axis, (far + d) * axis], [r, s])
    # Far away d is what rounding has left of it.
    d = np.linalg.norm(Y.centers[1] - Y.centers[0])
    bound = {"rel": 1e-12 if not far else 1e-9}
    assert Y.volume() == pytest.approx(4 * PI / 3 * (r**3 + s**3) - lens(r, s, d), **bound)
    areas, normals = patch_areas(Y.union)
    left = [4 * PI * r * r - cap_area(r, s, d), 4 * PI * s * s - cap_area(s, r, d)]
    assert areas == pytest.approx(left, rel=bound["rel"], abs=1e-14 * r * r)
    disc = PI * Y.union.boundary.circles.radii[0] ** 2
    across = (Y.centers[1] - Y.centers[0]) / d
    assert normals == pytest.approx(disc * np.array([-across, across]), abs=bound["rel"])


def test_balls_that_only_touch_or_hide():
    outside = Balls([(0, 0, 0), (3, 0, 0)], [1, 2])
    assert outside.volume() == pytest.approx(12 * PI, rel=1e-14)
    assert outside.area() == pytest.approx(20 * PI, rel=1e-14)
    inside = Balls([(0, 0, 0), (1, 0, 0), (0, 0.5, 0)], [2, 1, 1])
    assert inside.volume() == pytest.approx(32 * PI / 3, rel=1e-14)
    assert inside.area() == pytest.approx(16 * PI, rel=1e-14)
    assert inside.distance([(1, 0, 0), (2, 0, 0)]) == pytest.approx([1, 0], abs=1e-15)


def test_three_balls_by_symmetry():
    """Unit balls at unit distances: each keeps 4π less two caps, whose common part counts once."""
    centers = np.array([(0, 0, 0), (1, 0, 0), (0.5, np.sqrt(0.75), 0)])
    Y = Balls(centers, np.ones(3))
    areas, _ = patch_areas(Y.union)
    assert areas == pytest.approx(areas[[0, 0, 0]], rel=1e-13)
    # The common part of two caps of 60°, 60° apart, is two equal segments; one is a sector of its cap less
    # a triangle of the axis and both ends, which has the angle `apex` at the axis and `base` at the ends.
    half = np.arccos(np.tan(PI / 6) / np.tan(PI / 3))
    end = np.arcsin(np.sin(half) * np.sin(PI / 3))  # half the distance of the two ends
    apex = 2 * np.arcsin(np.sin(end) / np.sin(PI / 3))
    base = np.arctan2(1 / np.tan(apex / 2), np.cos(PI / 3))
    segment = apex * (1 - np.cos(PI / 3)) - (apex + 2 * base - PI)
    overlap = 2 * segment
    assert areas[0] == pytest.approx(4 * PI - 2 * PI + overlap, rel=1e-13)


def test_volume_is_the_integral_of_the_area_over_the_radii():
    """When all radii grow at the same rate, so does the volume, at the rate of the area (five point rule)."""
    Y, h = family_member(1), 1e-3
    v = [Balls(Y.centers, Y.radii + t * h).volume() for t in (-2, -1, 1, 2)]
    assert (v[0] - 8 * v[1] + 8 * v[2] - v[3]) / (12 * h) == pytest.approx(Y.area(), rel=1e-8)


def test_whole_spheres_and_almost_nothing_are_told_apart():
    """A large ball from which hairs stick out, and one of which a corner of almost no area is left."""
    rng = np.random.default_rng(5)
    hairs = rng.standard_normal((40, 3))
    hairs /= np.linalg.norm(hairs, axis=1)[:, None]
    Y = Balls(np.concatenate([np.zeros((1, 3)), hairs]), np.append(1, np.full(40, 1e-5)))
    areas, _ = patch_areas(Y.union)
    assert areas[0] == pytest.approx(4 * PI - 40 * cap_area(1, 1e-5, 1), rel=1e-14)
    assert areas[1:] == pytest.approx(np.full(40, 4 * PI * 1e-10 - cap_area(1e-5, 1, 1)), rel=1e-9)
    # Three balls around the pole of the first one leave a triangle of it with a height of about 1e-4.
    turn = np.arange(3) * 2 * PI / 3
    sides = np.column_stack([np.cos(turn), np.sin(turn), 0 * turn])
    reach = np.sqrt(1 + 0.25) - 1e-4
    below = np.array([(0, 0, -0.1)])
    Y = Balls(
        np.concatenate([np.zeros((1, 3)), below, sides * 0.5 + (0, 0, 0)]), np.append([1, 1.0], [reach] * 3)
    )
    areas, _ = patch_areas(Y.union)
    assert 0 < areas[0] < 1e-6


def test_hollow_cage():
    """The wall of the cavity counts, its inside does not; the mesh around it faces inward."""
    Y = hollow_cage()
    vertices, triangles, _ = Y.mesh(0.01)
    inner = np.linalg.norm(vertices[triangles].mean(axis=1), axis=1) < 1
    cavity, _ = measure(vertices, triangles[inner])
    total, surface = measure(vertices, triangles)
    assert cavity < -0.5
    assert total == pytest.approx(Y.volume(), rel=2e-3)
    assert surface == pytest.approx(Y.area(), rel=2e-3)
    whole = 4 / 3 * PI * 1.35**3
    assert Y.volume() < whole + cavity
    rng = np.random.default_rng(0)
    points = rng.uniform(-1.35, 1.35, (100_000, 3))
    share = Y.inside(points).mean()
    assert abs(Y.volume() - 2.7**3 * share) < 5 * 2.7**3 * np.sqrt(share * (1 - share) / len(points))
    assert Y.distance([(0, 0, 0)])[0] == pytest.approx((np.linalg.norm(Y.centers, axis=1) - Y.radii).min())


# --- any polyball


@pytest.mark.parametrize("number", of_all_families(3))
def test_volume_and_area_against_samples(number):
    Y = family_member(number)
    rng = np.random.default_rng(number)
    low, high = Y.box()
    points = rng.uniform(low, high, (20_000, 3))
    share = Y.inside(points).mean()
    sigma = np.prod(high - low) * np.sqrt(share * (1 - share) / len(points))
    assert abs(Y.volume() - np.prod(high - low) * share) < 5 * sigma
    u = rng.standard_normal((2_000, 3))
    u /= np.linalg.norm(u, axis=1)[:, None]
    areas, _ = patch_areas(Y.union)
    for ball, (c, r) in enumerate(zip(Y.centers, Y.radii, strict=True)):
        free = ~Y.inside(c + r * u, 1e-12)
        # At least one sample's worth, where all or none of them are free.
        sigma = np.sqrt(max(free.mean() * (1 - free.mean()), 1 / len(u)) / len(u))
        assert abs(areas[ball] / (4 * PI * r * r) - free.mean()) < 5 * sigma


@pytest.mark.parametrize("number", of_all_families(3))
def test_mesh_converges_to_the_exact_measures(number):
    """Half the edges, a quarter of the error, or nearly so where patches are narrower than an edge."""
    Y = family_member(number)
    errors = []
    for fineness in (0.03, 0.015):
        vertices, triangles, _ = Y.mesh(fineness)
        v, a = measure(vertices, triangles)
        errors.append((v / Y.volume() - 1, a / Y.area() - 1))
    coarse, fine = np.abs(errors)
    assert (fine < 0.02).all()
    assert (fine < coarse / 2.5).all()
    assert (np.array(errors) < 1e-12).all() or len(Y) > 1  # chords of a ball are inside it


def test_degenerate_positions_measure_like_their_neighbours():
    """Many spheres through one point, circles that touch: moving everything by 1e-9 changes as little."""
    rng = np.random.default_rng(3)
    for number in of_all_families(20):
        Y = family_member(number)
        reach = Y.radii[:, None]
        moved = Balls(
            Y.centers + 1e-9 * reach * rng.standard_normal(Y.centers.shape),
            Y.radii * (1 + 1e-9 * rng.standard_normal(len(Y))),
        )
        assert moved.volume() == pytest.approx(Y.volume(), rel=2e-8), number
        assert moved.area() == pytest.approx(Y.area(), rel=2e-8), number


def test_delaunay_balls_known_badly():
    """Balls through five cospherical samples come in copies, which rounding turns into close balls."""
    shape = psl.datasets.load("metacarpal")
    Y = psl.delaunay_balls(shape)
    rng = np.random.default_rng(0)
    reach = Y.radii[:, None]
    moved = Balls(
        Y.centers + 1e-9 * reach * rng.standard_normal(Y.centers.shape),
        Y.radii * (1 + 1e-9 * rng.standard_normal(len(Y))),
    )
    assert moved.volume() == pytest.approx(Y.volume(), rel=1e-6)
    assert moved.area() == pytest.approx(Y.area(), rel=1e-6)


def test_measures_add_up_over_components():
    one, many = far_apart(1), far_apart(500)
    assert many.volume() == pytest.approx(500 * one.volume(), rel=1e-12)
    assert many.area() == pytest.approx(500 * one.area(), rel=1e-12)


@pytest.mark.parametrize("number", of_all_families(2))
def test_moved_and_scaled(number):
    Y = family_member(number)
    turn = Rotation.from_rotvec([0.3, -1.1, 0.7]).as_matrix()
    queries = np.random.default_rng(number).uniform(*Y.box(), (50, 3))
    middle = Y.centers.mean(axis=0)
    for scale, shift in ((1, 0), (1e-6, 0), (1e6, 3e6), (1, 1e4)):
        moved = Balls(scale * (Y.centers - middle) @ turn.T + shift, scale * Y.radii)
        # Coordinates have 16 digits, and those in front of the size of the balls are lost.
        lost = 1e-12 + 1e-14 * abs(shift) / (scale * Y.radii.min())
        lost += 1e-13 * np.abs(middle).max() / Y.radii.min()
        assert moved.volume() == pytest.approx(scale**3 * Y.volume(), rel=lost)
        assert moved.area() == pytest.approx(scale**2 * Y.area(), rel=lost)
        found = moved.distance(scale * (queries - middle) @ turn.T + shift)
        assert found == pytest.approx(scale * Y.distance(queries), abs=lost * scale * Y.size)


# --- the mesh


@pytest.mark.parametrize("number", of_all_families(3))
@pytest.mark.parametrize("fineness", [0.03, 0.5])
def test_mesh_is_closed_on_the_spheres_and_faces_outward(number, fineness):
    Y = family_member(number)
    vertices, triangles, ball = Y.mesh(fineness)
    assert len(np.unique(triangles)) == len(vertices)
    there, back = directed_edges(triangles, len(vertices))
    assert np.array_equal(there, back)
    assert len(np.unique(there)) == len(there)
    away = vertices[triangles] - Y.centers[ball][:, None]
    rounding = 1e-14 + 1e-14 * np.abs(Y.centers).max() / Y.radii.min()
    assert np.linalg.norm(away, axis=2) == pytest.approx(
        np.repeat(Y.radii[ball, None], 3, axis=1), rel=rounding
    )
    assert not Y.inside(vertices, 1e-11 + rounding).any()
    assert set(ball) == set(np.flatnonzero(Y.union.exposed))
    a, b, c = away.transpose(1, 0, 2)
    outward = (np.cross(b - a, c - a) * (a + b + c)).sum(axis=1)
    assert (outward > -1e-12 * Y.radii[ball] ** 3).all()


@pytest.mark.parametrize("number", of_all_families(3))
def test_mesh_has_the_topology_of_the_boundary(number):
    """The boundary of a solid has twice the Euler number of the solid."""
    Y = family_member(number)
    vertices, triangles, _ = Y.mesh(0.02)
    b0, b1, b2 = Union(Y.centers, Y.radii, seed=number).betti()
    assert len(vertices) - len(triangles) / 2 == 2 * (b0 - b1 + b2)


def test_mesh_of_one_ball_is_an_icosphere():
    vertices, triangles, ball = Balls([(0, 0, 0)], [1]).mesh(1.0)
    assert (len(vertices), len(triangles), set(ball)) == (42, 80, {0})


@pytest.mark.parametrize("parts", [1, 2, 3, 7])
def test_icosphere(parts):
    vertices, triangles = _icosphere(parts)
    assert (len(vertices), len(triangles)) == (10 * parts**2 + 2, 20 * parts**2)
    there, back = directed_edges(triangles, len(vertices))
    assert np.array_equal(there, back)
    assert len(np.unique(there)) == len(there)
    assert measure(vertices, triangles)[0] > 0


def test_fineness_is_the_length_of_the_edges():
    Y = Balls([(0, 0, 0), (1, 0, 0), (4, 0, 0)], [1, 1, 0.01])
    for fineness in (0.01, 0.03):
        vertices, triangles, ball = Y.mesh(fineness)
        edges = vertices[triangles[ball < 2]][:, [0, 1, 2]] - vertices[triangles[ball < 2]][:, [1, 2, 0]]
        length = np.linalg.norm(edges, axis=2)
        assert length.max() < 1.6 * fineness * Y.size
        assert np.median(length) > 0.4 * fineness * Y.size
        assert (ball == 2).sum() == 80
    with pytest.raises(InputError, match="fineness"):
        Y.mesh(0)


def test_thin_patches_are_not_lost():
    """Spheres of which next to nothing is left still close the mesh."""
    for gap in (1, 1e-2, 1e-4, 1e-5, 1e-8):
        Y = Balls([(0, 0, 0), (gap, 0, 0), (2 * gap, 0, 0)], [1, 1, 1])
        vertices, triangles, ball = Y.mesh()
        there, back = directed_edges(triangles, len(vertices))
        assert np.array_equal(there, back)
        assert set(ball) == set(np.flatnonzero(Y.union.exposed))
        assert measure(vertices, triangles)[0] == pytest.approx(Y.volume(), rel=1e-2)


def test_a_fan_has_the_given_boundary():
    rng = np.random.default_rng(0)
    rims = np.concatenate(
        [np.column_stack([ring, np.roll(ring, -1)]) for ring in np.split(rng.permutation(20), [4])]
    )
    there, back = directed_edges(_fan(rims), 20)
    left = np.setdiff1d(there, back)
    assert np.array_equal(left, np.sort(rims[:, 0] * 20 + rims[:, 1]))


def test_spheres_that_surround_a_common_point():
    """Eight spheres meet in the middle of each cube of a grid, which is not on the boundary."""
    grid = np.stack(np.meshgrid(*[np.arange(4.0)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    Y = Balls(grid, np.full(len(grid), np.sqrt(0.75)))
    vertices, triangles, ball = Y.mesh(0.02)
    there, back = directed_edges(triangles, len(vertices))
    assert np.array_equal(there, back)
    assert measure(vertices, triangles)[0] == pytest.approx(Y.volume(), rel=3e-3)
    # No hole inside: all that is left are the outer balls.
    assert set(ball) == set(np.flatnonzero(((grid == 0) | (grid == 3)).any(axis=1)))
    assert Y.distance([(1.5, 1.5, 1.5)])[0] == pytest.approx(2, rel=1e-12)


def test_many_balls_take_seconds():
    """Smoke test: no quadratic memory, no loop over pairs; times are in the benchmarks."""
    rng = np.random.default_rng(0)
    Y = Balls(rng.standard_normal((1_500, 3)) * 3.5, rng.uniform(0.3, 1, 1_500))
    vertices, triangles, _ = Y.mesh()
    there, back = directed_edges(triangles, len(vertices))
    assert np.array_equal(there, back)
    assert 0 < measure(vertices, triangles)[0] < Y.volume()
    points = rng.uniform(*Y.box(), (10_000, 3))
    low, high = Y.box()
    distance = Y.distance(points)
    square, _ = cKDTree(Y.centers).query(points)
    assert np.isfinite(distance).all()
    assert (distance >= square - 1)[square > 1].all()
    share = np.mean([Y.inside(part).mean() for part in np.split(points, 100)])
    box = np.prod(high - low)
    assert abs(Y.volume() - box * share) < 5 * box * np.sqrt(share * (1 - share) / len(points))
