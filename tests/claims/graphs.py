"""Section 2.2: Voronoi graph, Delaunay tessellation, Gabriel graph."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from itertools import combinations, pairwise

import numpy as np
from truth import space
from truth.rational import circumcenter, dot, rational, strictly_gabriel, turn, voronoi_elements

import polyskel_lite as psl
from polyskel_lite.figures import definitions

from .geometry import (
    OBTUSE_IN_3D,
    RIGHT_TRIANGLE,
    face_center,
    fractions,
    named,
    open_gabriel,
    skew_lines,
    squared,
)
from .pictures import dots, faces, figure_is, lines, pieces
from .registry import check, definition, seen, transcript, verdict


@cache
def integer_sets(count: int = 20, n: int = 12, dimension: int = 2, seed: int = 12) -> tuple[np.ndarray, ...]:
    """Sets of distinct whole-number points on a small lattice, so that many are cocircular."""
    rng = np.random.default_rng(seed)
    lattice = np.stack(np.meshgrid(*[np.arange(7)] * dimension), axis=-1).reshape(-1, dimension)
    return tuple(rng.permutation(lattice)[:n] for _ in range(count))


@cache
def general_sets(count: int = 3, n: int = 9) -> tuple[np.ndarray, ...]:
    """Whole-number points in space without five on a sphere."""
    rng = np.random.default_rng(14)
    return tuple(rng.integers(0, 1000, (n, 3)) for _ in range(count))


@check("def-voronoi")
def voronoi_regions():
    """Vertices, edges, rays and in space polygons of the library's graph, against the definition, exactly.

    Each vertex is nearest to the samples of its simplex and to no other one; edges have two nearest samples
    throughout, the library's are all there are, and a region ends nowhere else.
    """
    for points in integer_sets():
        t = psl.delaunay(points)
        graph, samples = psl.voronoi(t), rational(points)
        exact = [circumcenter(*(samples[k] for k in triangle)) for triangle in t.simplices.tolist()]
        for triangle, m, center in zip(t.simplices.tolist(), exact, graph.vertices, strict=True):
            nearest = min(squared(m, s) for s in samples)
            if any(squared(m, samples[k]) != nearest for k in triangle):
                return definition(False)
            if np.abs(center - np.array(m, dtype=float)).max() > 1e-9:
                return definition(False)
        edges = voronoi_elements(samples)[1]
        bounded = {frozenset((a, b)) for _, _, a, b in edges if b is not None}
        # Between cocircular samples the library has edges without a length.
        found = {frozenset((exact[a], exact[b])) for a, b in graph.edges.tolist() if exact[a] != exact[b]}
        unbounded = sorted(a for _, _, a, b in edges if b is None)
        if found != bounded or sorted(exact[k] for k in graph.ray_vertices.tolist()) != unbounded:
            return definition(False)
    return definition(all(map(_voronoi_in_space, general_sets())))


def _voronoi_in_space(points) -> bool:
    """The library's elements are those of the spheres with no sample inside; polygons go around in order."""
    spheres = space.empty_spheres(fractions(points))
    shared, rings = space.sides(spheres), space.rings(spheres)
    graph = psl.voronoi(points)
    expected = set(spheres), {f for f, both in shared.items() if len(both) == 2}, set(rings)
    names = [frozenset(s) for s in graph.tessellation.simplices[graph.simplices].tolist()]
    exact = np.array([[float(x) for x in spheres[name]] for name in names])
    walks = [rings[frozenset.intersection(*(names[k] for k in p))] for p in graph.polygons]
    for polygon, walk in zip(graph.polygons, walks, strict=True):
        steps = {frozenset(pair) for pair in zip(walk, walk[1:] + walk[:1], strict=True)}
        mine = [names[k] for k in polygon]
        if {frozenset(pair) for pair in zip(mine, mine[1:] + mine[:1], strict=True)} != steps:
            return False
    hull = sum(len(both) == 1 for both in shared.values())
    near = np.abs(graph.vertices - exact).max() < 1e-9 * np.abs(exact).max()
    return named(graph) == expected and bool(near) and len(graph.rays) == hull


@check("voronoi-convex")
def regions_are_convex():
    """The middle of two points of a region is in the region, in whole numbers, in the plane and in space.

    And of two Voronoi vertices of the library around one sample, up to rounding.
    """
    rng = np.random.default_rng(3)
    for dimension in (2, 3):
        for points in integer_sets(8, dimension=dimension):
            m = rng.integers(-20, 28, (400, dimension))
            owner = ((2 * m[:, None] - 2 * points) ** 2).sum(axis=2)
            region = owner == owner.min(axis=1, keepdims=True)
            for k in range(len(points)):
                inside = m[region[:, k]]
                pairs = rng.integers(0, max(len(inside), 1), (100, 2)) if len(inside) else []
                for i, j in pairs:
                    middle = inside[i] + inside[j]
                    distance = ((middle - 2 * points) ** 2).sum(axis=1)
                    if distance[k] > distance.min():
                        return verdict(False)
            if not _regions_of_the_library(points):
                return verdict(False)
    return verdict(True)


