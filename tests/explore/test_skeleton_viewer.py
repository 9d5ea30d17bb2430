"""The skeleton viewer: what it sends to the browser, and what it says without one."""

import base64
import importlib
import json
import re
import subprocess
import sys
from pathlib import Path

import nbformat
import numpy as np
import pytest

import polyskel_lite as psl

pytest.importorskip("anywidget", reason="the viewer needs the extra lab")

from polyskel_lite import explore
from polyskel_lite.explore.skeleton_viewer import pack

ROOT = Path(__file__).resolve().parents[2]
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"


@pytest.fixture(scope="module")
def leaf():
    return psl.hierarchy(psl.datasets.load("leaf"), strategy="branch")


@pytest.fixture(scope="module")
def solids():
    P = psl.delaunay_shape(psl.datasets.load("fourbranch"))
    return [psl.hierarchy(P, strategy) for strategy in ("surface", "wireframe")]


def expected(h, threshold):
    skeleton = h.skeleton(threshold)
    return {
        "vertices": len(skeleton.vertices),
        "edges": len(skeleton.edges),
        "polygons": len(skeleton.polygons),
        "branches": h.branches(threshold).graph["branches"],
    }


def thresholds(h, count=12):
    """Round numbers, levels themselves, and the neighbours of a level."""
    finite = np.sort(h.level[np.isfinite(h.level)])
    some = finite[np.linspace(0, len(finite) - 1, count).astype(int)]
    beside = np.nextafter(some[count // 2], [-np.inf, np.inf])
    return [-np.inf, 0.0, np.pi / 3, np.pi, 2 * np.pi, *some, *beside, finite[-1] + 1]


def test_elements_shown_are_those_of_the_hierarchy_in_the_plane(leaf):
    picture = explore.viewer(leaf)
    for threshold in thresholds(leaf):
        assert picture.counts(threshold) == expected(leaf, threshold), threshold


def test_elements_shown_are_those_of_the_hierarchies_in_space(solids):
    picture = explore.viewer(solids)
    for h in solids:
        picture.strategy = h.strategy
        for threshold in thresholds(h, 6):
            assert picture.counts(threshold) == expected(h, threshold), (h.strategy, threshold)


def test_hierarchies_with_holes_and_both_criteria():
    P = psl.delaunay_shape(psl.datasets.load("lake"))
    both = [psl.hierarchy(P, criterion=criterion) for criterion in ("corrected", "transcript")]
    picture = explore.viewer(both)
    assert [h["label"] for h in picture.scene["variants"][0]["hierarchies"]] == [
        "branch, corrected",
        "branch, transcript",
    ]
    for h in both:
        picture.strategy = f"branch, {h.criterion}"
        assert picture.counts(3.0) == expected(h, 3.0)
    assert picture.scene["variants"][0]["hierarchies"][0]["betti"] == [1, 2]


def test_arrays_come_back(leaf):
    packer, rng = pack.Packer(), np.random.default_rng(0)
    sent = {
        "small": rng.integers(0, 200, 31),
        "middle": rng.integers(0, 60_000, 32),
        "large": rng.integers(0, 2**31, 33),
        "pairs": np.sort(rng.integers(0, 300, 40)),
        "none": np.zeros(0, dtype=int),
        "levels": np.array([-np.inf, 0.1, np.inf]),
    }
    refs = {name: packer.add(array, delta=2 * (name == "pairs")) for name, array in sent.items()}
    data = pack.unpack(packer.block())
    for name, array in sent.items():
        np.testing.assert_array_equal(pack.read(data, refs[name]), array)
        assert refs[name]["at"] % 8 == 0
    assert [refs[name]["type"] for name in ("small", "middle", "large", "levels")] == ["u1", "u2", "u4", "f8"]


def test_places_are_rounded_far_below_a_pixel_and_far_ones_kept(leaf):
    skeleton = leaf.skeleton(-np.inf)
    places = np.vstack([skeleton.vertices, [(1e6, -1e6)]])
    low, high = places[:-1].min(axis=0), places[:-1].max(axis=0)
    packer = pack.Packer()
    ref = packer.places(places, low, high)
    back = pack.read_places(pack.unpack(packer.block()), ref)
    assert np.abs(back - places)[:-1].max() < 1e-5 * (high - low).max()
    np.testing.assert_array_equal(back[-1], places[-1])


def test_radii_and_places_in_the_header_are_those_of_the_skeleton(leaf):
    picture = explore.viewer(leaf)
    header, data = picture.scene["variants"][0], pack.unpack(picture.blob)
    skeleton = leaf.skeleton(-np.inf)
    radii = pack.read(data, header["radius"]) / pack.GRID * picture.scene["radius"]
    np.testing.assert_allclose(radii, skeleton.radii, atol=1e-4)
    np.testing.assert_allclose(pack.read_places(data, header["vertices"]), skeleton.vertices, atol=1e-4)
    edges = pack.read(data, header["edges"]).reshape(-1, 2)
    assert {tuple(e) for e in edges.tolist()} == {tuple(sorted(e)) for e in skeleton.edges.tolist()}


def test_view_that_is_half_given_is_kept(solids):
    free = explore.viewer(solids).scene["view"]
    assert explore.viewer(solids, view={"elev": 5}).scene["view"]["elev"] == 5
    assert explore.viewer(solids, view={"azim": 7.5}).scene["view"]["azim"] == 7.5 != free["azim"]


def test_axis_that_points_up_is_the_third_in_the_browser(solids):
    plain = explore.viewer(solids[:1])
    turned = explore.viewer(solids[:1], view={"elev": 15, "azim": 18, "vertical_axis": "y"})
    assert turned.scene["high"] == np.roll(plain.scene["high"], 1).tolist()
    assert turned.scene["view"] == {"elev": 15.0, "azim": 18.0}


def test_same_input_gives_the_same_page(leaf):
    pages = [explore.viewer(leaf, alt="A leaf.", look="Look.").to_html() for _ in range(2)]
    assert pages[0] == pages[1]


def page_data(page):
    return json.loads(re.search(r'<script type="application/json">(.*?)</script>', page, re.S)[1])


def test_page_holds_the_data_and_three_pictures_for_readers_without_scripts(leaf):
    picture = explore.viewer(
        leaf, threshold=np.pi, alt='A "leaf" & more.', look="Short ones go </script> first."
    )
    data, metadata = picture._repr_mimebundle_()
    page = data["text/html"]
    assert WIDGET_VIEW in data
    assert metadata == {}
    held = page_data(page)
    assert base64.b64decode(held["blob"]) == picture.blob
    assert held["thresholds"] == {"branch": np.pi}
    assert held["scene"]["look"] == "Short ones go </script> first."
    assert page.count('src="data:image/png;base64,') == page.count("<figcaption>") == 3
    for alt in re.findall(r'alt="([^"]*)"', page):
        assert alt.startswith("A &quot;leaf&quot; &amp; more. Threshold")
    assert "<noscript" not in page  # the still pictures are there until the module takes their place
    assert not re.search(r"https?://", page)
    assert len(page) < 70_000


def test_nothing_removed_travels_as_null(solids):
    picture = explore.viewer(solids, threshold=-np.inf)
    thresholds = {"surface": None, "wireframe": 2 * np.pi}
    assert page_data(picture.to_html())["thresholds"] == thresholds
    assert picture.get_state("thresholds") == {"thresholds": thresholds}
    picture.set_state({"thresholds": thresholds | {"surface": 1.0}})
    assert picture.threshold == 1.0
    picture.set_state({"thresholds": thresholds})
    assert picture.threshold == -np.inf


def test_each_strategy_starts_where_the_paper_cuts_and_keeps_its_threshold(leaf, solids):
    assert explore.viewer(leaf).threshold == 2 * np.pi
    assert explore.viewer(leaf, threshold=0).threshold == 0
    picture = explore.viewer(solids)
    assert picture.threshold == np.pi / 3
    picture.threshold = 1.0
    heard = []
    picture.observe(lambda _: heard.append((picture.strategy, picture.threshold)), ["threshold", "strategy"])
    picture.strategy = "wireframe"
    assert picture.threshold == 2 * np.pi
    assert {*heard} == {("wireframe", 2 * np.pi)}  # nobody is told of one strategy with the other's threshold
    picture.threshold = 3.0
    picture.strategy = "surface"
    assert picture.threshold == 1.0
    assert picture.thresholds == {"surface": 1.0, "wireframe": 3.0}
    # As a browser tells it: the strategy and, in the same message or in a later one, another threshold.
    picture.set_state({"strategy": "wireframe", "thresholds": {"surface": 1.0, "wireframe": None}})
    assert picture.threshold == -np.inf
    picture.set_state({"strategy": "surface"})
    assert picture.threshold == 1.0
    assert picture.counts() == expected(solids[0], 1.0)


def test_threshold_that_is_given_is_that_of_the_strategy_shown_first(solids):
    picture = explore.viewer(solids, threshold=0.5, strategy="wireframe")
    assert picture.thresholds == {"surface": np.pi / 3, "wireframe": 0.5}
    assert picture.threshold == 0.5
    with pytest.raises(psl.InputError, match="threshold is inf"):
        picture.thresholds = {"surface": np.inf}
    with pytest.raises(psl.InputError, match="unknown strategy 'wire'"):
        picture.thresholds = {"wire": 1.0}
    assert picture.thresholds == {"surface": np.pi / 3, "wireframe": 0.5}


def test_slider_has_its_knee_where_its_levels_have(solids):
    header = explore.viewer(solids).scene["variants"][0]["hierarchies"]
    assert [about["knee"] / np.pi for about in header] == [1, 2.5]
    assert header[0]["largest"] <= 1.01 * np.pi < 2.5 * np.pi < header[1]["largest"]


@pytest.mark.parametrize(
    "source",
    [
        psl.Polyball([(0, 0), (1, 0), (5, 0)], [1, 0.8, 0.5]),
        psl.Polyball([(0, 0, 0), (1, 0, 0), (2, 0.3, 0), (1, 1, 0.2)], [1, 0.8, 0.7, 0.9]),
        psl.voronoi(np.random.default_rng(1).random((20, 2))),
        psl.voronoi(np.random.default_rng(1).random((20, 3))),
        psl.sk2(psl.datasets.load("leaf").resample(70, 0.5)),
        psl.sk3(psl.conform(psl.datasets.load("gear"))),
    ],
    ids=lambda source: f"{type(source).__name__}{source.dimension}",
)
def test_branches_are_those_of_the_branch_graph_also_without_thresholds(source):
    skeleton = source.skeleton() if isinstance(source, psl.Polyball) else source
    graph = psl.branch_graph(skeleton)
    assert explore.viewer(source).counts()["branches"] == graph.graph["branches"]


def test_no_arm_hides_another_at_first():
    h = psl.hierarchy(psl.datasets.load("fourbranch"), "wireframe")
    nodes = [node for _, node in h.branches(2 * np.pi).nodes(data=True)]
    ends = np.array([node["pos"] for node in nodes if node["kind"] == "end"])
    view = explore.viewer(h).scene["view"]
    a, e = np.radians([view["azim"], view["elev"]])
    right = -np.sin(a), np.cos(a), 0
    up = -np.sin(e) * np.cos(a), -np.sin(e) * np.sin(a), np.cos(e)
    tips = ends - h.P.tessellation.points.mean(axis=0)
    x, y = (tips @ np.transpose([right, up])).T
    assert len(tips) == 4
    turns = np.sort(np.degrees(np.arctan2(y, x)))
    assert np.diff([*turns, turns[0] + 360]).min() > 50  # around the middle
    reach = np.linalg.norm(tips, axis=1)
    assert (np.hypot(x, y) > 0.5 * reach).all()  # none points at the reader
    assert explore.viewer(h).scene["view"] == view


def test_dict_of_variants_shares_one_scale():
    horse = psl.datasets.load("horse")
    shapes = {f"n = {n}": psl.conform(horse.resample(n)) for n in (60, 120)}
    picture = explore.viewer(shapes, variant="number of samples", threshold=1.0)
    first, second = picture.scene["variants"]
    scales = [{k: h[k] for k in ("largest", "power")} for h in first["hierarchies"] + second["hierarchies"]]
    assert scales[0] == scales[1]
    assert picture.scene["variant"] == "Number of samples"
    picture.variant = "n = 120"
    assert picture.counts() == expected(psl.hierarchy(shapes["n = 120"]), 1.0)
    assert picture.to_html().count("<figcaption>Number of samples: n = ") == 2


def test_each_variant_of_a_skeleton_has_the_shape_of_its_key():
    shapes = {n: psl.datasets.load("lake", n=n) for n in (400, 800)}
    skeletons = {n: psl.sk0(shape) for n, shape in shapes.items()}
    picture = explore.viewer(skeletons, shape=shapes)
    assert [variant["samples"]["size"] for variant in picture.scene["variants"]] == [400, 800]
    with pytest.raises(psl.InputError, match="no entry 800"):
        explore.viewer(skeletons, shape={400: shapes[400]})


def test_skeleton_alone_has_no_threshold():
    points = np.random.default_rng(1).random((20, 2))
    voronoi = psl.voronoi(points)
    picture = explore.viewer(voronoi)
    assert not picture.scene["filters"]
    assert not picture.scene["shape"]
    assert picture.counts()["edges"] == len(voronoi.edges)
    header = picture.scene["variants"][0]
    assert pack.read(pack.unpack(picture.blob), header["rays"]).size == 8 * len(voronoi.rays)
    assert picture.to_html().count("<img ") == 1


def test_skeleton_in_a_shape():
    shape = psl.conform(psl.datasets.load("gear"))
    picture = explore.viewer(psl.sk2(shape), shape=shape, color="none", samples=True)
    assert picture.scene["shape"]
    assert picture.samples


def test_shape_beneath_a_polyball():
    X = psl.datasets.load("horse")
    Y = psl.sk2(X, X.sample(25)).balls()
    picture = explore.viewer({"few": Y}, shape=X)
    header, data = picture.scene["variants"][0], pack.unpack(picture.blob)
    lines = pack.read(data, header["beneath"]).reshape(-1, 2, 4)
    assert np.allclose(lines[..., :2], X.segments, atol=1e-6)
    assert not lines[..., 2:].any()
    low, high = np.array(picture.scene["low"]), np.array(picture.scene["high"])
    assert (low <= X.points.min(axis=0)).all()  # few balls: the horse reaches beyond them
    assert (high >= X.points.max(axis=0)).all()
    assert "beneath" not in explore.viewer(Y).scene["variants"][0]
    with pytest.raises(psl.InputError, match="both in the plane"):
        explore.viewer(psl.Polyball([(0, 0, 0)], [1]), shape=X)


def test_polyballs_in_the_plane_and_in_space():
    Y = psl.Polyball([(0, 0), (1, 0), (5, 0)], [1, 0.8, 0.5])
    picture = explore.viewer({"three": Y, "two": psl.Polyball(Y.centers[:2], Y.radii[:2])})
    header, data = picture.scene["variants"][0], pack.unpack(picture.blob)
    points = pack.read_places(data, header["points"])
    outline = points[pack.read(data, header["surface"])]
    assert np.abs(Y.boundary_distance(outline)).max() < 1e-3
    assert picture.counts()["vertices"] == len(Y.skeleton().vertices)
    assert not picture.scene["samples"]
    assert picture.to_html().count("<img ") == 2
    solid = psl.Polyball([(0, 0, 0), (1, 0, 0)], [1, 0.8])
    picture = explore.viewer(solid)
    header, data = picture.scene["variants"][0], pack.unpack(picture.blob)
    assert pack.read(data, header["surface"]).size == solid.patches()[1].size
    assert picture.counts()["edges"] == len(solid.skeleton().edges)


@pytest.mark.parametrize(
    ("source", "options", "words"),
    [
        ("a leaf", {}, "cannot show str"),
        ([], {}, "cannot show list"),
        ({}, {}, "is empty"),
        ("leaf", {"color": "red"}, "unknown color 'red'"),
        ("leaf", {"threshold": np.nan}, "threshold is nan"),
        ("leaf", {"strategy": "surface"}, "unknown strategy 'surface'"),
        ("leaf", {"variant": "v", "opcaity": 1}, "unknown option 'opcaity'"),
        ("twice", {}, "the same strategy and criterion"),
        ("mixed", {}, "different shapes"),
        ("kinds", {}, "another dimension or other strategies"),
    ],
)
def test_errors_say_what_to_do(source, options, words, leaf, solids):
    lake = psl.hierarchy(psl.datasets.load("lake"))
    known = {
        "leaf": leaf,
        "twice": [leaf, leaf],
        "mixed": [leaf, lake],
        "kinds": {"a": leaf, "b": solids[0]},
    }
    source = known.get(source, source) if isinstance(source, str) else source
    with pytest.raises(psl.InputError, match=words):
        explore.viewer(source, **options)


def test_saved_page_needs_nothing_else(leaf, tmp_path):
    explore.viewer(leaf, alt="A leaf.").save(tmp_path / "index.html", title="Leaf & skeleton")
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert "<title>Leaf &amp; skeleton</title>" in page
    assert page.count("export default { render }") == 1
    command = [sys.executable, str(ROOT / "tools" / "check_offline.py"), str(tmp_path)]
    assert subprocess.run(command, capture_output=True).returncode == 0


def test_module_can_stand_in_a_page():
    module = explore.SkeletonViewer._esm
    assert "</script" not in module
    assert not re.search(r"https?://|\bimport\b[^.]*\bfrom\b", module)


def test_stored_notebooks_keep_the_page_and_not_the_live_widget():
    sys.path.insert(0, str(ROOT / "tools"))
    try:
        from run_notebooks import clean
    finally:
        sys.path.pop(0)
    data = {WIDGET_VIEW: {"model_id": "7"}, "text/html": "<p>still here</p>", "text/plain": "SkeletonViewer"}
    output = nbformat.v4.new_output("display_data", data=data)
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("x", outputs=[output])])
    notebook.metadata["widgets"] = {"application/vnd.jupyter.widget-state+json": {}}
    cleaned = clean(notebook, "01_x")
    assert set(cleaned.cells[0].outputs[0].data) == {"text/html", "text/plain"}
    assert "widgets" not in cleaned.metadata


def test_library_does_not_need_widgets():
    hidden = """
import sys
sys.modules["anywidget"] = None
import polyskel_lite
assert "ipywidgets" not in sys.modules
from polyskel_lite import explore
explore.viewer
"""
    done = subprocess.run([sys.executable, "-c", hidden], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 1
    assert "ImportError: polyskel_lite.explore needs anywidget, which is not installed" in done.stderr
    assert "pip install ipywidgets anywidget" in done.stderr


def test_names_of_the_package_are_functions_even_after_their_modules_are_imported():
    importlib.import_module("polyskel_lite.explore.explorers")
    assert explore.balls.__name__ == "balls"
    assert explore.viewer.__name__ == "viewer"
    assert "viewer" in dir(explore)
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = explore.nothing
