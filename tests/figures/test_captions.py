"""Words of the figures."""

from __future__ import annotations

import re

import pytest

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
