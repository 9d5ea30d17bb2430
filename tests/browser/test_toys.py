"""Explorers on pages without a kernel: they say what Python says, by mouse, touch and keyboard."""

import re
from pathlib import Path

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import explore, figures
from polyskel_lite.explore.bundle import page_module, page_style, whole_page
from polyskel_lite.simplification import try_removal

from .accessibility import STRUCTURE, findings
from .conftest import ROOT, pages

HORSE = psl.datasets.load("horse")
LAKE = psl.datasets.load("lake")
MAKERS = {
    "graphs": lambda: explore.graphs(),
    "maximal_ball": lambda: explore.maximal_ball(),
    "sampling": lambda: explore.sampling(n=50),
    "sampling-lake": lambda: explore.sampling(LAKE, n=60),
    "four_methods": lambda: explore.four_methods(),
    "four_methods-lake": lambda: explore.four_methods(LAKE, n=120, start=0.3),
    "balls": lambda: explore.balls(),
    "refinement": lambda: explore.refinement(),
    "removals": lambda: explore.removals(),
}
# What a page shows of an explorer, once a control or a handle was moved.
SHOWN = """({ values = {}, handle = -1, place }) => {
    const { toy } = document.querySelector(".psl-toy");
    if (handle >= 0) toy.model.data.handles = toy.handles.map((old, k) => (k === handle ? place : old));
    toy.set(values);
    const [text, alt, legend] = ["text", "alt", "_legend"].map((name) => toy.model.get(name));
    const pictures = toy.model.get("_layers").map((name) => [name, toy.model.get(`_svg_${name}`)]);
    const drawn = pictures.filter(([, picture]) => picture);
    return { text, alt, legend, layers: drawn.map(([name]) => name), drawn };
}"""


def write(path: Path, body: str, toys) -> None:
    """A page of its own with these explorers."""
    path.write_text(whole_page(path.stem, body, page_module(toys), page_style()), encoding="utf-8")


@pytest.fixture(scope="module")
def folder(browser, tmp_path_factory) -> Path:
    """A page of each explorer."""
    folder = tmp_path_factory.mktemp("toys")
    for name, make in MAKERS.items():
        explorer = make()
        write(folder / f"{name}.html", explorer.stand_in(), [type(explorer).__name__])
    return folder


@pytest.fixture
def opened(visit, folder):
    """opened(name, **context): the page of an explorer, ready."""

    def open_page(name: str, **context):
        return visit(folder.as_uri(), f"{name}.html", **context)

    return open_page


def shown(explorer) -> dict[str, object]:
    """The same of an explorer in Python."""
    board = explorer.board
    layers = [name for name in board.get_state(["_layers"])["_layers"] if board.picture(name)]
    drawn = [[name, board.picture(name)] for name in layers]
    return {"text": board.text, "alt": board.alt, "legend": board.legend, "layers": layers, "drawn": drawn}


def assert_same(said: dict, explorer, *where) -> None:
    """The page says what Python says, and draws the same numbers in each layer, in whatever order."""
    own = shown(explorer)
    pictures = [dict(state.pop("drawn")) for state in (said, own)]
    assert said == own, where
    for name in own["layers"]:
        a, b = (
            np.sort(np.array(re.findall(r"-?\d+", "".join(re.findall(r' d="([^"]*)"', p[name]))), float))
            for p in pictures
        )
        assert len(a) == len(b), (name, *where)
        assert np.abs(a - b).max(initial=0) <= 2, (
            name,
            *where,
        )  # tenths of a pixel: roundings of ends and radii


def some_values(explorer, rng) -> dict[str, object]:
    """Other places for some of the controls, as a reader could choose them."""
    values = {}
    for name, control in explorer.controls.items():
        if not hasattr(control, "value") or rng.random() < 0.4:
            continue
        if hasattr(control, "options"):
            pairs = [o if isinstance(o, tuple) else (o, o) for o in control.options]
            values[name] = pairs[rng.integers(len(pairs))][1]
        elif isinstance(control.value, bool):
            values[name] = bool(rng.random() < 0.5)
        else:
            steps = int(rng.integers(round((control.max - control.min) / control.step) + 1))
            values[name] = type(control.value)(round(control.min + steps * control.step, 6))
    return values


