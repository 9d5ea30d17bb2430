"""Sources of the assignments: their form, their points, and that a release holds nothing of a solution."""

import re

import course
import pytest
from truth.submissions import SOURCES, TOLD

each_source = pytest.mark.parametrize("name", SOURCES)
ASKED = re.compile(r"\((\d+) points?\b[^)]*?(\d+) minutes\)")


@each_source
def test_names_are_unique_and_of_the_assignment(name):
    names = [course.grade_id(cell) for cell in SOURCES[name].cells if course.role(cell)]
    assert len(set(names)) == len(names)
    assert all(re.fullmatch(rf"{name}(-[a-z0-9]+)+", found) for found in names)
    assert all(cell.id in (course.grade_id(cell) or cell.id) for cell in SOURCES[name].cells)


@each_source
def test_every_code_answer_has_checks_and_every_check_an_answer(name):
    cells = [cell for cell in SOURCES[name].cells if course.role(cell)]
    answers = [course.grade_id(cell) for cell in cells if course.is_answer(cell) and cell.cell_type == "code"]
    owners = [
        max((a for a in answers if course.grade_id(cell).startswith(f"{a}-")), key=len, default=None)
        for cell in cells
        if course.is_check(cell)
    ]
    assert list(dict.fromkeys(owners)) == answers, (
        "checks stand in the order of the answers, each under its own"
    )


@each_source
def test_titles_say_the_points_and_minutes(name):
    points, minutes, said = 0, 0, 0
    for cell in SOURCES[name].cells:
        if cell.source.startswith("## "):
            assert points == said, cell.source.splitlines()[0]
            said, time = (int(part) for part in ASKED.search(cell.source.splitlines()[0]).groups())
            points, minutes = 0, minutes + time
        points += course.role(cell).get("points", 0)
    assert points == said
    total = sum(course.role(cell).get("points", 0) for cell in SOURCES[name].cells)
    head = re.search(r"^(\d+) points, about (\d+) minutes", SOURCES[name].cells[0].source, re.M)
    assert head.groups() == (str(total), str(minutes))


@each_source
def test_checks_begin_afresh_and_have_parts_that_are_hidden(name):
    for cell in SOURCES[name].cells:
        if course.is_check(cell):
            assert cell.source.startswith("checks = checks_fresh()\n"), course.grade_id(cell)
            assert "### BEGIN HIDDEN TESTS\n" in cell.source
            assert "import *" not in cell.source
        if course.by_hand(cell):
            assert "**Marks.**" in cell.source
        if course.is_answer(cell):
            assert "### BEGIN SOLUTION\n" in cell.source


@each_source
def test_sources_have_no_outputs(name):
    code = [cell for cell in SOURCES[name].cells if cell.cell_type == "code"]
    assert not [cell for cell in code if cell.outputs or cell.execution_count]


@each_source
def test_nothing_of_a_solution_is_in_the_release(name):
    release = course.released(SOURCES[name])
    text = "\n".join(cell.source for cell in release.cells)
    assert not re.search(r"HIDDEN|(BEGIN|END) SOLUTION|\*\*Marks|secret_rng|state_at", text)
    lines = {line.strip() for line in text.splitlines()}
    for cell, given in zip(SOURCES[name].cells, release.cells, strict=True):
        kept = given.source.splitlines()
        for line in cell.source.splitlines():
            if line not in kept and len(line.strip()) > 20:
                assert line.strip() not in lines, f"{course.grade_id(cell)}: {line}"
        if course.is_answer(cell):
            assert course.STUBS[cell.cell_type].splitlines()[0] in given.source
        if course.role(cell).get("locked"):
            assert given.metadata["editable"] is False


@each_source
def test_messages_are_held_by_submissions(name):
    """For every check some wrong submission says what its message must hold."""
    checks = {course.grade_id(cell) for cell in SOURCES[name].cells if course.is_check(cell)}
    assert checks == {check for about in TOLD[name]["submission"] for check in about.get("says", {})}
    assert {"other style", "untouched"} <= {about["name"] for about in TOLD[name]["submission"]}


@pytest.mark.parametrize(
    "text",
    [
        "### BEGIN SOLUTION\nx = 1",
        "### END SOLUTION",
        "### BEGIN SOLUTION\n### BEGIN HIDDEN TESTS\n### END HIDDEN TESTS\n### END SOLUTION",
        "### BEGIN SOLUTION\n### END HIDDEN TESTS",
    ],
)
def test_marks_that_do_not_fit_are_refused(text):
    cell = course.nbformat.v4.new_code_cell(text)
    with pytest.raises(ValueError, match=r"does not fit|has no end"):
        course.stripped(cell)


def test_answers_are_kept_and_checks_are_the_sources():
    source = SOURCES["a2"]
    sent = course.released(source)
    circle = next(cell for cell in sent.cells if course.grade_id(cell) == "a2-circle")
    circle.source = "def circumcenter(a, b, c): ..."
    second = course.copy.deepcopy(circle)
    second.source = "more = 1"
    own = course.nbformat.v4.new_code_cell("own = 2")
    check = next(cell for cell in sent.cells if course.grade_id(cell) == "a2-circle-check")
    check.source, check.metadata["nbgrader"]["points"] = "pass", 100
    sent.cells = [circle, second, own, check]
    got = course.collected(source, sent)
    by_name = {course.grade_id(cell): cell for cell in got.cells}
    assert by_name["a2-circle"].source == "def circumcenter(a, b, c): ...\n\nmore = 1"
    assert got.cells[got.cells.index(by_name["a2-circle"]) + 1].source == "own = 2"
    assert "raise NotImplementedError()" in by_name["a2-gabriel"].source
    assert by_name["a2-proof"].source == "YOUR ANSWER HERE"
    assert [c for c in got.cells if course.is_check(c)] == [c for c in source.cells if course.is_check(c)]


def test_nothing_that_a_student_needs_imports_nbgrader():
    root = course.ROOT
    files = [*root.glob("polyskel_lite/**/*.py"), root / "tools/course.py", root / "tools/marking.py"]
    assert not [file for file in files if re.search(r"(import|from) nbgrader", file.read_text("utf-8"))]


def test_a_secret_is_kept_and_can_be_given(tmp_path):
    first = course.secret(folder=tmp_path)
    assert course.secret(folder=tmp_path) == first != course.secret("another", tmp_path) == "another"
