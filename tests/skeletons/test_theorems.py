"""Theorems 1 and 2 on 1,000 random regions, in rational arithmetic, both sides; and where they break."""

from fractions import Fraction

import numpy as np
import pytest
from truth.rational import (
    circumcenter,
    grid_region,
    location,
    rational,
    segment_side,
    sk2_oracle,
    strictly_gabriel,
)

import polyskel_lite as psl

BATCHES, PER_BATCH = 20, 50


def dual_of(P, side):
    """Sk0 from the library's labels with exact coordinates: vertices, edges by their two samples, rays."""
    samples = rational(P.tessellation.points)
    skeleton = psl.sk0(P, side)
    corners = P.tessellation.simplices[skeleton.simplices]
    centers = [circumcenter(*(samples[i] for i in triangle)) for triangle in corners.tolist()]
    edges = set()
    for a, b in skeleton.edges.tolist():
        if centers[a] != centers[b]:
            shared = set(corners[a].tolist()) & set(corners[b].tolist())
            edges.add(frozenset(samples[i] for i in shared))
    for vertex, ray in zip(skeleton.ray_vertices.tolist(), skeleton.rays.tolist(), strict=True):
        edges.add(hull_facet(P, corners[vertex].tolist(), ray, samples))
    return set(centers), edges, len(skeleton.rays)


def hull_facet(P, triangle, ray, samples):
    """The hull edge of a triangle that a ray leaves through: the one the ray is orthogonal to, outwards."""
    t = P.tessellation
    row = int(np.flatnonzero((np.sort(t.simplices, axis=1) == sorted(triangle)).all(axis=1))[0])
    best = None
    for k, neighbor in enumerate(t.neighbors[row].tolist()):
        if neighbor < 0:
            p, q = (i for j, i in enumerate(t.simplices[row].tolist()) if j != k)
            along = t.points[q] - t.points[p]
            slant = abs(along @ ray) / np.hypot(*along)
            best = min(best or (2.0, None), (slant, frozenset((samples[p], samples[q]))), key=lambda x: x[0])
    return best[1]


def check(shape):
    """Both theorems for one shape whose boundary is strictly Gabriel; AssertionError if they fail."""
    P = psl.delaunay_shape(shape)
    samples = rational(shape.points)
    segments = [(samples[a], samples[b]) for a, b in shape.facets.tolist()]
    assert all(strictly_gabriel(p, q, samples) for p, q in segments)
    for side, name in ((1, "inner"), (-1, "outer")):
        vertices, edges, touching = sk2_oracle(samples, segments, side)
        centers, dual, _ = dual_of(P, name)
        assert not touching
        assert (
            centers == vertices
        )  # Theorem 1: Sk0's vertices are in the open side; Theorem 2: they are Sk2's
        assert dual == edges
        sk2 = psl.sk2(shape, side=name)
        sk0 = psl.sk0(P, name)
        assert sk2.simplices.tolist() == sk0.simplices.tolist()
        assert sk2.edges.tolist() == sk0.edges.tolist()
        assert len(sk2.rays) == len(sk0.rays)


@pytest.mark.parametrize("batch", range(BATCHES))
def test_theorems_on_random_regions(batch):
    rng = np.random.default_rng(1997 + batch)
    holes = components = 0
    for k in range(PER_BATCH):
        shape = psl.Shape.from_rings(grid_region(rng, size=3 + (k % 5 == 0), hole=k % 4 == 0))
        b0, b1 = shape.betti()
        components += b0 > 1
        holes += b1 > 0
        check(psl.conform(shape))
    # The batch must have what the theorem is about, or it says nothing.
    assert components > 0
    assert holes > 0


def test_the_check_can_fail():
    """A boundary that is Delaunay but not Gabriel is caught."""
    shape = psl.Shape.from_rings([[(0, 0), (4, 0), (2, 1)]])
    with pytest.raises(AssertionError):
        check(shape)


def test_right_triangle_breaks_theorem_2_under_the_open_ball():
    """Its boundary is in the open-ball Gabriel graph; Sk0 is its circumcenter, which is on the boundary."""
    shape = psl.Shape.from_rings([[(0, 0), (1, 0), (0, 1)]])
    P = psl.delaunay_shape(shape)
    assert P.is_gabriel(closed=False)
    assert not P.is_gabriel(closed=True)
    samples = rational(shape.points)
    segments = [(samples[a], samples[b]) for a, b in shape.facets.tolist()]
    center = circumcenter(*samples)
    assert location(center, segments) == 0
    # The outer side: Sk2 of the closed complement holds that vertex, Sk0 of the complement is empty.
    assert len(psl.sk0(P, "outer").vertices) == 0
    assert len(psl.sk2(shape, side="outer").vertices) == 1


