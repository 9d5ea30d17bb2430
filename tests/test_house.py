"""The rules of the house: who may import whom, what a room shows, how long a module is."""

import ast
import json
import re
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
HOUSE = runpy.run_path(str(ROOT / "tools" / "house.py"))
SOURCES = HOUSE["sources"]()

BELOW_DRAWING = {
    "exact",
    "files",
    "graphs",
    "shapes",
    "containment",
    "skeletons",
    "simplification",
    "polyballs",
}
BELOW_DRAWING |= {"datasets", "implicit"}
FOR_ALL = {"errors", "checks", "progress", "compiling", "tables"}
MAY_IMPORT = {
    "": BELOW_DRAWING | {"pipeline"},
    "pipeline": BELOW_DRAWING,
    "errors": set(),
    "checks": set(),
    "progress": set(),
    "compiling": set(),
    "tables": set(),
    "exact": set(),
    "files": set(),
    "graphs": {"exact"},
    "shapes": {"exact", "files", "graphs"},
    "containment": {"exact", "shapes", "graphs"},
    "skeletons": {"exact", "files", "shapes", "graphs", "containment"},
    "simplification": {"graphs", "shapes", "containment", "skeletons"},
    "polyballs": {"exact", "shapes", "graphs", "skeletons"},
    "datasets": {"shapes"},
    "implicit": {"exact", "shapes", "graphs", "containment"},
    "drawing": {"exact", "graphs", "skeletons", "polyballs"},
    "figures": BELOW_DRAWING | {"drawing"},
    "explore": BELOW_DRAWING | {"drawing", "pipeline"},
    "cli": BELOW_DRAWING | {"drawing", "pipeline", "figures", "explore"},
    "coursework": {""},
}
# Where matplotlib and widgets may be imported; everything else of the library is mathematics.
OUTSIDE = {
    "matplotlib": {"drawing", "figures", "explore"},
    "ipywidgets": {"explore"},
    "anywidget": {"explore"},
    "traitlets": {"explore"},
}


def broken_rules(texts):
    """One sentence for each import that a rule forbids."""
    for a, b in sorted(HOUSE["arrows"](texts)):
        if b not in MAY_IMPORT[a] | FOR_ALL or a == "errors":
            yield f"{a or 'the front door'} may not import {b}"
    if circle := HOUSE["circle"](texts):
        yield f"in a circle: {', '.join(circle)}"
    for i in HOUSE["imports"](texts):
        inner = HOUSE["room"](i.module) == HOUSE["room"](i.target)
        if (
            not inner
            and not i.face
            and i.target not in FOR_ALL | {"datasets", "implicit", "pipeline", "figures.__main__"}
        ):
            yield f"{i.module} imports {i.name} from {i.target} and not from the face of the room"
        if i.name.startswith("_"):
            yield f"{i.module} imports {i.name}, which is of {i.target} alone"


def test_imports_follow_the_table():
    assert list(broken_rules(SOURCES)) == []
    assert set(map(HOUSE["room"], SOURCES)) == set(MAY_IMPORT)


@pytest.mark.parametrize(
    ("module", "line", "rule"),
    [
        ("graphs.tessellation", "from ..shapes import Shape", "graphs may not import shapes"),
        (
            "skeletons.skeleton",
            "def f():\n    from ..polyballs import Polyball",
            "skeletons may not import polyballs",
        ),
        ("exact.boxes", "from polyskel_lite import drawing", "exact may not import drawing"),
        ("errors", "from .checks import near", "errors may not import checks"),
        ("exact.arrays", "from .polygons import Polygons", "in a circle: exact.arrays, exact.polygons"),
        ("shapes.rings", "from ..exact.topology import components", "not from the face of the room"),
        ("shapes.rings", "from .sampling import _halved", "which is of shapes.sampling alone"),
    ],
)
def test_one_arrow_more_is_seen(module, line, rule):
    assert any(
        rule in sentence for sentence in broken_rules(SOURCES | {module: f"{SOURCES[module]}\n{line}\n"})
    )


@pytest.mark.parametrize("name", OUTSIDE)
def test_drawing_and_widgets_stay_upstairs(name):
    pattern = re.compile(rf"^\s*(from|import) {name}\b", re.MULTILINE)
    assert {HOUSE["room"](module) for module, text in SOURCES.items() if pattern.search(text)} <= OUTSIDE[
        name
    ]


@pytest.mark.parametrize("module", SOURCES)
def test_a_module_is_one_notion(module):
    assert SOURCES[module].count("\n") <= 400
    assert not any(part.startswith("_") for part in module.split(".") if part != "__main__")
    tree = ast.parse(SOURCES[module])
    assert ast.get_docstring(tree)
    own = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    assert module.rpartition(".")[2] not in own, "a module has not the name of a function it exports"


@pytest.mark.parametrize("room", HOUSE["ROOMS"])
def test_a_room_is_small_and_has_a_face(room):
    below = {
        module.removeprefix(f"{room}.").split(".")[0] for module in SOURCES if module.startswith(f"{room}.")
    }
    assert len(below) <= 14
    assert "\n\n" in ast.get_docstring(ast.parse(SOURCES[room])), "what the room is for, then what is in it"


@pytest.mark.parametrize("chapter", sorted((ROOT / "notebooks").glob("*.ipynb")), ids=lambda path: path.stem)
def test_chapters_import_from_the_front_door_or_a_face(chapter):
    cells = json.loads(chapter.read_text(encoding="utf-8"))["cells"]
    code = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
    inner = [name for name in SOURCES if "." in name and not name.startswith("explore.skeleton_viewer.")]
    assert set(re.findall(r"polyskel_lite\.([\w.]+) import", code)) <= set(HOUSE["ROOMS"])
    assert not [name for name in inner if re.search(rf"\b{re.escape(name)}\.", code)]
