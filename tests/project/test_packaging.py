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
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
EXTRAS = PROJECT["optional-dependencies"]
LOCK = (ROOT / "requirements.lock").read_text(encoding="utf-8")


def packages(requirements: list[str]) -> dict[str, str]:
    """Name to version range, without the package itself (an extra that holds other extras names it)."""
    parsed = [Requirement(line) for line in requirements]
    own = canonicalize_name(PROJECT["name"])
    return {name: str(r.specifier) for r in parsed if (name := canonicalize_name(r.name)) != own}


def wanted() -> dict[str, str]:
    """What the environment of the project holds: the library and every extra but the maintainers' own."""
    lines = PROJECT["dependencies"] + [
        line for name, extra in EXTRAS.items() if name != "dev" for line in extra
    ]
    return packages(lines)


def test_environment_names_the_packages_of_pyproject():
    entries = yaml.safe_load((ROOT / "environment.yml").read_text(encoding="utf-8"))["dependencies"]
    conda = [entry for entry in entries if isinstance(entry, str)]
    (pip,) = [entry["pip"] for entry in entries if isinstance(entry, dict)]
    found = packages([entry for entry in conda + pip if entry not in ("pip", "-e .")])
    assert found.pop("python") == PROJECT["requires-python"]
    assert found == wanted()


def test_lock_pins_every_package_with_hashes_and_names_no_index():
    pinned = re.findall(
        r"^([A-Za-z0-9._-]+)==\S+(?: ;[^\\\n]*)? \\\n    --hash=sha256:[0-9a-f]{64}", LOCK, re.M
    )
    heads = re.findall(r"^[^\s#].*$", LOCK, re.M)
    assert len(pinned) == len(heads), "a line of requirements.lock is no pinned package with a hash"
    assert wanted().keys() <= {canonicalize_name(name) for name in pinned}
    assert not re.search(r"https?:|file:|^-", LOCK, re.M), "requirements.lock names an index or an address"


def test_lock_satisfies_the_ranges_of_pyproject():
    pins = {canonicalize_name(n): v for n, v in re.findall(r"^([A-Za-z0-9._-]+)==([^\s;]+)", LOCK, re.M)}
    ranges = {name: Requirement(f"{name}{spec}").specifier for name, spec in wanted().items()}
    assert not {name: pins[name] for name, allowed in ranges.items() if pins[name] not in allowed}


def test_contributing_explains_every_dependency():
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (\S+) \| (\w+) \| \S.* \|$", text.split("## Dependencies", 1)[1], re.M)
    groups = {"library": PROJECT["dependencies"], **EXTRAS}
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
