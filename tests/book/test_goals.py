"""Goals of the chapters: what a reader does, and the exercise, self-check and task that show it."""

import json
import re
from collections import Counter
from pathlib import Path

import pytest
import teaching

NOTEBOOKS = Path(__file__).resolve().parents[2] / "notebooks"
NUMBERS = {
    "01_introduction": "1",
    "02_1_shapes": "2.1",
    "02_2_graphs": "2.2",
    "03_four_methods": "3.1",
    "03_2_polyballs": "3.2",
    "03_2_convergence": "3.2c",
    "03_5_comparison": "3.5",
    "03_6_complexity": "3.6",
    "04_simplifying": "4.1",
    "04_2_homotopy": "4.2",
    "04_3_criteria": "4.3",
    "04_results": "4.4",
    "A_1_polyballs": "A.1",
    "A_2_theorem_3": "A.2",
    "A_3_theorem_4": "A.3",
    "A_4_back_to_sk2": "A.4",
    "B_proof": "B",
    "explore": "E",
    "claims": "C",
}
CHAPTERS = [name for name in NUMBERS if re.match(r"0|A_|B_", name)]
#: What can be watched. To know, to see, to understand and to learn cannot.
VERBS = re.compile(
    r"(build|check|choose|compare|compute|count|decide|derive|draw|estimate|explain|find|follow|"
    r"look|make|mark|measure|name|order|place|predict|prove|read|rebuild|refute|remove|repair|"
    r"run|show|state|test|translate|turn|write) "
)
LEVELS = ("read off", "compute", "code", "code: debug", "code: order the lines", "prove or refute", "open")
TOP = re.compile(r"^- \*\*Goals:\*\*\n((?:  - .*(?:\n    .*)*\n)+)", re.M)
GOAL = re.compile(r"(G[\w.]+\.\d+) (\w.*)", re.S)
EXERCISE = re.compile(r"^`{3,}\{exercise\} (.+) · (.+) · (\d+) minutes\n:label: (\S+)", re.M)


def prose(chapter: str) -> str:
    return teaching.cells(NOTEBOOKS / f"{chapter}.ipynb")


def lines(listed: str) -> list[str]:
    """The items of a list, each on one line."""
    return [" ".join(item.split()) for item in re.split(r"^ *- ", listed, flags=re.M) if item.strip()]


def goals(chapter: str) -> dict[str, str]:
    """The goals at the head of a chapter by their numbers."""
    (listed,) = TOP.findall(prose(chapter))
    return dict(GOAL.fullmatch(line.rstrip(".;")).groups() for line in lines(listed))


def ties(chapter: str) -> dict[str, tuple[str, list[str], list[int], list[str]]]:
    """Of the box at the end, by number: the words, the exercises, the self-checks and the tasks."""
    ((_, listed),) = teaching.BOX.findall(prose(chapter))
    found = {}
    for line in lines(listed):
        number, words, shown = teaching.TIED.fullmatch(line.rstrip(".")).groups()
        found[number] = (
            words,
            re.findall(r"\{ref\}`([\w-]+)`", shown),
            [int(n) for part in re.findall(r"checks? ([\d, and]+)", shown) for n in re.findall(r"\d+", part)],
            re.findall(r"\bA\d\.\d\b", shown),
        )
        rest = re.sub(r"\{ref\}`[\w-]+`|checks?|tasks?|no task|\bA\d\.\d\b|\d+|and|[ ,]", "", shown)
        assert not rest, f"{number}: what is {rest!r}?"
    return found


def exercises(chapter: str) -> list[tuple[str, str, str, str]]:
    """Title, level, minutes and label."""
    return EXERCISE.findall(prose(chapter))


