"""Triangles in space: which ones meet, and which of their points is the nearest one.

This is the floor below a `Shape` in 3D, as `segments` is in 2D: signs are exact, searching is a sweep
of boxes.
"""

from __future__ import annotations

import numpy as np

from .boxes import overlaps_of, self_overlaps
from .predicates import orientation
from .segments import nearest_on_segments, segments_meet

# The three coordinate planes: whatever is not flat in space has a shadow in one that is not flat.
_PLANES = ((0, 1), (1, 2), (2, 0))
_CHUNK = 500_000  # pairs of points and triangles looked at together: bounds the memory, not the result


def shadow_signs(triangles: np.ndarray) -> np.ndarray:
    """Orientation of the shadows of triangles in the planes xy, yz and zx, exactly.

    Parameters
    ----------
    triangles : (k, 3, 3) float array

    Returns
    -------
    (k, 3) int8 array
        All zero for triangles without an area.

    Examples
    --------
    >>> shadow_signs(np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 1]], [[0, 0, 0], [1, 1, 1], [2, 2, 2]]]))
    array([[ 1,  0, -1],
           [ 0,  0,  0]], dtype=int8)
    """
    triangles = np.asarray(triangles, dtype=np.float64)
    return np.stack([orientation(triangles[:, :, plane]) for plane in _PLANES], axis=1)


def in_facet(facets: np.ndarray, queries: np.ndarray) -> np.ndarray:
    """Whether each query of the line of a segment, or of the plane of a triangle, is in it; exactly.

    Parameters
    ----------
    facets : (k, N, N) float array, or one of fractions (dtype object)
        Triangles with an area.
    queries : (k, N) array of the same kind

    Examples
    --------
    >>> flat = np.array([[[0, 0, 0], [2, 0, 0], [0, 2, 0]]] * 3, dtype=float)
    >>> in_facet(flat, np.array([[1, 1, 0], [2, 2, 0], [0, 0, 0]]))
    array([ True, False,  True])
    """
    found = ((facets.min(axis=1) <= queries) & (queries <= facets.max(axis=1))).all(axis=1)
    if queries.shape[1] == 3:
        rows = np.flatnonzero(found)
        for plane in _PLANES:
            # Seen from the query, the sides of the shadow all turn the same way (or not at all).
            turns = _shadow_turns(facets[rows][:, :, plane], queries[rows][:, plane])
            found[rows[(turns.max(axis=0) > 0) & (turns.min(axis=0) < 0)]] = False
    return found


def _side(triangles, queries):
    """+1 where the query is on the side of the triangle's normal, 0 in its plane."""
    return orientation(np.concatenate([triangles, queries[:, None]], axis=1))


def _shadow_turns(triangles, queries):
    sides = (triangles[:, (i, (i + 1) % 3)] for i in range(3))
    return np.stack([orientation(np.concatenate([s, queries[:, None]], axis=1)) for s in sides])


