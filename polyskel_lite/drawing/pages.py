"""How notebooks and pages show a figure: as lines where it is made of lines, else as twice as many pixels.

A notebook shows figures as pixels of its own choice: too few for a sharp screen. `setup` has them shown by
`picture`; nothing of it is to be seen in a cell.
"""

from __future__ import annotations

import base64
import io
import re
import sys

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure
from PIL import Image
from PIL.PngImagePlugin import PngInfo

#: Pictures of lines that would be larger than this, in bytes, are shown as pixels.
LARGEST = 200_000
#: Pictures of pixels that would be larger than this have one and a half for one.
LARGEST_PIXELS = 300_000


def picture(figure: Figure) -> tuple[str, str, tuple[int, int]]:
    """A figure as SVG, where it is made of few lines in the plane, else as PNG with two pixels for one.

    Parameters
    ----------
    figure : Figure

    Returns
    -------
    kind : str
        ``"image/svg+xml"`` or ``"image/png"``.
    data : str
        The text of the SVG file; the PNG file in base 64, with at most 256 colours.
    size : pair of int
        Width and height on a page, in pixels of the page.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes()
    >>> drawing.picture(fig)[0]
    'image/svg+xml'
    >>> plt.close(fig)
    """
    if not any(ax.name == "3d" for ax in figure.axes):
        svg, size = _lines(figure)
        if len(svg) <= LARGEST:
            return "image/svg+xml", svg, size
    return "image/png", *_pixels(figure)


def _pixels(figure: Figure) -> tuple[str, tuple[int, int]]:
    """The PNG file of a figure in base 64, of 256 colours and two pixels for one; its size on a page."""
    for sharpness in (2, 1.5):
        data, size = _sharp(figure, sharpness)
        if len(data) <= LARGEST_PIXELS:
            break
    return base64.b64encode(data).decode(), size


def _sharp(figure: Figure, sharpness: float) -> tuple[bytes, tuple[int, int]]:
    """The PNG file of a figure with so many pixels for one, and its size on a page."""
    file, small, dpi = io.BytesIO(), io.BytesIO(), sharpness * figure.dpi
    figure.savefig(file, format="png", dpi=dpi, bbox_inches="tight")
    pixels = Image.open(file).convert("RGB")
    few = pixels.quantize(256, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    # One of the few colours stands for white and what is near it; on a page it has to be white.
    colors, ground = list(few.getpalette() or []), 3 * int(np.asarray(few)[0, 0])
    colors[ground : ground + 3] = np.asarray(pixels)[0, 0].tolist()
    few.putpalette(colors)
    size, said = (round(pixels.width / sharpness), round(pixels.height / sharpness)), PngInfo()
    said.add_text("page", f"{size[0]} x {size[1]}")  # for tools/lighten.py
    few.save(small, "PNG", optimize=True, dpi=(dpi, dpi), pnginfo=said)
    return small.getvalue(), size


def _lines(figure: Figure) -> tuple[str, tuple[int, int]]:
    """The SVG file of a figure, places rounded to a hundredth of a point, and its size on a page."""
    file = io.StringIO()
    # Letters as lines: a page may not have the font, and formulas would fall apart.
    with plt.rc_context({"svg.fonttype": "path", "svg.hashsalt": "polyskel_lite"}):
        figure.savefig(file, format="svg", bbox_inches="tight", metadata={"Date": None})
    # Two decimals are enough for places, not for the scale of letters.
    svg = re.sub(r"scale\([^)]*\)|(\.\d\d)\d+", lambda found: found[1] or found[0], file.getvalue())
    svg = re.sub(r"\s*\n\s*", " ", svg).strip()  # one line of a notebook's file, and not thousands
    width, height = (
        round(float(points) * figure.dpi / 72) for points in re.findall(r'="([\d.]+)pt"', svg)[:2]
    )
    return re.sub(r'width="[\d.]+pt" height="[\d.]+pt"', f'width="{width}" height="{height}"', svg), (
        width,
        height,
    )


def show_in_notebooks() -> None:
    """Have the notebook that runs, if one does, show figures by `picture`.

    Examples
    --------
    >>> show_in_notebooks()     # here is no notebook
    """
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    if shell is None:
        return
    plt.switch_backend(
        plt.get_backend()
    )  # loads it now, for it brings its own way of showing figures with it
    for formatter in shell.display_formatter.formatters.values():
        formatter.pop(Figure, None)
    shell.display_formatter.mimebundle_formatter.for_type(Figure, _bundle)


def _bundle(figure: Figure, include=None, exclude=None) -> tuple[dict, dict]:
    """The data of a figure for IPython, by kind, and what is to be known of them."""
    kind, data, (width, height) = picture(figure)
    return {kind: data, "text/plain": repr(figure)}, {kind: {"width": width, "height": height}}
