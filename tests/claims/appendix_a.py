"""Appendix A: unions of balls, their structure and their skeletons (Theorems 3 and 4).

Maximal balls are grown, and distances measured, by `truth.medial`, which knows no theorem about skeletons.
"""

from __future__ import annotations

from functools import cache
from itertools import combinations, pairwise
from math import comb

import numpy as np
from matplotlib.patches import Circle
from scipy.spatial import cKDTree
from truth.cases import check_medial
from truth.complexes import distance_to_complex, lengths
from truth.medial import Union
from truth.polyballs import random_polyball

import polyskel_lite as psl
from polyskel_lite.figures import polyballs as figures

from .pictures import faces, figure_is, lines, pieces
from .registry import check, definition, seen, verdict

#: Unit balls in a row: every two neighbours meet in a circle that is on the boundary as a whole.
ROW = [(0, 0, 0), (0.5, 0, 0), (1, 0, 0)]
#: Three discs around a gap, and one that fills it: generating, but with no arc on the boundary.
FILLED = ([(1.1, 0), (-0.55, 0.9526), (-0.55, -0.9526), (0, 0.05)], [1, 1, 1, 0.3])
#: Families of random polyballs in which some balls do not generate.
REDUNDANT = ("lattice", "grid", "nested", "delaunay_balls")
TOLERANCE = 1e-9


@cache
def truth(number: int, N: int) -> Union:
    """The oracle's view of one of its random polyballs, without tangent balls."""
    _, centers, radii = random_polyball(number, N)
    return Union(centers, radii, seed=number)


@cache
def grown(number: int, N: int) -> tuple[np.ndarray, np.ndarray]:
    """Centres and radii of maximal balls grown in it, those that are known well."""
    Y = truth(number, N)
    m, r, error = Y.medial_points(np.random.default_rng(number))
    sharp = error < 1e-10 * Y.size
    return m[sharp], r[sharp]


def library(Y: Union) -> psl.Polyball:
    return psl.Polyball(Y.c + Y.origin, Y.r)


def contacts(Y: Union, m, r) -> np.ndarray:
    """How many known boundary points (singular ones, and some of each arc and patch) are on each ball."""
    points = np.concatenate([Y.corners, Y.arc_middles, Y.patch_points]) + Y.origin
    return (np.abs(lengths(m[:, None] - points) - r[:, None]) < TOLERANCE * Y.size).sum(axis=1)


def singular(Y: Union) -> np.ndarray:
    """The oracle's singular points, each once: it finds one again for every pair of spheres through it."""
    points = Y.singular_points()
    twice = (
        cKDTree(points).query_pairs(1e-7 * Y.size, output_type="ndarray") if len(points) else np.zeros((0, 2))
    )
    return np.delete(points, np.unique(twice[:, 1]).astype(int), axis=0)


def held_by_singular(Y: Union, m, r) -> np.ndarray:
    """Points with two nearest singular points or more, at the distance of the boundary."""
    to_corners = lengths(m[:, None] - singular(Y))
    return (np.abs(to_corners - r[:, None]) < TOLERANCE * Y.size).sum(axis=1) >= 2


def at_centers(Y: Union, m, r, balls) -> np.ndarray:
    """Points that are centres of these balls (rows of Y)."""
    far = lengths(m[:, None] - (Y.c[balls] + Y.origin)) + np.abs(r[:, None] - Y.r[balls])
    return (far < TOLERANCE * Y.size).any(axis=1)


def lonely(Y: Union) -> list[int]:
    """Generating balls that meet no other generating ball, by definition: one ball of a piece of its own."""
    found = []
    for k in np.unique(Y.patch_ball):
        d = lengths(Y.c - Y.c[k])
        meets = (d < Y.r + Y.r[k]) & (d + Y.r > Y.r[k] * (1 + 1e-9))
        meets[k] = False
        if not meets.any():
            found.append(int(k))
    return found


