"""What several checks need: random regions, named counterexamples, duals by definition, exact solids."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import numpy as np
from truth import space
from truth.rational import (
    dot,
    grid_region,
    location,
    rational,
    ray_end,
    segment_side,
    strictly_gabriel,
    turn,
    voronoi_elements,
)

import polyskel_lite as psl

#: The counterexamples of the register, by name.
RIGHT_TRIANGLE = [(0, 0), (0, 1), (1, 0)]
HEXAGON = [(0, 0), (2, 0), (0, -1), (-1, 0), (0, 1), (1, 1)]
#: The same in general position: no four are cocircular.
HEPTAGON = [(1, 0), (3, 3), (0, 2), (-4, 0), (0, -1), (2, -1), (3, 0)]
EMPTY = [(0, 0), (0, 1), (1, 2)]
DISCONNECTED = [(0, 0), (0, 1), (1, 1), (0, 2), (2, 1)]
SWALLOWED = [(0, 0), (0, 3), (-3, 1), (-2, -2), (1, -2), (3, 0)]
EARS = [(5, 0), (3, 4), (-3, 4), (-5, 0), (-3, -4), (3, -4)]
NOT_CONTAINED = [[(0, 0), (10, 0), (5, 1)], [(5, -1), (4, -3), (6, -3)]]
THIN_IN_3D = [(-1, -1, 2), (2, 2, 2), (7, -1, 0), (-1, -3, 4), (9, -3, 5)]
OBTUSE_IN_3D = [(0, 0, 0), (4, 0, 0), (2, 1, 0), (2, -1, 10), (2, -1, -10)]


def ring(points) -> psl.Shape:
    return psl.Shape.from_rings([points])


@cache
def coarse_regions(count: int = 40, seed: int = 31) -> tuple[psl.Shape, ...]:
    """Random regions as they come: some with holes, some in pieces, their samples too few for anything."""
    rng = np.random.default_rng(seed)
    regions = []
    for k in range(count):
        rings = grid_region(rng, size=3 if k % 5 == 0 else 2, hole=k % 5 == 0)
        # Drawn out, so that some boundaries are not contained in the Delaunay tessellation.
        stretch = 4 if k % 3 == 1 else 1
        regions.append(psl.Shape.from_rings([[(stretch * x, y) for x, y in r] for r in rings]))
    return tuple(regions)


@cache
def gabriel_regions(count: int = 50, seed: int = 97, most: int = 40) -> tuple[psl.Shape, ...]:
    """Random regions refined until their boundary is strictly Gabriel, those with few samples."""
    rng = np.random.default_rng(seed)
    found: list[psl.Shape] = []
    while len(found) < count:
        hole, pieces = len(found) % 5 == 0, len(found) % 5 == 1
        rings = grid_region(rng, size=3 if hole or pieces else 2, fill=0.3 if pieces else 0.55, hole=hole)
        region = psl.conform(psl.Shape.from_rings(rings))
        if len(region.points) <= most:
            found.append(region)
    return tuple(found)


@cache
def exact(shape: psl.Shape):
    """Samples and boundary segments as rational numbers."""
    samples = rational(shape.points)
    return samples, [(samples[a], samples[b]) for a, b in shape.facets.tolist()]


@cache
def elements(shape: psl.Shape):
    """Voronoi vertices and edges of a shape's samples, by definition."""
    return voronoi_elements(exact(shape)[0])


@cache
def dual(shape: psl.Shape, side: int):
    """Sk0 by definition, exactly: centres of the Delaunay cells on one side, edges between neighbours.

    Cocircular samples make one cell and so one centre. Edges are named by the two samples they are
    equidistant from. The boundary must be strictly Gabriel, or a cell could be on both sides.
    """
    _, segments = exact(shape)
    boundary = {frozenset(s) for s in segments}
    vertices, edges = elements(shape)
    kept = set()
    for center, on in vertices.items():
        middle = tuple(sum(c) / len(on) for c in zip(*on, strict=True))
        if location(middle, segments) == side:
            kept.add(center)
    shared = set()
    for p, q, a, b in edges:
        if frozenset((p, q)) not in boundary and a in kept and (b in kept if b else side < 0):
            shared.add(frozenset((p, q)))
    return kept, shared


@cache
def inner_elements(shape: psl.Shape, side: int):
    """Sk2 by definition, exactly: Voronoi vertices and edges in the open side; vertices on the boundary."""
    samples, segments = exact(shape)
    vertices, edges = elements(shape)
    where = {m: location(m, segments) for m in vertices}
    kept = set()
    for p, q, a, b in edges:
        if where[a] == side and (b is not None or side < 0):
            end = ray_end(p, q, a, samples, segments) if b is None else b
            if segment_side(a, end, segments) == side:
                kept.add(frozenset((p, q)))
    touching = {m for m, place in where.items() if place == 0}
    return {m for m, place in where.items() if place == side}, kept, touching


@cache
def small_solids(stretch: int = 1, count: int = 6, n: int = 10) -> tuple[psl.Shape, ...]:
    """Random pieces of Delaunay tessellations of ten whole-number points, all of them on the boundary.

    Drawn out by ``stretch``, most of them have faces that are not Delaunay any more.
    """
    rng, found = np.random.default_rng(23), []
    while len(found) < count:
        t = psl.delaunay(rng.integers(0, 40, (n, 3)))
        try:
            shape = psl.DelaunayShape(t, rng.random(len(t.simplices)) < 0.85).to_shape()
        except psl.ShapeError:
            continue
        if len(shape.points) == n:
            found.append(psl.Shape(shape.points * [1, 1, stretch], shape.facets))
    return tuple(found)


def hull(points) -> psl.Shape:
    """The convex hull of points in space, all of them on it."""
    t = psl.delaunay(points)
    return psl.DelaunayShape(t, np.ones(len(t.simplices), dtype=bool)).to_shape()


