"""Questions before pictures (notebooks/predict.py): where they stand, what the directive makes of them."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
CHAPTERS = [
    path
    for path in sorted((ROOT / "notebooks").glob("*.ipynb"))
    if re.match(r"\d|A_|B_|index|explore", path.stem)
]
QUESTION = re.compile(r"^:::\{predict\} (?P<asked>.+)\n(?P<body>(?:.*\n)*?):::$", re.M)
NUMBER = re.compile(r"(?<![\w.])\d[\d,]*(?:\.\d+)?")
#: Numbers of verdicts that the chapter does not print; tests/book/test_readings.py computes them.
COMPUTED_THERE = {
    "01_introduction": {"0.108", "0.052", "0.112"},
    "03_5_comparison": {"92"},
    "03_6_complexity": {"998", "102", "101", "106", "107"},
    "A_1_polyballs": {"0.35", "0.94", "1.41"},
    "A_3_theorem_4": {"2.32", "0.41"},
    "explore": {"32"},
}


def prose(path: Path) -> str:
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown") + "\n"


def rights(body: str) -> tuple[int, int]:
    """How many options there are, and how many of them are right."""
    return len(re.findall(r"^- \[[ x]\] \S", body, re.M)), body.count("- [x] ")


@pytest.mark.parametrize("path", CHAPTERS, ids=lambda path: path.stem)
class TestQuestionsOfAChapter:
    def test_two_or_more_and_no_section_has_more_than_two(self, path):
        text = re.sub(r"^(`{3,})\{?code.*?^\1$", "", prose(path), flags=re.M | re.S)
        sections = [len(QUESTION.findall(section)) for section in re.split(r"^#{1,4} ", text, flags=re.M)]
        assert sum(sections) == prose(path).count("{predict}") >= 2
        assert max(sections) <= 2

    def test_one_option_is_right_or_the_verdict_says_that_none_is(self, path):
        for found in QUESTION.finditer(prose(path)):
            options, right = rights(found["body"])
            if ":place:" in found["body"]:
                assert options == 0
            elif "no wrong one" in found["body"]:
                assert right == 0
            else:
                assert (2 <= options <= 4, right) == (True, 1), found["asked"]

    def test_a_question_is_one_and_its_answer_is_not_the_line_above(self, path):
        text = prose(path)
        for found in QUESTION.finditer(text):
            assert found["asked"].rstrip().endswith(("?", "?*")), found["asked"]
            above = text[: found.start()].rstrip().rsplit("\n\n", 1)[-1]
            for option in re.findall(r"^- \[x\] (.{15,})", found["body"], re.M):
                assert option not in above

    def test_an_option_is_more_than_a_formula(self, path):
        """Programs that read a page aloud name a button by its words, and some skip formulas."""
        for option in re.findall(r"^- \[[ x]\] (.*)", prose(path), re.M):
            assert re.search(r"\w", re.sub(r"\$[^$]*\$", "", option)), option

    def test_the_numbers_of_a_verdict_are_the_chapter_s(self, path):
        """nbval holds what cells print; a number that only a verdict says could be wrong unseen."""
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        said = [QUESTION.sub(lambda found: found["asked"], prose(path))]
        said += ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
        for output in (output for cell in cells for output in cell.get("outputs", [])):
            said += ["".join(output.get("text", "")), "".join(output.get("data", {}).get("text/plain", ""))]
        there = {number.replace(",", "") for number in NUMBER.findall(" ".join(said))}
        there |= COMPUTED_THERE.get(path.stem, set())
        for found in QUESTION.finditer(prose(path)):
            told = " ".join(re.findall(r"^(?!:|- \[ \]).*", found["body"], re.M))
            numbers = {number.strip(",").replace(",", "") for number in NUMBER.findall(told)}
            assert {number for number in numbers if len(number) > 1} <= there, found["asked"]

    def test_no_prediction_is_left_as_a_sentence(self, path):
        sentence = r"\*+(?:Predict|Before you (?:move|drag))[^*]*\*|[^{]\bPredict(?: first)?:"
        assert re.findall(sentence, prose(path)) == []


def test_the_right_answer_has_no_place_of_its_own():
    """A reader who always takes the first one, or the last one, is right less often than not."""
    marks = [
        re.findall(r"^- \[([ x])\]", found["body"], re.M)
        for path in CHAPTERS
        for found in QUESTION.finditer(prose(path))
    ]
    places = [(own.index("x"), len(own) - own.index("x")) for own in marks if "x" in own]
    assert len(places) > 50
    for side in zip(*places, strict=True):
        assert max(map(side.count, set(side))) < len(places) / 2


# --- the directive ------------------------------------------------------------------------------------

PAGE = r"""# A page