@check("def-minimal")
def minimal_writing():
    """Dropped: a ball in another one, or in the union of two. Kept: a filler, which has substitutes.

    Of random polyballs: all with a patch of the boundary are kept, and what is kept has the same union.
    """
    centers, radii = FILLED
    Y = psl.Polyball([*centers, (1.5, 0.2)], [*radii, 0.4])
    other = psl.Polyball([*centers[:3], (-0.06, -0.04)], [1, 1, 1, 0.36])
    points = np.random.default_rng(0).uniform(-2.2, 2.2, (20_000, 2))
    same = (Y.contains(points) == other.contains(points)).all()
    hidden = psl.Polyball([(0, 0), (1, 0), (0.5, 0)], [1, 1, 0.7])
    kept = Y.generating().tolist() == [0, 1, 2, 3] and len(other.minimal()) == 4
    row = psl.Polyball(ROW, [1, 1, 1]).generating(), psl.Polyball(ROW, [1, 0.8, 1]).generating()
    dropped = [hidden.generating().tolist(), *(found.tolist() for found in row)]
    plain = same and kept and dropped == [[0, 1], [0, 1, 2], [0, 2]]
    return definition(plain and all(_writes_the_same(n, N) for N in (2, 3) for n in range(24)))


def _writes_the_same(number: int, N: int) -> bool:
    Y, rng = truth(number, N), np.random.default_rng(number)
    least = library(Y).minimal()
    m = Y.origin + Y.c.mean(axis=0) + rng.uniform(-1, 1, (2000, N)) * Y.size
    needed = set(np.unique(Y.patch_ball).tolist()) <= set(library(Y).generating().tolist())
    # Points that nearly are on a sphere say nothing.
    clear = np.abs(Y.gap(m - Y.origin)).min(axis=1) > 1e-6 * Y.size
    return needed and bool((least.contains(m) == Y.contains(m))[clear].all())


@check("def-disconnected")
def disconnected_balls():
    """The library's list is that of the definition, on random polyballs in the plane and in space."""
    agree, some = True, 0
    for N in (2, 3):
        for number in range(4, 60, 5):
            Y = truth(number, N)
            listed = library(Y).disconnected().tolist()
            agree &= listed == lonely(Y)
            some += len(listed)
    touching = psl.Polyball([(0, 0), (2, 0)], [1, 1])
    return definition(bool(agree and some > 10 and not len(touching.disconnected())))


@check("def-quasi-disconnected")
def quasi_disconnected_balls():
    """A lens that a third ball meets is not alone, though its rim is on the boundary: a row of balls.

    Of random polyballs the library lists the pairs whose lens, by the distance to it, no third ball meets.
    """
    found = {}
    for step in (1.5, 1.01, 0.99, 0.5):
        row = psl.Polyball([(k * step, 0, 0) for k in range(3)], [1, 1, 1])
        assert row.exposed_pairs().tolist() == [[0, 1], [1, 2]]
        found[step] = len(row.quasi_disconnected())
    some = 0
    for N in (2, 3):
        for number in range(40):
            if random_polyball(number, N)[0] in REDUNDANT:
                continue
            Y = truth(number, N)
            if len(library(Y).generating()) != len(np.unique(Y.patch_ball)):
                continue  # a filler generates, too, and the oracle does not know fillers
            listed = library(Y).quasi_disconnected().tolist()
            if listed != _lenses_alone(Y):
                return definition(False)
            some += len(listed)
    return definition(some > 20 and found == {1.5: 2, 1.01: 2, 0.99: 0, 0.5: 0})


def _lenses_alone(Y: Union) -> list[list[int]]:
    """Pairs of generating balls that cross, and whose common part no other one reaches."""
    balls, alone = np.unique(Y.patch_ball), []
    for i, j in combinations(balls.tolist(), 2):
        d = lengths(Y.c[j] - Y.c[i])
        if not abs(Y.r[i] - Y.r[j]) < d < Y.r[i] + Y.r[j]:
            continue
        others = [k for k in balls.tolist() if k not in (i, j)]
        if all(_from_lens(Y, i, j, Y.c[k]) > Y.r[k] for k in others):
            alone.append([i, j])
    return alone


