"""The claims register: every verdict recomputed, every pointer followed.

What the checks are worth is in `test_can_fail`.
"""

import ast
import json
import re
import runpy
import tomllib
from functools import cache
from pathlib import Path

import pytest

from claims import CHECKS, VERDICTS

ROOT = Path(__file__).resolve().parents[2]
CLAIMS = tomllib.loads((ROOT / "notebooks" / "claims.toml").read_text(encoding="utf-8"))["claim"]
FIELDS = (
    "id",
    "section",
    "place",
    "statement",
    "verdict",
    "reading",
    "tolerance",
    "why",
    "notebook",
    "cell",
    "test",
)
IDS = [claim.get("id", "?") for claim in CLAIMS]
each_claim = pytest.mark.parametrize("claim", CLAIMS, ids=IDS)


@each_claim
def test_verdict(claim):
    assert CHECKS[claim["id"]]() == claim["verdict"]


@each_claim
def test_entry_is_complete(claim):
    needed = {*FIELDS, *(["condition"] if claim["verdict"] == "holds under" else [])}
    assert set(claim) - {"proof"} == needed
    assert all(isinstance(value, str) and value.strip() for value in claim.values())
    assert claim["verdict"] in VERDICTS


def test_every_claim_has_a_check_and_every_check_a_claim():
    assert len(IDS) == len(set(IDS))
    assert set(IDS) == set(CHECKS)


@cache
def test_names(path: Path) -> frozenset[str]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return frozenset(node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef))


test_names.__test__ = False


@each_claim
def test_pointed_test_exists(claim):
    path, name = claim["test"].split("::")
    function, _, parameter = name.partition("[")
    assert function.startswith("test_")
    assert function in test_names(ROOT / path)
    if function == "test_verdict":
        assert parameter == claim["id"] + "]"


def test_pointed_proofs_exist():
    """A proof is a place in a chapter, or an entry of the bibliography."""
    bibliography = (ROOT / "notebooks" / "references.bib").read_text(encoding="utf-8")
    places = [claim["proof"] for claim in CLAIMS if "proof" in claim]
    assert len(places) > 20
    for place in places:
        kind, _, key = place.rpartition(":")
        if kind == "cite":
            assert f"{{{key}," in bibliography, place
        else:
            chapter, _, label = place.partition("#")
            text = (ROOT / "notebooks" / chapter).read_text(encoding="utf-8")
            assert f":label: {label}" in text if label else "{prf:" in text, place


def test_names_of_other_claims_are_right():
    named = [
        name for claim in CLAIMS for name in re.findall(r"\bsee ([a-z0-9]+(?:-[a-z0-9]+)+)", claim["reading"])
    ]
    assert named
    assert set(named) <= set(IDS)


def test_table_is_the_register():
    """claims.csv is written by tools/register.py."""
    register = runpy.run_path(str(ROOT / "tools" / "register.py"))
    table = (ROOT / "notebooks" / "claims.csv").read_text(encoding="utf-8")
    assert table == register["table"](register["load"]())
    assert list(register["SIGNS"]) == list(VERDICTS)


def test_index_counts_as_the_register_does():
    index = (ROOT / "notebooks" / "index.ipynb").read_text(encoding="utf-8")
    assert f"{len(CLAIMS)} statements of the paper" in index
    assert [claim["verdict"] for claim in CLAIMS].count("does not hold") == 3
    assert "three do not" in index


@cache
def code_cells(path: Path) -> list[dict]:
    notebook = json.loads(path.read_text(encoding="utf-8"))
    return [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]


@each_claim
def test_pointed_cell_exists_and_was_run(claim):
    path = ROOT / claim["notebook"]
    assert path.exists(), f"{claim['notebook']} is not written yet"
    cells = [cell for cell in code_cells(path) if claim["cell"] in cell["metadata"].get("tags", [])]
    assert cells, f"no code cell of {claim['notebook']} has the tag {claim['cell']}"
    for cell in cells:
        assert cell["execution_count"], "the cell was not run"
    # Of several cells with one tag, one shows or asserts it.
    assert any(cell["outputs"] or "assert " in "".join(cell["source"]) for cell in cells)


def test_tags_of_chapters_are_claims():
    for path in sorted((ROOT / "notebooks").glob("*.ipynb")):
        for cell in code_cells(path):
            tags = [tag for tag in cell["metadata"].get("tags", []) if tag.startswith("claim:")]
            assert {tag.removeprefix("claim:") for tag in tags} <= set(IDS), path.name


def test_page_lists_every_claim():
    shown = [
        "".join(output["data"]["text/markdown"])
        for cell in code_cells(ROOT / "notebooks" / "claims.ipynb")
        for output in cell["outputs"]
        if "text/markdown" in output.get("data", {})
    ]
    page = "\n".join(shown)
    missing = [claim["id"] for claim in CLAIMS if f"`{claim['id']}`" not in page]
    assert not missing
    assert all(claim["statement"] in page for claim in CLAIMS)
