"""Singular points: which crossings of spheres are one, and which of them lie on which spheres."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..exact import components, unique_rows
from .pairs import PRECISION, believed, gaps, lengths, octaves, rounding, spread_out, units

# A singular point is on every sphere that it misses by less than this share of the radius.
_ON = 1e-9
# The same for the distance from the origin: some ten roundings, as often amplified.
_FAR = 1e-14
# Singular points nearer to each other than this share of the smallest ball through them are one.
_NEAR = 1e-9
# Directions whose cosine is less than this are at a right angle: a point where two balls touch is known to
# 1e-12 of them, and directions from it lose some digits.
_LEVEL = 1e-9


class Incidence:
    """Pairs (singular point, ball) with the point on the sphere, as sorted keys.

    Parameters
    ----------
    corners : (s, N) float array
    centers, radii : (k, N) and (k,) float arrays
    origin : (N,) float array
        What was taken off all coordinates; they were rounded before that.
    spread : (s,) float array, optional
        Distance by which each corner may be off, a length.
    """

    def __init__(self, corners, centers, radii, origin, spread=None):
        self.count = len(radii)
        slack = _FAR * np.abs(origin).max() + (np.zeros(len(corners)) if spread is None else spread)
        point, ball = [], []
        tree = cKDTree(corners)
        for group in octaves(radii):
            near = cKDTree(centers[group]).sparse_distance_matrix(
                tree, radii[group].max() * (1 + 2 * _ON) + slack.max(initial=0), output_type="ndarray"
            )
            # No singular point is inside a ball, so that "not outside" is "on the sphere".
            on = near["v"] <= radii[group[near["i"]]] * (1 + _ON) + slack[near["j"]]
            point.append(near["j"][on])
            ball.append(group[near["i"][on]])
        self.keys = np.unique(np.concatenate(point) * self.count + np.concatenate(ball))
        self.first = np.searchsorted(self.keys, np.arange(len(corners) + 1) * self.count)

    def common(self, groups: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """All (row, ball) with every singular point of the row on the ball, sorted; groups is (m, c)."""
        size = np.diff(self.first)
        rows = np.arange(len(groups))
        shortest = groups[rows, size[groups].argmin(axis=1)] if len(groups) else np.zeros(0, dtype=int)
        row, place = spread_out(size[shortest])
        ball = self.keys[self.first[shortest][row] + place] % self.count
        for column in groups.T:
            wanted = column[row] * self.count + ball
            at = np.minimum(np.searchsorted(self.keys, wanted), len(self.keys) - 1)
            found = self.keys[at] == wanted
            row, ball = row[found], ball[found]
        return row, ball

    def pairs(self) -> np.ndarray:
        """For each singular point all pairs of its balls, one after the other, (m, 2)."""
        size = np.diff(self.first)
        point, ball = np.repeat(np.arange(len(size)), size), self.keys % self.count
        later = self.first[point + 1] - np.arange(len(ball)) - 1
        i, place = spread_out(later)
        return np.column_stack([ball[i], ball[i + 1 + place]])

    def balls(self, point: int) -> np.ndarray:
        """The balls of one singular point."""
        return self.keys[self.first[point] : self.first[point + 1]] % self.count

    def balls_of_each(self, n: int) -> np.ndarray:
        """The balls of singular points that lie on exactly n, (s, n), -1 for the others."""
        balls = np.full((len(self.first) - 1, n), -1)
        plain = np.flatnonzero(np.diff(self.first) == n)
        balls[plain] = self.keys[self.first[plain, None] + np.arange(n)] % self.count
        return balls

    def smallest(self, radii: np.ndarray) -> np.ndarray:
        """The radius of the smallest ball through each singular point, (s,)."""
        smallest = np.full(len(self.first) - 1, np.inf)
        np.minimum.at(smallest, self.keys // self.count, radii[self.keys % self.count])
        return smallest


def gather(corners: np.ndarray, centers, radii, origin) -> tuple[np.ndarray, Incidence]:
    """One singular point for each group closer together than `_NEAR`, and on which spheres it is.

    Where two spheres nearly coincide, a crossing is known so badly that rounding can show it twice.
    """
    on = Incidence(corners, centers, radii, origin)
    reach = _NEAR * on.smallest(radii)
    reach[~np.isfinite(reach)] = 0
    i, j = cKDTree(corners).query_pairs(reach.max(), output_type="ndarray").T
    near = lengths(corners[i] - corners[j]) <= np.minimum(reach[i], reach[j])
    if not near.any():
        return corners, on
    _, group = components(len(corners), np.column_stack([i, j])[near])
    # The point on most spheres is the best-known one.
    best = _least(-np.diff(on.first), group)
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
    near = cKDTree(points).query_pairs(2 * errors.max(), output_type="ndarray")
    near = near[lengths(points[near[:, 0]] - points[near[:, 1]]) <= errors[near].sum(axis=1)]
    return points[_least(errors, components(len(points), near)[1])]


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
    found = [np.zeros((0, 3))]
    tree = cKDTree(points)
    for group in octaves(radii):
        reach = radii[group].max() * (1 + _ON) + slack.max(initial=0)
        near = tree.sparse_distance_matrix(cKDTree(centers[group]), reach, output_type="ndarray")
        found.append(np.column_stack([near["i"], group[near["j"]], near["v"]]))
    found = np.concatenate(found)
    found = found[np.lexsort((found[:, 1], found[:, 0]))]
    point, ball = found[:, :2].astype(np.int64).T
    out = found[:, 2] - radii[ball]
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
