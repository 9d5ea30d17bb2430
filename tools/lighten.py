"""Make the pages of a built book light: what a page does not show is not fetched.

    .venv/bin/python tools/lighten.py _build/html

notebooks/conf.py runs it at the end of every build. Icons are written into the page, instead of drawn
there by a script with thousands of them; pictures and the data of viewers come when the reader comes
near; the index of all words comes with the page that searches it; style sheets lose the rules for what is
on no page; MathJax comes without its menu. A page that was made light stays as it is, and so do files
that Sphinx will copy again.
"""

import base64
import hashlib
import importlib.util
import re
import struct
import sys
from functools import cache
from pathlib import Path

LOOKS = "solid|regular|brands|lg|sm|xs|fw"  # what follows fa- and is no drawing's name
ICON = re.compile(
    rf'<(?P<tag>i|span) class="(?P<classes>[^"]*\bfa-(?P<name>(?!(?:{LOOKS})\b)[a-z0-9-]+)[^"]*)"'
    r"(?P<more>[^>]*)></(?P=tag)>"
)
ICONS = re.compile(r'\s*<script defer src="[^"]*scripts/fontawesome\.js[^"]*"></script>')
SEARCH = re.compile(
    r'\s*<script src="(?:_static/(?:searchtools|language_data)|searchindex)\.js[^"]*"></script>'
)
TABS = re.compile(r'\s*<script [^>]*\bsrc="_static/design-tabs\.js[^"]*"></script>')
PICTURE = re.compile(r'<img (?![^>]*\bloading=)(?P<rest>[^>]*?\bsrc="(?P<file>_images/[^"]+)"[^>]*)>')
IN_PAGE = re.compile(r"data:image/png;base64,(?P<data>[A-Za-z0-9+/=]{2000,})")
SHEET = re.compile(r'href="(?P<file>_static/[^"?]+?)(?:\.light)?\.css(?:\?[^"]*)?"')
DATA = re.compile(r'<script type="application/json">(?P<data>.{2000,}?)</script>', re.S)
TOKEN = re.compile(r'<span class="(?P<kind>[a-z]{1,2}\d?)">(?P<code>[^<]*)</span>')
MODULE = re.compile(r'(?<=<script type="module">).*?(?=</script>)', re.S)
UNUSED = ("scripts/fontawesome.js", "scripts/fontawesome.js.map", "scripts/fontawesome.js.LICENSE.txt")


@cache
def drawings() -> str:
    """The file of icons that comes with the theme."""
    (folder,) = importlib.util.find_spec("pydata_sphinx_theme").submodule_search_locations
    file = Path(folder, "theme", "pydata_sphinx_theme", "static", "scripts", "fontawesome.js")
    return file.read_text(encoding="utf-8")


def icon(match: re.Match) -> str:
    """An icon as a drawing; one that the theme does not have stays as it is."""
    # Where a name stands for two drawings, the one in outline comes first and the solid one last.
    found = re.findall(rf'[,{{]"?{match["name"]}"?:\[(\d+),(\d+),\[[^\]]*\],"[^"]*","([^"]+)"\]', drawings())
    if not found:
        return match[0]
    width, height, path = found[0 if "fa-regular" in match["classes"] else -1]
    return (
        f'<svg class="svg-inline--fa {match["classes"]}"{match["more"]} viewBox="0 0 {width} {height}" '
        f'aria-hidden="true"><path fill="currentColor" d="{path}"/></svg>'
    )


def size(file: Path) -> tuple[int, int] | None:
    """Width and height of a picture on a page; a picture for sharp screens has more pixels, and says so."""
    data = file.read_bytes()
    if file.suffix == ".svg":
        found = re.search(rb'<svg [^>]*?width="(\d+)" height="(\d+)"', data, re.S)
        return (int(found[1]), int(found[2])) if found else None
    if file.suffix != ".png":
        return None
    width, height = struct.unpack(">II", data[16:24])
    said = re.search(rb"tEXtpage\0(\d+) x (\d+)", data)
    return (int(said[1]), int(said[2])) if said else (width, height)


def kept(folder: Path, data: bytes, suffix: str) -> str:
    """The name of a file of the book that holds some data, named after what it holds."""
    name = f"{hashlib.sha256(data).hexdigest()[:32]}{suffix}"
    folder.mkdir(exist_ok=True)
    (folder / name).write_bytes(data)
    return f"{folder.name}/{name}"


def plain_tokens(book: Path) -> set[str]:
    """Kinds of code that the style sheet colours like all code around them: names, commas and the like."""
    sheet = (book / "_static" / "pygments.css").read_text(encoding="utf-8")
    rules = re.findall(r'html\[data-theme="(\w+)"\] \.highlight(?: \.(\w+))? \{([^}]*)\}', sheet)
    around = {
        theme: re.search(r"(?<!-)color: *[^;} ]+", style)[0] for theme, kind, style in rules if not kind
    }
    special = {kind for theme, kind, style in rules if kind and style.strip() != around.get(theme)}
    return {kind for _, kind, _ in rules if kind} - special


