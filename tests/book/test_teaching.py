"""The teacher's part: plans that add up, marks at four levels, a question for each task, slides."""

import importlib
import json
import os
import re
import runpy
import tomllib
from pathlib import Path
from xml.etree import ElementTree

import pytest
from bs4 import BeautifulSoup

ROOT = Path(__file__).resolve().parents[2]
NOTEBOOKS = ROOT / "notebooks"
BOOK = Path(os.environ.get("BOOK", ROOT / "_build" / "html"))
TEACHING = runpy.run_path(str(ROOT / "tools" / "teaching.py"))
GUIDE = (NOTEBOOKS / "teaching.md").read_text(encoding="utf-8")
MARKS = (NOTEBOOKS / "teaching_marks.md").read_text(encoding="utf-8")
MEETINGS = dict(re.findall(r"^### ((?:Day|Meeting) \d)\. .*\n((?:(?!##).*\n)+)", GUIDE, re.M))
SOURCES = sorted((NOTEBOOKS / "course").glob("a?_*.ipynb"))


def minutes(text: str) -> list[int]:
    return [int(n) for n in re.findall(r"^\| (\d+) \|", text, re.M)]


def by_hand() -> dict[str, float]:
    """The tasks that a person marks, with the points: those of cells with text that are graded."""
    found, task = {}, ""
    for source in SOURCES:
        for cell in json.loads(source.read_text(encoding="utf-8"))["cells"]:
            about = cell["metadata"].get("nbgrader", {})
            if title := re.match(r"## (\d+)\. ", "".join(cell["source"])):
                task = f"A{source.stem[1]}.{title[1]}"
            if about.get("grade") and about.get("solution"):
                found[task] = about["points"]
    return found


def test_there_are_plans_for_one_week_and_for_four():
    expected = [f"Day {k}" for k in range(1, 5)] + [f"Meeting {k}" for k in range(1, 9)]
    assert list(MEETINGS) == expected
    assert sum(minutes(GUIDE[GUIDE.index("(sec-monday)=") : GUIDE.index("(sec-first-day)=")])) == 15


@pytest.mark.parametrize("name", MEETINGS)
def test_a_meeting_has_ninety_minutes_and_all_that_the_teacher_needs(name):
    text = MEETINGS[name]
    assert sum(minutes(text)) == 90
    for part in ("**Predict", "**Live:**", "**Ticket:**", 'Slides: <a href="slides/'):
        assert text.count(part) == 1, part
    assert re.search(r"(Explorer|Viewer): .*\{(ref|doc)\}`", text)
    if name.startswith("Meeting"):
        assert "**Where students stumble.**" in text
        assert f'Slides: <a href="slides/{name[-1]}.html">' in text


def test_every_ticket_has_an_answer():
    table = GUIDE[GUIDE.index(":name: tab-tickets") : GUIDE.index("## More weeks")]
    assert re.findall(r"^\| ((?:Day|Meeting) \d) \| \S", table, re.M) == list(MEETINGS)


def test_misconceptions_named_in_the_guide_are_known():
    known = tomllib.loads((NOTEBOOKS / "misconceptions.toml").read_text(encoding="utf-8"))
    named = re.findall(r"\((M\d+)\)", GUIDE)
    assert len(set(named)) >= 10
    assert set(named) <= set(known)


def test_every_misconception_has_a_self_check_and_a_task():
    rows = re.findall(r"^\| (M\d+) \| (.*) \| (.*) \| (A\d\.\d) (.+) \|$", TEACHING["misconceptions"](), re.M)
    known = tomllib.loads((NOTEBOOKS / "misconceptions.toml").read_text(encoding="utf-8"))
    assert [row[0] for row in rows] == list(known)
    for mark, _, places, task, title in rows:
        assert re.search(r'<a href="\w+\.html#check-\d+">', places), mark
        assert TEACHING["task_titles"]()[task] == title


def test_goals_of_all_chapters_are_in_the_table():
    table = re.findall(r"^\| \*\*(G[\w.]+)\*\* \S.* \| .*\{ref\}`", TEACHING["goals"](), re.M)
    chapters = "".join(path.read_text(encoding="utf-8") for path in NOTEBOOKS.glob("[0AB]*.ipynb"))
    assert sorted(table) == sorted(re.findall(r"\*\*(G[\w.]+\.\d+)\*\*", chapters))
    assert len(table) > 40


def test_the_map_has_twenty_notions_and_its_arrows_join_neighbours():
    """An arrow between others would run through a box."""
    place = {
        one[0]: (row, column)
        for row, notions in enumerate(TEACHING["NOTIONS"])
        for column, one in enumerate(notions)
        if one
    }
    assert len(place) == 20
    for start, end, sentence in TEACHING["ARROWS"]:
        assert {abs(a - b) for a, b in zip(place[start], place[end], strict=True)} <= {0, 1}, (start, end)
        assert sentence.endswith(".")
    assert {name for arrow in TEACHING["ARROWS"] for name in arrow[:2]} == set(place)
    drawn = re.search(r"<svg.*</svg>", TEACHING["concept_map"](), re.S)[0]
    words = [node.text for node in ElementTree.fromstring(drawn).iter("text")]
    assert set(place) <= set(words)


def test_every_task_marked_by_hand_has_an_answer_at_four_levels():
    answers = dict(re.findall(r"^### (A\d\.\d) .*\n((?:(?!##|\().*\n)+)", MARKS, re.M))
    assert list(answers) == list(by_hand())
    for task, most in by_hand().items():
        levels = re.findall(r"^- \*\*Level (\d) \((\d) points?\)\.\*\* \S", answers[task], re.M)
        assert [level for level, _ in levels] == ["4", "3", "2", "1"], task
        points = [int(point) for _, point in levels]
        assert points[0] == most, task
        assert points == sorted(points, reverse=True), task


