"""Questions after sections (notebooks/check.py): where they stand, what they say, what is computed of it."""

import json
import math
import re
import runpy
import subprocess
import sys
import tomllib
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

import polyskel_lite as psl

ROOT = Path(__file__).resolve().parents[2]
NOTEBOOKS = ROOT / "notebooks"
CHAPTERS = sorted(p.stem for p in NOTEBOOKS.glob("*.ipynb") if re.match(r"0[1-4]_|A_|B_", p.stem))
CHECK = re.compile(r"^:::\{check\} (?P<asked>.+)\n(?P<body>(?:.*\n)*?):::$", re.M)
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?")
choices = runpy.run_path(str(NOTEBOOKS / "check.py"))["choices"]
MISCONCEPTIONS = tomllib.loads((NOTEBOOKS / "misconceptions.toml").read_text(encoding="utf-8"))


def cells(chapter: str) -> list[dict]:
    return json.loads((NOTEBOOKS / f"{chapter}.ipynb").read_text(encoding="utf-8"))["cells"]


def prose(chapter: str) -> str:
    return "\n\n".join("".join(c["source"]) for c in cells(chapter) if c["cell_type"] == "markdown") + "\n"


def asked(chapter: str) -> list[tuple[str, list[tuple[str, str, str]]]]:
    """Each question of a chapter with its choices."""
    return [(found["asked"], choices(found["body"])) for found in CHECK.finditer(prose(chapter))]


def said(chapter: str) -> str:
    """All words of the chapter's questions."""
    return "\n".join(
        [line for one, found in asked(chapter) for line in (one, *(" :: ".join(c) for c in found))]
    )


@pytest.mark.parametrize("chapter", CHAPTERS)
class TestQuestionsOfAChapter:
    def test_three_or_more_and_the_directive_is_spelled_as_here(self, chapter):
        assert len(asked(chapter)) == prose(chapter).count("{check}") >= 3

    def test_two_or_three_wrong_choices_none_twice_and_one_is_right(self, chapter):
        for question, found in asked(chapter):
            marks = [mark for mark, _, _ in found]
            assert question.endswith("?")
            assert 3 <= len(found) <= 4, question
            assert marks.count("x") == 1, question
            assert len(set(marks)) == len(marks), f"two choices with one misconception: {question}"
            assert len({answer for _, answer, _ in found}) == len(found), question

    def test_every_choice_has_a_reason_in_sentences(self, chapter):
        for _, answer, reason in (choice for _, found in asked(chapter) for choice in found):
            assert reason.endswith("."), reason
            assert re.search(r"\w", re.sub(r"\$[^$]*\$", "", answer)), "an answer is more than a formula"
            assert not re.match(r"(?i)(yes|no|right|wrong)[.,:] ", reason), "the page says so already"

    def test_a_section_has_two_questions_at_most(self, chapter):
        text = re.sub(r"^(`{3,})\{?code.*?^\1$", "", prose(chapter), flags=re.M | re.S)
        for section in re.split(r"^#{1,4} ", text, flags=re.M):
            assert len(re.findall(r"\{(?:check|predict)\}", section)) <= 2, section[:60]

    def test_no_question_stands_before_the_first_picture(self, chapter):
        for cell in cells(chapter):
            assert "{check}" not in "".join(cell["source"])
            if any(k.startswith("image/") for o in cell.get("outputs", []) for k in o.get("data", {})):
                return
        raise AssertionError("no picture")

    def test_a_question_is_not_one_of_the_predictions(self, chapter):
        predicted = re.findall(r"\{predict\} (.+)", prose(chapter))
        assert not {question for question, _ in asked(chapter)} & set(predicted)


def test_the_right_answer_has_no_place_of_its_own():
    """A reader who always takes the first one, or the last one, is right less often than not."""
    places = [[mark for mark, _, _ in found].index("x") for c in CHAPTERS for _, found in asked(c)]
    assert len(places) >= 51
    assert max(map(places.count, set(places))) < len(places) / 2
    assert min(map(places.count, range(3))) > len(places) / 6


