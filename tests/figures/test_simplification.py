"""Figures 6 to 10 show what their captions say."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import figures
from polyskel_lite.figures import removals, solids
from polyskel_lite.simplification import behind, facet_measures, simplices_by_type, ways


def without(P, row):
    inner = P.inner.copy()
    inner[row] = False
    return psl.DelaunayShape(P.tessellation, inner)


def test_figure_6_upper_row_can_go_and_lower_row_cannot():
    shared, kept = [], []
    for P, row in removals.examples_6():
        assert P.inner[row]
        shared.append(int(simplices_by_type(P)[row]))
        kept.append(psl.sk0(without(P, row)).betti() == psl.sk0(P).betti())
    assert shared == [1, 1, 2, 2, 2, 3]
    assert kept == [True, True, True, False, False, False]


def test_figure_6_says_what_goes_wrong():
    """Two panels are cut in two, the last one gets a tunnel."""
    after = [psl.sk0(without(P, row)).betti() for P, row in removals.examples_6()[3:]]
    assert after == [(2, 0), (2, 0, 0), (1, 1, 0)]


def test_figure_6_wants_six_examples():
    with pytest.raises(psl.InputError, match="six panels"):
        figures.figure_6(removals.examples_6()[:5])


def test_figure_7_counts():
    """A hat takes one vertex and one edge, a salient one vertex, two edges and one polygon."""
    lost = []
    for P, row in removals.examples_7():
        before, after = psl.sk0(P), psl.sk0(without(P, row))
        assert after.betti() == before.betti()
        lost.append(
            (
                len(before.vertices) - len(after.vertices),
                len(before.edges) - len(after.edges),
                len(before.polygons) - len(after.polygons),
            )
        )
    assert lost == [(1, 1, 0), (1, 1, 0), (1, 2, 1)]


def test_figure_8_is_the_leaf_of_1308_points():
    leaf = psl.datasets.load("leaf")
    assert len(leaf.points) == 1308
    assert len(figures.figure_8().axes) == 6


def test_figure_9_shows_all_that_must_go_first():
    """A(v) has the boundary length p(v), hangs on the rest by one side, and v is the last of it to go."""
    h = psl.hierarchy(psl.datasets.load("horse", n=160))
    skeleton, t = psl.sk0(h.P), h.P.tessellation
    vertex = int(np.argmin(np.linalg.norm(skeleton.vertices - (0.19, 0.19), axis=1)))
    members = behind(h, vertex)
    assert members[-1] == vertex
    assert 10 < len(members) < 50
    rows = h.simplices[members]
    part = np.zeros_like(h.P.inner)
    part[rows] = True
    crossing = np.append(part, False)[t.facet_table[1]]
    open_side = np.append(h.P.inner & ~part, False)[t.facet_table[1]]
    assert ((crossing.any(axis=1)) & open_side.any(axis=1)).sum() == 1
    outside = ~np.append(h.P.inner, False)[t.neighbors[rows]]
    p = facet_measures(t)[rows][outside].sum()
    # The level is the largest p/r in A(v), and in a neck it is that of v or of something before it.
    assert h.level[vertex] >= p / skeleton.radii[vertex] * (1 - 1e-12)


def test_parents_are_where_boundary_is_handed_to():
    """p(v) summed over A(v) is p(v) passed on from hat to hat, for every vertex of a shape with holes."""
    h = psl.hierarchy(psl.datasets.load("gear"))
    t = h.P.tessellation
    outside = ~np.append(h.P.inner, False)[t.neighbors[h.simplices]]
    own = np.where(outside, facet_measures(t)[h.simplices], 0).sum(axis=1)
    passed, towards = own.copy(), ways(h).heir
    for k in h.order:
        passed[towards[k]] += passed[k]
    for k in h.order[::7]:
        assert own[behind(h, k)].sum() == pytest.approx(passed[k])
    assert (towards >= 0).sum() == len(h.order)


def test_region_names_simplices_that_are_not_delaunay():
    with pytest.raises(ValueError, match="1 of 1 simplices are not Delaunay"):
        solids.region([(0, 0), (4, 0), (2, 1), (2, -1)], [(0, 1, 2)])


def test_figure_10_names_its_columns_and_counts_branches():
    pod = psl.implicit.solid(psl.implicit.tetrapod(), n=300)
    figure = figures.figure_10({"tetrapod": pod, "again": psl.delaunay_shape(pod)})
    words = [text.get_text() for ax in figure.axes for text in ax.texts]
    assert len(figure.axes) == 10
    assert f"tetrapod, {len(pod.points)} samples" in words
    assert words.count("4 branches") == 2
