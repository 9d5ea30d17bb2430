"""One style: legends, letters, kinds that can be told apart."""

from __future__ import annotations

import itertools

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D

import polyskel_lite as psl
from polyskel_lite import drawing

POINTS = np.array([(0, 0), (4, 0), (5, 3), (2, 4), (-1, 2), (2, 1.5)], dtype=float)


def test_legend_takes_kinds_and_artists(ax):
    other = Line2D([], [], label="by hand")
    assert drawing.legend(ax, "shape", other, "sk2", labels={"shape": "X"}) is ax
    assert [t.get_text() for t in ax.get_legend().get_texts()] == ["X", "by hand", "$Sk_2$"]


def test_unknown_kind_names_the_known_ones(ax):
    with pytest.raises(psl.InputError, match="sk0"):
        drawing.draw_samples(ax, POINTS, kind="sk9")


def test_axes_come_in_reading_order_with_letters():
    figure, axs = drawing.axes(2, 2, letters=True)
    assert [ax.get_title(loc="left") for ax in axs] == ["(a)", "(b)", "(c)", "(d)"]
    assert figure.get_figwidth() == drawing.TEXT_WIDTH
    plt.close(figure)


def test_no_two_kinds_share_a_colour_or_a_line_pattern():
    lines = [kind for kind in drawing.KINDS.values() if kind.linestyle != "none" and kind.fill != "#EEEEEE"]
    colors = [kind.color for kind in drawing.KINDS.values()]
    assert len(set(colors)) == len(colors)
    # Delaunay edges, balls and skeletons are solid: thin, around areas, of three widths, the last one double.
    patterns = [(kind.linestyle, kind.linewidth, kind.core) for kind in lines]
    assert len(set(patterns)) == len(patterns)


def test_a_double_line_has_its_core_in_pictures_and_legends(ax):
    drawing.draw_lines(ax, [[(0, 0), (1, 1)]], "sk3")
    drawing.draw_lines(ax, [[(0, 0), (1, 1)]], "sk2")
    sk3 = drawing.KINDS["sk3"]
    widths = [float(line.get_linewidth()[0]) for line in ax.collections]
    assert widths == [sk3.linewidth, drawing.CORE * sk3.linewidth, drawing.KINDS["sk2"].linewidth]
    assert len(drawing.handle("sk3").get_path_effects()) == 2
    drawing.legend(ax, "sk3")
    ax.figure.set_dpi(300)  # or the core has no pixel of its own
    ax.figure.canvas.draw()
    pixels = np.asarray(ax.figure.canvas.buffer_rgba())[..., :3] / 255
    assert (np.abs(pixels - to_rgb(sk3.core)).max(axis=-1) < 0.02).any()


# How the loss of a kind of cone changes linear RGB: Machado, Oliveira, Fernandes, "A physiologically-based
# model for simulation of color vision deficiency", IEEE TVCG 15, 2009, severity 1.
VISION = {
    "usual": np.eye(3),
    "no red cone": [
        (0.152286, 1.052583, -0.204868),
        (0.114503, 0.786281, 0.099216),
        (-0.003882, -0.048116, 1.051998),
    ],
    "no green cone": [
        (0.367322, 0.860646, -0.227968),
        (0.280085, 0.672501, 0.047413),
        (-0.01182, 0.04294, 0.968881),
    ],
    "no blue cone": [
        (1.255528, -0.076749, -0.178779),
        (-0.078411, 0.930809, 0.147602),
        (0.004733, 0.691367, 0.3039),
    ],
}


def lab(color: str, matrix) -> np.ndarray:
    """CIE L*a*b* of a colour as seen through a colour vision matrix."""
    rgb = np.array(to_rgb(color))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    seen = np.clip(np.array(matrix) @ linear, 0, 1)
    to_xyz = [(0.41246, 0.35758, 0.18044), (0.21267, 0.71515, 0.07217), (0.01933, 0.11919, 0.9503)]
    xyz = np.array(to_xyz) @ seen / (0.95047, 1, 1.08883)
    f = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


@pytest.mark.parametrize("vision", VISION)
def test_kinds_can_be_told_apart_with_any_colour_vision(vision):
    """A difference of 10 in L*a*b* is about four times what is just noticed."""
    colors = {name: lab(kind.color, VISION[vision]) for name, kind in drawing.KINDS.items()}
    close = {
        pair: round(float(np.linalg.norm(colors[pair[0]] - colors[pair[1]])), 1)
        for pair in itertools.combinations(colors, 2)
    }
    assert min(close.values()) > 10, min(close, key=close.get)


def test_a_narrow_page_has_smaller_panels_and_thinner_lines_but_not_smaller_letters_than_can_be_read():
    with drawing.page_width(3.5) as share:
        fig, axs = drawing.axes(2, height=2.3, letters=True)
        drawing.draw_lines(axs[0], [[(0, 0), (1, 1)]], "sk0")
        drawing.say(axs[0], "words")
        drawing.thin(fig, share)
    assert fig.get_size_inches()[0] == 3.5
    assert axs[0].texts[0].get_fontsize() == 7
    assert axs[0].collections[0].get_linewidth() == [0.5 * drawing.KINDS["sk0"].linewidth]
    wide, _ = drawing.axes(2, height=2.3)
    assert wide.get_size_inches()[0] == drawing.TEXT_WIDTH