def _from_lens(Y: Union, i: int, j: int, m: np.ndarray) -> float:
    """The distance from a point to what two crossing balls have in common."""
    for one, other in ((i, j), (j, i)):
        away = lengths(m - Y.c[one])
        nearest = m if away <= Y.r[one] else Y.c[one] + (m - Y.c[one]) * Y.r[one] / away
        if lengths(nearest - Y.c[other]) <= Y.r[other]:
            return float(lengths(m - nearest))
    # Else the nearest point is on the rim, the circle of both spheres.
    d = lengths(Y.c[j] - Y.c[i])
    normal = (Y.c[j] - Y.c[i]) / d
    along = (d**2 + Y.r[i] ** 2 - Y.r[j] ** 2) / (2 * d)
    middle, rim = Y.c[i] + along * normal, np.sqrt(Y.r[i] ** 2 - along**2)
    up = (m - middle) @ normal
    return float(np.hypot(up, lengths(m - middle - up * normal) - rim))


@check("def-singular")
def singular_points():
    """The library finds the oracle's points; a point that three centres surround is inside, not singular.

    Left out are families with balls that do not generate: to the oracle they make corners all the same.
    """
    agree = True
    for N in (2, 3):
        for number in range(30):
            if random_polyball(number, N)[0] in REDUNDANT:
                continue
            Y = truth(number, N)
            found, expected = library(Y).singular_points(), Y.singular_points()
            if len(found) and len(expected):
                d = lengths(found[:, None] - expected)
                agree &= max(d.min(axis=0).max(), d.min(axis=1).max()) < 1e-8 * Y.size
            else:
                agree &= len(found) == len(expected)
    inner = psl.Polyball([(1, 0), (-0.6, 0.8), (-0.6, -0.8)], [1, 1, 1])
    surrounded = lengths(inner.singular_points()).min() > 0.5 and inner.boundary_distance([(0, 0)])[0] > 0.5
    return definition(bool(agree and surrounded))


@check("singular-finite")
def finitely_many_singular_points():
    """Of three spheres through one circle the middle one does not generate: the others cover it.

    As many as the oracle finds (in families without balls that do not generate, which make it find more).
    """
    pencil = psl.Polyball([(-1, 0, 0), (1, 0, 0), (0, 0, 0)], [2**0.5, 2**0.5, 1])
    few, some = True, 0
    for N in (2, 3):
        for number in range(20):
            Y = truth(number, N)
            found = len(library(Y).singular_points())
            few &= found <= 2 * comb(len(Y.r), N)
            if random_polyball(number, N)[0] not in REDUNDANT:
                few &= found == len(singular(Y))
                some += found
    return verdict(
        few and some > 100 and pencil.generating().tolist() == [0, 1] and not len(pencil.singular_points())
    )


@check("fig-11")
def figure_of_the_plane():
    return seen(figure_is("figure_11", 4, _four_maximal_balls))


def _four_maximal_balls(figure, panels) -> bool:
    """The whole skeleton on every panel, and a disc around a point of it that just reaches the boundary."""
    Y = psl.Polyball(figures.CENTERS_11, figures.RADII_11)
    skeleton = Y.skeleton()
    for ax in panels[:4]:
        discs = [patch for patch in ax.patches if isinstance(patch, Circle)]
        centers, radii = np.array([d.center for d in discs]), np.array([d.radius for d in discs])
        on = distance_to_complex(centers, skeleton.vertices, skeleton.edges) < TOLERANCE
        full = np.abs(Y.boundary_distance(centers) - radii) < TOLERANCE
        if not ((on & full).any() and pieces(skeleton.segments()) <= lines(ax)):
            return False
    return True


@check("fig-12")
def figure_of_space():
    return seen(figure_is("figure_12", 6, _six_skeletons))


def _six_skeletons(figure, panels) -> bool:
    """The polygons of each skeleton, filled or by their sides, and where it has none its segments."""
    for ax, Y in zip(panels, figures.examples_12(), strict=False):
        skeleton = Y.skeleton()
        if len(skeleton.polygons):
            corners = (skeleton.vertices[[*polygon, polygon[0]]] for polygon in skeleton.polygons)
            outlined = sum(pieces(pairwise(ring)) <= lines(ax) for ring in corners)
            if len(skeleton.polygons) not in {outlined + filled for filled in faces(ax)}:
                return False
        elif not pieces(skeleton.segments()) <= lines(ax):
            return False
    return True


