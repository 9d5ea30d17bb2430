"""Appendix B: the steps of the proof of Theorem 1."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

import numpy as np
from truth.rational import circumcenter, dot, location, segment_side, turn, voronoi_elements

import polyskel_lite as psl
from polyskel_lite.figures import proof as figures

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
from .pictures import dots, figure_is, lines, pieces
from .registry import check, seen, verdict


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
    """m = v is not covered: by the paper's rule v can be on the boundary, by the strict rule it never is.

    Then the library finds it on both closed sides; else each vertex on one of them.
    """
    corner = ring(RIGHT_TRIANGLE)
    samples, segments = exact(corner)
    on_boundary = open_gabriel_boundary(corner) and location(circumcenter(*samples), segments) == 0
    strict = all(location(v, exact(shape)[1]) != 0 for shape in gabriel_regions() for v in elements(shape)[0])
    assert _on_both_sides(corner) == 1
    strict &= not any(map(_on_both_sides, gabriel_regions()))
    return verdict(stands=not on_boundary, repaired=strict)


def _on_both_sides(shape: psl.Shape) -> int:
    """How many Voronoi vertices are in Sk1 of the shape and of its complement; none is in neither."""
    sides = [set(psl.sk1(shape, side=side).simplices.tolist()) for side in ("inner", "outer")]
    assert len(sides[0] | sides[1]) == len(psl.delaunay(shape.points).simplices)
    return len(sides[0] & sides[1])


@check("proof-quadrilateral")
def the_quadrilateral():
    """Its four sides meet the boundary in a and b only; its points, and the edge vv', are inside.

    The library has each such edge in its Sk2.
    """
    tested = 0
    weights = [w for w in combinations((Fraction(k, 9) for k in range(1, 9, 2)), 2) if sum(w) < 1]
    for shape in gabriel_regions()[:15]:
        _, segments = exact(shape)
        _, shared = dual(shape, 1)
        samples, second = exact(shape)[0], psl.sk2(shape)
        corners = second.tessellation.simplices[second.simplices].tolist()
        edges = [set(corners[i]) & set(corners[j]) for i, j in second.edges.tolist()]
        if not shared <= {frozenset(samples[k] for k in edge) for edge in edges}:
            return verdict(False)
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
    return seen(figure_is("figure_13", 2, _path_and_quadrilateral))


def _path_and_quadrilateral(figure, panels) -> bool:
    """(a): Voronoi vertex v of an obtuse triangle, and its path to a. (b): the edge vv' and its samples."""
    t = psl.delaunay(figures.POINTS_A)
    v = t.circumcenters[[set(s) == {0, 1, 2} for s in t.simplices.tolist()].index(True)]
    a, b, c = figures.POINTS_A[:3].tolist()
    beyond = turn(b, c, a) * turn(b, c, v.tolist()) < 0
    path = pieces([[v, a]]) <= lines(panels[0]) and np.abs(dots(panels[0]) - v).max(axis=1).min() < 1e-9
    u = psl.delaunay(figures.POINTS_B)
    ends = [u.circumcenters[k] for k, s in enumerate(u.simplices.tolist()) if {0, 1} <= set(s)]
    edge = pieces([ends, figures.POINTS_B[:2]]) <= lines(panels[1])
    return bool(beyond and path and edge and len(ends) == 2)
