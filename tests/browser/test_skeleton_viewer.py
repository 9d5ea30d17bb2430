"""The skeleton viewer on a page without a kernel: what it shows is what the library's hierarchy says."""

import io
import math
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import explore

from .accessibility import STRUCTURE, findings
from .conftest import ROOT, pages

# What the graphics card is told to draw: how many points and lines the latest call of each kind had.
SPY = """
window.drawn = {};
const plain = WebGL2RenderingContext.prototype.drawElements;
WebGL2RenderingContext.prototype.drawElements = function (mode, count, ...rest) {
    if (mode === this.POINTS) window.drawn.vertices = count;
    if (mode === this.LINES) window.drawn.edges = count / 2;
    return plain.call(this, mode, count, ...rest);
};
"""
# The picture at rest: no other one for as long as the viewer takes to replace a coarse picture by a fine one.
AT_REST = """async () => {
    const root = document.querySelector(".psl-viewer");
    for (let before; before !== root.dataset.frames || !before; ) {
        before = root.dataset.frames;
        await new Promise((done) => setTimeout(done, 500));
    }
}"""
LEAST_ALPHA = """() => {
    const canvas = document.querySelector(".psl-viewer canvas");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return data.reduce((least, value, k) => (k % 4 === 3 ? Math.min(least, value) : least), 255);
}"""
# The chapters that show a viewer.
CHAPTERS = [
    name
    for name in pages()
    if (file := ROOT / f"notebooks/{name}.ipynb").exists() and "psl-viewer" in file.read_text("utf-8")
]
# Where the slider of thresholds is taken to, one after the other.
MOVES = [["Home"], ["PageUp"], ["PageUp", "ArrowRight"], ["PageUp"] * 2, ["PageUp"] * 4, ["End"]]


@pytest.fixture(scope="module")
def hierarchies() -> dict[str, list[psl.Hierarchy]]:
    """A flat shape, and a solid by both strategies."""
    solid = psl.delaunay_shape(psl.datasets.load("fourbranch"))
    return {
        "flat": [psl.hierarchy(psl.datasets.load("leaf"))],
        "solid": [psl.hierarchy(solid, strategy=strategy) for strategy in ("surface", "wireframe")],
    }


@pytest.fixture(scope="module")
def folder(browser, hierarchies, tmp_path_factory) -> Path:
    """A folder with a page of each."""
    folder = tmp_path_factory.mktemp("viewers")
    for name, own in hierarchies.items():
        page = folder / f"{name}.html"
        explore.viewer(own, alt=f"A {name} shape and its skeleton.", look="Short branches go first.").save(
            page
        )
    return folder


def pixels(page) -> np.ndarray:
    """The picture as the reader sees it, once it is at rest."""
    page.evaluate(AT_REST)
    return matplotlib.image.imread(io.BytesIO(page.locator(".psl-viewer canvas").screenshot()))


def changed(before: np.ndarray, after: np.ndarray) -> float:
    """The share of pixels whose colour is clearly another one."""
    return float((np.abs(before - after).max(axis=-1) > 0.2).mean())


@pytest.mark.parametrize(
    ("name", "strategy"), [("flat", "branch"), ("solid", "surface"), ("solid", "wireframe")]
)
def test_the_slider_follows_the_hierarchy(visit, folder, hierarchies, name, strategy):
    opened = visit(folder.as_uri(), f"{name}.html", before=SPY)
    root = opened.page.locator(".psl-viewer")
    if name == "solid":
        root.locator(f"[data-control=strategy][value={strategy}]").check()
    root.locator("[data-control=vertices]").check()
    hierarchy = next(h for h in hierarchies[name] if h.strategy == strategy)
    slider = root.locator("[data-control=threshold]")
    shown = {}
    for keys in MOVES:
        for key in keys:
            slider.press(key)
        threshold = float(root.get_attribute("data-threshold").replace("Infinity", "inf"))
        skeleton = hierarchy.skeleton(threshold)
        expected = {
            "vertices": len(skeleton.vertices),
            "edges": len(skeleton.edges),
            "polygons": len(skeleton.polygons),
            "branches": hierarchy.branches(threshold).graph["branches"],
        }
        assert {key: int(root.get_attribute(f"data-{key}")) for key in expected} == expected
        assert root.get_attribute("data-betti") == ",".join(map(str, skeleton.betti()))
        # Where there are no polygons, edges are thick lines made of triangles and are not counted here.
        drawn = {key: expected[key] for key in ("vertices", "edges")[: 1 + bool(skeleton.polygons)]}
        agree = "(drawn) => Object.entries(drawn).every(([key, count]) => window.drawn[key] === count)"
        opened.page.wait_for_function(agree, arg=drawn)
        shown[threshold] = expected["vertices"]
    assert len(shown) == len(MOVES)
    assert list(shown.values()) == sorted(shown.values(), reverse=True)
    assert len(set(shown.values())) > 3
    opened.assert_quiet()


