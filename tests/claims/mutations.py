"""Plausible mistakes, each to be put in the place of what the checks call of the library.

A `Mutation` patches the library: `instead` puts a wrong function in the place of a right one. What is wrong
is made of what is right: something is lost, counted twice, in another unit, or taken of the other side.
"""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable
from dataclasses import replace
from itertools import combinations
from types import ModuleType

import numpy as np
import pytest
from scipy.spatial.distance import cdist

import polyskel_lite as psl
from polyskel_lite import drawing, simplification
from polyskel_lite.figures import polyballs as ball_figures

Mutation = Callable[[pytest.MonkeyPatch], None]

DELAUNAY, VORONOI, GABRIEL = psl.delaunay, psl.voronoi, psl.gabriel
SK0, SK1, SK2, SK3 = psl.sk0, psl.sk1, psl.sk2, psl.sk3
CONFORM, MISSING, RECONSTRUCT, SORTED = (
    psl.conform,
    psl.missing_facets,
    psl.reconstruct_curve,
    psl.delaunay_shape,
)
HIERARCHY, CONDITIONS, BALLS, POLYBALL = psl.hierarchy, psl.sk2_conditions, psl.delaunay_balls, psl.Polyball
CONTAINS, IN_BALLS, RESAMPLE = psl.Shape.contains, psl.Polyball.contains, psl.Shape.resample
SKELETON, EXPOSED, GENERATING = POLYBALL.skeleton, POLYBALL.exposed_pairs, POLYBALL.generating
SINGULAR, BOUNDARY_DISTANCE = POLYBALL.singular_points, psl.Shape.boundary_distance
MEASURES, BEHIND, TYPES = (
    simplification.facet_measures,
    simplification.behind,
    simplification.simplices_by_type,
)
DRAW_LINES, FREE_EDGES, KINDS = drawing.draw_lines, ball_figures.free_edges, ball_figures.kinds_of_balls


def instead(target: object, name: str, wrong) -> Mutation:
    """Put something wrong in the place of an attribute of a module or a class."""
    return lambda patch: patch.setattr(target, name, wrong)


def clear_caches() -> None:
    """Forget all that the checks and their inputs have kept, so that nothing wrong outlives a mutation.

    `truth.space` keeps its answers: they hang on the numbers that were asked about, not on the library.
    """
    for name, module in list(sys.modules.items()):
        if isinstance(module, ModuleType) and name.split(".")[0] in ("claims", "truth"):
            if name == "truth.space":
                continue
            for value in vars(module).values():
                if hasattr(value, "cache_clear"):
                    value.cache_clear()


# Tessellations


def tessellation_of(points, simplices) -> psl.Tessellation:
    """A tessellation of any simplices, Delaunay or not."""
    simplices = np.asarray(simplices)
    across, neighbors = {}, np.full(simplices.shape, -1)
    for row, s in enumerate(simplices.tolist()):
        for side, corner in enumerate(s):
            facet = frozenset(s) - {corner}
            if facet in across:
                other, there = across[facet]
                neighbors[row, side], neighbors[other, there] = other, row
            across[facet] = row, side
    return psl.Tessellation.trusted(np.asarray(points, dtype=float), simplices, neighbors)


def last_simplex_lost(points):
    t = DELAUNAY(points)
    return tessellation_of(t.points, t.simplices[:-1]) if len(t.simplices) > 1 else t