def test_the_right_answer_is_not_the_longest_one():
    longest = [max(found, key=lambda choice: len(choice[1]))[0] for c in CHAPTERS for _, found in asked(c)]
    assert longest.count("x") < len(longest) / 2


def test_every_misconception_is_named_where_it_shows():
    shows: dict[str, list[str]] = {name: [] for name in MISCONCEPTIONS}
    for chapter in CHAPTERS:
        marks = {mark for _, found in asked(chapter) for mark, _, _ in found} - {"x"}
        for mark in marks:
            shows[mark].append(chapter)  # a KeyError: the table does not know it
    assert shows == {name: one["shows"] for name, one in MISCONCEPTIONS.items()}
    assert all(shows.values())
    assert list(MISCONCEPTIONS) == [f"M{k}" for k in range(1, len(MISCONCEPTIONS) + 1)]
    assert len(MISCONCEPTIONS) >= 20
    assert all(one["says"].endswith(".") and one["refuted"].endswith(".") for one in MISCONCEPTIONS.values())


# --- what is computed ---------------------------------------------------------------------------------


def ring(*points: tuple[float, float]) -> psl.Shape:
    return psl.Shape.from_rings([points])


def gabriel_pairs(points) -> set[tuple[int, ...]]:
    """Strict Gabriel edges from the definition, in whole numbers."""
    kept = set()
    for a, b in combinations(range(len(points)), 2):
        p, q = points[a], points[b]
        dots = [
            (p[0] - x) * (q[0] - x) + (p[1] - y) * (q[1] - y)
            for k, (x, y) in enumerate(points)
            if k not in (a, b)
        ]
        kept |= {(a, b)} if all(dot > 0 for dot in dots) else set()
    return kept


def balls_of_a_rectangle() -> list[str]:
    """On the bisector at a corner (t, t) is as far from both sides; in the middle it is 10."""
    wide, high = 40, 20
    inside = [min(t, high - t, wide - t) for t in np.linspace(0, 10, 11)]
    assert inside == list(range(11))
    return [
        f"{wide} wide and {high} high",
        f"some of each radius from 0 to {max(inside):g}",
        "no ball of radius 10 reaches",
    ]


def densities() -> list[str]:
    thrown, even, length, n, r, w = 0.2, 0.05, 6, 30, 0.5, 0.7
    assert r < w < 2 * r
    assert n == 30
    bound = length / (2 * n)
    ratio = {4: "four"}[round(thrown / even)]
    return [
        f"of 100 points has the covering radius {thrown}, one of 40 points has {even}",
        f"its $w$ is {1 / even:g}, that of the first is {1 / thrown:g}",
        f"{ratio} times as wide",
        f"within {bound:g} of a sample",
        f"so $w$ is at least {1 / bound:g}",
        f"a piece of length {length / n:g}",
        f"A ring of length {length} carries {n} samples",
        f"any other {n} samples",
        f"$r = {r}$",
        f"The covering radius is {w}",
        f"below $2r = {2 * r:g}$ and above $r$",
    ]


def three_samples_and_a_square() -> list[str]:
    flat, high = [(0, 0), (4, 0), (2, 1)], [(0, 0), (4, 0), (2, 3)]
    assert (0, 1) not in gabriel_pairs(flat)
    assert (0, 1) in gabriel_pairs(high)
    assert len(psl.delaunay(np.array(flat, float)).simplices) == 1
    assert max(combinations(high, 2), key=lambda ends: math.dist(*ends)) == (high[0], high[1])
    assert gabriel_pairs([(0, 0), (1, 0), (1, 1), (0, 1)]) == {(0, 1), (1, 2), (2, 3), (0, 3)}
    return [f"at distance {math.dist((2, 0), (2, 1)):g} from there", "With (2, 3) in place of (2, 1)"]


def a_rectangle_has_two_vertices_in_one_place() -> list[str]:
    bones = psl.sk0(ring((0, 0), (4, 0), (4, 2), (0, 2)))
    assert bones.vertices.tolist() == [[2, 1], [2, 1]]
    return ["two, both in the centre"]


