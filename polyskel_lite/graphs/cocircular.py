"""Among the tessellations of cocircular or cospherical samples, one that has given facets.

The diagonals of an empty circle's polygon are Delaunay edges as good as each other. A boundary that uses one
of them is in Del(E), whatever diagonal the rule for ties chose. In space the same holds for flat faces; but
there a cell is divided as a cone from one of its vertices, so not all diagonals go together.
"""

from __future__ import annotations

from heapq import heapify, heappop, heappush

import numpy as np

from ..exact import components, in_ball, in_gabriel_ball, orientation
from .growing import Growing, canonical
from .tessellation import OPPOSITE, Tessellation, facet_rows


def preferring(tessellation: Tessellation, facets: np.ndarray) -> Tessellation:
    """Of the tessellations of the same points one that has the facets, as far as its ties allow.

    Examples
    --------
    >>> from polyskel_lite import delaunay
    >>> preferring(delaunay([(0, 0), (1, 0), (1, 1), (0, 1)]), np.array([[1, 3]])).simplices.tolist()
    [[0, 1, 3], [1, 2, 3]]
    """
    points, missing = tessellation.points, facet_rows(tessellation, facets) < 0
    if not missing.any():
        return tessellation
    if tessellation.dimension == 2:
        cut = with_segments(points, tessellation.simplices, tessellation.neighbors, facets, missing)
        return Tessellation.trusted(points, *canonical(*cut))
    ranks = cone_ranks(points, facets)
    if not ranks.any():
        return tessellation
    return Tessellation.trusted(points, *Growing(points, ranks).simplices_and_neighbors())


def with_segments(points: np.ndarray, simplices, neighbors, facets, missing):
    """Triangles and neighbors with the cocircular polygons cut along ``facets`` where they can be.

    ``missing`` says which facets are no edges yet.

    Examples
    --------
    >>> square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    >>> triangles, across = np.array([[0, 1, 2], [0, 2, 3]]), np.array([[-1, 1, -1], [-1, -1, 0]])
    >>> with_segments(square, triangles, across, np.array([[1, 3]]), np.array([True]))[0].tolist()
    [[3, 1, 2], [0, 1, 3]]
    """
    place = np.lexsort(points.T[::-1]).argsort()
    rows = np.sort(facets, axis=1)
    # In an order that does not depend on the labels: where two diagonals cross, the first one is taken.
    ends = np.sort(place[rows], axis=1)
    diagonals = list(map(tuple, rows[np.lexsort(ends.T[::-1])].tolist()))
    first, local = np.nonzero(neighbors >= 0)
    second = neighbors[first, local]
    # The vertex of the neighbour that the two do not share.
    apex = simplices[second].sum(axis=1) - (simplices[first].sum(axis=1) - simplices[first, local])
    tie = in_ball(points[simplices[first]], points[apex]) == 0
    _, label = components(len(simplices), np.stack([first[tie], second[tie]], axis=1))
    circles: dict[int, set[int]] = {}
    for vertex, circle in zip(simplices.ravel().tolist(), np.repeat(label, 3).tolist(), strict=True):
        circles.setdefault(vertex, set()).add(circle)
    again = {circle for a, b in rows[missing].tolist() for circle in circles[a] & circles[b]}
    if not again:
        return simplices, neighbors
    kept = simplices[~np.isin(label, list(again))].tolist()
    for circle in again:
        # A polygon that is cut again must not lose the segments that it had.
        cuts = [(a, b) for a, b in diagonals if circle in circles[a] & circles[b]]
        kept += _cut(_outline(simplices[label == circle].tolist()), cuts, place)
    triangles = np.array(kept, dtype=np.int64)
    return triangles, _neighbors_of(triangles)


def _neighbors_of(triangles: np.ndarray) -> np.ndarray:
    """The triangle opposite each vertex, (t, 3), -1 at the border."""
    one, two = _twins(triangles)
    neighbors = np.full(triangles.size, -1)
    neighbors[one], neighbors[two] = two // 3, one // 3
    return neighbors.reshape(triangles.shape)