def half_of_the_simplices(points):
    t = DELAUNAY(points)
    return tessellation_of(t.points, t.simplices[: len(t.simplices) // 2])


def one_flip_too_many(points):
    """In the plane the other diagonal of two triangles, in space three tetrahedra for two."""
    t = DELAUNAY(points)
    for row, beside in enumerate(t.neighbors.tolist()):
        for other in beside:
            if other < row:
                continue
            one, two = (set(t.simplices[k].tolist()) for k in (row, other))
            shared, ends = sorted(one & two), sorted(one ^ two)
            new = [[*ends, *side] for side in combinations(shared, t.dimension - 1)]
            size = [abs(np.linalg.det(t.points[s[1:]] - t.points[s[0]])) for s in (*new, [*one], [*two])]
            # Only where the two make a convex body do the new ones fill it.
            if min(size) > 1e-6 and np.isclose(sum(size[: len(new)]), sum(size[len(new) :])):
                rest = np.delete(t.simplices, [row, other], axis=0)
                return tessellation_of(t.points, np.concatenate([rest, np.array(new)]))
    return t


def slow(points):
    """Computed anew for every two thousand points."""
    for _ in range(len(points) // 2000):
        DELAUNAY(points)
    return DELAUNAY(points)


def takes_shapes(points):
    return DELAUNAY(points.points if isinstance(points, psl.Shape) else points)


barycentres = property(lambda t: t.points[t.simplices].mean(axis=1))


# Gabriel graphs


def open_for_closed(points, closed: bool = True):
    return GABRIEL(points, closed=False)


def simplices_for_facets(points, closed: bool = True):
    return DELAUNAY(points).simplices


def last_facet_lost(points, closed: bool = True):
    return GABRIEL(points, closed)[:-1]


def acute_only(points, closed: bool = True):
    """Faces with the centre of their circle inside: what the paper's construction finds in space."""
    facets = GABRIEL(points, closed)
    t = points if isinstance(points, psl.Tessellation) else DELAUNAY(points)
    a, b, c = np.moveaxis(t.points[facets], 1, 0)
    corners = [((q - p) * (r - p)).sum(axis=1) for p, q, r in ((a, b, c), (b, c, a), (c, a, b))]
    return facets[np.min(corners, axis=0) >= 0]


# Skeletons


def of_a_shape(P) -> psl.Shape:
    return P if isinstance(P, psl.Shape) else P.to_shape()


def restricted(skeleton: psl.Skeleton, keep) -> psl.Skeleton:
    """Without some vertices, and all that is at them."""
    number = np.where(keep, np.cumsum(keep) - 1, -1)
    edges = number[skeleton.edges]
    polygons = [number[p] for p in skeleton.polygons]
    open_ = keep[skeleton.ray_vertices]
    return replace(
        skeleton,
        vertices=skeleton.vertices[keep],
        radii=skeleton.radii[keep],
        simplices=skeleton.simplices[keep],
        edges=edges[(edges >= 0).all(axis=1)],
        polygons=[p for p in polygons if (p >= 0).all()],
        rays=skeleton.rays[open_],
        ray_vertices=number[skeleton.ray_vertices[open_]],
    )


def last_vertex_lost(method):
    @functools.wraps(method)
    def wrong(*args, **kwargs):
        skeleton = method(*args, **kwargs)
        return restricted(skeleton, np.arange(len(skeleton.vertices)) < len(skeleton.vertices) - 1)

    return wrong


def last_edge_lost(method):
    @functools.wraps(method)
    def wrong(*args, **kwargs):
        skeleton = method(*args, **kwargs)
        return replace(skeleton, edges=skeleton.edges[:-1])

    return wrong


def without_rays(method):
    @functools.wraps(method)
    def wrong(*args, **kwargs):
        skeleton = method(*args, **kwargs)
        return replace(skeleton, rays=skeleton.rays[:0], ray_vertices=skeleton.ray_vertices[:0])

    return wrong


def without_polygons(method):
    @functools.wraps(method)
    def wrong(*args, **kwargs):
        return replace(method(*args, **kwargs), polygons=())

    return wrong


def polygons_out_of_order(method):
    @functools.wraps(method)
    def wrong(*args, **kwargs):
        skeleton = method(*args, **kwargs)
        return replace(skeleton, polygons=[p[[1, 0, *range(2, len(p))]] for p in skeleton.polygons])

    return wrong


def radii_squared(method):
    @functools.wraps(method)
    def wrong(*args, **kwargs):
        skeleton = method(*args, **kwargs)
        return replace(skeleton, radii=skeleton.radii**2)

    return wrong


def one_vertex_a_place(method):
    """As a set of points: vertices at one place are one."""

    @functools.wraps(method)
    def wrong(*args, **kwargs):
        skeleton = method(*args, **kwargs)
        places, first, number = np.unique(
            skeleton.vertices.round(9), axis=0, return_index=True, return_inverse=True
        )
        number = number.ravel()
        edges = np.unique(np.sort(number[skeleton.edges], axis=1), axis=0)
        return replace(
            skeleton,
            vertices=places,
            radii=skeleton.radii[first],
            simplices=skeleton.simplices[first],
            edges=edges[edges[:, 0] != edges[:, 1]],
            polygons=[number[p] for p in skeleton.polygons],
            ray_vertices=number[skeleton.ray_vertices],
        )

    return wrong


OTHER = {"inner": "outer", "outer": "inner"}


def other_side_sk0(P, side="inner"):
    return SK0(P, OTHER[side])


def other_side_sk1(shape, E=None, side="inner"):
    return SK1(shape, E, OTHER[side])


def simplified_sk0(P, side="inner"):
    return HIERARCHY(P).skeleton(np.pi)


def conformed_sk0(P, side="inner"):
    return SK0(CONFORM(P, to="delaunay") if isinstance(P, psl.Shape) else P, side)


def sk2_for_sk0(P, side="inner"):
    return SK2(of_a_shape(P), side=side)


def sk0_for_sk2(shape, E=None, side="inner"):
    """Where it is defined."""
    return SK2(shape, E, side) if len(MISSING(shape)) else SK0(shape, side)


def sk1_for_sk2(shape, E=None, side="inner"):
    return SK1(shape, E, side)


def sk3_for_sk2(shape, E=None, side="inner"):
    return SK3(shape, E, side)


def sk2_for_sk1(shape, E=None, side="inner"):
    return SK2(shape, E, side)


def sk1_for_sk3(shape, E=None, side="inner"):
    return SK1(shape, E, side)


def sk2_for_sk3(shape, E=None, side="inner"):
    return SK2(shape, E, side)


def both_ends_are_enough(shape, E=None, side="inner"):
    """All elements whose vertices are in the shape, wherever they pass."""
    first = SK1(shape, E, side)
    inner = np.zeros(len(first.tessellation.simplices), dtype=bool)
    inner[first.simplices] = True
    return SK0(psl.DelaunayShape(first.tessellation, inner))


def inner_simplices_for_inner_centres(shape, E=None, side="inner"):
    t = SK1(shape, E, side).tessellation
    inner = CONTAINS(shape, t.points[t.simplices].mean(axis=1)) == (side == "inner")
    return replace(SK0(psl.DelaunayShape(t, inner)), edges=np.zeros((0, 2), dtype=int), polygons=())


def poles_only(shape, E=None, side="inner"):
    """Of each sample the farthest vertex of its region: what does converge in space."""
    first = SK1(shape, E, side)
    keep = np.zeros(len(first.vertices), dtype=bool)
    corners = first.tessellation.simplices[first.simplices]
    for k in np.unique(corners):
        own = np.flatnonzero((corners == k).any(axis=1))
        keep[own[first.radii[own].argmax()]] = True
    return restricted(first, keep)


def of_the_open_shape(shape, E=None, side="inner"):
    first = SK1(shape, E, side)
    return restricted(first, BOUNDARY_DISTANCE(shape, first.vertices) > 0)


def skeleton_of_the_balls(shape, E=None, side="inner"):
    return BALLS(shape, E).skeleton()


def smaller_balls(skeleton):
    return POLYBALL(skeleton.vertices, 0.9 * skeleton.radii)


def whole_shape(skeleton):
    """All triangles, also those whose vertices have gone."""
    t = skeleton.tessellation
    return psl.DelaunayShape(t, np.ones(len(t.simplices), dtype=bool))


# Shapes


def open_shape(shape, queries):
    return CONTAINS(shape, queries) & (BOUNDARY_DISTANCE(shape, queries) > 0)


def at_the_corners(shape, E=None):
    """The distance to the samples of corners only."""
    E = shape.points if E is None else np.asarray(E, dtype=float)
    return float(cdist(shape.points, E).min(axis=1).max())


def to_the_corners(shape, queries):
    return cdist(np.asarray(queries, dtype=float), shape.points).min(axis=1)


def resampled_beside(shape, n, start=0.0):
    """The middles of the right samples, a little inside the outline."""
    right = RESAMPLE(shape, n, start)
    a, b = right.facets.T
    points = right.points.copy()
    points[a] = (right.points[a] + right.points[b]) / 2
    return psl.Shape(points, right.facets)


def by_their_centres(shape):
    """Simplices sorted by where their circumcentre is."""
    P = SORTED(shape)
    t = P.tessellation
    return psl.DelaunayShape(t, CONTAINS(shape, t.circumcenters))


def gabriel_for_delaunay(shape, *args, **kwargs):
    return MISSING(shape, of="gabriel")


def nothing_missing(shape, *args, **kwargs):
    return MISSING(shape)[:0]


def nothing_added(shape, to=None, limit=None):
    return shape


def halving_alone(shape, to=None, limit=None):
    """Thirty rounds without the cut at acute corners."""
    points, facets = shape.points.tolist(), shape.facets.tolist()
    for _ in range(30):
        for k in MISSING(psl.Shape(points, facets), of="gabriel").tolist():
            a, b = facets[k]
            points.append([(x + y) / 2 for x, y in zip(points[a], points[b], strict=True)])
            facets[k] = [a, len(points) - 1]
            facets.append([len(points) - 1, b])
    return psl.Shape(points, facets)


def holes_lost(points):
    right = RECONSTRUCT(points)
    rings = [right.points[r] for r in right.rings()]
    return psl.Shape.from_rings([max(rings, key=lambda ring: np.ptp(ring[:, 0]))])


# Hierarchies


def always_transcript(P, strategy=None, criterion="corrected"):
    return HIERARCHY(P, strategy, "transcript")


def never_transcript(P, strategy=None, criterion="corrected"):
    return HIERARCHY(P, strategy)


def sign_flipped(P, strategy=None, criterion="corrected"):
    h = HIERARCHY(P, strategy, criterion)
    return replace(h, level=-h.level)


def in_degrees(P, strategy=None, criterion="corrected"):
    h = HIERARCHY(P, strategy, criterion)
    return replace(h, level=np.degrees(h.level))


def one_too_many(P, strategy=None, criterion="corrected"):
    """Of those that stay the last one goes, too, as if it were a hat."""
    h = HIERARCHY(P, strategy, criterion)
    stays = np.flatnonzero(h.level == np.inf)
    level, kind = h.level.copy(), h.kind.copy()
    level[stays[-1:]], kind[stays[-1:]] = level[h.order].max(initial=0.0), 1
    return replace(h, level=level, kind=kind, order=np.append(h.order, stays[-1:]))


def kinds_swapped(P, strategy=None, criterion="corrected"):
    h = HIERARCHY(P, strategy, criterion)
    return replace(h, kind=np.array([0, 2, 1])[h.kind])


def any_threshold(h, threshold):
    """Words are compared like numbers that nothing reaches."""
    keep = np.zeros_like(h.P.inner)
    keep[h.simplices] = h.level >= (threshold if isinstance(threshold, float | int) else np.inf)
    return keep


def what_goes(h, threshold):
    """What goes at a threshold for what stays."""
    keep = np.zeros_like(h.P.inner)
    keep[h.simplices] = h.level < threshold
    return keep


def last_of_them_lost(h, vertex):
    return BEHIND(h, vertex)[:-1]


def first_of_them_lost(h, vertex):
    return BEHIND(h, vertex)[1:]


def twice_the_area(tessellation, rows=slice(None)):
    """The parallelogram for the triangle."""
    return 2 * MEASURES(tessellation, rows)


def boundary_sides(P):
    """Sides on the boundary counted for those that are shared."""
    right = TYPES(P)
    return np.where(right < 0, -1, P.dimension + 1 - right)


# Unions of balls


def open_balls(Y, queries):
    return IN_BALLS(POLYBALL(Y.centers, Y.radii * (1 - 1e-9)), queries)


def skeleton_of_smaller_balls(Y, statement="corrected"):
    return SKELETON(POLYBALL(Y.centers, 0.9 * Y.radii))


def printed_skeleton(Y, statement="corrected"):
    return SKELETON(Y, "transcript")


def all_balls(Y):
    return np.arange(len(Y))


def last_point_lost(Y):
    return SINGULAR(Y)[:-1]


def once_for_each_ball(Y):
    return np.repeat(SINGULAR(Y), Y.dimension, axis=0)


def overlaps_twice(Y):
    return float(np.pi * (Y.radii**2).sum())


def forgotten(condition: str):
    """One of the five conditions always holds."""

    def wrong(shape, E=None):
        found = CONDITIONS(shape, E)
        return found._replace(**{condition: getattr(found, condition)[:0]})

    return wrong


# Figures


def last_line_lost(ax, segments, *args, **kwargs):
    return DRAW_LINES(ax, segments[:-1], *args, **kwargs)


def last_free_edge_lost(skeleton):
    return FREE_EDGES(skeleton)[:-1]


def balls_too_small(polyball):
    return [None if ball is None else (ball[0], 0.9 * ball[1]) for ball in KINDS(polyball)]


def section_four(*args, **kwargs):
    """Sk2, the Voronoi elements that are wholly in the shape (section 4.2)."""
    return SK2(*args, **kwargs)
