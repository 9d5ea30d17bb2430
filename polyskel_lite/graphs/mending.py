"""Qhull's triangulation of nearly collinear samples, mended: new needles along the hull, then flips.

Samples on straight sides make needles along the convex hull, and rounding turns some of Qhull's inside out.
Everything else is a good triangulation, so only the border is made anew, by exact signs.
"""

from __future__ import annotations

import numpy as np

from ..exact import in_ball, orientation

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


def flip_to_delaunay(points: np.ndarray, triangles: np.ndarray, neighbors: np.ndarray):
    """Triangles and neighbors after exchanging diagonals until every ball is empty of its neighbours' apexes.

    Of 200,000 samples of a smooth curve Qhull's rounding leaves some ten edges wrong: far fewer than
    a new tessellation would cost.

    Parameters
    ----------
    points : (n, 2) float array
    triangles, neighbors : (t, 3) int arrays
        A triangulation, all triangles positively oriented. If it is none, neither is the result, but it
        still ends: every flip lowers the surface of the triangles lifted to the paraboloid.

    Returns
    -------
    triangles, neighbors : (t, 3) int arrays

    References
    ----------
    Lawson, Software for C1 surface interpolation, 1977.

    Examples
    --------
    >>> kite = np.array([(0.0, 0.0), (1.0, -3.0), (2.0, 0.0), (1.0, 3.0)])
    >>> long_diagonal = np.array([[0, 1, 3], [1, 2, 3]]), np.array([[1, -1, -1], [-1, 0, -1]])
    >>> flip_to_delaunay(kite, *long_diagonal)[0].tolist()
    [[0, 1, 2], [0, 2, 3]]
    """
    triangles, neighbors = triangles.copy(), neighbors.copy()
    doubtful = np.arange(len(triangles))
    while len(doubtful):
        changed: set[int] = set()
        for s, r in _wrong(points, triangles, neighbors, doubtful):
            # A triangle that changed in this round is looked at again in the next one.
            if s not in changed and r not in changed and _flip(triangles, neighbors, s, r):
                changed.update((s, r))
        doubtful = np.array(sorted(changed), dtype=np.int64)
    return triangles, neighbors


def _wrong(points, triangles, neighbors, rows):
    """Pairs of neighbours, one of them in ``rows``, such that one's apex is inside the other's ball."""
    at, local = np.nonzero(neighbors[rows] >= 0)
    first = rows[at]
    second = neighbors[first, local]
    asked = np.zeros(len(triangles), dtype=bool)
    asked[rows] = True
    once = (first < second) | ~asked[second]
    first, second = first[once], second[once]
    back = (neighbors[second] == first[:, None]).argmax(axis=1)
    inside = in_ball(points[triangles[first]], points[triangles[second, back]], positive=True) > 0
    return zip(first[inside].tolist(), second[inside].tolist(), strict=True)


def _flip(triangles, neighbors, s, r) -> bool:
    """Exchange the diagonal bc of the triangles abc and dcb for ad, in place; False if they are not such."""
    i, j = neighbors[s].tolist().index(r), neighbors[r].tolist().index(s)
    a, b, c = np.roll(triangles[s], -i).tolist()
    d, c_again, b_again = np.roll(triangles[r], -j).tolist()
    if (b, c) != (b_again, c_again):
        return False
    _, beyond_ca, beyond_ab = np.roll(neighbors[s], -i).tolist()
    _, beyond_bd, beyond_dc = np.roll(neighbors[r], -j).tolist()
    triangles[s], neighbors[s] = (a, b, d), (beyond_bd, r, beyond_ab)
    triangles[r], neighbors[r] = (a, d, c), (beyond_dc, beyond_ca, s)
    for outer, old, new in ((beyond_bd, r, s), (beyond_ca, s, r)):
        if outer >= 0:
            neighbors[outer, neighbors[outer].tolist().index(old)] = new
    return True
