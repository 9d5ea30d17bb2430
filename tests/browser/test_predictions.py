"""Questions before pictures in a browser: what they lock until answered, by keyboard, mouse and touch."""

import math
import re
from pathlib import Path

import pytest

from polyskel_lite import explore
from polyskel_lite.explore.bundle import page_module, page_style, whole_page

from .accessibility import COLOURS, findings
from .conftest import ROOT, pages

CHAPTERS = [name for name in pages() if re.match(r"\d|A_|B_|index|explore", name)]
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
# As the directive writes it (tests/book/test_predictions.py). The ring is wanted in the middle.
CHOICE = """<div class="psl-predict" id="predict-{k}" data-right="1"{more}>
<p class="psl-question">What is <em>right</em>?</p><ul class="simple"><li><p>the <em>first</em></p></li>
<li><p>the second</p></li></ul><details class="psl-answer"><summary>Answer</summary>
<p class="psl-right">the second</p><p>Because.</p></details></div>"""
PLACE = """<div class="psl-predict" id="predict-{k}" data-place="{x} {y} {near}"{more}>
<p class="psl-question">Where is it?</p><details class="psl-answer"><summary>Answer</summary>
<p>It is here.</p></details></div>"""
LARGEST_MODULE = 7_000


@pytest.fixture(scope="module")
def box() -> list[float]:
    return explore.graphs().board.get_state(["_view"])["_view"]["box"]


@pytest.fixture(scope="module")
def folder(browser, box, tmp_path_factory) -> Path:
    """Small pages: a question and an explorer; a place in it; two questions for one; a question alone."""
    folder = tmp_path_factory.mktemp("questions")
    style = page_style() + (ROOT / "notebooks/_static/predict.css").read_text("utf-8")
    middle = {"x": (box[0] + box[2]) / 2, "y": (box[1] + box[3]) / 2, "near": 0.1 * (box[2] - box[0])}
    toy = explore.graphs().stand_in()
    one, two = (CHOICE.format(k=k, more="") for k in (1, 2))
    bodies = {
        "choice": f"<section>{one}{toy}</section>",
        "place": f"<section>{PLACE.format(k=1, more='', **middle)}{toy}</section>",
        "both": f"<section>{PLACE.format(k=1, more=' data-opens=next', **middle)}{two}{toy}</section>",
        "first": f"<section>{one}{two}{toy}</section>",
        "none": f"<section>{CHOICE.format(k=1, more=' data-opens=none')}{toy}</section>",
        "elsewhere": f"<section>{one}</section><section>{toy}</section>",
        "nowhere": f"<section>{PLACE.format(k=1, more='', **middle)}</section>",
    }
    for name, body in bodies.items():
        page = whole_page(name, body, page_module(["Graphs"]), style)
        (folder / f"{name}.html").write_text(page, encoding="utf-8")
    return folder


@pytest.fixture
def opened(visit, folder):
    """opened(name, **context): one of the small pages, its explorer there."""

    def open_page(name: str, **context):
        found = visit(folder.as_uri(), f"{name}.html", **context)
        if name != "nowhere" and context.get("java_script_enabled", True):
            found.page.locator(".psl-toy[data-ready]").wait_for()
        return found

    return open_page


def assert_locked(page, locked: bool = True) -> None:
    """Whether the controls of the picture are out of reach, and what to look for is hidden."""
    root = page.locator(".psl-toy, .psl-viewer").first
    parts = root.locator(".psl-controls, .psl-knobs, .psl-handle, canvas")
    inert = parts.evaluate_all("(parts) => parts.map((part) => part.inert)")
    assert len(inert) > 0
    assert set(inert) == {locked}
    assert root.locator(".psl-look").first.is_visible() is not locked
    assert root.locator(".psl-locked").count() == locked
    assert root.evaluate("(root) => 'locked' in root.dataset") is locked


def focused(page, question: str = "() => document.activeElement.textContent"):
    return page.evaluate(question)


# --- a choice -----------------------------------------------------------------------------------------


def test_by_keyboard_alone(opened):
    found = opened("choice")
    page = found.page
    assert_locked(page)
    assert page.locator(".psl-answer").is_hidden()
    assert page.get_by_role("group", name="What is right?").count() == 1
    page.keyboard.press("Tab")
    page.keyboard.press("Space")
    page.keyboard.press("Tab")
    assert focused(page) == "Lock it in"
    page.keyboard.press("Tab")
    assert focused(page) == "Open without one"
    page.keyboard.press("Tab")  # past the locked controls, to the line that says why they are locked
    assert focused(page) == "Answer the question above"
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("Enter")
    assert_locked(page, False)
    assert page.get_by_role("status").first.inner_text() == "You said: the first"
    assert page.locator(".psl-said em").inner_text() == "first"
    assert focused(page) == "Verdict"  # it stands before the controls, which may be out of sight
    assert page.get_by_role("radio").first.is_disabled()
    assert page.get_by_role("button", name="Lock it in").count() == 0
    verdict = page.locator(".psl-answer")
    assert verdict.locator("p").first.is_hidden()
    verdict.locator("summary").press("Enter")
    assert re.sub(r"\s+", " ", verdict.inner_text()) == "Verdict Not what you said: the second Because."
    found.assert_quiet()


