"""What an argument must be before anything is computed from it, and how messages name a place.

Every array, number, name and path that a user passes goes through one of the functions here, so that nothing
is altered on the way in (masks, imaginary parts, integers that no float holds) and nothing hostile goes on.
"""

from __future__ import annotations

from numbers import Integral, Real
from os import PathLike, fspath
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from .errors import DuplicatePointError, InputError

# Floats hold every integer up to here; above, numbers would be moved to a neighbour.
_EXACT = 2**53
#: Numbers in one array: half a gigabyte as floats. A shape of millions of vertices has a tenth of it.
MOST_NUMBERS = 2**26
#: Keys of three vertices fit in 63 bits for so many points.
MOST_POINTS = 2**21
#: Coordinates whose squares, and the sums of these, are floats.
_LARGEST = 1e150


def near(points: np.ndarray) -> str:
    """The middle of some points (k, N) as messages write it.

    Examples
    --------
    >>> near(np.array([(0, 1), (1, 1)]))
    '(0.5, 1)'
    """
    return "(" + ", ".join(f"{x:g}" for x in points.mean(axis=0)) + ")"


def shown(value) -> str:
    """A value as messages write it: never long, and whatever its own repr does.

    Examples
    --------
    >>> shown("outer"), shown(10**5000), len(shown("x" * 10**6))
    ("'outer'", 'a int', 60)
    """
    # Numbers and words only: the repr of an array or of a nested list takes long, or fails.
    try:
        text = repr(value) if value is None or isinstance(value, (str, Real, complex)) else _kind(value)
    except Exception:  # integers of 4,300 digits, objects with a repr of their own
        text = _kind(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _kind(value) -> str:
    empty = isinstance(value, (list, tuple, dict, set)) and not value
    return f"{'an empty' if empty else 'a'} {type(value).__name__}"


def library(name: str, what: str = "", extra: str = "") -> ModuleType:
    """A package that not everybody has, or a sentence about what needs it and how to install it.

    Examples
    --------
    >>> library("networkx").__name__
    'networkx'
    """
    try:
        return __import__(name)
    except ImportError:
        said = f"{what} needs {name}" if what else f"{name} is not installed"
        name = f'"polyskel-lite[{extra}]"' if extra else name
        raise InputError(f"{said}; run: pip install {name}") from None


def as_choice(value, what: str, choices) -> str:
    """Return the value if it is one of the names, or say which there are.

    Examples
    --------
    >>> as_choice("inner", "side", ("inner", "outer"))
    'inner'
    """
    if not isinstance(value, str) or value not in choices:
        raise InputError(f"unknown {what} {shown(value)}; choose {' or '.join(map(repr, choices))}.")
    return str(value)


def as_instance(value, kind: type, name: str, instead: str):
    """Return the value if it is of a class of the library, or say what to pass.

    Examples
    --------
    >>> as_instance(None, int, "skeleton", "a Skeleton, such as sk0(shape)")
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: skeleton is a NoneType; pass a Skeleton, such as sk0(shape).
    """
    if not isinstance(value, kind):
        raise InputError(f"{name} is a {type(value).__name__}; pass {instead}.")
    return value


def as_number(
    value, name: str, what: str, low: float = -np.inf, high: float = np.inf, *, whole=False, above=False
):
    """Return a number from low to high as float (or int), or say that it is none.

    Parameters
    ----------
    value : float
    name, what : str
        How the message calls it, and what it asks for.
    low, high : float
        Both included; infinite and NaN never are.
    whole : bool
        Whether it must be an integer.
    above : bool
        Whether it must be larger than ``low``.

    Examples
    --------
    >>> as_number(2, "step", "a positive length", 0, above=True)
    2.0
    >>> as_number(2.5, "n", "a whole number of samples", whole=True)
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: n is 2.5; pass a whole number of samples.
    """
    good = isinstance(value, Integral if whole else Real) and _within(value, low, high)
    if not good or (above and value == low):
        raise InputError(f"{name} is {shown(value)}; pass {what}.")
    return int(value) if whole else float(value)


def _within(value: Any, low: float, high: float) -> bool:
    return low <= value <= high and not abs(value) > 1e308


def as_flag(value, name: str) -> bool:
    """Return True or False, or say that the value is neither.

    Examples
    --------
    >>> as_flag("no", "closed")
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: closed is 'no'; pass True or False.
    """
    if not isinstance(value, (bool, np.bool_, Integral)) or value not in (0, 1):
        raise InputError(f"{name} is {shown(value)}; pass True or False.")
    return bool(value)


def as_path(path) -> Path:
    """Return the path of a file, or say that it is none.

    Examples
    --------
    >>> as_path(None)
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: path is None; pass the name of a file.
    """
    try:
        if isinstance(path, (str, PathLike)) and "\0" not in (text := fspath(path)) and text.strip():
            text.encode()  # what is no text cannot be the name of a file either
            return Path(path)
    except (TypeError, UnicodeError):  # a PathLike of bytes; half of a surrogate pair
        pass
    raise InputError(f"path is {shown(path)}; pass the name of a file.")


def as_array(values, name: str, instead: str = "a list or an array of numbers") -> np.ndarray:
    """Return values as an array of bool, int or float, none of them altered; see `as_floats`.

    Raises
    ------
    InputError
        If they are masked, complex, text, ragged, no numbers, or integers that no float holds.

    Examples
    --------
    >>> as_array([1, 2], "radii").dtype.kind
    'i'
    >>> as_array([1, 2j], "radii")
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: radii holds complex numbers; pass their real parts, if those are meant.
    """
    masked = np.ma.is_masked(values)
    if masked or (isinstance(values, (list, tuple)) and any(map(np.ma.is_masked, values))):
        raise InputError(f"{name} is masked; leave the masked entries out, or fill them (.filled()).")
    try:
        array = np.asarray(values)
    except (ValueError, TypeError, OverflowError, RecursionError, RuntimeError, MemoryError) as error:
        raise InputError(f"{name} is not an array of numbers ({error}); pass {instead}.") from None
    if array.dtype.kind == "O" and not array.ndim:
        raise InputError(f"{name} is {shown(values)}, not an array of numbers; pass {instead}.")
    if array.size > MOST_NUMBERS:
        raise InputError(
            f"{name} has {array.size:,} numbers, and {MOST_NUMBERS:,} are the most; pass it in parts."
        )
    if array.dtype.kind == "c":
        raise InputError(f"{name} holds complex numbers; pass their real parts, if those are meant.")
    if array.dtype.kind not in "biufO":
        raise InputError(f"{name} is not an array of numbers but of {array.dtype}; pass {instead}.")
    large = array.dtype.kind == "f" and not isinstance(values, np.ndarray) and (np.abs(array) >= _EXACT).any()
    if array.dtype.kind == "O" or large:  # integers among floats are rounded, which only the objects tell
        _check_objects(np.array(values, dtype=object), name, instead)
        array = array.astype(np.float64)
    elif array.dtype.kind in "iu" and array.itemsize == 8:
        wrong = np.argwhere((array > _EXACT) | (array < -_EXACT))
        if len(wrong):
            raise _inexact(name, wrong[0].tolist(), array[tuple(wrong[0])])
    return array


def _check_objects(array: np.ndarray, name: str, instead: str) -> None:
    for place, value in np.ndenumerate(array):
        if isinstance(value, Integral) and not -_EXACT <= int(value) <= _EXACT:
            raise _inexact(name, list(place), value)
        try:
            number = not isinstance(value, (str, bytes)) and np.isscalar(float(value))
        except (TypeError, ValueError, OverflowError, RuntimeError):
            number = False
        if not number:
            raise InputError(
                f"{name} is not an array of numbers ({name}{list(place)} is {shown(value)}); pass {instead}."
            )


def _inexact(name: str, place: list, value) -> InputError:
    return InputError(
        f"{name}{place} is {shown(int(value))}, an integer above 2**53, and floats skip some of these; "
        "subtract an origin first."
    )


def as_floats(values, name: str, instead: str = "a list or an array of numbers") -> np.ndarray:
    """Return a finite float64 copy of an array of any shape, or say which entry is wrong.

    Examples
    --------
    >>> as_floats([[0, np.inf]], "image")
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: image[0, 1] is inf, not a finite number; remove or repair it.
    """
    with np.errstate(over="ignore"):  # of a longer float, which then is not finite
        array = np.array(as_array(values, name, instead), dtype=np.float64)
    bad = np.argwhere(~np.isfinite(array))
    if len(bad):
        place = bad[0].tolist()
        raise InputError(f"{name}{place} is {array[tuple(place)]}, not a finite number; remove or repair it.")
    return array


def as_indices(values, name: str, n: int, columns: int | None = None, low: int = 0) -> np.ndarray:
    """Return whole numbers from ``low`` to n - 1, (m, columns) or (m,) int, or say which one is not.

    Examples
    --------
    >>> as_indices([(0, 1), (1, 3)], "facets", 3, 2)
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: facets[1, 1] is 3, but there are only 0 to 2.
    """
    shape = f"an (m, {columns}) array of int" if columns else "an (m,) array of int"
    array = as_array(values, name, shape)
    wrong = array.ndim != 2 or array.shape[1] != columns if columns else array.ndim != 1
    if wrong or (array.dtype.kind not in "iu" and array.size):
        raise InputError(f"{name} has shape {array.shape} and type {array.dtype}; pass {shape}.")
    bad = np.argwhere((array < low) | (array >= n))
    if len(bad):
        place = bad[0].tolist()
        raise InputError(f"{name}{place} is {array[tuple(place)]}, but there are only {low} to {n - 1}.")
    return array.astype(np.int64)


def as_radii(radii, count: int) -> np.ndarray:
    """Return radii as a positive finite float64 array (count,) or say which entry is wrong.

    Examples
    --------
    >>> as_radii([1, 2], 2).tolist()
    [1.0, 2.0]
    """
    array = as_floats(radii, "radii", "a (k,) array")
    if array.shape != (count,):
        raise InputError(f"radii has shape {array.shape} for {count} centers; pass a ({count},) array.")
    bad = np.flatnonzero(array <= 0)
    if len(bad):
        raise InputError(
            f"radii[{bad[0]}] is {array[bad[0]]:g}; radii are positive and finite: leave this ball out."
        )
    return array


def as_points(points, *, name: str = "points", dimensions: tuple[int, ...] = (2, 3)) -> np.ndarray:
    """Return ``points`` as a finite float64 array (n, N) or say which entry is wrong.

    Parameters
    ----------
    points : array-like (n, N)
        Coordinates, any unit of length.
    name : str
        How the error message calls the array.
    dimensions : tuple of int
        The values of N that are accepted.

    Raises
    ------
    InputError
        If the array is masked, complex, ragged, not numeric, of another shape, or has an entry that is not
        finite, or an integer above 2**53.

    Examples
    --------
    >>> as_points([(0, 1), (2, 3)]).dtype
    dtype('float64')
    """
    array = as_floats(points, name, "an (n, N) array")
    if array.ndim != 2 or array.shape[1] not in dimensions:
        allowed = " or ".join(str(n) for n in dimensions)
        raise InputError(f"{name} has shape {array.shape}; pass an (n, N) array with N = {allowed}.")
    return array


def check_distinct(points: np.ndarray, place=None) -> None:
    """Raise `DuplicatePointError` naming the first two equal rows.

    Parameters
    ----------
    points : (n, N) float array
    place : callable, optional
        From a row to the name of its ring and its number there, for the message.

    Examples
    --------
    >>> check_distinct(np.array([[0.0, 1.0], [1.0, 0.0]]))
    """
    if not len(points):
        return
    order = np.lexsort(points.T[::-1])
    same = (points[order[1:]] == points[order[:-1]]).all(axis=1)
    if same.any():
        # lexsort is stable, so the first index of an equal pair is the smaller one.
        pairs = np.sort(np.stack([order[:-1][same], order[1:][same]], axis=1), axis=1)
        i, j = pairs[np.lexsort(pairs.T[::-1])[0]]
        called = f"points {i} and {j}"
        if place is not None:
            called = " and ".join(f"vertex {number} of {name}" for name, number in map(place, (i, j)))
        raise DuplicatePointError(f"{called} are both at {near(points[[i]])}; keep one of them.")


def check_squares(*arrays: np.ndarray) -> None:
    """Raise `InputError` if coordinates are so large that their squares overflow, and with them distances.

    Examples
    --------
    >>> check_squares(np.array([[1e200, 0]]))
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: coordinates reach 1e+200, whose square is no float; divide all by 1e+200.
    """
    largest = max(np.abs(array).max(initial=0) for array in arrays)
    if largest > _LARGEST:
        raise InputError(
            f"coordinates reach {largest:.3g}, whose square is no float; divide all by {largest:.0e}."
        )
