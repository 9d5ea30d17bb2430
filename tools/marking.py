"""Mark a notebook without nbgrader: one Python process for a submission, one rule for points, nbgrader's.

THIS RUNS STRANGERS' CODE AND IS NO SANDBOX: use a container or a throw-away account.

A cell that ends Python, or never ends, is taken out and the rest is marked without it. The notebook that
`marked` gives back does neither, so that nbgrader, which would stop there, can mark it too.
"""

from __future__ import annotations

import contextlib
import copy
import multiprocessing
import os
from typing import NamedTuple

from course import grade_id, is_answer, is_check, role
from nbformat import NotebookNode
from run_cells import run_cells

CELL_SECONDS = 30
GONE = "raise RuntimeError('This cell ended Python, or did not end, when it was marked.')"


class Mark(NamedTuple):
    """Points of one check cell, of how many, and what the check said."""

    name: str
    points: float
    most: float
    message: str


class Marked(NamedTuple):
    """All marks, the notebook in a form that can be run to its end, and what was taken out for that."""

    marks: list[Mark]
    notebook: NotebookNode
    taken: list[str]


def marked(notebook: NotebookNode, seconds: float = CELL_SECONDS) -> Marked:
    """Run a notebook cell by cell, again without a cell that ends Python or takes more than `seconds`."""
    notebook, taken = copy.deepcopy(notebook), []
    while True:
        said, last = _run(
            [cell.source if cell.cell_type == "code" else "" for cell in notebook.cells], seconds
        )
        if last is None:
            break
        guilty = _guilty(notebook, last)
        if guilty is None:
            break
        taken.append(grade_id(notebook.cells[guilty]) or "a cell that the student added")
        notebook.cells[guilty].source = GONE
    marks = []
    for k, cell in enumerate(notebook.cells):
        if is_check(cell):
            most = float(role(cell)["points"])
            points, message = said[k] if k < len(said) else (0.0, "Python had ended before this check")
            points = most if points is None else min(max(points, 0.0), most)
            marks.append(Mark(grade_id(cell), points, most, message))
    return Marked(marks, notebook, taken)


def _guilty(notebook: NotebookNode, last: int) -> int | None:
    """The cell to blame for the end at cell `last`: the answer that it checks, else the nearest before."""
    cells = notebook.cells
    name = grade_id(cells[last])

    def blamed(k: int) -> tuple[bool, int]:
        return bool(grade_id(cells[k])) and name.startswith(grade_id(cells[k])), k

    written = [
        k
        for k in range(last + 1)
        if cells[k].cell_type == "code"
        and cells[k].source != GONE
        and (is_answer(cells[k]) or not role(cells[k]))
    ]
    return max(written, key=blamed, default=None)


def _run(sources: list[str], seconds: float) -> tuple[list[tuple[float | None, str]], int | None]:
    """What each cell came to, and the cell at which Python ended or was ended, if it was."""
    # Forked from one process that has imported the library: quicker than a new Python, and as clean.
    kinds = multiprocessing.get_all_start_methods()
    context = multiprocessing.get_context("forkserver" if "forkserver" in kinds else "spawn")
    context.set_forkserver_preload(["IPython.core.interactiveshell", "nbformat", "polyskel_lite.coursework"])
    here, there = context.Pipe(duplex=False)
    environment = {
        "MPLBACKEND": "Agg",
        **{key: os.environ[key] for key in os.environ if key.startswith("POLYSKEL")},
    }
    child = context.Process(target=run_cells, args=(sources, environment, there))
    child.start()
    there.close()
    said = []
    if not here.poll(4 * CELL_SECONDS) or here.recv() != "begun":  # no fault of the notebook
        raise RuntimeError("the process that should run the cells did not begin")
    with contextlib.suppress(EOFError), here:
        while len(said) < len(sources) and here.poll(seconds):
            said.append(here.recv())
    child.kill()
    child.join()
    return said, (len(said) if len(said) < len(sources) else None)
