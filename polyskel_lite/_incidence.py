"""Which singular points lie on which spheres."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

# A singular point is on every sphere that it misses by less than this share of the radius.
ON = 1e-9
# The same for the distance from the origin: some ten roundings, as often amplified.
FAR = 1e-14


class Incidence:
    """Pairs (singular point, ball) with the point on the sphere, as sorted keys.

    Parameters
    ----------
    corners : (s, N) float array
    centers, radii : (k, N) and (k,) float arrays
    origin : (N,) float array
        What was taken off all coordinates; they were rounded before that.
    """

    def __init__(self, corners, centers, radii, origin):
        self.count = len(radii)
        slack = FAR * np.abs(origin).max()
        point, ball = [], []
        octave = np.frexp(radii)[1]
        tree = cKDTree(corners)
        for value in np.unique(octave):
            group = np.flatnonzero(octave == value)
            near = cKDTree(centers[group]).sparse_distance_matrix(
                tree, radii[group].max() * (1 + 2 * ON) + slack, output_type="ndarray"
            )
            # No singular point is inside a ball, so that "not outside" is "on the sphere".
            on = near["v"] <= radii[group[near["i"]]] * (1 + ON) + slack
            point.append(near["j"][on])
            ball.append(group[near["i"][on]])
        self.keys = np.unique(np.concatenate(point) * self.count + np.concatenate(ball))
        self.first = np.searchsorted(self.keys, np.arange(len(corners) + 1) * self.count)

    def common(self, groups: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """All (row, ball) with every singular point of the row on the ball, sorted; groups is (m, c)."""
        size = np.diff(self.first)
        rows = np.arange(len(groups))
        shortest = groups[rows, size[groups].argmin(axis=1)] if len(groups) else np.zeros(0, dtype=int)
        repeat = size[shortest]
        row = np.repeat(rows, repeat)
        begin = np.repeat(self.first[shortest] - (np.cumsum(repeat) - repeat), repeat)
        ball = self.keys[begin + np.arange(len(row))] % self.count
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
        i = np.repeat(np.arange(len(ball)), later)
        j = i + 1 + np.arange(len(i)) - np.repeat(np.cumsum(later) - later, later)
        return np.column_stack([ball[i], ball[j]])
