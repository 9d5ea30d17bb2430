"""The skeleton viewer on a page without a kernel: what it shows is what the library's hierarchy says."""

import io
import math
from itertools import pairwise
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
        about = {"alt": f"A {name} shape and its skeleton.", "look": "Short branches go first."}
        explore.viewer(own, threshold=0, **about).save(folder / f"{name}.html")
    return folder


def unfolded(page):
    """The viewer with all its controls open."""
    root = page.locator(".psl-viewer")
    root.locator("summary").click()
    root.locator("[data-control=color]").wait_for()
    return root


def pixels(page) -> np.ndarray:
    """The picture as the reader sees it, once it is at rest."""
    page.evaluate(AT_REST)
    return matplotlib.image.imread(io.BytesIO(page.locator(".psl-viewer canvas").screenshot()))


def drawn(page) -> str:
    """The picture at rest without what is around it."""
    page.evaluate(AT_REST)
    return page.locator(".psl-viewer canvas").evaluate("canvas => canvas.toDataURL()")


def changed(before: np.ndarray, after: np.ndarray) -> float:
    """The share of pixels whose colour is clearly another one."""
    return float((np.abs(before - after).max(axis=-1) > 0.2).mean())


@pytest.mark.parametrize(
    ("name", "strategy"), [("flat", "branch"), ("solid", "surface"), ("solid", "wireframe")]
)
def test_the_slider_follows_the_hierarchy(visit, folder, hierarchies, name, strategy):
    opened = visit(folder.as_uri(), f"{name}.html", before=SPY)
    root = unfolded(opened.page)
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
    root = unfolded(opened.page)
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
    root = unfolded(opened.page)
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
    opened.page.mouse.move(box["x"] + float(before[0]), box["y"] + float(before[1]))
    shown = pixels(opened.page)
    opened.page.keyboard.down("Control")  # without it the wheel is that of the page
    for turn in turns:
        opened.page.mouse.wheel(0, turn)
    opened.page.keyboard.up("Control")
    assert changed(shown, pixels(opened.page)) > 1e-3
    assert np.abs(corner() - before).max() <= 2
    opened.assert_quiet()


def test_the_picture_is_saved(visit, folder):
    opened = visit(folder.as_uri(), "flat.html")
    unfolded(opened.page)
    with opened.page.expect_download() as waiting:
        opened.page.locator("[data-control=save]").click()
    saved = matplotlib.image.imread(waiting.value.path(), format="png")
    assert saved.std() > 0.05


@pytest.mark.parametrize("name", ["flat", "solid"])
def test_the_wheel_scrolls_the_page_and_with_a_key_zooms(visit, folder, name):
    opened = visit(folder.as_uri(), f"{name}.html", viewport={"width": 900, "height": 500})
    page, canvas = opened.page, opened.page.locator(".psl-viewer canvas")
    canvas.click()  # once this caught the wheel
    assert canvas.evaluate("canvas => canvas === document.activeElement")
    page.evaluate("scrollTo(0, 0)")
    first, box = drawn(page), canvas.bounding_box()
    page.mouse.move(box["x"] + 200, box["y"] + 200)
    page.mouse.wheel(0, 120)
    page.wait_for_function("scrollY > 50")
    assert drawn(page) == first
    page.evaluate("scrollTo(0, 0)")
    for key in ("Control", "Meta"):
        last = pixels(page)
        page.keyboard.down(key)
        page.mouse.wheel(0, -240)
        page.keyboard.up(key)
        assert changed(last, pixels(page)) > 0.005, key
        assert page.evaluate("[scrollY, visualViewport.scale]") == [0, 1]
    assert "Ctrl (Cmd) and the wheel" in page.locator(".psl-hint").inner_text()
    opened.assert_quiet()


