"""The command line: what it prints and writes, and the three exit codes."""

import json
import subprocess
import sys
import tomllib
import webbrowser
from pathlib import Path

import pytest

import polyskel_lite as psl
from polyskel_lite import cli

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def bar(tmp_path, monkeypatch) -> str:
    monkeypatch.chdir(tmp_path)
    psl.Shape.from_rings([[(0, 0), (20, 0), (20, 4), (0, 4)]]).to_file("bar.geojson")
    return "bar.geojson"


def test_the_script_is_installed_and_says_how_it_is_used(capsys):
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["scripts"] == {"polyskel-lite": "polyskel_lite.cli:main"}
    for command in ([], ["info"], ["skeleton"], ["explore"], ["figures"]):
        with pytest.raises(SystemExit) as done:
            cli.main([*command, "--help"])
        said = capsys.readouterr().out
        assert done.value.code == 0
        assert "examples:" in said
        assert "exit codes:" in said


def test_info_as_text_and_json(bar, capsys):
    assert cli.main(["info", bar]) == 0
    assert "radius 2 at (10, 2)" in capsys.readouterr().out
    assert cli.main(["info", bar, "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["greatest_disc"]["radius"] == pytest.approx(2)
    assert (facts["betti"], facts["area"], facts["bounds"]) == ([1, 0], 80, [[0, 0], [20, 4]])


def test_a_skeleton_and_its_files(bar, capsys):
    outs = ["s.geojson", "s.csv", "s.npz", "s.svg", "s.wkt"]
    assert cli.main(["skeleton", bar, "--json", *(x for out in outs for x in ("--out", out))]) == 0
    said = capsys.readouterr()
    facts = json.loads(said.out)
    assert said.err == ""
    assert facts["main_axis"]["length"] == pytest.approx(16, abs=0.1)
    assert facts["written"] == outs
    assert psl.Skeleton.load("s.npz").betti() == (1, 0)
    assert Path("s.csv").read_text().count("\n") == 2
    assert len(json.loads(Path("s.geojson").read_text())["features"]) == len(facts["branches"]) == 1
    assert cli.main(["skeleton", bar, "--threshold", "0.1"]) == 0
    assert capsys.readouterr().out.count("end") > 3


def test_spacing_says_how_dense_the_samples_are(bar, capsys):
    sizes = []
    for spacing in ("0.5", "0.1"):
        assert cli.main(["skeleton", bar, "--spacing", spacing, "--json"]) == 0
        sizes.append(json.loads(capsys.readouterr().out)["vertices"])
    assert sizes[1] > 4 * sizes[0]


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (["info", "none.svg"], "none.svg"),
        (["skeleton", "bar.geojson", "--strategy", "surface"], "surface"),
        (["skeleton", "bar.geojson", "--spacing", "-1"], "spacing"),
        (["skeleton", "bar.geojson", "--out", "a.doc"], "'.doc'"),
    ],
)
def test_what_is_refused_is_one_sentence_and_1(bar, capsys, arguments, word):
    assert cli.main(arguments) == 1
    said = capsys.readouterr()
    assert said.err.startswith("polyskel-lite: ")
    assert said.err.count("\n") == 1
    assert word in said.err


@pytest.mark.parametrize("arguments", [[], ["info"], ["paint", "a"], ["skeleton", "a", "--threshold", "x"]])
def test_wrong_usage_is_2(arguments, capsys):
    with pytest.raises(SystemExit) as done:
        cli.main(arguments)
    assert done.value.code == 2
    assert "usage:" in capsys.readouterr().err


def test_a_warning_is_told_and_no_failure(bar, capsys):
    assert cli.main(["skeleton", bar, "--spacing", "20"]) == 0
    assert "too coarse" in capsys.readouterr().err


def test_mend_is_handed_on(bar, monkeypatch):
    given = {}
    monkeypatch.setattr(psl.Shape, "from_file", lambda path, **options: given.update(options) or shape)
    shape = psl.Shape.from_rings([[(0, 0), (20, 0), (20, 4), (0, 4)]])
    assert cli.main(["info", bar, "--mend"]) == 0
    assert given == {"mend": True}


def test_explore_writes_a_page_and_opens_it(bar, monkeypatch, capsys):
    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    assert cli.main(["explore", bar, "--no-open", "--out", "page.html"]) == 0
    assert opened == []
    assert cli.main(["explore", bar]) == 0
    assert opened == [Path("bar.html").resolve().as_uri()]
    assert "psl-viewer" in Path("bar.html").read_text() == Path("page.html").read_text()
    assert capsys.readouterr().out.split() == ["page.html", "bar.html"]


def test_figures_are_written(tmp_path, capsys):
    assert cli.main(["figures", str(tmp_path), "figure_2"]) == 0
    assert (tmp_path / "manifest.json").exists()


def test_nothing_of_the_command_line_loads_widgets():
    code = "import sys, polyskel_lite.cli; print(*sorted({'matplotlib', 'ipywidgets'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""
