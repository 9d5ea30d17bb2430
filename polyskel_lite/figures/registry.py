"""The list of figures: each a function, with its caption and alt text."""

from __future__ import annotations

import functools
import re
import tomllib
from collections.abc import Callable, Iterable, Iterator
from importlib import resources
from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from ..drawing import RC
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
        with plt.rc_context(RC):
            figure = draw(*args, **kwargs)
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


def write_figures(
    folder, names: Iterable[str] | None = None, formats: Iterable[str] = ("pdf", "svg", "png")
) -> Iterator[str]:
    """Draw figures with their default data and write them to a folder, with a file of captions and alt texts.

    Parameters
    ----------
    folder : path
        Made if it is not there.
    names : iterable of str, optional
        Keys of `FIGURES`; all by default.
    formats : iterable of str
        File types that matplotlib can write.

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
    ['figure_2'] ['captions.txt', 'figure_2.png']
    """
    names = list(FIGURES if names is None else names)
    unknown = [name for name in names if name not in FIGURES]
    if unknown:
        raise InputError(f"There is no figure called {unknown[0]!r}; choose among {', '.join(FIGURES)}.")
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    texts = [f"{name}\nCaption: {FIGURES[name].caption}\nAlt: {FIGURES[name].alt}\n" for name in names]
    (folder / "captions.txt").write_text("\n".join(texts), encoding="utf-8")
    for name in names:
        figure = FIGURES[name]()
        with plt.rc_context(RC):
            for suffix in formats:
                # Without dates in the file the same figure gives the same bytes.
                stamp = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}.get(suffix)
                figure.savefig(folder / f"{name}.{suffix}", metadata=stamp)
        plt.close(figure)
        yield name