@pytest.mark.parametrize("name", MAKERS)
def test_page_and_python_say_the_same(opened, name):
    found, explorer, rng = opened(name), MAKERS[name](), np.random.default_rng(11)
    assert_same(found.page.evaluate(SHOWN, {}), explorer)
    low, high = np.reshape(explorer.board.box, (2, 2))
    for turn in range(40):
        places = np.array(explorer.board.handles)
        if len(places) and turn % 2:  # one handle, anywhere
            handle, place = int(rng.integers(len(places))), (low + rng.random(2) * (high - low)).round(6)
            places[handle] = place
            values, told = {}, {"handle": handle, "place": place.tolist()}
        else:
            values = some_values(explorer, rng)
            told = {"values": values}
        with explorer.together():
            for control, value in values.items():
                explorer.controls[control].value = value
            if len(places):
                explorer.board.handles = places
        assert_same(found.page.evaluate(SHOWN, told), explorer, turn, told, places.tolist())
    found.assert_quiet()


def line(page) -> str:
    return page.locator(".psl-text").inner_text()


def test_handles_follow_keys_mouse_and_touch(opened):
    found, explorer = opened("graphs"), MAKERS["graphs"]()
    page, step = found.page, explorer.board.step
    handle = page.locator(".psl-handle").nth(3)
    x, y = explorer.board.handles[3]

    def python_says(x, y):
        explorer.board.handles = [*explorer.board.handles[:3], (x, y), *explorer.board.handles[4:]]
        return explorer.board.text

    handle.focus()
    page.keyboard.press("Shift+ArrowLeft")
    page.keyboard.press("ArrowUp")
    assert line(page) == python_says(x - 10 * step, y + step)
    box = handle.bounding_box()
    page.mouse.move(box["x"] + 16, box["y"] + 16)
    page.mouse.down()
    page.mouse.move(box["x"] + 76, box["y"] - 34, steps=5)
    page.mouse.up()
    x, y = (float(handle.get_attribute(f"data-{k}")) for k in "xy")
    assert line(page) == python_says(x, y)
    found.assert_quiet()


def test_a_finger_moves_a_handle_and_scrolls_beside_it(opened):
    found = opened("maximal_ball", viewport={"width": 390, "height": 600}, has_touch=True, is_mobile=True)
    page = found.page
    page.evaluate("document.body.style.paddingBottom = '1200px'")
    touch = page.context.new_cdp_session(page)

    def swipe(x, y, way):
        points = [[{"x": x + way[0] * k / 8, "y": y + way[1] * k / 8}] for k in range(9)]
        kinds = ["touchStart", *["touchMove"] * 8, "touchEnd"]
        for kind, place in zip(kinds, [*points, []], strict=True):
            touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": place})
            page.wait_for_timeout(16)
        page.wait_for_timeout(300)

    before, high, box = line(page), page.evaluate("scrollY"), page.locator(".psl-handle").bounding_box()
    swipe(box["x"] + 16, box["y"] + 16, (-60, 10))
    assert line(page) != before
    assert page.evaluate("scrollY") == high
    stage = page.locator(".psl-stage").bounding_box()
    swipe(stage["x"] + 20, stage["y"] + stage["height"] - 20, (0, -150))
    assert page.evaluate("scrollY") > high + 50
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


@pytest.mark.parametrize("name", MAKERS)
def test_a_finger_moves_what_is_open_at_first(opened, name):
    """A tap on the slider, or a dot that is dragged; then the line is Python's for the new place."""
    phone = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
    found, explorer = opened(name, **phone), MAKERS[name]()
    page = found.page
    before, slider = line(page), page.locator(".psl-knobs > .psl-slider input[type=range]")
    if explorer.board.handles:
        page.locator(".psl-stage").scroll_into_view_if_needed()
        box = page.locator(".psl-handle").first.bounding_box()
        touch = page.context.new_cdp_session(page)
        for kind, k in (("touchStart", 0), *(("touchMove", k) for k in range(1, 9)), ("touchEnd", None)):
            place = [] if k is None else [{"x": box["x"] + 16 + 4 * k, "y": box["y"] + 16 + 3 * k}]
            touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": place})
            page.wait_for_timeout(16)
        dots = page.locator(".psl-handle").all()  # another one may lie over the first
        explorer.board.handles = [[float(dot.get_attribute(f"data-{axis}")) for axis in "xy"] for dot in dots]
    else:
        box = slider.bounding_box()
        page.touchscreen.tap(box["x"] + 0.7 * box["width"], box["y"] + box["height"] / 2)
        control = slider.get_attribute("data-control")
        explorer.controls[control].value = int(slider.input_value())
    assert line(page) != before
    assert line(page) == explorer.board.text
    found.assert_quiet()


