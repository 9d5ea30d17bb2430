"""The contents page: a card for each page of the book, with its first picture and its question.

notebooks/conf.py reads it when the book is built. The small pictures are made by tools/thumbnails.py.
"""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NOTEBOOKS = ROOT / "notebooks"
THUMBNAILS = NOTEBOOKS / "_static" / "thumbnails"


def opening(name: str) -> str:
    """The first sentence of a page that asks something, else its first paragraph, in Markdown."""
    notebook = NOTEBOOKS / f"{name}.ipynb"
    if notebook.exists():
        cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
        text = "\n\n".join("".join(cell["source"]) for cell in cells[:3] if cell["cell_type"] == "markdown")
    else:
        text = (NOTEBOOKS / f"{name}.md").read_text(encoding="utf-8")
    paragraphs = [p for p in re.split(r"\n{2,}", text) if not re.match(r"[#(:`{]", p)]
    said = re.sub(r"^\*\*The question\.\*\* *", "", re.sub(r"\s+", " ", paragraphs[0]))
    asked = re.match(r"[^?]*\?", said)
    return asked[0] if asked else re.match(r".*?\.(?= |$)|.*", said)[0]


def contents() -> str:
    """The cards of all pages, part by part, in Markdown."""
    toc = tomllib.loads((ROOT / "book.toml").read_text(encoding="utf-8"))["toc"]
    lines = []
    for part in toc["parts"][1:]:  # the first one is this page
        lines += [f"## {part['caption']}", "", "::::{grid} 1 2 2 3", ":gutter: 3", ""]
        for name in (chapter["file"] for chapter in part["chapters"]):
            if name.startswith("api_"):  # one card leads to all of them
                continue
            picture = THUMBNAILS / f"{name.replace('/', '-')}.png"
            lines += [f":::{{grid-item-card}} {{doc}}`{name}`"]
            if picture.exists():
                lines += [
                    f":img-top: _static/thumbnails/{picture.name}",
                    ":img-alt: The first picture of the page",
                ]
            lines += ["", opening(name), ":::", ""]
        lines += ["::::", ""]
    return "\n".join(lines)
