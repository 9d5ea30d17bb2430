"""Mark a folder of submissions into nbgrader's gradebook: ``make grade FROM=folder`` runs this file.

THIS RUNS STRANGERS' CODE. nbgrader IS NO SANDBOX, and neither is this: an answer can read your files and send
them away. Use a container or a throw-away account.

Every notebook below the folder is a submission: of the student whom its folder names (``ada/a2.ipynb``), or
else the file (``ada.ipynb``); its cells say of which assignment. Each is marked twice: by `marking`, which
survives what nbgrader does not, and by nbgrader. Where the two differ, a person is asked.
"""

from __future__ import annotations

import argparse
import csv
import logging
import os
import re
import shutil
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import nbformat
from course import COURSE, ROOT, collected, grade_id, read, secret, sources
from marking import Marked, marked
from run_cells import limit_memory


class Submission(NamedTuple):
    """One file: whose, of which assignment; what cannot be read has none, and a reason."""

    student: str
    assignment: str
    path: Path
    reason: str = ""


def submissions(folder: Path) -> Iterator[Submission]:
    """What is handed in below a folder; of two notebooks of one student for one assignment the newer one."""
    newest: dict[tuple[str, str], Submission] = {}
    for path in sorted(folder.rglob("*.ipynb"), key=lambda path: path.stat().st_mtime):
        if ".ipynb_checkpoints" in path.parts:
            continue
        student = path.relative_to(folder).parts[0] if path.parent != folder else path.stem
        student = re.sub(r"[^\w.-]+", "_", student, flags=re.ASCII).strip("._") or "nameless"
        try:
            names = {grade_id(cell).partition("-")[0] for cell in read(path).cells} & set(sources())
        except Exception as error:  # whatever is wrong with a stranger's file
            yield Submission(student, "", path, f"cannot be read: {type(error).__name__}")
            continue
        if len(names) != 1:
            yield Submission(student, "", path, "is of no assignment: its cells' names are gone")
            continue
        found = Submission(student, *names, path)
        if older := newest.get(found[:2]):
            yield older._replace(assignment="", reason=f"{path.name} is newer")
        newest[found[:2]] = found
    yield from newest.values()


class Gradebook:
    """nbgrader's gradebook in a folder, with the sources of the assignments in it."""

    def __init__(self, folder: Path):
        warnings.filterwarnings("ignore")
        from nbgrader.apps import NbGraderAPI
        from traitlets.config import Config

        logging.getLogger("traitlets").setLevel(logging.CRITICAL)
        self.folder = folder
        settings = Config()
        settings.CourseDirectory.root = str(folder)
        settings.CourseDirectory.db_url = f"sqlite:///{folder / 'gradebook.db'}"
        settings.Execute.timeout = 120  # what would not end has been taken out before
        self.api = NbGraderAPI(config=settings)
        folder.mkdir(parents=True, exist_ok=True)
        config = 'c = get_config()\nc.CourseDirectory.db_url = "sqlite:///gradebook.db"\n'
        (folder / "nbgrader_config.py").write_text(config, encoding="utf-8")

    def _done(self, what: str, result: dict) -> None:
        if not result["success"]:
            why = result.get("error") or result.get("log") or ""
            raise RuntimeError(f"nbgrader could not do this: {what}\n{why[-2000:]}")

    def add(self, assignment: str) -> None:
        """Take an assignment's source in, as new or as changed."""
        target = self.folder / "source" / assignment / sources()[assignment].name
        text = sources()[assignment].read_text(encoding="utf-8")
        done = self.folder / "release" / assignment / target.name  # which nbgrader writes last
        if done.exists() and target.read_text(encoding="utf-8") == text:
            return
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")
        self._done(f"add {assignment}", self.api.generate_assignment(assignment, force=True, create=True))

    def mark(self, student: str, assignment: str, notebook: nbformat.NotebookNode) -> None:
        """Mark one notebook; marks given by hand before are kept."""
        target = self.folder / "submitted" / student / assignment / sources()[assignment].name
        shutil.rmtree(target.parent, ignore_errors=True)
        target.parent.mkdir(parents=True)
        nbformat.write(notebook, target)
        self._done(f"mark {student}", self.api.autograde(assignment, student, force=True, create=True))

    def grades(self) -> Iterator[dict]:
        """One row for each marked cell: whose, which task, its points, and whether a person is to mark it."""
        with self.api.gradebook as book:
            for assignment in book.assignments:
                for submission in assignment.submissions:
                    for notebook in submission.notebooks:
                        for grade in sorted(notebook.grades, key=lambda grade: grade.cell.name):
                            yield {
                                "student": submission.student.id,
                                "assignment": assignment.name,
                                "task": grade.name,
                                "points": grade.score,
                                "of": grade.max_score,
                                "by hand": bool(grade.needs_manual_grade),
                            }

    def feedback(self, student: str, assignment: str, to: Path) -> None:
        """The marked notebook as a page that asks no other host for anything."""
        self._done(f"feedback for {student}", self.api.generate_feedback(assignment, student, force=True))
        page = (
            self.folder / "feedback" / student / assignment / sources()[assignment].with_suffix(".html").name
        )
        text = re.sub(r"<script[^>]*\ssrc=[^>]*>\s*</script>", "", page.read_text(encoding="utf-8"))
        to.mkdir(parents=True, exist_ok=True)
        (to / f"{assignment}.html").write_text(text, encoding="utf-8")