def _regions_of_the_library(points) -> bool:
    graph = psl.voronoi(points)
    corners = graph.tessellation.simplices[graph.simplices]
    for k in range(len(points)):
        own = graph.vertices[(corners == k).any(axis=1)]
        middles = (own[:, None] + own).reshape(-1, points.shape[1]) / 2
        distance = np.linalg.norm(middles[:, None] - points, axis=2)
        if (distance[:, k] > distance.min(axis=1) * (1 + 1e-9)).any():
            return False
    return True


@check("def-delaunay")
def empty_balls():
    """No sample inside any circumscribed ball, in whole numbers, in the plane and in space."""
    good = True
    for dimension in (2, 3):
        for points in integer_sets(10, dimension=dimension):
            t = psl.delaunay(points)
            for corners in t.simplices.tolist():
                base = points[corners[0]].tolist()
                rows = [[x - y for x, y in zip(points[k].tolist(), base, strict=True)] for k in corners[1:]]
                center = _solve(rows, [Fraction(sum(x * x for x in r), 2) for r in rows])
                radius = sum(x * x for x in center)
                seen = [[x - y for x, y in zip(p, base, strict=True)] for p in points.tolist()]
                good &= all(squared(p, center) >= radius for p in seen)
    return definition(good)


def _solve(rows, right):
    """Cramer's rule for two or three equations."""

    def det(m):
        if len(m) == 2:
            return m[0][0] * m[1][1] - m[0][1] * m[1][0]
        return sum((-1) ** j * m[0][j] * det([r[:j] + r[j + 1 :] for r in m[1:]]) for j in range(3))

    whole = det(rows)
    return [
        Fraction(det([[*r[:j], b, *r[j + 1 :]] for r, b in zip(rows, right, strict=True)])) / whole
        for j in range(len(rows))
    ]


@check("delaunay-dual")
def duality():
    """Voronoi vertices are simplices, edges inner facets, rays hull facets; the simplices fill the hull."""
    for points in integer_sets():
        t = psl.delaunay(points)
        graph = psl.voronoi(t)
        sides = t.facet_table[1]
        if len(graph.vertices) != len(t.simplices) or len(graph.edges) != (sides[:, 1] >= 0).sum():
            return verdict(False)
        corners = points[t.simplices].tolist()
        twice = sum(_twice_area(c) for c in corners)
        if len(graph.rays) != (sides[:, 1] < 0).sum() or twice != _twice_hull_area(points.tolist()):
            return verdict(False)
        finite = {frozenset((p, q)) for p, q, _, _ in voronoi_elements(rational(points))[1]}
        edges = {frozenset(rational(points[pair])) for pair in t.edges()}
        if not finite <= edges:
            return verdict(False)
    return verdict(all(map(_dual_in_space, integer_sets(8, dimension=3))))


def _dual_in_space(points) -> bool:
    """Volumes add up to that of the hull, measured from its middle; each element has its dual."""
    t = psl.delaunay(points)
    graph, (facets, sides) = psl.voronoi(t), t.facet_table
    corners = fractions(points)
    whole = sum(abs(space.volume(*(corners[k] for k in s))) for s in t.simplices.tolist())
    middle = tuple(sum(x) / len(corners) for x in zip(*corners, strict=True))
    open_ = [f for f, s in zip(facets.tolist(), sides.tolist(), strict=True) if s[1] < 0]
    for f in open_:  # all samples are on one side of it
        signs = {space.sign(space.volume(*(corners[k] for k in f), p)) for p in corners}
        if {1, -1} <= signs:
            return False
    hull = sum(abs(space.volume(*(corners[k] for k in f), middle)) for f in open_)
    on_hull = {frozenset(pair) for f in open_ for pair in combinations(f, 2)}
    inner_edges = len(t.edges()) - len(on_hull)
    counts = len(graph.vertices), len(graph.edges), len(graph.rays), len(graph.polygons)
    expected = len(t.simplices), len(facets) - len(open_), len(open_), inner_edges
    return whole == hull and counts == expected


def _twice_area(c):
    return (c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) - (c[1][1] - c[0][1]) * (c[2][0] - c[0][0])


