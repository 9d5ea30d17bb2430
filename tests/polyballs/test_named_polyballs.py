"""Skeletons of polyballs that can be named: by hand, and counterexamples."""

from __future__ import annotations

import numpy as np
import pytest
from truth.cases import away, both_ways, check_complete, check_medial, hausdorff, samples_of
from truth.complexes import distance_to_complex, lengths, sample_complex
from truth.medial import Union

import polyskel_lite as psl

each_dimension = pytest.mark.parametrize("N", [2, 3])


def line_of(*points):
    points = np.array(points, dtype=float)
    edges = np.column_stack([np.arange(len(points) - 1), np.arange(1, len(points))])
    return points, edges


def is_exactly(skeleton, vertices, edges=(), polygons=(), tolerance=1e-12):
    """Whether the skeleton, as a set, is the given complex."""
    rng = np.random.default_rng(0)
    if not len(skeleton.vertices):
        return not len(vertices)
    there = away(sample_complex(rng, vertices, edges, polygons, 10, 20), skeleton).max()
    here = distance_to_complex(
        samples_of(skeleton, rng, per_edge=10, per_polygon=20), vertices, edges, polygons
    )
    return max(there, here.max()) < tolerance


@each_dimension
def test_one_ball(N):
    Y = psl.Polyball([np.arange(1.0, N + 1)], [2])
    skeleton = Y.skeleton()
    assert is_exactly(skeleton, [np.arange(1.0, N + 1)])
    assert skeleton.radii == pytest.approx([2])
    assert skeleton.betti() == (1, 0, 0)[:N]
    assert Y.disconnected().tolist() == [0]
    assert not len(Y.singular_points())
    assert not len(Y.quasi_disconnected())
    assert not len(Y.exposed_pairs())


@each_dimension
def test_two_balls(N):
    """The segment between the centres, no more."""
    centers = np.zeros((2, N))
    centers[1, 0] = 1.2
    Y = psl.Polyball(centers, [1, 0.8])
    assert is_exactly(Y.skeleton(), *line_of(*centers))
    assert Y.quasi_disconnected().tolist() == [[0, 1]]
    assert Y.exposed_pairs().tolist() == [[0, 1]]
    assert not len(Y.disconnected())
    assert len(Y.singular_points()) == (2 if N == 2 else 0)


@each_dimension
def test_coincident_and_swallowed_balls(N):
    """Doubles, a ball in a ball, and one touching from inside change nothing."""
    centers, radii = np.zeros((5, N)), np.array([1, 1, 0.3, 0.5, 1])
    centers[2, 0], centers[3, 1] = 0.2, 0.5
    centers[4, 0] = 1
    Y = psl.Polyball(centers, radii)
    assert is_exactly(Y.skeleton(), *line_of(centers[0], centers[4]))
    assert len(Y.minimal().radii) == 2
    assert sorted(Y.generating().tolist()) in ([0, 4], [1, 4])
    same = psl.Polyball(centers[:2], radii[:2])
    assert is_exactly(same.skeleton(), centers[:1])
    assert len(same.disconnected()) == 1


@each_dimension
def test_a_ball_in_the_union_of_two_others(N):
    centers = np.zeros((3, N))
    centers[:, 0] = 0, 0.5, 1
    Y = psl.Polyball(centers, [1, 0.9, 1])
    # 0.9 is more than the half chord: the ball in the middle shows.
    assert len(Y.minimal().radii) == 3
    Y = psl.Polyball(centers, [1, 0.85, 1])
    assert Y.generating().tolist() == [0, 2]
    assert is_exactly(Y.skeleton(), *line_of(centers[0], centers[2]))


@each_dimension
def test_tiny_and_far(N):
    for offset, scale in ((0, 1e-12), (1e6, 1), (1e-3, 1e-9)):
        centers = np.zeros((2, N)) + offset
        centers[1, 0] += scale
        d = centers[1, 0] - centers[0, 0]
        skeleton = psl.Polyball(centers, [scale, scale]).skeleton()
        assert is_exactly(skeleton, *line_of(*centers), tolerance=1e-6 * d)


def test_hexagon_swallows_its_reflex_sample():
    """Fact 5: Sk2 is not the skeleton of Y_w although the boundary is strictly Gabriel."""
    shape = psl.Shape.from_rings([[(0, 0), (0, 3), (-3, 1), (-2, -2), (1, -2), (3, 0)]])
    assert not len(psl.missing_facets(shape, of="gabriel"))
    Y = psl.delaunay_balls(shape)
    truth = Union(Y.centers, Y.radii)
    reflex = int(np.flatnonzero((shape.points == 0).all(axis=1))[0])
    assert truth.boundary_distance(shape.points)[reflex] == pytest.approx(1, abs=1e-12)
    assert Y.boundary_distance(shape.points)[reflex] == pytest.approx(1, abs=1e-12)
    found = Y.singular_points()
    assert both_ways(found, truth.singular_points()) < 1e-12
    strange = found[lengths(found[:, None] - shape.points).min(axis=1) > 1e-9]
    assert strange == pytest.approx(np.array([[3 / 5, 4 / 5]]))
    skeleton, sk2 = Y.skeleton(), psl.sk2(shape)
    rng = np.random.default_rng(0)
    check_complete(truth, skeleton, rng)
    check_medial(truth, skeleton, rng)
    assert hausdorff(skeleton, sk2, rng) > 0.1
    conditions = psl.sk2_conditions(shape)
    assert conditions.swallowed.tolist() == [reflex]
    assert conditions.extra == pytest.approx(np.array([[3 / 5, 4 / 5]]))
    assert not conditions.hold["a"]
    assert not conditions.hold["b"]


