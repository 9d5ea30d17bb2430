"""Drawing: what is in the data is in the picture, functions return their axes, kinds can be told apart."""

from __future__ import annotations

import itertools
import pkgutil
import subprocess
import sys
from types import SimpleNamespace

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from mpl_toolkits.mplot3d import proj3d

import polyskel_lite as psl
from polyskel_lite import drawing

POINTS = np.array([(0, 0), (4, 0), (5, 3), (2, 4), (-1, 2), (2, 1.5)], dtype=float)
POINTS_3D = np.array([(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2), (2, 2, 3), (0.7, 0.6, 0.5)])


@pytest.fixture
def ax():
    figure, axes = drawing.axes()
    yield axes
    plt.close(figure)


@pytest.fixture
def ax3():
    figure, axes = drawing.axes_3d()
    yield axes
    plt.close(figure)


@pytest.fixture(scope="module")
def frame():
    """A square with a square hole: its skeletons have one loop."""
    outer, hole = [(0, 0), (6, 0), (6, 6), (0, 6)], [(2, 2), (4, 2), (4, 4), (2, 4)]
    return psl.Shape.from_rings([outer, hole]).resample(48)


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


# --- the plane -------------------------------------------------------------------------------------------


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


# --- balls -----------------------------------------------------------------------------------------------


def test_union_of_balls_has_no_seam(ax):
    """Rendered: all pixels of a union of overlapping disks, also translucent, have one colour."""
    drawing.draw_balls(ax, [(0, 0), (1, 0), (0.5, 0.8)], [1, 1, 1], alpha=0.5)
    drawing.focus(ax, [(-0.1, -0.1), (1.1, 0.8)], margin=0)
    ax.figure.canvas.draw()
    pixels = np.asarray(ax.figure.canvas.buffer_rgba())
    low, high = ax.get_window_extent().extents.reshape(2, 2).round().astype(int)
    inside = pixels[-high[1] + 2 : -low[1] - 2, low[0] + 2 : high[0] - 2, :3].reshape(-1, 3)
    assert len(np.unique(inside, axis=0)) == 1


def test_balls_from_a_polyball_with_outlines(ax, frame):
    balls = psl.sk2(frame).balls()
    assert drawing.draw_balls(ax, balls, outlines=True) is ax
    (circles,) = ax.collections
    assert len(circles.get_paths()) == len(balls.radii)
    assert len(ax.patches) == 2


def test_balls_need_one_radius_each(ax):
    with pytest.raises(psl.InputError, match=r"radii \(k,\)"):
        drawing.draw_balls(ax, [(0, 0), (1, 0)], [1])


def test_ball_with_centre_and_contacts(ax):
    assert drawing.draw_ball(ax, (0, 0), 2, contacts=[(2, 0), (0, 2), (-2, 0)]) is ax
    assert len(ax.patches) == 1
    assert len(ax.collections[0].get_segments()) == 3
    assert drawn_points(ax) == 1 + 3


# --- boxes, chains, zoom ---------------------------------------------------------------------------------

coordinate = st.floats(-10, 10).map(lambda x: round(x, 3))
segment = st.tuples(*[st.tuples(coordinate, coordinate)] * 2).filter(lambda ends: ends[0] != ends[1])


@given(st.lists(segment, min_size=1, max_size=8))
def test_clipping_agrees_with_dense_points(segments):
    """A point of a segment is in the box exactly when it lies on what was kept of the segment."""
    box = np.array([(-3.0, -2.0), (4.0, 5.0)])
    for one in np.array(segments):
        kept = drawing.clip_segments([one], box)
        points = one[0] + np.linspace(0, 1, 101)[:, None] * (one[1] - one[0])
        inside = ((points > box[0] + 1e-9) & (points < box[1] - 1e-9)).all(axis=1)
        if len(kept) == 0:
            assert not inside.any()
            continue
        assert (kept >= box[0] - 1e-9).all()
        assert (kept <= box[1] + 1e-9).all()
        length = np.linalg.norm(one[1] - one[0])
        shares = np.linalg.norm(kept[0] - one[0], axis=1) / length
        between = (np.linspace(0, 1, 101) >= shares[0] - 1e-9) & (np.linspace(0, 1, 101) <= shares[1] + 1e-9)
        assert (between | ~inside).all()


def test_clipping_leaves_out_what_is_infinite():
    kept = drawing.clip_segments([[(0, 0), (np.inf, 0)], [(0, 0), (1, 0)]], [(-2, -2), (2, 2)])
    assert kept.tolist() == [[[0, 0], [1, 0]]]


@given(st.sets(st.tuples(st.integers(0, 9), st.integers(0, 9)).filter(lambda e: e[0] < e[1]), min_size=1))
def test_chains_hold_every_edge_once(edges):
    paths = drawing.chains(sorted(edges))
    found = [tuple(sorted(pair)) for path in paths for pair in itertools.pairwise(path.tolist())]
    assert sorted(found) == sorted(edges)


def test_a_cycle_is_one_chain():
    (path,) = drawing.chains([(0, 1), (1, 2), (2, 3), (3, 0)])
    assert path.tolist() == [0, 1, 2, 3, 0]


