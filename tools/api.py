"""The reference: a page for each room, with all that the room shows, read from the code without running it.

`notebooks/conf.py` runs this file by its path. Docstrings become reStructuredText by Sphinx's own napoleon.
"""

from __future__ import annotations

import ast
import json
import re
from pathlib import Path
from textwrap import indent

from sphinx.ext.napoleon import Config, NumpyDocstring

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "polyskel_lite"
#: The rooms that a reader uses, in the order of the paper.
ROOMS = (
    "shapes",
    "graphs",
    "containment",
    "skeletons",
    "simplification",
    "polyballs",
    "implicit",
    "datasets",
    "drawing",
    "explore",
    "exact",
)


SETTINGS = Config(napoleon_use_ivar=True, napoleon_use_rtype=False)


def shown(face: Path) -> list[tuple[str, str]]:
    """The public names of a face, each with the module it comes from."""
    tree = ast.parse(face.read_text(encoding="utf-8"))
    found = [
        (alias.name, node.module)
        for node in tree.body
        if isinstance(node, ast.ImportFrom) and node.level == 1 and node.module
        for alias in node.names
    ]
    found += [(n.name, "") for n in tree.body if isinstance(n, ast.FunctionDef | ast.ClassDef)]
    return sorted((name, module) for name, module in found if not name.startswith("_"))


def definition(name: str, file: Path) -> tuple[ast.AST | None, Path]:
    """The function or class of that name, followed from a module to where it is made, and that file."""
    file = file if file.exists() else file.with_suffix("") / "__init__.py"
    tree = ast.parse(file.read_text(encoding="utf-8"))
    for node in tree.body:
        if getattr(node, "name", None) == name:
            return node, file
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level and name in [a.name for a in node.names]:
            folder = file.parents[node.level - 1]
            return definition(name, folder / f"{(node.module or '__init__').replace('.', '/')}.py")
    return None, file


def home(room: str, module: str) -> Path:
    """The file in which a face finds a name."""
    folder = PACKAGE / room
    return folder / f"{module.replace('.', '/')}.py" if module else folder / "__init__.py"


def call(node: ast.FunctionDef) -> str:
    """How a function is called, without ``self``, and what it returns."""
    arguments = re.sub(r"^(self|cls)(, )?", "", ast.unparse(node.args))
    return f"({arguments})" + (f" -> {ast.unparse(node.returns)}" if node.returns else "")


def described(kind: str, name: str, node: ast.AST, called: str, inside: str = "") -> str:
    """A directive of Sphinx's domain for Python: how it is called, and its docstring."""
    docstring = str(NumpyDocstring(ast.get_docstring(node) or "", SETTINGS))
    head = f".. py:{kind}:: {name}{called}\n"
    return f"{head}\n{indent(docstring, '   ')}\n{indent(inside, '   ')}\n"


def members(node: ast.ClassDef, file: Path) -> dict[str, ast.FunctionDef]:
    """The public methods of a class and of the project's classes below it, in order."""
    found = {}
    for base in node.bases:
        below, there = definition(base.id, file) if isinstance(base, ast.Name) else (None, file)
        if isinstance(below, ast.ClassDef):
            found |= members(below, there)
    for inner in node.body:
        if isinstance(inner, ast.FunctionDef) and not inner.name.startswith("_") and ast.get_docstring(inner):
            found[inner.name] = inner
    return found


def entry(name: str, room: str, file: Path) -> str:
    """The directive that documents one name of a room; nothing for a constant."""
    node, file = definition(name, file)
    if isinstance(node, ast.FunctionDef):
        return described("function", f"polyskel_lite.{room}.{name}", node, call(node))
    if not isinstance(node, ast.ClassDef):
        return ""
    inside = ""
    for method in members(node, file).values():
        marks = {mark.id for mark in method.decorator_list if isinstance(mark, ast.Name)}
        if marks & {"property", "cached_property"}:
            inside += described("property", method.name, method, "")
        else:
            option = "\n   :classmethod:" if "classmethod" in marks else ""
            inside += described("method", method.name, method, call(method) + option)
    made = [call(inner) for inner in node.body if getattr(inner, "name", "") == "__init__"]
    called = made[0].removesuffix(" -> None") if made else ""
    return described("class", f"polyskel_lite.{room}.{name}", node, called, inside)


def chapters(room: str) -> list[str]:
    """The chapters whose card names a module of a room."""
    found = []
    for path in sorted((ROOT / "notebooks").glob("*.ipynb")):
        text = "".join("".join(c["source"]) for c in json.loads(path.read_text(encoding="utf-8"))["cells"])
        card = re.search(r"^- \*\*Code:\*\*.*?(?=^- |^```)", text, re.M | re.S)
        if card and f"(../polyskel_lite/{room}/" in card[0]:
            found.append(path.stem)
    return found


def public(room: str) -> list[tuple[str, str]]:
    """The names of a room that stay: those of the front door, and those that CONTRIBUTING.md lists."""
    face = shown(PACKAGE / room / "__init__.py")
    if room in ("drawing", "implicit", "datasets"):
        return face
    if room == "explore":
        explorers = [(name, "explorers") for name, _ in shown(PACKAGE / room / "explorers" / "__init__.py")]
        return sorted([*explorers, ("SkeletonViewer", "skeleton_viewer"), ("viewer", "skeleton_viewer")])
    names = {name for name, module in shown(PACKAGE / "__init__.py") if module == room}
    table = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    if listed := re.search(rf"^\| `polyskel_lite\.{room}` \| ([^|]*) \|", table, re.M):
        names |= set(re.findall(r"`(\w+)`", listed[1]))
    return [(name, module) for name, module in face if name in names]


def page(room: str) -> str:
    """The page of one room, in MyST."""
    face = PACKAGE / room / "__init__.py"
    about = ast.get_docstring(ast.parse(face.read_text(encoding="utf-8"))).split("\nExamples\n")[0]
    lines = [f"What stands in `polyskel_lite.{room}`.", "", about, ""]
    if used := chapters(room):
        lines += ["**In the chapters:** " + ", ".join(f"{{doc}}`{name}`" for name in used) + ".", ""]
    entries = [entry(name, room, home(room, module)) for name, module in public(room)]
    lines += ["```{eval-rst}", *filter(None, entries), "```"]
    return "\n".join(lines)


def beside(module: str) -> str:
    """All classes and functions of a module that stands beside the rooms, in MyST."""
    names = [name for name, home in shown(PACKAGE / "__init__.py") if home == module]
    return "\n".join(
        ["```{eval-rst}", *(entry(name, module, PACKAGE / f"{module}.py") for name in names), "```"]
    )


def front() -> str:
    """All names of the front door with the first line of each docstring, in MyST."""
    lines = ["| name | what it is |", "|---|---|"]
    for name, module in shown(PACKAGE / "__init__.py"):
        node, _ = definition(name, home(".", module))
        if node is not None and module not in ("errors",):
            said = ast.get_docstring(node).split("\n\n")[0].replace("\n", " ")
            kind = "class" if isinstance(node, ast.ClassDef) else "func"
            place = f"polyskel_lite.{module}.{name}"
            lines.append(f"| {{py:{kind}}}`psl.{name} <{place}>` | {said} |")
    return "\n".join(lines)


def reference_line(chapter: str) -> str:
    """The line of a chapter's card that links to the pages of the rooms its code is in."""
    used = [room for room in ROOMS if chapter in chapters(room)]
    links = ", ".join(f"{{doc}}`{room} <api_{room}>`" for room in used)
    return f"- **Reference:** {links}" if used else ""
