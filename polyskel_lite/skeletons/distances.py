"""Hausdorff distances between skeletons, boundaries and point sets (for the convergence of section 3)."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..checks import as_points
from ..errors import InputError
from ..shapes import Shape
from .skeleton import Skeleton


def directed_hausdorff(A, B, step: float | None = None) -> float:
    """The largest distance from a point of A to the set B; zero when A is part of B.

    Parameters
    ----------
    A, B : Skeleton, Shape or (k, N) array-like
        Skeletons count with their vertices and edges, shapes with their boundary, arrays as points.
    step : float, optional
        Edges are replaced by points at most this far apart; by default a thousandth of the larger
        bounding box.

    Returns
    -------
    float
        A length, wrong by at most ``step``.

    Raises
    ------
    InputError
        If a set is empty, or unbounded (rays), or a polygon mesh (3D skeletons with polygons).

    Examples
    --------
    >>> directed_hausdorff([(0, 0), (3, 4)], [(0, 0)])
    5.0
    """
    a, b = _sets(A, B, step)
    return float(cKDTree(b).query(a)[0].max())


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
    a, b = _sets(A, B, step)
    return float(max(cKDTree(b).query(a)[0].max(), cKDTree(a).query(b)[0].max()))


def _sets(A, B, step):
    parts = [_parts(A, "A"), _parts(B, "B")]
    dimensions = [points.shape[1] for points, _ in parts]
    if dimensions[0] != dimensions[1]:
        raise InputError(f"A is in {dimensions[0]}D and B in {dimensions[1]}D; pass sets of one space.")
    if step is None:
        step = max(float(np.ptp(points, axis=0).max()) for points, _ in parts) / 1000
    elif not step > 0:
        raise InputError(f"step is {step}; pass a positive length.")
    return [_points_along(points, ends, step) for points, ends in parts]


def _parts(thing, name):
    if isinstance(thing, Skeleton):
        if len(thing.rays):
            raise InputError(f"{name} has rays, so it is unbounded; use the inner side.")
        if len(thing.polygons):
            raise InputError(f"{name} has polygons; distances are measured along edges only.")
        points, ends = thing.vertices, thing.segments()
    elif isinstance(thing, Shape):
        points, ends = thing.points, thing.segments
    else:
        points = as_points(thing, name=name)
        ends = np.zeros((0, 2, points.shape[1]))
    if not len(points):
        raise InputError(f"{name} is empty; the distance to an empty set is not defined.")
    return points, ends


def _points_along(points, ends, step):
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    count = np.ceil(lengths / step).astype(np.intp) if step > 0 else np.zeros(len(lengths), dtype=np.intp)
    inner = np.maximum(count - 1, 0)
    which = np.repeat(np.arange(len(ends)), inner)
    number = np.arange(inner.sum()) - np.repeat(np.cumsum(inner) - inner, inner) + 1
    t = (number / count[which])[:, None] if len(which) else np.zeros((0, 1))
    return np.concatenate([points, ends[which, 0] * (1 - t) + ends[which, 1] * t])
