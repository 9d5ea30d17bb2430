"""What an array must be before anything is computed from it, and how messages name a place."""

from __future__ import annotations

import numpy as np

from .errors import DuplicatePointError, InputError


def near(points: np.ndarray) -> str:
    """The middle of some points (k, N) as messages write it.

    Examples
    --------
    >>> near(np.array([(0, 1), (1, 1)]))
    '(0.5, 1)'
    """
    return "(" + ", ".join(f"{x:g}" for x in points.mean(axis=0)) + ")"


def as_facets(facets, n: int, corners: int = 2) -> np.ndarray:
    """Return rows of vertex numbers, (m, corners) int, or say which one is not from 0 to n - 1.

    Examples
    --------
    >>> as_facets([(0, 1), (1, 2)], 3).dtype.kind
    'i'
    """
    array = np.array(facets)
    if array.ndim != 2 or array.shape[1] != corners or array.dtype.kind not in "iu":
        raise InputError(
            f"facets has shape {array.shape} and type {array.dtype}; pass an (m, {corners}) array of int."
        )
    bad = np.argwhere((array < 0) | (array >= n))
    if len(bad):
        row, column = bad[0]
        raise InputError(f"facets[{row}, {column}] is {array[row, column]}, but vertices are 0 to {n - 1}.")
    return array.astype(np.int64)


def as_radii(radii, count: int) -> np.ndarray:
    """Return radii as a positive finite float64 array (count,) or say which entry is wrong.

    Examples
    --------
    >>> as_radii([1, 2], 2).tolist()
    [1.0, 2.0]
    """
    try:
        array = np.array(radii, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"radii is not an array of numbers ({error}); pass a (k,) array.") from None
    if array.shape != (count,):
        raise InputError(f"radii has shape {array.shape} for {count} centers; pass a ({count},) array.")
    bad = np.flatnonzero(~(np.isfinite(array) & (array > 0)))
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
        If the array is ragged, not numeric, of another shape or has an entry that is not finite.

    Examples
    --------
    >>> as_points([(0, 1), (2, 3)]).dtype
    dtype('float64')
    """
    try:
        array = np.array(points, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} is not an array of numbers ({error}); pass an (n, N) array.") from None
    if array.ndim != 2 or array.shape[1] not in dimensions:
        allowed = " or ".join(str(n) for n in dimensions)
        raise InputError(f"{name} has shape {array.shape}; pass an (n, N) array with N = {allowed}.")
    bad = np.argwhere(~np.isfinite(array))
    if len(bad):
        row, column = bad[0]
        raise InputError(
            f"{name}[{row}, {column}] is {array[row, column]}, not a finite number; remove or repair it."
        )
    return array


def check_distinct(points: np.ndarray, name: str = "points") -> None:
    """Raise `DuplicatePointError` naming the first two equal rows.

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
        raise DuplicatePointError(f"{name} {i} and {j} are both at {near(points[[i]])}; keep one of them.")
