"""Explorers and viewer in a real JupyterLab: server and kernels of the test's own, mouse and keyboard."""

import json
import os
import re
import secrets
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import nbformat
import pytest
from accessibility import findings

import polyskel_lite as psl
from polyskel_lite import explore

pytestmark = pytest.mark.xdist_group("jupyterlab")  # one server
TOKEN = secrets.token_hex(16)
STARTS = 90  # seconds in which the server must answer
# No question about news, and none to the package index about a newer version.
SETTINGS = {"apputils-extension/notification": {"checkForUpdates": False, "fetchNews": "false"}}


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
        opened.page.locator(".jp-Notebook-ExecutionIndicator[data-status=idle]").wait_for()
        return opened

    return open_notebook


def run(page, number: int) -> str:
    """Run a cell and give back what it printed."""
    cell = page.locator(".jp-CodeCell").nth(number)
    cell.locator(".cm-content").first.click()
    page.keyboard.press("Shift+Enter")
    cell.locator(".jp-InputPrompt").get_by_text(re.compile(r"\[\d+\]")).wait_for()
    page.locator(".jp-Notebook-ExecutionIndicator[data-status=idle]").wait_for()
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
    handle.focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Shift+ArrowUp")
    check()
    assert len(set(texts)) == 3
    place = [float(handle.get_attribute(f"data-{axis}")) for axis in "xy"]
    assert [float(word) for word in run(page, 1).split()] == place
    assert findings(page, context=".psl-board") == []
    assert opened.outside() == []


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
    assert opened.outside() == []
