"""Among the tessellations of cocircular samples, one that contains given segments.

The diagonals of an empty circle's polygon are Delaunay edges as good as each other. A boundary that
uses one of them is in Del(E), whatever diagonal Qhull chose.
"""

from __future__ import annotations

import numpy as np

from ..exact import components, in_ball
from .mending import neighbors_of


def with_segments(points: np.ndarray, simplices: np.ndarray, neighbors: np.ndarray, facets: np.ndarray):
    """Triangles and neighbors with the cocircular polygons cut along ``facets`` where they can be.

    Examples
    --------
    >>> square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    >>> triangles, across = np.array([[0, 1, 2], [0, 2, 3]]), np.array([[-1, 1, -1], [-1, -1, 0]])
    >>> with_segments(square, triangles, across, np.array([[1, 3]]))[0].tolist()
    [[1, 2, 3], [3, 0, 1]]
    """
    edges = np.sort(simplices[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    rows = np.sort(facets, axis=1)
    keys, wanted = np.sort(edges @ (len(points), 1)), rows @ (len(points), 1)
    absent = keys[np.searchsorted(keys, wanted).clip(max=len(keys) - 1)] != wanted
    if not absent.any():
        return simplices, neighbors
    missing, facets = set(map(tuple, rows[absent].tolist())), list(map(tuple, rows.tolist()))
    first, local = np.nonzero(neighbors >= 0)
    second = neighbors[first, local]
    # The vertex of the neighbour that the two do not share.
    apex = simplices[second].sum(axis=1) - (simplices[first].sum(axis=1) - simplices[first, local])
    tie = in_ball(points[simplices[first]], points[apex]) == 0
    _, label = components(len(simplices), np.stack([first[tie], second[tie]], axis=1))
    circles: dict[int, set[int]] = {}
    for vertex, circle in zip(simplices.ravel().tolist(), np.repeat(label, 3).tolist(), strict=True):
        circles.setdefault(vertex, set()).add(circle)
    again = {circle for a, b in missing for circle in circles[a] & circles[b]}
    # A polygon that is cut again must not lose the segments that it had.
    diagonals = {circle: [(a, b) for a, b in facets if circle in circles[a] & circles[b]] for circle in again}
    if not diagonals:
        return simplices, neighbors
    kept = [
        t for t, circle in zip(simplices.tolist(), label.tolist(), strict=True) if circle not in diagonals
    ]
    for circle, cuts in diagonals.items():
        kept += _cut(_outline(simplices[label == circle].tolist()), cuts)
    triangles = np.array(kept, dtype=np.int64)
    return triangles, neighbors_of(triangles)


def _outline(triangles) -> list[int]:
    """The boundary cycle of the triangles, counter-clockwise."""
    edges = [edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a))]
    inner = {(b, a) for a, b in edges}
    follow = {a: b for a, b in edges if (a, b) not in inner}
    cycle = [min(follow)]
    while (vertex := follow[cycle[-1]]) != cycle[0]:
        cycle.append(vertex)
    return cycle


def _cut(polygon: list[int], diagonals: list[tuple[int, int]]) -> list[list[int]]:
    """Triangles of a convex polygon that has these diagonals; where two cross, the first one."""
    for a, b in diagonals:
        if a in polygon and b in polygon:
            i, j = sorted((polygon.index(a), polygon.index(b)))
            if 1 < j - i < len(polygon) - 1:
                rest = [d for d in diagonals if d != (a, b)]
                return _cut(polygon[i : j + 1], rest) + _cut(polygon[j:] + polygon[: i + 1], rest)
    return [[polygon[0], polygon[k], polygon[k + 1]] for k in range(1, len(polygon) - 1)]
