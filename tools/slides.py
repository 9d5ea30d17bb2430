"""Slides for the eight meetings of the course, cut out of the pages of the built book.

A deck has no text of its own but its title: of cells tagged ``slide`` it takes pictures with their captions,
definitions, theorems, questions and tables, in the order of the chapters, and no running prose.
notebooks/conf.py marks these cells in the pages (`mark`) and runs `write` when the pages are written.
reveal.js turns the pages; without it a deck is one long page.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import NamedTuple

from bs4 import BeautifulSoup, Comment, Tag

ROOT = Path(__file__).resolve().parent.parent
BEGIN, END = "slides from here", "slides up to here"
FORMULAS = re.compile(r"<script>window\.MathJax = .*?</script>", re.S)
TITLE = re.compile(r"<article.*?<h1>(.*?)<", re.S)
SHEETS = re.compile(r'<link[^>]*rel="stylesheet"[^>]*>')
#: Width by height; what is narrower gets its caption beside it, not below: the screen is wide.
TALL = 1.3
#: What makes a slide, by its classes; what else stands in a tagged cell is for readers.
PARTS = ("definition", "theorem", "proposition", "property", "lemma", "algorithm", "psl-predict", "psl-check")


class Deck(NamedTuple):
    """A meeting: its number, its title, the question of the day, and the chapters with its slides."""

    number: int
    title: str
    question: str
    chapters: tuple[str, ...]


DECKS = (
    Deck(1, "Balls", "Where are the centres of the largest balls?", ("01_introduction",)),
    Deck(2, "Samples", "What do fifty points know of a horse?", ("02_1_shapes",)),
    Deck(3, "Graphs", "Which points are neighbours?", ("02_2_graphs",)),
    Deck(4, "Four skeletons", "Which part of a Voronoi graph is the skeleton?", ("03_four_methods",)),
    Deck(5, "Agreement", "When do two methods give the same set?", ("03_5_comparison", "B_proof")),
    Deck(6, "Limits", "What do more samples buy?", ("03_2_convergence", "03_2_polyballs", "03_6_complexity")),
    Deck(7, "Simplify", "Which branches may go?", ("04_simplifying", "04_2_homotopy")),
    Deck(8, "Criteria", "How much does a threshold decide?", ("04_3_criteria", "04_results")),
)


def mark(notebook: dict) -> dict:
    """A notebook with comments around each tagged text: pages know the tags of code cells only."""
    for cell in notebook["cells"]:
        if cell["cell_type"] == "markdown" and "slide" in cell["metadata"].get("tags", []):
            before, after = (f"```{{raw}} html\n<!-- {words} -->\n```" for words in (BEGIN, END))
            cell["source"] = f"{before}\n\n{''.join(cell['source'])}\n\n{after}\n"
    return notebook


def article(page: Path) -> Tag:
    text = page.read_text(encoding="utf-8")
    return BeautifulSoup(text[text.index("<article") : text.index("</article>")], "html.parser")


def found(page: Path) -> Iterator[tuple[str, Tag, str]]:
    """For each slide of a page its heading, what is on it, and where in the book that stands."""
    heading, place, tagged, taken = "", "", False, None
    for node in article(page).descendants:
        if isinstance(node, Comment) and str(node).strip() in {BEGIN, END}:
            tagged = str(node).strip() == BEGIN
        if not isinstance(node, Tag) or (taken and any(parent is taken for parent in node.parents)):
            continue
        if re.fullmatch("h[1-3]", node.name):
            heading = node.decode_contents()
        if node.name == "section" and node.get("id"):
            place = node["id"]
        is_part = tagged and (node.name == "table" or set(node.get("class", [])).intersection(PARTS))
        if is_part or (node.name in {"figure", "table"} and node.find_parent(class_="tag_slide")):
            taken = node
            yield heading, node, node.get("id") or place


def slide(page: str, heading: str, part: Tag, place: str) -> str:
    """One slide, with a link to the place in the book."""
    for link in part.select("a.headerlink"):
        link.decompose()
    for link in part.select("a.image-reference"):  # the picture itself is large enough
        link.unwrap()
    for inner in part.find_all("section"):  # which reveal.js would take for a slide
        inner.name = "div"
    for folded in part.select("details[name]"):
        folded["name"] = f"{page}-{folded['name']}"
    for inner in part.find_all(id=True):  # only the parts themselves are linked to
        del inner["id"]
    if part.get("id"):
        part["id"] = f"{page}-{part['id']}"
    for node in [part, *part.select("[data-opens], .psl-predict")]:
        if "psl-predict" in node.get("class", []):
            node["data-opens"] = "none"
    for node, name in [(n, a) for a in ("href", "src") for n in part.find_all(attrs={a: True})]:
        if not re.match(r"\w+:", node[name]):
            node[name] = f"../{page}.html{node[name]}" if node[name][0] == "#" else f"../{node[name]}"
    for image in part.find_all("img"):
        del image["loading"], image["decoding"]  # or a print has empty frames
    picture = part.find("img") if part.name == "figure" else None
    if picture and float(picture.get("width", 9)) < TALL * float(picture.get("height", 1)):
        part["class"] = [*part.get("class", []), "tall"]  # its caption stands beside it
    title = BeautifulSoup(heading, "html.parser")
    for link in title.select("a.headerlink"):
        link.decompose()
    link = f'<p class="from"><a href="../{page}.html#{place}">in the book</a></p>'
    return f"<section><h2>{title.decode()}</h2>\n{part.decode()}\n{link}</section>"


def slides(deck: Deck, book: Path) -> list[str]:
    """The slides of a deck, the title first."""
    texts = {name: (book / f"{name}.html").read_text(encoding="utf-8") for name in deck.chapters}
    links = (f'<a href="../{name}.html">{TITLE.search(text)[1]}</a>' for name, text in texts.items())
    pages = " · ".join(links)
    first = (
        f'<section class="first"><h1>{deck.number}. {escape(deck.title)}</h1>\n'
        f'<p class="asked">{escape(deck.question)}</p>\n<p>{pages}</p>\n'
        '<p class="keys">Arrow keys or space turn the pages, Esc shows all of them. To print, add '
        "<code>?print-pdf</code> to the address.</p></section>"
    )
    return [
        first,
        *(slide(name, *one) for name in deck.chapters for one in found(book / f"{name}.html")),
    ]


def page(deck: Deck, book: Path, questions: str) -> str:
    """A deck as a page that asks for nothing but files of the book."""
    chapter = (book / f"{deck.chapters[0]}.html").read_text(encoding="utf-8")
    sheets = "\n".join(link.replace('href="', 'href="../') for link in SHEETS.findall(chapter))
    body = "\n".join(slides(deck, book))
    return f"""<!DOCTYPE html>
