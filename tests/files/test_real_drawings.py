"""Real drawings have the areas that a renderer gives them."""

import csv
import warnings
import zipfile
from pathlib import Path

import pytest

from polyskel_lite import LeftOutWarning, Shape

HERE = Path(__file__).parent
ROWS = list(csv.DictReader((HERE / "drawings.csv").read_text(encoding="utf-8").splitlines()[2:]))
with zipfile.ZipFile(HERE / "drawings.zip") as _archive:
    DRAWINGS = {name: _archive.read(name) for name in _archive.namelist()}


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["name"])
def test_area_is_the_renderer_s(tmp_path, row):
    path = tmp_path / row["name"]
    path.write_bytes(DRAWINGS[row["name"]])
    with_lines = ROWS.index(row) % 3 == 0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", LeftOutWarning)  # of text, which the renderer had no fonts for
        for stroke in (False, True)[: 1 + with_lines]:
            shape = Shape.from_file(path, stroke=stroke, mend=row["mend"] == "1")
            assert shape.area() == pytest.approx(float(row["with_lines" if stroke else "filled"]), rel=1e-2)


def test_there_are_enough_of_them():
    assert len(ROWS) == len(DRAWINGS) >= 60
