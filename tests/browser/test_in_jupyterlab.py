"""Explorers and viewer in a real JupyterLab: server and kernels of the test's own, mouse and keyboard."""

import json
import math
import os
import re
import runpy
import secrets
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import nbformat
import pytest

import polyskel_lite as psl
from polyskel_lite import explore

from .accessibility import findings

pytestmark = pytest.mark.xdist_group("jupyterlab")  # one server
ROOT = Path(__file__).resolve().parents[2]
TOKEN = secrets.token_hex(16)
STARTS = 90  # seconds in which the server must answer
# No question about news, and none to the package index about a newer version.
SETTINGS = {"apputils-extension/notification": {"checkForUpdates": False, "fetchNews": "false"}}
# `make lab` does not install it, older environments have it: it loses the mark that a solution opens.
DISABLED = {"disabledExtensions": {"jupyterlab-myst": True}}
# All that the console may say, and why.
KNOWN = {
    "@jupyterlite/": "The kernel of the browser site, which tests install as well, needs that site.",
}


@dataclass(frozen=True)
class Lab:
    """A running server: its address and the folder that it shows."""

    address: str
    folder: Path


def ask(address: str, method: str = "GET") -> bytes:
    headers = {"Authorization": f"token {TOKEN}"}
    with urllib.request.urlopen(
        urllib.request.Request(address, method=method, headers=headers), timeout=10
    ) as answer:
        return answer.read()


@pytest.fixture(scope="module")
def lab(browser, tmp_path_factory) -> Iterator[Lab]:
    """JupyterLab on a free port, with folders of its own for everything that it writes."""
    home, folder = tmp_path_factory.mktemp("home"), tmp_path_factory.mktemp("notebooks")
    for name, settings in SETTINGS.items():
        file = home / "settings" / "@jupyterlab" / f"{name}.jupyterlab-settings"
        file.parent.mkdir(parents=True)
        file.write_text(json.dumps(settings), encoding="utf-8")
    disabled = home / "config" / "labconfig" / "page_config.json"  # of labextension disable
    disabled.parent.mkdir(parents=True)
    disabled.write_text(json.dumps(DISABLED), encoding="utf-8")
    places = {
        "JUPYTER_CONFIG_DIR": home / "config",
        "JUPYTER_DATA_DIR": home / "data",
        "JUPYTER_RUNTIME_DIR": home / "runtime",
        "JUPYTERLAB_SETTINGS_DIR": home / "settings",
        "JUPYTERLAB_WORKSPACES_DIR": home / "workspaces",
        "IPYTHONDIR": home / "ipython",
        "JUPYTER_TOKEN": TOKEN,
    }
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    command = [sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root", "--ServerApp.ip=127.0.0.1"]
    command += [f"--ServerApp.port={port}", "--ServerApp.port_retries=0", f"--ServerApp.root_dir={folder}"]
    address, log = f"http://127.0.0.1:{port}", home / "log.txt"
    environment = {name: value for name, value in os.environ.items() if name != "MPLBACKEND"}
    environment |= {name: str(value) for name, value in places.items()}
    with (
        log.open("wb") as out,
        subprocess.Popen(command, cwd=home, env=environment, stdout=out, stderr=out) as server,
    ):
        try:
            until = time.monotonic() + STARTS
            while not answers(address):
                assert server.poll() is None, log.read_text()
                assert time.monotonic() < until, log.read_text()
                time.sleep(0.2)
            yield Lab(address, folder)
            ask(f"{address}/api/shutdown", "POST")  # its kernels with it
            server.wait(30)
        finally:
            server.kill()


def answers(address: str) -> bool:
    try:
        return bool(ask(f"{address}/api/status"))
    except urllib.error.URLError:
        return False


@pytest.fixture
def notebook(visit, lab) -> Callable:
    """notebook(name, *cells): a new notebook of these cells, open in JupyterLab, with its kernel at rest."""

    def open_notebook(name: str, *cells: str):
        book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
        book.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
        nbformat.write(book, lab.folder / f"{name}.ipynb")
        opened = visit(lab.address, f"lab/tree/{name}.ipynb?token={TOKEN}&reset")
        idle(opened.page)
        return opened

    return open_notebook


def idle(page) -> None:
    """Wait until the kernel is connected and at rest, as the line at the foot of the window says."""
    page.get_by_text("Python 3 (ipykernel) | Idle").wait_for()


def quiet(opened) -> None:
    """Nothing was asked of another host, and the console said nothing but what JupyterLab is known to say."""
    assert [text for text in opened.complaints if not any(known in text for known in KNOWN)] == []
    assert opened.outside() == []


def run(page, number: int) -> str:
    """Run a cell and give back what it printed."""
    cell = page.locator(".jp-CodeCell").nth(number)
    cell.locator(".cm-content").first.click()
    page.keyboard.press("Shift+Enter")
    cell.locator(".jp-InputPrompt").get_by_text(re.compile(r"\[\d+\]")).wait_for()
    idle(page)
    return "".join(cell.locator(".jp-OutputArea-output pre").all_inner_texts())


EXPLORER = """
from polyskel_lite import explore
explorer = explore.maximal_ball()
explorer
"""


def test_a_handle_is_dragged_and_the_numbers_agree(notebook):
    opened = notebook("explorer", EXPLORER.strip(), "print(*explorer.board.handles[0])")
    page = opened.page
    run(page, 0)
    board, handle = page.locator(".psl-board"), page.locator('.psl-handle[data-handle="0"]')
    shape = explore.maximal_ball().shape
    texts = []

    def check() -> None:
        page.locator('.psl-board[data-busy="false"]').wait_for()
        place = [float(handle.get_attribute(f"data-{axis}")) for axis in "xy"]
        texts.append(board.locator(".psl-text").inner_text())
        same = explore.maximal_ball(center=place)
        assert texts[-1] == same.board.text
        radius = float(shape.boundary_distance([place])[0])
        assert f"radius at the dot {radius:.4g}" in texts[-1]
        ball = board.locator('[data-layer="ball"] path').first.get_attribute("d")
        assert ball in same.board.picture("ball")

    check()
    box = handle.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 30, y + 10, steps=10)
    page.mouse.up()
    check()
    box = handle.bounding_box()
    assert (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2) == pytest.approx(
        (x - 30, y + 10), abs=1
    )
    handle.focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Shift+ArrowUp")
    check()
    assert len(set(texts)) == 3
    place = [float(handle.get_attribute(f"data-{axis}")) for axis in "xy"]
    assert [float(word) for word in run(page, 1).split()] == place
    assert findings(page, context=".psl-board") == []
    quiet(opened)


