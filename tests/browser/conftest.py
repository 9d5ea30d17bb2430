"""Pages in a real browser: Chromium driven by Playwright; the built book from disk and from a web server.

`make browser` builds the book and names its folder in BOOK; without BOOK it is built into a temporary folder.
"""

import os
import shutil
import subprocess
import sys
import threading
import tomllib
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
FLAGS = [
    "--no-sandbox",  # CI runs as root
    *("--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"),  # WebGL drawn in software
    *(
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
    ),  # it calls nobody itself
    *("--disable-quic", "--no-first-run"),
]
WITHOUT = "Chromium is not installed, so nothing was tried in a browser (Debian: apt-get install chromium)."
PATIENCE = 30_000  # milliseconds before a step that never comes counts as failed


def pages() -> list[str]:
    """The pages of the book by name, from book.toml, and the two that Sphinx adds.

    Those of the reference are made alike: a few of them stand for all.
    """
    toc = tomllib.loads((ROOT / "book.toml").read_text(encoding="utf-8"))["toc"]
    chapters = [chapter["file"] for part in toc["parts"] for chapter in part["chapters"]]
    alike = {name for name in chapters if name.startswith("api_")} - {"api_shapes", "api_drawing"}
    return [toc["root"], *(name for name in chapters if name not in alike), "genindex", "search"]


def chromium() -> str | None:
    return next(filter(None, map(shutil.which, PROGRAMS)), None)


def pytest_terminal_summary(terminalreporter) -> None:
    if chromium() is None:
        terminalreporter.write_line(WITHOUT)


@pytest.fixture(scope="session")
def browser() -> Iterator["Browser"]:
    """One Chromium for the whole run; where there is none the test is skipped and says why."""
    if (program := chromium()) is None:
        pytest.skip(WITHOUT)
    playwright = pytest.importorskip("playwright.sync_api", reason="The package playwright is not installed.")
    with playwright.sync_playwright() as driver:
        running = driver.chromium.launch(executable_path=program, args=FLAGS, timeout=2 * PATIENCE)
        yield running
        running.close()


@pytest.fixture(scope="session")
def book(browser: "Browser", tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the built book. It asks for the browser first: without one nothing need be built."""
    if "BOOK" in os.environ:
        return Path(os.environ["BOOK"]).resolve()
    folder = tmp_path_factory.mktemp("book")
    command = [
        sys.executable,
        "-m",
        "sphinx",
        "-q",
        "-b",
        "html",
        "-d",
        folder / "doctrees",
        "notebooks",
        folder / "html",
    ]
    subprocess.run(command, cwd=ROOT, check=True, timeout=300)
    return folder / "html"


class Quiet(SimpleHTTPRequestHandler):
    """A plain web server without a line for every file."""

    def log_message(self, format: str, *args: object) -> None:
        pass


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """The address under which a folder is served."""
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=folder)) as server:
        thread = threading.Thread(target=server.serve_forever, daemon=True)
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}"
        finally:
            server.shutdown()
            thread.join()


@pytest.fixture(scope="session")
def site(book: Path) -> Iterator[str]:
    """The built book on a plain web server."""
    with served(book) as address:
        yield address


@dataclass
class Visit:
    """A page with everything it said and asked for since it was opened."""

    page: "Page"
    home: str  # addresses that begin with this are the page's own
    complaints: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.page.set_default_timeout(PATIENCE)
        self.page.on("console", self.note)
        self.page.on("pageerror", lambda error: self.complaints.append(f"error: {error}"))
        self.page.on("requestfailed", lambda request: self.complaints.append(f"not loaded: {request.url}"))
        self.page.on("request", lambda request: self.requests.append(request.url))

    def note(self, message) -> None:
        about_speed = "GL Driver Message (OpenGL, Performance" in message.text  # drawing in software is slow
        if message.type in {"error", "warning", "assert"} and not about_speed:
            self.complaints.append(f"console {message.type}: {message.text}")

    def outside(self) -> list[str]:
        """Requests to anything but the page's own folder or server, and the page itself (data:, blob:)."""
        return [url for url in self.requests if not url.startswith((self.home, "data:", "blob:"))]

    def assert_quiet(self) -> None:
        assert self.complaints == []
        assert self.outside() == []


# Pictures wait for a reader to come near; this one wants them all.
ALL_PICTURES = """() => Promise.all([...document.images].map((image) => {
    image.loading = "eager";
    return image.decode().catch(() => {});
}))"""


def ready(page: "Page") -> None:
    """Wait until formulas, pictures, explorers and skeleton viewers are there, as if scrolled to."""
    page.evaluate("async () => { await window.MathJax?.startup?.promise }")
    page.evaluate(ALL_PICTURES)
    for explorer in page.locator(".psl-toy").all():
        explorer.scroll_into_view_if_needed()
        explorer.locator("xpath=self::*[@data-ready='true']").wait_for()
    for viewer in page.locator(".psl-viewer").all():
        viewer.scroll_into_view_if_needed()
        viewer.locator("xpath=self::*[@data-ready='true' and @data-frames]").wait_for()


@pytest.fixture
def visit(browser: "Browser") -> Iterator[Callable[..., Visit]]:
    """visit(home, path): a page in a fresh profile; keywords as for Playwright's `new_context`.

    `before` is a script that runs in the page ahead of its own.
    """
    with ExitStack() as stack:

        def open_page(home: str, path: str, before: str = "", **context: object) -> Visit:
            context = {"viewport": {"width": 1400, "height": 900}, "reduced_motion": "reduce"} | context
            profile = browser.new_context(**context)
            stack.callback(profile.close)
            visit = Visit(profile.new_page(), home)
            visit.page.add_init_script(before)
            visit.page.goto(f"{home}/{path}")
            if context.get("java_script_enabled", True):
                ready(visit.page)
            return visit

        yield open_page
