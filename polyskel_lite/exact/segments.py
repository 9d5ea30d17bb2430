"""Segments in the plane: which ones meet, where a point lies, what part of a segment is inside.

This is the floor below `Shape`: signs are exact (see `predicates`), searching is a sweep along one axis.
"""

from __future__ import annotations

import numpy as np

from .boxes import overlapping_pairs, overlaps_of, self_overlaps
from .predicates import in_gabriel_ball, orientation


def segments_meet(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Whether the closed segments a[i] and b[i] share a point, exactly; their boxes must overlap.

    Parameters
    ----------
    a, b : (k, 2, 2) float arrays

    Returns
    -------
    (k,) bool array

    Examples
    --------
    >>> cross = np.array([[[0, 0], [2, 2]]]), np.array([[[0, 2], [2, 0]]])
    >>> segments_meet(*cross)
    array([ True])
    """

    def sides(s, t):
        return orientation(np.stack([s[:, 0], s[:, 1], t[:, 0]], axis=1)) * orientation(
            np.stack([s[:, 0], s[:, 1], t[:, 1]], axis=1)
        )

    return (sides(a, b) <= 0) & (sides(b, a) <= 0)


def first_meeting(
    points: np.ndarray, facets: np.ndarray, doubtful: np.ndarray | None = None
) -> tuple[int, int] | None:
    """The first two segments that meet elsewhere than at a common end, or None.

    Parameters
    ----------
    points : (n, 2) float array
    facets : (m, 2) int array
    doubtful : (k,) int array, optional
        Only pairs with one of these segments; by default all.

    Returns
    -------
    tuple of two ints or None
        Indices into ``facets``; two segments of one vertex that lie on each other count too.

    Examples
    --------
    >>> bow = np.array([[0, 0], [1, 1], [1, 0], [0, 1]], dtype=float)
    >>> first_meeting(bow, np.array([[0, 1], [1, 2], [2, 3], [3, 0]]))
    (0, 2)
    """
    ends = points[facets]
    low, high = ends.min(axis=1), ends.max(axis=1)
    low, high = (np.hstack([corner, np.zeros((len(facets), 1))]) for corner in (low, high))
    for i, j in self_overlaps(low, high) if doubtful is None else overlaps_of(doubtful, low, high):
        shared = facets[i][:, :, None] == facets[j][:, None, :]
        apart = ~shared.any(axis=(1, 2))
        bad = np.zeros(len(i), dtype=bool)
        bad[apart] = segments_meet(ends[i[apart]], ends[j[apart]])
        bad[~apart] = _on_each_other(points, facets[i[~apart]], facets[j[~apart]], shared[~apart])
        if bad.any():
            k = np.flatnonzero(bad)[np.lexsort((j[bad], i[bad]))[0]]
            return int(i[k]), int(j[k])
    return None


def _on_each_other(points, a, b, shared) -> np.ndarray:
    """Whether segments with a common vertex share more; ``shared[k, i, j]`` says that a[k, i] is b[k, j]."""
    k = np.arange(len(a))
    place = shared.reshape(-1, 4).argmax(axis=1)
    common, p, q = a[k, place // 2], a[k, 1 - place // 2], b[k, 1 - place % 2]
    bad = p == q
    # Collinear, and the common vertex outside the ball of diameter pq.
    flat = np.flatnonzero(~bad)
    flat = flat[orientation(points[np.stack([common, p, q], axis=1)[flat]]) == 0]
    bad[flat] = in_gabriel_ball(points[np.stack([p, q], axis=1)[flat]], points[common[flat]]) < 0
    return bad


def locate(segments: np.ndarray, queries: np.ndarray) -> np.ndarray:
    """Where each query lies in the region left of the oriented segments: +1 inside, 0 on them, -1 outside.

    Parameters
    ----------
    segments : (m, 2, 2) float array
        Closed curves, interior on the left.
    queries : (k, 2) float array

    Returns
    -------
    (k,) int8 array
        Exact for the floats as given.

    Examples
    --------
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]], dtype=float)
    >>> locate(np.stack([square, np.roll(square, -1, axis=0)], axis=1), np.array([[1, 1], [2, 1], [3, 1]]))
    array([ 1,  0, -1], dtype=int8)
    """
    queries = np.asarray(queries, dtype=np.float64)
    winding = np.zeros(len(queries), dtype=np.int64)
    touching = np.zeros(len(queries), dtype=bool)
    a, b = segments[:, 0], segments[:, 1]
    low, high = segments.min(axis=1), segments.max(axis=1)
    # Only the heights decide which segments a horizontal ray can meet.
    for i, j in overlapping_pairs(queries[:, 1:], queries[:, 1:], low[:, 1:], high[:, 1:]):
        q = queries[i]
        # A segment wholly to the left of the query is not met by the ray to the right.
        ahead = high[j, 0] >= q[:, 0]
        i, j, q = i[ahead], j[ahead], q[ahead]
        side = orientation(np.stack([a[j], b[j], q], axis=1))
        touching[i[(side == 0) & (low[j, 0] <= q[:, 0])]] = True
        up = (a[j, 1] <= q[:, 1]) & (q[:, 1] < b[j, 1]) & (side > 0)
        down = (b[j, 1] <= q[:, 1]) & (q[:, 1] < a[j, 1]) & (side < 0)
        np.add.at(winding, i, up.astype(np.int64) - down)
    result = np.where(winding != 0, 1, -1).astype(np.int8)
    result[touching] = 0
    return result


def odd_around(segments: np.ndarray, owner: np.ndarray, queries: np.ndarray) -> np.ndarray:
    """Whether an odd number of closed curves runs around each query, (k,) bool; exact.

    Parameters
    ----------
    segments : (m, 2, 2) float array
    owner : (m,) int array
        The curve of each segment. Curve i does not count for query i, which may lie on it.
    queries : (k, 2) float array
        On no other curve.

    Examples
    --------
    >>> square = np.array([[0, 0], [3, 0], [3, 3], [0, 3]], dtype=float)
    >>> rings = np.concatenate([square, square / 3 + 1])
    >>> ends = np.concatenate([np.roll(part, -1, axis=0) for part in (rings[:4], rings[4:])])
    >>> odd_around(np.stack([rings, ends], axis=1), np.repeat([0, 1], 4), rings[[0, 4]]).tolist()
    [False, True]
    """
    odd = np.zeros(len(queries), dtype=bool)
    low, high = segments.min(axis=1), segments.max(axis=1)
    for i, j in overlapping_pairs(queries[:, 1:], queries[:, 1:], low[:, 1:], high[:, 1:]):
        x, y = queries[i].T
        # The ray to the right; of the two ends of a segment only the lower one belongs to it.
        met = (low[j, 1] <= y) & (y < high[j, 1]) & (high[j, 0] >= x) & (owner[j] != i)
        i, j, x, y = i[met], j[met], x[met], y[met]
        ahead = low[j, 0] > x
        unsure = np.flatnonzero(~ahead)
        a, b = segments[j[unsure]].transpose(1, 0, 2)
        side = orientation(np.stack([a, b, queries[i[unsure]]], axis=1))
        ahead[unsure] = side == np.where(a[:, 1] < b[:, 1], 1, -1)
        odd ^= np.bincount(i[ahead], minlength=len(queries)) % 2 == 1
    return odd


def point_segment_distance(queries: np.ndarray, segments: np.ndarray) -> np.ndarray:
    """Distance from point to segment, row by row (arrays are broadcast).

    Examples
    --------
    >>> float(point_segment_distance(np.array([1.0, 2.0]), np.array([[0.0, 0.0], [4.0, 0.0]])))
    2.0
    """
    return np.sqrt(((queries - nearest_on_segments(queries, segments)) ** 2).sum(axis=-1))


def nearest_on_segments(queries: np.ndarray, segments: np.ndarray) -> np.ndarray:
    """The point of a segment that is nearest to a query, row by row (arrays are broadcast).

    Examples
    --------
    >>> nearest_on_segments(np.array([1.0, 2.0]), np.array([[0.0, 0.0], [4.0, 0.0]])).tolist()
    [1.0, 0.0]
    """
    a, direction = segments[..., 0, :], segments[..., 1, :] - segments[..., 0, :]
    length2 = (direction**2).sum(axis=-1)
    t = ((queries - a) * direction).sum(axis=-1) / np.where(length2 > 0, length2, 1)
    return a + np.clip(t, 0, 1)[..., None] * direction
