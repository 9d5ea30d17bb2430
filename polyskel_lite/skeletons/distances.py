"""Hausdorff distances between skeletons, boundaries and point sets (for the convergence of section 3)."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..checks import as_number, as_points
from ..errors import InputError
from ..exact import facet_distance, nearest_facets
from ..shapes import Shape, halved
from .skeleton import Skeleton

#: What distances are measured between.
Measurable: TypeAlias = Skeleton | Shape | ArrayLike


def directed_hausdorff(A: Measurable, B: Measurable, step: float | None = None) -> float:
    """The largest distance from a point of A to the set B; zero when A is part of B.

    Parameters
    ----------
    A, B : Skeleton, Shape or (k, N) array-like
        Skeletons count with their vertices, edges and polygons, shapes with their boundary, arrays as points.
    step : float, optional
        How exact the result has to be, a length; by default a millionth of the larger bounding box.

    Returns
    -------
    float
        A length, too small by at most ``step``.

    Raises
    ------
    InputError
        If a set is empty, or unbounded (rays).

    Notes
    -----
    The distance to one segment or triangle is convex, so on a piece of A it is largest at a corner. A piece
    is halved as long as its corners allow a distance that is larger than the largest one found.

    Examples
    --------
    >>> directed_hausdorff([(0, 0), (3, 4)], [(0, 0)])
    5.0
    >>> corner = Shape(3 * np.eye(4, 3), [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])
    >>> directed_hausdorff([(1, 1, 1)], corner)
    0.0
    """
    a, b, step = _sets(A, B, step)
    return _directed(a, b, step)


def hausdorff(A: Measurable, B: Measurable, step: float | None = None) -> float:
    """Hausdorff distance: the larger one of the two directed distances.

    Parameters
    ----------
    A, B : Skeleton, Shape or (k, N) array-like
    step : float, optional
        As in `directed_hausdorff`.

    Returns
    -------
    float
        A length, too small by at most ``step``.

    References
    ----------
    scipy.spatial.distance.directed_hausdorff does the same for point sets.

    Examples
    --------
    >>> hausdorff([(0, 0)], [(0, 0), (3, 4)])
    5.0
    """
    a, b, step = _sets(A, B, step)
    return max(_directed(a, b, step), _directed(b, a, step))


def _directed(a: np.ndarray, b: np.ndarray, step: float) -> float:
    n = a.shape[1]
    best = float(nearest_facets(b, np.unique(a.reshape(-1, n), axis=0))[0].max())
    while len(a):
        distance, facet = nearest_facets(b, a.mean(axis=1))
        best = max(best, float(distance.max()))
        corners = facet_distance(a.reshape(-1, n), np.repeat(b[facet], n, axis=0)).reshape(-1, n)
        a = halved(a[corners.max(axis=1) > best + step])
    # A point between two corners is rounded, and so is its distance to what it lies on.
    return best if best > 16 * np.finfo(float).eps * np.abs(b).max() else 0.0


def _sets(A, B, step):
    a, b = _facets(A, "A"), _facets(B, "B")
    if a.shape[1] != b.shape[1]:
        raise InputError(f"A is in {a.shape[1]}D and B in {b.shape[1]}D; pass sets of one space.")
    if step is None:
        step = max(float(np.ptp(facets, axis=(0, 1)).max()) for facets in (a, b)) * 1e-6
    else:
        step = as_number(step, "step", "a positive length", 0, above=True)
    return a, b, step


def _facets(thing, name) -> np.ndarray:
    """All of a set as segments (m, 2, 2) or triangles (m, 3, 3), some of which are no longer than a point."""
    if isinstance(thing, Shape):
        return thing.segments
    if isinstance(thing, Skeleton):
        if len(thing.rays):
            raise InputError(f"{name} has rays, so it is unbounded; use the inner side.")
        points, cells = thing.vertices, [thing.edges, thing.polygons.triangles()]
    else:
        points, cells = as_points(thing, name=name), []
    if not len(points):
        raise InputError(f"{name} is empty; the distance to an empty set is not defined.")
    cells = [np.arange(len(points))[:, None], *cells]
    n = points.shape[1]
    # The last corner is repeated where a cell has too few.
    rows = [np.pad(cell, ((0, 0), (0, n - cell.shape[1])), mode="edge") for cell in cells if len(cell)]
    return points[np.concatenate(rows)]
