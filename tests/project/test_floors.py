"""Mathematics never loads drawing, drawing never loads widgets, oracles never load the library."""

import ast
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import polyskel_lite as psl

ROOT = Path(__file__).resolve().parents[2]


def loaded_by(statement: str) -> set[str]:
    code = f"{statement}\nimport sys; print('\\n'.join(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return {name.split(".")[0] for name in done.stdout.split()}


def test_mathematics_does_not_load_matplotlib():
    apart = {"drawing", "figures", "explore"}
    names = [m.name for m in pkgutil.iter_modules(psl.__path__) if m.name not in apart]
    assert {"shapes", "graphs", "polyballs", "datasets"} <= set(names)
    loaded = loaded_by("\n".join(f"import polyskel_lite.{name}" for name in names))
    assert "numpy" in loaded
    assert "matplotlib" not in loaded


def test_drawing_does_not_load_widgets():
    loaded = loaded_by("import polyskel_lite.drawing, polyskel_lite.figures")
    assert "matplotlib" in loaded
    assert not loaded & {"ipywidgets", "IPython", "anywidget", "networkx"}


def imported(path: Path) -> set[str]:
    """Every module that a file imports, also inside functions, with relative names made absolute."""
    names = set()
    package = path.relative_to(ROOT).with_suffix("").parts[:-1]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else ()
            start = ".".join([*base, *([node.module] if node.module else [])])
            names |= {start} | {f"{start}.{alias.name}" for alias in node.names}
    return names


def test_oracles_import_nothing_of_the_library():
    made_by_it = {"solids", "cases"}
    for path in (ROOT / "tests" / "truth").glob("*.py"):
        if path.stem not in made_by_it:
            names = {part for name in imported(path) for part in name.split(".")}
            assert not names & {"polyskel_lite", "claims", *made_by_it}, path


def test_no_test_imports_another_one():
    for path in (ROOT / "tests").rglob("test_*.py"):
        assert not [name for name in imported(path) if re.search(r"(^|\.)test_", name)], path
