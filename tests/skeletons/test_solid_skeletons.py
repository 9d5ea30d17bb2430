"""Sk0 to Sk3 in space: topology, inclusions, and rational arithmetic on every Voronoi edge."""

from fractions import Fraction

import numpy as np
import pytest
from truth.meshes import cube, together
from truth.solids import FIELDS, random_solids, solid

import polyskel_lite as psl
from polyskel_lite import InputError
from polyskel_lite.exact import clip_rational, fractions, locate, rational_circumcenter


def nested(small, large):
    """Whether every vertex, edge and polygon of the first is in the second (by Delaunay simplices)."""

    def cells(skeleton, parts):
        return {frozenset(skeleton.simplices[list(part)].tolist()) for part in parts if len(part) > 1}

    assert set(small.simplices.tolist()) <= set(large.simplices.tolist())
    assert cells(small, small.edges) <= cells(large, large.edges)
    assert cells(small, small.polygons) <= cells(large, large.polygons)


@pytest.mark.parametrize("side", ["inner", "outer"])
@pytest.mark.parametrize("name", ["torus", "hollow ball", "tetrapod", "metacarpal"])
def test_each_is_in_the_next(name, side):
    shape = solid(name) if name in FIELDS else psl.datasets.load(name)
    one, two, three = (f(shape, side=side) for f in (psl.sk1, psl.sk2, psl.sk3))
    nested(one, two)
    nested(two, three)
    assert len(one.edges) == len(one.polygons) == 0
    inside = shape.locate(three.vertices[three.simplices >= 0])
    assert (inside >= 0 if side == "inner" else inside <= 0).all()
    cuts = three.vertices[three.simplices < 0]
    assert len(cuts)
    assert shape.boundary_distance(cuts).max() < 1e-9
    nearest = np.sqrt(((three.vertices[:50, None] - shape.points) ** 2).sum(axis=2)).min(axis=1)
    assert three.radii[:50] == pytest.approx(nearest, rel=1e-6)
    if side == "inner":
        # Half-way along an edge, and in the middle of a polygon, one is still inside.
        assert shape.contains(two.segments().mean(axis=1)).all()
        assert shape.contains(three.segments().mean(axis=1)).all()
        assert shape.contains([two.vertices[p].mean(axis=0) for p in two.polygons]).all()


@pytest.mark.parametrize("name", ["ball", "hollow ball", "capsule"])
def test_sk2_of_dense_samples_keeps_the_topology(name):
    shape = solid(name)
    assert psl.sk2(shape).betti() == shape.betti()


def exact_edges(shape, tessellation, side):
    """Vertices and wholly inner Voronoi edges, by fractions alone."""
    triangles = shape.segments
    centers = [rational_circumcenter(t) for t in tessellation.points[tessellation.simplices]]
    vertices = set(np.flatnonzero(side * locate(triangles, np.array(centers)) >= 0).tolist())
    every = np.arange(len(triangles))
    edges, pieces = set(), 0
    for first, second in tessellation.facet_table[1].tolist():
        if second < 0:
            continue
        found = clip_rational(triangles, every, centers[first], centers[second], side)
        if found == [(0, 1)]:
            edges.add(frozenset((first, second)))
        else:
            pieces += len(found)
    return vertices, edges, pieces


def samples_of(shape, kind, random):
    if kind == "own":
        return shape.points
    return shape.points.mean(axis=0) + random.normal(size=(12, 3)) * np.ptp(shape.points, axis=0) / 2


@pytest.mark.parametrize("side", ["inner", "outer"])
@pytest.mark.parametrize("kind", ["own", "others"])
def test_vertices_and_edges_of_jagged_solids(kind, side):
    random = np.random.default_rng(5)
    for shape in random_solids(6):
        tessellation = psl.delaunay(samples_of(shape, kind, random))
        two, three = psl.sk2(shape, tessellation, side), psl.sk3(shape, tessellation, side)
        vertices, edges, pieces = exact_edges(shape, tessellation, 1 if side == "inner" else -1)
        assert set(two.simplices.tolist()) == vertices
        assert {frozenset(two.simplices[list(e)].tolist()) for e in two.edges} == edges
        rays = len(three.rays) - len(two.rays)
        added = len(three.edges) - len(two.edges)
        # Rays that come in again add edges that are not between two Voronoi vertices.
        assert added + rays >= pieces


DEGENERATE = {
    "cube": cube(),
    "cube with a cavity": together(cube(4), (cube(2, 1)[0], cube()[1][:, [0, 2, 1]])),
    "corner": ([(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4)], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]),
    # The circumcenter of this one is on a face, that of the next one outside.
    "on a face": (
        [(-1, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
        [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)],
    ),
    "flat": (
        [(-1, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0.5, 0.25)],
        [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)],
    ),
}