def test_three_discs_may_close_a_point():
    """On three circles and in no open disc, and yet inside: no singular point, no hole."""
    Y = psl.Polyball([(1, 0), (-0.6, 0.8), (-0.6, -0.8)], [1, 1, 1])
    truth = Union(Y.centers, Y.radii)
    assert len(Y.singular_points()) == 3
    assert Y.boundary_distance([(0, 0)])[0] == pytest.approx(truth.boundary_distance([(0, 0)])[0])
    assert Y.boundary_distance([(0, 0)])[0] > 0.5
    assert Y.skeleton().betti() == (1, 0)
    rng = np.random.default_rng(0)
    check_complete(truth, Y.skeleton(), rng)
    check_medial(truth, Y.skeleton(), rng)


def test_four_balls_may_close_a_point():
    centers = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)], dtype=float)
    Y = psl.Polyball(centers, np.full(4, np.sqrt(3)))
    truth = Union(Y.centers, Y.radii)
    assert both_ways(Y.singular_points(), truth.singular_points()) < 1e-9
    assert lengths(Y.singular_points()).min() > 1
    assert Y.boundary_distance([(0, 0, 0)])[0] == pytest.approx(truth.boundary_distance([(0, 0, 0)])[0])
    assert Y.skeleton().betti() == (1, 0, 0)
    rng = np.random.default_rng(0)
    check_complete(truth, Y.skeleton(), rng)
    check_medial(truth, Y.skeleton(), rng)


@each_dimension
@pytest.mark.parametrize("statement", ["corrected", "transcript"])
def test_tangent_balls_are_named(N, statement):
    """Fact 6: the theorems leave them out."""
    centers = np.zeros((3, N))
    centers[1:, 0] = -4, 2
    Y = psl.Polyball(centers, [1, 1, 1])
    with pytest.raises(psl.TangentBallsError) as caught:
        Y.skeleton(statement=statement)
    assert sorted(np.asarray(caught.value.pairs).ravel().tolist()) == [0, 2]
    assert "0" in str(caught.value)
    assert "2" in str(caught.value)
    assert isinstance(caught.value, psl.PolyskelError)


def test_three_unit_balls_on_a_line():
    """Fact 7: as printed the theorem gives nothing, the truth is a segment."""
    Y = psl.Polyball([(0, 0, 0), (0.5, 0, 0), (1, 0, 0)], [1, 1, 1])
    assert len(Y.minimal().radii) == 3
    assert not len(Y.quasi_disconnected())
    assert not len(Y.disconnected())
    assert not len(Y.singular_points())
    printed = Y.skeleton(statement="transcript")
    assert not len(printed.vertices)
    assert not len(printed.edges)
    assert is_exactly(Y.skeleton(), *line_of((0, 0, 0), (0.5, 0, 0), (1, 0, 0)))
    assert sorted(map(sorted, Y.exposed_pairs().tolist())) == [[0, 1], [1, 2]]
    assert Y.skeleton().betti() == (1, 0, 0)


def test_a_circle_partly_on_the_boundary_gives_its_whole_segment():
    """Fact 7. Its arcs end in singular points, so the Voronoi graph has the segment, as printed as well."""
    centers = np.array([(0, 0, 0), (1, 0, 0), (0.5, 0.9, 0)])
    radii = np.array([1, 1, 0.5])
    truth = Union(centers, radii)
    widths = truth.arcs[(truth.arcs[:, :2] == (0, 1)).all(axis=1), 2]
    assert 0.1 < widths.sum() < 2 * np.pi - 0.1
    Y = psl.Polyball(centers, radii)
    along = np.linspace(0, 1, 21)[:, None] * centers[1]
    assert truth.growth(along)[0].max() < 1e-9
    assert away(along, Y.skeleton()).max() < 1e-12
    assert away(along, Y.skeleton(statement="transcript")).max() < 1e-12
    assert [0, 1] in np.sort(Y.exposed_pairs(), axis=1).tolist()