def on_ellipsoid(n: int, axes=(2, 2, 1), seed: int = 1) -> np.ndarray:
    """Random points of an ellipsoid; that with half axes 2, 2, 1 has the disc of radius 3/2 as skeleton."""
    g = np.random.default_rng(seed).normal(size=(n, 3))
    return g / np.linalg.norm(g, axis=1)[:, None] * np.array(axes)


def in_space(shape: psl.Shape) -> space.Samples:
    """A solid's samples, faces and skeletons by definition, in rational numbers."""
    return space.samples(*(tuple(map(tuple, a.tolist())) for a in (shape.points, shape.facets)))


def named(skeleton: psl.Skeleton) -> tuple[set, set, set]:
    """Vertices, edges and polygons by the samples that they are equally far from: four, three, two."""
    names = [frozenset(s) for s in skeleton.tessellation.simplices[skeleton.simplices].tolist()]
    cells = [[[k] for k in range(len(names))], skeleton.edges.tolist(), skeleton.polygons]
    return tuple({frozenset.intersection(*(names[k] for k in cell)) for cell in kind} for kind in cells)


def open_gabriel(p, q, samples) -> bool:
    """No sample inside the open disk of diameter pq: the rule of the paper."""
    return all(dot(s, p, q) >= 0 for s in samples if s not in (p, q))


def strictly_gabriel_boundary(shape: psl.Shape) -> bool:
    samples, segments = exact(shape)
    return all(strictly_gabriel(p, q, samples) for p, q in segments)


def open_gabriel_boundary(shape: psl.Shape) -> bool:
    samples, segments = exact(shape)
    return all(open_gabriel(p, q, samples) for p, q in segments)


def touches(p, q, a, b) -> bool:
    """Whether the closed segments pq and ab have a point in common."""
    d1, d2, d3, d4 = turn(a, b, p), turn(a, b, q), turn(p, q, a), turn(p, q, b)
    if d1 * d2 < 0 and d3 * d4 < 0:
        return True
    on = ((d1, p, a, b), (d2, q, a, b), (d3, a, p, q), (d4, b, p, q))
    return any(d == 0 and dot(t, u, v) <= 0 for d, t, u, v in on)


def ellipse(n: int, start: float = 0.0) -> np.ndarray:
    """n points on the ellipse with half axes 2 and 1, whose skeleton is the segment from -3/2 to 3/2."""
    t = 2 * np.pi * (np.arange(n) + start) / n
    return np.column_stack([2 * np.cos(t), np.sin(t)])


ELLIPSE_SKELETON = np.column_stack([np.linspace(-1.5, 1.5, 3001), np.zeros(3001)])


def flower(petals: int, n: int) -> psl.Shape:
    """A smooth shape with equal protrusions."""
    t = 2 * np.pi * np.arange(n) / n
    r = 1 + 0.35 * np.cos(petals * t)
    return ring(np.column_stack([r * np.cos(t), r * np.sin(t)]))


def annulus(inner_angles, outer_angles) -> psl.Shape:
    """The polygon through samples of the ring between circles of radius 1 and 3, which is 1-regular."""
    rings = [
        radius * np.column_stack([np.cos(angles), np.sin(angles)])
        for radius, angles in ((3, np.asarray(outer_angles)), (1, np.asarray(inner_angles)))
    ]
    return psl.Shape.from_rings(rings)


def angles_with_gaps(rng, most: float) -> np.ndarray:
    """At least three angles around the circle with no gap above ``most``, irregular."""
    while True:
        gaps = rng.uniform(0.05, most, size=400)
        k = int(np.searchsorted(np.cumsum(gaps), 2 * np.pi))
        chosen = gaps[:k]
        rest = 2 * np.pi - chosen.sum()
        if k >= 2 and 0.05 < rest < most:
            return np.cumsum([rng.uniform(0, 2 * np.pi), *chosen])


def ends(skeleton: psl.Skeleton) -> int:
    """The number of vertices with one edge."""
    return int((np.bincount(skeleton.edges.ravel(), minlength=len(skeleton.vertices)) == 1).sum())


def fractions(points) -> list[tuple[Fraction, ...]]:
    return [tuple(Fraction(x) for x in p) for p in np.asarray(points, dtype=float).tolist()]


def volume(a, b, c, d):
    """Six times the signed volume of a tetrahedron."""
    u, v, w = ([x - y for x, y in zip(p, a, strict=True)] for p in (b, c, d))
    return (
        u[0] * (v[1] * w[2] - v[2] * w[1])
        - u[1] * (v[0] * w[2] - v[2] * w[0])
        + u[2] * (v[0] * w[1] - v[1] * w[0])
    )


def squared(p, q):
    return sum((x - y) ** 2 for x, y in zip(p, q, strict=True))


def face_center(a, b, c):
    """Circumcenter of a triangle in space."""
    u, v = ([x - y for x, y in zip(p, a, strict=True)] for p in (b, c))
    uu, vv = sum(x * x for x in u), sum(x * x for x in v)
    uv = sum(x * y for x, y in zip(u, v, strict=True))
    gram = 2 * (uu * vv - uv * uv)
    s, t = Fraction(vv * (uu - uv)) / gram, Fraction(uu * (vv - uv)) / gram
    return tuple(x + s * y + t * z for x, y, z in zip(a, u, v, strict=True))


def skew_lines(n: int) -> np.ndarray:
    """n points, half on one of two skew lines and half on the other: every two gaps make a tetrahedron."""
    u, zero = np.linspace(-1, 1, n // 2), np.zeros(n // 2)
    return np.concatenate([np.column_stack([u, zero, zero]), np.column_stack([zero, u, zero + 1])])
