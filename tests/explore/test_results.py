"""What a reader takes home: the table of branches, and files of the skeleton."""

import csv
import re
from base64 import b64decode
from xml.etree import ElementTree

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import explore
from polyskel_lite.explore.explorers import bring_your_own, results
from polyskel_lite.skeletons import branch_rows


def test_table_follows_the_threshold_and_is_for_screen_readers():
    own = explore.explore(psl.datasets.load("leaf"))
    for threshold in (0.5, np.pi, 2 * np.pi):
        own.picture.threshold = threshold
        table = ElementTree.fromstring(own._table.value)
        graph = own.hierarchy.branches(threshold)
        rows = table.findall("tbody/tr")
        assert len(rows) == min(graph.number_of_edges(), results.ROWS_SHOWN)
        assert f"{threshold / np.pi:.3g} π" in table.find("caption").text
        assert all(head.get("scope") == "col" for head in table.findall("thead/tr/th"))
        assert all(row.find("th").get("scope") == "row" for row in rows)
        heads = [head.text for head in table.findall("thead/tr/th")]
        assert heads == ["row", "from", "to", "smooth length", "mean width", "least width"]  # fit a phone
        assert "nowrap" not in own._table.value
        assert "CSV file has all" in table.find("caption").text
        lengths = [float(row.findall("td")[2].text) for row in rows]
        assert lengths == sorted(lengths, reverse=True)


def test_files_hold_the_skeleton_and_its_branches(tmp_path):
    own = explore.explore(psl.datasets.load("lake"))
    own.picture.threshold = 2.0
    skeleton = own.hierarchy.skeleton(2.0)
    paths = {path.name: path for path in own.save(tmp_path)}
    back = psl.Skeleton.load(paths["shape-skeleton.npz"])
    assert np.array_equal(back.vertices, skeleton.vertices)
    assert np.array_equal(back.edges, skeleton.edges)
    rows = list(csv.DictReader(paths["shape-branches.csv"].read_text().splitlines()))
    assert sum(float(row["length"]) for row in rows) == pytest.approx(skeleton.length())
    assert all(
        float(row["least_radius"]) <= float(row["mean_radius"]) <= float(row["largest_radius"])
        for row in rows
    )
    picture = ElementTree.parse(paths["shape.svg"]).getroot()
    assert "2" in picture.get("viewBox") or picture.get("role") == "img"
    own.make.click()
    links = re.findall(
        r'download="([^"]*)" href="data:application/octet-stream;base64,([^"]*)"', own._links.value
    )
    assert {name: b64decode(content) for name, content in links}.keys() == paths.keys()
    assert b64decode(dict(links)["shape-branches.csv"]) == paths["shape-branches.csv"].read_bytes()
    own.picture.threshold = 2.5
    assert own._links.value == ""  # those files were for another threshold


def test_files_of_solids(tmp_path):
    own = explore.explore(psl.datasets.load("fourbranch"))
    own.picture.strategy = "wireframe"
    own.picture.threshold = 2 * np.pi
    skeleton = own.hierarchy.skeleton(2 * np.pi)
    paths = {path.suffix: path for path in own.save(tmp_path)}
    assert paths.keys() == {".csv", ".npz", ".obj", ".ply"}
    assert paths[".obj"].read_text().count("\nv ") + 1 >= len(skeleton.vertices)
    assert (
        len(paths[".csv"].read_text().splitlines()) == own.hierarchy.branches(2 * np.pi).number_of_edges() + 1
    )
    assert "psl-viewer" in own._repr_mimebundle_()["text/html"]


def test_files_are_written_beside_the_notebook_or_it_says_why_not(tmp_path, monkeypatch):
    own = explore.explore(psl.datasets.load("gear"))
    monkeypatch.chdir(tmp_path)
    own.write.click()
    assert "Written" in own._links.value
    assert (tmp_path / "shape-branches.csv").exists()
    own.chain = bring_your_own.Chain("no/such/folder", *list(vars(own.chain).values())[1:])
    own.write.click()
    assert "Not written" in own._links.value


def test_branch_of_a_strip_has_its_width():
    strip = psl.Shape.from_rings([[(0, 0), (20, 0), (20, 2), (0, 2)]]).resample(220)
    (row,) = branch_rows(psl.hierarchy(strip).skeleton(np.pi))
    assert row.length == pytest.approx(18, abs=0.2)
    assert 2 * row.mean_radius == pytest.approx(2, rel=0.02)
    assert results.branch_table([]).startswith("<p>No branches")
