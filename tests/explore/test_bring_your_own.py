"""Explorers of refinement, removals, thresholds, balls, and of a reader's own shape: driven from Python."""

import contextlib
import csv
import io
import json
import random
import re
from base64 import b64decode
from datetime import UTC, datetime
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image

import polyskel_lite as psl
from polyskel_lite import explore, implicit
from polyskel_lite.containment import conform_stages, diametral_balls
from polyskel_lite.explore.explorers import bring_your_own, moving_balls, removing, results
from polyskel_lite.simplification import end_vertices, paths_back, state_at
from polyskel_lite.skeletons import branch_rows

# --- every explorer ---------------------------------------------------------------------------------


STARTED = {
    "refinement": lambda: explore.refinement(),
    "removals": lambda: explore.removals(),
    "thresholds": lambda: explore.thresholds(),
    "balls": lambda: explore.balls(),
}


@pytest.mark.parametrize("name", STARTED)
def test_stand_in_is_a_picture_with_words(name):
    explorer = STARTED[name]()
    page = explorer._repr_mimebundle_()["text/html"]
    picture = ElementTree.fromstring(re.search(r"<svg.*?</svg>", page, re.DOTALL)[0])
    assert picture.get("role") == "img"
    assert len(picture.get("aria-label")) > 60
    assert "open this chapter in JupyterLab" in page
    assert explorer.board.text in page.replace("&#x27;", "'")
    assert page.isascii() or "π" in page or "·" in page


@pytest.mark.parametrize("name", STARTED)
def test_controls_have_labels_and_a_sentence_says_what_to_look_for(name):
    explorer = STARTED[name]()
    assert all(control.description for control in explorer.controls.values())
    assert "Look" in explorer.look_for
    assert len(explorer.board.handle_labels) == len(explorer.board.handles)


# --- refinement -------------------------------------------------------------------------------------


@pytest.mark.parametrize("to", ["gabriel", "delaunay"])
@pytest.mark.parametrize("name", psl.datasets.names())
def test_refinement_counts_what_is_missing(name, to):
    explorer = explore.refinement(psl.datasets.load(name, n=60))
    explorer.controls["graph"].value = to
    stages = list(conform_stages(psl.datasets.load(name, n=60), to))
    assert explorer.controls["step"].max == max(len(stages) - 1, 0)
    for step, stage in enumerate(stages):
        explorer.controls["step"].value = step
        layers = explorer.board.layers
        assert explorer.numbers["missing"] == len(stage.missing) == len(layers["missing"].lines)
        assert len(layers["balls"].circles[1]) == len(stage.missing)
        assert len(layers["missing"].lines) + len(layers["there"].lines) == len(stage.facets)
        assert len(layers["samples"].points) + len(layers["added"].points) == len(stage.points)
    assert explorer.numbers["missing"] == 0
    assert "all" in explorer.board.text


def test_intruders_are_what_keeps_a_side_out_of_the_gabriel_graph():
    for stage in conform_stages(psl.datasets.load("lake", n=60)):
        centers, radii, intruders = diametral_balls(stage)
        ends = stage.points[stage.facets]
        middle, reach = ends.mean(axis=1), np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) / 2
        found = set()
        for k, (a, b) in enumerate(stage.facets.tolist()):
            near = np.flatnonzero(np.linalg.norm(stage.points - middle[k], axis=1) <= reach[k] * (1 + 1e-12))
            inside = set(near.tolist()) - {a, b}
            assert bool(inside) == (k in stage.missing)
            found |= inside
        assert found == set(intruders.tolist())
        assert len(centers) == len(radii) == len(stage.missing)


def test_refinement_hides_its_balls_and_refuses_solids():
    explorer = explore.refinement()
    explorer.controls["balls"].value = False
    assert not explorer.board.visible("balls")
    with pytest.raises(psl.InputError, match="in the plane"):
        explore.refinement(psl.datasets.load("fourbranch"))


