"""Tables of the whole course for the teacher's pages, read from chapters, assignments and misconceptions.

notebooks/conf.py puts them into ``teaching_map`` when the book is built: they cannot fall behind.
"""

from __future__ import annotations

import json
import re
import runpy
import tomllib
from collections.abc import Iterator
from html import escape
from pathlib import Path

NOTEBOOKS = Path(__file__).resolve().parent.parent / "notebooks"
CHECK = re.compile(r"^:::\{check\} .+\n((?:.*\n)*?):::$", re.M)
BOX = re.compile(r"^(`{3,})\{admonition\} You can now …\n:class: tip\n\n?((?:.*\n)*?)\1$", re.M)
TIED = re.compile(r"\*\*(G[\w.]+)\*\* (.+?): (\{ref\}.*?)\.?", re.S)

# The map: rows of three; each notion with the chapter that it is from.
NOTIONS = (
    (("shape", "2.1"), ("maximal ball", "1"), ("skeleton", "1")),
    (("samples", "2.1"), ("Voronoi graph", "2.2"), ("Sk₁, Sk₂, Sk₃", "3.1–3.3")),
    (("covering radius", "2.1"), ("Delaunay", "2.2"), ("union of balls", "3.2")),
    (("noise", "3.2"), ("Gabriel graph", "2.2"), ("convergence", "3.2")),
    (("polygon", "2.1"), ("containment", "3.4"), ("Sk₀", "3.4")),
    (("refinement", "3.5"), ("hat", "4.2"), ("pieces, holes", "2.1")),
    (None, ("p/r", "4.3"), ("threshold", "4.1")),
)
#: From, to, and the sentence that the arrow stands for.
ARROWS = (
    ("shape", "maximal ball", "A maximal ball lies in the shape, and in no other ball that does."),
    ("maximal ball", "skeleton", "The centres of the maximal balls are the skeleton."),
    ("shape", "samples", "Samples are points on the boundary of the shape."),
    ("samples", "covering radius", "The covering radius says how far the boundary is from its samples."),
    ("samples", "Voronoi graph", "The Voronoi graph separates the places by their nearest sample."),
    ("Voronoi graph", "Delaunay", "The Delaunay tessellation is its dual: who are neighbours."),
    ("Voronoi graph", "Sk₁, Sk₂, Sk₃", "Three methods keep a part of the Voronoi graph: what is inside."),
    ("Sk₁, Sk₂, Sk₃", "skeleton", "They approximate the skeleton."),
    ("Delaunay", "union of balls", "Delaunay balls with their centres inside make a union of balls."),
    ("Sk₁, Sk₂, Sk₃", "union of balls", "Under conditions Sk₂ is the exact skeleton of that union."),
    ("union of balls", "convergence", "With denser samples the union comes closer to the shape."),
    ("covering radius", "noise", "Once it is smaller than the noise, each bump gets a branch."),
    ("Delaunay", "Gabriel graph", "Facets whose smallest ball is empty are Gabriel."),
    ("polygon", "Gabriel graph", "Theorems 1 and 2 ask for it of each side of the polygon."),
    ("polygon", "containment", "Containment: each side of the polygon is a Delaunay facet."),
    ("containment", "Sk₀", "Where it holds, Sk₀ is defined: the dual of the inner simplices."),
    ("Gabriel graph", "Sk₀", "Where the sides are strictly Gabriel, Sk₀ is Sk₂ (Theorem 2)."),
    ("refinement", "polygon", "Refinement puts more samples on the same polygon."),
    ("refinement", "containment", "It ends when all sides are in the graph."),
    ("Sk₀", "pieces, holes", "Sk₀ has as many of them as the polygon."),
    ("containment", "hat", "A hat is an inner triangle with one neighbour."),
    ("hat", "pieces, holes", "To remove a hat changes neither."),
    ("hat", "p/r", "p/r says how much outline a hat stands for, in balls of its size."),
    ("p/r", "threshold", "Hats below the threshold go, the smallest first."),
)


def cells(path: Path) -> str:
    """The Markdown of a notebook."""
    found = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return "\n\n".join("".join(c["source"]) for c in found if c["cell_type"] == "markdown") + "\n"


def chapters() -> list[str]:
    toc = tomllib.loads((NOTEBOOKS.parent / "book.toml").read_text(encoding="utf-8"))["toc"]
    (paper,) = (part for part in toc["parts"] if part["caption"] == "The paper")
    return [chapter["file"] for chapter in paper["chapters"]]


def section(name: str) -> str:
    """What a chapter is called in a table, and in the numbers of its goals: 2.1, 3.2c, A.2, B."""
    return re.search(r"\*\*G([\w.]+)\.\d+\*\*", cells(NOTEBOOKS / f"{name}.ipynb"))[1]


def task_titles() -> dict[str, str]:
    """Every task of the assignments by its number, A2.3."""
    return {
        f"A{path.stem[1]}.{number}": title
        for path in sorted((NOTEBOOKS / "course").glob("a?_*.ipynb"))
        for number, title in re.findall(r"^## (\d+)\. (.+) \(\d+ points?[^()]*\)$", cells(path), re.M)
    }


