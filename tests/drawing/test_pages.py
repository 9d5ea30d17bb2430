"""How notebooks show figures: lines as lines, all else sharp and small."""

from __future__ import annotations

import base64
import io
import re
import sys
from types import SimpleNamespace

import numpy as np
from matplotlib.figure import Figure
from PIL import Image

from polyskel_lite import drawing
from polyskel_lite.drawing import pages


def opened(data: str) -> Image.Image:
    return Image.open(io.BytesIO(base64.b64decode(data)))


def test_lines_are_shown_as_lines():
    fig, ax = drawing.axes(letters=True)
    drawing.draw_lines(ax, [[(0, 0), (1, 0.123456789)]], "sk0")
    kind, data, (width, height) = drawing.picture(fig)
    assert kind == "image/svg+xml"
    assert f'width="{width}" height="{height}"' in data
    assert "<text" not in data  # a page may not have the font
    assert "<dc:date" not in data
    assert "scale(0.015625)" in data  # letters are as large as their places say
    assert not re.search(r"\.\d{3}", re.sub(r"scale\([^)]*\)", "", data.split("<defs>")[1]))
    assert drawing.picture(fig)[1] == data


def test_many_lines_and_pictures_in_space_are_shown_as_sharp_pixels():
    many, ax = drawing.axes()
    drawing.draw_lines(ax, np.random.default_rng(0).random((4000, 2, 2)), "sk0")
    space, _ = drawing.axes_3d()
    for figure in (many, space):
        kind, data, (width, height) = drawing.picture(figure)
        assert kind == "image/png"
        image = opened(data)
        assert (round(image.width / 2), round(image.height / 2)) == (width, height)
        assert round(image.info["dpi"][0]) == 2 * figure.dpi
        assert image.info["page"] == f"{width} x {height}"
        assert image.mode == "P"  # few colours: a third of the size


def test_white_stays_white():
    fig, ax = drawing.axes_3d()
    drawing.draw_facets_3d(ax, np.eye(3), [(0, 1, 2)], color="#FEFEFA", alpha=0.3)
    assert opened(drawing.picture(fig)[1]).convert("RGB").getpixel((0, 0)) == (255, 255, 255)


def test_a_notebook_shows_figures_so(monkeypatch):
    """The formatters of the notebook for figures give way to one that chooses."""

    class Formatter(dict):
        def for_type(self, kind, show):
            self[kind] = show

    png, bundle = Formatter({Figure: "pixels of the notebook's choice"}), Formatter()
    shell = SimpleNamespace(
        display_formatter=SimpleNamespace(formatters={"image/png": png}, mimebundle_formatter=bundle)
    )
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell))
    monkeypatch.setattr(pages.plt, "switch_backend", lambda name: None)
    pages.show_in_notebooks()
    assert Figure not in png
    fig, _ = drawing.axes()
    data, about = bundle[Figure](fig)
    assert set(data) == {"image/svg+xml", "text/plain"}
    assert about["image/svg+xml"]["width"] > 100
