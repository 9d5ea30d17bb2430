"""What an explorer hands on: the table of branches and the files of a simplified skeleton."""

from __future__ import annotations

import html
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...skeletons import Branch, branch_rows
from ..drawing_board import Board, box_around
from .explorer import outline

if TYPE_CHECKING:
    from ...simplification import Hierarchy

#: A page shows so many branches, the longest ones; the CSV file has them all.
ROWS_SHOWN = 40
_CELL = "padding:0.1em 0.4em;text-align:right;font-variant-numeric:tabular-nums"


def branch_table(rows: list[Branch], caption: str = "Branches, the longest first") -> str:
    """Write branches as an HTML table with headers that a screen reader can follow, as wide as a phone.

    The smoothed length and widths are what to report; the CSV file has the other numbers.

    Examples
    --------
    >>> branch_table([Branch("end 0", "end 4", 4.5, 4.4, 1.0, 0.9, 1.2)]).count("<tr>")
    2
    """
    if not rows:
        return "<p>No branches: at this threshold the skeleton is made of points and sheets.</p>"
    if len(rows) > ROWS_SHOWN:
        caption += f" ({ROWS_SHOWN} of {len(rows)})"
    caption += "; the CSV file has all numbers of all branches"
    heads = ["row", "from", "to", "smooth length", "mean width", "least width"]
    lines = [f'<table style="border-collapse:collapse"><caption>{html.escape(caption)}</caption><thead><tr>']
    lines += [f'<th scope="col" style="{_CELL}">{head}</th>' for head in heads]
    lines.append("</tr></thead><tbody>")
    for number, row in enumerate(rows[:ROWS_SHOWN], start=1):
        numbers = [row.smooth_length, 2 * row.mean_radius, 2 * row.least_radius]
        cells = [row.start, row.end, *(f"{value:.4g}" for value in numbers)]
        lines.append(f'<tr><th scope="row" style="{_CELL}">{number}</th>')
        lines += [f'<td style="{_CELL}">{html.escape(cell)}</td>' for cell in cells]
        lines.append("</tr>")
    return "".join([*lines, "</tbody></table>"])


def result_files(h: Hierarchy, threshold: float, name: str) -> dict[str, bytes]:
    """Make the files of a simplified skeleton.

    Parameters
    ----------
    h : Hierarchy
    threshold : float
        In radians.
    name : str
        Begin of every file name.

    Returns
    -------
    dict of file name to content
        The skeleton as `Skeleton.save` writes it, its branches as CSV; in 2D a picture of shape and
        skeleton (SVG), in 3D the skeleton for other programs, as OBJ and PLY.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> sorted(result_files(psl.hierarchy(psl.datasets.load("gear")), 3.0, "gear"))
    ['gear-branches.csv', 'gear-skeleton.npz', 'gear.svg']
    """
    skeleton = h.skeleton(threshold)
    files = {f"{name}-branches.csv": (branch_rows(skeleton).to_csv() + "\n").encode()}
    if skeleton.dimension == 2:
        files[f"{name}.svg"] = _picture(h, threshold).encode()
    with tempfile.TemporaryDirectory() as folder:
        for suffix in (".npz",) if skeleton.dimension == 2 else (".npz", ".obj", ".ply"):
            path = Path(folder) / f"{name}-skeleton{suffix}"
            (skeleton.save if suffix == ".npz" else skeleton.to_file)(path)
            files[path.name] = path.read_bytes()
    return files


def _picture(h: Hierarchy, threshold: float) -> str:
    points = h.P.tessellation.points
    board = Board(box_around(points, 0.03), alt=f"A shape and its skeleton at {threshold / np.pi:.3g} π.")
    board.draw("shape", kind="shape", polygons=outline(points, h.P.boundary()))
    board.draw("skeleton", kind="sk0", lines=h.skeleton(threshold).segments())
    return board.svg()