def slope_and_hat() -> list[str]:
    return [
        f"$2^{{-1.99}}$ is about {2**-1.99:.2f}",
        "slope for the ellipse is $-1.99$",
        "rises by 0.001",
        f"by {1 + 0.001:g}",
    ]


def horse_with_400_samples() -> list[str]:
    X = psl.datasets.load("horse")
    assert psl.sk2_conditions(X, X.sample(400)).hold
    return ["the horse with 400 samples", "some 400 samples"]


def a_right_triangle_agrees_inside() -> list[str]:
    P = ring((0, 0), (2, 0), (0, 2))
    inside, outside = psl.sk0(P), psl.sk2(P, P.points)
    assert inside.vertices.tolist() == outside.vertices.tolist() == [[1, 1]]
    assert len(gabriel_pairs([(0, 0), (2, 0), (0, 2)])) == 2
    obtuse = ring((0, 0), (4, 0), (2, 1))
    assert len(psl.sk0(obtuse).vertices) == 1
    assert len(psl.sk2(obtuse, obtuse.points).vertices) == 0
    return ["The right triangle agrees inside"]


def sizes() -> list[str]:
    turn = 2 * np.pi * np.arange(200) / 200
    vertices = psl.sk0(psl.Shape.from_rings([np.c_[np.cos(turn), np.sin(turn)]])).vertices
    assert np.abs(vertices).max() < 1e-6
    line = np.arange(10.0)[:, None] - 4.5
    skew = np.r_[line * [1, 0, 0] - [0, 0, 3], line * [0, 1, 0] + [0, 0, 3]]
    t = psl.delaunay(skew)
    return [
        "have 200 corners each",
        f"both have {len(vertices)}",
        f"the place of {len(vertices)} vertices",
        "$n = 200$",
        f"In space {len(skew)} samples",
        f"{len(t.simplices)} are possible",
        f"$(20/2 - 1)^2 = {(20 // 2 - 1) ** 2}$",
        f"{len(skew) - 2} or so",
        "any 20 samples",
    ]


def corners_and_units() -> list[str]:
    worth = [2 / math.tan(math.radians(angle / 2)) for angle in (60, 90)]
    return [
        f"$2\\cot 30° = {worth[0]:.2f}$ and $2\\cot 45° = {worth[1]:g}$",
        "that of 60°",
        "a corner of 60° or that of a corner of 90°",
        f"has {10**2} square millimetres",
    ]


def three_disks_and_others() -> list[str]:
    centers = np.array([(0, 0), (1, 0), (0.5, math.sqrt(0.75))])
    Y = psl.Polyball(centers, np.ones(3))
    assert list(psl.Polyball(np.array([[0, 0], [0.2, 0]]), np.array([1, 0.3])).disconnected()) == [0]
    assert list(psl.Polyball(np.array([[0, 0], [1.2, 0]]), np.array([1, 0.7])).disconnected()) == []
    return [f"x :: {len(Y.singular_points())} ::"]


def two_disks_move_apart() -> list[str]:
    pieces = [
        psl.Polyball(np.array([[0, 0], [d, 0]]), np.ones(2)).skeleton().betti()[0] for d in (1.99, 2.01)
    ]
    words = " and then ".join({1: "one,", 2: "two"}[k] for k in pieces)
    return [words, "A segment of length 1.99", "and then at 2.01"]


def a_whole_circle_has_no_singular_point() -> list[str]:
    Y = psl.Polyball(np.array([[0, 0, 0], [1, 0, 0]]), np.ones(2))
    assert len(Y.singular_points()) == 0
    return ["x :: none"]


COMPUTED = {
    "01_introduction": balls_of_a_rectangle,
    "02_1_shapes": densities,
    "02_2_graphs": three_samples_and_a_square,
    "03_four_methods": a_rectangle_has_two_vertices_in_one_place,
    "03_2_convergence": slope_and_hat,
    "03_2_polyballs": horse_with_400_samples,
    "03_5_comparison": a_right_triangle_agrees_inside,
    "03_6_complexity": sizes,
    "04_simplifying": corners_and_units,
    "A_1_polyballs": three_disks_and_others,
    "A_2_theorem_3": two_disks_move_apart,
    "A_3_theorem_4": a_whole_circle_has_no_singular_point,
}


