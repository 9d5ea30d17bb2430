"""Appendix B: the steps of the proof of Theorem 1."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

from truth.rational import circumcenter, dot, location, segment_side, turn, voronoi_elements

from .geometry import (
    RIGHT_TRIANGLE,
    dual,
    elements,
    exact,
    gabriel_regions,
    open_gabriel_boundary,
    ring,
    touches,
)
from .graphs import integer_sets, rational
from .registry import check, drawn, verdict


def obtuse_triangles(vertices):
    """Delaunay triangles whose Voronoi vertex v is across the side bc from a: pairs (a, v, b, c)."""
    for v, on in vertices.items():
        if len(on) != 3:
            continue
        for a in on:
            b, c = (p for p in on if p != a)
            if turn(b, c, a) * turn(b, c, v) < 0:
                yield a, v, b, c


@check("proof-path")
def path_from_vertex_to_triangle():
    """No boundary edge meets ]va[ or v; and an edge that does cross ]va[ has a inside its open disk."""
    paths = crossings = 0
    for shape in gabriel_regions():
        _, segments = exact(shape)
        for a, v, _, _ in obtuse_triangles(elements(shape)[0]):
            paths += 1
            for p, q in segments:
                if a not in (p, q):
                    blocked = touches(v, a, p, q)
                else:
                    other = q if p == a else p
                    blocked = turn(v, a, other) == 0 and dot(a, v, other) > 0
                if blocked:
                    return verdict(False)
    for points in integer_sets():
        samples = rational(points)
        vertices, edges = voronoi_elements(samples)
        for a, v, _, _ in obtuse_triangles(vertices):
            for p, q, _, _ in edges:
                if turn(p, q, a) * turn(p, q, v) < 0 and turn(a, v, p) * turn(a, v, q) < 0:
                    crossings += 1
                    if dot(a, p, q) >= 0:
                        return verdict(False)
    return verdict(paths > 50 < crossings)


@check("proof-gap")
def the_point_left_out():
    """m = v is not covered: by the printed rule v can be on the boundary, by the strict rule it never is."""
    corner = ring(RIGHT_TRIANGLE)
    samples, segments = exact(corner)
    on_boundary = open_gabriel_boundary(corner) and location(circumcenter(*samples), segments) == 0
    strict = all(location(v, exact(shape)[1]) != 0 for shape in gabriel_regions() for v in elements(shape)[0])
    return verdict(stands=not on_boundary, repaired=strict)


@check("proof-quadrilateral")
def the_quadrilateral():
    """Its four sides meet the boundary in a and b only; its points, and the edge vv', are inside."""
    tested = 0
    weights = [w for w in combinations((Fraction(k, 9) for k in range(1, 9, 2)), 2) if sum(w) < 1]
    for shape in gabriel_regions()[:15]:
        _, segments = exact(shape)
        _, shared = dual(shape, 1)
        for a, b, v, w in elements(shape)[1]:
            if frozenset((a, b)) not in shared:
                continue
            for sample in (a, b):
                for vertex in (v, w):
                    free = [s for s in segments if sample not in s]
                    if any(touches(sample, vertex, p, q) for p, q in free):
                        return verdict(False)
            points = [
                tuple(s * x + t * y + (1 - s - t) * z for x, y, z in zip(v, w, sample, strict=True))
                for sample in (a, b)
                for s, t in weights
            ]
            tested += len(points)
            if segment_side(v, w, segments) != 1 or any(location(m, segments) != 1 for m in points):
                return verdict(False)
    return verdict(tested > 300)


@check("fig-13")
def figure():
    return drawn("figure_13", 2)
