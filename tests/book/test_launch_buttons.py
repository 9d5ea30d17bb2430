"""Launch buttons: from one setting in book.toml, and none without it."""

import json
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CHAPTER = {
    "cells": [{"cell_type": "markdown", "id": "title", "metadata": {}, "source": "# One\n\nText."}],
    "metadata": {
        "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
        "language_info": {"name": "python"},
    },
    "nbformat": 4,
    "nbformat_minor": 5,
}


class Links(HTMLParser):
    """Where a page links to, and what it says."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.targets: set[str] = set()
        self.text = ""
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        if tag == "a":
            self.targets.add(dict(attrs).get("href") or "")

    def handle_data(self, data):
        self.text += data

    def outside(self) -> set[str]:
        return {link for link in self.targets if "://" in link or link.startswith("../")}


def small_book(folder: Path, settings: str) -> dict[str, Links]:
    """A book of one chapter and one page of text, with the real conf.py and the given lines in book.toml."""
    notebooks = folder / "notebooks"
    notebooks.mkdir()
    for path in (ROOT / "notebooks").iterdir():
        if path.suffix not in (".ipynb", ".md") and path.name != "course":
            (notebooks / path.name).symlink_to(path)
    (notebooks / "conf.py").unlink()
    (notebooks / "conf.py").write_text((ROOT / "notebooks" / "conf.py").read_text(encoding="utf-8"))
    for name in ("polyskel_lite", "tools"):
        (folder / name).symlink_to(ROOT / name)
    toml = (ROOT / "book.toml").read_text(encoding="utf-8")
    begin, end = toml.index("[toc]"), toml.index("# Handed on")
    toc = '[toc]\nformat = "jb-book"\nroot = "one"\nchapters = [{ file = "two" }]\n\n'
    (folder / "book.toml").write_text(toml[:begin].rstrip() + f"\n{settings}\n" + toc + toml[end:])
    (notebooks / "one.ipynb").write_text(json.dumps(CHAPTER))
    (notebooks / "two.md").write_text("# Two\n\nText.\n")
    command = [sys.executable, "-m", "sphinx", "-W", "-q", "-b", "html", notebooks, folder / "html"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return {name: Links(folder / "html" / f"{name}.html") for name in ("one", "two")}


def test_without_a_repository_no_page_links_outside(tmp_path):
    pages = small_book(tmp_path, "")
    assert not pages["one"].outside() | pages["two"].outside()
    assert "Colab" not in pages["one"].text


def test_launch_buttons_of_a_copy_on_github(tmp_path):
    home = "https://github.com/someone/skeletons"
    pages = small_book(tmp_path, f'repository = "{home}"\nlite = "../lite/lab/index.html"\n')
    assert pages["one"].outside() == {
        home,
        "https://mybinder.org/v2/gh/someone/skeletons/main?urlpath=lab/tree/notebooks/one.ipynb",
        "https://colab.research.google.com/github/someone/skeletons/blob/main/notebooks/one.ipynb",
        "../lite/lab/index.html?path=notebooks/one.ipynb",
    }
    assert f'%pip install -q "polyskel-lite[graph,files,meshes] @ git+{home}@main"' in pages["one"].text
    # A page without cells has nothing to launch.
    assert pages["two"].outside() == {home}
    assert "Colab" not in pages["two"].text


def test_a_copy_on_gitlab_has_binder_and_no_colab(tmp_path):
    home = "https://gitlab.com/someone/skeletons"
    page = small_book(tmp_path, f'repository = "{home}"')["one"]
    launch = "https://mybinder.org/v2/gl/someone%2Fskeletons/main?urlpath=lab/tree/notebooks/one.ipynb"
    assert page.outside() == {home, launch}
    assert "Colab" not in page.text


def test_a_copy_elsewhere_has_only_what_it_brings_itself(tmp_path):
    home, lite = "https://git.example.org/someone/skeletons", "../lite/lab/index.html"
    settings = f'repository = "{home}"\nprovider = "gitlab"\nlite = "{lite}"'
    assert small_book(tmp_path, settings)["one"].outside() == {home, f"{lite}?path=notebooks/one.ipynb"}