def test_by_touch(opened):
    found = opened("choice", **PHONE)
    page = found.page
    handle = page.locator(".psl-handle").first
    before = handle.get_attribute("data-x")
    place = handle.bounding_box()
    page.touchscreen.tap(place["x"] + 16, place["y"] + 16)
    page.keyboard.press("ArrowRight")
    assert handle.get_attribute("data-x") == before
    page.get_by_text("the second").first.tap()
    page.get_by_role("button", name="Lock it in").tap()
    assert_locked(page, False)
    page.get_by_text("Verdict").tap()
    assert page.locator(".psl-right").inner_text() == "As you said: the second"
    handle.focus()
    page.keyboard.press("ArrowRight")
    page.wait_for_function(
        "(before) => document.querySelector('.psl-handle').dataset.x !== before", arg=before
    )
    small = page.evaluate(
        "() => [...document.querySelectorAll('.psl-predict :is(label, button, summary)')]"
        ".filter((part) => part.getBoundingClientRect().height < 32).length"
    )
    assert small == 0
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    found.assert_quiet()


def test_without_a_choice_it_stays_locked_and_says_so(opened):
    page = opened("choice").page
    page.get_by_role("button", name="Lock it in").click()
    assert page.locator(".psl-said").inner_text().startswith("Choose one first")
    assert_locked(page)
    page.get_by_role("button", name="Open without one").click()
    assert_locked(page, False)
    assert page.locator(".psl-said").count() == 0
    page.locator(".psl-answer summary").click()
    assert page.locator(".psl-right").inner_text() == "the second"


def test_what_a_question_locks(opened):
    """The next picture of its section, but none beyond another question unless it says so."""
    page = opened("first").page
    assert_locked(page)
    page.locator("#predict-2").get_by_role("button", name="Open without one").click()
    assert_locked(page, False)
    assert page.locator("#predict-1 fieldset").is_enabled()
    page = opened("both").page
    for number in (2, 1):
        assert_locked(page)
        page.locator(f"#predict-{number}").get_by_role("button", name="Open without one").click()
        assert focused(page) == "Answer"
        if number == 2:  # the other one is asked for now
            assert page.locator(".psl-locked a").get_attribute("href") == "#predict-1"
    assert_locked(page, False)
    for name in ("none", "elsewhere"):
        page = opened(name).page
        assert_locked(page, False)
        page.get_by_text("the second").first.click()
        page.get_by_role("button", name="Lock it in").click()
        assert focused(page) == "Verdict"


# --- a place ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("share", "verdict"), [(0.5, "Near."), (0.52, "Near."), (0.7, "Far.")])
def test_a_place_by_click(opened, share, verdict):
    found = opened("place")
    page, ring = found.page, found.page.locator(".psl-guess")
    page.get_by_role("button", name="Lock it in").click()
    assert page.locator(".psl-said").inner_text() == "Set your mark in the picture first."
    area = page.locator(".psl-stage svg").first.bounding_box()
    page.locator(".psl-stage svg").first.click(
        position={"x": share * area["width"], "y": 0.5 * area["height"]}
    )
    there = ring.bounding_box()
    assert there["x"] + there["width"] / 2 == pytest.approx(area["x"] + share * area["width"], abs=1.5)
    assert there["y"] + there["height"] / 2 == pytest.approx(area["y"] + 0.5 * area["height"], abs=1.5)
    assert_locked(page)
    page.get_by_role("button", name="Lock it in").click()
    assert_locked(page, False)
    assert page.locator(".psl-said").inner_text().startswith("You said: x ")
    page.get_by_text("Verdict").click()
    assert page.locator(".psl-answer p").inner_text() == f"{verdict} It is here."
    assert ring.get_attribute("tabindex") is None  # it stays, as a picture only
    page.locator(".psl-stage svg").first.click(position={"x": 5, "y": 5})
    assert ring.bounding_box()["x"] == pytest.approx(there["x"], abs=1.5)
    found.assert_quiet()


