"""Drawing in the plane: what is in the data is in the picture, functions return their axes."""

from __future__ import annotations

import itertools

import matplotlib
import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import drawing

POINTS = np.array([(0, 0), (4, 0), (5, 3), (2, 4), (-1, 2), (2, 1.5)], dtype=float)
POINTS_3D = np.array([(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2), (2, 2, 3), (0.7, 0.6, 0.5)])


def segment_count(collection) -> int:
    return sum(len(path) - 1 for path in collection.get_segments())


def colors_at(ax, points) -> list[tuple[int, ...]]:
    """The colours of the rendered picture at points of the plane."""
    ax.figure.canvas.draw()
    pixels = np.asarray(ax.figure.canvas.buffer_rgba())
    columns, rows = ax.transData.transform(points).astype(int).T
    return [tuple(color.tolist()) for color in pixels[len(pixels) - 1 - rows, columns, :3]]


def drawn_points(ax) -> int:
    return sum(len(line.get_xdata()) for line in ax.lines)


def test_shape_is_one_path_with_open_holes(ax, frame):
    assert drawing.draw_shape(ax, frame) is ax
    (patch,) = ax.patches
    drawing.focus(ax, [(-1, -1), (7, 7)])
    fill = tuple(int(c, 16) for c in ("EE", "EE", "EE"))
    assert [color == fill for color in colors_at(ax, [(1, 1), (3, 3), (6.5, 6.5)])] == [True, False, False]
    closed = sum(len(ring) + 1 for ring in frame.rings())
    assert len(patch.get_path().vertices) == closed


def test_shape_accepts_one_ring_and_lists_of_rings(ax):
    drawing.draw_shape(ax, [(0, 0), (1, 0), (0, 1)])
    drawing.draw_shape(ax, [np.array([(0, 0), (1, 0), (0, 1)])], fill=False)
    assert [len(patch.get_path().vertices) for patch in ax.patches] == [4, 4]
    assert ax.patches[1].get_facecolor()[3] == 0


def test_samples_are_all_drawn(ax, frame):
    assert drawing.draw_samples(ax, POINTS) is ax
    drawing.draw_samples(ax, frame)
    assert drawn_points(ax) == len(POINTS) + len(frame.points)


def test_delaunay_edges_and_inner_triangles(ax, frame):
    P = psl.delaunay_shape(frame)
    assert drawing.draw_delaunay(ax, P) is ax
    triangles, edges = ax.collections
    assert len(triangles.get_paths()) == P.inner.sum()
    assert segment_count(edges) == len(P.tessellation.edges())


def test_delaunay_without_outer_edges(ax, frame):
    P = psl.delaunay_shape(frame)
    drawing.draw_delaunay(ax, P, edges=False)
    inner = P.tessellation.simplices[P.inner]
    expected = {tuple(sorted(pair)) for t in inner.tolist() for pair in itertools.combinations(t, 2)}
    assert segment_count(ax.collections[1]) == len(expected)


def test_voronoi_edges_and_rays_are_framed_by_the_samples(ax):
    # Nearly collinear samples: their Voronoi vertex is ten million away.
    points = np.vstack([POINTS, [(2, 1e-7)]])
    graph = psl.voronoi(points)
    assert np.abs(graph.vertices).max() > 1e6
    assert drawing.draw_voronoi(ax, graph) is ax
    box = drawing.box_of(points)
    ends = np.concatenate(ax.collections[0].get_segments())
    assert (ends >= box[0] - 1e-6).all()
    assert (ends <= box[1] + 1e-6).all()
    assert np.ptp(ax.get_xlim()) < 2 * np.ptp(points[:, 0])


def test_voronoi_of_one_triangle_is_three_rays(ax):
    drawing.draw_voronoi(ax, psl.voronoi([(0, 0), (2, 0), (1, 2)]))
    assert segment_count(ax.collections[0]) == 3


def test_gabriel_edges(ax):
    assert drawing.draw_gabriel(ax, POINTS) is ax
    assert segment_count(ax.collections[0]) == len(psl.gabriel(POINTS))
    drawing.draw_gabriel(ax, POINTS, edges=[(0, 1)])
    assert segment_count(ax.collections[1]) == 1


@pytest.mark.parametrize("kind", ["sk0", "sk2", "sk3"])
def test_skeleton_edges(ax, frame, kind):
    skeleton = getattr(psl, kind)(frame)
    assert len(skeleton.edges) > 0
    assert drawing.draw_skeleton(ax, skeleton, kind=kind) is ax
    assert segment_count(ax.collections[0]) == len(skeleton.edges)
    assert drawn_points(ax) == 0
    assert matplotlib.colors.to_hex(ax.collections[0].get_color()[0]).upper() == drawing.KINDS[kind].color


def test_skeleton_of_vertices_only_is_drawn_as_dots(ax, frame):
    skeleton = psl.sk1(frame)
    drawing.draw_skeleton(ax, skeleton, kind="sk1")
    assert drawn_points(ax) == len(skeleton.vertices)


def test_outer_skeleton_is_cut_to_the_samples_box(ax):
    cross = [(1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (2, 2), (2, 3), (1, 3), (1, 2), (0, 2), (0, 1), (1, 1)]
    outer = psl.sk0(psl.conform(psl.Shape.from_rings([cross])), side="outer")
    assert len(outer.rays) == 4
    drawing.draw_skeleton(ax, outer, kind="complement")
    box = drawing.box_of(cross)
    ends = np.concatenate(ax.collections[0].get_segments())
    # The rays, out of the four notches, end at the box.
    assert np.allclose(ends.min(axis=0), box[0])
    assert np.allclose(ends.max(axis=0), box[1])


def test_skeleton_refuses_three_coordinates(ax):
    with pytest.raises(psl.InputError, match="3 coordinates"):
        drawing.draw_skeleton(ax, psl.voronoi(POINTS_3D))


def test_style_given_by_the_caller_wins(ax, frame):
    drawing.draw_skeleton(ax, psl.sk0(frame), color="#123456", linewidth=3)
    lines = ax.collections[0]
    assert matplotlib.colors.to_hex(lines.get_color()[0]) == "#123456"
    assert lines.get_linewidth()[0] == 3


def test_nothing_in_drawing_prints(ax, frame, capsys):
    drawing.legend(drawing.draw_skeleton(drawing.draw_shape(ax, frame), psl.sk0(frame)), "shape", "sk0")
    assert capsys.readouterr().out == ""
