"""Section 3.2: the second method, and its reading as the skeleton of a polyball."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
from matplotlib.collections import PatchCollection
from truth.complexes import distance_to_complex
from truth.medial import Union
from truth.polyballs import random_polyball

import polyskel_lite as psl
from polyskel_lite import implicit
from polyskel_lite.figures import regular_shape
from polyskel_lite.figures.solids import orange

from .geometry import (
    ELLIPSE_SKELETON,
    SWALLOWED,
    ellipse,
    exact,
    hull,
    in_space,
    on_ellipsoid,
    ring,
    small_solids,
    strictly_gabriel_boundary,
)
from .introduction import L_SHAPE, _sites
from .methods import dense_ellipse
from .pictures import default, dots, figure_is, lines, pieces
from .registry import check, definition, seen, verdict


@cache
def skeleton_of_ellipse(n: int, start: float = 0.3) -> psl.Skeleton:
    return psl.sk2(dense_ellipse(), ellipse(n, start))


@check("voronoi-elements")
def kinds_of_elements():
    """Edges are orthogonal to their Delaunay facet, polygons flat, convex and orthogonal to their edge.

    Of random points, and of Sk2: of an L in the plane, which has edges and no polygon, and of a solid.
    """
    rng = np.random.default_rng(7)
    solid_ = psl.sk2(hull(on_ellipsoid(120)))
    plane = psl.sk2(ring(L_SHAPE), ring(L_SHAPE).sample(60))
    graphs = [psl.voronoi(rng.random((40, 2))), psl.voronoi(rng.random((40, 3))), plane, solid_]
    if not all(map(_straight_and_flat, graphs)):
        return verdict(False)
    some = [(len(g.edges) > 20, len(g.polygons) > 20) for g in graphs]
    return verdict(some == [(True, False), (True, True), (True, False), (True, True)])


def _straight_and_flat(graph: psl.Skeleton) -> bool:
    t, bends = graph.tessellation, [0.0]
    names = [set(s) for s in t.simplices[graph.simplices].tolist()]
    for a, b in graph.edges.tolist():
        facet = t.points[sorted(names[a] & names[b])]
        way = graph.vertices[b] - graph.vertices[a]
        sides = facet[1:] - facet[0]
        # Vertices of thin simplices are far away and known to fewer digits.
        scale = np.linalg.norm(sides, axis=1) * np.abs(graph.vertices[[a, b]]).max()
        bends.append(np.abs(sides @ way / scale).max())
        if len(facet) != t.dimension:
            return False
    for polygon in graph.polygons:
        p, q = t.points[sorted(set.intersection(*(names[k] for k in polygon)))]
        corners, normal = graph.vertices[polygon], (q - p) / np.linalg.norm(q - p)
        size = np.abs(corners).max()
        bends.append(np.abs((corners - corners[0]) @ normal).max() / size)
        sides = np.roll(corners, -1, axis=0) - corners
        turns = np.cross(sides, np.roll(sides, -1, axis=0)) @ normal
        bends.append(min(np.maximum(turns, 0).max(), np.maximum(-turns, 0).max()) / size**2)
    return max(bends) < 1e-9


@check("sk2-converges")
def second_method_converges():
    """Ellipse 2 : 1: the distance falls like 1/n², down to the step of the measurement."""
    distances = [
        psl.hausdorff(skeleton_of_ellipse(n), ELLIPSE_SKELETON, step=5e-4) for n in (10, 20, 40, 80, 160)
    ]
    falls = all(b < 0.5 * a for a, b in pairwise(distances))
    return verdict(falls and distances[-1] < 2e-3)


@check("def-yw")
def union_of_inner_balls():
    """Y_w has one ball per Voronoi vertex in X, through its three samples, with no sample inside."""
    horse = psl.datasets.load("horse")
    E = horse.sample(96, start=0.7)
    Y, t = psl.sk2(horse, E).balls(), psl.delaunay(E)
    inside = horse.contains(t.circumcenters)
    distance = np.linalg.norm(Y.centers[:, None] - E, axis=2)
    on = np.sort(np.abs(distance - Y.radii[:, None]), axis=1)[:, :3].max()
    empty = (distance - Y.radii[:, None]).min()
    plane = len(Y) == inside.sum() and on < 1e-9 and empty > -1e-9
    same = np.array_equal(psl.delaunay_balls(horse, E).centers, Y.centers)
    return definition(bool(plane and same) and all(map(_balls_in_space, (*small_solids(), *small_solids(3)))))


def _balls_in_space(shape: psl.Shape) -> bool:
    """In rational numbers: one ball for each centre in the solid, as large as the distance to its samples."""
    X, Y = in_space(shape), psl.delaunay_balls(shape)
    inner = sorted(X.sk1(), key=sorted)
    centers = np.array([[float(x) for x in X.centers[four]] for four in inner])
    radii = np.linalg.norm(centers - shape.points[[min(four) for four in inner]], axis=1)
    mine, expected = np.column_stack([Y.centers, Y.radii]), np.column_stack([centers, radii])
    far = np.abs(mine[:, None] - expected).max(axis=2)
    return len(mine) == len(expected) and max(far.min(axis=0).max(), far.min(axis=1).max()) < 1e-9


@check("sk2-polyball")
def second_method_is_not_the_skeleton():
    """A strictly Gabriel hexagon whose reflex sample is inside Y_w: the exact skeleton of Y_w is another set.

    Under the five conditions they are equal in the plane. In space three tetrahedra fulfil them all, and
    Sk2 is two sides of the triangle that is the skeleton of their balls.
    """
    shape = ring(SWALLOWED)
    assert strictly_gabriel_boundary(shape)
    assert exact(shape)[0].index((0, 0)) == 0
    found, second, Y = psl.sk2_conditions(shape), psl.sk2(shape), psl.delaunay_balls(shape)
    assert found.swallowed.tolist() == [0]
    assert abs(Y.boundary_distance([(0, 0)])[0] - 1) < 1e-12
    assert np.allclose(found.extra, [(3 / 5, 4 / 5)], atol=1e-12)
    differs = psl.hausdorff(second, Y.skeleton()) > 0.5
    for name in ("horse", "gear", "lake"):
        outline = psl.conform(psl.datasets.load(name), to="gabriel")
        assert all(psl.sk2_conditions(outline).hold.values())
        assert psl.hausdorff(psl.sk2(outline), psl.delaunay_balls(outline).skeleton()) < 1e-12
    slices = orange(3, of=6).to_shape()
    assert all(psl.sk2_conditions(slices).hold.values())
    assert not len(psl.sk2(slices).polygons)
    assert len(psl.delaunay_balls(slices).skeleton().polygons) == 1
    return verdict(stands=not (differs and _fits_into_a_larger_ball(Y, second, shape)))


def _fits_into_a_larger_ball(Y: psl.Polyball, second: psl.Skeleton, shape: psl.Shape) -> bool:
    """Whether the largest ball in Y around the middle of each edge of Sk2 fits into a larger one."""
    for a, b in second.edges:
        m = (second.vertices[a] + second.vertices[b]) / 2
        distance = np.linalg.norm(shape.points - m, axis=1)
        first, other = np.argsort(distance)[:2]
        assert 0 in (first, other)  # every edge of this Sk2 is equidistant from the reflex sample
        contact = shape.points[other if first == 0 else first]
        away, radius = (m - contact) / distance[first], distance[first]
        grown = Y.boundary_distance([m + 0.05 * away])[0] >= radius + 0.05 - 1e-9
        if not (grown and Y.contains([m + 0.05 * away])[0]):
            return False
    return True


@check("polyball-approximates")
def polyball_comes_near():
    """Ellipse: the farthest point of ∂Y_w from ∂X, and the other way round, falls like 1/n²."""
    X, distances = dense_ellipse(), []
    for n in (10, 20, 40, 80):
        Y = skeleton_of_ellipse(n).balls()
        arcs = zip(*Y.arcs(), strict=True)
        points = [
            Y.centers[k] + Y.radii[k] * np.array([np.cos(u), np.sin(u)])
            for k, first, last in arcs
            for u in np.linspace(first, last, 9)
        ]
        there, back = X.boundary_distance(np.array(points)).max(), Y.boundary_distance(ellipse(500)).max()
        distances.append(max(there, back))
    plane = all(b < 0.5 * a for a, b in pairwise(distances))
    return verdict(plane and _comes_near_in_space())


def _comes_near_in_space() -> bool:
    """Torus: points of ∂X come nearer to ∂Y_w with more samples, and Y_w reaches less and less beyond X."""
    field, u = implicit.torus(), np.random.default_rng(3).uniform(0, 2 * np.pi, (400, 2))
    across = 1 + 0.4 * np.cos(u[:, 1])
    points = np.column_stack([across * np.cos(u[:, 0]), across * np.sin(u[:, 0]), 0.4 * np.sin(u[:, 1])])
    there, beyond = [], []
    for n in (100, 400):
        Y = psl.sk2(implicit.solid(field, n)).balls()
        there.append(Y.boundary_distance(points).max())
        beyond.append((field(Y.centers) + Y.radii).max())  # the field is the distance to the torus
    return there[1] < 0.7 * there[0] and beyond[1] < 0.7 * beyond[0]


def _polyball(seed: int = 3) -> psl.Polyball:
    rng = np.random.default_rng(seed)
    return psl.Polyball(rng.uniform(-1.5, 1.5, (6, 2)), rng.uniform(0.7, 1.1, 6))


def _grows(Y: psl.Polyball, m: np.ndarray, t: float = 1e-4) -> bool:
    """Whether the largest ball in Y around m fits into a larger one whose centre is t away."""
    radius = Y.boundary_distance([m])[0]
    u = np.linspace(0, 2 * np.pi, 721)[:-1]
    around = m + t * np.column_stack([np.cos(u), np.sin(u)])
    # A ball that grows by t and moves by t still holds the old one.
    return bool((Y.boundary_distance(around) >= radius + t * (1 - 2e-5)).any())


@check("polyball-skeleton-simple")
def pieces_of_a_polyball_skeleton():
    """Balls around equidistant points of two singular points are maximal, others are not: straight pieces.

    Of a single disc a point is left, a segment of no length.
    """
    rng = np.random.default_rng(9)
    maximal, others = 0, 0
    for seed in range(4):
        Y = _polyball(seed)
        S = Y.singular_points()
        for i in range(len(S)):
            for j in range(i):
                middle, along = (S[i] + S[j]) / 2, (S[i] - S[j])[::-1] * [1, -1]
                for s in rng.uniform(-1.5, 1.5, 6):
                    m = middle + s * along
                    near = np.linalg.norm(S - m, axis=1).min()
                    nearest = abs(np.linalg.norm(S[i] - m) - near) < 1e-9 and near > 1e-3
                    if nearest and Y.contains([m])[0] and abs(Y.boundary_distance([m])[0] - near) < 1e-9:
                        maximal += 1
                        if _grows(Y, m):
                            return verdict(False)
        for m in rng.uniform(-2, 2, (40, 2)):
            distance = np.sort(np.linalg.norm(S - m, axis=1))
            centered = np.linalg.norm(Y.centers - m, axis=1).min() < 0.02
            if Y.contains([m])[0] and distance[1] - distance[0] > 0.02 and not centered:
                others += 1
                if not _grows(Y, m):
                    return verdict(False)
    assert maximal > 10 < others
    disc = psl.Polyball([(0, 0)], [1])
    only_center = not _grows(disc, np.zeros(2)) and _grows(disc, np.array([0.3, 0.1]))
    return verdict(only_center and _flat_convex_polygons())


def _flat_convex_polygons() -> bool:
    """In space: whether skeletons of random polyballs are made of segments and flat convex polygons."""
    seen = 0
    for number in range(20):
        _, centers, radii = random_polyball(number, 3)
        skeleton = psl.Polyball(centers, radii).skeleton()
        m, _, error = Union(centers, radii).medial_points(np.random.default_rng(number))
        size = np.ptp(centers, axis=0).max() + radii.max()
        away = distance_to_complex(m, skeleton.vertices, skeleton.edges, skeleton.polygons)
        if (away > 1e-8 * size + 10 * error)[error < 1e-6 * size].any():
            return False
        for polygon in skeleton.polygons:
            p = skeleton.vertices[polygon]
            side = np.roll(p, -1, axis=0) - p
            turns = np.cross(side, np.roll(side, -1, axis=0))
            normal = turns.sum(axis=0) / np.linalg.norm(turns.sum(axis=0))
            if np.abs((p - p[0]) @ normal).max() > 1e-8 * size or (turns @ normal).min() < -1e-8 * size**2:
                return False
            seen += 1
    return seen > 50


@check("fig-4")
def figure():
    return seen(figure_is("figure_4", 4, _two_samplings))


def _two_samplings(figure, panels) -> bool:
    """Above, balls through the samples that are drawn there; below, Voronoi edges of both sets of samples."""
    above, below = panels[:2], panels[2:]
    samplings = [np.unique(dots(ax), axis=0) for ax in above]
    graphs = [pieces(psl.voronoi(E).segments()) for E in samplings]
    differ = len(samplings[0]) == len(samplings[1]) and not np.array_equal(*samplings)
    skeletons = all(lines(ax) <= graphs[0] | graphs[1] for ax in below)
    own = all(len(lines(ax) & graph) > 10 for ax, graph in zip(below, graphs, strict=True))
    balls = [
        sum(len(c.get_paths()) for c in ax.collections if isinstance(c, PatchCollection)) for ax in above
    ]
    return differ and skeletons and own and min(balls) > 10


@check("sampling-stable")
def samples_shifted():
    """Ellipse, samples moved along by half a step: far apart with 10 samples, nearer and nearer with more."""
    shifts = [
        psl.hausdorff(skeleton_of_ellipse(n, 0.0), skeleton_of_ellipse(n, 0.5), step=1e-3)
        for n in (10, 20, 40)
    ]
    balls = skeleton_of_ellipse(20, 0.0).balls().boundary_distance(ellipse(20, 0.5)).max()
    dense = shifts[-1] < 0.02 and all(b < 0.5 * a for a, b in pairwise(shifts))
    assert balls > 1e-3  # the two polyballs do differ
    return verdict(stands=shifts[0] < 0.05, repaired=dense)


@check("polygon-skeleton-branches")
def polygon_skeleton_has_branches():
    """Convex corners: points on the bisector have both sides as nearest sites, down to the corner itself.

    So the skeleton of P_w reaches every sample of the ellipse, at least 1/2 away from Sk(X), for every n;
    Sk2 of the same samples comes near.
    """
    for n in (20, 80, 320):
        E = ellipse(n)
        before, after = np.roll(E, 1, axis=0) - E, np.roll(E, -1, axis=0) - E
        before /= np.linalg.norm(before, axis=1)[:, None]
        after /= np.linalg.norm(after, axis=1)[:, None]
        bisector = (before + after) / np.linalg.norm(before + after, axis=1)[:, None]
        on_branch = E + bisector * 1e-3 / n
        nearest = _sites(E, on_branch)
        reach = np.abs(on_branch[:, 1]).max()
        if not (np.ptp(nearest, axis=1).max() < 1e-9 and ring(E).contains(on_branch).all() and reach > 0.49):
            return verdict(False)
    # The library's skeleton of the polygon itself, from many samples of its sides, reaches the corners too.
    branchy = psl.sk2(ring(ellipse(20)), ring(ellipse(20)).sample(8000, start=0.5))
    if distance_to_complex(ellipse(20), branchy.vertices, branchy.edges).max() > 0.05:
        return verdict(False)
    second = psl.hausdorff(skeleton_of_ellipse(80), ELLIPSE_SKELETON)
    return verdict(second < 0.01)


@check("fig-5")
def convergence_figure():
    return seen(figure_is("figure_5", 6, _more_and_more_samples))


def _more_and_more_samples(figure, panels) -> bool:
    """Over the first panel's skeleton Sk2 of the samples drawn; of noisy samples, last, it has more edges."""
    X, counts = regular_shape(default("figure_5", "reference")), default("figure_5", "counts")
    exact_ = lines(panels[0])
    for n, ax in zip(counts, panels[1:-1], strict=True):
        E = X.sample(n)
        drawn = {*map(tuple, dots(ax).tolist())} == {*map(tuple, E.tolist())}
        if not (drawn and pieces(psl.sk2(X, E).segments()) == lines(ax) - exact_):
            return False
    rough = pieces(psl.voronoi(dots(panels[-1])).segments())
    barbs = lines(panels[-1]) - exact_
    return barbs <= rough and len(barbs) >= len(lines(panels[-2]) - exact_) and len(exact_) > 100
