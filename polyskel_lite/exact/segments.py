"""Segments in the plane: which ones meet, and which of their points is the nearest one.

This is the floor below `Shape`: signs are exact (see `predicates`), searching is a sweep along one axis.
"""

from __future__ import annotations

import numpy as np

from .boxes import overlaps_of, self_overlaps
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
    low, high, found = ends.min(axis=1), ends.max(axis=1), []
    for i, j in self_overlaps(low, high) if doubtful is None else overlaps_of(doubtful, low, high):
        shared = facets[i][:, :, None] == facets[j][:, None, :]
        apart = ~shared.any(axis=(1, 2))
        bad = np.zeros(len(i), dtype=bool)
        bad[apart] = segments_meet(ends[i[apart]], ends[j[apart]])
        bad[~apart] = _on_each_other(points, facets[i[~apart]], facets[j[~apart]], shared[~apart])
        found += sorted(zip(i[bad].tolist(), j[bad].tolist(), strict=True))[:1]
    return min(found, default=None)


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
