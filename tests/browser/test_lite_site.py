"""The browser site of `make lite` in Chromium: JupyterLab lists the chapters, shows one, and runs some.

Its kernel is Pyodide from Pyodide's own address, which a test machine need not reach. So cells run in a
second site that brings its own, and every request of the first one to another host is refused.
"""

import json
import re
import subprocess
import sys

import pytest
from jupyterlite_pyodide_kernel.constants import PYODIDE_VERSION

from .conftest import PATIENCE, ROOT, served

expect = pytest.importorskip("playwright.sync_api").expect

pytestmark = pytest.mark.xdist_group("lite")


@pytest.fixture(scope="module")
def lite(browser, tmp_path_factory):
    """The address of a fresh site. It asks for the browser first: without one nothing need be built."""
    folder = tmp_path_factory.mktemp("lite") / "site"
    subprocess.run(
        [sys.executable, "tools/build_lite.py", "--output", folder], cwd=ROOT, check=True, timeout=300
    )
    with served(folder) as address:
        yield address


@pytest.fixture(scope="module")
def whole_lite(browser, tmp_path_factory):
    """A site that brings its own Pyodide; skipped where tools/fetch_pyodide.py has not brought one."""
    pyodide = ROOT / "_build" / "pyodide"
    if not (pyodide / "wheels").exists():
        pytest.skip("no Pyodide here: run tools/fetch_pyodide.py.")
    folder = tmp_path_factory.mktemp("whole") / "site"
    command = [sys.executable, "tools/build_lite.py", "--output", folder]
    command += ["--pyodide", pyodide, "--wheels", pyodide / "wheels"]
    subprocess.run(command, cwd=ROOT, check=True, timeout=300)
    with served(folder) as address:
        yield address


def test_lab_opens_lists_the_chapters_and_shows_one(browser, lite):
    outside = []
    with browser.new_context(viewport={"width": 1400, "height": 900}) as profile:

        def answer(route):
            if route.request.url.startswith((lite, "data:", "blob:")):
                route.fallback()
            else:
                outside.append(route.request.url)
                route.abort()

        profile.route("**/*", answer)
        page = profile.new_page()
        page.set_default_timeout(2 * PATIENCE)
        page.goto(f"{lite}/lab/index.html?path=notebooks/index.ipynb")
        page.locator(".jp-Notebook h1", has_text="Continuous skeletons").wait_for()
        page.locator(".jp-Notebook", has_text="Python in your browser").wait_for()
        page.locator(".jp-RenderedImage img, .jp-RenderedSVG").first.wait_for()  # stored outputs are there
        listed = page.locator(".jp-DirListing-itemText").all_inner_texts()
        chapters = {path.name for path in (ROOT / "notebooks").glob("*.ipynb")}
        assert chapters <= {name.strip() for name in listed}
    assert all(f"/pyodide/v{PYODIDE_VERSION}/" in url for url in outside), outside


@pytest.fixture
def opened(browser, whole_lite):
    """opened(name): a chapter in the site that brings its own Pyodide, with its kernel at rest."""
    with browser.new_context(viewport={"width": 1400, "height": 900}) as profile:
        page, asked = profile.new_page(), []
        page.on("request", lambda request: asked.append(request.url))

        def open_chapter(name: str):
            page.goto(f"{whole_lite}/lab/index.html?path=notebooks/{name}.ipynb")
            page.locator(".jp-Notebook h1").first.wait_for(timeout=4 * PATIENCE)
            page.get_by_text("Python (Pyodide) | Idle").wait_for(timeout=180_000)
            return page

        yield open_chapter
        assert [url for url in asked if not url.startswith((whole_lite, "data:", "blob:"))] == []


@pytest.mark.parametrize("name", ["A_2_theorem_3", "claims"])
def test_a_chapter_runs_in_the_browser(opened, name):
    """Kernel, library, widgets and files from the site alone: every cell runs, none fails, handles move.

    One cell of the claims page needs scikit-image, which a site that brings its own Pyodide may lack.
    """
    page = opened(name)
    page.get_by_role("menuitem", name="Edit", exact=True).click()
    page.get_by_role("menuitem", name="Clear Outputs of All Cells", exact=True).click()
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
    page.get_by_text("Python (Pyodide) | Busy").wait_for(timeout=4 * PATIENCE)
    page.get_by_text("Python (Pyodide) | Idle").wait_for(timeout=240_000)
    assert page.locator(".jp-OutputArea-output[data-mime-type$='jupyter.error']").count() == 0
    assert page.locator(".jp-OutputArea-output").count() > 0  # all were cleared
    assert page.locator(".jp-CodeCell .jp-InputPrompt", has_text=re.compile(r"^\[[ *]\]:$")).count() == 0
    lock = json.loads((ROOT / "_build" / "pyodide" / "pyodide-lock.json").read_text(encoding="utf-8"))
    said = page.get_by_text("This cell needs scikit-image, which is not in this site.").count()
    assert said == (name == "claims" and "scikit-image" not in lock["packages"])
    board = page.locator(".psl-board:has(.psl-handle)").first
    assert board.count() or name != "A_2_theorem_3"
    if board.count():
        notebook = page.locator(".jp-WindowedPanel-outer")  # shows only the cells that are near
        notebook.evaluate("(it) => { it.scrollTop = 0 }")
        while not board.is_visible():
            notebook.evaluate("(it) => { it.scrollTop += 400 }")
            page.wait_for_timeout(200)
        before = board.locator(".psl-text").inner_text()
        board.locator(".psl-handle").first.press("Shift+ArrowRight")
        expect(board.locator(".psl-text")).not_to_have_text(before, timeout=PATIENCE)
