"""Build a JupyterLite site: chapters and library run in a browser, nothing to install (`make lite`).

    .venv/bin/python tools/build_lite.py [--output _build/lite] [--pyodide FOLDER] [--wheels FOLDER]

The chapters as committed stay untouched. Their copies in the site begin with two cells more: a note, and a
line that fetches the library from the site itself. Python for the browser (Pyodide) comes from the address
that jupyterlite-pyodide-kernel has built in; with --pyodide, from a folder that is copied into the site.
Cells that need what this folder does not have say so, and are left out.
"""

import argparse
import json
import re
import shutil
import subprocess
import symtable
import sys
from pathlib import Path

import nbformat
import working_copies

ROOT = Path(__file__).resolve().parent.parent

NOTE = """\
> **Python in your browser**
>
> This copy of the chapter runs on your own machine, in this page: nothing is installed, nothing is sent
> away. Run the next cell first (Shift+Enter). It fetches the library, and with it NumPy, SciPy and
> Matplotlib: some 65 MB, once, which the browser keeps. Cells take two to ten times as long as on your
> desktop.{missing}"""

# A browser has no numba. What that means is said where a reader would wonder.
SLOW = " The hierarchy of a large solid, compiled there, takes up to a minute here; its numbers are the same."
MISSING = {
    "03_6_complexity": " So do not compare the seconds measured here, but the shapes of the curves.",
}
#: What the library does not need but cells may, as they import it and as Pyodide calls it.
OTHERS = {"skimage": "scikit-image"}
LEFT_OUT = """

from IPython.core.magic import register_cell_magic


@register_cell_magic
def left_out(line, cell):
    print(f"This cell needs {line}, which is not in this site. It was left out; everything else runs.")"""


def requirements(code: str) -> list[str]:
    """What a chapter needs beyond the library's own requirements, for `%pip install`."""
    files = re.search(r"\b(from_file|to_file|bring_your_own|explore\.explore)\b", code)
    widgets = re.search(r"\bexplore\b", code)
    library = "polyskel-lite[graph,files,meshes]" if files else "polyskel-lite[graph]"
    others = [package for module, package in OTHERS.items() if imports(code, module)]
    return [library, *(["ipywidgets", "anywidget"] if widgets else []), *others]


def imports(code: str, module: str) -> bool:
    return bool(re.search(rf"^\s*(?:from|import) {module}\b", code, re.M))


def needing(module: str, cells: list[str]) -> list[int]:
    """Which cells import a module, or use what such a cell makes.

    >>> needing("skimage", ["import skimage", "f = lambda: skimage", "x = 2", "y = f()", "print(x)"])
    [0, 1, 3]
    """
    found, lost = [], set()
    for number, code in enumerate(cells):
        top = symtable.symtable(code, "cell", "exec")
        makes = {name.get_name() for name in top.get_symbols() if name.is_assigned() or name.is_imported()}
        if imports(code, module) or lost & (set(reads(top)) - makes):
            found.append(number)
            lost |= makes
        else:
            lost -= makes
    return found


def reads(scope: symtable.SymbolTable) -> list[str]:
    """The names of the notebook that a cell or a function in it reads."""
    own = [name.get_name() for name in scope.get_symbols() if name.is_global() and name.is_referenced()]
    return own + [name for inner in scope.get_children() for name in reads(inner)]


def browser_copy(notebook: nbformat.NotebookNode, stem: str, absent: set[str]) -> nbformat.NotebookNode:
    """The chapter with the two cells that a browser needs in front; what is absent is not asked for."""
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    code = "\n".join(cell.source for cell in cells)
    missing = MISSING.get(stem, SLOW if "hierarchy(" in code else "")
    install = "%pip install -q " + " ".join(name for name in requirements(code) if name not in absent)
    for module, package in OTHERS.items():
        if not imports(code, module):
            continue
        missing += f" This chapter takes {package} as well."
        if package in absent:
            missing += " It is not in this site, so the cells that need it are left out."
            install += LEFT_OUT
            for number in needing(module, [cell.source for cell in cells]):
                cells[number].source = f"%%left_out {package}\n{cells[number].source}"
    notebook.cells[:0] = [
        nbformat.v4.new_markdown_cell(NOTE.format(missing=missing), id="in-your-browser"),
        nbformat.v4.new_code_cell(install, id="fetch-the-library"),
    ]
    return notebook


def write_files(folder: Path, absent: set[str]) -> None:
    """Lay out the working copies of the chapters and what they read, each at its place in the repository."""
    working_copies.write(folder, ROOT / "_build" / "doctrees")
    (folder / "copies.json").unlink()
    for path in sorted((folder / "notebooks").glob("*.ipynb")):
        notebook = nbformat.read(path, as_version=4)
        notebook.cells = [cell for cell in notebook.cells if cell.id != "install"]
        for cell in notebook.cells:  # no server signs notebooks there, and what is not trusted shows no SVG
            if cell.cell_type == "code":
                cell.metadata["trusted"] = True
        # nbformat would take away who is trusted.
        copy = json.dumps(browser_copy(notebook, path.stem, absent), ensure_ascii=False)
        path.write_text(copy, encoding="utf-8")


def run(*command: str, folder: Path = ROOT) -> None:
    """Run a command of this environment and show what it said only if it failed."""
    done = subprocess.run([sys.executable, "-m", *command], cwd=folder, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"`{' '.join(command[:3])}` failed:\n{done.stdout}{done.stderr}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, default=ROOT / "_build" / "lite", help="where the site goes")
    parser.add_argument("--pyodide", type=Path, help="folder of an unpacked Pyodide to serve with it")
    parser.add_argument("--wheels", type=Path, help="folder of more wheels to serve (py3-none-any)")
    options = parser.parse_args()
    output = options.output.resolve()
    source = output.with_name(
        output.name + "_files"
    )  # with what `jupyter lite` reads: files/, pypi/, static/
    for folder in (source, output):
        shutil.rmtree(folder, ignore_errors=True)
    absent = set()
    if options.pyodide:
        lock = json.loads((options.pyodide / "pyodide-lock.json").read_text(encoding="utf-8"))
        absent = set(OTHERS.values()) - set(lock["packages"])
    write_files(source / "files", absent)
    run("build", "--wheel", "--no-isolation", "--outdir", str(source / "pypi"), ".")
    for wheel in sorted(options.wheels.glob("*-none-any.whl")) if options.wheels else []:
        shutil.copy(wheel, source / "pypi")
    if options.pyodide:
        (source / "static").mkdir()
        (source / "static" / "pyodide").symlink_to(options.pyodide.resolve(), target_is_directory=True)
    lean = ["--apps", "lab", "--no-sourcemaps", "--no-unused-shared-packages"]
    run("jupyterlite_core", "build", "--output-dir", str(output), *lean, folder=source)
    return 0


if __name__ == "__main__":
    sys.exit(main())
