"""Pairs of balls: which meet, cross, touch, lie in each other, and how far rounded numbers are believed.

Delaunay balls are the hard case, not the easy one: many pass through the same sample, neighbouring ones
nearly coincide, and rounded centres and radii keep none of this exactly.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.spatial import cKDTree
from scipy.spatial.distance import cdist

from ..exact import near_pairs, octave_pairs, octaves

# A ball that sticks out of another one by less than this share of its radius is taken as part of
# it: below, the crossings of the two spheres could be anywhere (error about 1e-16 / share).
_SWALLOWED = 1e-10
# The share of its radius to which a ball is believed: circumcentres of thin simplices lose digits.
PRECISION = 1e-12
# However badly conditioned, no crossing is off by more than this share of the smaller radius.
WORST = 1e-6
# A point is on every sphere that it misses by less than this share of the radius.
ON = 1e-9
ROUNDING = 8 * np.finfo(float).eps
_CHUNK = 2_000_000  # point-ball pairs looked at together: bounds the memory, not the result


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


def rounding(centers, radii, i, j) -> np.ndarray:
    """What the rounding of coordinates and radii may do to a distance between two balls."""
    size = np.abs(centers).max(axis=1) + radii
    return ROUNDING * (size[i] + size[j])


def meeting_pairs(centers, radii) -> tuple[np.ndarray, np.ndarray]:
    """All pairs i < j of balls that meet, and those that miss each other only by rounding."""
    found = []
    for i, j, away in near_pairs(centers, radii + ROUNDING * (np.abs(centers).max(axis=1) + radii)):
        meet = away <= (radii[i] + radii[j]) * (1 + 1e-9) + rounding(centers, radii, i, j)
        found.append(np.stack([i, j])[:, meet])
    return tuple(np.concatenate(found, axis=1))


def meeting_graph(centers, radii) -> csr_array:
    """Which balls meet which, from both sides.

    Examples
    --------
    >>> meeting_graph(np.array([(0.0, 0), (1, 0), (3, 0)]), np.ones(3)).indices.tolist()
    [1, 0, 2, 1]
    """
    i, j = meeting_pairs(centers, radii)
    both = np.append(i, j), np.append(j, i)
    return coo_array((np.ones(2 * len(i), dtype=bool), both), (len(radii), len(radii))).tocsr()


def pair_bound(centers, radii) -> int:
    """At most so many pairs of balls meet, counted with the largest radius of each factor of two."""
    groups = octave_pairs(centers, radii)
    return sum(int(tree.count_neighbors(other, reach)) for _, tree, _, other, reach in groups)


def balls_near(points, centers, radii, slack=0.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points and balls, one pair a row, and the distances of the points from the centres.

    All balls that hold the point or miss it by a length `slack`, and others that are not much smaller.

    Examples
    --------
    >>> found = balls_near(np.array([(0.0, 3)]), np.array([(0.0, 0), (9, 0)]), np.array([3.0, 4]))
    >>> [values.tolist() for values in found]
    [[0], [0], [3.0]]
    """
    tree, found = cKDTree(points), []
    for group in octaves(radii):
        reach = radii[group].max() * (1 + 2 * ON) + slack
        near = cKDTree(centers[group]).sparse_distance_matrix(tree, reach, output_type="ndarray")
        near["i"] = group[near["i"]]
        found.append(near)
    near = np.concatenate(found)
    return near["j"], near["i"], near["v"]


def found_at(keys, wanted) -> np.ndarray:
    """The first row of `keys`, in any order, with each wanted number, -1 where there is none.

    Examples
    --------
    >>> found_at(np.array([5, 3, 5]), np.array([5, 4, 3])).tolist()
    [0, -1, 1]
    """
    order = np.append(np.argsort(keys, kind="stable"), -1)
    row = order[np.searchsorted(keys, wanted, sorter=order[:-1])]
    return np.where(np.append(keys, -1)[row] == wanted, row, -1)


def gaps(centers, radii, i, j) -> np.ndarray:
    """How far balls are apart, negative where they meet.

    Examples
    --------
    >>> gaps(np.array([(0.0, 0), (5, 0)]), np.array([1, 2]), [0], [1]).tolist()
    [2.0]
    """
    return lengths(centers[i] - centers[j]) - radii[i] - radii[j]


def relations(centers, radii, i, j) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What pairs of balls are to each other, up to the tolerance.

    Returns
    -------
    swallowed : (k,) bool array
        Balls that lie in a larger one, or in an equal one with a smaller index.
    crossing : (m, 2) int array
        Pairs of other balls whose spheres cross.
    touching : (q, 2) int array
        Pairs of other balls that touch from outside or miss each other.

    Examples
    --------
    >>> centers, radii = np.array([(0.0, 0), (1, 0), (3, 0), (0, 0)]), np.array([1, 1, 1, 0.5])
    >>> swallowed, crossing, touching = relations(centers, radii, *meeting_pairs(centers, radii))
    >>> swallowed.tolist(), crossing.tolist(), touching.tolist()
    ([False, False, False, True], [[0, 1]], [[1, 2]])
    """
    smaller = radii[i] < radii[j]
    small, large = np.where(smaller, i, j), np.where(smaller, j, i)
    out = lengths(centers[small] - centers[large]) + radii[small] - radii[large]
    inside = out <= _SWALLOWED * radii[small] + rounding(centers, radii, small, large)
    swallowed = np.isin(np.arange(len(radii)), small[inside])
    pairs = np.column_stack([i, j])[~swallowed[i] & ~swallowed[j]]
    touch = gaps(centers, radii, *pairs.T) >= -believed(centers, radii, *pairs.T)
    return swallowed, pairs[~touch], pairs[touch]


def believed(centers, radii, i, j) -> np.ndarray:
    """The length to which the distance between two balls is believed."""
    return PRECISION * np.minimum(radii[i], radii[j]) + rounding(centers, radii, i, j)


def in_any(points, centers, radii) -> np.ndarray:
    """Which points lie in one of the closed balls, (m,) bool array."""
    inside = np.zeros(len(points), dtype=bool)
    # Large balls first: they settle most points, and only the others are asked again.
    order = np.argsort(-radii, kind="stable")
    step = max(1, _CHUNK // max(1, len(points)))
    for first in range(0, len(order), step):
        balls, left = order[first : first + step], np.flatnonzero(~inside)
        square = cdist(points[left], centers[balls], "sqeuclidean")
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
