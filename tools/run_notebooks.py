"""Run chapters from top to bottom in a fresh kernel and store the outputs (`make run`).

    .venv/bin/python tools/run_notebooks.py [02_1_shapes ...]

Stored files differ only where an output differs: no run times, no kernel details, and cells have fixed ids.
"""

import argparse
import sys
import time
from pathlib import Path

import nbformat
from nbclient import NotebookClient

NOTEBOOKS = Path(__file__).resolve().parent.parent / "notebooks"
LIVE = "application/vnd.jupyter.widget-view+json"  # points into a kernel that is gone
KERNEL = {"display_name": "Python 3", "language": "python", "name": "python3"}


def clean(notebook: nbformat.NotebookNode, stem: str) -> nbformat.NotebookNode:
    """Keep what the chapter says; drop what only tells which machine ran it, and when, and live widgets."""
    notebook.metadata = nbformat.from_dict({"kernelspec": KERNEL, "language_info": {"name": "python"}})
    for number, cell in enumerate(notebook.cells):
        cell["id"] = f"{stem.replace('_', '-')}-{number:03d}"
        cell.metadata.pop("execution", None)
        for output in cell.get("outputs", []):
            if len(output.get("data", {})) > 1:  # what stands beside it is shown instead
                output["data"].pop(LIVE, None)
    return notebook


def run(path: Path, timeout: int = 600) -> None:
    """Execute one notebook in its own folder and write it back."""
    notebook = nbformat.read(path, as_version=4)
    client = NotebookClient(
        notebook,
        timeout=timeout,
        kernel_name="python3",
        record_timing=False,
        coalesce_streams=True,
        resources={"metadata": {"path": str(path.parent)}},
    )
    client.execute()
    nbformat.write(clean(notebook, path.stem), path)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", help="chapters without .ipynb; all when none is named")
    parser.add_argument("--timeout", type=int, default=600, help="seconds that one cell may take")
    options = parser.parse_args()
    pages = sorted(NOTEBOOKS.glob("*.ipynb"))
    stems = {Path(name).stem for name in options.names}
    if unknown := stems - {path.stem for path in pages}:
        parser.error(f"no chapters of these names: {', '.join(sorted(unknown))}")
    for path in pages:
        if stems and path.stem not in stems:
            continue
        start = time.perf_counter()
        print(f"{path.name} ... ", end="", flush=True)
        run(path, options.timeout)
        print(f"{time.perf_counter() - start:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