def written(path: Path, rows: list[dict]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, list(rows[0]) if rows else ["nothing"])
        table.writeheader()
        table.writerows(rows)


def grade(folder: Path | None, to: Path) -> list[dict]:
    """Mark what is in `folder`, write the tables and pages into `to`, and give the rows of grades.csv."""
    os.environ["POLYSKEL_COURSE_SECRET"] = secret(folder=to)
    os.environ["PYTHONPATH"] = str(ROOT)
    os.environ["PATH"] = (
        f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"  # nbgrader calls alembic
    )
    book = Gradebook((to / "gradebook").resolve())
    look: list[dict] = []

    def look_at(student: str, assignment: str, what: str) -> None:
        look.append({"student": student, "assignment": assignment, "to do": what})

    own: dict[tuple[str, str], Marked] = {}
    for student, assignment, path, reason in list(submissions(folder) if folder else ()):
        print(student, assignment or path.name, flush=True)
        if reason:
            look_at(student, assignment, f"{path.name} {reason}")
            continue
        try:
            book.add(assignment)
            found = marked(collected(read(sources()[assignment]), read(path)))
            own[student, assignment] = found
            book.mark(student, assignment, found.notebook)
            book.feedback(student, assignment, to / "feedback" / student)
        except Exception as error:  # one submission never stops the others
            look_at(student, assignment, f"mark it yourself: {type(error).__name__}: {str(error)[-300:]}")
        for cell in own[student, assignment].taken if (student, assignment) in own else ():
            look_at(student, assignment, f"{cell} ended Python or did not end, and was left out")
    rows = list(book.grades())
    for student, assignment in dict.fromkeys((row["student"], row["assignment"]) for row in rows):
        if folder is None:  # marks have been given by hand since
            book.feedback(student, assignment, to / "feedback" / student)
    points = {(row["student"], row["assignment"], row["task"]): row["points"] for row in rows}
    for (student, assignment), found in own.items():
        for mark in found.marks:
            if points.get((student, assignment, mark.name)) != mark.points:
                other = points.get((student, assignment, mark.name))
                look_at(
                    student, assignment, f"{mark.name}: nbgrader gives {other}, alone it got {mark.points:g}"
                )
    for row in rows:
        if row["by hand"]:
            look_at(row["student"], row["assignment"], f"{row['task']} of {row['of']:g} points")
    totals = []
    for student, assignment in sorted({(row["student"], row["assignment"]) for row in rows}):
        mine = [row for row in rows if (row["student"], row["assignment"]) == (student, assignment)]
        total = {"student": student, "assignment": assignment, "points": sum(row["points"] for row in mine)}
        total |= {
            "of": sum(row["of"] for row in mine),
            "still by hand": sum(row["of"] for row in mine if row["by hand"]),
        }
        totals.append(total)
    written(to / "grades.csv", totals)
    written(to / "tasks.csv", rows)
    written(to / "by_hand.csv", look)
    return totals


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "folder", type=Path, nargs="?", help="without it, tables and feedback are written again"
    )
    parser.add_argument("--to", type=Path, default=COURSE)
    given = parser.parse_args()
    if given.folder and not given.folder.is_dir():
        sys.exit(f"There is no folder {given.folder}.")
    limit_memory()
    for row in grade(given.folder, given.to):
        print(*row.values(), sep="\t")
    print(f"Marks: {given.to / 'grades.csv'}. What you have to look at: {given.to / 'by_hand.csv'}.")


if __name__ == "__main__":
    main()