@pytest.mark.parametrize("side", ["inner", "outer"])
@pytest.mark.parametrize("name", DEGENERATE)
def test_cospherical_samples_and_centres_on_the_boundary(name, side):
    shape = psl.Shape(*DEGENERATE[name])
    tessellation = psl.delaunay(shape.points)
    vertices, edges, _ = exact_edges(shape, tessellation, 1 if side == "inner" else -1)
    one, two, three = (f(shape, tessellation, side) for f in (psl.sk1, psl.sk2, psl.sk3))
    assert set(one.simplices.tolist()) == set(two.simplices.tolist()) == vertices
    assert {frozenset(two.simplices[list(e)].tolist()) for e in two.edges} == edges
    nested(two, three)


def prism(x0, x1, y0, y1, z0, z1):
    """A box through which a thin triangular tunnel runs along z."""
    outer = [(x, y) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]
    inner = [(0.1, 0.0), (-0.1, 0.1), (-0.1, -0.1)]
    ring = outer + inner
    points = np.array([(*p, z) for z in (z0, z1) for p in ring])
    # Floor: a triangulation of the frame between the square and the triangle.
    frame = [(0, 1, 4), (1, 2, 4), (4, 2, 5), (2, 3, 5), (5, 3, 6), (3, 0, 6), (6, 0, 4)]
    faces = [(a, c, b) for a, b, c in frame] + [(a + 7, b + 7, c + 7) for a, b, c in frame]
    for chain in ((0, 1, 2, 3), (4, 6, 5)):
        for a, b in zip(chain, (*chain[1:], chain[0]), strict=True):
            faces += [(a, b, b + 7), (a, b + 7, a + 7)]
    return psl.Shape(points, faces)


def test_polygon_with_a_tunnel_through_it_is_left_out():
    """All sides of a Voronoi polygon are inside, but the solid has a tunnel that pierces it."""
    shape = prism(-9, 9, -9, 9, -9, 9)
    assert shape.betti() == (1, 1, 0)
    turn = 2 * np.pi * (np.arange(8) + 0.5) / 8
    belt = np.column_stack([10 * np.cos(turn) + 0.3, 10 * np.sin(turn) + 0.2, np.full(8, 0.1)])
    E = np.concatenate([belt, [(0.2, 0.1, -8), (-0.1, 0.2, 8.5)]])
    tessellation = psl.delaunay(E)
    skeleton = psl.sk2(shape, tessellation)
    solid_box = psl.Shape(*(lambda V, F: (V * 18 - 9, F))(*cube()))
    full = psl.sk2(solid_box, tessellation)
    assert len(full.polygons) > len(skeleton.polygons)
    nested(skeleton, full)
    assert len(full.edges) == len(skeleton.edges)
    assert full.betti() == (1, 0, 0)
    assert skeleton.betti() == (1, 1, 0)


def test_samples_of_the_wrong_dimension():
    with pytest.raises(InputError, match="E is in 2D and the shape in 3D"):
        psl.sk1(psl.Shape(*cube()), [(0, 0), (1, 0), (0, 1)])


def test_rational_points():
    center = rational_circumcenter(np.array([(0, 0, 0), (1, 0, 0), (0, 3, 0), (0, 0, 5)]))
    assert center.tolist() == [Fraction(1, 2), Fraction(3, 2), Fraction(5, 2)]
    V, F = cube()
    for height, where in ((Fraction(1, 3), 1), (Fraction(1), 0), (Fraction(4, 3), -1), (Fraction(0), 0)):
        assert locate(V[F], np.array([(Fraction(1, 2), Fraction(1, 2), height)])).tolist() == [where]
    ends = fractions([(-1, -1, 1), (3, 3, 1)])
    along_a_face = clip_rational(V[F], np.arange(12), *ends, 1)
    assert along_a_face == [(Fraction(1, 4), Fraction(1, 2))]


@pytest.mark.parametrize("name", [*FIELDS, "vertebra", "fourbranch"])
def test_betti_numbers_of_shape_delaunay_shape_and_sk0(name):
    shape = solid(name) if name in FIELDS else psl.datasets.load(name)
    P = psl.delaunay_shape(shape)
    skeleton = psl.sk0(P)
    assert shape.betti() == P.betti() == skeleton.betti()
    back = skeleton.reconstruct()
    assert (back.inner == P.inner).all()
    faces = {tuple(np.roll(f, -f.argmin())) for f in shape.facets}
    assert {tuple(np.roll(f, -f.argmin())) for f in P.boundary()} == faces
    corners = P.tessellation.points[P.tessellation.simplices[P.inner]]
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6
    assert volume == pytest.approx(shape.volume(), rel=1e-9)
