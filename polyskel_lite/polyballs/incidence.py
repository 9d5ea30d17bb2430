"""Singular points: which crossings of spheres are one, and which of them lie on which spheres."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..exact import components
from .pairs import lengths, octaves, spread_out

# A singular point is on every sphere that it misses by less than this share of the radius.
_ON = 1e-9
# The same for the distance from the origin: some ten roundings, as often amplified.
_FAR = 1e-14
# Singular points nearer to each other than this share of the smallest ball through them are one.
_NEAR = 1e-9


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


def _least(values, group) -> np.ndarray:
    """The row of each group with the least value."""
    order = np.lexsort((values, group))
    return order[np.unique(group[order], return_index=True)[1]]
