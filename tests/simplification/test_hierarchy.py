"""Section 4: removals keep the topology, and one pass gives every threshold."""

import numpy as np
import pytest
from truth.solids import random_region

import polyskel_lite as psl
from polyskel_lite.simplification import collapse
from polyskel_lite.simplification.criteria import face_angles, facet_measures

STRATEGIES = {2: ["branch"], 3: ["surface", "wireframe"]}


def direct_run(P, strategy, threshold):
    """The paper's process at one threshold, as it is written: slow, with no heap and no memory."""
    t = P.tessellation
    size = t.dimension + 1
    alive, measure = P.inner.copy(), facet_measures(t)
    angles = face_angles(t) if t.dimension == 3 else None
    share = np.where(np.append(alive, False)[t.neighbors], 0.0, measure).sum(axis=1)
    pairs = {(0, 1): 0, (0, 2): 1, (0, 3): 2, (1, 2): 3, (1, 3): 4, (2, 3): 5}

    def surrounds(v, a, b):
        edge = {int(t.simplices[v, a]), int(t.simplices[v, b])}
        around = [s for s in range(len(alive)) if edge <= set(t.simplices[s].tolist())]
        hull = any(t.neighbors[s, i] < 0 and t.simplices[s, i] not in edge for s in around for i in range(4))
        return all(alive[s] for s in around) and not hull

    while True:
        best = None
        for v in np.flatnonzero(alive).tolist():
            inner = [i for i in range(size) if t.neighbors[v, i] >= 0 and alive[t.neighbors[v, i]]]
            outer = tuple(i for i in range(size) if i not in inner)
            if len(inner) == 1:
                value = {
                    "branch": share[v] / t.circumradii[v],
                    "surface": -np.inf,
                    "wireframe": share[v] / t.circumradii[v] / t.circumradii[v],
                }[strategy]
            elif len(inner) == 2 and size == 4 and surrounds(v, *outer):
                value = angles[v, pairs[outer]] if strategy == "surface" else -np.inf
            else:
                continue
            if value < threshold:
                best = min(best or (np.inf, 0, 0, ()), (value, t.circumradii[v], v, tuple(inner)))
        if best is None:
            return alive
        _, _, v, inner = best
        alive[v] = False
        for i in inner:
            share[t.neighbors[v, i]] += share[v] / len(inner)


