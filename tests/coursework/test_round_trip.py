"""The whole way through nbgrader: a folder of submissions becomes tables, pages and a list to do."""

import csv
import json

import course
import nbformat
import pytest
from truth.submissions import SOURCES, SUBMISSIONS

pytestmark = pytest.mark.slow
ASSIGNMENTS = list(SOURCES)[:2]
WRONG = ("untouched", "ends Python", "tampering", "one number of two", "prints and eats")


@pytest.fixture(scope="module")
def marked_folder(tmp_path_factory):
    """Submissions of two assignments, files that are none, and what grading makes of them."""
    pytest.importorskip("nbgrader")
    import grading

    folder, to = tmp_path_factory.mktemp("in"), tmp_path_factory.mktemp("course")
    told = {}
    for submission in SUBMISSIONS:
        name, about = submission.assignment, submission.about
        if name in ASSIGNMENTS and (about["name"] == "other style" or about["name"] in WRONG):
            student = about["name"].replace(" ", "-")
            target = folder / student / name / "any name.ipynb"
            target.parent.mkdir(parents=True)
            nbformat.write(submission.notebook, target)
            told[student, name] = about
    (folder / "broken.ipynb").write_text("no notebook", encoding="utf-8")
    (folder / "empty.ipynb").write_text(json.dumps(nbformat.v4.new_notebook()), encoding="utf-8")
    grading.grade(folder, to)
    tables = {}
    for name in ("grades", "tasks", "by_hand"):
        with (to / f"{name}.csv").open(encoding="utf-8") as file:
            tables[name] = list(csv.DictReader(file))
    return to, told, tables


def test_every_task_gets_its_points(marked_folder):
    _, told, tables = marked_folder
    assert len(told) > 3
    for (student, name), about in told.items():
        rows = [row for row in tables["tasks"] if (row["student"], row["assignment"]) == (student, name)]
        hand = {course.grade_id(cell) for cell in SOURCES[name].cells if course.by_hand(cell)}
        lost = {
            row["task"]: float(row["of"]) - float(row["points"]) for row in rows if row["task"] not in hand
        }
        assert {task: points for task, points in lost.items() if points} == about.get("lost", {}), student
        asked = {row["task"] for row in rows if row["by hand"] == "True"}
        assert asked == (set() if about.get("untouched") else hand)


def test_both_graders_agree_and_the_list_names_what_to_look_at(marked_folder):
    _, told, tables = marked_folder
    listed = [(row["student"], row["to do"]) for row in tables["by_hand"]]
    assert not [what for _, what in listed if "nbgrader gives" in what or "yourself" in what]
    assert ("broken", "broken.ipynb cannot be read: NotJSONError") in listed
    assert [what for student, what in listed if student == "empty"] == [
        "empty.ipynb is of no assignment: its cells' names are gone"
    ]
    for (student, _), about in told.items():
        for cell in about.get("taken", ()):
            assert (student, f"{cell} ended Python or did not end, and was left out") in listed
    assert len(tables["grades"]) == len(told)


def test_feedback_shows_the_message_and_asks_no_other_host(marked_folder):
    to, told, _ = marked_folder
    for student, name in told:
        page = (to / "feedback" / student / f"{name}.html").read_text(encoding="utf-8")
        assert 'src="http' not in page
        if student == "untouched":
            assert "is not written yet" in page


def test_releases_are_those_of_nbgrader(marked_folder):
    to, _, _ = marked_folder
    for name in ASSIGNMENTS:
        theirs = course.read(to / "gradebook" / "release" / name / course.sources()[name].name)
        ours = course.released(SOURCES[name])
        assert [cell.source.strip() for cell in theirs.cells] == [cell.source.strip() for cell in ours.cells]
