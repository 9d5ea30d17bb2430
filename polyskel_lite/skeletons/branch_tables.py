"""The branches of a skeleton as a table: lengths and radii, for the page and for spreadsheets."""

from __future__ import annotations

import csv
import io
from typing import NamedTuple

from .branches import branch_graph
from .skeleton import Skeleton


class Branch(NamedTuple):
    """One branch of a skeleton, as `branch_rows` lists them.

    Attributes
    ----------
    start, end : str
        What is at its two ends: "end", "junction", "sheet" or "loop", with the number of the vertex.
    length, smooth_length : float
        In the unit of the coordinates: of the edges, and without their zigzag between the samples.
    mean_radius, least_radius, largest_radius : float
        Of the balls along it; the mean counts every piece by its length. The width is twice the radius.
    """

    start: str
    end: str
    length: float
    smooth_length: float
    mean_radius: float
    least_radius: float
    largest_radius: float


def branch_rows(skeleton: Skeleton) -> list[Branch]:
    """List the branches of a skeleton, the longest first (needs the extra ``graph``).

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> rectangle = psl.Shape.from_rings([[(0, 0), (6, 0), (6, 2), (0, 2)]]).resample(48)
    >>> rows = branch_rows(psl.hierarchy(rectangle).skeleton(3))
    >>> [(round(row.length, 6), round(row.mean_radius, 2)) for row in rows]
    [(4.0, 1.01)]
    """
    graph = branch_graph(skeleton)
    rows = []
    for a, b, data in graph.edges(data=True):
        ends = (f"{graph.nodes[node]['kind']} {node}" for node in (a, b))
        numbers = (data[name] for name in ("length", "smooth_length", "mean_radius"))
        rows.append(Branch(*ends, *numbers, min(data["radii"]), max(data["radii"])))
    return sorted(rows, key=lambda row: (-row.length, row))


def branch_csv(rows: list[Branch]) -> str:
    """Write branches as comma-separated values, one a line, with all digits.

    Examples
    --------
    >>> print(branch_csv([Branch("end 0", "end 4", 4.5, 4.4, 1.0, 0.9, 1.2)]))
    start,end,length,smooth_length,mean_radius,least_radius,largest_radius
    end 0,end 4,4.5,4.4,1.0,0.9,1.2
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(Branch._fields)
    writer.writerows(rows)
    return text.getvalue().rstrip("\n")