@pytest.mark.parametrize("chapter", NUMBERS)
class TestGoalsOfAChapter:
    def test_numbered_in_order_and_begun_by_a_verb_of_doing(self, chapter):
        found = goals(chapter)
        assert list(found) == [f"G{NUMBERS[chapter]}.{k}" for k in range(1, len(found) + 1)]
        assert 2 <= len(found) <= 6
        for number, words in found.items():
            assert VERBS.match(words), f"{number} {words}"
            assert not re.search(r"\b(know|understand|learn|see)\b", words), f"{number} {words}"

    def test_the_box_at_the_end_says_the_same_and_names_an_exercise(self, chapter):
        assert {number: words for number, (words, *_) in ties(chapter).items()} == goals(chapter)
        known = {label for *_, label in exercises(chapter)}
        for number, (_, shown, *_) in ties(chapter).items():
            assert shown, number
            assert set(shown) <= known, number

    def test_every_exercise_says_level_and_minutes(self, chapter):
        found = exercises(chapter)
        assert len(found) == len(re.findall(r"\{exercise(?:-start)?\}", prose(chapter)))
        assert all(level in LEVELS and 1 <= int(minutes) <= 240 for _, level, minutes, _ in found)

    def test_some_exercises_are_quick_and_some_are_not(self, chapter):
        levels = Counter(level for _, level, *_ in exercises(chapter))
        assert levels["read off"] >= 1
        assert levels["code: debug"] + levels["code: order the lines"] >= int(chapter in CHAPTERS)
        assert sum(levels[level] for level in LEVELS[1:]) >= 3


@pytest.mark.parametrize("chapter", CHAPTERS)
def test_no_goal_without_a_self_check_and_no_self_check_without_a_goal(chapter):
    there = len(re.findall(r"^:::\{check\}", prose(chapter), re.M))
    named = [checks for _, _, checks, _ in ties(chapter).values()]
    assert all(named), "each goal has a self-check"
    assert {n for one in named for n in one} == set(range(1, there + 1))


def test_goals_name_tasks_and_every_task_is_named():
    every = {number: named for chapter in CHAPTERS for number, (*_, named) in ties(chapter).items()}
    assert {task for named in every.values() for task in named} == set(teaching.task_titles())
    without = [number for number, named in every.items() if not named]
    assert len(without) <= len(every) / 4, without


def test_wrong_answers_given_often_are_answered():
    """A second fold under a solution: what people write there, and why it is not so."""
    text = "".join(map(prose, NUMBERS))
    # No link in the title: that is a button already.
    fold = r"^:{3,}\{dropdown\} Common wrong answers\nTo \{ref\}`([\w-]+)`:\n((?:.*\n)+?):{3,}$"
    folds = re.findall(fold, text, re.M)
    assert len(folds) == text.count("Common wrong answers")
    assert not re.search(r"\{dropdown\}.*\{ref\}", text)
    known = {label for chapter in NUMBERS for *_, label in exercises(chapter)}
    assert len({label for label, _ in folds} & known) == len(folds) >= 20
    assert all(re.search(r"^- .*[.?!]$", body, re.M) for _, body in folds)


@pytest.mark.parametrize("chapter", NUMBERS)
def test_code_solutions_end_in_asserts_that_run(chapter):
    cells = json.loads((NOTEBOOKS / f"{chapter}.ipynb").read_text(encoding="utf-8"))["cells"]
    inside, code, solved = None, [], {}
    for cell in cells:
        text = "".join(cell["source"])
        if cell["cell_type"] == "code" and inside:
            code.append(text)
            assert "skip-execution" not in cell["metadata"].get("tags", [])
        for mark, label in re.findall(r"\{solution-(start|end)\} ?(\S*)", text):
            if mark == "end":
                solved[inside] = code
            inside, code = (label, []) if mark == "start" else (None, [])
    levels = {label: level for _, level, _, label in exercises(chapter)}
    for label, level in levels.items():
        if level.startswith("code"):
            assert solved.get(label), f"{label}: the solution is no cell"
            last = solved[label][-1].rstrip().splitlines()
            assert any(line.startswith("assert ") for line in last[-6:]), label