VIEWER = """
import polyskel_lite as psl
from polyskel_lite import explore
hierarchy = psl.hierarchy(psl.datasets.load("leaf"))
picture = explore.viewer(hierarchy, alt="A leaf.")
picture
"""


def test_the_viewer_and_python_tell_each_other_the_threshold(notebook):
    show = "print(picture.threshold, picture.counts()['branches'])"
    opened = notebook("viewer", VIEWER.strip(), "picture.threshold = 4.0", show)
    page, hierarchy = opened.page, psl.hierarchy(psl.datasets.load("leaf"))
    run(page, 0)
    root = page.locator(".psl-viewer[data-ready=true]")
    run(page, 1)
    page.locator('.psl-viewer[data-threshold="4"]').wait_for()
    assert int(root.get_attribute("data-branches")) == hierarchy.branches(4.0).graph["branches"]
    root.locator("[data-control=threshold]").press("PageDown")
    moved = float(root.get_attribute("data-threshold"))
    assert moved < 4
    threshold, branches = run(page, 2).split()
    assert float(threshold) == moved
    assert (
        int(branches)
        == int(root.get_attribute("data-branches"))
        == hierarchy.branches(moved).graph["branches"]
    )
    quiet(opened)


SOLID = """
import polyskel_lite as psl
from polyskel_lite import explore
picture = explore.viewer(psl.datasets.load("fourbranch"), alt="Four arms.")
picture
"""


def test_each_strategy_has_one_threshold_in_the_viewer_and_in_python(notebook):
    change = 'picture.threshold = 3.0; picture.strategy = "surface"'
    show = "print(*picture.thresholds.values(), picture.threshold)"
    opened = notebook("solid", SOLID.strip(), show, change, show)
    page = opened.page
    run(page, 0)
    root = page.locator(".psl-viewer[data-ready=true]")
    assert float(root.get_attribute("data-threshold")) == math.pi / 3
    root.locator("[data-control=threshold]").press("PageDown")
    moved = float(root.get_attribute("data-threshold"))
    root.locator("[data-control=strategy][value=wireframe]").check()
    assert float(root.get_attribute("data-threshold")) == 2 * math.pi
    assert run(page, 1).split() == [repr(moved), repr(2 * math.pi), repr(2 * math.pi)]
    run(page, 2)
    page.locator(f'.psl-viewer[data-strategy=surface][data-threshold="{moved}"]').wait_for()
    assert run(page, 3).split() == [repr(moved), "3.0", repr(moved)]
    root.locator("[data-control=strategy][value=wireframe]").check()
    page.locator('.psl-viewer[data-threshold="3"]').wait_for()
    assert opened.outside() == []