def test_a_place_by_arrow_keys(opened, box):
    found = opened("place")
    page = found.page
    ring = page.get_by_role("slider", name="your mark")
    ring.focus()
    low, high = float(ring.get_attribute("aria-valuemin")), float(ring.get_attribute("aria-valuemax"))
    assert [low, high] == pytest.approx([box[0], box[2]])
    at = float(ring.get_attribute("aria-valuenow"))
    ring.press("ArrowRight")
    assert float(ring.get_attribute("aria-valuenow")) == pytest.approx(at + 0.01 * (high - low), rel=0.01)
    for _ in range(4):
        ring.press("Shift+ArrowRight")
    for _ in range(math.ceil(4 * (box[3] - box[1]) / (box[2] - box[0]))):
        ring.press("Shift+ArrowDown")
    assert re.fullmatch(r"x [-\d.e]+, y [-\d.e]+", ring.get_attribute("aria-valuetext"))
    page.get_by_role("button", name="Lock it in").press("Enter")
    assert_locked(page, False)
    page.get_by_text("Verdict").click()
    assert page.locator(".psl-answer p").inner_text() == "Near. It is here."
    found.assert_quiet()


def test_a_place_without_a_picture_stays_text(opened):
    found = opened("nowhere")
    assert found.page.get_by_role("button").count() == 0
    found.page.locator(".psl-answer summary").click()
    assert found.page.get_by_text("It is here.").is_visible()
    found.assert_quiet()


# --- as a page ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (390, "dark")])
@pytest.mark.parametrize("name", ["choice", "place"])
def test_it_is_accessible(opened, name, width, scheme):
    page = opened(name, viewport={"width": width, "height": 800}, color_scheme=scheme).page
    assert findings(page) == []
    page.get_by_role("button", name="Open without one").click()
    assert findings(page) == []


def test_without_javascript_it_is_text(opened):
    page = opened("choice", java_script_enabled=False).page
    assert page.get_by_text("What is right?").is_visible()
    assert page.get_by_role("listitem").all_inner_texts() == ["the first", "the second"]
    assert page.get_by_text("Because.").is_hidden()
    page.get_by_text("Answer").click()
    assert page.get_by_text("Because.").is_visible()


def test_in_print_question_and_verdict_are_there(opened):
    page = opened("choice").page
    page.emulate_media(media="print")
    for words in ("What is right?", "Because."):
        assert page.get_by_text(words).is_visible()
    assert page.locator(".psl-look").is_visible()
    assert page.get_by_role("button", name="Lock it in").is_hidden()


def test_the_module_is_small():
    with_it, without = page_module(), page_module().split("const LOCKABLE")[0]
    rest = with_it[len(without) :]
    assert len(rest[: rest.index("function predictions")].encode()) < LARGEST_MODULE


# --- in the book --------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "part"), [("index", ".psl-viewer"), ("02_2_graphs", ".psl-toy")])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_what_is_locked_can_be_read(visit, book, name, part, scheme):
    found = visit(book.as_uri(), f"{name}.html", color_scheme=scheme)
    found.page.locator(part).first.scroll_into_view_if_needed()
    found.page.locator(f"{part} .psl-locked + :is(.psl-controls, .psl-knobs)").first.wait_for()
    assert findings(found.page, COLOURS, part) == []


def test_a_viewer_of_the_book(visit, book):
    """It is made when the reader comes near, and locked then."""
    found = visit(book.as_uri(), "index.html")
    page = found.page
    assert_locked(page)
    root = page.locator(".psl-viewer").first
    frames = root.get_attribute("data-threshold")
    assert page.locator(".psl-locked a").first.get_attribute("href") == "#predict-1"
    page.locator("#predict-1").get_by_text("the tail and the head").click()
    page.locator("#predict-1").get_by_role("button", name="Lock it in").click()
    assert_locked(page, False)
    assert focused(page) == "Verdict"
    root.locator("[data-control=threshold]").press("End")
    assert root.get_attribute("data-threshold") != frames
    found.assert_quiet()


@pytest.mark.parametrize("name", CHAPTERS)
def test_questions_of_a_chapter(visit, book, name):
    """All of them can be answered, and then nothing is locked; without JavaScript they are text."""
    found = visit(book.as_uri(), f"{name}.html")
    page = found.page
    questions = page.locator(".psl-predict")
    assert questions.count() >= 2
    for question in questions.all():
        question.scroll_into_view_if_needed()
        question.get_by_role("button", name=re.compile("Open without one|Show the answer")).click()
        question.locator("summary").click()
        assert question.locator(".psl-answer p").last.is_visible()
    assert page.locator("[data-locked], [inert]").count() == 0
    found.assert_quiet()
    plain = visit(book.as_uri(), f"{name}.html", java_script_enabled=False).page
    assert plain.locator(".psl-predict details").count() == questions.count()
    assert plain.locator(".psl-predict button").count() == 0