def test_hexagon_gains_a_segment_under_the_open_ball():
    shape = psl.Shape.from_rings([[(0, 0), (2, 0), (0, -1), (-1, 0), (0, 1), (1, 1)]])
    P = psl.delaunay_shape(shape)
    samples = rational(shape.points)
    segments = [(samples[a], samples[b]) for a, b in shape.facets.tolist()]
    assert P.is_gabriel(closed=False)
    assert not P.is_gabriel(closed=True)
    end, start = (Fraction(1), Fraction(-1, 2)), (Fraction(1), Fraction(0))
    # The segment is in the closed shape, and is a Voronoi edge piece of Sk2 but not of Sk0.
    assert location(((end[0] + start[0]) / 2, (end[1] + start[1]) / 2), segments) >= 0
    sk0, sk2 = psl.sk0(P), psl.sk2(shape)
    pieces = {frozenset(map(tuple, ends)) for ends in sk2.segments().tolist()}
    dual = {frozenset(map(tuple, ends)) for ends in sk0.segments().tolist()}
    gained = frozenset(((1.0, -0.5), (1.0, 0.0)))
    assert gained in pieces | dual
    assert pieces != dual


def test_theorem_2_is_false_in_3d():
    """All hull faces strictly Gabriel, yet an inner tetrahedron has its circumcenter outside the hull."""
    points = np.array([(-1, -1, 2), (2, 2, 2), (7, -1, 0), (-1, -3, 4), (9, -3, 5)], dtype=float)
    t = psl.delaunay(points)
    _, sides = t.facet_table
    hull = {frozenset(f) for f in t.facets()[sides[:, 1] < 0].tolist()}
    assert len(hull) == 6
    assert hull <= {frozenset(f) for f in psl.gabriel(t, closed=True).tolist()}
    row = [set(s) for s in t.simplices.tolist()].index({0, 1, 2, 3})
    assert t.circumcenters[row] == pytest.approx([17 / 5, -12 / 5, 13 / 5], abs=1e-12)
    # Outside: beyond the plane of a hull facet, exactly.
    center = [Fraction(17, 5), Fraction(-12, 5), Fraction(13, 5)]
    exact = [[Fraction(x) for x in p] for p in points.tolist()]
    assert len({sum((c - x) ** 2 for c, x in zip(center, exact[i], strict=True)) for i in range(4)}) == 1

    def volume(f, q):
        a, b, c = (exact[i] for i in f)
        u, v, w = ([x - y for x, y in zip(p, a, strict=True)] for p in (b, c, q))
        return (
            u[0] * (v[1] * w[2] - v[2] * w[1])
            - u[1] * (v[0] * w[2] - v[2] * w[0])
            + u[2] * (v[0] * w[1] - v[1] * w[0])
        )

    beyond = 0
    for facet in hull:
        f = sorted(facet)
        inner = [volume(f, exact[i]) for i in range(5) if i not in facet]
        assert all(v > 0 for v in inner) or all(v < 0 for v in inner)
        beyond += volume(f, center) * inner[0] < 0
    assert beyond == 1


def test_segment_side_sees_a_crossing():
    square = rational([(0, 0), (4, 0), (4, 4), (0, 4)])
    segments = list(zip(square, square[1:] + square[:1], strict=True))
    point = lambda x, y: (Fraction(x), Fraction(y))  # noqa: E731
    assert segment_side(point(1, 1), point(3, 3), segments) == 1
    assert segment_side(point(1, 1), point(5, 1), segments) is None
    assert segment_side(point(5, 1), point(6, 7), segments) == -1


@pytest.mark.parametrize("batch", range(4))
def test_the_condition_of_theorem_2_is_exact(batch):
    """Beyond the paper: with the boundary in Del(E), equality on both sides means strictly Gabriel."""
    rng = np.random.default_rng(batch)
    met = {True: 0, False: 0}
    for _ in range(60):
        shape = psl.conform(psl.Shape.from_rings(grid_region(rng, size=3)), to="delaunay")
        P = psl.delaunay_shape(shape)
        equal = True
        for side in ("inner", "outer"):
            a, b = psl.sk0(P, side), psl.sk2(shape, P.tessellation, side)
            pairs = zip((a.simplices, a.edges, a.rays), (b.simplices, b.edges, b.rays), strict=True)
            equal &= all(np.array_equal(x, y) for x, y in pairs)
        assert equal == P.is_gabriel()
        met[equal] += 1
    assert min(met.values()) > 0
