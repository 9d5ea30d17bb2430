"""The main axis, widths at stations, branches as records and as maps: against known lengths and shapely."""

import csv
import io
import json
import math

import numpy as np
import pandas
import pytest
import shapely

import polyskel_lite as psl

networkx = pytest.importorskip("networkx")


def diameter(skeleton) -> float:
    """The longest of all shortest paths, by networkx from every vertex."""
    ways = networkx.all_pairs_dijkstra_path_length(skeleton.to_networkx(), weight="length")
    return max(max(found.values()) for _, found in ways)


def graph_of(points, edges=(), dimension=2) -> psl.Skeleton:
    """A skeleton of some points, the radius of each its number and one."""
    vertices = np.zeros((len(points), dimension))
    vertices[:, :2] = np.reshape(points, (-1, 2))
    edges = np.reshape(np.array(edges, dtype=np.int64), (-1, 2))
    return psl.Skeleton(vertices, 1.0 + np.arange(len(points)), np.full(len(points), -1), edges)


@pytest.mark.parametrize(("name", "threshold"), [("horse", 0), ("horse", 3), ("lake", 3), ("hawaii", 0)])
def test_the_main_axis_is_the_longest_shortest_path(name, threshold):
    skeleton = psl.hierarchy(psl.conform(psl.datasets.load(name))).skeleton(threshold)
    axis = skeleton.main_axis()
    assert axis.length == pytest.approx(diameter(skeleton), rel=1e-12)
    pairs = np.sort(np.stack([axis.vertices[:-1], axis.vertices[1:]], axis=1), axis=1)
    assert {*map(tuple, pairs.tolist())} <= {*map(tuple, np.sort(skeleton.edges, axis=1).tolist())}


@pytest.mark.parametrize("seed", range(20))
def test_the_main_axis_of_any_graph(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 30))
    edges = rng.integers(0, n, (int(rng.integers(1, 2 * n)), 2))
    edges = np.unique(np.sort(edges[edges[:, 0] != edges[:, 1]], axis=1), axis=0).reshape(-1, 2)
    skeleton = graph_of(rng.random((n, 2)), edges, dimension=int(rng.choice([2, 3])))
    graph, closed = skeleton.to_networkx(), 0.0
    for ring in networkx.connected_components(graph):  # a closed line counts whole
        part = graph.subgraph(ring)
        if len(part) and all(d == 2 for _, d in part.degree()):
            closed = max(closed, part.size(weight="length"))
    assert skeleton.main_axis().length == pytest.approx(max(diameter(skeleton), closed))


def test_a_ring_is_its_own_axis_in_the_plane_and_in_space():
    turn = np.linspace(0, 2 * math.pi, 200, endpoint=False)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    flat = psl.sk0(psl.conform(psl.Shape.from_rings([6 * circle, 4 * circle])))
    axis = psl.hierarchy(flat.reconstruct()).skeleton(3).main_axis()
    assert axis.vertices[0] == axis.vertices[-1]
    assert axis.smooth_length == pytest.approx(10 * math.pi, rel=0.01)
    torus = psl.hierarchy(psl.implicit.solid(psl.implicit.torus(2.0, 0.6), 1500), "wireframe").skeleton(6)
    around = torus.main_axis()
    assert around.smooth_length == pytest.approx(4 * math.pi, rel=0.03)


def test_an_island_is_passed_on_the_shorter_side():
    lake = [
        (0, 3),
        (20, 3),
        (20, 0),
        (40, 0),
        (40, 3),
        (60, 3),
        (60, 7),
        (40, 7),
        (40, 8),
        (20, 8),
        (20, 7),
        (0, 7),
    ]
    island = [(25, 2), (25, 6), (35, 6), (35, 2)]
    axis = psl.skeleton([lake, island]).skeleton.main_axis()
    assert axis.length == pytest.approx(58, abs=3)
    inner = axis.points[(axis.points[:, 0] > 27) & (axis.points[:, 0] < 33)]
    assert np.allclose(inner[:, 1], 7, atol=0.1)


def test_without_edges_the_axis_is_the_largest_ball_and_without_vertices_there_is_none():
    axis = graph_of([(0, 0), (5, 0)]).main_axis()
    assert (axis.vertices.tolist(), axis.length, axis.smooth_length) == ([1], 0, 0)
    assert axis.stations().widths.tolist() == [4]
    none = graph_of([])
    with pytest.raises(psl.InputError, match="no vertex"):
        none.main_axis()


