"""The chapters as plain notebooks: no MyST is left, numbers are the book's, a reader's changes are kept."""

import json
import re
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TOOL = runpy.run_path(str(ROOT / "tools" / "working_copies.py"))
CHAPTERS = sorted(path.name for path in (ROOT / "notebooks").glob("*.ipynb"))
NUMBERED = r"(?:Figure|Table|Exercise|Definition|Theorem|Proposition|Lemma|Algorithm|Property|Remark) \d+"


@pytest.fixture(scope="module")
def copies(book) -> dict[str, str]:
    return TOOL["copies"](book.parent / "doctrees")


def text(notebook: dict) -> str:
    return "\n\n".join("".join(c["source"]) for c in notebook["cells"] if c["cell_type"] == "markdown")


@pytest.mark.parametrize("name", CHAPTERS)
def test_no_role_and_no_directive_is_left(copies, name):
    words = text(json.loads(copies[name]))
    words = re.sub(r"```(?!\{).*?```", "", words, flags=re.S)  # code that is quoted
    assert re.findall(r"\{[a-z:-]+\}`|^[`:]{3,}\{.*|^\([\w-]+\)=$|@@", words, re.M) == []


@pytest.mark.parametrize("name", CHAPTERS)
def test_a_question_is_a_list_and_a_folded_answer(copies, name):
    source = text(json.loads((ROOT / "notebooks" / name).read_text(encoding="utf-8")))
    asked = re.findall(r"^:::\{predict\} ", source, re.M)
    options = r"^\*\*.*\?\*?\*\*\n\n(?:(?:- (?!\[).*\n)+\n)?<details><summary>Answer</summary>\n\n(?!<)"
    assert len(re.findall(options, text(json.loads(copies[name])), re.M)) == len(asked)


@pytest.mark.parametrize("name", CHAPTERS)
def test_a_self_check_is_a_list_and_folded_reasons(copies, name):
    source = text(json.loads((ROOT / "notebooks" / name).read_text(encoding="utf-8")))
    checks = r"^\*\*Check \d+\. .*\?\*\*\n\n(?:- (?!\[).*\n){2,}\n"
    reasons = (
        r"<details><summary>Which, and why</summary>\n\n((?:- .*: \*\*(?:yes|no)\.\*\* .*\n){2,})\n</details>"
    )
    told = re.findall(checks + reasons, text(json.loads(copies[name])), re.M)
    assert len(told) == len(re.findall(r"^:::\{check\} ", source, re.M))
    assert all("**yes.**" in one and "**no.**" in one for one in told)


@pytest.mark.parametrize("name", CHAPTERS)
def test_numbers_are_those_of_the_page(book, copies, name):
    page = (book / name.replace(".ipynb", ".html")).read_text(encoding="utf-8")
    there = re.findall(rf'<span class="caption-number">({NUMBERED}) ?', page)
    words = text(json.loads(copies[name]))
    here = re.findall(rf"^(?:> )?\*\*({NUMBERED})\.?\*\*", words, re.M)
    assert sorted(here) == sorted(set(there))


@pytest.mark.parametrize("name", CHAPTERS)
def test_code_and_outputs_are_the_chapter_s_own(copies, name):
    source = json.loads((ROOT / "notebooks" / name).read_text(encoding="utf-8"))
    kept = [[cell["source"], cell["outputs"]] for cell in source["cells"] if cell["cell_type"] == "code"]
    copy = [cell for cell in json.loads(copies[name])["cells"] if cell["cell_type"] == "code"]
    assert [[cell["source"], cell["outputs"]] for cell in copy if cell["id"] != "install"] == kept


@pytest.mark.parametrize("name", CHAPTERS)
def test_what_the_page_folds_is_folded(book, copies, name):
    """Cells by JupyterLab's own marks, words by <details>; of solutions outputs too."""
    page = (book / name.replace(".ipynb", ".html")).read_text(encoding="utf-8")
    solutions = [block(rest) for rest in page.split('class="solution dropdown')[1:]]
    copy = json.loads(copies[name])
    marks = [cell["metadata"] for cell in copy["cells"] if cell["id"] != "install"]
    whole = [mark for mark in marks if mark.get("jupyter", {}).get("outputs_hidden")]
    assert [mark for mark in marks if mark.get("collapsed")] == whole
    assert len(whole) == "".join(solutions).count('<div class="cell ')
    hidden = [mark for mark in marks if mark.get("jupyter", {}).get("source_hidden")]
    inputs = page.count("hide above-input") - "".join(solutions).count("hide above-input")
    assert len(hidden) == len(whole) + inputs
    titles = re.findall(r"<summary>(.*?)</summary>", text(copy))
    of_solutions = {title for title in titles if title.startswith("Solution")}
    assert len(of_solutions) == len(solutions)
    assert titles.count("Answer") == page.count('class="psl-answer"')
    assert titles.count("Which, and why") == page.count('class="psl-check"')
    others = [title for title in titles if title not in of_solutions | {"Answer", "Which, and why"}]
    assert len(others) == page.count(" sd-dropdown ")


def block(page: str) -> str:
    """The start of a page up to the end of the <div> that it begins in."""
    depth = 1
    for tag in re.finditer(r"<(/?)div\b", page):
        depth += -1 if tag[1] else 1
        if depth == 0:
            return page[: tag.start()]
    raise ValueError("a block without an end")


def test_what_a_reader_changed_is_kept(book, tmp_path):
    doctrees = book.parent / "doctrees"
    assert TOOL["write"](tmp_path, doctrees) == []
    path = tmp_path / "notebooks" / CHAPTERS[0]
    path.write_text("mine", encoding="utf-8")
    assert TOOL["write"](tmp_path, doctrees) == []  # nothing new: nothing to say
    record = tmp_path / "copies.json"
    older = json.loads(record.read_text(encoding="utf-8")) | {CHAPTERS[0]: "what an older book had"}
    record.write_text(json.dumps(older), encoding="utf-8")
    assert TOOL["write"](tmp_path, doctrees) == [CHAPTERS[0]]
    assert path.read_text(encoding="utf-8") == "mine"
