"""Which boxes overlap, and which places are near each other: by a sweep, or by trees of similar sizes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.spatial import cKDTree

_CHUNK = 2_000_000  # pairs looked at together: bounds the memory, not the result


def octaves(sizes: np.ndarray) -> list[np.ndarray]:
    """The rows in groups whose sizes differ by less than a factor of two, to share a search radius.

    Examples
    --------
    >>> [rows.tolist() for rows in octaves(np.array([1.0, 5, 1.5, 4]))]
    [[0, 2], [1, 3]]
    """
    octave = np.frexp(sizes)[1]
    return [np.flatnonzero(octave == value) for value in np.unique(octave)]


def octave_pairs(places: np.ndarray, reach: np.ndarray) -> Iterator[tuple]:
    """Every two groups of `octaves` with their trees, and the distance within which their reaches may meet.

    Examples
    --------
    >>> pairs = octave_pairs(np.zeros((2, 2)), np.array([1.0, 2]))
    >>> [(a.tolist(), b.tolist(), float(d)) for a, _, b, _, d in pairs]
    [([0], [0], 2.0), ([1], [0], 3.0), ([1], [1], 4.0)]
    """
    groups = [(rows, cKDTree(places[rows]), reach[rows].max()) for rows in octaves(reach)]
    for n, (a, tree, far) in enumerate(groups):
        for b, other, wide in groups[: n + 1]:
            yield a, tree, b, other, far + wide


def near_pairs(places: np.ndarray, reach: np.ndarray, p: float = 2.0) -> Iterator[tuple[np.ndarray, ...]]:
    """Yield i < j and their distance, in chunks, of all places not farther apart than their reaches.

    Some pairs that are a little farther apart come as well: a tree wants one search radius. The reaches in
    one tree differ by less than a factor of two, so that these are few, however unequal the reaches are.

    Parameters
    ----------
    places : (k, N) float array
    reach : (k,) float array
    p : float
        Of the norm: 2, or infinity for the largest difference of coordinates.

    Examples
    --------
    >>> places = np.array([(0.0, 0), (1, 0), (9, 0)])
    >>> [[a.tolist() for a in chunk] for chunk in near_pairs(places, np.full(3, 0.5))]
    [[[0], [1], [1.0]]]
    """
    slack = 1e-14 * np.abs(places).max(initial=0.0)  # some ten roundings
    for a, tree, b, other, within in octave_pairs(places, reach):
        within = within * (1 + 1e-9) + slack
        count = len(a) * len(b)
        if count > _CHUNK:  # some of them tell about how many there are
            some = places[a[:: 1 + len(a) // 256]]
            count = other.query_ball_point(some, within, p=p, return_length=True).mean() * len(a)
        for part in np.array_split(a, 1 + int(count) // _CHUNK):
            tree = tree if len(part) == len(a) else cKDTree(places[part])
            near = tree.sparse_distance_matrix(other, within, p=p, output_type="ndarray")
            i, j = part[near["i"]], b[near["j"]]
            once = (i < j) | (a is not b)  # within one tree each pair is found from both sides
            yield np.minimum(i, j)[once], np.maximum(i, j)[once], near["v"][once]


def self_overlaps(low: np.ndarray, high: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield index pairs (i, j), i < j, in chunks, of the closed boxes that overlap; each pair once.

    Parameters
    ----------
    low, high : (m, d) float arrays

    Notes
    -----
    Time grows with m log m for boxes of similar size, where a sweep along one axis needs m^(3/2) and more.

    Examples
    --------
    >>> low = np.array([[0, 0, 0], [1, 1, 1], [5, 5, 5], [0, 0, 0]], dtype=float)
    >>> size = np.array([[1], [1], [1], [9]])
    >>> sorted((int(i), int(j)) for a, b in self_overlaps(low, low + size) for i, j in zip(a, b))
    [(0, 1), (0, 3), (1, 3), (2, 3)]
    """
    for i, j, _ in near_pairs(low / 2 + high / 2, (high / 2 - low / 2).max(axis=1), p=np.inf):
        keep = ((low[i] <= high[j]) & (low[j] <= high[i])).all(axis=1)
        yield i[keep], j[keep]


def overlapping_pairs(
    low_a: np.ndarray, high_a: np.ndarray, low_b: np.ndarray, high_b: np.ndarray
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield index pairs (i, j), in chunks, of the closed boxes a[i] and b[j] that overlap.

    Parameters
    ----------
    low_a, high_a : (k, d) float arrays
        Corners of the first boxes.
    low_b, high_b : (m, d) float arrays
        Corners of the second boxes.

    Yields
    ------
    tuple of two (c,) int arrays
        Every overlapping pair once; each box of ``a`` stays inside one chunk.

    Examples
    --------
    >>> low, high = np.array([[0.0], [2.0]]), np.array([[1.0], [3.0]])
    >>> [(i.tolist(), j.tolist()) for i, j in overlapping_pairs(low, high, low + 0.5, high + 0.5)]
    [([0, 1], [0, 1])]
    """
    if not len(low_a) or not len(low_b):
        return
    # Sweep along the axis with fewer candidate pairs: b begins in a, or ends at or after a's begin.
    orders, counts = [], []
    for axis in range(low_a.shape[1]):
        order = np.argsort(low_b[:, axis], kind="stable")
        last = np.searchsorted(low_b[order, axis], high_a[:, axis], side="right")
        # All b that begin before a ends, from the first one whose running maximum of ends reaches a.
        reach = np.maximum.accumulate(high_b[order, axis])
        first = np.searchsorted(reach, low_a[:, axis], side="left")
        orders.append((order, first))
        counts.append(np.maximum(last - first, 0))
    axis = int(np.argmin([c.sum() for c in counts]))
    (order, first), count = orders[axis], counts[axis]
    total = np.concatenate([[0], np.cumsum(count)])
    begin = 0
    while begin < len(count):
        end = max(begin + 1, int(np.searchsorted(total, total[begin] + _CHUNK, side="right")) - 1)
        size = count[begin:end]
        i = np.repeat(np.arange(begin, end), size)
        j = order[
            np.repeat(first[begin:end] - (total[begin:end] - total[begin]), size) + np.arange(size.sum())
        ]
        keep = ((low_a[i] <= high_b[j]) & (low_b[j] <= high_a[i])).all(axis=1)
        if keep.any():
            yield i[keep], j[keep]
        begin = end


def overlaps_of(
    rows: np.ndarray, low: np.ndarray, high: np.ndarray
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Those of `self_overlaps` in which one of the boxes is among the given rows.

    Examples
    --------
    >>> low = np.array([[0.0], [1.0], [2.0]])
    >>> [(i.tolist(), j.tolist()) for i, j in overlaps_of(np.array([1]), low, low + 1)]
    [([0, 1], [1, 2])]
    """
    rows = np.unique(rows)
    for i, j in overlapping_pairs(low[rows], high[rows], low, high):
        i = rows[i]
        once = (i < j) | ((i > j) & ~np.isin(j, rows))
        yield np.minimum(i, j)[once], np.maximum(i, j)[once]
