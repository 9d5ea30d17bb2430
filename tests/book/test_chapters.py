"""What every chapter must have, and that book.toml and notebooks/ name the same files."""

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "notebooks"
# Assignments, course/a1_... to a6_..., are no pages: tests/coursework runs them.
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
LONGEST_CELL = 25
# Of what is to be read without unfolding anything: lines of code a chapter, and a cell.
VISIBLE_LINES = 60
LONGEST_VISIBLE_CELL = 12
LARGEST_FILE = 1_500_000
# A path of the machine that ran the notebook tells a reader nothing, and differs on the next machine.
MACHINE_PATHS = re.compile(r"/(?:root|home|Users|tmp|work)/")


def chapters_of_book() -> list[str]:
    toc = tomllib.loads((ROOT / "book.toml").read_text(encoding="utf-8"))["toc"]
    return [toc["root"]] + [chapter["file"] for part in toc["parts"] for chapter in part["chapters"]]


def cells(path: Path, kind: str) -> list[dict]:
    notebook = json.loads(path.read_text(encoding="utf-8"))
    return [cell for cell in notebook["cells"] if cell["cell_type"] == kind]


def text(cell: dict) -> str:
    return "".join(cell["source"])


def has_picture(cell: dict) -> bool:
    return any(kind.startswith("image/") for output in cell["outputs"] for kind in output.get("data", {}))


def interactive(cell: dict) -> str:
    """The HTML of the viewer or explorer that a cell shows; nothing for other cells."""
    pages = ["".join(output.get("data", {}).get("text/html", "")) for output in cell["outputs"]]
    return "".join(page for page in pages if re.search(r'class="psl-(?:viewer|explorer)"', page))


def is_folded(cell: dict) -> bool:
    return "hide-input" in cell["metadata"].get("tags", [])


def outside_solutions(path: Path) -> list[dict]:
    """The code cells that are on the page before anything is unfolded."""
    found, inside = [], False
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "markdown":
            marks = re.findall(r"^[`:]{3,}\{solution-(start|end)\}", text(cell), re.M)
            inside = marks[-1] == "start" if marks else inside
        elif not inside:
            found.append(cell)
    return found


def test_book_and_folder_name_the_same_chapters():
    pages = [*NOTEBOOKS, *FOLDER.glob("*.md")]
    found = [path.relative_to(FOLDER).with_suffix("").as_posix() for path in pages]
    assert sorted(chapters_of_book()) == sorted(found)


