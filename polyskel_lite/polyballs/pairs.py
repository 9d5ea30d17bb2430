"""Pairs of balls: which meet, cross, touch, lie in each other, and how far rounded numbers are believed.

Delaunay balls are the hard case, not the easy one: many pass through the same sample, neighbouring ones
nearly coincide, and rounded centres and radii keep none of this exactly.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

# A ball that sticks out of another one by less than this share of its radius is taken as part of
# it: below, the crossings of the two spheres could be anywhere (error about 1e-16 / share).
SWALLOWED = 1e-10
# The share of its radius to which a ball is believed: circumcentres of thin simplices lose digits.
PRECISION = 1e-12
# However badly conditioned, no crossing is off by more than this share of the smaller radius.
WORST = 1e-6
ROUNDING = 8 * np.finfo(float).eps
CHUNK = 2_000_000  # point-ball pairs looked at together: bounds the memory, not the result


def lengths(vectors: np.ndarray) -> np.ndarray:
    """Euclidean lengths of vectors along the last axis.

    Examples
    --------
    >>> lengths(np.array([(3.0, 4.0), (0, 2)])).tolist()
    [5.0, 2.0]
    """
    return np.sqrt((vectors**2).sum(axis=-1))


def units(vectors: np.ndarray) -> np.ndarray:
    """Vectors along the last axis, scaled to length 1.

    Examples
    --------
    >>> units(np.array([(3.0, 4.0)])).tolist()
    [[0.6, 0.8]]
    """
    return vectors / lengths(vectors)[..., None]


def spread_out(sizes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """For groups of given sizes, member by member: its group, and its number in the group from 0.

    Examples
    --------
    >>> group, number = spread_out(np.array([2, 0, 3]))
    >>> group.tolist(), number.tolist()
    ([0, 0, 2, 2, 2], [0, 1, 0, 1, 2])
    """
    group = np.repeat(np.arange(len(sizes)), sizes)
    return group, np.arange(len(group)) - np.repeat(np.cumsum(sizes) - sizes, sizes)


def rounding(centers, radii, i, j) -> np.ndarray:
    """What the rounding of coordinates and radii may do to a distance between two balls."""
    size = np.abs(centers).max(axis=1) + radii
    return ROUNDING * (size[i] + size[j])


def octaves(radii) -> list[np.ndarray]:
    """The balls in groups whose radii differ by less than a factor of two, to share a search radius."""
    octave = np.frexp(radii)[1]
    return [np.flatnonzero(octave == value) for value in np.unique(octave)]


def meeting_pairs(centers, radii) -> tuple[np.ndarray, np.ndarray]:
    """All pairs i < j of balls that meet, and those that miss each other only by rounding.

    A KD-tree wants one search radius. The radii in one tree differ by less than a factor of two, so
    that few pairs too many are looked at, however unequal the balls are.
    """
    groups = octaves(radii)
    trees = [cKDTree(centers[group]) for group in groups]
    found_i, found_j = [], []
    for a in range(len(groups)):
        for b in range(a + 1):
            reach = (radii[groups[a]].max() + radii[groups[b]].max()) * (1 + 1e-9)
            near = trees[a].sparse_distance_matrix(trees[b], reach, output_type="ndarray")
            i, j = groups[a][near["i"]], groups[b][near["j"]]
            meet = near["v"] <= (radii[i] + radii[j]) * (1 + 1e-9) + rounding(centers, radii, i, j)
            if a == b:
                meet &= i < j  # within one tree each pair is found from both sides
            found_i.append(i[meet])
            found_j.append(j[meet])
    i, j = np.concatenate(found_i), np.concatenate(found_j)
    return np.minimum(i, j), np.maximum(i, j)


def pair_bound(centers, radii) -> int:
    """At most so many pairs of balls meet, counted with the largest radius of each factor of two."""
    groups = octaves(radii)
    trees = [cKDTree(centers[group]) for group in groups]
    return sum(
        int(trees[a].count_neighbors(trees[b], radii[groups[a]].max() + radii[groups[b]].max()))
        for a in range(len(groups))
        for b in range(a + 1)
    )


def swallowed(centers, radii, i, j) -> np.ndarray:
    """Which balls lie in a larger one, or in an equal one with a smaller index, up to the tolerance."""
    smaller = radii[i] < radii[j]
    small, large = np.where(smaller, i, j), np.where(smaller, j, i)
    out = lengths(centers[small] - centers[large]) + radii[small] - radii[large]
    inside = out <= SWALLOWED * radii[small] + rounding(centers, radii, small, large)
    result = np.zeros(len(radii), dtype=bool)
    result[small[inside]] = True
    return result


def gaps(centers, radii, i, j) -> np.ndarray:
    """How far balls are apart, negative where they meet.

    Examples
    --------
    >>> gaps(np.array([(0.0, 0), (5, 0)]), np.array([1, 2]), [0], [1]).tolist()
    [2.0]
    """
    return lengths(centers[i] - centers[j]) - radii[i] - radii[j]


def touching(centers, radii, i, j) -> np.ndarray:
    """Which pairs do not cross but touch from outside (or miss each other), up to the tolerance."""
    return gaps(centers, radii, i, j) >= -_believed(centers, radii, i, j)


def contacts(centers, radii, i, j) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of pairs that are `touching` those that do not miss each other, the points, and the tolerance there.

    Examples
    --------
    >>> pairs, points, _ = contacts(np.array([(0.0, 0), (3, 0)]), np.array([1, 2]), [0], [1])
    >>> pairs.tolist(), points.tolist()
    ([[0, 1]], [[1.0, 0.0]])
    """
    pairs, believed = np.column_stack([i, j]), _believed(centers, radii, i, j)
    close = gaps(centers, radii, i, j) <= believed
    i, j = pairs[close].T
    share = radii[i] / (radii[i] + radii[j])
    return pairs[close], centers[i] + share[:, None] * (centers[j] - centers[i]), believed[close]


