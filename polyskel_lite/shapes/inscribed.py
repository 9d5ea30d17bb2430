"""The largest ball inside a shape: of the boundary itself, not of samples."""

from __future__ import annotations

from operator import attrgetter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..exact import locate, nearest_facets, nearest_on_facets
from ..graphs import delaunay

# Cells are halved until they are this share of the largest radius, or so many.
_FINE, _MOST_CELLS = 0.02, 60_000
# Centres nearer than this share of the radius to one that was tried lead to the same ball; so many are tried.
_APART, _MOST_TRIES = 0.5, 64
_MOST_STEPS = 60
_RADIUS = attrgetter("radius")

_CORNERS = {n: np.stack(np.meshgrid(*[[-1, 1]] * n), axis=-1).reshape(-1, n) for n in (2, 3)}


class Ball(NamedTuple):
    """A ball: what `Shape.largest_ball` returns.

    Attributes
    ----------
    center : (N,) float array
    radius : float
    """

    center: NDArray[np.float64]
    radius: float


def largest_inside(points: np.ndarray, facets: np.ndarray) -> Ball:
    """The largest ball inside a boundary; see `Shape.largest_ball`.

    Examples
    --------
    >>> square = np.array([(0.0, 0), (2, 0), (2, 2), (0, 2)])
    >>> largest_inside(square, np.array([(0, 1), (1, 2), (2, 3), (3, 0)])).center.round(12).tolist()
    [1.0, 1.0]
    """
    low, exponent = points.min(axis=0), int(np.frexp(np.ptp(points, axis=0).max())[1])
    points = np.ldexp(points - low, -exponent)  # about the size of one, near the origin
    boundary, n = points[facets], points.shape[1]

    def depths(places: np.ndarray) -> np.ndarray:
        """Distance to the boundary, negative outside."""
        return nearest_facets(boundary, places)[0] * np.where(locate(boundary, places) < 0, -1, 1)

    corners = delaunay(points)
    starts = np.concatenate([corners.circumcenters, points[corners.simplices].mean(axis=1)])
    starts = starts[(np.abs(starts - 0.5) <= 1).all(axis=1)]  # in the box of the shape, or near it
    depth = depths(starts)
    best = _grown(boundary, starts[depth.argmax()]) if depth.max() > 0 else Ball(points[0], 0.0)
    # No ball around a place in a cell is larger than the one around its middle by more than the way there.
    span = np.ptp(points, axis=0)
    half = max(span.min() / 4, (span.prod() / 2_000) ** (1 / n) / 2)
    while np.prod(np.ceil(span / half / 2)) > _MOST_CELLS:  # a box that is nearly flat has many along it
        half *= 2
    axes = [half * (2 * np.arange(np.ceil(x / half / 2)) + 1) for x in span]
    cells = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, n)
    while True:
        depth, reach = depths(cells), half * np.sqrt(n)
        if depth.max() > best.radius:
            best = max(best, _grown(boundary, cells[depth.argmax()]), key=_RADIUS)
        left = depth + reach > best.radius
        cells, depth = cells[left], depth[left]
        if reach <= _FINE * best.radius or not 0 < len(cells) << n <= _MOST_CELLS:
            break
        half /= 2
        cells = (cells[:, None] + half * _CORNERS[n]).reshape(-1, n)
    tried = best.center[None]
    for k in np.argsort(-depth, kind="stable").tolist():
        if (np.linalg.norm(tried - cells[k], axis=1) > _APART * best.radius).all():
            tried = np.append(tried, cells[[k]], axis=0)
            best = max(best, _grown(boundary, cells[k]), key=_RADIUS)
            if len(tried) > _MOST_TRIES:
                break
    best = _centred(boundary, best)
    return Ball(np.ldexp(best.center, exponent) + low, float(np.ldexp(best.radius, exponent)))


def _grown(boundary: np.ndarray, center: np.ndarray) -> Ball:
    """The ball that cannot grow any more when it is moved.

    Each facet is convex: a plane through its nearest point keeps it out. The largest ball among all these
    planes is inside the shape, and no smaller than the last one; near the end its planes are the true ones.
    """
    ball, place = Ball(center, 0.0), center
    for _ in range(_MOST_STEPS):
        normals, distance = _planes(boundary, place)
        radius = float(distance.min())
        if radius <= ball.radius * (1 + 1e-15) or locate(boundary, place[None])[0] <= 0:
            break
        ball = Ball(place, radius)
        # No other facet is in reach of one step, in which the ball moves and grows by its radius at most.
        close = distance <= 5 * radius
        step = _best(normals[close], distance[close] / radius, reach=1.0)
        if step is None:
            break
        place = place + radius * step[:-1]
    return ball


def _centred(boundary: np.ndarray, ball: Ball) -> Ball:
    """Of equally large balls around places that form a line or an area, as in a bar, one in the middle."""
    normals, distance = _planes(boundary, ball.center)
    room = distance / ball.radius
    found = [_best(normals, room, aim=sign * axis) for axis in np.eye(len(ball.center)) for sign in (1, -1)]
    places = [place for place in found if place is not None]
    if len(places) < len(found):
        return ball
    ends = np.stack(places).reshape(-1, 2, len(places[0]))
    # What is between two such places is one: a mean in which the pairs count that are far apart.
    spread = [pair[0][k] - pair[1][k] for k, pair in enumerate(ends)]
    if max(spread) < 1e-6:
        return ball
    center = ball.center + ball.radius * np.average(np.mean(ends, axis=1), axis=0, weights=spread)[:-1]
    moved = _grown(boundary, center)
    return moved if moved.radius >= ball.radius * (1 - 1e-12) else ball


def _planes(boundary: np.ndarray, center: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The direction from the nearest point of each facet, and the distance to it."""
    away = center - nearest_on_facets(np.broadcast_to(center, (len(boundary), len(center))), boundary)
    distance = np.linalg.norm(away, axis=1)
    return away / np.maximum(distance, 1e-300)[:, None], distance


def _best(normals: np.ndarray, room: np.ndarray, reach=None, aim=None) -> np.ndarray | None:
    """The way to the centre of the largest ball among planes, and its radius, (N + 1,).

    With an aim the way that leads farthest in its direction, to a ball of radius 1; None if none is found.
    """
    from scipy.optimize import linprog  # it takes as long to load as the rest of the library

    n = normals.shape[1]
    sides = np.column_stack([-normals, np.ones(len(normals))])
    bounds = [(None if reach is None else -reach, reach)] * n + [(0.0 if aim is None else 1.0, None)]
    goal = -np.eye(n + 1)[n] if aim is None else -np.append(aim, 0.0)
    return linprog(goal, sides, room, bounds=bounds, method="highs").x
