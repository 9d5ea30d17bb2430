"""Submissions of the assignments that are right, wrong or hostile, from ``notebooks/course/wrong``."""

import copy
import tomllib
from typing import Any, NamedTuple

import course
import nbformat

SOURCES = {name: course.read(path) for name, path in course.sources().items()}
TOLD = {
    name: tomllib.loads((course.SOURCES / "wrong" / f"{name}.toml").read_text(encoding="utf-8"))
    for name in SOURCES
}


class Told(NamedTuple):
    """One submission of an assignment and what its file says of it."""

    assignment: str
    about: dict[str, Any]

    @property
    def notebook(self) -> nbformat.NotebookNode:
        """What the student would hand in: the release with the answers in it."""
        source, about = SOURCES[self.assignment], self.about
        notebook = course.released(source)
        answers = {} if about.get("untouched") else {course.grade_id(c): c.source for c in source.cells}
        answers = {name: text for name, text in answers.items() if text and name in answer_names(source)}
        for name, (old, new) in about.get("replace", {}).items():
            assert old in answers[name], f"{old!r} is not in {name}"
            answers[name] = answers[name].replace(old, new)
        answers |= {name: text.strip("\n") for name, text in about.get("cells", {}).items()}
        for cell in notebook.cells:
            cell.source = answers.pop(course.grade_id(cell), cell.source)
        assert not answers, f"no cells of these names: {list(answers)}"
        gone = about.get("delete", [])
        notebook.cells = [cell for cell in notebook.cells if course.grade_id(cell) not in gone]
        return copy.deepcopy(notebook)


def answer_names(source: nbformat.NotebookNode) -> list[str]:
    return [course.grade_id(cell) for cell in source.cells if course.is_answer(cell)]


SUBMISSIONS = [Told(name, about) for name, told in TOLD.items() for about in told["submission"]]
