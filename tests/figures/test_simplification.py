"""Figures 6 to 10 show what their captions say."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import drawing, figures
from polyskel_lite.drawing import view
from polyskel_lite.figures import removals, results, solids
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


def test_figure_7_leaves_a_sheet():
    """After the salient tetrahedron has gone there is still a polygon to be seen."""
    P, row = removals.examples_7()[2]
    assert [len(p) for p in psl.sk0(P).polygons] == [5, 5]
    assert [len(p) for p in psl.sk0(without(P, row)).polygons] == [5]


def test_figure_6_is_seen_whole_and_through():
    """No piece is outside its panel, and one looks along the tunnel, through a plug that is drawn clear."""
    figure = figures.figure_6()
    for k, (P, _) in enumerate(removals.examples_6()):
        if P.dimension == 3:
            spread = 0.6 if k == 5 else 0.9
            low, high = view.seen_between(figure.axes[k], solids.moved_apart(P, spread).reshape(-1, 3))
            corner, size = np.array([k % 3 / 3 * 7, (1 - k // 3) * 2.2]), np.array([7 / 3, 2.2])
            assert (low > corner).all()
            assert (high < corner + size).all()
    P, row = removals.examples_6()[5]
    corners = P.tessellation.points[P.tessellation.simplices]
    axis = corners[row].mean(axis=0) - corners[P.inner].mean(axis=(0, 1))
    assert np.allclose(drawing.view_direction(figure.axes[5]), axis / np.linalg.norm(axis))
    assert (figure.axes[5].collections[0].get_facecolor()[:, 3] < 0.5).sum() == 4


def test_figure_8_is_the_leaf_of_1308_points():
    leaf = psl.datasets.load("leaf")
    assert len(leaf.points) == 1308
    figure = figures.figure_8()
    assert len(figure.axes) == 6
    told = [text.get_text().split("= ")[1] for ax in figure.axes for text in ax.texts]
    assert told == [text.get_text() for text in figure.legends[0].get_texts()] == ["0", "π/2", "π", "2π"]


def test_figure_9_is_full_and_its_words_stand_clear():
    """What the picture is about takes two thirds of its height, and no word stands on a line."""
    figure = figures.figure_9()
    (ax,) = figure.axes
    figure.canvas.draw()
    rim = max((c for c in ax.collections), key=lambda c: c.get_linewidths()[0])
    height = np.ptp(np.concatenate(rim.get_segments())[:, 1])
    assert height > 0.6 * np.ptp(ax.get_ylim())
    skeleton = psl.sk0(psl.datasets.load("horse", n=160))
    lines = skeleton.segments()
    dots = np.concatenate([lines[:, 0] + s * (lines[:, 1] - lines[:, 0]) for s in np.linspace(0, 1, 20)])
    dots = ax.transData.transform(dots)
    assert sorted(text.get_text() for text in ax.texts) == ["$A(v)$", "$p(v)$", "$r(v)$", "$v$"]
    for text in ax.texts:
        box = text.get_window_extent()
        assert not box.count_contains(dots), text


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
    assert len(figure.axes) == 11  # ten panels, and the scale of colours
    assert f"tetrapod\n{len(pod.points)} samples" in words
    assert words.count("4 branches") == 2
    assert {"shape", "samples", "$Sk_0$"} <= set(words)
    assert figure.axes[10].get_xlabel().startswith("radius")
    rings = [line for ax in figure.axes[8:10] for line in ax.lines]
    assert [len(line.get_data_3d()[0]) for line in rings] == [4, 4]


def test_figure_10_shows_all_four_arms():
    """From the camera no arm is seen shorter than 85 % of its length, and no two are within 75 degrees."""
    shape = psl.datasets.load("fourbranch")
    wires = psl.hierarchy(shape, "wireframe").skeleton(2 * np.pi)
    graph = psl.branch_graph(wires)
    tips = np.array([graph.nodes[v]["pos"] for v, kind in graph.nodes(data="kind") if kind == "end"])
    _, ax = drawing.axes_3d()
    ax.view_init(**results.CAMERAS["fourbranch"])
    arms = tips - tips.mean(axis=0)
    towards = drawing.view_direction(ax)
    flat = arms - np.outer(arms @ towards, towards)
    seen = np.linalg.norm(flat, axis=1)
    assert (seen / np.linalg.norm(arms, axis=1)).min() > 0.85
    cosines = (flat / seen[:, None]) @ (flat / seen[:, None]).T
    assert np.degrees(np.arccos(cosines[np.triu_indices(4, 1)])).min() > 75
