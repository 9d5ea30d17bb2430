"""Delaunay simplices that pass an exact check: Qhull first, slower methods for what it gets wrong."""

from __future__ import annotations

from functools import cache

import numpy as np
from scipy.spatial import Delaunay, QhullError

from ..errors import TessellationError
from ..exact import in_ball, orientation
from .cocircular import with_segments
from .incremental import incremental_delaunay
from .mending import mended
from .tessellation import OPPOSITE


def triangulate(points: np.ndarray, facets: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Simplices (t, N+1), positively oriented, and neighbors (t, N+1) of distinct points; exact.

    In 2D, ``facets`` are segments to prefer among the diagonals of cocircular samples.

    Raises
    ------
    TessellationError
        If there is no tessellation, or none that passes `problem`.

    Examples
    --------
    >>> triangulate(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))[1].tolist()
    [[-1, -1, -1]]
    """
    n, dimension = points.shape
    if n <= dimension:
        raise TessellationError(f"{n} points in {dimension}D; a tessellation needs at least {dimension + 1}.")
    reason = ""
    for candidate in _candidates(points):
        try:
            simplices, neighbors = candidate()
        except QhullError as error:
            reason = str(error).strip().splitlines()[0]
            continue
        if not len(simplices):
            reason = "all simplices are flat"
            continue
        reason = problem(points, simplices, neighbors)
        if not reason:
            if facets is not None and dimension == 2:
                simplices, neighbors = with_segments(points, simplices, neighbors, facets)
            return _canonical(simplices, neighbors)
    if _flat(points):
        where = "line" if dimension == 2 else "plane"
        raise TessellationError(f"all {n} points are in one {where}; add a point outside of it.")
    raise TessellationError(f"no Delaunay tessellation passed the exact check ({reason}).")


def _candidates(points):
    centred = points - (points.min(axis=0) + points.max(axis=0)) / 2
    scale = np.abs(centred).max()
    centred = centred / scale if scale > 0 else centred
    quick = cache(lambda: _qhull(centred))
    yield lambda: _orient(points, *map(np.copy, quick()))
    if points.shape[1] == 2:
        yield lambda: mended(points, *quick())
    yield lambda: incremental_delaunay(points)


def _qhull(points):
    tessellation = Delaunay(points)
    if (tessellation.simplices >= len(points)).any():  # seen for points that are nearly in one line
        raise QhullError("a simplex has a corner at infinity")
    return tessellation.simplices.astype(np.int64), tessellation.neighbors.astype(np.int64)


def _keep(simplices, neighbors, keep):
    new = np.append(np.where(keep, np.cumsum(keep) - 1, -1), -1)
    return simplices[keep], new[neighbors[keep]]


def _orient(points, simplices, neighbors):
    """Drop flat simplices of the hull, layer by layer, and make the others positive."""
    sign = orientation(_corners(points, simplices))
    while len(simplices) and (peel := (sign == 0) & (neighbors < 0).any(axis=1)).any():
        simplices, neighbors = _keep(simplices, neighbors, ~peel)
        sign = sign[~peel]
    swap = np.flatnonzero(sign < 0)
    for array in (simplices, neighbors):
        array[swap, :2] = array[swap, 1::-1]
    return simplices, neighbors


def _canonical(simplices, neighbors):
    """The same in one order: rows and vertices increasing, but for the last two of odd simplices."""
    inside = np.argsort(simplices, axis=1)
    simplices, neighbors = (np.take_along_axis(array, inside, axis=1) for array in (simplices, neighbors))
    # Sorting the corners turns a simplex over if it takes an odd number of exchanges.
    pairs = [(i, j) for j in range(inside.shape[1]) for i in range(j)]
    odd = np.flatnonzero(sum((inside[:, i] > inside[:, j]).astype(int) for i, j in pairs) % 2)
    for array in (simplices, neighbors):
        array[odd, -2:] = array[odd, :-3:-1]
    order = _order(simplices)
    new = np.append(np.argsort(order), -1)
    return simplices[order], new[neighbors[order]]


def _order(simplices):
    """The lexicographic order of the rows: that of one key, as no three simplices share a facet."""
    n = simplices.max() + 1
    # n**3 fits in 63 bits for two million points.
    key = simplices[:, :-1] @ (n ** np.arange(simplices.shape[1] - 1)[::-1])
    order = np.argsort(key)
    tie = np.flatnonzero(key[order[1:]] == key[order[:-1]])
    tie = tie[simplices[order[tie], -1] > simplices[order[tie + 1], -1]]
    order[tie], order[tie + 1] = order[tie + 1], order[tie]
    return order


def problem(points: np.ndarray, simplices: np.ndarray, neighbors: np.ndarray) -> str:
    """What keeps these simplices from being a Delaunay tessellation of the points, or ''; exact.

    Examples
    --------
    >>> points = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.2, 0.2]])
    >>> problem(points, np.array([[0, 1, 2]]), np.array([[-1, -1, -1]]))
    'point 3 is not used'
    """
    used = np.zeros(len(points), dtype=bool)
    used[simplices] = True
    if not used.all():
        return f"point {np.flatnonzero(~used)[0]} is not used"
    if (orientation(_corners(points, simplices)) <= 0).any():
        return "a simplex is flat"
    size = simplices.shape[1]
    first, local = np.nonzero(neighbors >= 0)
    second = neighbors[first, local]
    once = first < second
    if 2 * np.count_nonzero(once) != len(once):
        return "neighbors disagree"
    first, local, second = first[once], local[once], second[once]
    back = (neighbors[second] == first[:, None]).argmax(axis=1)
    if (neighbors[second, back] != first).any():
        return "neighbors disagree"
    if (
        in_ball(_corners(points, simplices[first]), points[simplices[second, back]], positive=True) > 0
    ).any():
        return "a sample is inside a Delaunay ball"
    # Both are positive, so they are on different sides of their facet if they see it in opposite senses.
    near, far = (
        simplices[first[:, None], OPPOSITE[size][local]],
        simplices[second[:, None], OPPOSITE[size][back]],
    )
    if not _opposite(near, far).all():
        return "simplices overlap"
    return _hull_problem(points, simplices, neighbors, size)


def _corners(points, simplices):
    """The same as ``points[simplices]``, each coordinate contiguous as the predicates like it."""
    return np.take(points.T, simplices.T.astype(np.intp, copy=False), axis=1).transpose(2, 1, 0)


def _opposite(near, far):
    """Whether the rows of ``far`` are odd permutations of those of ``near``: exchanges of two vertices."""
    n = near.shape[1]
    exchanges = [[1, 0]] if n == 2 else [[0, 2, 1], [2, 1, 0], [1, 0, 2]]
    return np.any([(near == far[:, exchange]).all(axis=1) for exchange in exchanges], axis=0)


def _hull_problem(points, simplices, neighbors, corners):
    """Every vertex of the hull's surface must be on or behind the planes of the facets next to it."""
    simplex, local = np.nonzero(neighbors < 0)
    facets = simplices[simplex[:, None], OPPOSITE[corners][local]]
    ridges = np.concatenate([np.delete(facets, i, axis=1) for i in range(corners - 1)])
    owner = np.tile(np.arange(len(facets)), corners - 1)
    extra = np.concatenate([facets[:, i] for i in range(corners - 1)])
    order = np.lexsort(np.sort(ridges, axis=1).T[::-1])
    ridges, owner, extra = np.sort(ridges, axis=1)[order], owner[order], extra[order]
    if len(order) % 2 or (ridges[::2] != ridges[1::2]).any():
        return "the hull is not closed"
    for a, b in ((0, 1), (1, 0)):
        # Replace a facet's opposite vertex by the neighbouring facet's free one: same side, or in the plane.
        cell = points[simplices[simplex[owner[a::2]]]]
        cell[np.arange(len(cell)), local[owner[a::2]]] = points[extra[b::2]]
        if (orientation(cell) < 0).any():
            return "the hull is not convex"
    return ""


def _flat(points) -> bool:
    """Whether all points are in one line (2D) or plane (3D), exactly."""
    base = points[0]
    far = points[np.argmax(((points - base) ** 2).sum(axis=1))]
    if points.shape[1] == 2:
        cells = np.broadcast_to(np.stack([base, far]), (len(points), 2, 2))
    else:
        off = np.argmax((np.cross(points - base, far - base) ** 2).sum(axis=1))
        cells = np.broadcast_to(np.stack([base, far, points[off]]), (len(points), 3, 3))
    return not orientation(np.concatenate([cells, points[:, None]], axis=1)).any()