def _believed(centers, radii, i, j) -> np.ndarray:
    return PRECISION * np.minimum(radii[i], radii[j]) + rounding(centers, radii, i, j)


def in_any(points, centers, radii) -> np.ndarray:
    """Which points lie in one of the closed balls, (m,) bool array."""
    inside = np.zeros(len(points), dtype=bool)
    # Large balls first: they settle most points, and only the others are asked again.
    order = np.argsort(-radii, kind="stable")
    step = max(1, CHUNK // max(1, len(points)))
    for first in range(0, len(order), step):
        balls, left = order[first : first + step], np.flatnonzero(~inside)
        square = sum(
            np.square(points[left, None, axis] - centers[balls, axis]) for axis in range(points.shape[1])
        )
        inside[left] = (square <= np.square(radii[balls])).any(axis=1)
    return inside


def circle_offset(d, r, other):
    """How far from the centre of the ball of radius r, towards the other one, the two spheres cross.

    Examples
    --------
    >>> circle_offset(5.0, 3.0, 4.0)
    1.8
    """
    return (d + (r - other) * (r + other) / d) / 2


def frames(axes: np.ndarray) -> np.ndarray:
    """For each unit axis two unit vectors across it and the axis itself, right-handed, (m, 3, 3)."""
    # The coordinate axis most across gives the first direction.
    x = units(np.cross(axes, np.eye(3)[np.abs(axes).argmin(axis=1)]))
    return np.stack([x, np.cross(axes, x), axes], axis=1)


def crossings(centers, radii, pairs) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where the spheres of crossing pairs meet: centres (m, N), radii (m,), unit axes (m, N) of the circles.

    In the plane a circle is two points.
    """
    i, j = pairs.T
    across = centers[j] - centers[i]
    d = lengths(across)
    axis = across / d[:, None]
    along = circle_offset(d, radii[i], radii[j])
    # Heron's product instead of r² - a²: near tangency the difference would lose half of the digits.
    product = (radii[i] + radii[j] + d) * (radii[i] + radii[j] - d)
    product *= (d + radii[i] - radii[j]) * (d - radii[i] + radii[j])
    return centers[i] + along[:, None] * axis, np.sqrt(np.maximum(product, 0)) / (2 * d), axis
