"""One list of packages everywhere, and a wheel that works with NumPy, SciPy and Matplotlib alone."""

import re
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parents[2]
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT, GROUPS = PYPROJECT["project"], PYPROJECT["dependency-groups"]
EXTRAS = PROJECT["optional-dependencies"]
LOCKS = {path.stem: path.read_text(encoding="utf-8") for path in (ROOT / "requirements").glob("*.lock")}
PIN = re.compile(r"^([A-Za-z0-9._-]+)==([^\s;]+)(?: ;([^\\\n]*))? \\\n    --hash=sha256:[0-9a-f]{64}", re.M)
each_lock = pytest.mark.parametrize("name", LOCKS)


def packages(requirements: list[str]) -> dict[str, str]:
    """Name to version range, without the package itself (an extra that holds other extras names it)."""
    parsed = [Requirement(line) for line in requirements]
    own = canonicalize_name(PROJECT["name"])
    return {name: str(r.specifier) for r in parsed if (name := canonicalize_name(r.name)) != own}


def wanted(name: str = "") -> dict[str, str]:
    """What the environment of one lock holds; of all together the library, every extra and group but dev."""
    extras = {extra: lines for extra, lines in EXTRAS.items() if extra != "course"}
    library = [
        *PROJECT["dependencies"],
        *(line for lines in extras.values() for line in lines),
        *GROUPS["install"],
    ]
    course = [*library, *EXTRAS["course"]]
    test = [*course, *GROUPS["lite"], *GROUPS["test"]]
    lite = [*PROJECT["dependencies"], *EXTRAS["graph"], *GROUPS["install"], *GROUPS["lite"]]
    lines = {"book": GROUPS["book"], "lab": library, "lite": lite, "course": course, "test": test}
    lines |= {"uv": ["uv"], "browser": []}
    return packages(lines[name] if name else [*test, *GROUPS["book"]])


def test_environment_names_the_packages_of_pyproject():
    entries = yaml.safe_load((ROOT / "environment.yml").read_text(encoding="utf-8"))["dependencies"]
    conda = [entry for entry in entries if isinstance(entry, str)]
    (pip,) = [entry["pip"] for entry in entries if isinstance(entry, dict)]
    found = packages([entry for entry in conda + pip if entry not in ("pip", "-e .")])
    assert found.pop("python") == PROJECT["requires-python"]
    assert found == wanted()


@each_lock
def test_lock_pins_every_package_with_hashes_and_names_no_index(name):
    pinned = {canonicalize_name(pin[0]) for pin in PIN.findall(LOCKS[name])}
    heads = re.findall(r"^[^\s#].*$", LOCKS[name], re.M)
    assert len(PIN.findall(LOCKS[name])) == len(heads), "a line is no pinned package with a hash"
    assert wanted(name).keys() <= pinned
    assert not re.search(r"https?:|file:|^-", LOCKS[name], re.M), "the lock names an index or an address"


@each_lock
def test_lock_satisfies_the_ranges_of_pyproject(name):
    pins = {canonicalize_name(pin[0]): pin[1] for pin in PIN.findall(LOCKS[name])}
    ranges = {name: Requirement(f"{name}{spec}").specifier for name, spec in wanted(name).items()}
    assert not {name: pins[name] for name, allowed in ranges.items() if pins[name] not in allowed}


def test_locks_agree_and_the_book_needs_no_library():
    pins: dict[tuple[str, str], set[str]] = {}
    for name, lock in LOCKS.items():
        if name == "browser":  # Pyodide has older ones
            continue
        for package, version, marker in PIN.findall(lock):
            pins.setdefault((package, marker), set()).add(version)
        assert name == "uv" or len(PIN.findall(lock)) > 20
    assert not {package: found for package, found in pins.items() if len(found) > 1}
    assert not {"numpy", "scipy", "numba", "matplotlib"} & {pin[0] for pin in PIN.findall(LOCKS["book"])}


