"""Assignments: from one source a release for students and a copy for the teacher, by ``make course``.

A source is a notebook in ``notebooks/course/`` with nbgrader's metadata. What stands between the lines
``### BEGIN SOLUTION`` and ``### END SOLUTION`` becomes a stub, what is between ``### BEGIN HIDDEN TESTS`` and
its end goes. This needs no nbgrader: the few rules are nbgrader's own, and ``tests/course`` compares both.
"""

from __future__ import annotations

import argparse
import copy
import os
import re
import secrets
import shutil
import sys
from pathlib import Path

import nbformat
from nbformat import NotebookNode

ROOT = Path(__file__).resolve().parent.parent
SOURCES = ROOT / "notebooks" / "course"
COURSE = ROOT / "_course"
#: With the slides, the handout and the guide; the whole book, since they link to it and share its pictures.
BOOK = ROOT / "_build" / "html"
STUBS = {"code": "# YOUR CODE HERE\nraise NotImplementedError()", "markdown": "YOUR ANSWER HERE"}
MARK = re.compile(r"\s*#+ (BEGIN|END) (SOLUTION|HIDDEN TESTS)\s*")

INSTALLS = re.compile(r"\s*([%!] *pip\b|$)")  # what the browser needs is here when a submission is marked


def sources() -> dict[str, Path]:
    """Every assignment's source by its short name: a1, a2 ..."""
    return {path.stem.partition("_")[0]: path for path in sorted(SOURCES.glob("a[0-9]_*.ipynb"))}


def read(path: Path) -> NotebookNode:
    return nbformat.read(path, as_version=4)


def role(cell: NotebookNode) -> dict:
    """What nbgrader's metadata says of a cell; nothing for a cell that is plain text or the student's own."""
    about = cell.metadata.get("nbgrader")
    return about if isinstance(about, dict) and isinstance(about.get("grade_id"), str) else {}


def grade_id(cell: NotebookNode) -> str:
    return role(cell).get("grade_id", "")


def is_answer(cell: NotebookNode) -> bool:
    """Whether the student writes in this cell, code or text."""
    return bool(role(cell).get("solution"))


def is_check(cell: NotebookNode) -> bool:
    """Whether running this cell gives points."""
    return cell.cell_type == "code" and bool(role(cell).get("grade")) and not is_answer(cell)


def by_hand(cell: NotebookNode) -> bool:
    """Whether a person marks this cell."""
    return bool(role(cell).get("grade")) and is_answer(cell)


def stripped(cell: NotebookNode) -> str:
    """A cell's text without its solution and hidden tests."""
    kept, inside = [], ""
    for line in cell.source.split("\n"):
        mark = MARK.fullmatch(line)
        if mark and mark.groups() != (("END", inside) if inside else ("BEGIN", mark[2])):
            raise ValueError(f"{grade_id(cell)}: {line.strip()!r} does not fit what stands before it")
        if mark:
            inside = mark[2] if mark[1] == "BEGIN" else ""
            if inside == "SOLUTION":
                indent = re.match(r"\s*", line)[0]
                kept += [indent + stub for stub in STUBS[cell.cell_type].split("\n")]
        elif not inside:
            kept.append(line)
    if inside:
        raise ValueError(f"{grade_id(cell)}: {inside} has no end")
    return "\n".join(kept)


def released(source: NotebookNode) -> NotebookNode:
    """The students' notebook: no solutions, hidden tests, outputs; what is not theirs to write is locked."""
    notebook = copy.deepcopy(source)
    for cell in notebook.cells:
        cell.source = stripped(cell)
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
        if role(cell).get("locked"):
            cell.metadata |= {"deletable": False, "editable": False}
    return notebook


def collected(source: NotebookNode, submission: NotebookNode) -> NotebookNode:
    """The source with a submission's answers in it: checks and points are the source's, whatever was sent in.

    Cells that a student has added stay, each after the same cell. An answer in several cells of one name (a
    cell that was split or copied) is all of them; one that is not there at all is the stub.
    """
    answers: dict[str, list[str]] = {}
    added: dict[str, list[NotebookNode]] = {}
    ours = {grade_id(cell) for cell in source.cells} - {""}
    place = ""
    for cell in submission.cells:
        name = grade_id(cell)
        if name in ours:
            place = name
            answers.setdefault(name, []).append(cell.source)
        elif cell.cell_type == "code" and not INSTALLS.match(cell.source):
            kept = nbformat.v4.new_code_cell(cell.source)
            added.setdefault(place, []).append(kept)
    notebook = copy.deepcopy(source)
    notebook.cells = list(added.get("", []))
    for cell in copy.deepcopy(source.cells):
        if is_answer(cell):
            cell.source = "\n\n".join(answers.get(grade_id(cell), [stripped(cell)]))
        notebook.cells += [cell, *added.get(grade_id(cell) or "-", [])]
    return notebook


def secret(given: str = "", folder: Path = COURSE) -> str:
    """The teacher's secret, which seeds the hidden tests: the one given, or the one kept, or a new one."""
    path = folder / "secret"
    if not given and path.exists():
        return path.read_text(encoding="utf-8").strip()
    folder.mkdir(parents=True, exist_ok=True)
    path.write_text((given or secrets.token_hex(8)) + "\n", encoding="utf-8")
    return secret(folder=folder)


def write(name: str, to: Path) -> str:
    """Write an assignment's release and the teacher's copy, unless its own solution fails a check."""
    from marking import marked

    path = sources()[name]
    source = read(path)
    marks = marked(source).marks
    for mark in marks:
        if mark.points < mark.most:
            raise ValueError(f"{path.name}: its own solution fails {mark.name}: {mark.message}")
    for kind, notebook in (("release", released(source)), ("instructor", source)):
        target = to / kind / name / path.name
        target.parent.mkdir(parents=True, exist_ok=True)
        nbformat.write(notebook, target)
    hand = sum(role(cell)["points"] for cell in source.cells if by_hand(cell))
    return f"{path.name}: {sum(mark.most for mark in marks):g} points by machine, {hand:g} by hand"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--assignment", default="", help="one of them, as a2; without it all")
    parser.add_argument(
        "--secret", default="", help="seeds hidden tests; without it the last one, or a new one"
    )
    parser.add_argument("--to", type=Path, default=COURSE)
    given = parser.parse_args()
    os.environ["POLYSKEL_COURSE_SECRET"] = secret(given.secret, given.to)
    wanted = [name for name in sources() if given.assignment in ("", name)]
    if not wanted:
        sys.exit(f"There is no assignment {given.assignment!r}; there are {', '.join(sources())}.")
    for name in wanted:
        try:
            print(write(name, given.to), flush=True)
        except ValueError as error:
            sys.exit(f"Not released. {error}")
    print(f"For students: {given.to / 'release'}\nFor you, with solutions: {given.to / 'instructor'}")
    if BOOK.exists():
        shutil.rmtree(given.to / "book", ignore_errors=True)  # pages that the book no longer has
        shutil.copytree(BOOK, given.to / "book")
        print(f"Slides, handout and the guide: {given.to / 'book' / 'teaching.html'}")


if __name__ == "__main__":
    main()