class Fingers:
    """Touches on a phone, through the protocol of the browser's developer tools."""

    def __init__(self, visit, folder, name):
        phone = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
        self.opened = visit(folder.as_uri(), f"{name}.html", **phone)
        self.page = self.opened.page
        # Room to scroll to, as there is in a book.
        self.page.evaluate("document.body.style.paddingBottom = '900px'")
        self.canvas = self.page.locator(".psl-viewer canvas")
        self.send = self.page.context.new_cdp_session(self.page).send

    def middle(self) -> np.ndarray:
        box = self.canvas.bounding_box()
        return np.array([box["x"] + box["width"] / 2, box["y"] + box["height"] / 2])

    def move(self, *ways) -> float:
        """Move fingers at once, each from its place by as much; how far the page was scrolled."""
        top = self.page.evaluate("scrollY")
        for k in range(13):
            points = [
                dict(zip("xy", np.add(a, np.multiply(by, k / 12)).tolist(), strict=True)) for a, by in ways
            ]
            points = [point | {"id": i} for i, point in enumerate(points)]
            self.send(
                "Input.dispatchTouchEvent",
                {"type": "touchMove" if k else "touchStart", "touchPoints": points},
            )
            self.page.wait_for_timeout(16)
        self.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        self.page.wait_for_timeout(400)
        return self.page.evaluate("scrollY") - top


@pytest.mark.parametrize("name", ["flat", "solid"])
def test_a_finger_scrolls_the_page_or_turns_the_picture(visit, folder, name):
    fingers = Fingers(visit, folder, name)
    first = drawn(fingers.page)
    assert fingers.move((fingers.middle(), (0, -200))) > 100
    assert drawn(fingers.page) == first
    fingers.canvas.tap()  # once this took the swipes from the page
    assert fingers.canvas.evaluate("canvas => canvas === document.activeElement")
    assert fingers.move((fingers.middle(), (3, -150))) > 100
    assert drawn(fingers.page) == first
    before = pixels(fingers.page)
    assert fingers.move((fingers.middle(), (90, 4))) == 0
    assert changed(before, pixels(fingers.page)) > 0.01
    fingers.opened.assert_quiet()


@pytest.mark.parametrize("way", [(60, 0), (0, 60)])
@pytest.mark.parametrize("tapped", [False, True])
def test_two_fingers_zoom_the_picture_and_not_the_page(visit, folder, way, tapped):
    fingers = Fingers(visit, folder, "solid")
    if tapped:
        fingers.canvas.tap()
    before, way = pixels(fingers.page), np.array(way)
    apart = way / 3
    moves = (fingers.middle() - apart, -way), (fingers.middle() + apart, way)
    assert fingers.move(*moves) == 0
    assert changed(before, pixels(fingers.page)) > 0.02
    assert fingers.page.evaluate("visualViewport.scale") == 1
    assert fingers.page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    fingers.opened.assert_quiet()


def test_two_fingers_together_move_the_picture_and_not_the_page(visit, folder):
    fingers = Fingers(visit, folder, "flat")
    before, side = pixels(fingers.page), np.array([40, 0])
    assert fingers.move(*((fingers.middle() + apart, (0, -150)) for apart in (-side, side))) == 0
    assert changed(before, pixels(fingers.page)) > 0.02
    # Chromium leaves two fingers to the picture by itself; other browsers must be asked to, and only then.
    asked = """(canvas, count) => {
        const touches = [1, 2].map((identifier) => new Touch({ identifier, target: canvas }));
        const some = { touches: touches.slice(0, count), cancelable: true };
        return ["touchstart", "touchmove"].map((name) => !canvas.dispatchEvent(new TouchEvent(name, some)));
    }"""
    assert fingers.canvas.evaluate(asked, 2) == [True, True]
    assert fingers.canvas.evaluate(asked, 1) == [False, False]
    fingers.opened.assert_quiet()


def test_one_control_is_open_and_the_others_are_folded(visit, folder):
    opened = visit(folder.as_uri(), "flat.html")
    controls = opened.page.locator(".psl-viewer [data-control]").all()
    seen = [control.get_attribute("data-control") for control in controls if control.is_visible()]
    assert seen == ["threshold", "threshold-number"]
    assert len(controls) > 8
    places = ["canvas", ".psl-look", ".psl-status", ".psl-controls"]
    tops = [opened.page.locator(f".psl-viewer {place}").bounding_box()["y"] for place in places]
    assert tops == sorted(tops)  # what to look for stands under the picture
    unfolded(opened.page)
    assert all(control.is_visible() for control in controls)