def segment_meets_triangle(segments: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Whether each closed segment shares a point with its closed triangle, exactly.

    Parameters
    ----------
    segments : (k, 2, 3) float array
    triangles : (k, 3, 3) float array
        With an area.

    Returns
    -------
    (k,) bool array

    Examples
    --------
    >>> floor = np.array([[[0, 0, 0], [4, 0, 0], [0, 4, 0]]] * 3, dtype=float)
    >>> up, beside, along = [[1, 1, -1], [1, 1, 1]], [[3, 3, -1], [3, 3, 1]], [[-1, 1, 0], [9, 1, 0]]
    >>> segment_meets_triangle(np.array([up, beside, along], dtype=float), floor)
    array([ True, False,  True])
    """
    first, second = _side(triangles, segments[:, 0]), _side(triangles, segments[:, 1])
    result = first * second <= 0
    flat = (first == 0) & (second == 0)
    rows = np.flatnonzero(result & ~flat)
    p, q, t = segments[rows, 0], segments[rows, 1], triangles[rows]
    turns = np.stack([orientation(np.stack([p, q, t[:, i], t[:, (i + 1) % 3]], axis=1)) for i in range(3)])
    result[rows] = ~((turns.max(axis=0) > 0) & (turns.min(axis=0) < 0))
    rows = np.flatnonzero(flat)
    if len(rows):
        result[rows] = _meets_in_plane(segments[rows], triangles[rows])
    return result


def _meets_in_plane(segments, triangles):
    """The same where the segment lies in the plane of the triangle: on a shadow that has an area."""
    columns = np.array(_PLANES)[(shadow_signs(triangles) != 0).argmax(axis=1)][:, None, :]
    s, t = np.take_along_axis(segments, columns, axis=2), np.take_along_axis(triangles, columns, axis=2)
    turns = _shadow_turns(t, s[:, 0])
    result = (turns.min(axis=0) >= 0) | (turns.max(axis=0) <= 0)
    for i in range(3):
        side = t[:, (i, (i + 1) % 3)]
        boxes = ((s.min(axis=1) <= side.max(axis=1)) & (side.min(axis=1) <= s.max(axis=1))).all(axis=1)
        result[boxes] |= segments_meet(s[boxes], side[boxes])
    return result


def meeting_faces(points: np.ndarray, faces: np.ndarray, new: np.ndarray | None = None) -> np.ndarray:
    """Pairs of faces that share more than their common vertices, exactly.

    Parameters
    ----------
    points : (n, 3) float array
    faces : (m, 3) int array
        With an area.
    new : (k,) int array, optional
        Only pairs with one of these faces; by default all.

    Returns
    -------
    (p, 2) int array
        In increasing order; empty for an embedded mesh.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 1], [9, 9, 0]], dtype=float)
    >>> meeting_faces(points, np.array([[0, 1, 2], [3, 4, 5]])).tolist()
    [[0, 1]]
    """
    corners = points[faces]
    low, high = corners.min(axis=1), corners.max(axis=1)
    pairs = self_overlaps(low, high) if new is None else overlaps_of(new, low, high)
    found = [np.zeros((0, 2), dtype=np.int64)]
    for i, j in pairs:
        for begin in range(0, len(i), _CHUNK):
            a, b = i[begin : begin + _CHUNK], j[begin : begin + _CHUNK]
            bad = _meet(corners[a], corners[b], faces[a][:, :, None] == faces[b][:, None, :])
            found.append(np.stack([a[bad], b[bad]], axis=1))
    pairs = np.concatenate(found)
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


def _meet(s: np.ndarray, t: np.ndarray, common: np.ndarray) -> np.ndarray:
    """Whether triangles s[i] and t[i] meet elsewhere than in vertices marked as common, (k, 3, 3) bool."""
    bad = ~_apart(s, t, common.any(axis=1))
    bad[bad] = ~_apart(t[bad], s[bad], common[bad].any(axis=2))
    shared = common.sum(axis=(1, 2))
    for some, meet in ((shared < 2, _sides_meet), (shared == 2, _meet_at_edge)):
        rows = np.flatnonzero(bad & some)
        bad[rows] = meet(s[rows], t[rows], common[rows])
    return bad


def _apart(s, t, shared):
    """Whether the plane of s has all corners of t that are not shared strictly on one side."""
    above, below = np.ones(len(s), dtype=bool), np.ones(len(s), dtype=bool)
    for corner in range(3):
        free = ~shared[:, corner]
        rows = np.flatnonzero(free & (above | below))
        side = _side(s[rows], t[rows, corner])
        above[rows] &= side > 0
        below[rows] &= side < 0
    return (above | below) & ~shared.all(axis=1)


def _sides_meet(s, t, common):
    # What they share is convex. So it reaches from a common vertex to a side opposite it.
    bad = np.zeros(len(s), dtype=bool)
    for first, second, shared in ((s, t, common.any(axis=2)), (t, s, common.any(axis=1))):
        for i, k in ((0, 1), (1, 2), (2, 0)):
            rows = np.flatnonzero(~bad & ~shared[:, i] & ~shared[:, k])
            bad[rows] = segment_meets_triangle(first[rows][:, (i, k)], second[rows])
    return bad


def _meet_at_edge(s, t, common):
    # Both triangles are in one plane here; they overlap if they lie on one side of their edge.
    k = np.arange(len(s))
    i, j = (~common.any(axis=2)).argmax(axis=1), (~common.any(axis=1)).argmax(axis=1)
    edge = np.stack([s[k, (i + 1) % 3], s[k, (i + 2) % 3]], axis=1)
    turn_s = shadow_signs(np.concatenate([edge, s[k, i][:, None]], axis=1))
    turn_t = shadow_signs(np.concatenate([edge, t[k, j][:, None]], axis=1))
    return (turn_s * turn_t > 0).any(axis=1)


def nearest_on_triangles(queries: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """The point of a triangle that is nearest to a query, row by row; triangles may be segments or points.

    Examples
    --------
    >>> floor = np.array([[[0, 0, 0], [4, 0, 0], [0, 4, 0]]] * 2, dtype=float)
    >>> nearest_on_triangles(np.array([[1.0, 1.0, 3.0], [5, 0, 1]]), floor).tolist()
    [[1.0, 1.0, 0.0], [4.0, 0.0, 0.0]]
    """
    sides = [triangles[:, (i, (i + 1) % 3)] for i in range(3)]
    on_sides = np.stack([nearest_on_segments(queries, side) for side in sides])
    first = ((queries - on_sides) ** 2).sum(axis=2).argmin(axis=0)
    nearest = on_sides[first, np.arange(len(queries))]
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    square = (normal**2).sum(axis=1)
    over = square > 0
    for side in sides:
        over &= ((queries - side[:, 0]) * np.cross(normal, side[:, 1] - side[:, 0])).sum(axis=1) > 0
    height = ((queries - triangles[:, 0]) * normal).sum(axis=1)
    nearest[over] = queries[over] - (height[over] / square[over])[:, None] * normal[over]
    return nearest