:::{predict} Is $x^2$ *larger* than {math}`x`?
:opens: none
- [ ] yes, **always**
- [x] not between
  $0$ and $1$
- [ ] never

At $x = \tfrac12$ it is smaller.
And at 2 it is larger.

Two paragraphs.
:::

:::{predict} Where?
:place: 0.5 -1 0.25

Here.
:::

```{predict} Which do you like?
- [ ] this
- [ ] that

Both are fine.
```
"""


def build(folder: Path, text: str, builder: str = "html") -> tuple[str, str]:
    """A page of a small book, and what Sphinx complains of."""
    folder.mkdir(exist_ok=True)
    (folder / "conf.py").write_text(
        "import sys\n"
        f"sys.path.insert(0, {str(ROOT / 'notebooks')!r})\n"
        'extensions = ["myst_parser", "predict"]\n'
        'myst_enable_extensions = ["colon_fence", "dollarmath"]\n'
    )
    (folder / "index.md").write_text(text, encoding="utf-8")
    command = [sys.executable, "-m", "sphinx", "-q", "-E", "-b", builder, folder, folder / builder]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    (page,) = [path for end in ("html", "tex", "txt") for path in (folder / builder).glob(f"[!gs]*.{end}")]
    return page.read_text(encoding="utf-8"), done.stderr


def test_a_page_without_javascript_has_question_options_and_folded_answer(tmp_path):
    page, said = build(tmp_path, PAGE)
    assert said == ""
    first, second, third = re.findall(r'<div class="psl-predict".*?</details></div>', page, re.S)
    assert '<div class="psl-predict" id="predict-1" data-right="1" data-opens="none">' in first
    assert (
        '<p class="psl-question">Is <span class="math notranslate nohighlight">\\(x^2\\)</span> <em>l'
        in first
    )
    assert re.findall(r"<li><p>(.*?)</p></li>", first, re.S) == [
        "yes, <strong>always</strong>",
        *re.findall(r"<li><p>(not between .*?)</p></li>", first, re.S),
        "never",
    ]
    folded = first[first.index("<details") :]
    assert folded.startswith('<details class="psl-answer"><summary>Answer</summary>')
    assert folded.index('<p class="psl-right">not between') < folded.index("it is smaller.\nAnd at 2")
    assert "<p>Two paragraphs.</p>" in folded
    assert "open" not in re.search("<details[^>]*>", first)[0]
    assert 'data-place="0.5 -1 0.25"' in second
    assert "<ul" not in second
    assert 'id="predict-3">' in third  # nothing is right
    assert "psl-right" not in third


@pytest.mark.parametrize("builder", ["latex", "text"])
def test_other_builders_print_it(tmp_path, builder):
    page, said = build(tmp_path, PAGE, builder)
    assert said == ""
    order = [
        "larger",
        "never",
        "Answer:",
        "not between",
        "Two paragraphs.",
        "Where?",
        "Here.",
        "that",
        "Both are fine",
    ]
    at = 0
    for words in order:
        at = page.index(words, at)
    assert "details" not in page


@pytest.mark.parametrize(
    ("body", "complaint"),
    [
        ("- [x] alone\n\nA verdict.", "two options or more"),
        ("Only a verdict.", "two options or more"),
        ("- [x] one\n- [x] two\n\nA verdict.", "nothing to choose"),
        ("- [ ] one\n- [x] two", "needs a verdict"),
        ("- [ ] one\n- [x] two\n\nA verdict.\n\n- [ ] three", "options come first"),
        (":place: 1 2\n\nA verdict.", "place"),
        (":place: 1 2 0\n\nA verdict.", "x y tolerance"),
        (":place: 1 2 3\n- [ ] one\n- [x] two\n\nA verdict.", "has no options"),
        (":opens: all\n- [ ] one\n- [x] two\n\nA verdict.", "opens"),
        (":close: all\n- [ ] one\n- [x] two\n\nA verdict.", "close"),
    ],
)
def test_a_mistake_in_the_source_is_a_warning(tmp_path, body, complaint):
    _, said = build(tmp_path, f"# A page\n\n:::{{predict}} Is it?\n{body}\n:::\n")
    assert complaint in said
    assert "index.md" in said