@check("two-contacts")
def at_least_two_contacts():
    """Every grown ball touches two known boundary points or more; so do those at the library's vertices."""
    tried = 0
    for N in (2, 3):
        for number in range(30):
            Y, (m, r) = truth(number, N), grown(number, N)
            skeleton = library(Y).skeleton()
            m, r = np.concatenate([m, skeleton.vertices]), np.concatenate([r, skeleton.radii])
            if len(m) and contacts(Y, m, r).min() < 2:
                return verdict(False)
            tried += len(m)
    assert tried > 2000
    return verdict(True)


@check("theorem-3")
def theorem_3():
    """Grown centres are where the theorem says, and the library's skeleton is that set.

    Read as "all closest points are singular" it loses the centre of each of two crossing discs.
    """
    pair = Union(np.array([(0.0, 0), (1, 0)]), np.ones(2))
    growth, error = pair.growth([(0, 0)])
    center_is_maximal = growth[0] <= 10 * error[0] + TOLERANCE
    arc = np.array(
        [(-1, 0), (-0.6, 0.8)]
    )  # as near to (0, 0) as the two corners, on the boundary, no corners
    lost = np.abs(pair.boundary_distance([(0, 0), *arc]) - (1, 0, 0)).max() < 1e-12
    assert center_is_maximal
    for number in range(40):
        Y, (m, r) = truth(number, 2), grown(number, 2)
        if len(m) and not (held_by_singular(Y, m, r) | at_centers(Y, m, r, lonely(Y))).all():
            return verdict(False)
        skeleton = library(Y).skeleton()
        away = distance_to_complex(m, skeleton.vertices, skeleton.edges)
        if len(m) and away.max() > 1e-8 * Y.size:
            return verdict(False)
    return verdict(stands=not lost, repaired=True)


@check("theorem-3-contact")
def contact_inside_an_arc():
    """A grown ball with a contact that is no corner is an exposed disc: alone, or with two corners on it.

    So is a ball at a vertex of the library's skeleton.
    """
    seen = 0
    for number in range(40):
        Y, (m, r) = truth(number, 2), grown(number, 2)
        skeleton = library(Y).skeleton()
        m, r = np.concatenate([m, skeleton.vertices]), np.concatenate([r, skeleton.radii])
        # The library has each exposed disc, with its radius.
        own = np.unique(Y.patch_ball)
        discs, found = (
            np.column_stack([centers, radii])
            for centers, radii in ((Y.c[own] + Y.origin, Y.r[own]), (skeleton.vertices, skeleton.radii))
        )
        if np.abs(discs[:, None] - found).max(axis=2).min(axis=1).max() > 1e-8 * Y.size:
            return verdict(False)
        d = lengths(m[:, None] - Y.patch_points - Y.origin) - r[:, None]
        arc = (np.abs(d) < TOLERANCE * Y.size).any(axis=1)
        own = at_centers(Y, m, r, np.unique(Y.patch_ball))
        if not (arc == own).all():
            return verdict(False)
        if not (held_by_singular(Y, m[own], r[own]) | at_centers(Y, m[own], r[own], lonely(Y))).all():
            return verdict(False)
        seen += int(own.sum())
    assert seen > 100
    return verdict(True)


@check("theorem-3-converse")
def balls_of_the_formula_are_maximal():
    """Points of Vor(S) in Y with a singular nearest point, and centres of lonely discs, cannot grow.

    Nor can the balls around points of the library's skeleton.
    """
    rng, tried = np.random.default_rng(2), 0
    for number in range(20):
        Y = truth(number, 2)
        check_medial(Y, library(Y).skeleton(), rng)
        S, points = singular(Y), [Y.c[lonely(Y)] + Y.origin]
        for p, q in combinations(S, 2):
            across = (q - p)[::-1] * [1, -1]
            points.append((p + q) / 2 + rng.uniform(-1, 1, (8, 1)) * across)
        m = np.concatenate(points)
        m = m[Y.contains(m)]
        r = Y.boundary_distance(m)
        m = m[(held_by_singular(Y, m, r) | at_centers(Y, m, r, lonely(Y))) & (r > 1e-3 * Y.size)]
        growth, error = Y.growth(m)
        if (growth > TOLERANCE * Y.size + 10 * error).any():
            return verdict(False)
        tried += len(m)
    assert tried > 100
    return verdict(True)