def checks() -> Iterator[tuple[str, str, int]]:
    """Of each misconception where it is a choice: its id, the chapter, the number of the self-check."""
    choices = runpy.run_path(str(NOTEBOOKS / "check.py"))["choices"]
    for name in chapters():
        for number, body in enumerate(CHECK.findall(cells(NOTEBOOKS / f"{name}.ipynb")), start=1):
            for mark, _, _ in choices(body):
                yield mark, name, number


def misconceptions() -> str:
    """The table: what students take for true, why it is not, and where it shows."""
    known = tomllib.loads((NOTEBOOKS / "misconceptions.toml").read_text(encoding="utf-8"))
    shown: dict[str, dict[str, list[int]]] = {}
    for mark, name, number in checks():
        shown.setdefault(mark, {}).setdefault(name, []).append(number)
    titles = task_titles()
    rows = ["| id | taken for true, and why it is not | self-checks by chapter | task |", "|---|---|---|---|"]
    for mark, one in known.items():
        places = "; ".join(
            f"{{doc}}`{section(name)} <{name}>`: "
            + ", ".join(f'<a href="{name}.html#check-{number}">{number}</a>' for number in numbers)
            for name, numbers in shown.get(mark, {}).items()
        )
        task = f"{one['task']} {titles[one['task']]}"
        rows.append(f"| {mark} | **{one['says']}** {one['refuted']} | {places} | {task} |")
    return "```{table} Misconceptions\n:name: tab-misconceptions\n\n" + "\n".join(rows) + "\n```\n"


def goals() -> str:
    """The table of all goals, from the boxes at the ends of the chapters."""
    rows = ["| goal | exercise, self-checks of the chapter, task |", "|---|---|"]
    for name in chapters():
        for _, listed in BOX.findall(cells(NOTEBOOKS / f"{name}.ipynb")):
            for item in filter(str.strip, re.split(r"^ *- ", listed, flags=re.M)):
                number, words, shown = TIED.fullmatch(" ".join(item.split())).groups()
                words = words.replace("|", "\\|")
                rows.append(f"| **{number}** {words} | {shown} |")
    return "```{table} Goals\n:name: tab-goals\n\n" + "\n".join(rows) + "\n```\n"


def concept_map() -> str:
    """The map as a drawing that takes the letters' colour from the page, and its arrows as sentences."""
    wide, high, across, down = 190, 58, 225, 96
    place = {
        notion[0]: (across * column + wide / 2 + 1, down * row + high / 2 + 1)
        for row, notions in enumerate(NOTIONS)
        for column, notion in enumerate(notions)
        if notion
    }
    line, tip = 'fill="none" stroke="currentColor" stroke-width="1.5"', 'marker-end="url(#map-tip)"'
    drawn = []
    for start, end, _ in ARROWS:
        (x, y), (u, v) = place[start], place[end]
        # Where the line leaves one box and meets the other one.
        part = min(wide / 2 / abs(u - x) if u != x else 1, high / 2 / abs(v - y) if v != y else 1)
        dx, dy = part * (u - x), part * (v - y)
        drawn.append(f'<path d="M{x + dx:.0f} {y + dy:.0f}L{u - dx:.0f} {v - dy:.0f}" {line} {tip}/>')
    for name, number in (notion for notions in NOTIONS for notion in notions if notion):
        x, y = place[name]
        box = f'x="{x - wide / 2:.0f}" y="{y - high / 2:.0f}" width="{wide}" height="{high}" rx="6"'
        drawn.append(
            f'<rect {box} {line}/><text x="{x:.0f}" y="{y - 3:.0f}">{escape(name)}</text>'
            f'<text x="{x:.0f}" y="{y + 20:.0f}" font-size="16">{number}</text>'
        )
    size = f"0 0 {2 * across + wide + 2} {(len(NOTIONS) - 1) * down + high + 2}"
    text = " ".join(sentence for *_, sentence in ARROWS)
    listed = "\n".join(f"- {start} → {end}: {sentence}" for start, end, sentence in ARROWS)
    return f"""```{{raw}} html
<figure id="concept-map"><svg viewBox="{size}" role="img" aria-labelledby="map-title map-desc" width="100%"
font-family="inherit" font-size="20" text-anchor="middle" fill="currentColor">
<title id="map-title">Concept map: twenty notions and what connects them</title>
<desc id="map-desc">{escape(text)}</desc>
<defs><marker id="map-tip" viewBox="0 0 10 10" refX="10" refY="5" markerWidth="9" markerHeight="9"
orient="auto-start-reverse"><path d="M0 0L10 5L0 10z" fill="currentColor"/></marker></defs>
{chr(10).join(drawn)}
</svg>
<figcaption>Twenty notions, each with its section of the paper. An arrow is a sentence of the list
below.</figcaption>
</figure>
```

````{{dropdown}} The arrows as sentences
{listed}
````
"""
