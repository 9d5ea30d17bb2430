"""The rooms of the library and the arrows between them, read from its imports; drawn for the book.

Standard library only: `notebooks/conf.py` runs this file by its path, so that the page "The house" is made
from the code at every build and cannot go stale; `tests/test_house.py` holds the arrows against the rules.
"""

import ast
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from html import escape
from pathlib import Path
from typing import NamedTuple

PACKAGE = Path(__file__).resolve().parent.parent / "polyskel_lite"
#: From the ground up: the section of the paper, and where the room stands in the picture, from left to right.
ROOMS = {
    "exact": ("", 1.0),
    "files": ("", 2.4),
    "graphs": ("2.2", 0.5),
    "shapes": ("2.1", 1.9),
    "containment": ("3.4, 3.5", 1.2),
    "skeletons": ("3", 1.0),
    "simplification": ("4", 1.5),
    "polyballs": ("A", 0.4),
    "datasets": ("", 3.0),
    "implicit": ("", 2.1),
    "drawing": ("", 0.4),
    "figures": ("", 1.3),
    "explore": ("", 2.4),
}


class Import(NamedTuple):
    """One imported name: by which module, from which one, and whether that is the face of a room."""

    module: str
    target: str
    name: str
    face: bool


def sources(folder: Path = PACKAGE) -> dict[str, str]:
    """The text of every module, by its dotted name below the package; a face has the name of its room."""
    names = {path: ".".join(path.relative_to(folder).with_suffix("").parts) for path in folder.rglob("*.py")}
    return {
        name.removesuffix("__init__").rstrip("."): path.read_text("utf-8") for path, name in names.items()
    }


def imports(texts: dict[str, str]) -> Iterator[Import]:
    """All imports of the package's own names, lazy ones too; a name from a face is followed to its module."""
    faces = {"", *ROOMS} | {name for name in texts if any(other.startswith(f"{name}.") for other in texts)}
    trees = {name: ast.parse(text) for name, text in texts.items()}

    def found(module: str) -> Iterator[tuple[str, str]]:
        package = module if module in faces else module.rpartition(".")[0]
        for node in ast.walk(trees[module]):
            if isinstance(node, ast.ImportFrom) and node.level:
                parts = package.split(".") if package else []
                parts = parts[: len(parts) - node.level + 1] + (node.module or "").split(".")
                base = ".".join(filter(None, parts))
                yield from ((base, alias.name) for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and f"{node.module}.".startswith("polyskel_lite."):
                yield from ((node.module[14:], alias.name) for alias in node.names)

    def home(base: str, name: str) -> str:
        if (inner := f"{base}.{name}".lstrip(".")) in texts:
            return inner
        return next((home(b, n) for b, n in found(base) if n == name), base) if base in faces else base

    for module in sorted(texts):
        for base, name in found(module):
            yield Import(module, home(base, name), name, base in faces and f"{base}.{name}" not in texts)


def room(module: str) -> str:
    """The room of a module, or the module itself where it stands beside the rooms."""
    return module.split(".")[0]


def arrows(texts: dict[str, str]) -> set[tuple[str, str]]:
    """Pairs of different rooms, the first one importing from the second one."""
    pairs = {(room(i.module), room(i.target)) for i in imports(texts)}
    return {(a, b) for a, b in pairs if a != b}


def circle(texts: dict[str, str]) -> list[str]:
    """Modules that import each other in a circle, or none."""
    after: dict[str, set[str]] = {name: set() for name in texts}
    for i in imports(texts):
        if i.module != i.target:
            after[i.module].add(i.target)
    try:
        TopologicalSorter(after).prepare()
    except CycleError as error:
        return sorted(set(error.args[1]))
    return []


def facts(texts: dict[str, str]) -> Iterator[tuple[str, list[str], int, list[str]]]:
    """For each room its name, its modules, their lines, and the rooms from which it imports."""
    there = arrows(texts)
    for name in ROOMS:
        modules = sorted(module for module in texts if module.startswith(f"{name}."))
        lines = sum(texts[module].count("\n") for module in [name, *modules])
        yield name, modules, lines, [other for other in ROOMS if (name, other) in there]


def table(texts: dict[str, str]) -> str:
    """The rooms as a table in Markdown."""
    rows = ["| room | section | what is in it | lines | imports from |", "|---|---|---|---|---|"]
    for name, _, lines, below in facts(texts):
        what = ast.get_docstring(ast.parse(texts[name])).splitlines()[0].rstrip(".:")
        rows.append(f"| `{name}` | {ROOMS[name][0]} | {what} | {lines:,} | {', '.join(below) or 'nothing'} |")
    return "\n".join(rows)


def picture(texts: dict[str, str]) -> str:
    """The rooms on their floors as SVG, each with the arrows that no longer way implies."""
    below = {name: set(rooms) for name, _, _, rooms in facts(texts)}
    floor: dict[str, int] = {}
    for name in ROOMS:
        floor[name] = max((floor[other] + 1 for other in below[name]), default=0)
    reach: dict[str, set[str]] = {}
    for name in ROOMS:
        reach[name] = below[name].union(*(reach[other] for other in below[name]))
    width, height, step = 150, 52, 90
    top = max(floor.values())
    place = {
        name: (40 + 190 * column, (top - floor[name]) * step + 32) for name, (_, column) in ROOMS.items()
    }
    said = "; ".join(f"{name} from {', '.join(sorted(rooms)) or 'nothing'}" for name, rooms in below.items())
    tall = step * top + 62
    out = [
        f'<svg viewBox="0 0 720 {tall}" role="img" style="max-width:720px;width:100%"',
        f' aria-label="{escape(f"Rooms of the library on their floors. Imports: {said}.")}" fill="none"',
        ' stroke="currentColor" font-size="18">',
    ]
    for name, others in below.items():
        for other in sorted(others - set().union(*(reach[o] for o in others))):
            (x, y), (u, v) = place[name], place[other]
            out.append(f'<path d="M{x},{y + height / 2} L{u},{v - height / 2 - 6}" opacity="0.6"/>')
            out.append(f'<path d="M{u - 4},{v - height / 2 - 8} l4,8 l4,-8" opacity="0.6"/>')
    for name, (x, y) in place.items():
        left, upper = x - width / 2, y - height / 2
        out.append(f'<rect x="{left}" y="{upper}" width="{width}" height="{height}" rx="5"/>')
        text = 'stroke="none" fill="currentColor" text-anchor="middle"'
        section = ROOMS[name][0]
        number = section and ("appendix A" if section == "A" else f"section {section}")
        out.append(f'<text x="{x}" y="{y + (-3 if number else 6)}" {text}>{name}</text>')
        out.append(f'<text x="{x}" y="{y + 17}" {text} font-size="14">{number}</text>' if number else "")
    return "".join([*out, "</svg>"])


if __name__ == "__main__":
    print(table(sources()))
