"""Every page of the book: from disk and from a plain web server, light and dark, wide and narrow.

Colours do not depend on the width nor the structure on the colours, so axe's rules are divided accordingly.
"""

import pytest

from .accessibility import COLOURS, STRUCTURE, findings
from .conftest import pages

HEAVIEST = 1_500_000
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
# How many letters a full line of text has, on average over the longer paragraphs of the page.
LETTERS = """() => {
    const long = (p) => p.innerText.length > 300 && p.clientHeight && !p.querySelector(".math");
    const full = [...document.querySelectorAll("article p")].filter(long);
    const lines = full.map((p) => p.clientHeight / parseFloat(getComputedStyle(p).lineHeight));
    const sum = (numbers) => numbers.reduce((a, b) => a + b, 0);
    return full.length ? sum(full.map((p) => p.innerText.length)) / sum(lines) : null;
}"""
# What does not fit a sheet of A4, or may be on two of them.
CUT = """(height) => {
    const cut = [], whole = "article :is(figure, .psl-viewer, .psl-toy, .psl-predict, .psl-check)";
    for (const one of document.querySelectorAll(whole)) {
        const box = one.getBoundingClientRect(), name = one.id || one.className;
        if (box.height > height) cut.push(`${name} is ${box.height} high`);
        if (box.right > innerWidth + 1) cut.push(`${name} ends at ${box.right}`);
        if (getComputedStyle(one).breakInside !== "avoid") cut.push(`${name} may be cut`);
    }
    return cut;
}"""
# What leaves a narrow screen, and pictures so small that the letters of their panels have less than 9 pixels.
TIGHT = """(letters) => {
    const tight = [];
    for (const table of document.querySelectorAll("article table")) {
        const box = table.getBoundingClientRect();
        const name = table.innerText.slice(0, 80);
        if (box.right > innerWidth + 1) tight.push(`a table ends at ${box.right}: ${name}`);
    }
    for (const image of document.querySelectorAll("article figure img")) {
        const box = image.getBoundingClientRect(), natural = Number(image.getAttribute("width"));
        const name = image.alt.slice(0, 60);
        if (box.width && letters * box.width < 9 * natural) tight.push(`${name}: ${box.width} of ${natural}`);
    }
    if (document.documentElement.scrollWidth > innerWidth + 1) tight.push("the page scrolls sideways");
    return tight;
}"""
# What a wide page has around its text is the theme's and the same on all: a few stand for it. The text itself
# has the rules on structure on the phone; one page of reference stands there for the others, made alike.
ALIKE_WHEN_WIDE = set(pages()) - {"index", "01_introduction", "claims", "search", "api_shapes"}
ALIKE_ON_A_PHONE = {name for name in ALIKE_WHEN_WIDE if name.startswith("api_")}
A4 = {"width": 680, "height": 1009}  # in pixels, within margins of 15 mm
LETTER = 1.45 * 9 * 120 / 72  # height of "(a)" in a picture of its full size, in pixels


@pytest.mark.parametrize("name", pages())
def test_page_from_disk(visit, book, name):
    opened = visit(book.as_uri(), f"{name}.html", color_scheme="light")
    assert opened.page.evaluate(LOST) == []
    assert findings(opened.page, COLOURS if name in ALIKE_WHEN_WIDE else None) == []
    assert (
        name == "search" or opened.page.locator("article h1").count() == 1
    )  # the theme's, outside the article
    letters = opened.page.evaluate(LETTERS)
    assert letters is None or 55 < letters <= 75  # a paragraph's last line is seldom full
    opened.page.emulate_media(color_scheme="dark")
    opened.page.locator("html[data-theme=dark]").wait_for()
    assert findings(opened.page, COLOURS) == []
    opened.page.emulate_media(media="print")
    opened.page.set_viewport_size(A4)
    assert opened.page.evaluate(CUT, A4["height"]) == []
    opened.assert_quiet()


@pytest.mark.parametrize("name", pages())
def test_page_from_a_web_server_on_a_phone(visit, site, name):
    opened = visit(
        site, f"{name}.html", viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True
    )
    assert opened.page.evaluate(LOST) == []
    assert name in ALIKE_ON_A_PHONE or findings(opened.page, STRUCTURE) == []
    assert opened.page.evaluate(TIGHT, LETTER) == []
    opened.assert_quiet()


@pytest.mark.parametrize("name", pages())
def test_landing_is_light(browser, site, book, name):
    """What a first visit fetches before the reader does anything, not packed."""
    profile = browser.new_context(viewport={"width": 1280, "height": 800}, reduced_motion="reduce")
    page, fetched = profile.new_page(), set()
    page.on("requestfinished", lambda request: fetched.add(request.url.removeprefix(site).split("?")[0]))
    page.goto(f"{site}/{name}.html", wait_until="networkidle")
    profile.close()
    files = [book / name.lstrip("/") for name in fetched]
    sizes = {file.name: file.stat().st_size for file in files if file.is_file()}
    assert f"{name}.html" in sizes
    assert sum(sizes.values()) < HEAVIEST, sorted(sizes.items(), key=lambda item: -item[1])
    assert ("startup.js" in sizes) == ('class="math' in (book / f"{name}.html").read_text(encoding="utf-8"))
    assert not {"fontawesome.js", "fa-solid-900.woff2", "tex-chtml.js"} & set(sizes)
    assert ("searchindex.js" in sizes) == (name == "search")


@pytest.mark.parametrize("place", ["book", "site"])
def test_search_finds_a_chapter(visit, request, place):
    home = request.getfixturevalue(place)
    home = home if isinstance(home, str) else home.as_uri()
    opened = visit(home, "search.html?q=reversibility")
    opened.page.locator("#search-results li a").first.wait_for()
    opened.assert_quiet()


def test_the_register_can_be_filtered_without_a_kernel(visit, book):
    opened = visit(book.as_uri(), "claims.html")
    page = opened.page
    cards = page.locator("div.claim")
    everything = cards.count()
    assert everything > 140
    page.get_by_label("verdict").select_option("does not hold")
    shown = page.locator("div.claim:visible")
    assert 0 < shown.count() < 10
    assert page.get_by_role("search").locator("output").inner_text() == f"{shown.count()} of {everything}"
    assert page.get_by_role("heading", name="3.6: cost").is_hidden()  # no card of it is left
    page.get_by_label("words").fill("obtuse face")
    assert shown.count() == 1
    page.locator("a[href='#row-theorem-2']").first.click()  # a link to a card that is filtered out
    page.locator("#row-theorem-2").wait_for()
    assert shown.count() == everything
    page.locator("#row-theorem-2").get_by_role("link", name="Shown here").click()
    page.wait_for_url("**/03_5_comparison.html#claim-theorem-2")
    assert page.locator("#claim-theorem-2 + div.cell").count() == 1
    opened.assert_quiet()