# --- removals ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "n"), [("gear", 60), ("lake", 80), ("horse", 60)])
def test_removals_follow_the_hierarchy(name, n):
    shape = psl.conform(psl.datasets.load(name, n=n))
    explorer = explore.removals(shape)
    h = explorer.hierarchy
    values = []
    for step in range(len(h.order)):
        explorer.controls["step"].value = step
        numbers = explorer.numbers
        assert numbers["triangle"] == h.simplices[h.order[step]]
        assert numbers["shared"] == 1
        assert numbers["before"] == numbers["after"] == shape.betti()
        assert len(explorer.board.layers["triangles"].polygons) == len(h.level) - step
        values.append(numbers["value"])
    # The threshold at which a triangle goes is the largest criterion met so far.
    assert np.maximum.accumulate(values) == pytest.approx(h.level[h.order], rel=1e-12)
    explorer.controls["step"].value = len(h.order)
    assert "No hat is left" in explorer.board.text
    assert len(explorer.board.layers["marked"].polygons) == 0


def test_only_hats_can_go():
    explorer = explore.removals()
    h, seen = explorer.hierarchy, set()
    for step in (0, 10):
        explorer.controls["step"].value = step
        for row in h.simplices.tolist():
            explorer.controls["triangle"].value = row
            numbers = explorer.numbers
            if "shared" not in numbers:
                assert "not there any more" in explorer.board.text
                continue
            seen.add(numbers["shared"])
            assert (numbers["before"] == numbers["after"]) == (numbers["shared"] == 1)
            assert ("it may go" in explorer.board.text) == (numbers["shared"] == 1)
    assert seen == {1, 2, 3}


def test_removals_want_a_flat_shape_and_a_step_there_is():
    with pytest.raises(psl.InputError, match="in the plane"):
        explore.removals(psl.datasets.load("fourbranch"))
    h = psl.hierarchy(psl.datasets.load("gear", n=60))
    with pytest.raises(psl.InputError, match="step is 99"):
        state_at(h, 99)
    assert removing.try_removal(h, 0, triangle=10**6) is None


def test_waiting_triangles_are_told_with_their_threshold():
    explorer = explore.removals(psl.conform(psl.datasets.load("horse", n=60)))
    texts = []
    for step in range(len(explorer.hierarchy.order)):
        explorer.controls["step"].value = step
        texts.append("it waited for others" in explorer.board.text)
        level = explorer.hierarchy.level[explorer.hierarchy.order[step]]
        assert texts[-1] == (level > explorer.numbers["value"] * (1 + 1e-9))
    assert any(texts)
    assert not all(texts)


# --- thresholds -------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", psl.datasets.names())
def test_thresholds_show_what_the_hierarchy_has(name):
    explorer = explore.thresholds(psl.datasets.load(name))
    for criterion in ("corrected", "as printed"):
        explorer.controls["criterion"].value = criterion
        h = psl.hierarchy(explorer.P, criterion=criterion)
        for value in (0, 0.5, 1, 2.5, 6):
            explorer.controls["threshold"].value = value
            skeleton = h.skeleton(value * np.pi)
            drawn = explorer.board.layers["skeleton"].lines
            assert np.array_equal(drawn, skeleton.segments())
            assert explorer.numbers["Betti_numbers"] == skeleton.betti()
            assert explorer.numbers["ends"] == h.branches(value * np.pi).graph["branches"]
            assert explorer.numbers["simplices"] == len(skeleton.vertices)
            assert len(explorer.board.layers["ends"].points) == explorer.numbers["ends"]


def test_ends_come_back_along_the_whole_skeleton():
    h = psl.hierarchy(psl.datasets.load("leaf"))
    whole = psl.sk0(h.P)
    edges = {frozenset(map(tuple, segment)) for segment in whole.segments().tolist()}
    first = set(map(tuple, whole.vertices[end_vertices(h, 0)].tolist()))
    for threshold in (0, np.pi, 2 * np.pi):
        paths = paths_back(h, threshold)
        for path in paths:
            steps = pairwise(map(tuple, path.tolist()))
            assert all(frozenset(step) in edges or step[0] == step[1] for step in steps)
            assert tuple(path[-1].tolist()) in first  # where a branch of the whole skeleton ends
    explorer = explore.thresholds(h.P)
    for choice, seen in (("nothing", None), ("their balls", "balls"), ("the way they have come", "ways")):
        explorer.controls["ends"].value = choice
        assert [layer for layer in ("balls", "ways") if explorer.board.visible(layer)] == [seen] * bool(seen)


