"""Distance from points to the boundary of a union of balls, exact to rounding.

The nearest point of the boundary is straight ahead of the middle of a circle on one of its arcs, or the end
of an arc. In space, it is the distance to the nearest ball outside; inside, the nearest point can be straight
ahead of a centre on a patch of its sphere as well. Arcs and spheres that are farther than the best point
found so far are never looked at.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.distance import cdist

from ..exact import octaves, spread_out
from .discs import TURN, Boundary
from .pairs import rounding
from .union import BallUnion

_CHUNK = 400_000  # point-ball pairs looked at together: what fits a cache, not the result
_BELIEVED = 1e-12  # share of the size: where this decides, the point is taken for the end of an arc
_PIECE = np.pi / 4  # arcs are found by pieces that turn by no more than this


def distance_to_boundary(queries: np.ndarray, union: BallUnion) -> np.ndarray:
    """Measure the distance from points inside or outside to the boundary of a union of balls.

    Parameters
    ----------
    queries : (m, N) float array
        Seen from the origin of the union.
    union : BallUnion

    Returns
    -------
    (m,) float array
        Never negative.

    Examples
    --------
    From the midpoint of two unit balls the nearest points are on their circle:

    >>> two = BallUnion(np.array([(-0.5, 0, 0), (0.5, 0, 0)]), np.ones(2))
    >>> queries = np.array([(0, 0, 0), (-0.5, 0, 0), (-1.2, 0, 0), (2.5, 0, 0)])
    >>> distance_to_boundary(queries, two).round(4).tolist()
    [0.866, 1.0, 0.3, 1.0]
    """
    if not union.in_space:
        return _to_arcs(queries, union.boundary)
    distance = _to_balls(queries, union.centers, union.radii)
    # A point on many spheres that surround it is in no open ball, but inside the union all the same.
    believed = _BELIEVED * (np.abs(union.centers).max() + union.radii.max())
    inside = np.flatnonzero(distance <= believed)
    if len(inside):
        points = queries[inside]
        best = _to_arcs(points, union.boundary)
        _to_patches(points, union, best)
        distance[inside] = best
    return distance


def _to_balls(points, centers, radii) -> np.ndarray:
    """Distance to the nearest ball, negative inside."""
    parts = _chunks(len(points), len(radii))
    return np.concatenate([(cdist(points[rows], centers) - radii).min(axis=1) for rows in parts])


def _chunks(count: int, width: int) -> list[slice]:
    """Rows of a table in parts that a cache holds."""
    step = max(1, _CHUNK // width)
    return [slice(first, first + step) for first in range(0, max(1, count), step)]


def _to_arcs(points, boundary: Boundary) -> np.ndarray:
    """Distance to the nearest arc, ends included; infinite if there is none."""
    if not len(points):
        return np.zeros(0)
    circles, arcs = boundary.circles, boundary.arcs
    row, start, end = arcs
    size = np.ceil((end - start) / _PIECE).astype(np.intp)
    arc, number = spread_out(size)
    half = ((end - start) / size / 2)[arc]
    middles = circles.points(row[arc], start[arc] + (2 * number + 1) * half)
    ends = circles.points(np.tile(row, 2), np.concatenate([start, end]))
    best = cKDTree(np.concatenate([ends, boundary.corners])).query(points)[0]

    def straight_ahead(pairs):
        """The nearest point of a circle is straight ahead of its middle; it counts if it is on the arc."""
        point, found = pairs // len(row), pairs % len(row)
        seen = points[point] - circles.centers[row[found]]
        x, y, *z = np.einsum("mck,mk->cm", circles.frames[row[found]], seen)
        on = arcs.whole[found] | ((np.arctan2(y, x) - start[found]) % TURN <= (end - start)[found])
        gap = np.hypot(z[0] if z else 0, np.hypot(x, y) - circles.radii[row[found]])
        np.minimum.at(best, point[on], gap[on])

    if len(points) * len(row) <= _CHUNK:
        straight_ahead(np.arange(len(points) * len(row)))
        return best
    reach = half * circles.radii[row[arc]]
    bound = cKDTree(middles).query(points)[0]
    # One search radius for pieces of about the same length, so that short ones are not searched for in vain.
    for group in octaves(reach):
        near = cKDTree(middles[group]).query_ball_point(
            points, np.minimum(best, bound) * (1 + 1e-9) + reach[group].max()
        )
        point = np.repeat(np.arange(len(points)), [len(found) for found in near])
        piece = group[np.concatenate([np.asarray(found, dtype=np.int64) for found in near])]
        straight_ahead(np.unique(point * len(row) + arc[piece]))
    return best


def _to_patches(points, union: BallUnion, best) -> None:
    """Lower `best` to the distance of the nearest point straight ahead of a centre that is in no cap."""
    centers, radii, covered = union.centers, union.radii, union.caps
    balls = np.flatnonzero(union.exposed)
    size = np.diff(covered.first)
    # A foot on the edge of a cap is left to the arc there, if there is one: where many edges meet in a point
    # that they surround, there is none.
    edge = _BELIEVED * np.sqrt(np.maximum(1 - covered.heights**2, 0))
    at = covered.ball
    heights = covered.heights - edge - rounding(centers, radii, at, at) / radii[at]
    for rows in _chunks(len(points), len(balls)):
        far = cdist(points[rows], centers[balls])
        gap = np.abs(far - radii[balls])
        row, column = np.nonzero(gap < best[rows, None])
        far, gap = far[row, column], gap[row, column]
        point, ball = rows.start + row, balls[column]
        rank = 0
        while len(point):
            free = size[ball] <= rank
            np.minimum.at(best, point[free], gap[free])
            # What the larger caps leave is tried on the next smaller one, if it can still be the nearest.
            left = ~free & (gap < best[point])
            point, ball, far, gap = point[left], ball[left], far[left], gap[left]
            cap = covered.first[ball] + rank
            along = ((points[point] - centers[ball]) * covered.axes[cap]).sum(axis=1)
            out = along <= heights[cap] * far
            point, ball, far, gap = point[out], ball[out], far[out], gap[out]
            rank += 1