def test_labels_are_unique_over_the_book():
    labels = []
    for path in NOTEBOOKS:
        prose = "\n".join(text(cell) for cell in cells(path, "markdown"))
        labels += re.findall(r"^\s*:(?:label|name): *(\S+)", prose, re.M)
        labels += re.findall(r"^\((\S+)\)=$", prose, re.M) + re.findall(r"^\$\$ *\((\S+)\)", prose, re.M)
        labels += [
            cell["metadata"].get("mystnb", {}).get("figure", {}).get("name") for cell in cells(path, "code")
        ]
    labels = [label for label in labels if label]
    assert not {label for label in labels if labels.count(label) > 1}


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
class TestChapter:
    def test_every_code_cell_was_run_in_order(self, path):
        counts = [cell["execution_count"] for cell in cells(path, "code")]
        assert counts == list(range(1, len(counts) + 1)), "run tools/run_notebooks.py and store the outputs"

    def test_no_output_is_an_error_or_a_warning(self, path):
        for cell in cells(path, "code"):
            bad = [o for o in cell["outputs"] if o["output_type"] == "error" or o.get("name") == "stderr"]
            assert not bad, f"{text(cell)}\n{bad}"

    def test_every_picture_has_caption_name_and_alternative_text(self, path):
        for cell in filter(has_picture, cells(path, "code")):
            metadata = cell["metadata"].get("mystnb", {})
            assert len(metadata.get("image", {}).get("alt", "").strip()) >= 20, f"no alt text:\n{text(cell)}"
            assert metadata.get("figure", {}).get("caption", "").strip(), f"no caption:\n{text(cell)}"
            assert metadata["figure"].get("name", "").startswith("fig-"), f"no name fig-...:\n{text(cell)}"
            assert len(cell["outputs"]) == 1, f"prints beside its picture (end it with ;):\n{text(cell)}"

    def test_every_interactive_picture_has_alternative_text_and_says_what_to_look_for(self, path):
        for cell in cells(path, "code"):
            page = interactive(cell)
            if "explore.viewer(" in text(cell):  # explorers give these to the viewers in them themselves
                assert re.search(r"\balt\b", text(cell)), f"a viewer without alt=:\n{text(cell)}"
                assert re.search(r"\blook\b", text(cell)), f"a viewer without look=:\n{text(cell)}"
            if page:
                assert re.search(r'(?:aria-label|alt)="[^"]{20}', page), f"no alternative text:\n{text(cell)}"
                assert "nbval-ignore-output" in cell["metadata"].get("tags", []), text(cell)
                assert len(cell["outputs"]) == 1, f"prints beside its picture:\n{text(cell)}"
                live = [
                    kind for output in cell["outputs"] for kind in output["data"] if "widget-view" in kind
                ]
                assert not live, "a live widget is stored: use tools/run_notebooks.py"

    def test_every_caption_has_its_picture(self, path):
        captioned = [cell for cell in cells(path, "code") if "figure" in cell["metadata"].get("mystnb", {})]
        assert all(map(has_picture, captioned))

    def test_pictures_in_the_text_have_alternative_text(self, path):
        for cell in cells(path, "markdown"):
            assert not re.search(r"!\[\s*\]\(", text(cell)), text(cell)
            for figure in re.findall(r"\{(?:figure|image)\}.*?```", text(cell), re.S):
                assert re.search(r":alt: *\S", figure), figure

    def test_no_code_cell_is_long(self, path):
        for cell in cells(path, "code"):
            assert len(text(cell).splitlines()) <= LONGEST_CELL, text(cell)

    def test_visible_code_is_what_teaches(self, path):
        """Checks, drawing and plumbing are folded; what makes a number or a picture is to be seen."""
        visible = [text(cell) for cell in outside_solutions(path) if not is_folded(cell)]
        lines = [[line for line in code.splitlines() if line.strip()] for code in visible]
        assert sum(map(len, lines)) <= VISIBLE_LINES
        assert [
            code for code, own in zip(visible, lines, strict=True) if len(own) > LONGEST_VISIBLE_CELL
        ] == []
        assert [code for code in visible if re.search(r"^\s*assert\b", code, re.M)] == []

    def test_what_is_folded_says_what_it_is_and_is_folded_in_jupyterlab_too(self, path):
        for cell in filter(is_folded, cells(path, "code")):
            assert cell["metadata"].get("mystnb", {}).get("code_prompt_show"), text(cell)
            assert cell["metadata"]["jupyter"]["source_hidden"], text(cell)

    def test_what_is_printed_is_no_table(self, path):
        """Columns of numbers are a table of the page (`psl.table`), for phones and screen readers."""
        for cell in cells(path, "code"):
            printed = "".join("".join(o["text"]) for o in cell["outputs"] if o["output_type"] == "stream")
            columns = re.findall(r"^.*\S {2,}\S+ {2,}\S.*$", printed, re.M)
            assert len(columns) < 3, printed

    def test_one_title(self, path):
        prose = "\n".join(text(cell) for cell in cells(path, "markdown"))
        prose = re.sub(r"^(`{3,}|:{3,}).*?^\1`*$", "", prose, flags=re.S | re.M)
        assert len(re.findall(r"^# ", prose, re.M)) == 1

    def test_every_exercise_has_a_folded_solution(self, path):
        prose = "\n".join(text(cell) for cell in cells(path, "markdown"))
        exercises = re.findall(r"\{exercise(?:-start)?\}.*?:label: (\S+)", prose, re.S)
        solutions = re.findall(r"\{solution(?:-start)?\} (\S+)\n((?::.*\n)*)", prose)
        assert sorted(exercises) == sorted(name for name, _ in solutions)
        assert all(":class: dropdown" in options for _, options in solutions)

    def test_file_is_small_and_names_no_machine(self, path):
        assert path.stat().st_size < LARGEST_FILE
        for cell in cells(path, "code"):
            shown = [output for output in cell["outputs"] if not has_picture({"outputs": [output]})]
            assert not MACHINE_PATHS.search(text(cell) + json.dumps(shown)), text(cell)


def test_tables_that_cells_print_are_shown_as_tables():
    """The book reads a cell's Markdown as CommonMark, which has no tables, unless the cell says MyST."""
    for path in NOTEBOOKS:
        for cell in cells(path, "code"):
            printed = "".join("".join(o.get("data", {}).get("text/markdown", "")) for o in cell["outputs"])
            if re.search(r"^\|[-:| ]+\|$", printed, re.MULTILINE):
                assert cell["metadata"].get("mystnb", {}).get("markdown_format") == "myst", path.name


def test_checker_of_pages_finds_what_it_looks_for(tmp_path):
    page = '<a href="gone.html">x</a><img src="//host/x.png"><a href="https://host/">a link is fine</a>'
    (tmp_path / "index.html").write_text(page, encoding="utf-8")
    command = [sys.executable, str(ROOT / "tools" / "check_offline.py"), str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 1
    assert done.stdout.splitlines() == [
        "index.html fetches //host/x.png",
        "index.html names a missing file: gone.html",
    ]
    (tmp_path / "index.html").write_text('<img src="data:image/png;base64,AA==">', encoding="utf-8")
    assert subprocess.run(command, capture_output=True).returncode == 0


def test_every_source_is_cited():
    """The bibliography has what the book cites, and nothing else."""
    folder = ROOT / "notebooks"
    keys = set(re.findall(r"@\w+\{(\w+),", (folder / "references.bib").read_text(encoding="utf-8")))
    sources = [*folder.glob("*.ipynb"), *folder.glob("*.md"), folder / "claims.toml"]
    words = "".join(path.read_text(encoding="utf-8") for path in sources)
    cited = {key for group in re.findall(r"\{cite(?::\w+)?\}`([^`]+)`", words) for key in group.split(",")}
    cited |= set(re.findall(r"cite:(\w+)\"", words))
    assert keys == cited
