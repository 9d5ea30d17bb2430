"""The whole chain in one call, on shapes with few vertices: lengths and widths can be checked by hand."""

import warnings

import numpy as np
import pytest
from truth.meshes import capsule, extruded

import polyskel_lite as psl
from polyskel_lite.skeletons import smooth_lengths


def test_rectangle_has_its_axis():
    bones = psl.skeleton([[(0, 0), (20, 0), (20, 4), (0, 4)]])
    (axis,) = bones.branches
    assert axis.length == pytest.approx(16, rel=0.01)
    assert axis.smooth_length == pytest.approx(16, rel=0.01)
    assert axis.mean_radius == pytest.approx(2, rel=0.05)
    assert bones.quality.ratio < 1.02
    assert bones.quality.added > 0


def test_t_has_three_arms_of_the_right_width():
    bones = psl.skeleton([[(0, 0), (100, 0), (100, 10), (60, 10), (60, 60), (40, 60), (40, 10), (0, 10)]])
    assert len(bones.branches) == 3
    true = bones.given.boundary_distance(bones.skeleton.vertices)
    assert np.abs(bones.skeleton.radii / true - 1).max() < 0.05
    widths = sorted(round(2 * row.least_radius) for row in bones.branches)
    assert widths == [10, 10, 20]


def test_without_samples_it_is_told():
    rectangle = psl.Shape.from_rings([[(0, 0), (20, 0), (20, 4), (0, 4)]])
    with pytest.warns(psl.CoarseSamplingWarning, match=r"5\.10 times as large"):
        psl.skeleton(rectangle, densify=False)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        psl.skeleton(psl.datasets.load("gear"), densify=False)


def test_what_is_too_thin_is_told_with_what_to_do():
    bar = [[(0, 0), (1, 0), (1, 1e-4), (0, 1e-4)]]
    with pytest.warns(psl.CoarseSamplingWarning, match=r"densify\(1e-05\) adds the .* samples") as told:
        psl.skeleton(bar)
    assert told[0].filename == __file__
    with pytest.warns(psl.CoarseSamplingWarning, match=r"it is 1e-08 wide there, too thin for its size"):
        psl.skeleton([[(0, 0), (1, 0), (1, 1e-8), (0, 1e-8)]])


def test_files_and_refusals(tmp_path):
    file = tmp_path / "plan.geojson"
    file.write_text('{"type": "Polygon", "coordinates": [[[0, 0], [8, 0], [8, 2], [0, 2], [0, 0]]]}')
    assert psl.skeleton(file).branches[0].mean_radius == pytest.approx(1, rel=0.05)
    with pytest.raises(psl.InputError, match="unknown strategy"):
        psl.skeleton(file, strategy="twigs")


@pytest.mark.parametrize("zigzag", [0.0, 0.1, 0.2])
def test_a_straight_bar_of_16_measures_16(zigzag):
    x = np.arange(0, 16.25, 0.25)
    points = np.column_stack([x, zigzag * (np.arange(len(x)) % 2), np.zeros_like(x)])
    assert smooth_lengths(points, np.full(len(x), 2.0), [len(x)])[0] == pytest.approx(16, rel=0.01)


def test_chains_do_not_know_of_each_other():
    rng = np.random.default_rng(0)
    sizes = [2, 7, 3, 40, 2]
    points, radii = rng.normal(size=(sum(sizes), 2)), rng.random(sum(sizes))
    cuts = np.cumsum(sizes)[:-1]
    alone = [
        smooth_lengths(p, r, [len(r)])[0]
        for p, r in zip(np.split(points, cuts), np.split(radii, cuts), strict=True)
    ]
    assert smooth_lengths(points, radii, sizes) == pytest.approx(alone, rel=1e-12)
    assert smooth_lengths(points + 1e6, radii, sizes) == pytest.approx(alone, rel=1e-6)
    assert alone[0] == pytest.approx(np.linalg.norm(points[1] - points[0]), rel=1e-12)


SOLIDS = {
    "box": extruded([(0, 0), (4, 0), (4, 4), (0, 4)], [(0, 1, 2), (0, 2, 3)], 12.0),
    "prism": extruded([(0, 0), (6, 0), (3, 27**0.5)], [(0, 1, 2)], 10.0),
    "L": extruded(
        [(0, 0), (8, 0), (8, 3), (3, 3), (3, 8), (0, 8)], [(0, 1, 2), (0, 2, 3), (0, 3, 5), (3, 4, 5)], 3.0
    ),
}


@pytest.mark.parametrize(("name", "width"), [("box", 2), ("prism", 3**0.5), ("L", 1.5)])
def test_solids_of_few_corners_have_their_width(name, width):
    solid = psl.Shape.from_mesh(*SOLIDS[name])
    bones = psl.skeleton(solid, strategy="wireframe")
    assert bones.skeleton.betti() == (1, 0, 0)
    assert bones.quality.ratio < 1.05
    assert bones.quality.added > 1000
    assert bones.skeleton.radii.max() == pytest.approx(width, rel=0.05)
    with pytest.warns(psl.CoarseSamplingWarning):
        assert psl.skeleton(solid, strategy="wireframe", densify=False).quality.ratio > 1.5


def test_a_fine_mesh_keeps_its_samples_and_a_straight_bar_its_length():
    bones = psl.skeleton(psl.Shape.from_mesh(*capsule(16.0, 24, 60, 8)), strategy="wireframe")
    assert bones.quality.added == 0
    (wire,) = bones.branches
    assert wire.smooth_length == pytest.approx(16, rel=0.01)
    assert wire.mean_radius == pytest.approx(1, rel=0.02)


def test_what_is_printed_is_one_short_line():
    bones = psl.skeleton([[(0, 0), (20, 0), (20, 4), (0, 4)]])
    voronoi, P = psl.voronoi([(0, 0), (2, 0), (0, 2)]), bones.hierarchy.P
    assert repr(bones.given) == "Shape(2D, 4 points, 4 segments, (0, 0) to (20, 4), Betti (1, 0))"
    assert repr(voronoi) == "Skeleton(2D, 1 vertices, 0 edges, 3 rays, (1, 1) to (1, 1), Betti (1, 2))"
    assert repr(voronoi.tessellation) == "Tessellation(2D, 3 points, 1 triangles, (0, 0) to (2, 2))"
    assert repr(voronoi.balls()) == "Polyball(2D, 1 balls, (-0.4142, -0.4142) to (2.414, 2.414))"
    n, about = P.inner.sum(), "(0, 0) to (20, 4), Betti (1, 0)"
    assert repr(P) == f"DelaunayShape(2D, {n} inner triangles of {n}, {about})"
    assert repr(bones.hierarchy) == f"Hierarchy(2D, 'branch', {n} simplices, {about})"
    assert repr(bones) == f"Bones({bones.skeleton} at 3, 'branch')"
    assert len(repr(bones)) < 100


@pytest.mark.parametrize("kind", [list, tuple, np.array, lambda ring: list(map(list, ring))])
def test_one_ring_alone_is_told_to_go_into_a_list(kind):
    ring = kind([(0, 0), (1, 0), (0, 1.5)])
    for taker in (psl.skeleton, psl.Shape.from_rings):
        with pytest.raises(psl.InputError, match=r"list of points, not of rings; for one ring pass \[ring\]"):
            taker(ring)
