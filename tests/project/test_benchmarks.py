"""The benchmarks run, on tiny sizes; nothing here looks at a clock."""

import csv
import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import polyskel_lite as psl

FOLDER = Path(__file__).resolve().parents[2] / "benchmarks"


@pytest.fixture
def module(monkeypatch):
    monkeypatch.syspath_prepend(FOLDER)

    def load(name):
        spec = importlib.util.spec_from_file_location(f"benchmark_{name}", FOLDER / f"{name}.py")
        loaded = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(loaded)
        return loaded

    return load


def rows_of(path: Path) -> list[dict]:
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_inputs_are_what_they_say(module):
    inputs = module("inputs")
    curve, horse = inputs.lobed_curve(500), inputs.outline(500)
    assert curve.betti() == horse.betti() == (1, 0)
    assert len(curve.points) == len(horse.points) == 500
    steps = np.sqrt((np.diff(curve.segments, axis=1)[:, 0] ** 2).sum(axis=1))
    # Chords of equal arcs: shorter where a lobe turns, never longer than the others.
    assert steps.max() < 1.05 * np.median(steps)
    tessellation = psl.delaunay(inputs.bumpy_samples(400))
    P = psl.DelaunayShape(tessellation, inputs.bumpy_inside(tessellation))
    assert P.betti() == psl.sk0(P).betti() == (1, 0, 0)


def triangles(points, faces) -> set:
    """Triangles by their corners, up to what rounding does."""
    return {frozenset(map(tuple, corners)) for corners in (np.round(points[faces], 9) + 0.0).tolist()}


def test_primitives_are_those_of_trimesh(module):
    creation = pytest.importorskip("trimesh.creation")
    box = creation.box()
    for _ in range(3):
        box = box.subdivide()
    theirs = {
        "icosphere": creation.icosphere(),
        "uv sphere": creation.uv_sphere(),
        "torus": creation.torus(1, 0.25),
        "box": box,
        "cylinder": creation.cylinder(1, 1),
        "capsule": creation.capsule(),
    }
    ours = module("inputs").primitives()
    assert ours.keys() == theirs.keys()
    for name, mesh in theirs.items():
        points, faces = ours[name]
        assert len(points) == len(mesh.vertices)
        assert len(faces) == len(mesh.faces)
        assert triangles(points, faces) == triangles(mesh.vertices, mesh.faces)
        assert psl.Shape.from_mesh(points, faces).volume() > 0


def test_a_coast_and_a_curve_with_gaps(module, tmp_path):
    inputs = module("inputs")
    inputs.write_geojson(tmp_path / "coast.geojson", inputs.coast(500))
    assert psl.Shape.from_file(tmp_path / "coast.geojson").betti() == (1, 0)
    points, facets = inputs.random_curve(400)
    steps = np.sqrt(((points[facets[:, 1]] - points[facets[:, 0]]) ** 2).sum(axis=1))
    assert steps.max() > 100 * steps.min()
    assert len(psl.conform(psl.Shape(points, facets)).points) > 400


@pytest.mark.parametrize("numba", [True, False])
@pytest.mark.parametrize(
    ("name", "n"),
    [("curve", 300), ("curve at random", 300), ("outline", 300), ("bumpy sphere", 300), ("vertebra", 2011)],
)
def test_every_stage_of_one_measurement(name, n, numba):
    command = [sys.executable, FOLDER / "stages.py", "--one", name, str(n), str(int(numba)), "--repeats", "1"]
    rows = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
    assert rows[0]["stage"] == "scipy"
    assert float(rows[0]["ratio"]) == 1
    assert {(row["input"], row["n"], row["numba"]) for row in rows} == {(name, n, int(numba))}


def test_the_table_is_written(module, monkeypatch, tmp_path):
    stages = module("stages")
    monkeypatch.setattr(stages, "SIZES", {"curve": (100, 10_000), "bumpy sphere": (100,)})
    monkeypatch.setattr(stages, "PAPER", ())
    stages.main(["--largest", "100", "--repeats", "1", "--out", str(tmp_path)])
    rows = rows_of(tmp_path / "results.csv")
    assert {(row["input"], row["n"], row["numba"]) for row in rows} == {
        (name, "100", numba) for name in ("curve", "bumpy sphere") for numba in "01"
    }
    known = json.loads((tmp_path / "machine.json").read_text())
    assert known["numpy"] == np.__version__
    assert known["measured"]["results.csv"].keys() == {"commit", "date"}


