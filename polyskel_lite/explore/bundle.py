"""JavaScript modules as one: a page read from disk may not import others, and a widget has one.

Only the standard library and nothing of this package is used here, because ``notebooks/conf.py`` runs this
file by its path: the book can be built where neither NumPy nor the library is installed.
"""

import re
from collections.abc import Iterable
from graphlib import TopologicalSorter
from html import escape
from pathlib import Path

HERE = Path(__file__).resolve().parent
#: The modules to begin with: the skeleton viewer, the drawing board, and what a page without a kernel has.
VIEWER = HERE / "skeleton_viewer" / "page.js"
BOARD = HERE / "drawing_board" / "board.js"
TOYS = HERE / "toys"

# The only forms that the modules use; a test holds that nothing else is there.
_IMPORT = re.compile(r'^import \{ [\w, ]+ \} from "(\.{1,2}/[\w/]+\.js)";\n', re.M)
_EXPORT = re.compile(r"^export (?!default )", re.M)
_DEFAULT = re.compile(r"^export default .*;\n", re.M)
_COMMENT = re.compile(r"^ *//.*\n|^ */\*\*(?:.|\n)*?\*/ *\n", re.M)
_INDENT = re.compile(r"^\s+", re.M)


def one_module(main: Path = VIEWER) -> str:
    """A module and all that it imports in one text, each after those that it imports.

    Examples
    --------
    >>> text = one_module()
    >>> text.rstrip().endswith("export default { render };"), text.count("export "), "import {" in text
    (True, 1, False)
    """
    return _joined(main.resolve(), main.read_text(encoding="utf-8"))


def page_module(toys: Iterable[str] = ()) -> str:
    """The JavaScript of a page with questions and these explorers, without comments and indentation.

    Examples
    --------
    >>> text = page_module(["Graphs"])
    >>> len(text.encode()) < 60_000, "class Graphs " in text, "class Balls " in text
    (True, True, False)
    """
    names = sorted(toys)
    written = {file: file.read_text(encoding="utf-8") for file in sorted(TOYS.glob("*.js"))}
    homes = {
        name: file.name for name in names for file in written if f"export class {name} " in written[file]
    }
    lines = [f'import {{ {name} }} from "./{homes[name]}";\n' for name in names]
    main = f'import {{ start }} from "./page.js";\n{"".join(lines)}\nstart({{ {", ".join(names)} }});\n'
    return _INDENT.sub("", _COMMENT.sub("", _joined(TOYS / "main.js", main)))


def page_style() -> str:
    """The style sheets of a page with explorers.

    Examples
    --------
    >>> ".psl-knobs" in page_style(), ".psl-board" in page_style()
    (True, True)
    """
    sheets = (BOARD.with_name("board.css"), TOYS / "toys.css")
    return "".join(sheet.read_text(encoding="utf-8") for sheet in sheets)


def whole_page(title: str, body: str, module: str, style: str = "") -> str:
    """A page of its own that works from disk.

    Examples
    --------
    >>> whole_page("A & B", "<p>here</p>", "").count("A &amp; B")
    2
    """
    title = escape(title)
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{title}</title>\n<style>{style}</style></head>\n"
        f"<body><main>\n<h1>{title}</h1>\n{body}\n</main>\n"
        f'<script type="module">\n{module}\n</script>\n</body>\n</html>\n'
    )


def _joined(main: Path, text: str) -> str:
    texts = {main: text}
    needed: dict[Path, list[Path]] = {}
    todo = [main]
    while todo:
        file = todo.pop()
        if file not in texts:
            texts[file] = file.read_text(encoding="utf-8")
        if file not in needed:
            needed[file] = [(file.parent / name).resolve() for name in _IMPORT.findall(texts[file])]
            todo += needed[file]
    order = list(TopologicalSorter(dict(sorted(needed.items()))).static_order())
    texts |= {file: _DEFAULT.sub("", texts[file]) for file in order[:-1]}
    return "\n".join(_EXPORT.sub("", _IMPORT.sub("", texts[file])) for file in order)