@pytest.mark.parametrize("chapter", CHAPTERS)
def test_numbers_of_questions_are_computed(chapter):
    """Those of two digits or more, or with decimals: each is in a sentence that the table above makes."""
    sentences = COMPUTED.get(chapter, list)()
    for sentence in sentences:
        assert sentence in said(chapter), f"{chapter} does not say: {sentence}"
    there = {number for number in NUMBER.findall(said(chapter)) if len(number) > 1}
    assert there <= set(NUMBER.findall(" ".join(sentences)))


# --- the directive ------------------------------------------------------------------------------------

PAGE = r"""# A page

:::{check} Is $x^2$ *larger* than $x$?
- [M3] yes, **always** :: At $\tfrac12$ it is smaller.
- [x] not between $0$ and $1$ :: There it is *smaller*,
  and on both ends equal.
:::

:::{check} And then?
- [x] yes :: It is.
- [M1] no :: It is all the same.
:::
"""


def build(folder: Path, text: str, builder: str = "html") -> tuple[str, str]:
    """A page of a small book, and what Sphinx complains of."""
    (folder / "conf.py").write_text(
        f"import sys\nsys.path.insert(0, {str(NOTEBOOKS)!r})\n"
        'extensions = ["myst_parser", "check"]\nmyst_enable_extensions = ["colon_fence", "dollarmath"]\n'
    )
    (folder / "index.md").write_text(text, encoding="utf-8")
    command = [sys.executable, "-m", "sphinx", "-q", "-E", "-b", builder, folder, folder / builder]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    (page,) = [path for end in ("html", "txt") for path in (folder / builder).glob(f"[!gs]*.{end}")]
    return page.read_text(encoding="utf-8"), done.stderr


def test_a_page_has_a_group_of_answers_of_which_one_is_open_at_a_time(tmp_path):
    page, complaints = build(tmp_path, PAGE)
    assert complaints == ""
    first, second = re.findall(r"<fieldset.*?</fieldset>", page, re.S)
    assert first.startswith('<fieldset class="psl-check" id="check-1"><legend>Check 1</legend>')
    assert re.findall(r'<details name="([\w-]+)" class="(\w+)">', first) == [
        ("check-1", "wrong"),
        ("check-1", "right"),
    ]
    assert re.findall(r'<details name="([\w-]+)"', second) == ["check-2"] * 2
    assert "<strong>No. </strong>" in first.partition("not between")[0]
    assert "<strong>Yes. </strong>" in first.partition("not between")[2]
    assert "<em>smaller</em>, and on both ends equal." in first
    assert not re.search(r"\bM3\b|::|\[x\]", first), "marks are for authors"
    assert "<script" not in first


MISTAKES = {
    "- [x] yes :: It is.": "a right choice and a wrong one",
    "- [M1] yes :: It is.\n- [M2] no :: It is not.": "a right choice and a wrong one",
    "- [x] yes :: It is.\n- [M2] no": "reads",
    "- [x] yes :: It is.\n- [ ] no :: It is not.": "reads",
    "": "a right choice and a wrong one",
}


def test_another_builder_prints_answers_and_reasons_and_a_mistake_is_a_warning(tmp_path):
    wrong = "\n".join(f":::{{check}} Is it?\n{body}\n:::\n" for body in MISTAKES)
    page, complaints = build(tmp_path, PAGE + wrong, "text")
    at = 0
    for words in ("larger", "always", "No.", "not between", "Yes.", "smaller", "And then?"):
        at = page.index(words, at)
    for line, expected in zip(re.findall(r"index\.md.*", complaints), MISTAKES.values(), strict=True):
        assert expected in line


@pytest.mark.parametrize("body", MISTAKES)
def test_a_mistake_is_named(body):
    with pytest.raises(ValueError, match=MISTAKES[body]):
        choices(body)
