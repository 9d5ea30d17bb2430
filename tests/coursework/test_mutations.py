"""Every check can fail: on answers of nothing, of wrong types and shapes, on one operator changed."""

import ast
import copy
import re
from collections.abc import Iterator

import course
import pytest
from marking import marked
from truth.submissions import SOURCES, TOLD

OTHER = {
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.And: ast.Or,
    ast.Or: ast.And, ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Add, ast.Div: ast.Mult,
    ast.FloorDiv: ast.Add, ast.Mod: ast.Add, ast.Pow: ast.Mult, ast.BitAnd: ast.BitOr, ast.BitOr: ast.BitAnd,
    ast.BitXor: ast.BitOr, ast.USub: ast.UAdd,
}  # fmt: skip
NOTHINGS = ["None", "'seven'", "__import__('numpy').zeros((3, 7))"]
ANSWERS = [
    (name, course.grade_id(cell))
    for name, source in SOURCES.items()
    for cell in source.cells
    if cell.cell_type == "code" and course.is_answer(cell)
]
each_answer = pytest.mark.parametrize(("name", "answer"), ANSWERS, ids=[answer for _, answer in ANSWERS])


def cell_and_checks(name: str, answer: str) -> tuple:
    """The cell of an answer and its own checks."""
    cells = {course.grade_id(cell): cell for cell in SOURCES[name].cells}
    others = [other for _, other in ANSWERS if other != answer and other.startswith(answer)]
    mine = [c for key, c in cells.items() if key.startswith(f"{answer}-") and course.is_check(c)]
    return cells[answer], [
        c for c in mine if not course.grade_id(c).startswith(tuple(f"{o}-" for o in others))
    ]


def lost(name: str, texts: list[str], checks: list) -> list[list[float]]:
    """The points that each check takes from each text of one answer, all in one process."""
    notebook = copy.deepcopy(SOURCES[name])
    notebook.cells = [
        cell for cell in notebook.cells if course.role(cell).get("locked") and not course.is_check(cell)
    ]
    for text in texts:
        notebook.cells += [course.nbformat.v4.new_code_cell(text), *copy.deepcopy(checks)]
    marks = marked(notebook).marks
    return [
        [mark.most - mark.points for mark in marks[k : k + len(checks)]]
        for k in range(0, len(marks), len(checks))
    ]


def changed(text: str) -> Iterator[tuple[str, str]]:
    """The text with one operator changed, and what was changed; each in turn."""
    for k, node in enumerate(ast.walk(ast.parse(text))):
        for i in range(len(getattr(node, "ops", "1")) if hasattr(node, "ops") or hasattr(node, "op") else 0):
            tree = ast.parse(text)
            twin = list(ast.walk(tree))[k]
            before = ast.unparse(twin)
            old = twin.ops[i] if hasattr(twin, "ops") else twin.op
            if isinstance(old, ast.Not):
                twin.operand = ast.UnaryOp(ast.Not(), twin.operand)
            elif type(old) not in OTHER:
                continue
            elif hasattr(twin, "ops"):
                twin.ops[i] = OTHER[type(old)]()
            else:
                twin.op = OTHER[type(old)]()
            yield ast.unparse(tree), f"{before} -> {ast.unparse(twin)}"


@pytest.fixture(autouse=True)
def in_a_hurry(monkeypatch):
    monkeypatch.setenv("POLYSKEL_COURSE_PATIENCE", "0.3")


@each_answer
def test_no_check_takes_nothing_or_a_wrong_type_or_shape(name, answer):
    cell, checks = cell_and_checks(name, answer)
    asked = "\n".join(check.source for check in checks)
    functions = sorted(set(re.findall(r'guarded\(\s*"(\w+)"', asked)))
    variables = sorted(set(re.findall(r'answer\(\s*"(\w+)"', asked)) | set(functions))
    texts = []
    for nothing in NOTHINGS:
        lines = [
            f"def {v}(*_): return {nothing}" if v in functions else f"{v} = {nothing}" for v in variables
        ]
        texts.append("\n".join([cell.source, *lines]))
    for nothing, points in zip(NOTHINGS, lost(name, texts, checks), strict=True):
        assert all(points), f"{nothing}: {dict(zip(map(course.grade_id, checks), points, strict=True))}"


@each_answer
def test_no_operator_of_a_solution_can_change(name, answer):
    cell, checks = cell_and_checks(name, answer)
    known = {each["change"] for each in TOLD[name].get("equivalent", ()) if each["cell"] == answer}
    texts = list(changed(cell.source))
    right, *points = lost(name, [cell.source, *(text for text, _ in texts)], checks)
    assert not any(right)
    unseen = {change for (_, change), taken in zip(texts, points, strict=True) if not any(taken)}
    assert unseen == known