@check("through-centres")
def through_the_centres():
    """Exposed balls: yes. A filler is generating, but a larger ball holds it."""
    for N in (2, 3):
        for number in range(20):
            Y = truth(number, N)
            skeleton = library(Y).skeleton()
            exposed = Y.c[np.unique(Y.patch_ball)] + Y.origin
            away = distance_to_complex(exposed, skeleton.vertices, skeleton.edges, skeleton.polygons)
            if away.max() > 1e-8 * Y.size:
                return verdict(False)
    Y = psl.Polyball(*FILLED)
    assert Y.generating().tolist() == [0, 1, 2, 3]
    skeleton = Y.skeleton()
    off = distance_to_complex(Y.centers[3:], skeleton.vertices, skeleton.edges)[0]
    return verdict(stands=off < 0.01, repaired=True)


@check("theorem-4")
def theorem_4():
    """Read for the circle, and "at least one": grown centres are where the theorem and its proof say.

    Read for the lens, the three sets of a row of balls are empty, yet balls around its points are maximal.
    """
    row = psl.Polyball(ROW, np.ones(3))
    empty = (
        not len(row.disconnected()) and not len(row.quasi_disconnected()) and not len(row.singular_points())
    )
    m = np.array([(0.2, 0, 0), (0.5, 0, 0), (0.8, 0, 0)])
    growth, error = Union(np.array(ROW, dtype=float), np.ones(3)).growth(m)
    maximal = (growth <= TOLERANCE + 10 * error).all()
    found = row.skeleton()
    on = distance_to_complex(m, found.vertices, found.edges, found.polygons).max() < TOLERANCE
    assert maximal
    seen = 0
    for number in range(30):
        Y, (m, r) = truth(number, 3), grown(number, 3)
        if not len(m):
            continue
        pairs = whole_circles(library(Y))
        on_segment = np.full(len(m), False)
        if len(pairs):
            on_segment = distance_to_complex(m, library(Y).centers, pairs) < 1e-8 * Y.size
        listed = held_by_singular(Y, m, r) | at_centers(Y, m, r, lonely(Y)) | on_segment
        skeleton = library(Y).skeleton()
        away = distance_to_complex(m, skeleton.vertices, skeleton.edges, skeleton.polygons)
        on &= bool(listed.all()) and away.max() < 1e-8 * Y.size
        seen += int(on_segment.sum())
    return verdict(stands=not empty, repaired=bool(on) and seen > 50)


def whole_circles(Y: psl.Polyball) -> np.ndarray:
    """Definition 3 read for the circle: pairs of generating balls whose circle no third ball meets."""
    S, whole = Y.singular_points(), []
    for i, j in Y.exposed_pairs():
        # An exposed circle that another ball cuts has singular points on it, where its arcs end.
        on = [np.abs(lengths(S - Y.centers[k]) - Y.radii[k]) < 1e-8 * Y.radii[k] for k in (i, j)]
        if not (on[0] & on[1]).any():
            whole.append((i, j))
    return np.array(whole, dtype=int).reshape(-1, 2)


@check("polyball-by-voronoi")
def voronoi_graph_of_singular_points():
    """Edges in the plane, and polygons in space, have two nearest singular points throughout."""
    rng, polygons = np.random.default_rng(5), 0
    for number in range(30):
        for N in (2, 3):
            Y, skeleton = truth(number, N), library(truth(number, N)).skeleton()
            if N == 2:
                a, b = np.moveaxis(skeleton.segments(), 1, 0)
                m = a + rng.random((len(a), 1)) * (b - a)
            else:
                middles = [skeleton.vertices[p].mean(axis=0) for p in skeleton.polygons]
                m = np.array(middles).reshape(-1, N)
                polygons += len(m)
            if len(m) and not held_by_singular(Y, m, Y.boundary_distance(m)).all():
                return verdict(False)
    assert polygons > 50
    return verdict(True)
