"""The list of figures: each a function, with its caption and alt text."""

from __future__ import annotations

import base64
import functools
import inspect
import io
import json
import re
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping
from importlib import resources
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from PIL import Image

from .. import datasets
from ..drawing import RC, page_share, page_width, thin
from ..errors import InputError

#: Every figure function by name, in the paper's order: ``"figure_1"``, ``"figure_2"``, ``"figure_2_3d"`` ...
FIGURES: dict[str, Callable[..., Figure]] = {}


def paper_figure(draw: Callable[..., Figure]) -> Callable[..., Figure]:
    """Register a function as a figure of the paper, and draw it in the style of the book.

    The function gets two attributes from `captions.toml`: `caption`, what stands under the figure, and `alt`,
    what is to be seen, in words, for readers who cannot see it.

    Parameters
    ----------
    draw : function
        Data in, figure out; its name is the figure's.

    Examples
    --------
    >>> from polyskel_lite import figures
    >>> figures.FIGURES["figure_2"].caption.startswith("The three neighbourhood graphs")
    True
    """

    @functools.wraps(draw)
    def styled(*args, **kwargs) -> Figure:
        size, share = plt.rcParams["font.size"], page_share()
        with plt.rc_context(RC if share == 1 else RC | {"font.size": size}):
            figure = draw(*args, **kwargs)
            if share < 1:
                thin(figure, max(share, 0.6))
            interactive = plt.isinteractive()
        # The first figure of a notebook loads the backend, which switches interactive mode on; leaving the
        # context would switch it off again, and no later figure of the notebook would be shown.
        plt.interactive(interactive)
        return figure

    texts = _texts()[draw.__name__]
    styled.caption, styled.alt = (" ".join(texts[key].split()) for key in ("caption", "alt"))
    FIGURES[draw.__name__] = styled
    # Modules register in the order in which they are imported, which is not the paper's.
    for name in sorted(FIGURES, key=_place_in_paper):
        FIGURES[name] = FIGURES.pop(name)
    return styled


def _place_in_paper(name: str) -> tuple[int, str]:
    """The number in the name of a figure function, and what follows it."""
    _, number, rest = re.split(r"(\d+)", name, maxsplit=1)
    return int(number), rest


@functools.cache
def _texts() -> dict[str, dict[str, str]]:
    """The contents of `captions.toml`."""
    return tomllib.loads((resources.files(__package__) / "captions.toml").read_text(encoding="utf-8"))


#: Widths that journals print, in inches: one column of two, and both.
WIDTHS = {"single": 3.4, "double": 7.0}
#: Settings that only files for print need: edges as they are, so that a file is as wide as asked for; letters
#: stay letters, which can be searched, and edited by a printer.
PRINT = {"savefig.bbox": None, "savefig.dpi": 300, "svg.fonttype": "none"}


def write_figures(
    folder,
    names: Iterable[str] | None = None,
    formats: Iterable[str] = ("pdf", "svg", "png"),
    widths: Mapping[str, float] | None = None,
) -> Iterator[str]:
    """Draw figures with their default data and write them to a folder, with captions and a manifest.

    Many small clear faces stand in PDF and SVG as pixels, 300 an inch; all else is lines and letters. The
    same version of the library writes the same bytes.

    Parameters
    ----------
    folder : path
        Made if it is not there. ``captions.txt`` tells what stands under the figures and what is to be seen;
        ``manifest.json`` from which data, by which function and with which values each one was made, and what
        differs from the paper's.
    names : iterable of str, optional
        Keys of `FIGURES`; all by default.
    formats : iterable of str
        File types that matplotlib can write.
    widths : mapping of str to float, optional
        Widths in inches, by what is added to the names of files; by default `WIDTHS`.

    Yields
    ------
    str
        The name of each figure once its files are written, so that the caller can report progress.

    Raises
    ------
    InputError
        If there is no figure of that name.

    Examples
    --------
    >>> import tempfile
    >>> from polyskel_lite import figures
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     done = list(figures.write_figures(folder, ["figure_2"], ["png"]))
    ...     print(done, sorted(path.name for path in Path(folder).iterdir()))
    ['figure_2'] ['captions.txt', 'figure_2_double.png', 'figure_2_single.png', 'manifest.json']
    """
    names, formats, widths = list(FIGURES if names is None else names), list(formats), widths or WIDTHS
    unknown = [name for name in names if name not in FIGURES]
    if unknown:
        raise InputError(f"There is no figure called {unknown[0]!r}; choose among {', '.join(FIGURES)}.")
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    texts = [f"{name}\nCaption: {FIGURES[name].caption}\nAlt: {FIGURES[name].alt}\n" for name in names]
    (folder / "captions.txt").write_text("\n".join(texts), encoding="utf-8")
    manifest = {name: described(name) | {"inches": {}, "files": []} for name in names}
    for name in names:
        for word, inches in widths.items():
            with page_width(inches):
                figure = FIGURES[name]()
            manifest[name]["inches"][word] = figure.get_size_inches().round(4).tolist()
            with plt.rc_context(RC | PRINT):
                for suffix in formats:
                    # Without dates in the file the same figure gives the same bytes.
                    stamp = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}.get(suffix)
                    path = folder / f"{name}_{word}.{suffix}"
                    figure.savefig(path, metadata=stamp)
                    if suffix == "svg":
                        path.write_text(small_pictures(path.read_text(encoding="utf-8")), encoding="utf-8")
                    manifest[name]["files"].append(path.name)
            plt.close(figure)
        yield name
    text = json.dumps(manifest, indent=2, ensure_ascii=False)
    (folder / "manifest.json").write_text(text + "\n", encoding="utf-8")


def small_pictures(svg: str) -> str:
    """An SVG file whose embedded pictures have 256 colours each, a third of the size of all colours.

    Examples
    --------
    >>> small_pictures("<svg/>")
    '<svg/>'
    """

    def smaller(match: re.Match) -> str:
        picture, file = Image.open(io.BytesIO(base64.b64decode(match[1]))), io.BytesIO()
        few = picture.convert("RGBA").quantize(256, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
        few.save(file, "PNG", optimize=True)
        return f'data:image/png;base64,{base64.b64encode(file.getvalue()).decode()}"'

    return re.sub(r'data:image/png;base64,\s*([A-Za-z0-9+/=\s]+)"', smaller, svg)


def described(name: str) -> dict[str, Any]:
    """What a figure was made from: number in the paper, function, data, parameters, differences.

    Examples
    --------
    >>> from polyskel_lite import figures
    >>> entry = figures.registry.described("figure_4")
    >>> entry["function"], entry["parameters"]
    ('polyskel_lite.figures.figure_4', {'n': 18})
    """
    draw, texts = FIGURES[name], _texts()[name]
    # A parameter that is not given stands for the figure's own data, which the words tell.
    given = {key: p.default for key, p in inspect.signature(draw).parameters.items() if p.default is not None}
    sources = {key: datasets.info(key).splitlines() for key in texts["datasets"]}
    return {
        "paper": texts["paper"],
        "function": f"{__package__}.{name}",
        "data": " ".join(texts["data"].split()),
        "datasets": sources,
        "parameters": given,
        "differs from the paper": " ".join(texts["differs"].split()),
    }
