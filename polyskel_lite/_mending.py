"""Qhull's triangulation of nearly collinear samples, mended: new needles along the hull, then flips.

Samples on straight sides make needles along the convex hull, and rounding turns some of Qhull's inside out.
Everything else is a good triangulation, so only the border is made anew, by exact signs.
"""

from __future__ import annotations

import numpy as np

from ._flips import flip_to_delaunay
from .predicates import orientation

_THIN = 1e-6  # height over base of the needles that are taken off; what is taken off is made anew exactly


def mended(points: np.ndarray, triangles: np.ndarray, neighbors: np.ndarray):
    """Delaunay triangles (t, 3) and neighbors (t, 3) from a triangulation that is wrong near its border.

    Parameters
    ----------
    points : (n, 2) float array
    triangles, neighbors : (t, 3) int arrays
        As Qhull returns them: all of one sense as a complex, some of them inside out in the plane.

    Returns
    -------
    triangles, neighbors : (t, 3) int arrays
        Empty if that did not help. The caller checks the result anyway.

    Examples
    --------
    The last triangle is inside out: sample 3 is beyond the segment from 1 to 2.

    >>> points = np.array([(0.0, 0.0), (4.0, 0.0), (0.0, 4.0), (2.0, 2.0000001)])
    >>> wrong = np.array([[0, 1, 3], [0, 3, 2], [1, 2, 3]]), np.array([[2, 1, -1], [2, -1, 0], [1, 0, -1]])
    >>> mended(points, *wrong)[0].tolist()
    [[0, 1, 3], [0, 3, 2]]
    """
    nothing = np.zeros((0, 3), dtype=np.int64), np.zeros((0, 3), dtype=np.int64)
    border, peeled = _peel(points, triangles, neighbors)
    if border is None:
        return nothing
    triangles = np.concatenate([triangles[~peeled], _fill(points, border)])
    if (orientation(points[triangles]) <= 0).any():
        return nothing
    return flip_to_delaunay(points, triangles, neighbors_of(triangles))


def _peel(points, triangles, neighbors):
    """Take needles off along the hull: the next vertex of each one on the new border, and which went."""
    corners = points[triangles]
    sides = np.roll(corners, -2, axis=1) - np.roll(corners, -1, axis=1)
    area = sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0]
    needle = area[:, None] <= _THIN * (sides**2).sum(axis=2)
    peeled = np.zeros(len(triangles), dtype=bool)
    owner, local = np.nonzero(neighbors < 0)
    start, end = triangles[owner, (local + 1) % 3], triangles[owner, (local + 2) % 3]
    following = dict(zip(start.tolist(), end.tolist(), strict=True))
    behind = dict(zip(start.tolist(), zip(owner.tolist(), local.tolist(), strict=True), strict=True))
    if len(following) != len(owner):
        return None, peeled
    stack = list(following)
    while stack:
        b = stack.pop()
        s, i = behind[b]
        a, c = int(triangles[s, i]), following[b]
        # A vertex that is on the border already would pinch it.
        if not needle[s, i] or a in following:
            continue
        peeled[s] = True
        for vertex, r, to in ((b, neighbors[s, (i + 2) % 3], a), (a, neighbors[s, (i + 1) % 3], c)):
            following[vertex] = to
            behind[vertex] = int(r), neighbors[r].tolist().index(s)
        stack += [b, a]
    return following, peeled


def _fill(points, following):
    """Triangles in the notches of a border that is nearly convex, until it is convex."""
    before = {b: a for a, b in following.items()}
    new, doubtful = [], np.array(list(following))
    while len(doubtful):
        chain = np.array([(before[v], v, following[v]) for v in doubtful.tolist()])
        touched: set[int] = set()
        for a, v, b in chain[orientation(points[chain]) < 0].tolist():
            # A notch next to one that was filled in this round is looked at again in the next one.
            if not touched & {a, v, b}:
                new.append((a, b, v))
                following[a], before[b] = b, a
                del following[v], before[v]
                touched |= {a, b, v}
            else:
                touched |= {v} & following.keys()
        doubtful = np.array(sorted(v for v in touched if v in following), dtype=np.int64)
    return np.array(new, dtype=np.int64).reshape(-1, 3)


def neighbors_of(triangles: np.ndarray) -> np.ndarray:
    """The triangle opposite each vertex, (t, 3), -1 at the border.

    Examples
    --------
    >>> neighbors_of(np.array([[0, 1, 2], [0, 2, 3]])).tolist()
    [[-1, 1, -1], [-1, -1, 0]]
    """
    ends = triangles[:, [[1, 2], [2, 0], [0, 1]]].reshape(-1, 2)
    key = ends.min(axis=1) * (triangles.max(initial=0) + 1) + ends.max(axis=1)
    order = np.argsort(key)
    pair = np.flatnonzero(key[order[1:]] == key[order[:-1]])
    first, second = order[pair], order[pair + 1]
    neighbors = np.full(triangles.size, -1)
    neighbors[first], neighbors[second] = second // 3, first // 3
    return neighbors.reshape(triangles.shape)
