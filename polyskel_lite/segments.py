"""Segments in the plane: which ones meet, where a point lies, what part of a segment is inside.

This is the floor below `Shape`: signs are exact (see `predicates`), searching is a sweep along one axis.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise

import numpy as np

from .predicates import in_gabriel_ball, orientation

_CHUNK = 2_000_000  # pairs looked at together: bounds the memory, not the result


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


def first_meeting(points: np.ndarray, facets: np.ndarray) -> tuple[int, int] | None:
    """The first two segments that meet elsewhere than at a common end, or None.

    Parameters
    ----------
    points : (n, 2) float array
    facets : (m, 2) int array

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
    for i, j in overlapping_pairs(low, high, low, high):
        i, j = i[i < j], j[i < j]
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


def locate_exactly(segments: np.ndarray, query: tuple[Fraction, Fraction]) -> int:
    """`locate` for one point with rational coordinates, such as a circumcenter.

    Examples
    --------
    >>> triangle = np.array([[[0, 0], [1, 0]], [[1, 0], [0, 1]], [[0, 1], [0, 0]]], dtype=float)
    >>> locate_exactly(triangle, (Fraction(1, 3), Fraction(2, 3)))
    0
    """
    x, y = query
    fx, fy = float(x), float(y)
    # Widen by more than the rounding of the query; everything left is decided on rationals.
    slack = 1e-9 * (1 + abs(fx) + abs(fy))
    low, high = segments.min(axis=1), segments.max(axis=1)
    near = (low[:, 1] <= fy + slack) & (high[:, 1] >= fy - slack) & (high[:, 0] >= fx - slack)
    winding = 0
    for (ax, ay), (bx, by) in (_rational(s) for s in segments[near]):
        side = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        if side == 0 and min(ax, bx) <= x <= max(ax, bx) and min(ay, by) <= y <= max(ay, by):
            return 0
        winding += (ay <= y < by and side > 0) - (by <= y < ay and side < 0)
    return 1 if winding else -1


def _rational(segment: np.ndarray):
    return [(Fraction(x), Fraction(y)) for x, y in segment.tolist()]


def clip_exactly(segments: np.ndarray, start, end, side: int, near=None) -> list[tuple[Fraction, Fraction]]:
    """The parameter intervals of the segment start-end that lie in the closed region, by rationals.

    Parameters
    ----------
    segments : (m, 2, 2) float array
        The whole boundary.
    start, end : pairs of Fraction
    side : +1 or -1
        The closed region inside, or the closure of its complement.
    near : (m,) bool array, optional
        The segments that can meet it, if that is known.

    Returns
    -------
    list of (t0, t1)
        Increasing, 0 <= t0 < t1 <= 1; ``[(0, 1)]`` when all of it is contained. A segment without
        length gives ``[(0, 1)]`` or ``[]``. Isolated touching points are left out.

    Examples
    --------
    >>> triangle = np.array([[[0, 0], [3, 0]], [[3, 0], [0, 3]], [[0, 3], [0, 0]]], dtype=float)
    >>> at = lambda x, y: (Fraction(x), Fraction(y))
    >>> clip_exactly(triangle, at(-1, 1), at(5, 1), side=1)
    [(Fraction(1, 6), Fraction(1, 2))]
    """
    (px, py), (qx, qy) = start, end
    dx, dy = qx - px, qy - py
    if dx == 0 and dy == 0:
        return [(Fraction(0), Fraction(1))] if side * locate_exactly(segments, start) >= 0 else []
    cuts = {Fraction(0), Fraction(1)}
    for (ax, ay), (bx, by) in (_rational(s) for s in (segments if near is None else segments[near])):
        ex, ey = bx - ax, by - ay
        det = dx * ey - dy * ex
        if det:
            t = ((ax - px) * ey - (ay - py) * ex) / det
            s = ((ax - px) * dy - (ay - py) * dx) / det
            if 0 < t < 1 and 0 <= s <= 1:
                cuts.add(t)
        elif (ax - px) * dy == (ay - py) * dx:
            along = [((x - px) * dx + (y - py) * dy) / (dx * dx + dy * dy) for x, y in ((ax, ay), (bx, by))]
            cuts.update(t for t in along if 0 < t < 1)
    ordered = sorted(cuts)
    pieces: list[tuple[Fraction, Fraction]] = []
    for t0, t1 in pairwise(ordered):
        middle = (t0 + t1) / 2
        if side * locate_exactly(segments, (px + middle * dx, py + middle * dy)) < 0:
            continue
        if pieces and pieces[-1][1] == t0:
            pieces[-1] = (pieces[-1][0], t1)
        else:
            pieces.append((t0, t1))
    return pieces


def distance_to_segments(segments: np.ndarray, queries: np.ndarray) -> np.ndarray:
    """Distance from each query to the nearest segment; O(k m) time in chunks.

    Parameters
    ----------
    segments : (m, 2, N) float array
    queries : (k, N) float array

    Returns
    -------
    (k,) float array

    Examples
    --------
    >>> distance_to_segments(np.array([[[0, 0], [2, 0]]]), np.array([[1, 3], [5, 4]]))
    array([3., 5.])
    """
    segments, queries = np.asarray(segments, dtype=np.float64), np.asarray(queries, dtype=np.float64)
    out = np.empty(len(queries))
    step = max(1, _CHUNK // max(1, len(segments)))
    for k in range(0, len(queries), step):
        q = queries[k : k + step, None]
        out[k : k + step] = point_segment_distance(q, segments[None]).min(axis=1)
    return out


def point_segment_distance(queries: np.ndarray, segments: np.ndarray) -> np.ndarray:
    """Distance from point to segment, row by row (arrays are broadcast).

    Examples
    --------
    >>> float(point_segment_distance(np.array([1.0, 2.0]), np.array([[0.0, 0.0], [4.0, 0.0]])))
    2.0
    """
    a, direction = segments[..., 0, :], segments[..., 1, :] - segments[..., 0, :]
    length2 = (direction**2).sum(axis=-1)
    t = ((queries - a) * direction).sum(axis=-1) / np.where(length2 > 0, length2, 1)
    foot = a + np.clip(t, 0, 1)[..., None] * direction
    return np.sqrt(((queries - foot) ** 2).sum(axis=-1))