def test_thresholds_of_solids_are_those_of_the_viewer():
    explorer = explore.thresholds(psl.datasets.load("fourbranch"))
    assert len(explorer.hierarchies) == 4
    seen = set()
    for h in explorer.hierarchies:
        explorer.picture.strategy = f"{h.strategy}, {h.criterion}"
        explorer.picture.threshold = 1.0
        assert explorer.hierarchy is h
        assert explorer.numbers["simplices"] == explorer.picture.counts()["vertices"]
        assert explorer.numbers["ends"] == explorer.picture.counts()["branches"]
        assert explorer.numbers["Betti_numbers"] == (1, 0, 0)
        seen.add(explorer.numbers["simplices"])
    assert len(seen) == 4
    assert "psl-viewer" in explorer._repr_mimebundle_()["text/html"]


# --- balls ------------------------------------------------------------------------------------------


def moved(explorer, index, place):
    handles = [list(handle) for handle in explorer.board.handles]
    handles[index] = list(place)
    explorer.board.handles = handles


def test_moving_a_centre_takes_the_rim_along():
    explorer = explore.balls(psl.Polyball([(0, 0), (1, 0), (3, 0)], [1, 0.8, 0.5]))
    before = np.array(explorer.board.handles)
    assert explorer.numbers["Betti_numbers"] == (2, 0)
    moved(explorer, 4, (2.0, 0.2))
    after = np.array(explorer.board.handles)
    assert explorer.polyball.centers[2].tolist() == [2.0, 0.2]
    assert explorer.polyball.radii.tolist() == [1, 0.8, 0.5]
    assert after[5] - after[4] == pytest.approx(before[5] - before[4])
    assert (after[:4] == before[:4]).all()
    assert explorer.numbers["Betti_numbers"] == (1, 0)
    assert explorer.controls["ball"].value == 2


def test_dragging_a_rim_and_the_slider_make_a_ball_grow():
    explorer = explore.balls(psl.Polyball([(0, 0), (3, 0)], [1, 1]))
    assert explorer.numbers["singular_points"] == 0
    moved(explorer, 1, (0.0, 2.3))
    assert explorer.polyball.radii == pytest.approx([2.3, 1])
    assert explorer.board.handles[1] == pytest.approx((0.0, 2.3))
    assert explorer.numbers["singular_points"] == 2
    explorer.controls["ball"].value = 1
    assert explorer.controls["radius"].value == pytest.approx(1)
    explorer.controls["radius"].value = 1.5
    assert explorer.polyball.radii == pytest.approx([2.3, 1.5])
    explorer.controls["ball"].value = 0
    assert explorer.controls["radius"].value == pytest.approx(2.3)
    assert explorer.polyball.radii == pytest.approx([2.3, 1.5])


def test_a_slider_that_snaps_to_its_steps_is_not_a_hand():
    explorer = explore.balls(psl.Polyball([(0, 0), (3, 0)], [1, 1]))
    radius = explorer.controls["radius"]
    radius.value = 1 + 0.4 * radius.step  # what a browser does by itself when it shows the slider
    assert explorer.polyball.radii.tolist() == [1, 1]
    radius.value = 1 + 1.4 * radius.step  # one step further, by hand
    assert explorer.polyball.radii.tolist() == [1 + 1.4 * radius.step, 1]


def test_a_rim_dragged_into_the_centre_leaves_a_small_ball():
    explorer = explore.balls(psl.Polyball([(0, 0), (3, 0)], [1, 1]))
    moved(explorer, 1, (0.0, 0.0))
    assert 0 < explorer.polyball.radii[0] < 0.2
    assert explorer.error is None


def test_rims_beyond_the_board_do_not_change_their_balls():
    explorer = explore.balls(psl.Polyball([(0, 0), (1.2, 0)], [1, 1]))
    xmin, _, _, ymax = explorer.board.box
    moved(explorer, 0, (xmin, ymax))
    moved(explorer, 0, (0.1, 0.0))
    assert explorer.polyball.radii.tolist() == [1, 1]


