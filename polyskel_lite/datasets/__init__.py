"""Outlines and solids to work with, each with its source and licence.

All of them are free to share. The outlines were smoothed a little and sampled uniformly, the surfaces
of the solids remeshed uniformly with all triangles in the Delaunay tessellation; all were moved to the
origin and scaled so that the diagonal of the bounding box is 1.

Examples
--------
>>> names()
['elephant', 'gear', 'hawaii', 'horse', 'kangaroo', 'lake', 'leaf']
>>> names(dimension=3)
['chromosome', 'fourbranch', 'metacarpal', 'vertebra']
"""

from __future__ import annotations

import tomllib
from difflib import get_close_matches
from functools import cache
from importlib.resources import files
from numbers import Integral

import numpy as np

from ..checks import shown
from ..errors import InputError
from ..shapes import Shape

__all__ = ["info", "load", "names"]

# The arrays of an outline and of a solid: points of all rings and where rings begin; vertices and faces.
_KEYS = {2: {"xy", "off"}, 3: {"V", "F"}}


def names(dimension: int | None = 2) -> list[str]:
    """List the names of the outlines (2D), the solids (3D) or all shapes, in alphabetical order.

    Parameters
    ----------
    dimension : 2, 3 or None
        None: all.

    Returns
    -------
    list of str

    Examples
    --------
    >>> "horse" in names()
    True
    """
    if not (dimension is None or (isinstance(dimension, Integral) and dimension in (2, 3))):
        raise InputError(f"dimension is {shown(dimension)}; choose 2 (outlines), 3 (solids) or None (all).")
    return sorted(
        name for name in _records() if dimension is None or _arrays(name).keys() >= _KEYS[dimension]
    )


def load(name: str, n: int | None = None) -> Shape:
    """Load a shape by its name.

    Parameters
    ----------
    name : str
        One of `names(None)`.
    n : int, optional
        Outlines only: the number of samples on all rings together, uniform by arc length along the
        finest outline there is. Without it, the stored samples: enough for all facets to be Delaunay.

    Returns
    -------
    Shape
        The diagonal of its bounding box is 1.

    Raises
    ------
    InputError
        If there is no such name, if `n` is less than three a ring, or given for a solid.
    ShapeError
        If the polygon through so few samples crosses itself.

    Examples
    --------
    >>> lake = load("lake")
    >>> len(lake.points), lake.betti()
    (1000, (1, 2))
    >>> len(load("lake", n=300).points)
    300
    >>> vertebra = load("vertebra")
    >>> len(vertebra.points), vertebra.betti()
    (2011, (1, 1, 0))
    """
    _record(name)
    if name in names(3):
        arrays = _arrays(name)
        if n is not None and not (isinstance(n, Integral) and n == len(arrays["V"])):
            raise InputError(
                f"{name} is stored with {len(arrays['V'])} samples and not made anew with {shown(n)}; leave "
                "n out, or make a solid of any size with polyskel_lite.implicit.solid."
            )
        return Shape(arrays["V"], arrays["F"])
    if n is None:
        return Shape.from_rings(_rings(name, "xy", "off"))
    return Shape.from_rings(_rings(name, "fine_xy", "fine_off")).resample(n)


def info(name: str) -> str:
    """Describe a shape: what it is, its size, its source and its licence line.

    Parameters
    ----------
    name : str
        One of `names(None)`.

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
    record, arrays = _record(name), _arrays(name)
    if "V" in arrays:
        size = f"{len(arrays['V'])} samples, {len(arrays['F'])} triangles"
    else:
        rings = len(arrays["off"]) - 1
        size = f"{len(arrays['xy'])} samples, {rings} ring{'s' if rings > 1 else ''}"
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
    if not isinstance(name, str) or name not in records:
        near = get_close_matches(shown(name).lower(), records, n=1, cutoff=0.0)[0]
        raise InputError(
            f"There is no shape called {shown(name)}; did you mean {near!r}? The names are "
            f"{', '.join(names(2) + names(3))}."
        )
    return records[name]


def _rings(name: str, points: str, offsets: str) -> list[np.ndarray]:
    arrays = _arrays(name)
    return np.split(arrays[points].astype(np.float64), arrays[offsets][1:-1])


@cache
def _arrays(name: str) -> dict[str, np.ndarray]:
    with (files(__package__) / f"{name}.npz").open("rb") as stream, np.load(stream) as data:
        return dict(data)
