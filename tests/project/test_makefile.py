"""`make book` builds what has changed, and nothing where nothing has."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
# In place of Python: it notes its arguments, and makes the folder that Sphinx would make.
RECORDER = """#!/bin/sh
echo "$@" >> calls.txt
mkdir -p _build/html
test ! -e broken
"""


@pytest.mark.skipif(shutil.which("make") is None, reason="make is not here")
def test_the_book_is_built_again_only_after_a_change(tmp_path):
    folder = tmp_path / "a folder"
    for name in ("notebooks", "polyskel_lite/__pycache__", "tools", "tests", "benchmarks", "requirements"):
        (folder / name).mkdir(parents=True)
    for name in ("book.toml", "requirements/book.lock", "notebooks/one.ipynb"):
        (folder / name).touch()
    shutil.copyfile(ROOT / "Makefile", folder / "Makefile")
    python = folder / ".venv" / "bin" / "python"
    python.parent.mkdir(parents=True)
    python.write_text(RECORDER, encoding="utf-8")
    python.chmod(0o755)
    (folder / ".venv" / ".book").touch()

    def builds() -> int:
        """How often Sphinx has been asked after one more `make book`."""
        done = subprocess.run(["make", "book"], cwd=folder, capture_output=True, text=True)
        assert (done.returncode == 0) == (not (folder / "broken").exists()), done.stdout + done.stderr
        return (folder / "calls.txt").read_text(encoding="utf-8").count("-m sphinx")

    assert [builds(), builds()] == [1, 1]
    (folder / "polyskel_lite" / "__pycache__" / "one.pyc").touch()
    assert builds() == 1
    (folder / "notebooks" / "one.ipynb").write_text("changed", encoding="utf-8")
    (folder / "broken").touch()
    assert [builds(), builds()] == [2, 3]  # a build that failed is none
    (folder / "broken").unlink()
    assert [builds(), builds()] == [4, 4]
    (folder / "notebooks" / "one.ipynb").unlink()
    assert [builds(), builds()] == [5, 5]
    shutil.rmtree(folder / "_build" / "html")
    assert builds() == 6