@pytest.mark.parametrize("name", MAKERS)
def test_every_control_works_by_keyboard(opened, name):
    found, explorer = opened(name), MAKERS[name]()
    page = found.page
    page.locator("summary").press("Enter")
    keys = {"range": ["Home", "PageUp"], "checkbox": ["Space"], "button": ["Enter"]}
    for control, widget in explorer.controls.items():
        part = page.locator(f"[data-control={control}]")
        label = part.evaluate("node => node.labels?.[0]?.textContent || node.textContent")
        assert label == widget.description
        for key in keys.get(part.get_attribute("type"), ["ArrowDown"]):
            part.press(key)
        if hasattr(widget, "value"):
            value = page.evaluate("name => document.querySelector('.psl-toy').toy.value(name)", control)
            assert value != widget.value
            widget.value = value
        else:
            widget.click()
        assert line(page) == explorer.board.text, control
    found.assert_quiet()


def test_a_number_can_be_typed(opened):
    found, explorer = opened("sampling"), MAKERS["sampling"]()
    number = found.page.locator("input[type=number]").first
    number.fill("111")
    number.press("Enter")
    explorer.controls["n"].value = 111
    assert line(found.page) == explorer.board.text
    number.fill("100000")
    number.press("Enter")
    explorer.controls["n"].value = explorer.controls["n"].max
    assert line(found.page) == explorer.board.text
    assert number.input_value() == str(explorer.controls["n"].max)


def test_balls_are_added_and_removed(opened):
    found, explorer = opened("balls"), MAKERS["balls"]()
    page = found.page
    page.locator("summary").click()
    for _ in range(10):
        page.get_by_role("button", name="add a ball").click()
        explorer.add()
        assert line(page) == explorer.board.text
    assert line(page).startswith("16 balls are as many")
    for _ in range(16):
        page.get_by_role("button", name="remove this ball").click()
        explorer.remove(explorer.controls["ball"].value)
        assert line(page) == explorer.board.text
    assert line(page) == "One ball has to stay."
    assert page.locator(".psl-handle").count() == 2
    found.assert_quiet()


@pytest.mark.parametrize("name", ["graphs", "sampling", "balls"])  # the pages' own test has all of them
def test_a_page_is_accessible(opened, name):
    found = opened(name, viewport={"width": 390, "height": 844}, color_scheme="dark")
    assert findings(found.page, STRUCTURE) == []
    small = found.page.evaluate(
        """() => [...document.querySelectorAll(".psl-knobs :is(button, select, input), .psl-handle")]
            .filter((node) => node.getBoundingClientRect().height < 24 && !node.closest("label"))
            .map((node) => node.outerHTML)"""
    )
    assert [node for node in small if "checkbox" not in node] == []


def test_without_javascript_the_picture_and_its_words_are_there(visit, folder):
    found = visit(folder.as_uri(), "balls.html", java_script_enabled=False)
    explorer = MAKERS["balls"]()
    text = found.page.locator("figure").inner_text()
    assert explorer.look_for in text
    assert explorer.board.text in text
    assert "moves on a page with JavaScript" in text
    assert found.page.locator("figure svg[role=img]").get_attribute("aria-label") == explorer.board.alt


def test_all_explorers_on_one_page(visit, folder):
    explorers = [make() for make in MAKERS.values()]
    names = {type(explorer).__name__ for explorer in explorers}
    assert all(len(page_module([name]).encode()) < 60_000 for name in names)
    module = page_module(names)
    # Indentation is taken off, so no text in the modules may go over several lines.
    assert [row for row in module.splitlines() if row.count("`") % 2] == []
    write(folder / "all.html", "".join(explorer.stand_in() for explorer in explorers), names)
    found = visit(folder.as_uri(), "all.html")
    assert found.page.locator(".psl-text").all_inner_texts() == [one.board.text for one in explorers]
    found.assert_quiet()


