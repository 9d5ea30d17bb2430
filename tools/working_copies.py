"""Working copies: the chapters as plain notebooks, for JupyterLab, Colab, VS Code and the browser site.

    .venv/bin/python tools/working_copies.py _build/lab

Written from the built book, so that every number is the book's: roles become words and links, captions and
definitions become text, solutions and proofs fold. Code and outputs stay as they are. A copy that a reader
has changed is kept; delete it to get the new one.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import pickle
import re
import runpy
import shutil
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NOTEBOOKS = ROOT / "notebooks"
#: By its path: it is an extension of the book, and no module of the library.
CHECK = runpy.run_path(str(NOTEBOOKS / "check.py"))
#: What chapters read beside themselves, or link to.
BESIDE = (
    "notebooks/claims.toml",
    "notebooks/claims.csv",
    "notebooks/references.bib",
    "polyskel_lite/**/*",
    "tests/claims/*.py",
    "tests/fuzz/*.py",
    "tests/truth/*.py",
    "tools/register.py",
    "benchmarks/*",
    "*.md",
    "*.toml",
    "*.yml",
    "LICENSE*",
)
ROLE = re.compile(r"\{([a-z:]+)\}`([^`]+)`")
DIRECTIVE = re.compile(r"^(`{3,}|:{3,})\{([a-z:-]+)\} *(.*)\n((?:.*\n)*?)\1 *$", re.M)
WORDS = {"figure": "Figure", "table": "Table", "code-block": "Listing", "displaymath": ""}
INSTALL = """\
# Does nothing where the library is installed.
import importlib.util

