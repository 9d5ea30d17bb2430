"""Tables of results, and what things say of themselves: tables in a notebook, words in a terminal."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from html import escape
from numbers import Integral, Real

import numpy as np

from .errors import InputError, PolyskelError


@dataclass(frozen=True)
class Table:
    """What `table` returns: rows of words under a head.

    Attributes
    ----------
    head : tuple of str
        The names of the columns.
    rows : tuple of tuple of str
    words : tuple of bool
        Which columns hold words and begin at the left; numbers end at the right.
    """

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    words: tuple[bool, ...]

    def __repr__(self) -> str:
        lines = [self.head, *self.rows]
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        set_in = [
            f"{{:{'<' if left else '>'}{width}}}" for left, width in zip(self.words, widths, strict=True)
        ]
        return "\n".join("  ".join(set_in).format(*line).rstrip() for line in lines)

    def _repr_html_(self) -> str:
        side = [f'style="text-align: {"left" if left else "right"}"' for left in self.words]

        def cells(line: Sequence[str], kinds: Sequence[str]) -> str:
            told = zip(line, kinds, side, strict=True)
            return "".join(f"<{kind} {at}>{escape(word)}</{kind.split()[0]}>" for word, kind, at in told)

        n = len(self.head)
        first = 'th scope="row"' if self.words[0] else "td"
        body = "".join(f"<tr>{cells(row, [first, *['td'] * (n - 1)])}</tr>\n" for row in self.rows)
        head = cells(self.head, ['th scope="col"'] * n)
        return f"<table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n</table>"


def table(rows: Iterable[Sequence], head: Sequence[str], decimals: int | Sequence[int] = 3) -> Table:
    """Set rows as a table: a notebook shows it as a table of the page, a terminal as columns.

    Parameters
    ----------
    rows : iterable of sequences
        One sequence a row, as long as `head`. Whole numbers and words are shown as they are, truth as yes and
        no, what is None or not a number as a dash; other numbers with `decimals`.
    head : sequence of str
        The names of the columns.
    decimals : int or sequence of int
        Digits behind the point, for all columns or for each.

    Returns
    -------
    Table

    Raises
    ------
    InputError
        If a row, or `decimals`, has another length than `head`.

    Examples
    --------
    >>> table([("horse", 400, 0.0055), ("leaf", 1308, 0.0013)], ["shape", "samples", "w⁻¹"], decimals=4)
    shape  samples     w⁻¹
    horse      400  0.0055
    leaf      1308  0.0013
    """
    head, found = tuple(head), [tuple(row) for row in rows]
    digits = list(decimals) if isinstance(decimals, Sequence | np.ndarray) else [decimals] * len(head)
    for name, line in [("decimals", digits), *((f"row {k}", row) for k, row in enumerate(found))]:
        if len(line) != len(head):
            raise InputError(f"{name} has {len(line)} entries for {len(head)} columns; give one for each.")
    said = tuple(tuple(_said(x, d) for x, d in zip(row, digits, strict=True)) for row in found)
    words = tuple(not any(_is_number(row[k]) for row in found) for k in range(len(head)))
    return Table(head, said, words)


class Described:
    """A thing that says what it is in a line, in a notebook in a small table: counts, bounds, Betti numbers.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> psl.Shape.from_rings([[(0, 0), (20, 0), (20, 4), (0, 4)]])
    Shape(2D, 4 points, 4 segments, (0, 0) to (20, 4), Betti (1, 0))
    """

    @property
    def dimension(self) -> int:
        """N, the dimension of the space."""
        raise NotImplementedError

    def _facts(self) -> Iterator[tuple[str, object]]:
        """Names and values; whole numbers are counts."""
        raise NotImplementedError

    def __repr__(self) -> str:
        said = [f"{self.dimension}D"]
        for name, value in self._facts():
            if isinstance(value, int):
                said.append(f"{value:,} {name}")
            else:
                said.append(f"{name} {value}" if isinstance(value, tuple) else str(value))
        return f"{type(self).__name__}({', '.join(said)})"

    def _repr_html_(self) -> str:
        rows = [
            (name, f"{value:,}" if isinstance(value, int) else str(value)) for name, value in self._facts()
        ]
        return table(rows, (type(self).__name__, f"{self.dimension}D"))._repr_html_()


def bounds_and_betti(
    points: np.ndarray, betti: Callable[[], tuple[int, ...]]
) -> Iterator[tuple[str, object]]:
    """Two facts: the box of the finite points, and Betti numbers where they can be told.

    Examples
    --------
    >>> list(bounds_and_betti(np.array([(0.0, 1), (2, 3)]), lambda: (1, 0)))
    [('bounds', '(0, 1) to (2, 3)'), ('Betti', (1, 0))]
    """
    points = points[np.isfinite(points).all(axis=1)]
    if len(points):
        low, high = ("(" + ", ".join(f"{x:.4g}" for x in p) + ")" for p in (points.min(0), points.max(0)))
        yield "bounds", f"{low} to {high}"
    with suppress(PolyskelError):
        yield "Betti", betti()


def _is_number(value) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool | np.bool_)


def _said(value, decimals: int) -> str:
    """One cell in words."""
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    if value is None or (_is_number(value) and math.isnan(value)):
        return "–"
    if not _is_number(value):
        return str(value)
    said = str(value) if isinstance(value, Integral) else f"{value:z.{decimals}f}"
    return said.replace("-", "−")
