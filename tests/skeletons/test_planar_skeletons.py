"""Sk0 to Sk3: inclusions, homotopy, reversibility, degenerate input."""

from itertools import pairwise

import numpy as np
import pytest
from truth.rational import grid_region, rational, sk2_oracle

import polyskel_lite as psl

OUTLINES = {
    "horse": (1, 0),
    "leaf": (1, 0),
    "lake": (1, 2),
    "hawaii": (8, 0),
    "gear": (1, 1),
    "elephant": (1, 0),
}


@pytest.mark.parametrize(("name", "betti"), OUTLINES.items())
def test_real_outlines(name, betti):
    """Homotopy and reversibility of Sk0 (section 3.4) on real shapes."""
    shape = psl.datasets.load(name)
    P = psl.delaunay_shape(shape)
    skeleton = psl.sk0(P)
    assert shape.betti() == P.betti() == skeleton.betti() == betti
    again = skeleton.reconstruct()
    assert (again.inner == P.inner).all()
    assert {tuple(e) for e in again.boundary().tolist()} == {tuple(e) for e in shape.facets.tolist()}
    # Alexander duality: with the point at infinity, the complement has a component more than holes.
    assert psl.sk0(P, side="outer").betti() == (betti[1] + 1, betti[0] - 1)


def pieces(skeleton):
    """Vertices and edges as sets of simplices, to compare skeletons of one tessellation."""
    edges = {frozenset(skeleton.simplices[edge].tolist()) for edge in skeleton.edges}
    return set(skeleton.simplices.tolist()), edges


@pytest.mark.parametrize("side", ["inner", "outer"])
@pytest.mark.parametrize("n", [40, 60, 100, 200])
@pytest.mark.parametrize("name", ["horse", "lake"])
def test_inclusions(name, n, side):
    """Sk1 in Sk2 in Sk3, also where the samples are too few for anything else to hold."""
    shape = psl.datasets.load(name)
    E = psl.delaunay(shape.sample(n))
    one, two, three = (method(shape, E, side=side) for method in (psl.sk1, psl.sk2, psl.sk3))
    (v1, e1), (v2, e2), (v3, e3) = map(pieces, (one, two, three))
    assert v1 == v2 == v3 - {-1}
    assert e1 == set()
    assert e2 <= e3
    # Every piece of Sk3 is in the shape: its middle is, and its cut ends are on the boundary.
    middles = three.segments().mean(axis=1)
    where = shape.locate(middles[np.isfinite(middles).all(axis=1)])
    assert (where >= 0).all() if side == "inner" else (where <= 0).all()
    cut = three.simplices < 0
    # Cut points are rounded to floats near a shape of size one.
    assert shape.boundary_distance(three.vertices[cut]).max() < 1e-12
    nearest = np.sqrt(((three.vertices[cut][:, None] - E.points) ** 2).sum(axis=2)).min(axis=1)
    assert np.allclose(three.radii[cut], nearest, rtol=1e-9)


@pytest.mark.parametrize("seed", range(12))
def test_sk2_of_a_coarse_sampling_by_definition(seed):
    """Any samples, any side, against the rational oracle; lattice corners make touching cases common."""
    rng = np.random.default_rng(seed)
    shape = psl.Shape.from_rings(grid_region(rng, size=3, hole=seed % 3 == 0))
    samples = rational(shape.points)
    segments = [(samples[a], samples[b]) for a, b in shape.facets.tolist()]
    for side, name in ((1, "inner"), (-1, "outer")):
        vertices, edges, touching = sk2_oracle(samples, segments, side)
        ours = psl.sk2(shape, side=name)
        assert rounded(vertices | touching) == rounded(ours.vertices.tolist())
        t = ours.tessellation
        found = set()
        for a, b in ours.edges.tolist():
            if not np.allclose(ours.vertices[a], ours.vertices[b], atol=1e-9):
                corners = [set(t.simplices[ours.simplices[k]].tolist()) for k in (a, b)]
                found.add(frozenset(samples[i] for i in corners[0] & corners[1]))
        bounded = {e for e in edges if len(e) == 2}
        # The oracle's edges are in the open side; ours may also touch the boundary. Rays are counted apart.
        if not touching:
            assert found <= bounded
            assert len(bounded) - len(found) <= len(ours.rays)


