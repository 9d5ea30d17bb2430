"""Space: shading, tessellations, glass, skeletons before and behind it."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from mpl_toolkits.mplot3d import proj3d

import polyskel_lite as psl
from polyskel_lite import drawing
from polyskel_lite.drawing import view

POINTS_3D = np.array([(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2), (2, 2, 3), (0.7, 0.6, 0.5)])


def test_facets_in_space_are_shaded_alike_from_both_sides(ax3):
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    assert drawing.draw_facets_3d(ax3, points, [(0, 1, 2), (0, 2, 1), (0, 1, 3)]) is ax3
    colors = ax3.collections[0].get_facecolor()
    assert len(colors) == 3
    assert np.allclose(colors[0], colors[1])
    assert not np.allclose(colors[0], colors[2])


def test_tessellation_in_space(ax3):
    t = psl.delaunay(POINTS_3D)
    assert drawing.draw_tessellation_3d(ax3, t, spread=0.5) is ax3
    assert len(ax3.collections[0].get_facecolor()) == 4 * len(t.simplices)


def test_voronoi_in_space_is_cut_to_the_box(ax3):
    graph = psl.voronoi(POINTS_3D)
    box = np.array([(-100.0, -100, -100), (100, 100, 100)])
    assert drawing.draw_voronoi_3d(ax3, graph, box=box) is ax3
    (lines,) = ax3.collections
    assert len(lines._segments3d) == len(graph.edges) + len(graph.rays)
    assert np.abs(np.array(lines._segments3d)).max() <= 100 + 1e-9


def test_mesh_sets_the_view(ax3):
    mesh = SimpleNamespace(points=POINTS_3D[:4], facets=[(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    assert drawing.draw_mesh(ax3, mesh) is ax3
    assert len(ax3.collections[0].get_facecolor()) == 4
    assert ax3.get_zlim() == (0, 2)


@pytest.mark.parametrize("vertical", ["x", "y", "z"])
def test_view_direction_is_where_matplotlib_looks_from(ax3, vertical):
    ax3.view_init(elev=25, azim=40, vertical_axis=vertical)
    drawing.focus_3d(ax3, np.array([(0, 0, 0), (1, 1, 1)]))
    # Whoever walks from the middle towards the camera stays where he is in the picture.
    middle, nearer = np.full(3, 0.5), 0.5 + 0.1 * drawing.view_direction(ax3)
    (x, y, _), (u, v, _) = (proj3d.proj_transform(*point, ax3.get_proj()) for point in (middle, nearer))
    assert (u, v) == pytest.approx((x, y), abs=1e-9)


def test_glass_has_its_near_faces_over_the_skeleton_and_its_far_faces_under(ax3, slab):
    drawing.draw_glass(ax3, slab)
    back, front = ax3.collections
    assert len(back.get_facecolor()) + len(front.get_facecolor()) == len(slab.boundary())
    assert back.get_zorder() < drawing.KINDS["sk0"].zorder < front.get_zorder()


def test_glass_takes_meshes(ax3):
    points = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
    mesh = SimpleNamespace(points=points, facets=[(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    drawing.draw_glass(ax3, mesh)
    assert sum(len(layer.get_facecolor()) for layer in ax3.collections) == 4


def test_skeleton_in_space_leaves_out_what_is_far_away(ax3, slab):
    skeleton = psl.sk0(slab)
    low, high = drawing.box_of(slab.tessellation, margin=0.02)
    seen = ((skeleton.vertices >= low) & (skeleton.vertices <= high)).all(axis=1)
    drawing.draw_skeleton_3d(ax3, skeleton, wires="all")
    polygons, edges = ax3.collections
    assert 0 < len(polygons.get_facecolor()) == sum(seen[p].all() for p in skeleton.polygons)
    assert len(edges.get_color()) == seen[skeleton.edges].all(axis=1).sum() < len(skeleton.edges)


def test_skeleton_in_space_is_coloured_by_values(ax3, slab):
    """One value everywhere: polygons differ in brightness only, wires not at all."""
    skeleton = psl.sk0(slab)
    values = np.full(len(skeleton.vertices), 3.0)
    drawing.draw_skeleton_3d(ax3, skeleton, values=values, limits=(0, 3), wires="all")
    faces, wires = ax3.collections[0].get_facecolor(), ax3.collections[1].get_color()
    assert np.allclose(np.asarray(wires)[:, :3], drawing.RAMP(1.0)[:3])
    shades = faces[:, :3] / drawing.RAMP(1.0)[:3]
    assert np.allclose(shades, shades[:, :1])
    assert 0.6 < shades.min() < shades.max() <= 1


def test_skeleton_in_space_without_wires(ax3, slab):
    skeleton = psl.hierarchy(slab, "wireframe").skeleton(1.0)
    drawing.draw_skeleton_3d(ax3, skeleton, wires="none")
    assert len(ax3.collections) == (len(skeleton.polygons) > 0)
    with pytest.raises(psl.InputError, match="free"):
        drawing.draw_skeleton_3d(ax3, skeleton, wires="some")


def test_fill_panel_shows_all_of_the_points_in_the_middle_of_a_long_place():
    _, axs = drawing.axes_3d(2, height=2)
    points = np.random.default_rng(3).random((50, 3)) * (1, 2, 5)
    ax = drawing.fill_panel(drawing.focus_3d(axs[0], points), points, share=0.9)
    low, high = view.seen_between(ax, points)
    assert np.allclose((low + high) / 2, (1.75, 1.0), atol=0.01)
    assert np.isclose(((high - low) / (3.5, 2.0)).max(), 0.9, atol=0.01)