<html lang="en" data-theme="light">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{deck.number}. {escape(deck.title)} - slides</title>
<link rel="icon" href="../_static/icon.svg">
<link rel="stylesheet" href="../_static/reveal/reveal.css">
{sheets}
<link rel="stylesheet" href="../_static/slides.css">
{FORMULAS.search(chapter)[0]}
<script defer src="../_static/mathjax/startup.js"></script>
<script defer src="../_static/reveal/reveal.js"></script>
<script defer src="../_static/slides.js"></script>
</head>
<body>
<main>
<div class="reveal bd-content">
<div class="slides">
{body}
</div>
</div>
</main>
<script type="module">{questions}</script>
</body>
</html>
"""


def write(book: Path, questions: str) -> None:
    """Write all decks; ``questions`` is the module that makes controls of predictions."""
    folder = book / "slides"
    folder.mkdir(exist_ok=True)
    built = {path.stem for path in book.glob("*.html")}
    for deck in DECKS:
        if built.issuperset(deck.chapters):  # a book may be a part of this one
            (folder / f"{deck.number}.html").write_text(page(deck, book, questions), encoding="utf-8")


if __name__ == "__main__":
    import runpy

    bundle = runpy.run_path(str(ROOT / "polyskel_lite" / "explore" / "bundle.py"))
    write(Path(sys.argv[1] if len(sys.argv) > 1 else "_build/html"), bundle["page_module"]())