def _twice_hull_area(points):
    """Twice the area of the convex hull, by Andrew's monotone chain."""

    def chain(points):
        out = []
        for p in points:
            while len(out) > 1 and turn(out[-2], out[-1], p) <= 0:
                out.pop()
            out.append(p)
        return out[:-1]

    points = sorted(points)
    hull = chain(points) + chain(points[::-1])
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(hull, hull[1:] + hull[:1], strict=True))


@check("general-position")
def general_position():
    """Without four cocircular samples every Voronoi vertex has three; a square has one vertex with four.

    In space the spheres through four samples with none inside are the library's tetrahedra, one each.
    """
    rng = np.random.default_rng(8)
    simple = True
    for _ in range(6):
        points = rng.integers(0, 10**6, (14, 2))
        vertices, _ = voronoi_elements(rational(points))
        simple &= all(len(on) == 3 for on in vertices.values())
        simple &= len(psl.delaunay(points).simplices) == len(vertices)
    square, _ = voronoi_elements(rational([(0, 0), (1, 0), (1, 1), (0, 1)]))
    assert [len(on) for on in square.values()] == [4]
    for points in general_sets():
        tetrahedra = {frozenset(s) for s in psl.delaunay(points).simplices.tolist()}
        simple &= tetrahedra == set(space.empty_spheres(fractions(points)))
    return verdict(simple)


