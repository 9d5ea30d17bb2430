"""Generating balls of a polyball: which ones are needed, which meet no other, which only meet in pairs."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from .pairs import crossings, gaps, lengths, meeting_graph, meeting_pairs, rounding

# A ball reaches a place when it misses it by less than this share of its radius.
_REACH = 1e-12
# A ball is needed if a hole between the others reaches deeper into it than this share of its radius.
_DEPTH = 1e-9


def distinct(centers: np.ndarray, radii: np.ndarray) -> np.ndarray:
    """The balls that are not equal, up to rounding, to one before them, (d,) int array.

    Examples
    --------
    >>> import numpy as np
    >>> distinct(np.array([(0.0, 0), (1, 0), (0, 0), (0, 0)]), np.array([1, 1, 1, 2])).tolist()
    [0, 1, 3]
    """
    first = np.sort(np.unique(np.column_stack([centers, radii]), axis=0, return_index=True)[1])
    centers, radii = centers[first], radii[first]
    size = np.abs(centers).max(axis=1) + radii
    i, j = cKDTree(centers).query_pairs(1e-12 * size.max(), output_type="ndarray").T
    apart = lengths(centers[i] - centers[j]) + np.abs(radii[i] - radii[j])
    return np.delete(first, np.maximum(i, j)[apart <= 1e-12 * np.minimum(radii[i], radii[j])])


def alike(centers: np.ndarray, radii: np.ndarray, share: float) -> tuple[np.ndarray, np.ndarray]:
    """Take one ball, a little larger, for all that differ from it by less than a share of its radius.

    Returns
    -------
    rows : (m,) int array
        The balls that are left, large ones first.
    radii : (m,) float array
        With these radii they hold those that are left out.

    Examples
    --------
    >>> import numpy as np
    >>> rows, radii = alike(np.array([(0.0, 0), (1e-7, 0), (1, 0)]), np.array([1, 1, 0.5]), 1e-6)
    >>> rows.tolist(), radii.tolist()
    ([0, 2], [1.0000001, 0.5])
    """
    tree, free, rows, grown = cKDTree(centers), np.ones(len(radii), dtype=bool), [], []
    for ball in np.argsort(-radii, kind="stable"):
        if free[ball]:
            near = np.array(tree.query_ball_point(centers[ball], share * radii[ball]))
            reach = lengths(centers[near] - centers[ball])
            same = free[near] & (reach + radii[ball] - radii[near] <= share * radii[ball])
            free[near[same]] = False
            rows.append(ball)
            grown.append((reach + radii[near])[same].max())
    return np.array(rows), np.array(grown)


def needed(centers, radii, exposed, hidden, room_in) -> np.ndarray:
    """Leave out balls that lie in the union of the others, smallest first; the indices of the rest, sorted.

    Parameters
    ----------
    centers : (k, N) float array
    radii : (k,) float array
        No two balls equal.
    exposed : (k,) bool array
        Balls with a piece of the boundary: these are needed.
    hidden : (k,) bool array
        Balls with an empty power cell: these are not, all at once.
    room_in : callable
        ``(centers, radii, point) -> float``, the radius of the largest ball around a point that lies in the
        union, negative if the point does not.

    Examples
    --------
    Three discs around a small gap, and a fourth one that fills it:

    >>> import numpy as np, polyskel_lite as psl
    >>> centers = np.array([(1.1, 0), (-0.55, 0.9526), (-0.55, -0.9526), (0, 0.05)])
    >>> def room(c, r, point):
    ...     Y = psl.Polyball(c, r)
    ...     return Y.boundary_distance([point])[0] if Y.contains([point])[0] else -1.0
    >>> radii, outer = np.array([1, 1, 1, 0.3]), np.array([True, True, True, False])
    >>> needed(centers, radii, outer, np.zeros(4, dtype=bool), room).tolist()
    [0, 1, 2, 3]
    """
    keep = ~hidden | exposed
    candidates = np.flatnonzero(keep & ~exposed)
    if not len(candidates):
        return np.flatnonzero(keep)
    graph = meeting_graph(centers, radii)
    for ball in candidates[np.argsort(radii[candidates], kind="stable")]:
        others = graph.indices[graph.indptr[ball] : graph.indptr[ball + 1]]
        others = others[keep[others]]
        # Its sphere is covered, so a place that it covers alone is in a hole between the others. The corners
        # of the hole may all be on its sphere (Delaunay balls), so that only the distance to arcs tells.
        room = room_in(centers[others], radii[others], centers[ball])
        keep[ball] = bool(room < (1 - _DEPTH) * radii[ball])
    return np.flatnonzero(keep)


def lonely(centers, radii) -> np.ndarray:
    """The balls that meet no other one (definition 2), sorted.

    Examples
    --------
    >>> import numpy as np
    >>> lonely(np.array([(0.0, 0), (1, 0), (5, 0)]), np.ones(3)).tolist()
    [2]
    """
    i, j = meeting_pairs(centers, radii)
    met = gaps(centers, radii, i, j) <= rounding(centers, radii, i, j)
    return np.setdiff1d(np.arange(len(radii)), [i[met], j[met]])


def isolated_lenses(centers, radii, pairs) -> np.ndarray:
    """Those of the crossing pairs whose common part meets no third ball (definition 3), (q,) bool array.

    Parameters
    ----------
    centers : (k, N) float array
    radii : (k,) float array
    pairs : (q, 2) int array

    Examples
    --------
    The third ball stays away from the lens of the first two, then not:

    >>> import numpy as np
    >>> for x in (2.5, 1.5):
    ...     balls = np.array([(0.0, 0, 0), (1, 0, 0), (x, 0, 0)])
    ...     isolated_lenses(balls, np.ones(3), np.array([(0, 1)])).tolist()
    [True]
    [False]
    """
    alone = np.ones(len(pairs), dtype=bool)
    for row, (pair, *circle) in enumerate(zip(pairs, *crossings(centers, radii, pairs), strict=True)):
        others = np.setdiff1d(np.arange(len(radii)), pair)
        gap = _distance_to_lens(centers[others], centers[pair], radii[pair], *circle)
        alone[row] = not (gap <= radii[others] * (1 + _REACH)).any()
    return alone


def _distance_to_lens(points, centers, radii, circle_center, circle_radius, axis) -> np.ndarray:
    """Distance from points to the common part of two balls."""
    nearest = np.full(len(points), np.inf)
    for a, b in ((0, 1), (1, 0)):
        offset = points - centers[a]
        far = lengths(offset)
        outside = np.maximum(far - radii[a], 0)
        share = np.minimum(far, radii[a]) / np.maximum(far, np.finfo(float).tiny)
        foot = centers[a] + offset * share[:, None]
        # The nearest point of one ball, if it is in the other one too, is the nearest of both.
        both = lengths(foot - centers[b]) <= radii[b]
        nearest[both] = np.minimum(nearest[both], outside[both])
    offset = points - circle_center
    along = offset @ axis
    across = np.sqrt(np.maximum((offset**2).sum(axis=1) - along**2, 0))
    return np.where(np.isinf(nearest), np.hypot(along, across - circle_radius), nearest)