def test_tangent_balls_get_a_sentence_and_moving_on_works():
    explorer = explore.balls(psl.Polyball([(0, 0), (2, 0)], [1, 1]))
    assert isinstance(explorer.error, psl.TangentBallsError)
    assert explorer.board.text == str(explorer.error)
    assert "touch" in explorer.board.text
    assert len(explorer.board.layers["boundary"].arcs[0]) > 0  # the balls themselves are drawn
    assert len(explorer.board.layers["skeleton"].lines) == 0
    assert explorer.numbers == {}
    moved(explorer, 2, (1.7, 0.0))
    assert explorer.error is None
    assert len(explorer.board.layers["skeleton"].lines) == 1


def test_balls_are_added_and_removed():
    explorer = explore.balls()
    count, area = len(explorer.polyball), explorer.numbers["area"]
    explorer.controls["add"].click()
    assert len(explorer.polyball) == count + 1 == explorer.numbers["balls"]
    assert len(explorer.board.handles) == len(explorer.board.handle_labels) == 2 * (count + 1)
    assert explorer.controls["ball"].value == count
    explorer.controls["remove"].click()
    assert explorer.numbers["area"] == pytest.approx(area)
    for _ in range(count + 2):
        explorer.controls["remove"].click()
    assert len(explorer.polyball) == 1
    assert explorer.board.text == "One ball has to stay."
    for _ in range(20):
        explorer.add()
    assert len(explorer.polyball) == moving_balls.MOST
    assert "remove one first" in explorer.board.text


def test_the_skeleton_drawn_is_that_of_the_library():
    explorer = explore.balls()
    rng = np.random.default_rng(3)
    for _ in range(10):
        moved(explorer, 2 * rng.integers(7), rng.uniform(-1, 4, 2))
        Y = explorer.polyball
        if explorer.error:
            continue
        drawn = explorer.board.layers["skeleton"].lines
        assert np.array_equal(drawn, Y.skeleton().segments())
        # In the plane nothing is to be corrected, so there is no switch between the two statements.
        assert np.array_equal(drawn, Y.skeleton(statement="as printed").segments())
        assert explorer.numbers["area"] == Y.area()
        assert len(explorer.board.layers["singular"].points) == len(Y.singular_points())
    explorer.controls["voronoi"].value = False
    assert not explorer.board.visible("voronoi")


def test_balls_in_space_or_too_many_are_refused():
    with pytest.raises(psl.InputError, match="3 coordinates"):
        explore.balls(psl.Polyball([(0, 0, 0)], [1]))
    with pytest.raises(psl.InputError, match="too many"):
        explore.balls(psl.Polyball([(k, 0) for k in range(40)], [0.6] * 40))


# --- bring your own ---------------------------------------------------------------------------------


def picture_bytes(kind):
    rows, columns = np.mgrid[:60, :80]
    inside = (rows - 30) ** 2 / 400 + (columns - 40) ** 2 / 900 < 1
    stream = io.BytesIO()
    Image.fromarray(np.where(inside, 0, 255).astype(np.uint8)).save(stream, kind)
    return stream.getvalue()


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    """One small file of each kind."""
    folder = tmp_path_factory.mktemp("good")
    solid = implicit.solid(implicit.ball(), n=60)
    for suffix in ("stl", "ply", "obj", "off"):
        solid.to_file(folder / f"solid.{suffix}")
    stream = io.BytesIO()
    np.savez(stream, points=[[0, 0], [4, 0], [0, 3.0]], facets=[[0, 1], [1, 2], [2, 0]])
    ring = [[0, 0], [4, 0], [4, 1], [0, 1], [0, 0]]
    return {
        "blob.png": picture_bytes("PNG"),
        "blob.jpg": picture_bytes("JPEG"),
        "drawing.svg": b'<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H9V4H0Z"/></svg>',
        "field.geojson": json.dumps({"type": "Polygon", "coordinates": [ring]}).encode(),
        "arrays.npz": stream.getvalue(),
    } | {path.name: path.read_bytes() for path in folder.iterdir()}


WHEN = datetime(1997, 9, 1, tzinfo=UTC)


def uploaded(own, name, content):
    own.upload.value = (
        {
            "name": name,
            "type": "",
            "size": len(content),
            "last_modified": WHEN,
            "content": memoryview(content),
        },
    )


KINDS = [
    *("blob.png", "blob.jpg", "drawing.svg", "field.geojson", "arrays.npz"),
    *("solid.stl", "solid.ply", "solid.obj", "solid.off"),
]


