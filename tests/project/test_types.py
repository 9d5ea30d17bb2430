"""The types of the public surface: annotated, marked as such, and what a type checker makes of them."""

import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import polyskel_lite as psl

ROOT = Path(__file__).resolve().parents[2]
PUBLIC = {
    name: thing
    for module in (psl, psl.datasets, psl.implicit)
    for name, thing in vars(module).items()
    if not name.startswith("_") and callable(thing) and name in getattr(module, "__all__", dir(module))
}
#: What a user writes, and what it is.
REVEALED = {
    'psl.skeleton("a.svg")': "polyskel_lite.pipeline.Bones",
    "psl.sk0(P)": "polyskel_lite.skeletons.skeleton.Skeleton",
    "psl.sk0(P).main_axis()": "polyskel_lite.skeletons.axes.Axis",
    "psl.sk0(P).branch_table()": "polyskel_lite.skeletons.branch_tables.Branches",
    "psl.hierarchy(P).skeleton(3)": "polyskel_lite.skeletons.skeleton.Skeleton",
    "psl.delaunay([(0, 0), (1, 0), (0, 1)])": "polyskel_lite.graphs.tessellation.Tessellation",
    "psl.Shape([(0, 0), (1, 0), (0, 1)], [(0, 1), (1, 2), (2, 0)])": "polyskel_lite.shapes.shape.Shape",
    "psl.Shape.from_shapely(None)": "polyskel_lite.shapes.shape.Shape",
    "psl.Polyball([(0, 0)], [1]).skeleton()": "polyskel_lite.skeletons.skeleton.Skeleton",
    "P.betti()": "tuple[int, ...]",
    "P.to_shape().area()": "float",
}


def functions():
    for name, thing in PUBLIC.items():
        if inspect.isfunction(thing):
            yield name, thing
        elif inspect.isclass(thing):
            for method, member in inspect.getmembers(thing):
                inner = getattr(member, "__func__", member)
                own = inspect.isfunction(inner) and inner.__module__.startswith("polyskel_lite")
                if own and not method.startswith("_"):
                    yield f"{name}.{method}", inner


@pytest.mark.parametrize(("name", "function"), list(functions()), ids=[name for name, _ in functions()])
def test_everything_public_is_annotated(name, function):
    signature = inspect.signature(function)
    given = [p for p in signature.parameters.values() if p.name not in ("self", "cls")]
    assert [p.name for p in given if p.annotation is p.empty] == []
    assert signature.return_annotation is not signature.empty


def test_a_type_checker_knows_what_comes_out(tmp_path):
    assert (ROOT / "polyskel_lite" / "py.typed").exists()
    lines = ["import polyskel_lite as psl", "P: psl.DelaunayShape", *(f"reveal_type({x})" for x in REVEALED)]
    (tmp_path / "user.py").write_text("\n".join(lines) + "\n")
    command = [
        sys.executable,
        "-m",
        "mypy",
        "--config-file",
        str(ROOT / "pyproject.toml"),
        "--cache-dir",
        str(tmp_path),
    ]
    done = subprocess.run(
        [*command, str(tmp_path / "user.py")], capture_output=True, text=True, cwd=ROOT, timeout=300
    )
    said = [line.split('"')[1] for line in done.stdout.splitlines() if "Revealed type" in line]
    assert dict(zip(REVEALED, said, strict=True)) == REVEALED, done.stdout + done.stderr
