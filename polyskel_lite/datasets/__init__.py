"""Outlines to work with, each with its source and licence.

All of them are free to share. The outlines were smoothed a little, sampled uniformly, moved to the
origin and scaled so that the diagonal of the bounding box is 1.

Examples
--------
>>> names()
['elephant', 'gear', 'hawaii', 'horse', 'kangaroo', 'lake', 'leaf']
"""

from __future__ import annotations

import tomllib
from difflib import get_close_matches
from functools import cache
from importlib.resources import files

import numpy as np

from ..errors import InputError
from ..shapes import Shape

__all__ = ["info", "load", "names"]


def names() -> list[str]:
    """List the names of the shapes, in alphabetical order.

    Returns
    -------
    list of str

    Examples
    --------
    >>> "horse" in names()
    True
    """
    return sorted(_records())


def load(name: str, n: int | None = None) -> Shape:
    """Load a shape by its name.

    Parameters
    ----------
    name : str
        One of `names()`.
    n : int, optional
        The number of samples on all rings together, uniform by arc length along the finest outline
        there is. Without it, the stored samples: enough for all edges to be Delaunay edges.

    Returns
    -------
    Shape
        The diagonal of its bounding box is 1.

    Raises
    ------
    InputError
        If there is no such name, or `n` is less than three a ring.
    ShapeError
        If the polygon through so few samples crosses itself.

    Examples
    --------
    >>> lake = load("lake")
    >>> len(lake.points), lake.betti()
    (1000, (1, 2))
    >>> len(load("lake", n=300).points)
    300
    """
    _record(name)
    if n is None:
        return Shape.from_rings(_rings(name, "xy", "off"))
    return Shape.from_rings(_rings(name, "fine_xy", "fine_off")).resample(n)


def info(name: str) -> str:
    """Describe a shape: what it is, its size, its source and its licence line.

    Parameters
    ----------
    name : str
        One of `names()`.

    Returns
    -------
    str
        Three lines, to print.

    Raises
    ------
    InputError
        If there is no such name.

    Examples
    --------
    >>> print(info("horse"))
    horse: a standing horse (400 samples, 1 ring)
    source: scikit-image 0.26.0, skimage/data/horse.png
    licence: CC0 1.0, credit: Andreas Preuss (marauder)
    """
    record, rings = _record(name), _rings(name, "xy", "off")
    size = f"{sum(map(len, rings))} samples, {len(rings)} ring{'s' if len(rings) > 1 else ''}"
    return (
        f"{name}: {record['what']} ({size})\n"
        f"source: {record['source']}\n"
        f"licence: {record['licence']}, credit: {record['credit']}"
    )


@cache
def _records() -> dict[str, dict[str, str]]:
    return tomllib.loads((files(__package__) / "LICENCES.toml").read_text(encoding="utf-8"))


def _record(name: str) -> dict[str, str]:
    records = _records()
    if name not in records:
        near = get_close_matches(str(name).lower(), records, n=1, cutoff=0.0)[0]
        raise InputError(
            f"There is no shape called {name!r}; did you mean {near!r}? The names are {', '.join(names())}."
        )
    return records[name]


def _rings(name: str, points: str, offsets: str) -> list[np.ndarray]:
    with (files(__package__) / f"{name}.npz").open("rb") as stream, np.load(stream) as data:
        return np.split(data[points].astype(np.float64), data[offsets][1:-1])
