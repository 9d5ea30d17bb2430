"""What a measurement ran on: versions, processor, commit and date of every file of numbers."""

from __future__ import annotations

import json
import os
import platform
import subprocess
import time
from importlib.metadata import version
from pathlib import Path

PACKAGES = ("numpy", "scipy", "numba")


def commit(folder: Path) -> str:
    """The commit of a checkout, with "-dirty" if files differ from it."""
    command = ["git", "describe", "--always", "--dirty", "--exclude", "*"]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    except OSError:
        return "unknown"
    return done.stdout.strip() or "unknown"


def machine() -> dict:
    """Versions and processor."""
    model = ""
    if Path("/proc/cpuinfo").exists():
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        model = next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), "")
    packages = {name: version(name) for name in PACKAGES if _installed(name)}
    return {"python": platform.python_version(), **packages, "cores": os.cpu_count(), "processor": model}


def _installed(name: str) -> bool:
    try:
        return bool(version(name))
    except ImportError:
        return False


def note(folder: Path, name: str, of: str | None = None) -> None:
    """Put into machine.json on what, at which commit and on which day a file was measured."""
    path = folder / "machine.json"
    known = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    measured = known.get("measured", {})
    measured[name] = {"commit": of or commit(Path(__file__).parent), "date": time.strftime("%Y-%m-%d")}
    path.write_text(json.dumps(machine() | {"measured": measured}, indent=1) + "\n", encoding="utf-8")