@pytest.mark.parametrize("strategy", ["branch", "surface", "wireframe"])
@pytest.mark.parametrize("seed", range(6))
def test_hierarchy_is_the_direct_run_at_every_threshold(strategy, seed):
    P = random_region(seed, n=2 if strategy == "branch" else 3, points=40 if strategy == "branch" else 18)
    h = psl.hierarchy(P, strategy)
    finite = h.level[np.isfinite(h.level)]
    thresholds = [0.0, *np.unique(finite)[:: max(1, len(np.unique(finite)) // 5)], 1.0, np.pi, 100.0]
    for threshold in thresholds:
        assert (h.kept(threshold) == direct_run(P, strategy, threshold)).all()


@pytest.mark.parametrize("strategy", ["branch", "surface", "wireframe"])
@pytest.mark.parametrize("seed", range(10))
def test_betti_numbers_of_the_dual_stay(strategy, seed):
    P = random_region(seed, n=2 if strategy == "branch" else 3, points=150)
    h = psl.hierarchy(P, strategy)
    expected = psl.sk0(P).betti()
    for threshold in [-np.inf, *np.quantile(h.level[np.isfinite(h.level)], np.linspace(0, 1, 8)), np.inf]:
        assert h.skeleton(threshold).betti() == expected


def test_betti_numbers_after_every_single_removal():
    P = random_region(3, n=3, points=30)
    h = psl.hierarchy(P, "surface")
    expected = psl.sk0(P).betti()
    alive = P.inner.copy()
    for position in h.order:
        alive[h.simplices[position]] = False
        assert psl.sk0(psl.DelaunayShape(P.tessellation, alive)).betti() == expected


@pytest.mark.parametrize("name", ["horse", "leaf", "lake", "hawaii", "gear"])
def test_outlines_keep_shape_and_skeleton_topology(name):
    shape = psl.datasets.load(name)
    h = psl.hierarchy(shape)
    for threshold in np.linspace(0, 4 * np.pi, 12):
        assert h.shape(threshold).betti() == h.skeleton(threshold).betti() == shape.betti()


@pytest.mark.parametrize("strategy", ["branch", "surface", "wireframe"])
def test_compiled_and_plain_loops_agree(strategy):
    t = random_region(5, n=2 if strategy == "branch" else 3, points=200).tessellation
    values = face_angles(t) if strategy == "surface" else facet_measures(t)
    arguments = (strategy, False, t.simplices, t.neighbors, values, t.circumradii)
    pytest.importorskip("numba")
    for a, b in zip(
        collapse.run(*arguments, compiled=True), collapse.run(*arguments, compiled=False), strict=True
    ):
        assert np.array_equal(a, b)


@pytest.mark.parametrize("strategy", ["branch", "surface", "wireframe"])
def test_names_of_the_points_do_not_matter(strategy):
    n = 2 if strategy == "branch" else 3
    P = random_region(8, n=n, points=120)
    new = np.random.default_rng(0).permutation(120)
    other = psl.delaunay(P.tessellation.points[np.argsort(new)])
    inner = {frozenset(new[s].tolist()) for s in P.tessellation.simplices[P.inner]}
    Q = psl.DelaunayShape(other, np.array([frozenset(s) in inner for s in other.simplices.tolist()]))
    assert Q.inner.sum() == P.inner.sum()

    def levels(h, rename):
        rows = h.P.tessellation.simplices[h.simplices]
        return {frozenset(rename[s].tolist()): level for s, level in zip(rows, h.level.tolist(), strict=True)}

    a = levels(psl.hierarchy(P, strategy), new)
    b = levels(psl.hierarchy(Q, strategy), np.arange(120))
    assert a.keys() == b.keys()
    # The corners of a simplex come in another order, which rounds areas and radii differently.
    assert all(a[s] == b[s] or a[s] == pytest.approx(b[s], rel=1e-9) for s in a)


@pytest.mark.parametrize("strategy", ["branch", "surface", "wireframe"])
@pytest.mark.parametrize("scale", [2.0**-20, 2.0**20])
def test_size_does_not_matter(strategy, scale):
    P = random_region(9, n=2 if strategy == "branch" else 3, points=120)
    Q = psl.DelaunayShape(psl.delaunay(P.tessellation.points * scale), P.inner)
    assert np.allclose(psl.hierarchy(P, strategy).level, psl.hierarchy(Q, strategy).level, rtol=1e-12)


def test_size_matters_as_printed_in_3d():
    P = random_region(9, n=3, points=120)
    Q = psl.DelaunayShape(psl.delaunay(P.tessellation.points * 2.0**10), P.inner)
    a, b = (psl.hierarchy(S, "wireframe", criterion="transcript").level for S in (P, Q))
    finite = np.isfinite(a) & np.isfinite(b) & (a > 0)
    assert not np.allclose(a[finite], b[finite])


def test_area_is_handed_on_completely():
    """With k the neighbours still there, the total of p(v) stays what it was: the boundary's area."""
    P = random_region(4, n=3, points=100)
    t, inner = P.tessellation, np.flatnonzero(P.inner)
    number = np.append(np.where(P.inner, np.cumsum(P.inner) - 1, -1), -1)
    neighbors, measure = number[t.neighbors[inner]], facet_measures(t, inner)
    total = measure[neighbors < 0].sum()
    for printed in (False, True):
        level, kind, _, share = collapse.run(
            "wireframe", printed, t.simplices[inner], neighbors, measure, t.circumradii[inner]
        )
        assert (kind == 1).any()
        # Sums of a thousand areas of size one hundredth, in another order.
        assert (share[level == np.inf].sum() == pytest.approx(total, rel=1e-9)) != printed


def test_the_hexagon_strip_by_hand():
    """Two right isosceles triangles: each has p = 2 and r = 1/sqrt 2; the smaller radius goes, one stays."""
    t = psl.delaunay([(0, 0), (1, 0), (1, 1), (0, 1)])
    h = psl.hierarchy(psl.DelaunayShape(t, np.array([True, True])))
    assert sorted(h.level.tolist()) == [pytest.approx(2 * np.sqrt(2)), np.inf]
    printed = psl.hierarchy(psl.DelaunayShape(t, np.array([True, True])), criterion="transcript")
    assert min(printed.level) == pytest.approx(2 * np.sqrt(2) + 2)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"strategy": "branches"}, "unknown strategy 'branches'"),
        ({"strategy": "surface"}, "not for 2D shapes; choose branch"),
        ({"criterion": "raw"}, "unknown criterion 'raw'"),
    ],
)
def test_bad_names(arguments, message):
    with pytest.raises(psl.InputError, match=message):
        psl.hierarchy(psl.datasets.load("gear"), **arguments)