#: Chapters and the explorers that they show.
IN_CHAPTERS = {
    name: re.findall(r'json\\">\{\\"toy\\":\\"(\w+)', file.read_text("utf-8"))
    for name in pages()
    if (file := ROOT / f"notebooks/{name}.ipynb").exists()
}


def test_every_explorer_of_the_plane_is_in_a_chapter():
    shown = {toy for toys in IN_CHAPTERS.values() for toy in toys}
    assert shown == {type(make()).__name__ for make in MAKERS.values()}


TIED = """<p>With <span class="psl-knob" data-to="n">50</span> samples the covering radius is
<span class="psl-reading" data-to="covering_radius">0.0445</span>. Try
<span class="psl-state" data-to='{"n": 100, "noise": 0.2}'>n = 100</span>.</p>"""


def test_words_of_the_text_follow_and_move_an_explorer(visit, folder):
    page = (folder / "sampling.html").read_text("utf-8").replace("</main>", f"{TIED}</main>")
    (folder / "tied.html").write_text(page, encoding="utf-8")
    found, explorer = visit(folder.as_uri(), "tied.html"), MAKERS["sampling"]()
    page = found.page
    reading, knob = page.locator(".psl-reading"), page.locator(".psl-knob input")
    assert reading.inner_text() == f"{explorer.numbers['covering_radius']:.4g}"
    assert knob.get_attribute("aria-label") == "samples n"
    knob.fill("79.6")
    explorer.controls["n"].value = 80
    assert line(page) == explorer.board.text
    assert reading.inner_text() == f"{explorer.numbers['covering_radius']:.4g}"
    knob.blur()
    assert knob.input_value() == "80"
    knob.fill("1e9")
    knob.blur()
    assert knob.input_value() == "400"
    page.evaluate("document.querySelector('.psl-toy').toy.set({ start: 0.5 })")
    page.get_by_role("button", name="n = 100").press("Enter")  # the shift goes back, too
    with explorer.together():
        explorer.controls["n"].value, explorer.controls["noise"].value = 100, 0.2
    assert line(page) == explorer.board.text
    assert knob.input_value() == "100"
    assert findings(page, STRUCTURE) == []
    found.assert_quiet()
    plain = visit(folder.as_uri(), "tied.html", java_script_enabled=False)
    assert "With 50 samples the covering radius is 0.0445" in " ".join(plain.page.inner_text("main").split())


def test_samples_at_one_place_or_on_one_line(opened):
    found, explorer = opened("graphs"), MAKERS["graphs"]()
    page, places = found.page, [list(place) for place in explorer.board.handles]
    said = page.evaluate(SHOWN, {"handle": 4, "place": places[2]})
    assert said["text"] == "Samples 2 and 4 are at one place; move one of them."
    assert said["layers"] == []
    assert_same(page.evaluate(SHOWN, {"handle": 4, "place": places[4]}), explorer)
    for k, (x, _) in enumerate(places):
        said = page.evaluate(SHOWN, {"handle": k, "place": [x, 2]})
    assert said["text"] == "All samples are on one line: there is no triangle."
    found.assert_quiet()


def test_the_last_triangle_goes_with_a_word(opened):
    found, explorer = opened("graphs"), MAKERS["graphs"]()
    last = explorer.controls["triangle"].max
    explorer.controls["triangle"].value = last
    assert_same(found.page.evaluate(SHOWN, {"values": {"triangle": last}}), explorer)
    places = np.array(explorer.board.handles)
    for step in range(1, 40):  # a corner of it goes to the middle, until it is gone
        place = (places[8] + (places.mean(axis=0) - places[8]) * step / 40).round(6)
        explorer.board.handles = [*places[:8], place, *places[9:]]
        assert_same(found.page.evaluate(SHOWN, {"handle": 8, "place": place.tolist()}), explorer)
        if "are no triangle any more" in explorer.board.text:
            return
    raise AssertionError("the triangle stayed")


