"""Singular points: which crossings of spheres are one, and which of them lie on which spheres."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array, triu
from scipy.spatial import cKDTree

from ..exact import components, spread_out, unique_rows
from .pairs import ON, PRECISION, balls_near, believed, gaps, lengths, rounding, units

# As `ON`, a share of the distance from the origin: some ten roundings, as often amplified.
_FAR = 1e-14
# Singular points nearer to each other than this share of the smallest ball through them are one.
_NEAR = 1e-9
# Directions whose cosine is less than this are at a right angle: a point where two balls touch is known to
# 1e-12 of them, and directions from it lose some digits.
_LEVEL = 1e-9


class Incidence:
    """Pairs (singular point, ball) with the point on the sphere, sorted.

    Parameters
    ----------
    corners : (s, N) float array
    centers, radii : (k, N) and (k,) float arrays
    origin : (N,) float array
        What was taken off all coordinates; they were rounded before that.
    spread : (s,) float array, optional
        Distance by which each corner may be off, a length.

    Attributes
    ----------
    matrix : (s, k) csr_array of int
        1 where the point is on the sphere.
    """

    def __init__(self, corners, centers, radii, origin, spread=None):
        slack = _FAR * np.abs(origin).max() + (np.zeros(len(corners)) if spread is None else spread)
        point, ball, away = balls_near(corners, centers, radii, slack.max(initial=0))
        # No singular point is inside a ball, so that "not outside" is "on the sphere".
        on = away <= radii[ball] * (1 + ON) + slack[point]
        ones = np.ones(np.count_nonzero(on), dtype=np.int64)
        self.matrix = coo_array((ones, (point[on], ball[on])), (len(corners), len(radii))).tocsr()
        self.matrix.sort_indices()

    def common(self, groups: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """All (row, ball) with every singular point of the row on the ball, sorted; groups is (m, c)."""
        shared = self.matrix[groups[:, 0]]
        for column in groups.T[1:]:
            shared = shared.multiply(self.matrix[column])
        return shared.nonzero()

    def pairs(self) -> tuple[np.ndarray, np.ndarray]:
        """The pairs of balls with a common singular point, sorted, (m, 2), and how many they have."""
        shared = triu(self.matrix.T @ self.matrix, 1, format="coo")
        order = np.lexsort((shared.col, shared.row))
        return np.stack([shared.row, shared.col], axis=1, dtype=np.int64)[order], shared.data[order]

    def balls(self, point: int) -> np.ndarray:
        """The balls of one singular point."""
        return self.matrix.indices[self.matrix.indptr[point] : self.matrix.indptr[point + 1]]

    def balls_of_each(self, n: int) -> np.ndarray:
        """The balls of singular points that lie on exactly n, (s, n), -1 for the others."""
        balls = np.full((self.matrix.shape[0], n), -1)
        plain = np.flatnonzero(self.sizes() == n)
        balls[plain] = self.matrix.indices[self.matrix.indptr[plain, None] + np.arange(n)]
        return balls

    def sizes(self) -> np.ndarray:
        """How many balls each singular point has, (s,)."""
        return np.diff(self.matrix.indptr)

    def smallest(self, radii: np.ndarray) -> np.ndarray:
        """The radius of the smallest ball through each singular point, (s,)."""
        smallest = np.full(self.matrix.shape[0], np.inf)
        np.minimum.at(smallest, spread_out(self.sizes())[0], radii[self.matrix.indices])
        return smallest


def gather(corners: np.ndarray, centers, radii, origin) -> tuple[np.ndarray, Incidence]:
    """One singular point for each group closer together than `_NEAR`, and on which spheres it is.

    Where two spheres nearly coincide, a crossing is known so badly that rounding can show it twice.
    """
    on = Incidence(corners, centers, radii, origin)
    reach = _NEAR * on.smallest(radii)
    reach[~np.isfinite(reach)] = 0
    group = _linked(corners, reach, np.minimum)
    # The point on most spheres is the best-known one.
    best = _least(-on.sizes(), group)
    if len(best) == len(corners):
        return corners, on
    spread = np.zeros(len(best))
    np.maximum.at(spread, group, lengths(corners - corners[best][group]))
    return corners[best], Incidence(corners[best], centers, radii, origin, 2 * spread)


def merged(points: np.ndarray, errors: np.ndarray) -> np.ndarray:
    """The best-known point of each group of points that are linked by distances within their errors.

    Examples
    --------
    >>> merged(np.array([(0.0, 0), (0.1, 0), (1, 0)]), np.array([0.2, 0.1, 0.1])).tolist()
    [[0.1, 0.0], [1.0, 0.0]]
    """
    if not len(points):
        return points
    return points[_least(errors, _linked(points, errors, np.add))]


def _linked(points, reach, both) -> np.ndarray:
    """The group of each point: linked by distances within `both` (least or sum) of the reaches of two."""
    i, j = cKDTree(points).query_pairs(2 * reach.max(), output_type="ndarray").T
    near = lengths(points[i] - points[j]) <= both(reach[i], reach[j])
    return components(len(points), np.column_stack([i, j])[near])[1]


def contacts(centers, radii, touching) -> tuple[np.ndarray, np.ndarray]:
    """Of pairs that are `touching` (see `pairs.relations`) those that touch on the boundary, and where.

    Around the point p where two balls touch, only their tangent plane is free. A step along v in it leaves
    the ball k through p iff v · (c_k - p) <= 0. So p is on the boundary iff it is in no open ball and some v
    leaves all of them (chapter A.1 of the book); then every two balls that touch in p are returned.

    Examples
    --------
    Two discs, then a third one through their point, then a fourth one on the other side:

    >>> centers, radii = np.array([(-1.0, 0), (1, 0), (0, 1), (0, -1)]), np.ones(4)
    >>> for n in (2, 3, 4):
    ...     contacts(centers[:n], radii[:n], np.array([(0, 1)]))[0].tolist()
    [[0, 1]]
    [[0, 1]]
    []
    """
    slack = believed(centers, radii, *touching.T)
    close = gaps(centers, radii, *touching.T) <= slack
    touching, slack = touching[close], slack[close]
    i, j = touching.T
    share = radii[i] / (radii[i] + radii[j])
    points = centers[i] + share[:, None] * (centers[j] - centers[i])
    point, ball, inside = _through(points, slack, centers, radii)
    shown = ~np.isin(np.arange(len(points)), point[inside])
    first = np.searchsorted(point, np.arange(len(points) + 1))
    more = [np.zeros((0, 2), dtype=np.int64)]
    for row in np.flatnonzero(shown & (np.diff(first) > 2)):
        balls = ball[first[row] : first[row + 1]]
        normal = units(centers[j[row]] - points[row])
        shown[row] = _can_be_left(units(centers[balls] - points[row]), normal)
        if shown[row]:
            more.append(balls[np.stack(np.triu_indices(len(balls), 1), axis=1)])
    more = np.concatenate(more)
    more = more[gaps(centers, radii, *more.T) >= -believed(centers, radii, *more.T)]
    return unique_rows(np.concatenate([touching[shown], more]), len(radii))[0], points[shown]


def _through(points, slack, centers, radii) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """All (point, ball) with the point in the ball or on it, sorted, and whether it is inside for sure."""
    point, ball, away = balls_near(points, centers, radii, slack.max(initial=0))
    order = np.lexsort((ball, point))
    point, ball = point[order], ball[order]
    out = away[order] - radii[ball]
    error = slack[point] + PRECISION * radii[ball] + rounding(centers, radii, ball, ball)
    kept = out <= error
    return point[kept], ball[kept], (out < -error)[kept]


def _can_be_left(towards, normal) -> bool:
    """Whether some direction across `normal` leads into none of the balls in the directions `towards`."""
    if len(normal) == 2:
        ways = np.array([(-normal[1], normal[0])])
    else:
        ways = np.cross(normal, towards)
        size = lengths(ways)
        ways = ways[size > _LEVEL] / size[size > _LEVEL, None]
    ways = np.concatenate([ways, -ways])
    return not len(ways) or bool((ways @ towards.T <= _LEVEL).all(axis=1).any())


def _least(values, group) -> np.ndarray:
    """The row of each group with the least value."""
    order = np.lexsort((values, group))
    return order[np.unique(group[order], return_index=True)[1]]
