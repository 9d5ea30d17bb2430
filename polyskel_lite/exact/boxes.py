"""Which boxes of one set overlap: a grid for the many small ones, a sweep for the few large ones."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

_CHUNK = 2_000_000  # pairs looked at together: bounds the memory, not the result


def self_overlaps(low: np.ndarray, high: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield index pairs (i, j), i < j, in chunks, of the closed boxes that overlap; each pair once.

    Parameters
    ----------
    low, high : (m, 3) float arrays

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
    if len(low) < 2:
        return
    extent = (high - low).max(axis=1)
    origin, span = low.min(axis=0), float(np.ptp(np.concatenate([low, high]), axis=0).max())
    cell = max(2 * float(np.median(extent)), span / 2**20)
    large = np.flatnonzero(extent > 4 * cell)
    for a, b in overlapping_pairs(low[large], high[large], low, high):
        i = large[a]
        # Two large ones come twice.
        once = (i < b) | ~np.isin(b, large)
        once &= i != b
        yield np.minimum(i, b)[once], np.maximum(i, b)[once]
    small = np.setdiff1d(np.arange(len(low)), large)
    if len(small) > 1 and cell > 0:
        first = ((low[small] - origin) / cell).astype(np.int64)
        last = ((high[small] - origin) / cell).astype(np.int64)
        for i, j in _in_one_cell(first, last):
            a, b = small[i], small[j]
            keep = ((low[a] <= high[b]) & (low[b] <= high[a])).all(axis=1)
            yield np.minimum(a, b)[keep], np.maximum(a, b)[keep]


def _in_one_cell(first: np.ndarray, last: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Pairs of boxes with a common cell, from the first and last cell of each box on the three axes."""
    counts = last - first + 1
    number = counts.prod(axis=1).astype(np.intp)
    box = np.repeat(np.arange(len(first)), number)
    rank = np.arange(number.sum()) - np.repeat(np.cumsum(number) - number, number)
    cells = np.empty((len(box), 3), dtype=np.int64)
    for axis in range(3):
        cells[:, axis] = first[box, axis] + rank % counts[box, axis]
        rank //= counts[box, axis]
    size = last.max(axis=0) + 1
    key = (cells[:, 0] * size[1] + cells[:, 1]) * size[2] + cells[:, 2]
    order = np.argsort(key, kind="stable")
    key, box, cells = key[order], box[order], cells[order]
    ends = np.searchsorted(key, key, side="right")
    later = ends - np.arange(len(key)) - 1
    total = np.concatenate([[0], np.cumsum(later)])
    begin = 0
    while begin < len(key):
        end = max(begin + 1, int(np.searchsorted(total, total[begin] + _CHUNK, side="right")) - 1)
        count = later[begin:end]
        a = np.repeat(np.arange(begin, end), count)
        b = a + 1 + np.arange(len(a)) - np.repeat(np.cumsum(count) - count, count)
        # Only in the lowest cell that both are in.
        lowest = (np.maximum(first[box[a]], first[box[b]]) == cells[a]).all(axis=1)
        yield box[a[lowest]], box[b[lowest]]
        begin = end


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