def test_an_uploaded_file_goes_through_the_whole_chain(notebook, tmp_path):
    leaf = psl.datasets.load("leaf")
    rings = [[*leaf.points[ring].tolist(), leaf.points[ring[0]].tolist()] for ring in leaf.rings()]
    files = {
        "place.geojson": {"type": "Point", "coordinates": [1, 2]},
        "leaf.geojson": {"type": "Polygon", "coordinates": rings},
    }
    for name, content in files.items():
        (tmp_path / name).write_text(json.dumps(content), encoding="utf-8")
    refused = explore.explore(tmp_path / "place.geojson").error
    hierarchy = explore.explore(tmp_path / "leaf.geojson").hierarchy

    opened = notebook("own", "from polyskel_lite import explore\nexplore.explore()")
    page = opened.page
    run(page, 0)
    for name, role in (("place.geojson", "alert"), ("leaf.geojson", "status")):
        with page.expect_file_chooser() as waiting:
            page.get_by_role("button", name="choose a file").click()
        waiting.value.set_files(tmp_path / name)
        words = (
            str(refused) if role == "alert" else f"leaf: {len(leaf.points)} vertices, Betti numbers (1, 0)."
        )
        page.get_by_role(role).get_by_text(words).wait_for()
    root = page.locator(".psl-viewer[data-ready=true]")
    root.locator("[data-control=threshold]").press("ArrowRight")
    threshold = float(root.get_attribute("data-threshold"))
    page.get_by_text(f"Branches at the threshold {threshold / math.pi:.3g} π").wait_for()
    lines = hierarchy.branches(threshold).number_of_edges()
    assert page.locator(".jp-OutputArea table tbody tr").count() == lines > 1
    page.get_by_role("button", name="make files to download").click()
    with page.expect_download() as waiting:
        page.get_by_role("link", name="leaf-skeleton.npz").click()
    skeleton = psl.Skeleton.load(waiting.value.path())
    assert len(skeleton.vertices) == len(hierarchy.skeleton(threshold).vertices)
    quiet(opened)


def solutions_open(page) -> None:
    """A solution is folded, says so with a mark, and opens and closes by keyboard."""
    page.keyboard.press("Control+End")
    solution = page.locator(".jp-RenderedMarkdown details", has_text="Solution of Exercise").last
    summary, first = solution.locator("summary"), solution.locator(":scope > :not(summary)").first
    summary.wait_for()
    assert summary.evaluate("(it) => getComputedStyle(it).display") == "list-item"  # what has a triangle
    for opens in (True, False):
        summary.press("Enter")
        first.wait_for(state="visible" if opens else "hidden")


@pytest.mark.parametrize("name", ["02_1_shapes", "claims"])
def test_a_working_copy_runs_from_top_to_bottom(visit, lab, book, name):
    """As `make lab` opens it: no role is left, the console is quiet, no cell fails, the sources stay."""
    sources = {path: path.read_bytes() for path in (ROOT / "notebooks").glob("*.ipynb")}
    working_copies = runpy.run_path(str(ROOT / "tools" / "working_copies.py"))
    working_copies["write"](lab.folder / "copies", book.parent / "doctrees")
    path = lab.folder / "copies" / "notebooks" / f"{name}.ipynb"
    copy = nbformat.read(path, as_version=4)
    for cell in copy.cells:
        cell |= {"outputs": [], "execution_count": None} if cell.cell_type == "code" else {}
    nbformat.write(copy, path)
    opened = visit(lab.address, f"lab/tree/copies/notebooks/{name}.ipynb?token={TOKEN}&reset")
    page = opened.page
    idle(page)
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
    until, code = time.monotonic() + 240, []
    while time.monotonic() < until and not (code and all(cell["execution_count"] for cell in code)):
        page.wait_for_timeout(2000)
        page.keyboard.press("Control+s")
        with suppress(nbformat.reader.NotJSONError):  # JupyterLab is just writing it
            code = [c for c in nbformat.read(path, as_version=4).cells if c.cell_type == "code"]
    assert all(cell["execution_count"] for cell in code)
    assert [o for cell in code for o in cell["outputs"] if o["output_type"] == "error"] == []
    assert page.locator(".jp-RenderedMarkdown", has_text=re.compile(r"\{\w+(:\w+)?\}`")).count() == 0
    solutions_open(page)
    assert sources == {path: path.read_bytes() for path in sources}
    quiet(opened)