def test_hints_of_the_library_name_packages_that_it_uses():
    """What a message tells the reader to install is a package of an extra, by its own name."""
    known = packages([line for extra in EXTRAS.values() for line in extra])
    hints = []
    for path in (ROOT / "polyskel_lite").rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        hints += re.findall(r"pip install ([\w {}.-]+?)(?=[\"`.\n]|``)", text)
        hints += re.findall(r'\blibrary\("(\w+)"(?:, "[^"]*")?\)', text)  # with an extra, that is the hint
    assert len(hints) > 6
    assert {name for hint in hints for name in hint.split() if name != "{name}"} <= set(known)


def test_contributing_explains_every_dependency():
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (\S+) \| (\w+) \| \S.* \|$", text.split("## Dependencies", 1)[1], re.M)
    groups = {"library": PROJECT["dependencies"], **EXTRAS, **GROUPS}
    needed = [(name, group) for group, lines in groups.items() for name in packages(lines)]
    assert sorted(set(rows) - {("package", "extra")}) == sorted(needed)


def test_version_and_licences_agree():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert str(citation["version"]) == PROJECT["version"]
    assert citation["license"] == PROJECT["license"]
    assert citation["preferred-citation"]["doi"] == "10.1006/cviu.1997.0536"
    assert PROJECT["version"] in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert (ROOT / "LICENSE").exists()
    assert (ROOT / "LICENSE-TEXT").exists()


def test_example_in_the_readme_runs():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```python\n(.*?)```", readme, re.S)
    names = {}
    exec(example, names)
    assert names["skeleton"].betti() == names["shape"].betti()
    assert names["graph"].number_of_nodes() == len(names["skeleton"].vertices)


# Imports every module, refusing what is neither one of the three packages nor needed by them.
IMPORT_ALL = """
import importlib.abc, importlib.metadata, pkgutil, re, sys

def needs(name, seen):
    if name not in seen:
        seen.add(name)
        for line in importlib.metadata.requires(name) or []:
            if "extra ==" not in line:
                try:
                    needs(re.match(r"[A-Za-z0-9._-]+", line)[0].lower(), seen)
                except importlib.metadata.PackageNotFoundError:
                    pass
    return seen

allowed = needs("numpy", set()) | needs("scipy", set()) | needs("matplotlib", set())
tops = importlib.metadata.packages_distributions()
refused = {top for top, names in tops.items() if not allowed & {name.lower() for name in names}}
refused.discard("polyskel_lite")

class Refuse(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in refused:
            raise ImportError("not a hard requirement: " + name)

sys.meta_path.insert(0, Refuse())
sys.path.insert(0, sys.argv[1])
import polyskel_lite
assert polyskel_lite.__file__.startswith(sys.argv[1]), polyskel_lite.__file__
for module in pkgutil.walk_packages(polyskel_lite.__path__, "polyskel_lite."):
    if not module.name.startswith("polyskel_lite.explore") and not module.name.endswith("__main__"):
        __import__(module.name)
import polyskel_lite as psl
shape = psl.datasets.load("horse")
assert psl.sk0(psl.delaunay_shape(psl.conform(shape, to="gabriel"))).betti() == shape.betti()
"""


@pytest.fixture(scope="module")
def archives(tmp_path_factory) -> Path:
    """The folder with the wheel and the source archive, built as a release would be."""
    folder = tmp_path_factory.mktemp("dist")
    command = [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(folder), str(ROOT)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


def test_wheel_holds_the_whole_library_and_its_data(archives):
    (wheel,) = archives.glob("*.whl")
    assert len(list(archives.glob("*.tar.gz"))) == 1
    packed = {name for name in zipfile.ZipFile(wheel).namelist() if name.startswith("polyskel_lite/")}
    tree = {str(path.relative_to(ROOT)) for path in (ROOT / "polyskel_lite").rglob("*") if path.is_file()}
    assert packed == {name for name in tree if "__pycache__" not in name}


def test_wheel_works_without_any_extra(archives, tmp_path):
    (wheel,) = archives.glob("*.whl")
    zipfile.ZipFile(wheel).extractall(tmp_path)
    command = [sys.executable, "-c", IMPORT_ALL, str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
