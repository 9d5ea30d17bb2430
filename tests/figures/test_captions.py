"""Words of the figures, and the files they are written to."""

from __future__ import annotations

import re

import pytest

import polyskel_lite as psl
from polyskel_lite import figures


@pytest.mark.parametrize("name", figures.FIGURES)
def test_every_figure_has_caption_and_alt_text(name):
    draw = figures.FIGURES[name]
    assert 100 < len(draw.alt) < 600
    assert 100 < len(draw.caption) < 900
    assert draw.caption != draw.alt
    for text in (draw.caption, draw.alt):
        assert "\n" not in text
        assert "  " not in text
        assert text.endswith(".")


@pytest.mark.parametrize("name", figures.FIGURES)
def test_captions_name_the_panels_that_there_are(name):
    draw = figures.FIGURES[name]
    figure = draw()
    drawn = {ax.get_title(loc="left") for ax in figure.axes} | {
        t.get_text() for ax in figure.axes for t in ax.texts
    }
    drawn = {text for text in drawn if re.fullmatch(r"\([a-z]\)", text)}
    named = set(re.findall(r"(?<!\w)\([a-z]\)", draw.caption))  # A(v) is no panel
    if "(b) to (e)" in draw.caption:
        named |= {"(c)", "(d)"}
    assert drawn == named


def test_writing_figures_makes_files_and_captions(tmp_path):
    names = ["figure_2", "figure_13"]
    assert list(figures.write_figures(tmp_path / "new", names, ["svg"])) == names
    assert sorted(p.name for p in (tmp_path / "new").iterdir()) == [
        "captions.txt",
        "figure_13.svg",
        "figure_2.svg",
    ]
    text = (tmp_path / "new" / "captions.txt").read_text(encoding="utf-8")
    assert figures.figure_13.alt in text
    assert "figure_1\n" not in text


def test_the_same_figure_makes_the_same_file(tmp_path):
    for folder in ("once", "twice"):
        list(figures.write_figures(tmp_path / folder, ["figure_2"], ["svg", "pdf"]))
    for suffix in ("svg", "pdf"):
        first, second = (
            (tmp_path / folder / f"figure_2.{suffix}").read_bytes() for folder in ("once", "twice")
        )
        assert first == second


def test_unknown_figure_is_refused(tmp_path):
    with pytest.raises(psl.InputError, match="figure_99"):
        list(figures.write_figures(tmp_path, ["figure_99"]))