if importlib.util.find_spec("polyskel_lite") is None:
    {install}"""


@dataclass
class Book:
    """What the built book knows: numbers, titles, labels, sources."""

    titles: dict[str, str]
    labels: dict[str, tuple[str, str]]
    numbers: dict[str, tuple[str, str, str]] = field(default_factory=dict)
    sources: dict = field(default_factory=dict)

    @classmethod
    def of(cls, doctrees: Path) -> Book:
        from pybtex.database import parse_file

        with (doctrees / "environment.pickle").open("rb") as file:
            env = pickle.load(file)
        labels = {name: (doc, str(text)) for name, (doc, _, text) in env.domaindata["std"]["labels"].items()}
        book = cls({doc: title.astext() for doc, title in env.titles.items()}, labels)
        for doc, kinds in env.toc_fignumbers.items():
            for kind, found in kinds.items():
                for label, number in found.items():
                    word = WORDS.get(kind, kind.capitalize())
                    number = ".".join(map(str, number))
                    book.numbers[label.removeprefix("equation-").lower()] = (doc, word, number)
        book.sources = parse_file(str(NOTEBOOKS / "references.bib")).entries
        return book

    def called(self, label: str) -> str:
        """The number of a figure, a theorem, an exercise, as the book calls it."""
        _, word, number = self.numbers[label.lower()]
        return f"{word} {number}" if word else f"({number})"


def plain(text: str) -> str:
    """A field of the bibliography without TeX."""
    from pybtex.richtext import Text

    return str(Text.from_latex(text)).replace("--", "–")


@dataclass
class Chapter:
    """One chapter on its way to a plain notebook."""

    book: Book
    name: str
    cited: set[str] = field(default_factory=set)
    checks: int = 0

    def link(self, doc: str, words: str) -> str:
        """Words, linked where they lead to another chapter."""
        there = doc != self.name and (NOTEBOOKS / f"{doc}.ipynb").exists()
        return f"[{words}]({doc}.ipynb)" if there else words

    def role(self, match: re.Match) -> str:
        """A role of MyST in words."""
        kind, text = match[1], match[2]
        titled = re.fullmatch(r"(.*?)\s*<([^>]*)>", text, re.S)
        words, label = (titled[1], titled[2]) if titled else ("", text.strip())
        if kind.startswith("cite"):
            return self.citation(kind, label.split(","))
        if kind in ("state", "knob", "reading"):
            return words
        if kind == "doc":
            return self.link(label.lstrip("/"), words or self.book.titles[label.lstrip("/")])
        if kind == "download":
            return f"[{words or label}]({label})"
        if label.lower() in self.book.numbers:
            doc, _, number = self.book.numbers[label.lower()]
            if "%s" in words or "{number}" in words:
                return self.link(doc, words.replace("%s", number).replace("{number}", number))
            return self.link(doc, words or self.book.called(label))
        doc, title = self.book.labels[label]
        return self.link(doc, words or title)

    def citation(self, kind: str, keys: list[str]) -> str:
        keys = [key.strip() for key in keys]
        self.cited.update(keys)
        shown = [f"{self.authors(key)}, {self.book.sources[key].fields['year']}" for key in keys]
        if kind == "cite:t":
            return ", ".join(re.sub(r", (\d+)$", r" (\1)", one) for one in shown)
        return f"[{'; '.join(shown)}]"

    def authors(self, key: str) -> str:
        entry = self.book.sources[key]
        people = entry.persons.get("author") or entry.persons.get("editor")
        names = [plain(" ".join(person.last_names)) for person in people]
        return names[0] + {1: "", 2: f" and {names[-1]}"}.get(len(names), " et al.")

    def reference(self, key: str) -> str:
        """One line of the list of references."""
        entry = self.book.sources[key]
        people = entry.persons.get("author") or entry.persons.get("editor")
        names = ", ".join(plain(" ".join(p.first_names + p.last_names)) for p in people)
        where = next(
            (entry.fields[k] for k in ("journal", "booktitle", "publisher") if k in entry.fields), ""
        )
        return f"- {names}. {plain(entry.fields['title'])}. *{plain(where)}*, {entry.fields['year']}."

    def directive(self, match: re.Match) -> str:
        """A directive of MyST as a quote, or as something that folds."""
        kind, title, body = match[2], match[3].strip(), match[4]
        options = dict(re.findall(r"^:([a-z-]+): *(.*)$", body, re.M))
        body = re.sub(r"\A(:[a-z-]+:.*\n)+", "", body.lstrip("\n")).strip("\n")
        body = DIRECTIVE.sub(self.directive, body)
        label = options.get("label", options.get("name", "")).lower()
        number = self.book.called(label) if label in self.book.numbers else ""
        if kind == "bibliography":
            return "@@references@@"
        if kind == "literalinclude":
            return f"[{title}]({title})"
        if kind == "predict":
            return question(title, body)
        if kind == "check":
            self.checks += 1
            return self_check(self.checks, title, body)
        if kind == "dropdown":
            return folded(title, body)
        if kind == "solution":
            return folded(f"Solution of {self.book.called(title)}", body)
        if kind == "table":
            return f"**{number}.** {title}\n\n{body}"
        word = {"admonition": title, "prf:proof": "Proof"}.get(kind, number or kind.capitalize())
        head = f"**{word}**" if kind == "admonition" or not title else f"**{word}** ({title})"
        return "\n".join(f"> {line}".rstrip() for line in f"{head}\n\n{body}".split("\n"))

    def text(self, source: str) -> str:
        """Markdown without MyST."""
        source = re.sub(r"^\([\w-]+\)=\n", "", source + "\n", flags=re.M)
        source = re.sub(r"^(?::{3,}|`{3,})\{solution-end\}\n(?::{3,}|`{3,})\n?", "", source, flags=re.M)
        return ROLE.sub(self.role, DIRECTIVE.sub(self.directive, source)).rstrip("\n")

    def cells(self, notebook: dict) -> Iterator[dict]:
        """All cells, with captions beneath pictures and solutions folded."""
        solution = ""
        for cell in notebook["cells"]:
            source = "".join(cell["source"])
            tags = cell["metadata"].get("tags", [])
            if cell["cell_type"] == "code":
                hidden = {}
                if solution:  # JupyterLab keeps the older name `collapsed` in step with its own
                    hidden = {"collapsed": True, "jupyter": {"source_hidden": True, "outputs_hidden": True}}
                elif "hide-input" in tags:
                    hidden = {"jupyter": {"source_hidden": True}}
                yield cell | {"metadata": cell["metadata"] | hidden}
                figure = cell["metadata"].get("mystnb", {}).get("figure")
                if figure:
                    caption = f"**{self.book.called(figure['name'])}.** {self.text(figure['caption'])}"
                    yield markdown(f"caption-{figure['name']}", caption)
                continue
            for piece in re.split(r"^(?=```\{solution-(?:start|end)\})", source, flags=re.M):
                start = re.match(r"```\{solution-start\} *(\S+)\n(?:.*\n)*?```\n?", piece)
                if start:
                    solution = f"Solution of {self.book.called(start[1])}"
                    piece = piece[start.end() :] or "Open the cells below."
                ended = re.match(r"```\{solution-end\}", piece)
                solution = "" if ended else solution
                text = self.text(piece)
                if text.strip():
                    name = f"{cell.get('id', 'text')}-{len(piece)}"
                    yield markdown(name, folded(solution, text) if solution else text)

    def notebook(self, source: dict) -> dict:
        """The whole copy."""
        cells = list(self.cells(source))
        references = "\n".join(map(self.reference, sorted(self.cited)))
        for cell in cells:
            if cell["cell_type"] == "markdown":
                text = "".join(cell["source"]).replace("@@references@@", references)
                cell["source"] = text.splitlines(keepends=True)
        settings = tomllib.loads((ROOT / "book.toml").read_text(encoding="utf-8"))["book"]
        install = 'raise ImportError("In a copy of the project: pip install \\".[lab]\\"")'
        if "repository" in settings:
            address = f"git+{settings['repository']}@{settings.get('branch', 'main')}"
            install = f'%pip install -q "polyskel-lite[graph,files,meshes] @ {address}" ipywidgets anywidget'
        first = markdown("install", "") | {"cell_type": "code", "execution_count": None, "outputs": []}
        first["source"] = INSTALL.format(install=install).splitlines(keepends=True)
        first["metadata"] = {"jupyter": {"source_hidden": True}}
        title = next(k for k, cell in enumerate(cells) if cell["cell_type"] == "markdown") + 1
        return source | {"cells": [*cells[:title], first, *cells[title:]]}


def markdown(name: str, text: str) -> dict:
    """A text cell; its name is made fit for the notebook format."""
    name = re.sub(r"[^A-Za-z0-9_-]", "-", name)[:64]
    return {"cell_type": "markdown", "id": name, "metadata": {}, "source": text.splitlines(keepends=True)}


def folded(title: str, body: str) -> str:
    return f"<details><summary>{title}</summary>\n\n{body}\n\n</details>"


def question(title: str, body: str) -> str:
    """A question before a picture: its options as a list, the right ones and the verdict folded."""
    choices, _, verdict = body.partition("\n\n") if body.startswith("- [") else ("", "", body)
    right = [f"**{one}**" for one in re.findall(r"^- \[x\] (.*(?:\n  .*)*)", choices, re.M)]
    listed = re.sub(r"^- \[[ x]\]", "-", choices, flags=re.M)
    return "\n\n".join(
        filter(None, [f"**{title}**", listed, folded("Answer", "\n\n".join([*right, verdict]))])
    )


def self_check(number: int, title: str, body: str) -> str:
    """A question after a section: its answers as a list, and folded which of them are right and why."""
    found = CHECK["choices"](body)
    listed = "\n".join(f"- {answer}" for _, answer, _ in found)
    told = [f"- {answer}: **{'yes' if mark == 'x' else 'no'}.** {why}" for mark, answer, why in found]
    return f"**Check {number}. {title}**\n\n{listed}\n\n{folded('Which, and why', chr(10).join(told))}"


def copies(doctrees: Path) -> dict[str, str]:
    """The text of every working copy by the name of its chapter."""
    book = Book.of(doctrees)
    made = {}
    for path in sorted(NOTEBOOKS.glob("*.ipynb")):
        source = json.loads(path.read_text(encoding="utf-8"))
        copy = Chapter(book, path.stem).notebook(source)
        made[path.name] = json.dumps(copy, indent=1, ensure_ascii=False) + "\n"
    return made


def write(folder: Path, doctrees: Path) -> list[str]:
    """Lay out the copies and what they read; returns the names of those kept as a reader left them."""
    for pattern in BESIDE:
        for path in sorted(ROOT.glob(pattern)):
            if path.is_file() and "__pycache__" not in path.parts:
                (folder / path.relative_to(ROOT)).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(path, folder / path.relative_to(ROOT))
    record, kept = folder / "copies.json", []
    try:
        written = json.loads(record.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        written = {}
    for name, text in copies(doctrees).items():
        path, new = folder / "notebooks" / name, hashlib.sha256(text.encode()).hexdigest()
        there = hashlib.sha256(path.read_bytes()).hexdigest() if path.exists() else None
        if there and written.get(name) == new:
            continue
        if there not in (None, new, written.get(name)):
            kept.append(name)
            continue
        path.write_text(text, encoding="utf-8")
        written[name] = new
    record.write_text(json.dumps(written, indent=1), encoding="utf-8")
    return kept


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--doctrees", type=Path, default=ROOT / "_build" / "doctrees")
    options = parser.parse_args()
    if not (options.doctrees / "environment.pickle").exists():
        raise SystemExit("The copies have the numbers of the built book: run make book first.")
    kept = write(options.folder, options.doctrees)
    print(f"The chapters to work in are in {options.folder / 'notebooks'}.")
    if kept:
        print("Changed by you and kept, though the book has a newer one:", ", ".join(kept))


if __name__ == "__main__":
    main()
