"""Slides that keys turn, in light and dark, and a handout of two sheets."""

import re
from itertools import pairwise

import pytest

from .accessibility import findings

A4 = {"format": "A4", "margin": dict.fromkeys(("top", "bottom", "left", "right"), "15mm")}


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_keys_turn_the_slides_and_answer_questions(visit, book, scheme):
    opened = visit(
        book.as_uri(), "slides/1.html", color_scheme=scheme, viewport={"width": 1280, "height": 800}
    )
    page = opened.page
    page.locator(f"html[data-ready][data-theme={scheme}]").wait_for()
    number = page.locator(".slide-number")
    assert re.sub(r"\s", "", number.inner_text()).startswith("1/")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Space")
    assert re.sub(r"\s", "", number.inner_text()).startswith("3/")
    question = page.locator("section.present .psl-predict")
    question.get_by_role("radio").first.check()
    question.get_by_role("button", name="Lock it in").press("Enter")
    assert question.locator("summary").inner_text() == "Verdict"
    question.locator("summary").press("Space")  # opens the verdict, and does not turn the page
    assert question.locator("details").get_attribute("open") is not None
    assert re.sub(r"\s", "", number.inner_text()).startswith("3/")
    page.keyboard.press("ArrowLeft")
    shown = page.locator("section.present img")
    assert shown.evaluate("(image) => image.complete && image.naturalWidth > 0")
    dark = page.evaluate(
        "getComputedStyle(document.body).backgroundColor.match(/\\d+/g).every((n) => n < 60)"
    )
    assert dark == (scheme == "dark")
    assert findings(page) == []
    opened.assert_quiet()


@pytest.mark.parametrize("number", range(1, 9))
def test_no_slide_is_larger_than_the_screen(visit, book, number):
    page = visit(book.as_uri(), f"slides/{number}.html", viewport={"width": 1280, "height": 800}).page
    page.locator("html[data-ready]").wait_for()
    cut = page.evaluate("""() => [...Array(Reveal.getTotalSlides()).keys()].filter((k) => {
        Reveal.slide(k);
        const slide = Reveal.getCurrentSlide();
        return slide.scrollHeight > slide.clientHeight + 2 || slide.scrollWidth > slide.clientWidth + 2;
    })""")
    assert cut == []


def test_what_a_slide_is_about_stands_in_its_middle(visit, book):
    page = visit(book.as_uri(), "slides/1.html#/3", viewport={"width": 1280, "height": 800}).page
    page.locator("html[data-ready]").wait_for()
    box = page.locator("section.present .admonition").bounding_box()
    assert 350 < box["y"] + box["height"] / 2 < 500


def test_the_handout_takes_two_sheets(visit, book):
    page = visit(book.as_uri(), "handout.html").page
    assert len(re.findall(rb"/Type\s*/Page\b", page.pdf(**A4))) == 2


def test_without_scripts_a_deck_is_one_long_page(visit, book):
    page = visit(book.as_uri(), "slides/5.html", java_script_enabled=False).page
    tops = [slide.bounding_box() for slide in page.locator(".slides > section").all()]
    assert len(tops) >= 12
    assert all(box["height"] > 60 for box in tops)
    assert all(low["y"] >= high["y"] + high["height"] for high, low in pairwise(tops))


def test_paper_is_white_in_the_dark_too(visit, book):
    page = visit(book.as_uri(), "slides/2.html?print-pdf", color_scheme="dark").page
    page.locator("html[data-ready][data-theme=light]").wait_for()
