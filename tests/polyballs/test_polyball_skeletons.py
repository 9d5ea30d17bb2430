"""Appendix A against the truth: skeletons of random polyballs, grown maximal balls, named counterexamples.

`truth.medial` knows no theorem. It grows maximal balls in unions of balls, measures distances to the
boundary and counts holes by brute force; here its answers are compared with the library's, on `PER_FAMILY`
polyballs of each of eleven families in the plane and as many in space.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from truth.cases import (
    BLUNT,
    PER_FAMILY,
    TOLERANCE,
    away,
    cases,
    check_complete,
    check_medial,
    farthest,
    samples_of,
)
from truth.complexes import distance_to_complex, sample_complex
from truth.medial import Union
from truth.nerves import common_power
from truth.polyballs import FAMILIES, random_polyball

import polyskel_lite as psl

each_family = pytest.mark.parametrize("family", range(len(FAMILIES)), ids=[f.__name__ for f in FAMILIES])
each_dimension = pytest.mark.parametrize("N", [2, 3])


# --- the theorem


@each_dimension
@each_family
def test_every_maximal_ball_is_centred_on_the_skeleton(family, N):
    blunt, balls = np.sum(
        [check_complete(x.truth, x.skeleton, x.rng, x.name) for x in cases(family, N)], axis=0
    )
    assert blunt < balls / 20


@each_dimension
@each_family
def test_every_point_of_the_skeleton_is_the_centre_of_a_maximal_ball(family, N):
    blunt, points = np.sum(
        [check_medial(x.truth, x.skeleton, x.rng, x.name) for x in cases(family, N)], axis=0
    )
    assert blunt < points / 20


@each_dimension
@each_family
def test_radii_are_distances_to_the_boundary(family, N):
    for x in cases(family, N):
        distance = x.truth.boundary_distance(x.skeleton.vertices)
        assert x.skeleton.radii == pytest.approx(distance, abs=TOLERANCE * x.size), x.name
        assert x.truth.contains(x.skeleton.vertices).all()


@each_dimension
@each_family
def test_homotopy(family, N):
    """The skeleton has the Betti numbers of the polyball: of the nerve of its balls.

    Left out in space are polyballs whose holes open or close when radii change by 1e-9 of the size: there
    the closed set and its interior may differ, and the skeleton goes with the interior.
    """
    compared = 0
    for x in cases(family, N):
        betti = x.truth.robust_betti()
        if betti is not None:
            assert x.skeleton.betti() == betti, x.name
            compared += 1
    assert compared >= 0.8 * PER_FAMILY


def test_the_families_have_loops_and_cavities():
    """What the comparison of Betti numbers stands on: many polyballs are not just blobs."""
    loops = [x.truth.robust_betti() for f in range(len(FAMILIES)) for x in cases(f, 2)]
    assert sum(b is not None and b[1] > 0 for b in loops) > 80
    hollow = [x.truth.robust_betti() for f in range(len(FAMILIES)) for x in cases(f, 3)]
    assert sum(b is not None and b[1] > 0 for b in hollow) > 50
    assert sum(b is not None and b[2] > 0 for b in hollow) > 5


def missed_as_printed(N, count=PER_FAMILY):
    """Polyballs of which the theorem as printed misses a medial point, all; points missed, all."""
    wrong, missed, total = 0, 0, 0
    for x in (x for f in range(len(FAMILIES)) for x in cases(f, N, count)):
        m, _, error = x.truth.medial_points(np.random.default_rng(7))
        sharp = error <= BLUNT * x.size
        printed = x.Y.skeleton(statement="transcript")
        off = sharp & (away(m, printed) > 1e-6 * x.size)
        wrong, missed, total = wrong + bool(off.any()), missed + int(off.sum()), total + int(sharp.sum())
    return wrong, count * len(FAMILIES), missed, total


def test_as_printed_theorem_4_misses_medial_points():
    wrong, polyballs, missed, points = missed_as_printed(3, 20)
    assert wrong > polyballs / 20
    assert missed > points / 100


def test_as_printed_theorem_4_misses_segments_of_whole_circles_only():
    """An arc has two ends, singular points at one distance from all points of the segment: they are Voronoi.

    So of the corrected statement's segments only those of circles wholly on the boundary are new, and
    Definition 3 need only be replaced by "their circle is on the boundary". (A circle that a third sphere
    touches in one point counts as whole.)
    """
    segments = 0
    for x in (x for f in range(len(FAMILIES)) for x in cases(f, 3, 20)):
        t = x.truth
        part = t.arcs[(t.arcs[:, 2] < 2 * np.pi - 1e-3) & (t.arcs[:, 2] > 1e-3), :2].astype(int)
        if len(part):
            share = np.linspace(0, 1, 5)[:, None, None]
            m = ((1 - share) * t.c[part[:, 0]] + share * t.c[part[:, 1]] + t.origin).reshape(-1, 3)
            assert away(m, x.Y.skeleton(statement="transcript")).max() < TOLERANCE * x.size, x.name
            segments += len(part)
    assert segments > 500


def test_as_printed_theorem_3_misses_none():
    assert missed_as_printed(2, 10)[2] == 0


@each_family
def test_as_printed_claims_no_more_in_3d(family):
    """What the printed theorem does give is medial: it is too small, not wrong."""
    for x in cases(family, 3, 5):
        printed = x.Y.skeleton(statement="transcript")
        assert (
            not len(printed.vertices)
            or away(samples_of(printed, x.rng), x.skeleton).max() < TOLERANCE * x.size
        )


# --- the same polyball in other clothes


def rotation(rng, N):
    q, _ = np.linalg.qr(rng.standard_normal((N, N)))
    return q * np.sign(np.linalg.det(q))


@each_dimension
@each_family
def test_invariances(family, N):
    """Permuted, moved, scaled and turned balls have the permuted, moved, scaled and turned skeleton."""
    for x in cases(family, N, 5):
        rng, c, r = x.rng, x.centers, x.radii
        order = rng.permutation(len(r))
        shift, turn = x.size * rng.standard_normal(N), rotation(rng, N)
        if np.prod(np.linalg.eigvals(turn)).real < 0:
            turn[:, 0] *= -1
        middle = c.mean(axis=0)
        variants = {
            "permuted": (c[order], r[order], lambda v: v),
            "moved": (c + shift, r, lambda v, shift=shift: v - shift),
            "tiny": ((c - middle) * 1e-9, r * 1e-9, lambda v, middle=middle: v * 1e9 + middle),
            "huge": ((c - middle) * 2.0**40, r * 2.0**40, lambda v, middle=middle: v * 2.0**-40 + middle),
            "turned": (
                (c - middle) @ turn.T,
                r,
                lambda v, turn=turn, middle=middle: v @ turn + middle,
            ),
        }
        for name, (centers, radii, back) in variants.items():
            other = psl.Polyball(centers, radii).skeleton()
            vertices = back(other.vertices)
            here = distance_to_complex(samples_of(x.skeleton, rng), vertices, other.edges, other.polygons)
            there = away(sample_complex(rng, vertices, other.edges, other.polygons), x.skeleton)
            # Coordinates that are rounded anew move corners of nearly tangent circles by more.
            assert max(here.max(), there.max()) < 1e-7 * x.size, (x.name, name)
            assert other.betti() == x.skeleton.betti(), (x.name, name)


@each_dimension
@pytest.mark.parametrize("factor", [1e3, 1e6])
def test_far_from_the_origin(N, factor):
    """Coordinates rounded at `factor` times the size: right up to that rounding."""
    for number in range(20):
        _, c, r = random_polyball(number, N)
        size = Union(c, r).size
        shift = factor * size * np.ones(N)
        moved = c + shift  # rounded; from here on exact input
        truth = Union(moved, r)
        if len(truth.tangent_pairs(1e-8)):
            continue
        skeleton = psl.Polyball(moved, r).skeleton()
        m, _, error = truth.medial_points(np.random.default_rng(number))
        gap = away(m, skeleton)
        allowed = (TOLERANCE + 1e-14 * factor) * size + 1e3 * error
        assert (gap <= allowed)[error < BLUNT * size].all(), (number, gap.max())
        growth, error = truth.growth(samples_of(skeleton, np.random.default_rng(number)))
        allowed = (TOLERANCE + 1e-14 * factor) * size + 1e3 * error
        assert (growth <= allowed)[error < BLUNT * size].all(), (number, growth.max())


# --- the parts: boundary, singular points, kinds of balls and pairs


@each_dimension
@each_family
def test_boundary_distance_and_membership(family, N):
    for x in cases(family, N, 20):
        low, high = (x.centers - x.radii[:, None]).min(axis=0), (x.centers + x.radii[:, None]).max(axis=0)
        queries = np.concatenate([x.rng.uniform(low, high, (60, N)), x.centers])
        distance = x.truth.boundary_distance(queries)
        assert x.Y.boundary_distance(queries) == pytest.approx(distance, abs=TOLERANCE * x.size), x.name
        clear = np.abs(x.truth.gap(queries - x.truth.origin)).min(axis=1) > TOLERANCE * x.size
        assert (x.Y.contains(queries) == x.truth.contains(queries))[clear].all(), x.name


@each_dimension
@each_family
def test_singular_points(family, N):
    for x in cases(family, N):
        found, true = x.Y.singular_points(), x.truth.singular_points()
        # Nearly tangent circles have two corners in one place to 1e-8; which are told apart is rounding.
        assert farthest(found, true) < 1e-7 * x.size, x.name
        # Where a third sphere only touches an arc (centres and p in one plane) no arc ends: definition 4
        # counts the point, the skeleton is the same with it and without.
        spans = [
            np.linalg.svd(x.truth.directions(p))[1][-1] > 1e-4 if len(true) else 0 for p in x.truth.corners
        ]
        assert farthest(true[np.array(spans, dtype=bool)], found) < 1e-7 * x.size, x.name


@each_dimension
@each_family
def test_minimal_writing(family, N):
    """The same set, and no ball of it is covered by the others."""
    for x in cases(family, N, 8):
        minimal = x.Y.minimal()
        truth = Union(minimal.centers, minimal.radii)
        low, high = (x.centers - x.radii[:, None]).min(axis=0), (x.centers + x.radii[:, None]).max(axis=0)
        queries = x.rng.uniform(low, high, (40, N))
        assert truth.boundary_distance(queries) == pytest.approx(
            x.truth.boundary_distance(queries), abs=TOLERANCE * x.size
        ), x.name
        assert not any(truth.redundant(k) for k in range(len(truth.r))), x.name
        assert len(truth.r) == len(minimal.radii)  # no doubles
        assert len(minimal.minimal().radii) == len(minimal.radii)


def common_points(centers, radii, size):
    """Which pairs meet, and which pairs meet in a place where a third ball is (definitions 2 and 3)."""
    k = len(radii)
    pairs = np.array(list(combinations(range(k), 2)), dtype=int).reshape(-1, 2)
    pairs = pairs[common_power(centers[pairs], radii[pairs] ** 2) <= 0] if len(pairs) else pairs
    met = set()
    for i, j in pairs.tolist():
        rest = [m for m in range(k) if m not in (i, j)]
        triples = np.array([[i, j, m] for m in rest], dtype=int).reshape(-1, 3)
        if len(triples) and (common_power(centers[triples], radii[triples] ** 2) <= 1e-12 * size**2).any():
            met.add((i, j))
    return pairs, met


@each_dimension
@each_family
def test_disconnected_and_quasi_disconnected(family, N):
    """Definitions 2 and 3 as printed for the generating balls, by common points of two and three balls."""
    for x in cases(family, N, 20):
        generating = x.Y.generating()
        c, r = x.centers[generating], x.radii[generating]
        pairs, met = common_points(c, r, x.size)
        alone = sorted(set(range(len(r))) - set(pairs.ravel().tolist()))
        assert sorted(x.Y.disconnected().tolist()) == generating[alone].tolist(), x.name
        quasi = {frozenset(generating[list(p)].tolist()) for p in pairs.tolist() if tuple(p) not in met}
        assert set(map(frozenset, x.Y.quasi_disconnected().tolist())) == quasi, x.name


@each_family
def test_exposed_pairs_in_3d(family):
    """Circles with an arc on the boundary; which of several pairs names one circle is left open."""
    for x in cases(family, 3):
        t = x.truth
        true = t.arcs[t.arcs[:, 2] > 1e-5, :2].astype(int)
        found = x.Y.exposed_pairs()
        ends = x.centers[found]
        for i, j in true:  # some found pair has this circle: its segment is on the found line
            m = t.origin + (t.c[i] + t.c[j]) / 2
            edges = np.arange(2 * len(found)).reshape(-1, 2)
            gap = distance_to_complex([m], ends.reshape(-1, 3), edges)
            assert gap[0] < TOLERANCE * x.size, (x.name, i, j)
        where = {int(original): k for k, original in enumerate(t.index)}
        known = {frozenset(p) for p in t.arcs[:, :2].astype(int).tolist()}
        assert {frozenset((where[i], where[j])) for i, j in found.tolist()} <= known, x.name


def lens(d, a, b):
    """Area and volume of the union of two balls by the textbook formulas for lenses."""
    alpha = np.arccos((d * d + a * a - b * b) / (2 * d * a))
    beta = np.arccos((d * d + b * b - a * a) / (2 * d * b))
    area = (
        np.pi * (a * a + b * b)
        - a * a * (alpha - np.sin(2 * alpha) / 2)
        - b * b * (beta - np.sin(2 * beta) / 2)
    )
    both = np.pi * (a + b - d) ** 2 * (d * d + 2 * d * (a + b) - 3 * (a - b) ** 2) / (12 * d)
    return area, 4 / 3 * np.pi * (a**3 + b**3) - both


@pytest.mark.parametrize(("d", "a", "b"), [(1, 1, 1), (1.5, 1, 0.7), (0.35, 1, 0.7), (1.69, 1, 0.7)])
def test_area_and_volume_of_two_balls(d, a, b):
    area, volume = lens(d, a, b)
    assert psl.Polyball([(5, 1), (5, 1 + d)], [a, b]).area() == pytest.approx(area, rel=1e-10)
    assert psl.Polyball([(5, 1, 0), (5, 1 + d, 0)], [a, b]).volume() == pytest.approx(volume, rel=1e-10)


@each_dimension
@each_family
def test_area_and_volume_by_counting(family, N):
    """20,000 random points in a box: the share inside is known to a few of its standard errors."""
    for x in cases(family, N, 4):
        low, high = (x.centers - x.radii[:, None]).min(axis=0), (x.centers + x.radii[:, None]).max(axis=0)
        inside = x.truth.contains(x.rng.uniform(low, high, (20_000, N))).mean()
        box = np.prod(high - low)
        value = x.Y.area() if N == 2 else x.Y.volume()
        deviation = box * np.sqrt(max(inside * (1 - inside), 1e-4) / 20_000)
        assert abs(value - inside * box) < 5 * deviation, x.name