def test_box_needs_points():
    with pytest.raises(psl.InputError, match="at least one point"):
        drawing.box_of(np.empty((0, 2)))


def test_inset_shows_the_box(ax):
    drawing.draw_samples(ax, POINTS)
    glass = drawing.inset(ax, [(0, 0), (1, 1)])
    drawing.draw_samples(glass, POINTS)
    assert glass.get_xlim() == (0, 1)
    assert glass.get_ylim() == (0, 1)


# --- space -----------------------------------------------------------------------------------------------


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


# --- style -----------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def slab():
    """A flat block, full of tetrahedra: its skeleton has polygons."""
    points = np.random.default_rng(0).random((60, 3)) * [4, 3, 1]
    tessellation = psl.delaunay(points)
    return psl.DelaunayShape(tessellation, np.ones(len(tessellation.simplices), dtype=bool))


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


def test_legend_takes_kinds_and_artists(ax):
    other = Line2D([], [], label="by hand")
    assert drawing.legend(ax, "shape", other, "sk2", labels={"shape": "X"}) is ax
    assert [t.get_text() for t in ax.get_legend().get_texts()] == ["X", "by hand", "$Sk_2$"]


def test_unknown_kind_names_the_known_ones(ax):
    with pytest.raises(psl.InputError, match="sk0"):
        drawing.draw_samples(ax, POINTS, kind="sk9")


def test_axes_come_in_reading_order_with_letters():
    figure, axs = drawing.axes(2, 2, letters=True)
    assert [ax.get_title(loc="left") for ax in axs] == ["(a)", "(b)", "(c)", "(d)"]
    assert figure.get_figwidth() == drawing.TEXT_WIDTH
    plt.close(figure)


def test_no_two_kinds_share_a_colour_or_a_line_pattern():
    lines = [kind for kind in drawing.KINDS.values() if kind.linestyle != "none" and kind.fill != "#EEEEEE"]
    colors = [kind.color for kind in drawing.KINDS.values()]
    assert len(set(colors)) == len(colors)
    # Delaunay edges, balls and Sk0 are solid: thin and blue, around areas, thick.
    patterns = [(kind.linestyle, kind.linewidth) for kind in lines]
    assert len(set(patterns)) == len(patterns)


# How the loss of a kind of cone changes linear RGB: Machado, Oliveira, Fernandes, "A physiologically-based
# model for simulation of color vision deficiency", IEEE TVCG 15, 2009, severity 1.
VISION = {
    "usual": np.eye(3),
    "no red cone": [
        (0.152286, 1.052583, -0.204868),
        (0.114503, 0.786281, 0.099216),
        (-0.003882, -0.048116, 1.051998),
    ],
    "no green cone": [
        (0.367322, 0.860646, -0.227968),
        (0.280085, 0.672501, 0.047413),
        (-0.01182, 0.04294, 0.968881),
    ],
    "no blue cone": [
        (1.255528, -0.076749, -0.178779),
        (-0.078411, 0.930809, 0.147602),
        (0.004733, 0.691367, 0.3039),
    ],
}


def lab(color: str, matrix) -> np.ndarray:
    """CIE L*a*b* of a colour as seen through a colour vision matrix."""
    rgb = np.array(to_rgb(color))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    seen = np.clip(np.array(matrix) @ linear, 0, 1)
    to_xyz = [(0.41246, 0.35758, 0.18044), (0.21267, 0.71515, 0.07217), (0.01933, 0.11919, 0.9503)]
    xyz = np.array(to_xyz) @ seen / (0.95047, 1, 1.08883)
    f = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


@pytest.mark.parametrize("vision", VISION)
def test_kinds_can_be_told_apart_with_any_colour_vision(vision):
    """A difference of 10 in L*a*b* is about four times what is just noticed."""
    colors = {name: lab(kind.color, VISION[vision]) for name, kind in drawing.KINDS.items()}
    close = {
        pair: round(float(np.linalg.norm(colors[pair[0]] - colors[pair[1]])), 1)
        for pair in itertools.combinations(colors, 2)
    }
    assert min(close.values()) > 10, min(close, key=close.get)


# --- floors of the house ---------------------------------------------------------------------------------


def loaded_by(statement: str) -> set[str]:
    code = f"{statement}\nimport sys; print('\\n'.join(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return {name.split(".")[0] for name in done.stdout.split()}


def test_mathematics_does_not_load_matplotlib():
    apart = {"drawing", "figures", "explore"}
    names = [m.name for m in pkgutil.iter_modules(psl.__path__) if m.name not in apart]
    assert {"shapes", "graphs", "polyballs", "datasets"} <= set(names)
    loaded = loaded_by("\n".join(f"import polyskel_lite.{name}" for name in names))
    assert "numpy" in loaded
    assert "matplotlib" not in loaded


def test_drawing_does_not_load_widgets():
    loaded = loaded_by("import polyskel_lite.drawing, polyskel_lite.figures")
    assert "matplotlib" in loaded
    assert not loaded & {"ipywidgets", "IPython", "anywidget", "networkx"}


def test_nothing_in_drawing_prints(ax, frame, capsys):
    drawing.legend(drawing.draw_skeleton(drawing.draw_shape(ax, frame), psl.sk0(frame)), "shape", "sk0")
    assert capsys.readouterr().out == ""