def test_a_variant_has_its_slider_open(visit, tmp_path):
    shapes = {n: psl.datasets.load("lake", n=n) for n in (100, 200)}
    skeletons = {n: psl.sk0(psl.conform(shape)) for n, shape in shapes.items()}
    explore.viewer(skeletons, alt="A lake.").save(tmp_path / "lake.html")
    opened = visit(tmp_path.as_uri(), "lake.html")
    controls = opened.page.locator(".psl-viewer [data-control]").all()
    assert [c.get_attribute("data-control") for c in controls if c.is_visible()] == ["variant"]
    before = opened.page.locator(".psl-viewer").get_attribute("data-vertices")
    opened.page.locator("[data-control=variant]").press("End")
    assert opened.page.locator(".psl-viewer").get_attribute("data-vertices") != before


def test_each_strategy_has_its_threshold(visit, folder):
    opened = visit(folder.as_uri(), "solid.html")
    root = opened.page.locator(".psl-viewer")

    def choose(strategy: str) -> float:
        root.locator(f"[data-control=strategy][value={strategy}]").check()
        return float(root.get_attribute("data-threshold"))

    assert choose("surface") == 0
    assert choose("wireframe") == 2 * math.pi  # the paper's
    root.locator("[data-control=threshold]").press("ArrowLeft")
    moved = float(root.get_attribute("data-threshold"))
    assert 1.9 * math.pi < moved < 2 * math.pi
    assert choose("surface") == 0
    assert choose("wireframe") == moved


def test_ticks_set_round_thresholds(visit, folder, hierarchies):
    opened = visit(folder.as_uri(), "solid.html")
    root = opened.page.locator(".psl-viewer")
    angles = {"π/3": math.pi / 3, "2π/3": 2 * math.pi / 3, "π": math.pi, "2π": 2 * math.pi}
    for h in hierarchies["solid"]:
        root.locator(f"[data-control=strategy][value={h.strategy}]").check()
        top = h.level[np.isfinite(h.level)].max()
        names = [button.inner_text() for button in root.locator(".psl-ticks button").all()]
        assert names == [name for name, angle in angles.items() if angle < top]
        slider = root.locator("[data-control=threshold]").bounding_box()
        for name in names:
            button = root.get_by_role("button", name=f"Threshold {name}", exact=True)
            button.press("Enter")
            assert float(root.get_attribute("data-threshold")) == angles[name]
            pressed = root.locator(".psl-ticks [aria-pressed=true]").all()
            assert [other.inner_text() for other in pressed] == [name]
            # It stands where the slider's thumb is.
            share = float(root.locator("[data-control=threshold]").input_value()) / 400
            box = button.bounding_box()
            assert box["x"] + box["width"] / 2 == pytest.approx(
                slider["x"] + 8 + share * (slider["width"] - 16), abs=2
            )
    assert "2π" in names
    root.locator("[data-control=threshold]").press("ArrowRight")
    assert root.locator(".psl-ticks [aria-pressed=true]").count() == 0
    opened.assert_quiet()


def test_ticks_do_not_overlap_on_a_phone(visit, folder):
    opened = visit(folder.as_uri(), "solid.html", viewport={"width": 390, "height": 844})
    for strategy in ("surface", "wireframe"):
        opened.page.locator(f"[data-control=strategy][value={strategy}]").check()
        boxes = [button.bounding_box() for button in opened.page.locator(".psl-ticks button").all()]
        assert len(boxes) == {"surface": 1, "wireframe": 4}[strategy]
        for left, right in pairwise(boxes):
            assert left["x"] + left["width"] <= right["x"]
        assert min(min(box["width"], box["height"]) for box in boxes) >= 24


