"""Refuse a built book that would ask another host for anything when a page is opened, or that lost a file.

    .venv/bin/python tools/check_offline.py _build/html

Links that a reader may click are fine; scripts, styles, fonts, pictures and frames must be files of the book.
"""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# Attributes that make a browser fetch something by itself. A <link> fetches only for these relations.
FETCHING = {"src", "srcset", "poster"}
FETCHING_LINKS = {"stylesheet", "icon", "preload", "modulepreload", "prefetch", "preconnect", "manifest"}
CSS_URL = re.compile(r"""url\(\s*["']?([^"')]+)|@import\s+["']([^"']+)""")


class Resources(HTMLParser):
    """The addresses that a page fetches by itself, and the pages it links to."""

    def __init__(self) -> None:
        super().__init__()
        self.fetched: list[str] = []
        self.linked: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attrs}
        names = FETCHING | {"data"} if tag == "object" else FETCHING
        self.fetched += [values[name] for name in names & values.keys()]
        self.fetched += [url for pair in CSS_URL.findall(values.get("style", "")) for url in pair if url]
        if tag == "link" and FETCHING_LINKS & set(values.get("rel", "").split()):
            self.fetched.append(values.get("href", ""))
        elif tag == "a":
            self.linked.append(values.get("href", ""))


def problems(root: Path) -> list[str]:
    """One sentence for each address that a page of the book must not have."""
    found = []
    # The theme leaves unfilled templates in _static, which no page shows.
    for page in sorted(page for page in root.rglob("*.html") if "_static" not in page.parts):
        resources = Resources()
        resources.feed(page.read_text(encoding="utf-8"))
        found += [f"{page.name} fetches {url}" for url in resources.fetched if is_remote(url)]
        found += [
            f"{page.name} names a missing file: {url}"
            for url in resources.fetched + resources.linked
            if is_local(url) and not exists(page.parent, url)
        ]
    for sheet in sorted(root.rglob("*.css")):
        urls = [url for pair in CSS_URL.findall(sheet.read_text(encoding="utf-8")) for url in pair if url]
        found += [f"{sheet.name} fetches {url}" for url in urls if is_remote(url)]
    return found


def is_remote(url: str) -> bool:
    return urlsplit(url).scheme in {"http", "https", "ws", "wss"} or url.startswith("//")


def is_local(url: str) -> bool:
    return not urlsplit(url).scheme and not is_remote(url)


def exists(folder: Path, url: str) -> bool:
    path = unquote(urlsplit(url).path)
    return not path or (folder / path).exists()


def main() -> int:
    root = Path(sys.argv[1] if len(sys.argv) > 1 else "_build/html")
    if not (root / "index.html").exists():
        print(f"There is no built book in {root}; run `make book` first.")
        return 1
    found = problems(root)
    print("\n".join(sorted(set(found))) or "Checked: no page of the book asks another host for anything.")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
