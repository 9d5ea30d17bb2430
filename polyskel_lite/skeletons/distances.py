"""Hausdorff distances between skeletons, boundaries and point sets (for the convergence of section 3)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from ..checks import as_points
from ..errors import InputError
from ..exact import distance_to_triangles
from ..shapes import Shape, farthest
from .branches import free_edges
from .skeleton import Skeleton


def directed_hausdorff(A, B, step: float | None = None) -> float:
    """The largest distance from a point of A to the set B; zero when A is part of B.

    Parameters
    ----------
    A, B : Skeleton, Shape or (k, N) array-like
        Skeletons count with their vertices, edges and polygons, shapes with their boundary, arrays as points.
    step : float, optional
        Edges are replaced by points at most this far apart, triangles are cut until the result is known to
        that length; by default a thousandth of the larger bounding box.

    Returns
    -------
    float
        A length, wrong by at most ``step``.

    Raises
    ------
    InputError
        If a set is empty, or unbounded (rays).

    Examples
    --------
    >>> directed_hausdorff([(0, 0), (3, 4)], [(0, 0)])
    5.0
    >>> from polyskel_lite import Shape
    >>> corner = Shape(3 * np.eye(4, 3), [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])
    >>> directed_hausdorff([(1, 1, 1)], corner)
    0.0
    """
    a, b, step = _sets(A, B, step)
    return _directed(a, b, step)


def hausdorff(A, B, step: float | None = None) -> float:
    """Hausdorff distance: the larger one of the two directed distances.

    Parameters
    ----------
    A, B : Skeleton, Shape or (k, N) array-like
    step : float, optional
        As in `directed_hausdorff`.

    Returns
    -------
    float
        A length, wrong by at most ``step``.

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


class _Set(NamedTuple):
    """Points, those along edges included, and triangles."""

    points: np.ndarray
    triangles: np.ndarray


def _directed(a: _Set, b: _Set, step: float) -> float:
    tree = cKDTree(b.points)

    def distance(points):
        to_points = tree.query(points)[0]
        if not len(b.triangles):
            return to_points
        return np.minimum(to_points, distance_to_triangles(b.triangles, points))

    return farthest(a.triangles, a.points, distance, 0.0, step)


def _sets(A, B, step):
    parts = [_parts(A, "A"), _parts(B, "B")]
    dimensions = [points.shape[1] for points, _, _ in parts]
    if dimensions[0] != dimensions[1]:
        raise InputError(f"A is in {dimensions[0]}D and B in {dimensions[1]}D; pass sets of one space.")
    if step is None:
        step = max(float(np.ptp(points, axis=0).max()) for points, _, _ in parts) / 1000
    elif not step > 0:
        raise InputError(f"step is {step}; pass a positive length.")
    return *(_Set(_points_along(points, ends, step), triangles) for points, ends, triangles in parts), step


def _parts(thing, name):
    n = getattr(thing, "dimension", None)
    ends, triangles = np.zeros((0, 2, n or 0)), np.zeros((0, 3, 3))
    if isinstance(thing, Skeleton):
        if len(thing.rays):
            raise InputError(f"{name} has rays, so it is unbounded; use the inner side.")
        points, ends = thing.vertices, thing.vertices[thing.edges[free_edges(thing)]]
        if len(thing.polygons):
            triangles = points[thing.polygons.triangles()]
    elif isinstance(thing, Shape):
        points = thing.points
        ends, triangles = (thing.segments, triangles) if n == 2 else (ends, thing.segments)
    else:
        points = as_points(thing, name=name)
        ends = np.zeros((0, 2, points.shape[1]))
    if not len(points):
        raise InputError(f"{name} is empty; the distance to an empty set is not defined.")
    return points, ends, triangles


def _points_along(points, ends, step):
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    count = np.ceil(lengths / step).astype(np.intp) if step > 0 else np.zeros(len(lengths), dtype=np.intp)
    inner = np.maximum(count - 1, 0)
    which = np.repeat(np.arange(len(ends)), inner)
    number = np.arange(inner.sum()) - np.repeat(np.cumsum(inner) - inner, inner) + 1
    t = (number / count[which])[:, None] if len(which) else np.zeros((0, 1))
    return np.concatenate([points, ends[which, 0] * (1 - t) + ends[which, 1] * t])
