"""Delaunay simplices, unique for given points: Qhull for small sets, by an exact check; else `Growing`."""

from __future__ import annotations

import numpy as np
from scipy.spatial import Delaunay, QhullError

from ..errors import TessellationError
from ..exact import in_ball, orientation
from .growing import Growing, canonical, compiled_wanted
from .tessellation import OPPOSITE, corners_of


def triangulate(points: np.ndarray) -> tuple[np.ndarray, np.ndarray, Growing | None]:
    """Simplices (t, N+1), positively oriented, and neighbors (t, N+1) of points, exact.

    They depend on the points only: see `polyskel_lite.graphs.insertion` for ties. The third is the `Growing`
    that they were read off, if that was needed.

    Raises
    ------
    DuplicatePointError
        If two points are equal.
    TessellationError
        If all points are in one line or plane.

    Examples
    --------
    >>> triangulate(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))[1].tolist()
    [[-1, -1, -1]]
    """
    n, dimension = points.shape
    if n <= dimension:
        raise TessellationError(f"{n} points in {dimension}D; a tessellation needs at least {dimension + 1}.")
    growing, found = None, None if compiled_wanted(n, dimension) else _qhull(points)
    if found is None:
        growing = Growing(points)
        found = growing.simplices_and_neighbors()
    return *found, growing


def _qhull(points):
    """What Qhull finds, if it passes `problem` and there are no ties: then there is no other tessellation."""
    centred = points - (points.min(axis=0) + points.max(axis=0)) / 2
    scale = np.abs(centred).max()
    try:
        tessellation = Delaunay(centred / scale if scale > 0 else centred)
    except QhullError:
        return None
    simplices, neighbors = tessellation.simplices.astype(np.int64), tessellation.neighbors.astype(np.int64)
    if (simplices >= len(points)).any():  # seen for points that are nearly in one line
        return None
    simplices, neighbors = _orient(points, simplices, neighbors)
    if not len(simplices) or problem(points, simplices, neighbors, unique=True):
        return None
    return canonical(simplices, neighbors)


def _keep(simplices, neighbors, keep):
    new = np.append(np.where(keep, np.cumsum(keep) - 1, -1), -1)
    return simplices[keep], new[neighbors[keep]]


def _orient(points, simplices, neighbors):
    """Drop flat simplices of the hull, layer by layer, and make the others positive."""
    sign = orientation(corners_of(points, simplices))
    while len(simplices) and (peel := (sign == 0) & (neighbors < 0).any(axis=1)).any():
        simplices, neighbors = _keep(simplices, neighbors, ~peel)
        sign = sign[~peel]
    swap = np.flatnonzero(sign < 0)
    for array in (simplices, neighbors):
        array[swap, :2] = array[swap, 1::-1]
    return simplices, neighbors


def problem(points: np.ndarray, simplices: np.ndarray, neighbors: np.ndarray, unique: bool = False) -> str:
    """What keeps these simplices from being a (the only) Delaunay tessellation of the points, or ''; exact.

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
    if (orientation(corners_of(points, simplices)) <= 0).any():
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
    apex = points[simplices[second, back]]
    where = in_ball(corners_of(points, simplices[first]), apex, positive=True).max(initial=-1)
    if where > 0:
        return "a sample is inside a Delaunay ball"
    if where == 0 and unique:
        return "samples are cospherical"
    # Both are positive, so they are on different sides of their facet if they see it in opposite senses.
    near, far = (
        simplices[first[:, None], OPPOSITE[size][local]],
        simplices[second[:, None], OPPOSITE[size][back]],
    )
    if not _opposite(near, far).all():
        return "simplices overlap"
    return _hull_problem(points, simplices, neighbors, size)


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