def test_tangent_balls_are_called_as_on_the_board(visit, folder):
    explorer = explore.balls(psl.Polyball([(0, 0), (5, 5), (2, 0)], [1, 1, 1]))
    assert explorer.board.text.startswith("Balls 1 and 3 touch without crossing")
    write(folder / "tangent.html", explorer.stand_in(), ["Balls"])
    assert line(visit(folder.as_uri(), "tangent.html").page) == explorer.board.text


# What the text says was seen: chapter, the words of a button in it, and what the line under the picture says.
SEEN = [
    ("02_1_shapes", "n = 100", "covering radius 0.02226 "),
    ("02_1_shapes", "n = 200", "covering radius 0.01113 "),
    ("02_1_shapes", "n = 200", "ends 17 · Betti numbers of Sk2 (1, 0)"),
    ("02_1_shapes", "0.2 % at n = 200", "ends 27 "),
    ("03_2_convergence", "7 ends", "n 50 · "),
    ("03_2_convergence", "7 ends", "ends 7 "),
    ("03_2_convergence", "25 ends", "ends 25 "),
    ("03_2_convergence", "72 ends", "ends 72 "),
    ("03_2_convergence", "Without noise", "ends 3 "),
    ("03_5_comparison", "nine steps", "Step 9 of 9: 95 samples, all 95 sides are in the Gabriel graph"),
    ("03_four_methods", "with 104 samples", "Sk2: 113 vertices, 112 edges, Betti (1, 0)"),
    ("03_four_methods", "n = 200 with shift 0.7", "Sk0: none, 1 side is not Delaunay"),
    ("03_four_methods", "no shift", "Sk0: 198 vertices, 197 edges, Betti (1, 0)"),
    ("04_2_homotopy", "33 removals", "33 of 33 triangles are gone. No hat is left"),
]


@pytest.mark.parametrize("name", sorted({name for name, *_ in SEEN}))
def test_what_was_seen_is_what_the_explorer_says(visit, book, name):
    found = visit(book.as_uri(), f"{name}.html")
    page, toy = found.page, found.page.locator(".psl-toy").last
    assert page.locator(".psl-told").last.is_hidden()  # it would give the answer away
    locked = page.get_by_role("button", name=re.compile("Open without one|Show the answer"))
    while locked.count():
        locked.first.click()
    assert page.locator(".psl-told").count() == 0
    for _, words, said in [row for row in SEEN if row[0] == name]:
        page.locator(".psl-state").get_by_role("button", name=words, exact=True).click()
        assert said in toy.locator(".psl-text").inner_text() + " ", words
    found.assert_quiet()


def test_numbers_that_were_seen_one_after_the_other():
    explorer = explore.refinement(psl.datasets.load("horse", n=40))
    assert explorer.numbers["missing_per_step"] == [11, 10, 7, 4, 4, 4, 2, 2, 2, 0]
    smooth = explore.sampling(figures.regular_shape())
    for n, ends in ((50, 3), (100, 3), (200, 4)):
        smooth.controls["n"].value = n
        assert smooth.numbers["ends"] == ends
    four = explore.four_methods(HORSE)
    for n in range(20, 111):
        four.controls["n"].value = n
        assert min(four.numbers[name]["betti"][0] for name in ("Sk2", "Sk3")) > 1, n
        assert four.numbers["Sk0"] is None or four.numbers["Sk0"]["betti"] == (1, 0)
    removals = explore.removals(psl.datasets.load("gear", n=60))
    removals.controls["step"].value = 33
    assert removals.numbers["left"] == 27
    assert kinds(removals) == {(2, (1, 0))}
    removals.controls["step"].value = 0
    assert {(2, (2, 1)), (2, (1, 0)), (3, (2, 0))} <= kinds(removals)


def kinds(removals) -> set[tuple[int, tuple[int, int]]]:
    """Of every triangle that is left: with how many it shares a side, and the Betti numbers without it."""
    tries = [
        try_removal(removals.hierarchy, removals.controls["step"].value, int(row))
        for row in removals.hierarchy.simplices
    ]
    return {(found.shared, found.after) for found in tries if found}