@pytest.mark.parametrize("name", KINDS)
def test_upload_goes_the_whole_way(good, name):
    own = explore.explore()
    assert own.chain is None
    assert not own._place.children
    uploaded(own, name, good[name])
    assert own.error is None
    assert own.chain.name == name.split(".")[0]
    assert own.chain.given.betti()[:2] == (1, 0)
    assert own.picture in own._place.children
    assert own.chain.name in own._status.value
    files = own.files()
    assert own.hierarchy.skeleton(own.picture.threshold).vertices.shape[1] == own.chain.given.dimension
    assert len(files) == (3 if own.chain.given.dimension == 2 else 4)
    assert all(len(content) for content in files.values())


BAD = {
    "empty.png": b"",
    "text.png": b"no picture at all",
    "white.png": None,
    "broken.svg": b"<svg><path d='M0 0",
    "open.svg": b'<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H9V4"/></svg>',
    "bow.geojson": b'{"type":"Polygon","coordinates":[[[0,0],[2,2],[2,0],[0,2],[0,0]]]}',
    "line.geojson": b'{"type":"LineString","coordinates":[[0,0],[2,2]]}',
    "broken.json": b"{",
    "broken.npz": b"PK\x03\x04 and nothing more",
    "broken.stl": b"solid but no",
    "open.off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    "far.ply": b"ply\nformat ascii 1.0\n"
    b"element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    b"element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n",
    "points.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\n",
    "letter.docx": b"PK",
}


@pytest.mark.parametrize("name", BAD)
def test_bad_files_get_the_sentence_of_the_library(name, tmp_path):
    content = BAD[name]
    if content is None:
        stream = io.BytesIO()
        Image.new("L", (9, 9), 255).save(stream, "PNG")
        content = stream.getvalue()
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(psl.PolyskelError) as refusal:
        psl.Shape.from_file(path)
    own = explore.explore(psl.datasets.load("gear"))
    uploaded(own, name, content)
    assert type(own.error) is refusal.type
    sentence = ElementTree.fromstring(own._status.value)
    assert sentence.text == str(refusal.value)
    assert sentence.get("role") == "alert"
    assert name in sentence.text
    assert own.chain is None
    assert not own._place.children
    with pytest.raises(psl.InputError, match="no shape yet"):
        own.files()
    own.load(psl.datasets.load("gear"))  # and on it goes
    assert own.error is None


@pytest.mark.parametrize("name", KINDS)
def test_files_with_errors_in_them_are_never_a_traceback(good, name, tmp_path):
    rng, path = random.Random(name), tmp_path / name
    for round in range(45):
        content = bytearray(good[name])
        at = rng.randrange(len(content))
        if round % 3 == 0:
            content = content[:at]
        elif round % 3 == 1:
            content[at] = rng.randrange(256)
        else:
            content[at:at] = rng.randbytes(5)
        path.write_bytes(content)
        with contextlib.suppress(psl.PolyskelError):  # and nothing else
            psl.Shape.from_file(path)


def test_numbers_of_corners_that_are_no_vertices_are_named(tmp_path):
    (tmp_path / "far.ply").write_bytes(BAD["far.ply"])
    with pytest.raises(psl.InputError, match=r"face 0 has the corners \[0, 1, 9\], and there are 3 vertices"):
        psl.Shape.from_file(tmp_path / "far.ply")


def test_names_of_files_are_text_and_stay_in_their_folder(good):
    own = explore.explore()
    uploaded(own, "../<b>bold.geojson", good["field.geojson"])
    assert own.error is None
    assert "<b>" not in own._status.value
    own.make.click()
    assert "<b>" not in own._links.value
    uploaded(own, "<img src=x>.docx", b"x")
    assert "<img" not in own._status.value


def test_large_files_and_large_shapes_are_refused(monkeypatch):
    own = explore.explore()
    uploaded(own, "large.png", bytes(bring_your_own.MOST_BYTES + 1))
    assert "megabytes" in own._status.value
    assert own.chain is None
    monkeypatch.setitem(bring_your_own.MOST_VERTICES, 2, 100)
    own.load(psl.datasets.load("gear"))
    assert str(own.error).startswith("shape has 500 vertices; up to 100 are quick enough")
    own.load(42)
    assert "cannot explore int" in str(own.error)


