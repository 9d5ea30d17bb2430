"""Edge flips in 2D: a triangulation that is nearly Delaunay made Delaunay, with exact signs."""

from __future__ import annotations

import numpy as np

from .predicates import in_ball


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
