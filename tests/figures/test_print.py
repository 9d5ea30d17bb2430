"""Files for print: sizes, letters, weights, the same twice, and the list of what each was made from."""

from __future__ import annotations

import inspect
import json
import re
import struct
from xml.etree import ElementTree

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axis import Axis

import polyskel_lite as psl
from polyskel_lite import drawing, figures

LIGHT = ["figure_2", "figure_7"]  # drawn in no time: one of the plane, one of space
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """A folder with two light figures in all formats and widths."""
    folder = tmp_path_factory.mktemp("figures") / "new"
    assert list(figures.write_figures(folder, LIGHT)) == LIGHT
    return folder


def test_files_are_named_after_figure_and_width(written):
    names = [
        f"{name}_{width}.{suffix}"
        for name in LIGHT
        for width in ("single", "double")
        for suffix in ("pdf", "png", "svg")
    ]
    assert sorted(path.name for path in written.iterdir()) == sorted(
        [*names, "captions.txt", "manifest.json"]
    )
    assert figures.figure_7.alt in (written / "captions.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", LIGHT)
@pytest.mark.parametrize(("width", "inches"), figures.WIDTHS.items())
def test_files_are_exactly_as_wide_as_a_column(written, name, width, inches):
    stem = written / f"{name}_{width}"
    across, _ = struct.unpack(">II", stem.with_suffix(".png").read_bytes()[16:24])
    assert across == round(300 * inches)
    root = ElementTree.parse(stem.with_suffix(".svg")).getroot()
    assert float(root.get("width").removesuffix("pt")) == pytest.approx(72 * inches)
    box = re.search(rb"/MediaBox \[ ([^\]]+)\]", stem.with_suffix(".pdf").read_bytes())[1]
    assert float(box.split()[2]) == pytest.approx(72 * inches)


def test_letters_stay_letters(written):
    words = [text.text for text in ElementTree.parse(written / "figure_2_double.svg").iter(f"{SVG}text")]
    assert {"(a)", "(b)", "(c)", "Voronoi", "Delaunay", "Gabriel"} <= set(words)


def test_the_same_figures_make_the_same_files(written, tmp_path):
    list(figures.write_figures(tmp_path, LIGHT))
    for path in written.iterdir():
        assert (tmp_path / path.name).read_bytes() == path.read_bytes(), path.name


@pytest.mark.parametrize(("name", "most"), [("figure_10", 2e6), ("figure_12", 0.5e6)])
def test_glass_does_not_make_files_heavy(tmp_path, name, most):
    """As lines, figure 10 had 18.5 MB and figure 12 had 5.6 MB."""
    list(figures.write_figures(tmp_path, [name], ["svg"], {"double": 7.0}))
    svg = (tmp_path / f"{name}_double.svg").read_text(encoding="utf-8")
    assert "data:image/png;base64" in svg
    assert len(svg) < most


@pytest.mark.parametrize("name", figures.FIGURES)
@pytest.mark.parametrize("inches", figures.WIDTHS.values())
def test_nothing_is_cut_off_at_the_edges(name, inches):
    """Of text all is on the page; of lines and faces only what runs on: rays, and the rest of a shape."""
    with drawing.page_width(inches):
        figure = figures.FIGURES[name]()
    figure.canvas.draw()
    page = figure.bbox.padded(1)
    axes = [axis for ax in figure.axes if not ax.axison for axis in ax.findobj(Axis)]
    unseen = [text for axis in axes for text in axis.findobj(plt.Text)]
    for text in figure.findobj(plt.Text):
        if text.get_text() and text not in unseen:
            box = text.get_window_extent()
            assert page.contains(box.x0, box.y0), text
            assert page.contains(box.x1, box.y1), text
    if name not in ("figure_2", "figure_2_3d", "figure_3", "figure_9"):
        pixels = np.asarray(figure.canvas.buffer_rgba())[:, :, :3]
        rim = np.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
        assert (rim > 250).all()


def test_letters_are_large_enough_to_read():
    for inches in figures.WIDTHS.values():
        with drawing.page_width(inches):
            figure = figures.figure_8()
        sizes = [text.get_fontsize() for text in figure.findobj(plt.Text) if text.get_text()]
        assert min(sizes) >= 7


def test_manifest_tells_what_every_figure_was_made_from(tmp_path):
    manifest = {name: figures.described(name) for name in figures.FIGURES}
    assert list(manifest) == list(figures.FIGURES)
    for name, entry in manifest.items():
        assert re.match(r"Fig\. \d+|none \(", entry["paper"])
        assert entry["function"] == f"polyskel_lite.figures.{name}"
        assert len(entry["data"]) > 20
        assert entry["differs from the paper"].endswith(".")
        named = {
            word
            for word in psl.datasets.names()
            if re.search(rf"\b{word}\b", inspect.getsource(figures.FIGURES[name]))
        }
        named |= set(figures.results.CAMERAS) if name == "figure_10" else set()
        assert set(entry["datasets"]) == named
        for key in entry["parameters"]:
            assert key in inspect.signature(figures.FIGURES[name]).parameters
    json.dumps(manifest)


def test_manifest_stands_beside_the_files(written):
    manifest = json.loads((written / "manifest.json").read_text(encoding="utf-8"))
    assert list(manifest) == LIGHT
    assert manifest["figure_2"]["inches"]["single"][0] == 3.4
    for entry in manifest.values():
        assert len(entry["files"]) == 6
        assert all((written / name).exists() for name in entry["files"])


def test_unknown_figure_is_refused(tmp_path):
    with pytest.raises(psl.InputError, match="figure_99"):
        list(figures.write_figures(tmp_path, ["figure_99"]))