def rounded(vertices):
    # Circumcenters of lattice triangles; nine digits tell different ones apart and forgive rounding.
    return {tuple(float(f"{float(x):.9g}") + 0.0 for x in v) for v in vertices}


def test_named_counterexamples_of_sk2():
    empty = psl.Shape.from_rings([[(0, 0), (0, 1), (1, 2)]])
    assert len(psl.sk2(empty).vertices) == 0
    apart = psl.Shape.from_rings([[(0, 0), (0, 1), (1, 1), (0, 2), (2, 1)]])
    assert psl.sk2(apart).betti()[0] > apart.betti()[0]


def test_sk0_may_leave_the_shape():
    shape = psl.Shape.from_rings([[(0, 0), (4, 0), (2, 1)]])
    skeleton = psl.sk0(shape)
    assert not shape.contains(skeleton.vertices).any()


def test_cocircular_ears_are_two_components_at_one_point():
    """The dual complex is abstract: as a point set it would be connected."""
    circle = np.array([(5, 0), (3, 4), (-3, 4), (-5, 0), (-3, -4), (3, -4)], dtype=float)
    ears = psl.Shape(circle, [(0, 1), (1, 5), (5, 0), (2, 3), (3, 4), (4, 2)])
    skeleton = psl.sk0(ears)
    assert ears.betti() == skeleton.betti() == (2, 0)
    assert skeleton.vertices.tolist() == [[0, 0], [0, 0]]


@pytest.mark.parametrize("flip", [False, True])
def test_either_diagonal_of_a_square_is_contained(flip):
    """Cocircular samples: a boundary on one diagonal is in Del(E), whichever Qhull prefers."""
    square = np.array([(0, 0), (2, 0), (2, 2), (0, 2)], dtype=float)
    far = np.array([(9, 9), (8, 10), (10, 10)], dtype=float)
    corners = square[[1, 2, 3]] if flip else square[[0, 1, 2]]
    other = square[[0]] if flip else square[[3]]
    # The fourth corner is a vertex of another component, a thin triangle away from the diagonal.
    away = other + np.sign(other - 1) * np.array([(0, 0), (4, 0.5), (4, 1)])
    shape = psl.Shape.from_rings([corners, np.unique(away, axis=0), far])
    assert not len(psl.missing_facets(shape))
    assert psl.sk0(shape).betti() == (3, 0)


@pytest.mark.parametrize("move", [(0, 0), (1e7, -3e7)])
@pytest.mark.parametrize("scale", [1e-9, 1.0, 2.0**40])
def test_moving_and_scaling_change_nothing(scale, move):
    shape = psl.datasets.load("horse", n=120)
    other = psl.Shape((shape.points + np.array(move)) * scale, shape.facets)
    a, b = psl.sk2(shape), psl.sk2(other)
    # Moving rounds the points to 1e-9, which may change a sign only where the shape itself has changed.
    assert abs(len(a.vertices) - len(b.vertices)) <= (0 if move == (0, 0) else 2)


def test_samples_may_be_a_tessellation():
    shape = psl.datasets.load("horse")
    E = shape.sample(150)
    assert psl.sk2(shape, psl.delaunay(E)).edges.tolist() == psl.sk2(shape, E).edges.tolist()


def test_samples_of_another_dimension():
    with pytest.raises(psl.InputError, match="E is in 3D"):
        psl.sk2(psl.datasets.load("gear"), np.random.default_rng(0).random((9, 3)))


