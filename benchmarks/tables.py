"""Tables of numbers as files that the pages read."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path


def write_table(path: Path, rows: Sequence[dict], columns: Iterable[str] | None = None) -> None:
    """Write rows as CSV, by default with the columns of the first one."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0] if columns is None else columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