def test_every_task_has_one_question_to_ask():
    asked = re.findall(r"^\| (A\d\.\d) \| (.+[?.]) \|$", MARKS[MARKS.index(":name: tab-oral") :], re.M)
    assert [task for task, _ in asked] == list(TEACHING["task_titles"]())
    assert len({question for _, question in asked}) == len(asked) == 36


def test_the_index_links_to_everything():
    index = (NOTEBOOKS / "index.ipynb").read_text(encoding="utf-8")
    for name in (
        "teaching",
        "teaching_marks",
        "teaching_map",
        "handout",
        "project_data",
        "teaching_misconceptions",
    ):
        assert re.search(rf"\{{doc\}}`(?:[^`<]*<)?{name}>?`", index), name
    assert [int(n) for n in re.findall(r"slides/(\d)\.html", index)] == list(range(1, 9))


def test_the_message_in_the_handout_is_one_of_a_check():
    handout = (NOTEBOOKS / "handout.ipynb").read_text(encoding="utf-8")
    said = re.search(r"> Not yet: .* yours is True\. (.*?\.) ", handout)[1]
    assert said in (NOTEBOOKS / "course" / "a2_gabriel_dual.ipynb").read_text(encoding="utf-8")
    checks = (ROOT / "polyskel_lite" / "coursework" / "checks.py").read_text(encoding="utf-8")
    for words in ("alls what it should do of the library", "as not ready after"):
        assert words in checks
        assert words in handout


# --- slides -------------------------------------------------------------------------------------------

PAGE = """<article><h1>Title<a class="headerlink" href="#t">#</a></h1>
<p>Prose.</p><div class="proof definition" id="one">no slide</div>
<!-- slides from here --><p>Prose again.</p><section id="s"><h2>Heading</h2>
<div class="proof definition" id="two"><section id="proof-content"><a href="#x">x</a> <a href="y.html">y</a>
</section></div><div class="psl-predict" id="predict-1"><details name="d"></details></div></section>
<!-- slides up to here --><div class="proof theorem" id="three">no slide</div>
<div class="cell tag_slide"><figure id="f"><a class="image-reference" href="_images/a.svg"><img loading="lazy"
src="_images/a.svg" alt="A." width="500" height="400" decoding="async"/></a></figure></div>
<div class="cell"><figure id="g"></figure></div></article>"""


@pytest.fixture
def slides(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "tools")
    return importlib.import_module("slides")


def test_slides_are_parts_of_tagged_cells_and_no_prose(slides, tmp_path):
    (tmp_path / "p.html").write_text(PAGE, encoding="utf-8")
    made = slides.slides(slides.Deck(1, "A & B", "Why?", ("p",)), tmp_path)
    assert len(made) == 4
    text = "".join(made)
    assert "Prose" not in text
    assert "no slide" not in text
    assert text.count("<section") == 4  # one inside another would be a slide of its own
    assert "A &amp; B" in text
    assert '<a href="../p.html">Title</a>' in text
    assert 'href="../p.html#x"' in text
    assert 'href="../y.html"' in text
    assert 'src="../_images/a.svg"' in text
    assert 'data-opens="none"' in text
    assert 'name="p-d"' in text
    assert "headerlink" not in text
    assert '<a href="../p.html#two">in the book</a>' in text
    assert "loading" not in text
    assert "decoding" not in text
    assert 'class="tall"' in text  # 5 to 4: its caption goes beside it


def test_marks_stand_around_tagged_texts_only(slides):
    cells = [
        {"cell_type": "markdown", "metadata": {"tags": ["slide"]}, "source": ["a\n", "b"]},
        {"cell_type": "markdown", "metadata": {}, "source": ["c"]},
    ]
    marked = slides.mark({"cells": cells})["cells"]
    assert slides.BEGIN in marked[0]["source"]
    assert slides.END in marked[0]["source"]
    assert "\n\na\nb\n\n" in marked[0]["source"]
    assert marked[1]["source"] == ["c"]


@pytest.mark.skipif(not (BOOK / "slides").exists(), reason="The book is not built: make book.")
@pytest.mark.parametrize("number", range(1, 9))
def test_a_deck_has_twelve_to_fifteen_slides_and_is_of_the_book(slides, number):
    deck = BeautifulSoup((BOOK / "slides" / f"{number}.html").read_text(encoding="utf-8"), "html.parser")
    made = deck.find_all("section")
    assert 12 <= len(made) <= 15
    assert made[0].h1.string == f"{number}. {slides.DECKS[number - 1].title}"
    assert all(one.h2.get_text(strip=True) for one in made[1:])
    pictures = deck.find_all("img")
    assert len(pictures) >= (1 if number == 4 else 3)
    assert all(len(picture["alt"]) >= 20 for picture in pictures)
    assert deck.select(".psl-predict")
    ids = [node["id"] for node in deck.find_all(id=True)]
    assert len(ids) == len(set(ids))
    fetched = [
        node[name]
        for name in ("src", "href")
        for node in deck.select(f"link[{name}], [src]")
        if node.get(name)
    ]
    assert fetched
    assert all(name.startswith("../_") for name in fetched)


def test_meetings_and_decks_are_about_the_same(slides):
    titles = re.findall(r"^### Meeting \d\. (.+)$", GUIDE, re.M)
    for deck, title in zip(slides.DECKS, titles, strict=True):
        assert title.startswith(deck.title)
        chapters = MEETINGS[f"Meeting {deck.number}"]
        assert all(f"{{doc}}`{name}`" in chapters for name in deck.chapters)