def test_options_read_the_uploaded_file_again(good):
    own = explore.explore()
    own.smooth.value = 0
    uploaded(own, "blob.png", good["blob.png"])
    first = own.chain.given
    own.smooth.value = 2
    assert len(own.chain.given.points) != len(first.points) or own.chain.given.area() != first.area()
    own.invert.value = True
    assert own.chain.given.betti() == (1, 1)


def test_table_follows_the_threshold_and_is_for_screen_readers():
    own = explore.explore(psl.datasets.load("leaf"))
    for threshold in (0.5, np.pi, 2 * np.pi):
        own.picture.threshold = threshold
        table = ElementTree.fromstring(own._table.value)
        graph = own.hierarchy.branches(threshold)
        rows = table.findall("tbody/tr")
        assert len(rows) == min(graph.number_of_edges(), results.ROWS_SHOWN)
        assert f"{threshold / np.pi:.3g} π" in table.find("caption").text
        assert all(head.get("scope") == "col" for head in table.findall("thead/tr/th"))
        assert all(row.find("th").get("scope") == "row" for row in rows)
        lengths = [float(row.findall("td")[2].text) for row in rows]
        assert lengths == sorted(lengths, reverse=True)


def test_files_hold_the_skeleton_and_its_branches(tmp_path):
    own = explore.explore(psl.datasets.load("lake"))
    own.picture.threshold = 2.0
    skeleton = own.hierarchy.skeleton(2.0)
    paths = {path.name: path for path in own.save(tmp_path)}
    back = psl.Skeleton.load(paths["shape-skeleton.npz"])
    assert np.array_equal(back.vertices, skeleton.vertices)
    assert np.array_equal(back.edges, skeleton.edges)
    rows = list(csv.DictReader(paths["shape-branches.csv"].read_text().splitlines()))
    assert sum(float(row["length"]) for row in rows) == pytest.approx(skeleton.length())
    assert all(
        float(row["least_radius"]) <= float(row["mean_radius"]) <= float(row["largest_radius"])
        for row in rows
    )
    picture = ElementTree.parse(paths["shape.svg"]).getroot()
    assert "2" in picture.get("viewBox") or picture.get("role") == "img"
    own.make.click()
    links = re.findall(
        r'download="([^"]*)" href="data:application/octet-stream;base64,([^"]*)"', own._links.value
    )
    assert {name: b64decode(content) for name, content in links}.keys() == paths.keys()
    assert b64decode(dict(links)["shape-branches.csv"]) == paths["shape-branches.csv"].read_bytes()
    own.picture.threshold = 2.5
    assert own._links.value == ""  # those files were for another threshold


def test_files_of_solids(tmp_path):
    own = explore.explore(psl.datasets.load("fourbranch"))
    own.picture.strategy = "wireframe"
    own.picture.threshold = 2 * np.pi
    skeleton = own.hierarchy.skeleton(2 * np.pi)
    paths = {path.suffix: path for path in own.save(tmp_path)}
    assert paths.keys() == {".csv", ".npz", ".obj", ".ply"}
    assert paths[".obj"].read_text().count("\nv ") + 1 >= len(skeleton.vertices)
    assert (
        len(paths[".csv"].read_text().splitlines()) == own.hierarchy.branches(2 * np.pi).number_of_edges() + 1
    )
    assert "psl-viewer" in own._repr_mimebundle_()["text/html"]


def test_files_are_written_beside_the_notebook_or_it_says_why_not(tmp_path, monkeypatch):
    own = explore.explore(psl.datasets.load("gear"))
    monkeypatch.chdir(tmp_path)
    own.write.click()
    assert "Written" in own._links.value
    assert (tmp_path / "shape-branches.csv").exists()
    own.chain = bring_your_own.Chain("no/such/folder", *list(vars(own.chain).values())[1:])
    own.write.click()
    assert "Not written" in own._links.value


def test_branch_of_a_strip_has_its_width():
    strip = psl.Shape.from_rings([[(0, 0), (20, 0), (20, 2), (0, 2)]]).resample(220)
    (row,) = branch_rows(psl.hierarchy(strip).skeleton(np.pi))
    assert row.length == pytest.approx(18, abs=0.2)
    assert 2 * row.mean_radius == pytest.approx(2, rel=0.02)
    assert results.branch_table([]).startswith("<p>No branches")