def test_save_and_load(tmp_path):
    for skeleton in (
        psl.sk0(psl.datasets.load("lake"), side="outer"),
        psl.voronoi(np.random.default_rng(0).random((20, 3))),
    ):
        skeleton.save(tmp_path / "s.npz")
        other = psl.Skeleton.load(tmp_path / "s.npz")
        for name in ("vertices", "radii", "simplices", "edges", "rays", "ray_vertices"):
            assert np.array_equal(getattr(skeleton, name), getattr(other, name))
        assert [p.tolist() for p in skeleton.polygons] == [p.tolist() for p in other.polygons]
        assert np.array_equal(skeleton.reconstruct().inner, other.reconstruct().inner)


@pytest.mark.parametrize("content", [b"", b"no numbers", b"PK\x03\x04"])
def test_files_that_are_no_skeletons(tmp_path, content):
    path = tmp_path / "bad.npz"
    path.write_bytes(content)
    with pytest.raises(psl.InputError, match="is not a skeleton"):
        psl.Skeleton.load(path)


def test_networkx_export():
    skeleton = psl.sk0(psl.datasets.load("gear"))
    graph = skeleton.to_networkx()
    assert graph.number_of_nodes() == len(skeleton.vertices)
    assert graph.number_of_edges() == len(skeleton.edges)
    assert sum(length for _, _, length in graph.edges(data="length")) == pytest.approx(skeleton.length())
    assert graph.nodes[3]["pos"] == tuple(skeleton.vertices[3])
    assert graph.nodes[3]["radius"] == skeleton.radii[3]


def test_balls_are_the_delaunay_balls():
    shape = psl.datasets.load("leaf", n=200)
    skeleton = psl.sk1(shape)
    balls = skeleton.balls()
    assert np.array_equal(balls.centers, skeleton.vertices)
    # Their circles pass through samples and hold none inside: the nearest sample is at the radius.
    d = np.sqrt(((skeleton.vertices[:, None] - shape.points) ** 2).sum(axis=2)).min(axis=1)
    assert np.allclose(d, skeleton.radii, rtol=1e-9)


def test_polygons_of_sk0_go_around_their_edge():
    graph = psl.voronoi(np.random.default_rng(5).random((60, 3)))
    edges = {frozenset(edge) for edge in graph.edges.tolist()}
    for polygon in graph.polygons:
        sides = [*pairwise(polygon.tolist()), (polygon[-1], polygon[0])]
        assert all(frozenset(map(int, side)) in edges for side in sides)


ALTERED = {
    "edges": (lambda a: a + 0.5, "edges has shape .* type float64"),
    "vertices": (lambda a: a * np.nan, r"vertex 0 is \[nan nan\]"),
    "radii": (lambda a: -a, "vertex 0 is .* with radius -"),
    "simplices": (lambda a: a + 10**6, r"simplices\[0\] is 1000"),
    "rays": (lambda a: np.ones((2, 2)), "0 ray_vertices for 2 rays"),
    "polygon_sizes": (lambda a: np.array([5]), "polygons of 5 corners in all have 0 corners"),
    "tessellation_points": (lambda a: a[:-1], r"simplices\[.* but there are only 0 to"),
    "tessellation_neighbors": (lambda a: np.roll(a, 1, axis=0), "has the neighbor"),
    "tessellation_simplices": (lambda a: None, "there is no array tessellation_simplices"),
}


@pytest.mark.parametrize("name", ALTERED)
def test_altered_skeletons_are_refused(tmp_path, name):
    psl.sk0(psl.conform(psl.datasets.load("lake"))).save(tmp_path / "k.npz")
    with np.load(tmp_path / "k.npz") as file:
        arrays = dict(file)
    alter, message = ALTERED[name]
    arrays[name] = alter(arrays[name])
    np.savez(tmp_path / "k.npz", **{key: array for key, array in arrays.items() if array is not None})
    with pytest.raises(psl.InputError, match=f"k.npz is not a skeleton .*{message}"):
        psl.Skeleton.load(tmp_path / "k.npz")