def _twins(faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Corners, as 3 f + i, opposite the sides that two faces share: of the one face and of the other."""
    ends = np.sort(faces[:, OPPOSITE[3]].reshape(-1, 2), axis=1)
    key = ends @ (faces.max() + 1, 1)
    order = np.argsort(key, kind="stable")
    pair = np.flatnonzero(key[order[1:]] == key[order[:-1]])
    return order[pair], order[pair + 1]


def _outline(triangles) -> list[int]:
    """The boundary cycle of the triangles, counter-clockwise."""
    edges = [edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a))]
    inner = {(b, a) for a, b in edges}
    follow = {a: b for a, b in edges if (a, b) not in inner}
    cycle = [min(follow)]
    while (vertex := follow[cycle[-1]]) != cycle[0]:
        cycle.append(vertex)
    return cycle


def _cut(polygon: list[int], diagonals: list[tuple[int, int]], place) -> list[list[int]]:
    """Triangles of a convex polygon that has these diagonals; where two cross, the first one."""
    for a, b in diagonals:
        if a in polygon and b in polygon:
            i, j = sorted((polygon.index(a), polygon.index(b)))
            if 1 < j - i < len(polygon) - 1:
                rest = [d for d in diagonals if d != (a, b)]
                return _cut(polygon[i : j + 1], rest, place) + _cut(
                    polygon[j:] + polygon[: i + 1], rest, place
                )
    k = int(np.argmin(place[polygon]))
    polygon = polygon[k:] + polygon[:k]
    return [[polygon[0], polygon[k], polygon[k + 1]] for k in range(1, len(polygon) - 1)]


def cone_ranks(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Ranks (n,) by which cones have the diagonals of the flat, cocircular faces of a mesh.

    Each such polygon must be a fan of triangles from its first vertex. Vertices from which all of their
    polygons are fans come first; then those for whose other polygons that is true; and so on. Polygons that
    no vertex suits are left out. Lower is first, 0 is for all others.

    Examples
    --------
    >>> cube = np.array([(x, y, z) for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)])
    >>> cone_ranks(cube, np.array([(1, 3, 5), (3, 7, 5)])).tolist()
    [0, 0, 0, -1, 0, 0, 0, 0]
    """
    one, two = _twins(faces)
    first, second, apex = one // 3, two // 3, faces.ravel()[two]
    flat = orientation(points[np.column_stack([faces[first], apex])]) == 0
    first, second, apex = first[flat], second[flat], apex[flat]
    tie = in_gabriel_ball(points[faces[first]], points[apex]) == 0
    _, label = components(len(faces), np.stack([first[tie], second[tie]], axis=1))
    polygons: dict[int, list] = {polygon: [] for polygon in np.unique(label[first[tie]]).tolist()}
    for face in np.flatnonzero(np.isin(label, list(polygons))).tolist():
        polygons[int(label[face])].append(set(faces[face].tolist()))
    around: dict[int, list[int]] = {}
    unsuited: dict[int, int] = {}
    for polygon, triangles in polygons.items():
        fans = set.intersection(*triangles)
        for vertex in set.union(*triangles):
            around.setdefault(vertex, []).append(polygon)
            unsuited[vertex] = unsuited.get(vertex, 0) + (vertex not in fans)
    ranks = np.zeros(len(points), dtype=np.int64)
    place = np.lexsort(points.T[::-1]).argsort().tolist()
    ready = [(place[vertex], vertex) for vertex, count in unsuited.items() if not count]
    heapify(ready)
    chosen = 0
    while ready:
        _, vertex = heappop(ready)
        if mine := [polygon for polygon in around[vertex] if polygon in polygons]:
            ranks[vertex] = chosen = chosen - 1
        for polygon in mine:
            triangles = polygons.pop(polygon)
            fans = set.intersection(*triangles)
            for other in set.union(*triangles) - fans:
                unsuited[other] -= 1
                if not unsuited[other]:
                    heappush(ready, (place[other], other))
    return np.where(ranks < 0, chosen - 1 - ranks, 0)