def test_a_field_that_cannot_be_read_says_what_to_type(visit, folder):
    opened = visit(folder.as_uri(), "flat.html")
    root = opened.page.locator(".psl-viewer")
    field = opened.page.get_by_role("textbox", name="multiples of π")
    says = root.locator(".psl-problem")

    def enter(text: str) -> float:
        field.fill(text)
        field.press("Enter")
        return float(root.get_attribute("data-threshold"))

    assert enter("2pi/3") == 2 * math.pi / 3
    assert root.locator(".psl-ticks [aria-pressed=true]").inner_text() == "2π/3"
    for text, words in (("-1", "never negative"), ("much", "“much” cannot be read")):
        assert enter(text) == 2 * math.pi / 3
        assert field.get_attribute("aria-invalid") == "true"
        assert field.input_value() == text  # to be mended
        assert words in says.inner_text()
        assert "pi/3" in says.inner_text()
        assert "still 0.667 π" in says.inner_text()
        assert says.get_attribute("role") == "status"
        assert field.get_attribute("aria-describedby") == says.get_attribute("id")
    assert findings(opened.page) == []
    root.locator("[data-control=threshold]").press("ArrowRight")
    assert field.get_attribute("aria-invalid") == "false"
    assert says.inner_text() == ""
    assert field.input_value() not in ("much", "0.667")
    assert enter("π/2") == math.pi / 2
    opened.assert_quiet()


@pytest.mark.parametrize("name", ["flat", "solid"])
@pytest.mark.parametrize("sign", ["data-theme=dark", "data-jp-theme-light=false"])
def test_the_picture_follows_the_theme(visit, folder, name, sign):
    opened = visit(folder.as_uri(), f"{name}.html")
    key, value = sign.split("=")
    where = "document.documentElement" if key == "data-theme" else "document.body"
    light = pixels(opened.page)
    opened.page.evaluate(f"{where}.setAttribute('{key}', '{value}')")
    dark = pixels(opened.page)
    assert light[5:15, 5:15, :3].min() == 1
    assert dark[5:15, 5:15, :3].max() < 0.15
    # Lines, dots and letters are brighter there than the ground, as they are darker here.
    assert np.median(light[..., :3].max(axis=-1)) > 0.9
    assert np.median(dark[..., :3].max(axis=-1)) < 0.25
    assert (dark[..., :3].max(axis=-1) > 0.5).mean() > 0.002
    # The colours by radius are others too: not those from before, which a change of colours makes anew.
    bright = drawn(opened.page)
    unfolded(opened.page)
    for color in ("none", "radius"):
        opened.page.locator("[data-control=color]").select_option(color)
        assert (drawn(opened.page) == bright) == (color == "radius")
    opened.page.evaluate(f"{where}.removeAttribute('{key}')")
    opened.page.locator("summary").click()
    assert changed(light, pixels(opened.page)) == 0
    opened.assert_quiet()


def test_a_viewer_that_is_locked_draws_well(visit, folder):
    """A page may hide what to look for, and keep hands off, until its reader has answered a question."""
    lock = """() => {
        const root = document.querySelector(".psl-viewer");
        for (const part of root.querySelectorAll(".psl-controls, canvas")) part.inert = true;
        root.querySelector(".psl-look").hidden = true;
    }"""
    opened = visit(folder.as_uri(), "flat.html")
    root, first = opened.page.locator(".psl-viewer"), pixels(opened.page)
    opened.page.evaluate(lock)
    box = root.locator("canvas").bounding_box()
    opened.page.mouse.move(box["x"] + 300, box["y"] + 200)
    opened.page.mouse.down()
    opened.page.mouse.move(box["x"] + 200, box["y"] + 150)
    opened.page.mouse.up()
    np.testing.assert_array_equal(pixels(opened.page), first)
    assert not root.locator(".psl-look").is_visible()
    opened.page.set_viewport_size({"width": 600, "height": 800})
    small = pixels(opened.page)
    assert small.shape[1] < first.shape[1]
    assert len(np.unique(small.reshape(-1, small.shape[-1]), axis=0)) > 20
    opened.page.evaluate("document.querySelectorAll('[inert]').forEach((part) => (part.inert = false))")
    root.locator("[data-control=threshold]").press("End")
    assert changed(small, pixels(opened.page)) > 1e-3
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
    for button in opened.page.get_by_role("button", name="Open without one").all()[::-1]:
        button.click()
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
