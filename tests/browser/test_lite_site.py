"""The browser site of `make lite` in Chromium: JupyterLab opens, lists the chapters and shows one.

Its kernel is Pyodide from Pyodide's own address, which a test machine need not reach: every request to
another host is refused here, so no cell runs. tests/project/test_lite.py runs the library in Pyodide itself.
"""

import subprocess
import sys

import pytest
from jupyterlite_pyodide_kernel.constants import PYODIDE_VERSION

from .conftest import PATIENCE, ROOT, served

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