def test_in_the_plane_one_exposed_crossing_is_not_enough():
    """The same balls as discs: the segment leaves the skeleton where the third disc covers a crossing."""
    centers, radii = np.array([(0, 0), (1, 0), (0.5, 0.9)]), np.array([1, 1, 0.5])
    truth, skeleton = Union(centers, radii), psl.Polyball(centers, radii).skeleton()
    middle = np.array([[0.5, 0.0]])
    assert truth.growth(middle)[0][0] > 1e-3
    assert away(middle, skeleton)[0] > 1e-3
    rng = np.random.default_rng(0)
    check_complete(truth, skeleton, rng)
    check_medial(truth, skeleton, rng)


def test_minimal_writing_is_not_unique():
    """Fact 8: a filler without any boundary; its centre is not on the skeleton, and others do as well."""
    discs = [(1.1, 0), (-0.55, 0.9526), (-0.55, -0.9526)]
    Y = psl.Polyball([*discs, (0, 0.05)], [1, 1, 1, 0.3])
    Z = psl.Polyball([*discs, (0.02, 0)], [1, 1, 1, 0.3])
    assert Y.generating().tolist() == Z.generating().tolist() == [0, 1, 2, 3]
    truth = Union(Y.centers, Y.radii)
    queries = np.random.default_rng(0).uniform(-2, 2, (200, 2))
    assert Y.boundary_distance(queries) == pytest.approx(Z.boundary_distance(queries), abs=1e-12)
    rng = np.random.default_rng(0)
    assert hausdorff(Y.skeleton(), Z.skeleton(), rng) < 1e-9
    assert away([(0, 0.05)], Y.skeleton())[0] > 0.01
    check_complete(truth, Y.skeleton(), rng)
    check_medial(truth, Y.skeleton(), rng)
    without = Union(Y.centers[:3], Y.radii[:3])
    assert (truth.betti(), without.betti()) == ((1, 0), (1, 1))


@each_dimension
def test_a_ball_whose_hole_has_its_corners_on_the_sphere_is_needed(N):
    """As in Y_w: the other Delaunay balls pass through N + 1 points of one, and leave a hole between them."""
    if N == 2:
        angle = np.pi * (1 + 2 * np.arange(3)) / 3
        away_from, radius = 2.5 * np.column_stack([np.cos(angle), np.sin(angle)]), np.sqrt(19) / 2
    else:
        directions = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]) / np.sqrt(3)
        away_from, radius = -13 / 3 * directions, np.sqrt(152) / 3
    Y = psl.Polyball(np.concatenate([away_from, np.zeros((1, N))]), np.append(np.full(N + 1, radius), 1))
    truth = Union(Y.centers, Y.radii)
    assert not truth.redundant(N + 1)
    assert Y.generating().tolist() == list(range(N + 2))
    assert not Y.exposed()[N + 1]
    assert Y.skeleton().betti() == truth.betti(1e-9) == (1, 0, 0)[:N]
    rng = np.random.default_rng(0)
    check_complete(truth, Y.skeleton(), rng)
    check_medial(truth, Y.skeleton(), rng)
    missing = Union(away_from, np.full(N + 1, radius))
    assert missing.boundary_distance(np.zeros((1, N)))[0] < 0.4
    assert missing.robust_betti() == ((1, 1) if N == 2 else (1, 0, 1))


def test_a_ring_and_a_hollow_ball():
    angle = np.arange(6) * np.pi / 3
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    skeleton = psl.Polyball(ring, np.full(6, 0.6)).skeleton()
    edges = np.column_stack([np.arange(6), (np.arange(6) + 1) % 6])
    assert is_exactly(skeleton, ring, edges, tolerance=1e-9)
    assert skeleton.betti() == (1, 1)
    corners = np.array(list(np.ndindex(2, 2, 2))) * 2.0 - 1
    faces = np.concatenate([np.eye(3), -np.eye(3)]) * 1.4
    centers, radii = np.concatenate([corners, faces]), np.concatenate([np.full(8, 1.1), np.full(6, 1.2)])
    truth = Union(centers, radii)
    assert truth.robust_betti() == (1, 0, 1)
    skeleton = psl.Polyball(centers, radii).skeleton()
    assert skeleton.betti() == (1, 0, 1)
    rng = np.random.default_rng(0)
    check_complete(truth, skeleton, rng)
    check_medial(truth, skeleton, rng)


def test_a_tunnel_that_closes_in_one_point():
    """Three spheres touch one line in one point: the skeleton keeps the loop that the interior has."""
    angle = np.arange(3) * 2 * np.pi / 3
    centers = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(3)])
    for radius, betti in ((0.95, (1, 1, 0)), (1.05, (1, 0, 0))):
        Y = psl.Polyball(centers, np.full(3, radius))
        assert Y.skeleton().betti() == Union(Y.centers, Y.radii).robust_betti() == betti
    truth, skeleton = Union(centers, np.ones(3)), psl.Polyball(centers, np.ones(3)).skeleton()
    assert is_exactly(skeleton, centers, [(0, 1), (1, 2), (2, 0)], tolerance=1e-7)
    assert truth.robust_betti() is None
