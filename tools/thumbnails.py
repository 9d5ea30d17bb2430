"""Small pictures of the pages for the contents page: what one sees first on each.

    .venv/bin/python tools/thumbnails.py _build/html

Takes them from the built book in Chromium and writes them to notebooks/_static/thumbnails/. For maintainers,
after a first picture has changed; a test in tests/browser compares them.
"""

from __future__ import annotations

import io
import shutil
import sys
import tomllib
from pathlib import Path

from PIL import Image, ImageOps

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / "notebooks" / "_static" / "thumbnails"
#: What a page shows: the first of these that can be seen.
PICTURE = "figure img, .psl-viewer canvas, article svg[role=img]"
SIZE = (360, 240)


def thumbnail(element) -> Image.Image:
    """A picture of a page, an element of Playwright, made small on white."""
    seen = Image.open(io.BytesIO(element.screenshot(animations="disabled"))).convert("RGB")
    width, height = seen.size
    # The upper part of a high picture: a row or two of panels says more than all of them tiny.
    seen = seen.crop((0, 0, width, min(height, round(width * SIZE[1] / SIZE[0]))))
    return ImageOps.pad(seen, SIZE, color="white")


def pages() -> list[str]:
    """The names of all pages in the order of the book."""
    toc = tomllib.loads((ROOT / "book.toml").read_text(encoding="utf-8"))["toc"]
    return [chapter["file"] for part in toc["parts"] for chapter in part["chapters"]]


def main(book: Path) -> None:
    from playwright.sync_api import sync_playwright

    FOLDER.mkdir(exist_ok=True)
    program = shutil.which("chromium") or shutil.which("google-chrome")
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=program, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1280, "height": 900}, reduced_motion="reduce")
        for name in pages():
            page.goto(f"{book.resolve().as_uri()}/{name}.html", wait_until="networkidle")
            found = page.locator(PICTURE).locator("visible=true")
            if found.count():
                small = thumbnail(found.first).quantize(48, dither=Image.Dither.NONE)
                small.save(FOLDER / f"{name.replace('/', '-')}.png", optimize=True)
        browser.close()


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "_build/html"))