def test_targets_before_and_now(module, monkeypatch, tmp_path):
    targets = module("targets")
    keys = ("delaunay", "whole 2D", "conform", "whole 3D", "primitives", "coast")
    small = {key: next(t for t in targets.TARGETS if t.key == key) for key in keys}
    small = {key: t._replace(n=min(t.n, 150)) for key, t in small.items()}
    found = {key: targets.measure(target, repeats=1) for key, target in small.items()}
    assert all(float(row["first"]) > 0 < float(row["second"]) for row in found.values())
    assert found["conform"]["points"] > 150 == found["whole 2D"]["points"]
    assert found["primitives"]["points"] == 642
    # A file keeps the rows that are not measured again, and the numbers of the state before.
    monkeypatch.setattr(targets, "TARGETS", [small["delaunay"], small["coast"]])
    row = {"first": "0.5", "second": "0.4"}
    monkeypatch.setattr(
        targets, "in_subprocess", lambda _, target, repeats, old=None: row if not old else {"first": "2"}
    )
    targets.main(["--out", str(tmp_path), "--old", str(FOLDER)])
    targets.main(["--out", str(tmp_path), "--only", "coast"])
    rows = rows_of(tmp_path / "targets.csv")
    assert [row["key"] for row in rows] == ["delaunay", "coast"]
    assert all((row["old_first"], row["old_second"], row["second"]) == ("2", "", "0.4") for row in rows)
    assert "targets.csv" in json.loads((tmp_path / "machine.json").read_text())["measured"]


def test_a_work_that_takes_too_long_or_fails_is_a_row_that_says_so(module, capfd):
    targets = module("targets")
    slow = targets.TARGETS[0]._replace(limit=0.01)
    assert targets.in_subprocess(0, slow, 1) == {"first": "> 0.01", "second": "> 0.01"}
    assert targets.in_subprocess(10**6, targets.TARGETS[0], 1)["first"] == "failed"
    assert "IndexError" in capfd.readouterr().err


def test_peers_without_and_with_an_interpreter(module, tmp_path):
    peers = module("peers")
    peers.main(["--small", "--out", str(tmp_path)])
    rows = rows_of(tmp_path / "peers.csv")
    assert [(row["shape"], row["method"]) for row in rows] == [
        ("horse", "branch"),
        ("torus", "surface"),
        ("torus", "wireframe"),
    ]
    assert all(row["found"] == row["loops"] for row in rows)
    # scikit-image is in the project's own environment; a peer that is missing is a row that says so.
    pytest.importorskip("skimage")
    _, loops, data = peers.region("gear", 80)
    assert peers.theirs(sys.executable, "scikit-image skeletonize", data)["found"] == loops == 1
    missing = peers.theirs(sys.executable, "kimimaro skeletonize", data)
    assert missing["found"] == "" or missing["seconds"] >= 0
    assert peers.theirs(sys.executable, "scikit-image skeletonize", data, limit=0.01)["note"].startswith(
        "stopped"
    )


def test_numbers_of_graphs_and_pixels(module):
    runner = module("peer_runner")
    triangle = np.array([(0, 1), (1, 2), (2, 0), (0, 1), (3, 3)])
    assert runner.graph_numbers(4, triangle) == (1, 2)
    assert runner.line_numbers([np.array([(0, 0), (1, 0), (1, 1)]), np.array([(1, 1), (0, 0)])]) == (1, 1)
    pytest.importorskip("skimage")
    frame = np.zeros((9, 9), dtype=bool)
    frame[1:5, 1:5], frame[2:4, 2:4], frame[7, 7] = True, False, True
    assert runner.cell_numbers(frame) == (1, 2)


def test_committed_numbers_have_the_columns(module):
    stages, peers, targets = module("stages"), module("peers"), module("targets")
    assert tuple(rows_of(FOLDER / "targets.csv")[0]) == targets.COLUMNS
    assert tuple(rows_of(FOLDER / "results.csv")[0]) == stages.COLUMNS
    assert tuple(rows_of(FOLDER / "peers.csv")[0]) == peers.COLUMNS
    pinned = (FOLDER / "peers.txt").read_text().split()
    assert all(line.count("==") == 1 and not line.startswith("-") for line in pinned)


def test_polyballs(tmp_path):
    command = [
        sys.executable,
        FOLDER / "polyballs.py",
        "--largest",
        "100",
        "--polyballs",
        "11",
        "--out",
        tmp_path,
    ]
    subprocess.run(command, check=True, stdout=subprocess.PIPE)
    times, checks = rows_of(tmp_path / "polyballs.csv"), rows_of(tmp_path / "polyball_checks.csv")
    assert [(row["balls"], row["dimension"]) for row in times] == [
        (name, N) for name in ("scattered", "chain") for N in "23"
    ]
    for row in checks:
        assert int(row["medial_points"]) > 500
        assert row["missed"] == row["not_medial"] == row["betti_wrong"] == "0"