def test_a_typed_threshold_is_exact(visit, folder, hierarchies):
    opened = visit(folder.as_uri(), "flat.html")
    root = opened.page.locator(".psl-viewer")
    field = root.locator("[data-control=threshold-number]")
    field.fill("1.25")
    field.press("Enter")
    assert float(root.get_attribute("data-threshold")) == 1.25 * math.pi
    branches = hierarchies["flat"][0].branches(1.25 * math.pi).graph["branches"]
    assert "Threshold 1.25 π: " in root.inner_text()
    assert f", {branches} branches." in root.inner_text()
    opened.assert_quiet()


@pytest.mark.parametrize("name", ["flat", "solid"])
def test_the_picture_follows_the_keyboard(visit, folder, name):
    opened = visit(folder.as_uri(), f"{name}.html")
    root = opened.page.locator(".psl-viewer")
    first = last = pixels(opened.page)
    rows, columns = (slice(size // 4, 3 * size // 4) for size in first.shape[:2])
    assert len(np.unique(first[rows, columns].reshape(-1, first.shape[-1]), axis=0)) > 20
    for control, key in (
        ("canvas", "ArrowLeft"),
        ("canvas", "+"),
        ("[data-control=threshold]", "End"),
        ("[data-control=simplified]", "End"),
    ):
        for _ in range(3):
            root.locator(control).press(key)
        now = pixels(opened.page)
        assert changed(last, now) > 2e-3, (control, key)
        last = now
    root.locator("[data-control=simplified]").press("Home")
    root.locator("[data-control=threshold-number]").fill("0")
    root.locator("[data-control=threshold-number]").press("Enter")
    root.locator("[data-control=reset]").click()
    assert changed(first, pixels(opened.page)) < 5e-3
    opened.assert_quiet()


@pytest.mark.parametrize("strategy", ["surface", "wireframe"])
def test_a_picture_shows_nothing_of_the_one_before(visit, folder, strategy):
    small = {"width": 700, "height": 700}  # so that it is drawn at its best on slow machines too
    opened = visit(folder.as_uri(), "solid.html", viewport=small)
    root = opened.page.locator(".psl-viewer")
    root.locator(f"[data-control=strategy][value={strategy}]").check()
    root.locator("[data-control=vertices]").check()
    first = pixels(opened.page)
    for _ in range(3):
        root.locator("canvas").press("ArrowLeft")
    assert changed(first, pixels(opened.page)) > 2e-3
    root.locator("[data-control=reset]").click()
    np.testing.assert_array_equal(pixels(opened.page), first)
    assert opened.page.evaluate(LEAST_ALPHA) == 255  # nor of the page beneath
    opened.assert_quiet()


@pytest.mark.parametrize("turns", [[-120] * 3, [60], [-120, -120, 90, -30]])
def test_the_wheel_keeps_the_place_under_the_pointer(visit, tmp_path, turns):
    shape = psl.Shape.from_rings([[(0, 0), (4, 0), (0, 3)]])
    picture = explore.viewer(psl.sk0(shape), shape=shape, alt="A triangle.", edges=False, color="none")
    picture.save(tmp_path / "triangle.html")
    opened = visit(tmp_path.as_uri(), "triangle.html")
    canvas = opened.page.locator(".psl-viewer canvas")

    def corner() -> np.ndarray:
        """Where the right angle, the lower left corner, stands on the canvas: x and y in pixels."""
        rows, columns = np.nonzero(pixels(opened.page)[3:-3, 3:-3, :3].min(axis=-1) < 0.98)
        return np.array([columns.min() + 3, rows.max() + 3])

    before, box = corner(), canvas.bounding_box()
    opened.page.mouse.click(box["x"] + float(before[0]), box["y"] + float(before[1]))
    shown = pixels(opened.page)  # after the click: until then the wheel is that of the page
    for turn in turns:
        opened.page.mouse.wheel(0, turn)
    assert changed(shown, pixels(opened.page)) > 1e-3
    assert np.abs(corner() - before).max() <= 2
    opened.assert_quiet()


def test_the_picture_is_saved(visit, folder):
    opened = visit(folder.as_uri(), "flat.html")
    with opened.page.expect_download() as waiting:
        opened.page.locator("[data-control=save]").click()
    saved = matplotlib.image.imread(waiting.value.path(), format="png")
    assert saved.std() > 0.05


def test_two_fingers_zoom_the_picture_and_not_the_page(visit, folder):
    phone = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
    opened = visit(folder.as_uri(), "solid.html", **phone)
    canvas = opened.page.locator(".psl-viewer canvas")
    canvas.tap()
    before, box = pixels(opened.page), canvas.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    fingers = opened.page.context.new_cdp_session(opened.page)
    for kind, gap in [
        ("touchStart", 20),
        *(("touchMove", 20 + 10 * k) for k in range(1, 9)),
        ("touchEnd", None),
    ]:
        points = [] if gap is None else [{"x": x - gap, "y": y, "id": 0}, {"x": x + gap, "y": y, "id": 1}]
        fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    assert changed(before, pixels(opened.page)) > 0.02
    assert opened.page.evaluate("visualViewport.scale") == 1
    assert opened.page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    opened.assert_quiet()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_viewer_is_accessible(visit, folder, scheme):
    opened = visit(folder.as_uri(), "solid.html", color_scheme=scheme)
    assert findings(opened.page) == []
    opened.page.set_viewport_size({"width": 390, "height": 844})
    assert findings(opened.page, STRUCTURE) == []


def test_three_still_pictures_without_javascript(visit, folder):
    opened = visit(folder.as_uri(), "solid.html", java_script_enabled=False)
    pictures = opened.page.locator(".psl-strip img")
    assert pictures.count() == 3
    for picture in pictures.all():
        assert picture.is_visible()
        assert picture.get_attribute("alt")
        assert picture.bounding_box()["width"] > 100
    opened.assert_quiet()


@pytest.mark.parametrize("name", CHAPTERS)
def test_the_viewers_of_a_chapter(visit, book, name):
    opened = visit(book.as_uri(), f"{name}.html")
    for root in opened.page.locator(".psl-viewer").all():
        whole = int(root.get_attribute("data-vertices"))
        for slider in root.locator("[data-control=threshold]").all():
            slider.press("End")
            assert int(root.get_attribute("data-vertices")) < whole
    opened.assert_quiet()
    plain = visit(book.as_uri(), f"{name}.html", java_script_enabled=False).page
    assert plain.locator(".psl-strip").count() == opened.page.locator(".psl-viewer").count()
    for picture in plain.locator(".psl-strip img").all():
        assert picture.is_visible()


def test_a_skeleton_with_fewer_vertices_leaves_its_shape_whole(visit, tmp_path):
    shape = psl.datasets.load("leaf").resample(70, 0.5)
    skeletons = [psl.sk2(shape), psl.sk0(shape)]
    assert len(skeletons[0].vertices) < len(skeletons[1].vertices)
    views = []
    for skeleton in skeletons:
        picture = explore.viewer(skeleton, shape=shape, alt="A leaf.", edges=False)
        picture.save(tmp_path / "leaf.html")
        opened = visit(tmp_path.as_uri(), "leaf.html")
        views.append(pixels(opened.page))
        opened.assert_quiet()
    assert changed(*views) < 0.001