def light(page: str, book: Path, plain: set[str] = frozenset()) -> str:
    """The text of a page, made light; files for what it no longer holds itself are added to the book."""

    def picture(match: re.Match) -> str:
        found = None if "width=" in match["rest"] else size(book / match["file"])
        place = 'width="{}" height="{}" '.format(*found) if found else ""
        return f'<img loading="lazy" decoding="async" {place}{match["rest"]}>'

    def picture_in_page(match: re.Match) -> str:
        return kept(book / "_images", base64.b64decode(match["data"]), ".png")

    def data(match: re.Match) -> str:
        name = hashlib.sha256(match["data"].encode()).hexdigest()[:32]
        script = f'(globalThis.pslData ??= {{}})["{name}"] = {match["data"]};'
        file = kept(book / "_data", script.encode(), ".js")
        return f'<script type="application/json" data-name="{name}" data-from="{file}"></script>'

    page = ICON.sub(icon, page)
    page = TOKEN.sub(lambda match: match["code"] if match["kind"] in plain else match[0], page)
    # Of the viewer's code lines of comment, and blanks before lines.
    page = MODULE.sub(lambda match: re.sub(r"(?m)^\s*//.*\n|^\s*/\*\*.*?\*/\n|^[ \t]+", "", match[0]), page)
    if not re.search(r'<(?:i|span) class="[^"]*\bfa-', page):
        page = ICONS.sub("", page)
    if 'id="search-results"' not in page:
        page = SEARCH.sub("", page)
    if "sd-tab-" not in TABS.sub("", page):
        page = TABS.sub("", page)
    # A formula wider than a phone can be scrolled, also by keys; the menu of MathJax had seen to that.
    page = page.replace('<div class="math ', '<div tabindex="0" class="math ')
    page = page.replace("_static/mathjax/tex-chtml.js", "_static/mathjax/startup.js")
    page = SHEET.sub(r'href="\g<file>.light.css"', page)
    return PICTURE.sub(picture, DATA.sub(data, IN_PAGE.sub(picture_in_page, page)))


def rules(sheet: str) -> list[tuple[str, str]]:
    """The rules of a style sheet: what stands before the braces, and what stands in them."""
    found, start, at, depth = [], 0, 0, 0
    for mark in re.finditer(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|/\*.*?\*/|[{};]', sheet, re.S):
        if mark[0] == "{":
            depth += 1
            at = mark.start() if depth == 1 else at
        elif mark[0] == "}" or (mark[0] == ";" and depth == 0):
            depth -= mark[0] == "}"
            if depth == 0:
                inside = sheet[at + 1 : mark.start()] if mark[0] == "}" else ""
                found.append((sheet[start : at if mark[0] == "}" else mark.end()], inside))
                start = mark.end()
    return found


def names(selector: str) -> list[str]:
    """The classes and ids that an element must have, or its neighbours, for a selector to mean it."""
    plain = re.sub(r"\[[^\]]*\]|:(?:not|is|where|has)\([^)]*\)", "", selector)
    return re.findall(r"[.#]((?:[\w-]|\\.)+)", plain)


def used(sheet: str, words: set[str]) -> str:
    """A style sheet without the rules that need a class or an id that is not among the words."""
    lines = []
    for before, inside in rules(sheet):
        head = re.sub(r"/\*.*?\*/", "", before, flags=re.S).strip()
        if not inside and head.endswith(";"):
            lines.append(re.sub(r"(?<!\.light)\.css\b", ".light.css", head))  # what @import names
        elif head.startswith(("@media", "@supports", "@layer")):
            rest = used(inside, words)
            lines += [f"{head}{{{rest}}}"] if rest else []
        elif head.startswith("@"):
            lines.append(f"{head}{{{inside}}}")
        else:
            # Commas within :is( ... ) part no selectors; what :not( ... ) names need not be there.
            selectors = re.split(r",(?![^(]*\))", head)
            seen = [selector for selector in selectors if words.issuperset(names(selector))]
            lines += [f"{','.join(seen)}{{{inside}}}"] if seen else []
    return "".join(lines)


def lighten(book: Path) -> None:
    """Make the pages and the style sheets of a built book light."""
    pages = [
        page for page in sorted(book.rglob("*.html")) if not {"_static", "slides"}.intersection(page.parts)
    ]
    words, plain = set[str](), plain_tokens(book)
    for page in pages:
        text = page.read_text(encoding="utf-8")
        lighter = light(text, book, plain) if page.parent == book else text
        if lighter != text:
            page.write_text(lighter, encoding="utf-8")
        words.update(re.findall(r"[\w-]+", lighter))
    for script in book.glob("_static/**/*.js"):
        if not {"mathjax", "reveal"}.intersection(script.parts) and script.name != "fontawesome.js":
            words.update(re.findall(r"[\w-]+", script.read_text(encoding="utf-8")))
    for sheet in book.glob("_static/**/*.css"):
        if not sheet.stem.endswith(".light"):
            text = used(sheet.read_text(encoding="utf-8"), words)
            sheet.with_suffix(".light.css").write_text(text, encoding="utf-8")
    if not any("scripts/fontawesome.js" in page.read_text(encoding="utf-8") for page in pages):
        for name in UNUSED:
            (book / "_static" / name).unlink(missing_ok=True)


if __name__ == "__main__":
    lighten(Path(sys.argv[1] if len(sys.argv) > 1 else "_build/html"))