@pytest.mark.parametrize("threshold", [np.nan, "pi", None])
def test_threshold_must_be_a_number(threshold):
    with pytest.raises(psl.InputError, match="not a number"):
        psl.hierarchy(psl.datasets.load("gear")).skeleton(threshold)


def test_branches_of_a_tree_and_a_loop():
    h = psl.hierarchy(psl.datasets.load("gear"))
    graph = h.branches(np.inf)
    # Simplified for good, only the loop around the hole is left: one closed branch.
    assert [kind for _, kind in graph.nodes(data="kind")] == ["loop"]
    assert graph.number_of_edges() == 1
    full = psl.branch_graph(psl.sk0(h.P))
    assert sum(length for _, _, length in full.edges(data="length")) == pytest.approx(psl.sk0(h.P).length())
    assert full.number_of_edges() - full.number_of_nodes() + 1 == 1


def test_branches_along_their_edges():
    skeleton = psl.hierarchy(psl.datasets.load("horse")).skeleton(np.pi)
    edges = {frozenset(edge) for edge in skeleton.edges.tolist()}
    graph = psl.branch_graph(skeleton)
    for a, b, data in graph.edges(data=True):
        assert {data["path"][0], data["path"][-1]} == {a, b}
        assert all(frozenset(pair) in edges for pair in zip(data["path"], data["path"][1:], strict=False))
        assert data["radii"] == skeleton.radii[data["path"]].tolist()
    assert sum(len(data["path"]) - 1 for _, _, data in graph.edges(data=True)) == len(edges)


@pytest.mark.parametrize("exponent", [-900, -300, -201, -200, 7, 200, 201, 300])
def test_a_power_of_two_changes_no_bit(exponent):
    flat, solid = psl.datasets.load("horse", n=60), psl.implicit.solid(psl.implicit.torus(), n=200)
    for shape, strategies in ((flat, ["branch"]), (solid, ["surface", "wireframe"])):
        P = psl.delaunay_shape(psl.conform(shape))
        t = P.tessellation
        scaled = psl.Tessellation(np.ldexp(t.points, exponent), t.simplices, t.neighbors)
        for strategy in strategies:
            h, same = psl.hierarchy(P, strategy), psl.hierarchy(psl.DelaunayShape(scaled, P.inner), strategy)
            assert (h.level == same.level).all()
            assert (h.order == same.order).all()
        if abs(exponent) <= 300:
            assert (np.ldexp(t.circumradii, exponent) == scaled.circumradii).all()


@pytest.mark.parametrize("scale", [1e80, 1e-80, 1e100, 1e-100])
def test_other_scales_change_nothing_but_rounding(scale):
    P = psl.delaunay(np.random.default_rng(3).normal(size=(12, 3)))
    every = np.ones(len(P.simplices), dtype=bool)
    scaled = psl.delaunay(P.points * scale)
    for strategy in ("surface", "wireframe"):
        level = psl.hierarchy(psl.DelaunayShape(P, every), strategy).level
        same = psl.hierarchy(psl.DelaunayShape(scaled, every), strategy).level
        assert same == pytest.approx(level, rel=1e-6)
