"""A chapter opens with its title, a question and its first picture; what it is for comes below, folded."""

import runpy
import tomllib

import numpy as np
import pytest
from PIL import Image

from .conftest import ROOT

LOWEST = 700  # pixels from the top of the page, of the 900 that the screen has
# These have no picture, or one that sums the page up; a table is what a reader comes for.
TABLES = {"notation": "table", "fuzz": "table"}
PICTURE = "figure img, figure svg, .psl-viewer, .psl-toy"
#: Where the first of them begins that can be seen, and where the title and the card begin.
PLACES = """(wanted) => {
    const article = document.querySelector("article");
    const top = (node) => node.getBoundingClientRect().top + scrollY;
    const seen = (node) => node.getBoundingClientRect().height > 0;
    const shown = [...article.querySelectorAll(wanted)].filter(seen);
    const cards = [...article.querySelectorAll("details.sd-dropdown")];
    const card = cards.find((one) => /^(In this chapter|On this page)/.test(one.innerText.trim()));
    return {
        title: top(article.querySelector("h1")),
        picture: shown.length ? top(shown[0]) : null,
        card: card ? top(card) : null,
        open: card ? card.open : false,
    };
}"""


SHOW_NOTHING = {"teaching_misconceptions", "project_data", "handout"}  # pages to teach with begin with words


def chapters() -> list[str]:
    """The notebooks of the book that have something to show."""
    toc = tomllib.loads((ROOT / "book.toml").read_text(encoding="utf-8"))["toc"]
    names = [toc["root"], *(chapter["file"] for part in toc["parts"] for chapter in part["chapters"])]
    return [
        name for name in names if (ROOT / "notebooks" / f"{name}.ipynb").exists() and name not in SHOW_NOTHING
    ]


@pytest.mark.parametrize("name", chapters())
def test_first_picture_is_on_the_first_screen(visit, book, name):
    opened = visit(book.as_uri(), f"{name}.html", viewport={"width": 1280, "height": 900})
    found = opened.page.evaluate(PLACES, TABLES.get(name, PICTURE))
    assert found["picture"] is not None
    assert found["title"] < found["picture"] <= LOWEST, found
    if name not in {"index", "claims", "notation"}:
        assert found["card"] is not None, "a folded card: In this chapter"
        assert found["card"] > found["picture"]
    assert not found["open"]
    thumbnails = runpy.run_path(str(ROOT / "tools" / "thumbnails.py"))
    if name != "index":  # the contents page has a small picture of what one sees first
        stored = thumbnails["FOLDER"] / f"{name}.png"
        seen = opened.page.locator(thumbnails["PICTURE"]).locator("visible=true")
        assert stored.exists() == bool(seen.count()), "run tools/thumbnails.py"
        if stored.exists():
            small, now = (
                np.asarray(i.convert("RGB"), float)
                for i in (Image.open(stored), thumbnails["thumbnail"](seen.first))
            )
            # 48 colours and other edges of lines make less than 2 of 255 on average; another picture 7.
            assert np.abs(small - now).mean() < 4, "run tools/thumbnails.py"
