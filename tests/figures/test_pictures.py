"""The paper's figures look as they did when last looked at."""

from __future__ import annotations

import io
import re
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest

from polyskel_lite import figures

# The comparison is of layers, not of pixels: small pictures, and a tolerance (root mean square, of 255) under
# what the least layer of a figure makes (`test_tolerance_sees_every_layer`) and far over what last digits
# make, which differ between processors (0.0 for points moved by 1e-12). Another version of matplotlib draws
# fonts and edges otherwise (3.8: 1.5 to 14), so the pictures are compared under the version of the lock only.
TOLERANCE = 1.0
BASELINE_VERSION = "3.11"
SAVED = {"dpi": 40, "facecolor": "white"}
same_matplotlib = pytest.mark.skipif(
    not matplotlib.__version__.startswith(BASELINE_VERSION + "."),
    reason=f"the stored pictures are of matplotlib {BASELINE_VERSION}",
)


def compared(name: str):
    """Compare the returned figure with `baseline/NAME.png` (under ``pytest --mpl``)."""
    compare = pytest.mark.mpl_image_compare(
        baseline_dir="baseline",
        filename=f"{name}.png",
        style="default",
        tolerance=TOLERANCE,
        savefig_kwargs=SAVED,
    )
    return lambda test: same_matplotlib(compare(test))


@compared("figure_1")
def test_figure_1():
    return figures.figure_1()


@compared("figure_2")
def test_figure_2():
    return figures.figure_2()


@compared("figure_2_3d")
def test_figure_2_3d():
    return figures.figure_2_3d()


@compared("figure_3")
def test_figure_3():
    return figures.figure_3()


@compared("figure_4")
def test_figure_4():
    return figures.figure_4()


@compared("figure_5")
def test_figure_5():
    return figures.figure_5()


@compared("figure_6")
def test_figure_6():
    return figures.figure_6()


@compared("figure_7")
def test_figure_7():
    return figures.figure_7()


@compared("figure_8")
def test_figure_8():
    return figures.figure_8()


@compared("figure_9")
def test_figure_9():
    return figures.figure_9()


@compared("figure_10")
def test_figure_10():
    return figures.figure_10()


@compared("figure_11")
def test_figure_11():
    return figures.figure_11()


@compared("figure_12")
def test_figure_12():
    return figures.figure_12()


@compared("figure_13")
def test_figure_13():
    return figures.figure_13()


def pixels(figure) -> np.ndarray:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", **SAVED)
    buffer.seek(0)
    return plt.imread(buffer)[:, :, :3] * 255.0


def layers(figure) -> list:
    return [a for ax in figure.axes for a in [*ax.collections, *ax.patches, *ax.lines]]


@same_matplotlib
@pytest.mark.parametrize("name", ["figure_2", "figure_2_3d"])
def test_tolerance_sees_every_layer(name):
    """Hiding any one layer of these figures changes more than the tolerance."""
    with plt.style.context("default"):
        figure = figures.FIGURES[name]()
        whole = pixels(figure)
        for layer in layers(figure):
            layer.set_visible(False)
            changed = np.sqrt(((pixels(figure) - whole) ** 2).mean())
            layer.set_visible(True)
            assert changed > TOLERANCE, (type(layer).__name__, changed)


def test_stored_pictures_are_small_and_none_is_left_over():
    stored = {path.stem: path.stat().st_size for path in (Path(__file__).parent / "baseline").glob("*.png")}
    assert sorted(stored) == sorted(figures.FIGURES)
    assert max(stored.values()) < 120_000  # figure 10 has fifteen panels


def test_stored_pictures_belong_to_the_locked_matplotlib():
    """After an upgrade: make the pictures anew, look at them, and change BASELINE_VERSION.

    ``pytest tests/figures/test_pictures.py --mpl-generate-path=tests/figures/baseline`` makes them.
    """
    lock = Path(__file__).parents[2] / "requirements" / "test.lock"
    (version,) = re.findall(r"^matplotlib==(\S+)", lock.read_text(encoding="utf-8"), flags=re.MULTILINE)
    assert version.startswith(BASELINE_VERSION + ".")
