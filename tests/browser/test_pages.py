"""Every page of the book: from disk and from a plain web server, light and dark, wide and narrow.

Colours do not depend on the width nor the structure on the colours, so axe's rules are divided accordingly.
"""

import pytest

from .accessibility import COLOURS, STRUCTURE, findings
from .conftest import pages

# What a reader would miss: pictures that did not come or that say nothing, formulas that were not set.
LOST = """() => {
    const lost = [];
    for (const image of document.images) {
        const name = image.src.slice(0, 100);
        if (!image.complete || !image.naturalWidth) lost.push("picture not there: " + name);
        if (!image.alt.trim()) lost.push("no alternative text: " + name);
    }
    for (const formula of document.querySelectorAll(".math")) {
        const set = formula.querySelector("mjx-container");
        if (!set || set.querySelector("[data-mjx-error]")) lost.push("formula: " + formula.textContent);
    }
    return lost;
}"""


@pytest.mark.parametrize("name", pages())
def test_page_from_disk(visit, book, name):
    opened = visit(book.as_uri(), f"{name}.html", color_scheme="light")
    assert opened.page.evaluate(LOST) == []
    assert findings(opened.page) == []
    opened.page.emulate_media(color_scheme="dark")
    opened.page.locator("html[data-theme=dark]").wait_for()
    assert findings(opened.page, COLOURS) == []
    opened.assert_quiet()


@pytest.mark.parametrize("name", pages())
def test_page_from_a_web_server_on_a_phone(visit, site, name):
    opened = visit(
        site, f"{name}.html", viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True
    )
    assert opened.page.evaluate(LOST) == []
    assert findings(opened.page, STRUCTURE) == []
    opened.assert_quiet()


@pytest.mark.parametrize("place", ["book", "site"])
def test_search_finds_a_chapter(visit, request, place):
    home = request.getfixturevalue(place)
    home = home if isinstance(home, str) else home.as_uri()
    opened = visit(home, "search.html?q=reversibility")
    opened.page.locator("#search-results li a").first.wait_for()
    opened.assert_quiet()