@pytest.mark.parametrize("unit", [1.0, 2.0**-600, 2.0**700])
def test_widths_of_a_wedge_at_stations(unit):
    """Between two lines the width across is that of the inscribed circle: 2 x sin(half the angle)."""
    wedge = psl.skeleton([np.array([(0, 4), (60, 9), (60, 11), (0, 16)]) * unit])
    along, points, widths = wedge.skeleton.main_axis().stations(2 * unit)
    x = points[:, 0] / unit
    slope = 5 / 60
    half = np.abs(6 - slope * x) / math.hypot(1, slope)
    inner = (x > 8) & (x < 57)
    assert inner.sum() > 20
    assert np.allclose(widths[inner] / unit, 2 * half[inner], rtol=0.01)
    steps = np.diff(along)
    assert np.allclose(steps, steps[0])
    assert steps[0] <= 2 * unit


@pytest.mark.parametrize("spacing", [0, -1, math.nan, 1e-9, "wide"])
def test_a_spacing_that_is_no_length_is_refused(spacing):
    axis = psl.skeleton([[(0, 0), (20, 0), (20, 4), (0, 4)]]).skeleton.main_axis()
    with pytest.raises(psl.InputError, match="spacing"):
        axis.stations(spacing)


@pytest.fixture(scope="module")
def cross():
    arms = [
        (4, -3),
        (6, -3),
        (6, 4),
        (15, 4.1),
        (15, 6),
        (6, 6),
        (6, 12),
        (4, 12),
        (4, 6),
        (-3, 6),
        (-3, 4),
        (4, 4),
    ]
    return psl.skeleton([arms])


def test_branches_are_records_csv_and_a_dataframe(cross, tmp_path):
    table = cross.skeleton.branch_table()
    assert len(table) >= 4
    assert [row.length for row in table] == sorted((row.length for row in table), reverse=True)
    text = table.to_csv(tmp_path / "branches.csv")
    read = list(csv.DictReader(io.StringIO(text)))
    assert (tmp_path / "branches.csv").read_text() == text + "\n"
    assert [float(row["length"]) for row in read] == [row.length for row in table]
    frame = table.to_dataframe()
    assert isinstance(frame, pandas.DataFrame)
    assert frame["mean_radius"].tolist() == [row.mean_radius for row in table]
    assert list(frame.columns) == list(read[0])
    for row in table:
        assert row.axis.length == pytest.approx(row.length)
        assert row.axis.smooth_length == pytest.approx(row.smooth_length)
    html = table._repr_html_()
    assert html.count("<tr>") == len(table) + 1
    assert "0x" not in html


def test_shapely_reads_the_lines_of_a_skeleton(cross, tmp_path):
    skeleton = cross.skeleton
    for suffix in ("geojson", "wkt", "svg"):
        skeleton.to_file(tmp_path / f"cross.{suffix}")
    content = json.loads((tmp_path / "cross.geojson").read_text())
    lines = [shapely.geometry.shape(feature["geometry"]) for feature in content["features"]]
    rows = [row for row in skeleton.branch_table() if row.length]
    assert [line.length for line in lines] == pytest.approx([row.length for row in rows])
    assert [f["properties"]["mean_radius"] for f in content["features"]] == [row.mean_radius for row in rows]
    wkt = shapely.from_wkt((tmp_path / "cross.wkt").read_text())
    assert wkt.geom_type == "MultiLineString"
    assert wkt.length == pytest.approx(skeleton.length())
    assert all(line.is_valid for line in [*lines, wkt])
    assert (tmp_path / "cross.svg").read_text().count("<polyline") == len(lines)


def test_points_without_edges_are_points_of_the_map(tmp_path):
    mixed = graph_of([(0, 0), (1, 0), (5, 5)], [(0, 1)])
    mixed.to_file(tmp_path / "a.wkt")
    found = shapely.from_wkt((tmp_path / "a.wkt").read_text())
    assert sorted(part.geom_type for part in found.geoms) == ["LineString", "Point"]
    none = graph_of([])
    none.to_file(tmp_path / "b.wkt")
    assert shapely.from_wkt((tmp_path / "b.wkt").read_text()).is_empty


def test_what_is_no_map_is_refused(tmp_path):
    solid = graph_of([(0, 0)], dimension=3)
    with pytest.raises(psl.InputError, match="of the plane"):
        _ = solid.__geo_interface__
    with pytest.raises(psl.InputError, match="geojson"):
        solid.to_file(tmp_path / "a.geojson")
