"""Appendix A against the truth: skeletons of random polyballs, grown maximal balls, named counterexamples.

`truth.medial` knows no theorem. It grows maximal balls in unions of balls, measures distances to the
boundary and counts holes by brute force; here its answers are compared with the library's, on `PER_FAMILY`
polyballs of each of eleven families in the plane and as many in space.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from truth.cases import BLUNT, PER_FAMILY, TOLERANCE, away, cases, samples_of
from truth.complexes import distance_to_complex, lengths, sample_complex
from truth.medial import Union
from truth.nerves import common_power, components
from truth.polyballs import FAMILIES, random_polyball

import polyskel_lite as psl

each_family = pytest.mark.parametrize("family", range(len(FAMILIES)), ids=[f.__name__ for f in FAMILIES])
each_dimension = pytest.mark.parametrize("N", [2, 3])


def farthest(a, b) -> float:
    """Largest distance from a point of a to the nearest of b."""
    return float(lengths(np.asarray(a)[:, None] - np.asarray(b)).min(axis=1, initial=np.inf).max(initial=0))


def both_ways(a, b) -> float:
    """Hausdorff distance of two finite point sets."""
    return max(farthest(a, b), farthest(b, a))


def hausdorff(one, other, rng):
    """Both directed distances between samples of one skeleton and the whole of the other."""
    return max(away(samples_of(one, rng), other).max(), away(samples_of(other, rng), one).max())


# --- the theorem


def check_complete(truth, skeleton, rng, name=""):
    """Every maximal ball that can be grown has its centre on the skeleton; how many balls were too blunt."""
    m, _, error = truth.medial_points(rng)
    sharp = error <= BLUNT * truth.size
    gap = away(m, skeleton)
    missed = sharp & (gap > TOLERANCE * truth.size + 10 * error)
    assert not missed.any(), (name, m[missed], gap[missed])
    return int((~sharp).sum()), len(m)


def check_medial(truth, skeleton, rng, name=""):
    """Around every point of the skeleton there is a maximal ball; how many points were too blunt."""
    m = samples_of(skeleton, rng)
    growth, error = truth.growth(m)
    wrong = growth > TOLERANCE * truth.size + 10 * error
    assert not wrong.any(), (name, m[wrong], growth[wrong], error[wrong])
    return int((error > BLUNT * truth.size).sum()), len(m)


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
        printed = x.Y.skeleton(statement="as printed")
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
            assert away(m, x.Y.skeleton(statement="as printed")).max() < TOLERANCE * x.size, x.name
            segments += len(part)
    assert segments > 500


def test_as_printed_theorem_3_misses_none():
    assert missed_as_printed(2, 10)[2] == 0


@each_family
def test_as_printed_claims_no_more_in_3d(family):
    """What the printed theorem does give is medial: it is too small, not wrong."""
    for x in cases(family, 3, 5):
        printed = x.Y.skeleton(statement="as printed")
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


# --- named examples


def line_of(*points):
    points = np.array(points, dtype=float)
    edges = np.column_stack([np.arange(len(points) - 1), np.arange(1, len(points))])
    return points, edges


def is_exactly(skeleton, vertices, edges=(), polygons=(), tolerance=1e-12):
    """Whether the skeleton, as a set, is the given complex."""
    rng = np.random.default_rng(0)
    if not len(skeleton.vertices):
        return not len(vertices)
    there = away(sample_complex(rng, vertices, edges, polygons, 10, 20), skeleton).max()
    here = distance_to_complex(
        samples_of(skeleton, rng, per_edge=10, per_polygon=20), vertices, edges, polygons
    )
    return max(there, here.max()) < tolerance


@each_dimension
def test_one_ball(N):
    Y = psl.Polyball([np.arange(1.0, N + 1)], [2])
    skeleton = Y.skeleton()
    assert is_exactly(skeleton, [np.arange(1.0, N + 1)])
    assert skeleton.radii == pytest.approx([2])
    assert skeleton.betti() == (1, 0, 0)[:N]
    assert Y.disconnected().tolist() == [0]
    assert not len(Y.singular_points())
    assert not len(Y.quasi_disconnected())
    assert not len(Y.exposed_pairs())


@each_dimension
def test_two_balls(N):
    """The segment between the centres, no more."""
    centers = np.zeros((2, N))
    centers[1, 0] = 1.2
    Y = psl.Polyball(centers, [1, 0.8])
    assert is_exactly(Y.skeleton(), *line_of(*centers))
    assert Y.quasi_disconnected().tolist() == [[0, 1]]
    assert Y.exposed_pairs().tolist() == [[0, 1]]
    assert not len(Y.disconnected())
    assert len(Y.singular_points()) == (2 if N == 2 else 0)


@each_dimension
def test_coincident_and_swallowed_balls(N):
    """Doubles, a ball in a ball, and one touching from inside change nothing."""
    centers, radii = np.zeros((5, N)), np.array([1, 1, 0.3, 0.5, 1])
    centers[2, 0], centers[3, 1] = 0.2, 0.5
    centers[4, 0] = 1
    Y = psl.Polyball(centers, radii)
    assert is_exactly(Y.skeleton(), *line_of(centers[0], centers[4]))
    assert len(Y.minimal().radii) == 2
    assert sorted(Y.generating().tolist()) in ([0, 4], [1, 4])
    same = psl.Polyball(centers[:2], radii[:2])
    assert is_exactly(same.skeleton(), centers[:1])
    assert len(same.disconnected()) == 1


@each_dimension
def test_a_ball_in_the_union_of_two_others(N):
    centers = np.zeros((3, N))
    centers[:, 0] = 0, 0.5, 1
    Y = psl.Polyball(centers, [1, 0.9, 1])
    # 0.9 is more than the half chord: the ball in the middle shows.
    assert len(Y.minimal().radii) == 3
    Y = psl.Polyball(centers, [1, 0.85, 1])
    assert Y.generating().tolist() == [0, 2]
    assert is_exactly(Y.skeleton(), *line_of(centers[0], centers[2]))


@each_dimension
def test_tiny_and_far(N):
    for offset, scale in ((0, 1e-12), (1e6, 1), (1e-3, 1e-9)):
        centers = np.zeros((2, N)) + offset
        centers[1, 0] += scale
        d = centers[1, 0] - centers[0, 0]
        skeleton = psl.Polyball(centers, [scale, scale]).skeleton()
        assert is_exactly(skeleton, *line_of(*centers), tolerance=1e-6 * d)


def test_hexagon_swallows_its_reflex_sample():
    """Fact 5: Sk2 is not the skeleton of Y_w although the boundary is strictly Gabriel."""
    shape = psl.Shape.from_rings([[(0, 0), (0, 3), (-3, 1), (-2, -2), (1, -2), (3, 0)]])
    assert not len(psl.missing_facets(shape, of="gabriel"))
    Y = psl.delaunay_balls(shape)
    truth = Union(Y.centers, Y.radii)
    reflex = int(np.flatnonzero((shape.points == 0).all(axis=1))[0])
    assert truth.boundary_distance(shape.points)[reflex] == pytest.approx(1, abs=1e-12)
    assert Y.boundary_distance(shape.points)[reflex] == pytest.approx(1, abs=1e-12)
    found = Y.singular_points()
    assert both_ways(found, truth.singular_points()) < 1e-12
    strange = found[lengths(found[:, None] - shape.points).min(axis=1) > 1e-9]
    assert strange == pytest.approx(np.array([[3 / 5, 4 / 5]]))
    skeleton, sk2 = Y.skeleton(), psl.sk2(shape)
    rng = np.random.default_rng(0)
    check_complete(truth, skeleton, rng)
    check_medial(truth, skeleton, rng)
    assert hausdorff(skeleton, sk2, rng) > 0.1
    conditions = psl.sk2_conditions(shape)
    assert conditions.swallowed.tolist() == [reflex]
    assert conditions.extra == pytest.approx(np.array([[3 / 5, 4 / 5]]))
    assert not conditions.hold["a"]
    assert not conditions.hold["b"]


def test_three_discs_may_close_a_point():
    """On three circles and in no open disc, and yet inside: no singular point, no hole."""
    Y = psl.Polyball([(1, 0), (-0.6, 0.8), (-0.6, -0.8)], [1, 1, 1])
    truth = Union(Y.centers, Y.radii)
    assert len(Y.singular_points()) == 3
    assert Y.boundary_distance([(0, 0)])[0] == pytest.approx(truth.boundary_distance([(0, 0)])[0])
    assert Y.boundary_distance([(0, 0)])[0] > 0.5
    assert Y.skeleton().betti() == (1, 0)
    rng = np.random.default_rng(0)
    check_complete(truth, Y.skeleton(), rng)
    check_medial(truth, Y.skeleton(), rng)


def test_four_balls_may_close_a_point():
    centers = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)], dtype=float)
    Y = psl.Polyball(centers, np.full(4, np.sqrt(3)))
    truth = Union(Y.centers, Y.radii)
    assert both_ways(Y.singular_points(), truth.singular_points()) < 1e-9
    assert lengths(Y.singular_points()).min() > 1
    assert Y.boundary_distance([(0, 0, 0)])[0] == pytest.approx(truth.boundary_distance([(0, 0, 0)])[0])
    assert Y.skeleton().betti() == (1, 0, 0)
    rng = np.random.default_rng(0)
    check_complete(truth, Y.skeleton(), rng)
    check_medial(truth, Y.skeleton(), rng)


@each_dimension
@pytest.mark.parametrize("statement", ["corrected", "as printed"])
def test_tangent_balls_are_named(N, statement):
    """Fact 6: the theorems leave them out."""
    centers = np.zeros((3, N))
    centers[1:, 0] = -4, 2
    Y = psl.Polyball(centers, [1, 1, 1])
    with pytest.raises(psl.TangentBallsError) as caught:
        Y.skeleton(statement=statement)
    assert sorted(np.asarray(caught.value.pairs).ravel().tolist()) == [0, 2]
    assert "0" in str(caught.value)
    assert "2" in str(caught.value)
    assert isinstance(caught.value, psl.PolyskelError)


def test_three_unit_balls_on_a_line():
    """Fact 7: as printed the theorem gives nothing, the truth is a segment."""
    Y = psl.Polyball([(0, 0, 0), (0.5, 0, 0), (1, 0, 0)], [1, 1, 1])
    assert len(Y.minimal().radii) == 3
    assert not len(Y.quasi_disconnected())
    assert not len(Y.disconnected())
    assert not len(Y.singular_points())
    printed = Y.skeleton(statement="as printed")
    assert not len(printed.vertices)
    assert not len(printed.edges)
    assert is_exactly(Y.skeleton(), *line_of((0, 0, 0), (0.5, 0, 0), (1, 0, 0)))
    assert sorted(map(sorted, Y.exposed_pairs().tolist())) == [[0, 1], [1, 2]]
    assert Y.skeleton().betti() == (1, 0, 0)


def test_a_circle_partly_on_the_boundary_gives_its_whole_segment():
    """Fact 7. Its arcs end in singular points, so the Voronoi graph has the segment, as printed as well."""
    centers = np.array([(0, 0, 0), (1, 0, 0), (0.5, 0.9, 0)])
    radii = np.array([1, 1, 0.5])
    truth = Union(centers, radii)
    widths = truth.arcs[(truth.arcs[:, :2] == (0, 1)).all(axis=1), 2]
    assert 0.1 < widths.sum() < 2 * np.pi - 0.1
    Y = psl.Polyball(centers, radii)
    along = np.linspace(0, 1, 21)[:, None] * centers[1]
    assert truth.growth(along)[0].max() < 1e-9
    assert away(along, Y.skeleton()).max() < 1e-12
    assert away(along, Y.skeleton(statement="as printed")).max() < 1e-12
    assert [0, 1] in np.sort(Y.exposed_pairs(), axis=1).tolist()


def test_in_the_plane_one_exposed_crossing_is_not_enough():
    """The same balls as discs: the segment leaves the skeleton where the third disc covers a crossing."""
    centers, radii = np.array([(0, 0), (1, 0), (0.5, 0.9)]), np.array([1, 1, 0.5])
    truth, skeleton = Union(centers, radii), psl.Polyball(centers, radii).skeleton()
    middle = np.array([[0.5, 0.0]])
    assert truth.growth(middle)[0][0] > 1e-3
    assert away(middle, skeleton)[0] > 1e-3
    rng = np.random.default_rng(0)
    check_complete(truth, skeleton, rng)
    check_medial(truth, skeleton, rng)


def test_minimal_writing_is_not_unique():
    """Fact 8: a filler without any boundary; its centre is not on the skeleton, and others do as well."""
    discs = [(1.1, 0), (-0.55, 0.9526), (-0.55, -0.9526)]
    Y = psl.Polyball([*discs, (0, 0.05)], [1, 1, 1, 0.3])
    Z = psl.Polyball([*discs, (0.02, 0)], [1, 1, 1, 0.3])
    assert Y.generating().tolist() == Z.generating().tolist() == [0, 1, 2, 3]
    truth = Union(Y.centers, Y.radii)
    queries = np.random.default_rng(0).uniform(-2, 2, (200, 2))
    assert Y.boundary_distance(queries) == pytest.approx(Z.boundary_distance(queries), abs=1e-12)
    rng = np.random.default_rng(0)
    assert hausdorff(Y.skeleton(), Z.skeleton(), rng) < 1e-9
    assert away([(0, 0.05)], Y.skeleton())[0] > 0.01
    check_complete(truth, Y.skeleton(), rng)
    check_medial(truth, Y.skeleton(), rng)
    without = Union(Y.centers[:3], Y.radii[:3])
    assert (truth.betti(), without.betti()) == ((1, 0), (1, 1))


@each_dimension
def test_a_ball_whose_hole_has_its_corners_on_the_sphere_is_needed(N):
    """As in Y_w: the other Delaunay balls pass through N + 1 points of one, and leave a hole between them."""
    if N == 2:
        angle = np.pi * (1 + 2 * np.arange(3)) / 3
        away_from, radius = 2.5 * np.column_stack([np.cos(angle), np.sin(angle)]), np.sqrt(19) / 2
    else:
        directions = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]) / np.sqrt(3)
        away_from, radius = -13 / 3 * directions, np.sqrt(152) / 3
    Y = psl.Polyball(np.concatenate([away_from, np.zeros((1, N))]), np.append(np.full(N + 1, radius), 1))
    truth = Union(Y.centers, Y.radii)
    assert not truth.redundant(N + 1)
    assert Y.generating().tolist() == list(range(N + 2))
    assert not Y.exposed()[N + 1]
    assert Y.skeleton().betti() == truth.betti(1e-9) == (1, 0, 0)[:N]
    rng = np.random.default_rng(0)
    check_complete(truth, Y.skeleton(), rng)
    check_medial(truth, Y.skeleton(), rng)
    missing = Union(away_from, np.full(N + 1, radius))
    assert missing.boundary_distance(np.zeros((1, N)))[0] < 0.4
    assert missing.robust_betti() == ((1, 1) if N == 2 else (1, 0, 1))


def test_a_ring_and_a_hollow_ball():
    angle = np.arange(6) * np.pi / 3
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    skeleton = psl.Polyball(ring, np.full(6, 0.6)).skeleton()
    edges = np.column_stack([np.arange(6), (np.arange(6) + 1) % 6])
    assert is_exactly(skeleton, ring, edges, tolerance=1e-9)
    assert skeleton.betti() == (1, 1)
    corners = np.array(list(np.ndindex(2, 2, 2))) * 2.0 - 1
    faces = np.concatenate([np.eye(3), -np.eye(3)]) * 1.4
    centers, radii = np.concatenate([corners, faces]), np.concatenate([np.full(8, 1.1), np.full(6, 1.2)])
    truth = Union(centers, radii)
    assert truth.robust_betti() == (1, 0, 1)
    skeleton = psl.Polyball(centers, radii).skeleton()
    assert skeleton.betti() == (1, 0, 1)
    rng = np.random.default_rng(0)
    check_complete(truth, skeleton, rng)
    check_medial(truth, skeleton, rng)


def test_a_tunnel_that_closes_in_one_point():
    """Three spheres touch one line in one point: the skeleton keeps the loop that the interior has."""
    angle = np.arange(3) * 2 * np.pi / 3
    centers = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(3)])
    for radius, betti in ((0.95, (1, 1, 0)), (1.05, (1, 0, 0))):
        Y = psl.Polyball(centers, np.full(3, radius))
        assert Y.skeleton().betti() == Union(Y.centers, Y.radii).robust_betti() == betti
    truth, skeleton = Union(centers, np.ones(3)), psl.Polyball(centers, np.ones(3)).skeleton()
    assert is_exactly(skeleton, centers, [(0, 1), (1, 2), (2, 0)], tolerance=1e-7)
    assert truth.robust_betti() is None


# --- the oracle itself


def test_oracle_by_hand():
    """Distances and maximal balls that can be worked out on paper."""
    one = Union([(3.0, 4.0)], [2.0])
    assert one.boundary_distance([(3, 4), (3, 5), (3, 9)]) == pytest.approx([2, 1, 3])
    m, t, _ = one.medial_points(np.random.default_rng(0))
    assert lengths(m - (3, 4)).max() < 1e-9
    assert t == pytest.approx(np.full(len(t), 2.0))
    two = Union([(0, 0), (1, 0)], [1, 1])
    assert two.boundary_distance([(0.5, 0), (0, 0), (0.5, 0.5)]) == pytest.approx(
        [np.sqrt(0.75), 1, np.sqrt(0.75) - 0.5]
    )
    m, _, error = two.medial_points(np.random.default_rng(0))
    assert (distance_to_complex(m, *line_of((0, 0), (1, 0))) < 1e-12 + error).all()
    assert np.median(error) < 1e-9
    growth, _ = two.growth([(0.5, 0), (0, 0), (0.3, 0), (-0.1, 0), (0.5, 0.1), (5, 0)])
    assert growth[:3].max() < 1e-9
    assert growth[3] == pytest.approx(0.1)
    assert growth[4] > 0.05
    assert growth[5] == np.inf
    line = Union([(0, 0, 0), (0.5, 0, 0), (1, 0, 0)], [1, 1, 1])
    assert line.boundary_distance([(0.25, 0, 0), (0.5, 0, 0)]) == pytest.approx([np.sqrt(15 / 16), 1])
    assert line.growth([(0.25, 0, 0), (0.9, 0, 0), (1, 0, 0)])[0].max() < 1e-9
    assert line.growth([(1.1, 0, 0), (0.5, 0.01, 0)])[0].min() > 1e-3
    assert line.betti() == (1, 0, 0)


def test_oracle_distance_against_dense_points():
    rng = np.random.default_rng(5)
    for number in range(40):
        _, c, r = random_polyball(number, 2)
        truth = Union(c, r)
        angle = np.linspace(0, 2 * np.pi, 2000)
        points = (c[:, None] + r[:, None, None] * np.column_stack([np.cos(angle), np.sin(angle)])).reshape(
            -1, 2
        )
        inside = (lengths(points[:, None] - c) - r < -1e-9).any(axis=1)
        queries = rng.uniform((c - r[:, None]).min(axis=0), (c + r[:, None]).max(axis=0), (30, 2))
        dense = lengths(queries[:, None] - points[~inside]).min(axis=1)
        distance = truth.boundary_distance(queries)
        assert (distance < dense + 1e-6 * truth.size).all()
        assert (distance > dense - 4e-3 * r.max()).all()


def test_oracle_point_to_complex():
    square = np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (1, 0.5, 0), (0, 2, 0)], dtype=float)  # not convex
    polygon = [np.arange(5)]
    points = [(1, 0.2, 1), (1, 1.5, 0), (3, 0, 0), (0.2, 0.5, -2)]
    expected = [1, distance_to_complex([(1, 1.5, 0)], square, [(2, 3), (3, 4)])[0], 1, 2]
    assert distance_to_complex(points, square, (), polygon) == pytest.approx(expected)
    assert expected[1] > 0.3


def test_oracle_betti():
    angle = np.arange(6) * np.pi / 3
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    assert Union(ring, np.full(6, 0.6)).betti() == (1, 1)
    assert Union(ring, np.full(6, 0.4)).betti() == (6, 0)
    assert Union(ring, np.full(6, 1.01)).betti() == (1, 0)
    assert components(3, np.array([[0, 1]])) == 2
