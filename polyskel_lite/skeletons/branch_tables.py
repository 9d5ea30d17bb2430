"""The branches of a skeleton as a table: lengths and radii, for the page, spreadsheets and pandas."""

from __future__ import annotations

import csv
import io
from os import PathLike
from typing import TYPE_CHECKING, NamedTuple

from ..checks import library
from ..files import writing
from ..tables import Table
from .axes import Axis, axis_of
from .branches import branch_graph
from .complexes import BallComplex

if TYPE_CHECKING:
    import pandas


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
    axis : Axis or None
        The line itself; its ``stations`` say how wide the shape is along the branch.
    """

    start: str
    end: str
    length: float
    smooth_length: float
    mean_radius: float
    least_radius: float
    largest_radius: float
    axis: Axis | None = None


#: The columns of a table of branches: everything that is a word or a number.
COLUMNS = Branch._fields[:-1]
_HEAD = tuple(name.replace("_", " ") for name in COLUMNS)


class Branches(list[Branch]):
    """The branches of a skeleton, the longest first: a list, and a table in a notebook.

    Examples
    --------
    >>> rows = Branches([Branch("end 0", "end 4", 4.5, 4.4, 1.0, 0.9, 1.2)])
    >>> print(rows.to_csv())
    start,end,length,smooth_length,mean_radius,least_radius,largest_radius
    end 0,end 4,4.5,4.4,1.0,0.9,1.2
    """

    def __repr__(self) -> str:
        return repr(self.table())

    def _repr_html_(self) -> str:
        return self.table()._repr_html_()

    def table(self) -> Table:
        """The same with four digits, as a notebook and a terminal show it.

        Examples
        --------
        >>> Branches([Branch("end 0", "end 4", 4.5, 4.4, 1.0, 0.9, 1.2)]).table()
        start  end    length  smooth length  mean radius  least radius  largest radius
        end 0  end 4     4.5            4.4            1           0.9             1.2
        """
        rows = tuple((*row[:2], *(f"{x:.4g}" for x in row[2:-1])) for row in self)
        return Table(_HEAD, rows, tuple(k < 2 for k in range(len(_HEAD))))

    def records(self) -> list[dict[str, str | float]]:
        """A dict for each branch, of words and numbers, as JSON and pandas take them.

        Examples
        --------
        >>> Branches([Branch("end 0", "end 4", 4.5, 4.4, 1.0, 0.9, 1.2)]).records()[0]["length"]
        4.5
        """
        return [dict(zip(COLUMNS, row[:-1], strict=True)) for row in self]

    def to_csv(self, path: str | PathLike | None = None) -> str:
        """Comma-separated values, one branch a line, with all digits; also as a file, if one is named.

        Examples
        --------
        >>> Branches().to_csv().count(",")
        6
        """
        stream = io.StringIO()
        csv.writer(stream, lineterminator="\n").writerows([COLUMNS, *(row[:-1] for row in self)])
        text = stream.getvalue().rstrip("\n")
        if path is not None:
            with writing(path) as place:
                place.write_text(text + "\n", encoding="utf-8")
        return text

    def to_dataframe(self) -> pandas.DataFrame:
        """The same as a pandas DataFrame (needs pandas).

        Examples
        --------
        >>> Branches([Branch("end 0", "end 4", 4.5, 4.4, 1.0, 0.9, 1.2)]).to_dataframe().shape
        (1, 7)
        """
        return library("pandas").DataFrame(self.records(), columns=list(COLUMNS))


def branch_rows(skeleton: BallComplex) -> Branches:
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
        start, end = (f"{graph.nodes[node]['kind']} {node}" for node in (a, b))
        length, smooth, mean = (data[name] for name in ("length", "smooth_length", "mean_radius"))
        radii, axis = data["radii"], axis_of(skeleton, data["path"])
        rows.append(Branch(start, end, length, smooth, mean, min(radii), max(radii), axis))
    return Branches(sorted(rows, key=lambda row: (-row.length, row[:-1])))
