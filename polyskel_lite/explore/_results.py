"""What an explorer hands on: the table of branches and the files of a simplified skeleton."""

from __future__ import annotations

import csv
import html
import io
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..drawing import chains
from .board import Board, box_around

if TYPE_CHECKING:
    from ..simplification import Hierarchy

#: A page shows so many branches, the longest ones; the CSV file has them all.
ROWS_SHOWN = 40
_CELL = "padding:0.1em 0.7em;text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums"


class Branch(NamedTuple):
    """One branch of a skeleton, as `branch_rows` lists them.

    Attributes
    ----------
    start, end : str
        What is at its two ends: "end", "junction", "sheet" or "loop", with the number of the vertex.
    length : float
        In the unit of the coordinates.
    mean_radius, least_radius, largest_radius : float
        Of the balls along it; the mean counts every piece by its length. The width is twice the radius.
    """

    start: str
    end: str
    length: float
    mean_radius: float
    least_radius: float
    largest_radius: float


def branch_rows(h: Hierarchy, threshold: float) -> list[Branch]:
    """List the branches of a simplified skeleton, the longest first.

    Parameters
    ----------
    h : Hierarchy
    threshold : float
        In radians, as for `Hierarchy.branches`.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> rectangle = psl.Shape.from_rings([[(0, 0), (6, 0), (6, 2), (0, 2)]]).resample(48)
    >>> rows = branch_rows(psl.hierarchy(rectangle), 3)
    >>> [(round(row.length, 6), round(row.mean_radius, 2)) for row in rows]
    [(4.0, 1.01)]
    """
    graph, skeleton = h.branches(threshold), h.skeleton(threshold)
    rows = []
    for a, b, data in graph.edges(data=True):
        points, radii = skeleton.vertices[data["path"]], np.asarray(data["radii"])
        pieces = np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1))
        mean = float(radii.mean())
        if pieces.sum() > 0:
            mean = float((pieces * (radii[1:] + radii[:-1]) / 2).sum() / pieces.sum())
        ends = (f"{graph.nodes[node]['kind']} {node}" for node in (a, b))
        rows.append(Branch(*ends, data["length"], mean, float(radii.min()), float(radii.max())))
    return sorted(rows, key=lambda row: (-row.length, row))


def branch_table(rows: list[Branch], caption: str = "Branches, the longest first") -> str:
    """Write branches as an HTML table with headers that a screen reader can follow.

    Examples
    --------
    >>> branch_table([Branch("end 0", "end 4", 4.5, 1.0, 0.9, 1.2)]).count("<tr>")
    2
    """
    if not rows:
        return "<p>No branches: at this threshold the skeleton is made of points and sheets.</p>"
    left_out = len(rows) - ROWS_SHOWN
    if left_out > 0:
        caption += f" ({ROWS_SHOWN} of {len(rows)}; the CSV file has all of them)"
    heads = ("number", "from", "to", "length", "mean radius", "mean width", "least radius", "largest radius")
    lines = [f'<table style="border-collapse:collapse"><caption>{html.escape(caption)}</caption><thead><tr>']
    lines += [f'<th scope="col" style="{_CELL}">{head}</th>' for head in heads]
    lines.append("</tr></thead><tbody>")
    for number, row in enumerate(rows[:ROWS_SHOWN], start=1):
        numbers = (row.length, row.mean_radius, 2 * row.mean_radius, row.least_radius, row.largest_radius)
        cells = [row.start, row.end, *(f"{value:.4g}" for value in numbers)]
        lines.append(f'<tr><th scope="row" style="{_CELL}">{number}</th>')
        lines += [f'<td style="{_CELL}">{html.escape(cell)}</td>' for cell in cells]
        lines.append("</tr>")
    return "".join([*lines, "</tbody></table>"])


def branch_csv(rows: list[Branch]) -> str:
    """Write branches as comma-separated values, one a line, with all digits.

    Examples
    --------
    >>> print(branch_csv([Branch("end 0", "end 4", 4.5, 1.0, 0.9, 1.2)]))
    start,end,length,mean_radius,least_radius,largest_radius
    end 0,end 4,4.5,1.0,0.9,1.2
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(Branch._fields)
    writer.writerows(rows)
    return text.getvalue().rstrip("\n")


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
    files = {f"{name}-branches.csv": (branch_csv(branch_rows(h, threshold)) + "\n").encode()}
    if skeleton.dimension == 2:
        files[f"{name}.svg"] = _picture(h, threshold).encode()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}-skeleton.npz"
        skeleton.save(path)
        files[path.name] = path.read_bytes()
        for suffix in (".obj", ".ply") if skeleton.dimension == 3 else ():
            skeleton.to_file(path.with_suffix(suffix))
            files[path.with_suffix(suffix).name] = path.with_suffix(suffix).read_bytes()
    return files


def _picture(h: Hierarchy, threshold: float) -> str:
    points, boundary = h.P.tessellation.points, chains(h.P.boundary())
    board = Board(box_around(points, 0.03), alt=f"A shape and its skeleton at {threshold / np.pi:.3g} π.")
    board.draw("shape", kind="shape", polygons=[points[path] for path in boundary])
    board.draw("skeleton", kind="sk0", lines=h.skeleton(threshold).segments())
    return board.svg()