@check("voronoi-cost")
def cost_of_the_graph():
    """Points on two skew lines have (n/2 - 1)² Voronoi vertices: more than any multiple of n log n + n."""
    counts = {n: len(psl.delaunay(skew_lines(n)).simplices) for n in (20, 40, 80)}
    assert counts == {n: (n // 2 - 1) ** 2 for n in counts}
    per_floor = [count / (n * np.log(n) + n) for n, count in counts.items()]
    per_ceiling = [count / (n * np.log(n) + n**2) for n, count in counts.items()]
    # A bound holds if the quotient stays; doubling n must not raise it by more than a quarter.
    grows = all(b > 1.25 * a for a, b in pairwise(per_floor))
    stays = max(per_ceiling) < 0.25
    return transcript(stands=not grows, other=stays)


@check("def-gabriel")
def gabriel_graph():
    """Against all pairs, exactly: the strict rule of this book, and the paper's, which differs."""
    for points in integer_sets():
        samples = rational(points)
        brute = {
            frozenset((i, j))
            for i, j in combinations(range(len(points)), 2)
            if strictly_gabriel(samples[i], samples[j], samples)
        }
        if {frozenset(pair) for pair in psl.gabriel(points).tolist()} != brute:
            return definition(False)
    closed, printed = psl.gabriel(RIGHT_TRIANGLE), psl.gabriel(RIGHT_TRIANGLE, closed=False)
    return definition((len(closed), len(printed)) == (2, 3) and _gabriel_in_space())


def _gabriel_in_space() -> bool:
    points = np.random.default_rng(2).integers(0, 50, (12, 3))
    corners = fractions(points)
    brute = set()
    for face in combinations(range(12), 3):
        a, b, c = (corners[k] for k in face)
        m = face_center(a, b, c)
        if all(squared(m, corners[k]) > squared(m, a) for k in range(12) if k not in face):
            brute.add(frozenset(face))
    return {frozenset(face) for face in psl.gabriel(points).tolist()} == brute


@check("gabriel-in-delaunay")
def gabriel_in_delaunay():
    """Strict Gabriel facets are Delaunay facets; by the paper's rule both diagonals of a square are Gabriel.

    Of all pairs, and in space all triples, that are Gabriel by definition none is missing in the library.
    """
    strict = True
    for points in integer_sets():
        samples = rational(points)
        pairs = combinations(range(len(points)), 2)
        brute = {(i, j) for i, j in pairs if strictly_gabriel(samples[i], samples[j], samples)}
        strict &= brute <= {tuple(sorted(e)) for e in psl.delaunay(points).edges().tolist()}
    for points in general_sets():
        samples, triples = fractions(points), combinations(range(len(points)), 3)
        brute = {f for f in triples if space.strictly_gabriel(*(samples[k] for k in f), samples)}
        strict &= bool(brute) and brute <= {tuple(sorted(f)) for f in psl.delaunay(points).facets().tolist()}
    for samples in map(rational, integer_sets()):
        delaunay = {frozenset((p, q)) for p, q, _, _ in voronoi_elements(samples)[1]}
        pairs = [pair for pair in combinations(samples, 2) if strictly_gabriel(*pair, samples)]
        strict &= set(map(frozenset, pairs)) <= delaunay
    a, b, c, d = rational([(0, 0), (1, 0), (1, 1), (0, 1)])
    crossing = open_gabriel(a, c, [a, b, c, d]) and open_gabriel(b, d, [a, b, c, d])
    return verdict(stands=not crossing, repaired=strict)


@check("gabriel-by-voronoi-2d")
def gabriel_by_voronoi():
    """An edge meets its dual exactly if its open disk is empty, and crosses it if the closed one is.

    The library's Gabriel graphs are the Delaunay edges that do.
    """
    for points in integer_sets():
        samples = rational(points)
        crossing, meeting = set(), set()
        for p, q, a, b in voronoi_elements(samples)[1]:
            middle = ((p[0] + q[0]) / 2, (p[1] + q[1]) / 2)
            if b is None:
                away = (q[1] - p[1], p[0] - q[0])
                if any(turn(p, q, s) < 0 for s in samples):
                    away = (-away[0], -away[1])
                position = (middle[0] - a[0]) * away[0] + (middle[1] - a[1]) * away[1]
                meets, crosses = position >= 0, position > 0
            else:
                meets, crosses = dot(middle, a, b) <= 0, dot(middle, a, b) < 0
            if meets != open_gabriel(p, q, samples) or crosses != strictly_gabriel(p, q, samples):
                return verdict(False)
            crossing |= {frozenset((p, q))} if crosses else set()
            meeting |= {frozenset((p, q))} if meets else set()
        t = psl.delaunay(points)
        delaunay, strict, printed = (
            {frozenset(samples[k] for k in pair) for pair in edges.tolist()}
            for edges in (t.edges(), psl.gabriel(t), psl.gabriel(t, closed=False))
        )
        # Delaunay edges whose dual has no length, of cocircular samples, are in no list of Voronoi edges.
        duals = {frozenset((p, q)) for p, q, _, _ in voronoi_elements(samples)[1]}
        if strict != crossing or printed & duals != meeting & delaunay:
            return verdict(False)
    return verdict(True)


@check("gabriel-by-voronoi-3d")
def gabriel_by_voronoi_in_space():
    """An obtuse face that is strictly Gabriel, and whose dual Voronoi edge passes outside it."""
    points = fractions(OBTUSE_IN_3D)
    face, others = points[:3], points[3:]
    center = face_center(*face)
    gabriel = all(squared(center, s) > squared(center, face[0]) for s in others)
    assert [0, 1, 2] in psl.gabriel(OBTUSE_IN_3D).tolist()
    # The dual edge joins the centres of the two tetrahedra at the face; it meets their plane at its centre.
    t = psl.delaunay(OBTUSE_IN_3D)
    tetrahedra = [set(s) for s in t.simplices.tolist()]
    above, below = (t.circumcenters[tetrahedra.index({0, 1, 2, k})] for k in (3, 4))
    assert above[2] * below[2] < 0
    assert np.allclose([above[:2], below[:2]], np.array(center[:2], dtype=float), atol=1e-12)
    a, b, c, m = (p[:2] for p in (*face, center))  # all in the plane z = 0
    meets = len({turn(a, b, m), turn(b, c, m), turn(c, a, m)}) == 1
    return verdict(stands=gabriel == meets)


@check("transcript-n-face")
def face_dimension():
    """The facets of the Gabriel graph have N points, so they are (N-1)-faces: segments, triangles."""
    corners = {2: psl.gabriel(integer_sets()[0]).shape[1], 3: psl.gabriel(OBTUSE_IN_3D).shape[1]}
    return transcript(
        stands=all(k == n + 1 for n, k in corners.items()), other=all(k == n for n, k in corners.items())
    )


@check("fig-2")
def figures():
    """Each graph is drawn whole, over its samples; in space the region of a point, tetrahedra, triangles."""
    return seen(figure_is("figure_2", 3, _three_graphs) and figure_is("figure_2_3d", 3, _three_in_space))


def _three_graphs(figure, panels) -> bool:
    points = definitions.POINTS_2D
    t = psl.delaunay(points)
    voronoi = psl.voronoi(t).segments()
    low, high = points.min(axis=0), points.max(axis=0)
    whole = ((voronoi > low) & (voronoi < high)).all(axis=(1, 2))  # the others are cut at the frame
    shown = (
        pieces(voronoi[whole]),
        pieces(points[t.edges()]),
        pieces(points[psl.gabriel(points)]),
    )
    sampled = all({*map(tuple, points.tolist())} <= {*map(tuple, dots(ax).tolist())} for ax in panels)
    return sampled and all(graph and graph <= lines(ax) for graph, ax in zip(shown, panels, strict=True))


def _three_in_space(figure, panels) -> bool:
    t = psl.delaunay(definitions.POINTS_3D)
    region = sum(0 in pair for pair in named(psl.voronoi(t))[2])
    counts = region, 4 * len(t.simplices), len(psl.gabriel(t))
    return all(count in faces(ax) for count, ax in zip(counts, panels, strict=True))
