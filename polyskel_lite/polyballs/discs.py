"""The boundary of a union of discs, as circular arcs.

Delaunay discs are the hard case, not the easy one: many circles pass through the same sample,
neighbouring circles nearly coincide when four samples are cocircular, and rounded centres and radii
keep none of this exactly. So each crossing of two circles carries the length by which rounding may
have moved it, and two crossings no further apart than their two lengths count as one. In space the
circles in which spheres cross are cut into arcs in the same way (`spheres`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .incidence import contacts, merged
from .pairs import PRECISION, ROUNDING, WORST, crossings, frames, lengths, meeting_pairs, relations, rounding
from .power import PowerTriangulation

TURN = 2 * np.pi


class Arcs(NamedTuple):
    """Arcs of circles on the boundary, counter-clockwise (in the plane the union is on their left).

    Attributes
    ----------
    ball : (a,) int array
        The disc on whose circle the arc lies; in space the row of the circle.
    start, end : (a,) float arrays
        Angles in radians, -π <= start < π and start < end <= start + 2π; equal for a whole circle.
    """

    ball: np.ndarray
    start: np.ndarray
    end: np.ndarray

    @property
    def whole(self) -> np.ndarray:
        """Which arcs are whole circles, (a,) bool array."""
        return self.end - self.start >= TURN


class Covers(NamedTuple):
    """Covered parts of circles: from `start` to `start + width`, each end known to `error` (angles)."""

    ball: np.ndarray
    start: np.ndarray
    width: np.ndarray
    error: np.ndarray

    @classmethod
    def about(cls, ball, x, y, above, below, error) -> Covers:
        """Parts on both sides of the direction (x, y), by the half-angle formula tan²(half) = above / below.

        Near tangency the law of cosines would lose half of the digits.

        Examples
        --------
        >>> one = np.ones(1)
        >>> Covers.about([0], one, 0 * one, one, one, 0 * one).width.round(6).tolist()
        [3.141593]
        """
        half = 2 * np.arctan2(np.sqrt(above), np.sqrt(below))
        return cls(ball, np.arctan2(y, x) - half, 2 * half, error)


class Circles(NamedTuple):
    """Circles on which arcs of the boundary lie: those of discs, or those in which two spheres cross.

    Attributes
    ----------
    pairs : (m, 2) int array
        The two balls, i < j; of a disc its own number, twice.
    centers : (m, N) float array
    radii : (m,) float array
    frames : (m, N, N) float array
        Rows: two unit vectors in the plane of the circle, from which angles count; its axis from i to j.
    """

    pairs: np.ndarray
    centers: np.ndarray
    radii: np.ndarray
    frames: np.ndarray

    @classmethod
    def between(cls, centers, radii, pairs) -> Circles:
        """Those in which the spheres of crossing pairs of balls meet.

        Examples
        --------
        >>> balls = np.array([(0.0, 0, 0), (1, 0, 0)]), np.ones(2), np.array([(0, 1)])
        >>> Circles.between(*balls).centers.tolist()
        [[0.5, 0.0, 0.0]]
        """
        middles, sizes, axes = crossings(centers, radii, pairs)
        return cls(pairs, middles, sizes, frames(axes))

    def points(self, circle: np.ndarray, angle: np.ndarray) -> np.ndarray:
        """Points at given angles on given circles, (m, N).

        Examples
        --------
        >>> unit = Circles(np.array([[0, 1]]), np.zeros((1, 3)), np.ones(1), np.eye(3)[None])
        >>> unit.points(np.array([0]), np.array([np.pi])).round(3).tolist()
        [[-1.0, 0.0, 0.0]]
        """
        x, y = self.frames[circle, 0], self.frames[circle, 1]
        swing = np.cos(angle)[:, None] * x + np.sin(angle)[:, None] * y
        return self.centers[circle] + self.radii[circle, None] * swing


class Boundary(NamedTuple):
    """What is on the boundary of a union of balls.

    Attributes
    ----------
    exposed : (k,) bool array
        Balls with a piece of their sphere on the boundary.
    circles : Circles
        In the plane of all discs, in space those with an arc on the boundary.
    arcs : Arcs
        The arcs of the boundary; ``ball`` is the row of the circle.
    corners : (s, N) float array
        The singular points: ends of arcs, and in the plane points where discs touch.
    touching : (q, 2) int array
        Balls that touch from outside in a point of the boundary.
    sound : bool
        Whether the arcs close up; not so where too many balls nearly coincide for floating-point numbers.
    """

    exposed: np.ndarray
    circles: Circles
    arcs: Arcs
    corners: np.ndarray
    touching: np.ndarray
    sound: bool = True


def ends_of(arcs: Arcs, errors: np.ndarray, circles: Circles) -> tuple[np.ndarray, np.ndarray]:
    """Where arcs that are not whole circles start and end, and by how much each end may be off, a length.

    Parameters
    ----------
    arcs, errors
        As `uncovered` returns them.
    circles : Circles

    Examples
    --------
    >>> half = Arcs(np.array([0]), np.zeros(1), np.array([np.pi]))
    >>> circle = Circles(np.array([[0, 0]]), np.zeros((1, 2)), np.ones(1), np.eye(2)[None])
    >>> ends_of(half, np.zeros((2, 1)), circle)[0].round(6).tolist()
    [[1.0, 0.0], [-1.0, 0.0]]
    """
    part = ~arcs.whole
    circle = np.tile(arcs.ball[part], 2)
    ends, size = circles.points(circle, np.append(arcs.start[part], arcs.end[part])), circles.radii[circle]
    return ends, errors[:, part].ravel() * size + ROUNDING * (np.abs(ends).max(axis=1, initial=0) + size)


def uncovered(covers: Covers, kept: np.ndarray) -> tuple[Arcs, np.ndarray]:
    """What the covered parts leave of the circles in `kept`, and the errors (2, a) of both ends as angles.

    Examples
    --------
    >>> one = np.ones(1)
    >>> arcs, _ = uncovered(Covers(np.array([0]), 0 * one, np.pi * one, 0 * one), np.array([0, 1]))
    >>> arcs.ball.tolist(), np.degrees(arcs.end - arcs.start).tolist()
    ([0, 1], [180.0, 360.0])
    """
    whole = np.setdiff1d(kept, covers.ball)
    ball, origin, start, end, error = _unrolled(covers)
    # Sweep along each circle: an arc opens where a part starts beyond the furthest end so far. Parts
    # are widened by their errors, so that a gap which rounding may have opened stays shut.
    order = np.lexsort((start - error, ball))
    ball, origin, start, end, error = (values[order] for values in (ball, origin, start, end, error))
    furthest = _furthest_so_far(ball, end + error)[:-1]
    gap = (ball[1:] == ball[:-1]) & ((start - error)[1:] > (end + error)[furthest])
    before, after = furthest[gap], np.flatnonzero(gap) + 1
    first = _wrapped(origin[before] + end[before])
    found = np.array([first, first + (start[after] - end[before]), error[before], error[after]])
    whole_turns = np.tile([[-np.pi], [np.pi], [0], [0]], len(whole))
    ball, found = np.append(ball[before], whole), np.concatenate([found, whole_turns], axis=1)
    order = np.lexsort((found[0], ball))
    start, end, *errors = found[:, order]
    return Arcs(ball[order], start, end), np.array(errors)


def _unrolled(covers: Covers) -> tuple[np.ndarray, ...]:
    """Covered parts as intervals of a line: per circle from the start of one part once around to it again."""
    ball, start, width, error = covers
    balls, first = np.unique(ball, return_index=True)
    origin = (start - error)[first][np.searchsorted(balls, ball)]
    turned = (start - origin) % TURN
    end = turned + width
    over = np.flatnonzero(end + error > TURN)  # these cover the beginning of the line as well
    index = np.concatenate([np.arange(len(ball)), over, first])
    shift = np.repeat([0.0, -TURN, TURN], [len(ball), len(over), len(first)])
    return ball[index], origin[index], turned[index] + shift, end[index] + shift, error[index]


def _furthest_so_far(ball: np.ndarray, reach: np.ndarray) -> np.ndarray:
    """For each interval, which one reaches furthest among itself and those before it on its circle."""
    by_reach = np.lexsort((reach, ball))
    rank = np.empty(len(ball), dtype=np.intp)
    rank[by_reach] = np.arange(len(ball))
    # Ranks grow from circle to circle, so one running maximum serves all circles.
    return by_reach[np.maximum.accumulate(rank)]


def _wrapped(angle: np.ndarray) -> np.ndarray:
    """The angle in [-π, π)."""
    turned = (angle + np.pi) % TURN - np.pi
    return np.where(turned >= np.pi, -np.pi, turned)


def disc_boundary(centers, radii, power: PowerTriangulation | None = None) -> Boundary:
    """Find the arcs of the boundary of a union of closed discs, and the points where circles meet on it.

    Discs in a larger disc have no arc; of equal discs the first has them all. Where two discs touch
    from outside, the touching point is a corner, but no arc ends there.

    Parameters
    ----------
    centers : (k, 2) float array
    radii : (k,) float array
        Positive.
    power : PowerTriangulation, optional
        Of the same discs: then only pairs whose power cells meet are looked at.

    Returns
    -------
    Boundary

    Examples
    --------
    >>> centers, radii = np.array([(0.0, 0.0), (1.0, 0.0), (0.1, 0.0)]), np.array([1, 1, 0.2])
    >>> found = disc_boundary(centers, radii)
    >>> arcs = found.arcs
    >>> arcs.ball, np.degrees(arcs.start).round(), np.degrees(arcs.end).round()
    (array([0, 1]), array([  60., -120.]), array([300., 120.]))
    >>> sorted(found.corners.round(3).tolist())
    [[0.5, -0.866], [0.5, 0.866]]
    """
    row = np.arange(len(radii))
    circles = Circles(np.column_stack([row, row]), centers, radii, np.tile(np.eye(2), (len(row), 1, 1)))
    i, j = meeting_pairs(centers, radii) if power is None else power.faces(2).T
    gone, crossing, touching = relations(centers, radii, i, j)
    if power is not None:
        gone |= ~np.isin(row, power.faces(1))
    arcs, errors = uncovered(_covers(centers, radii, *crossing.T), np.flatnonzero(~gone))
    ends, slack = ends_of(arcs, errors, circles)
    touching, points = contacts(centers, radii, touching)
    corners = merged(np.concatenate([ends, points]), np.append(slack, np.zeros(len(points))))
    return Boundary(np.isin(row, arcs.ball), circles, arcs, corners, touching)


def _covers(centers, radii, i, j) -> Covers:
    """The part of circle i in disc j, and of circle j in disc i, for discs that cross."""
    i, j = np.concatenate([i, j]), np.concatenate([j, i])
    ri, rj = radii[i], radii[j]
    across = centers[j] - centers[i]
    d = lengths(across)
    # For the angle at c_i in the triangle (c_i, c_j, crossing).
    above = np.maximum((rj - d + ri) * (rj + d - ri), 0)
    below = np.maximum((d + ri - rj) * (d + ri + rj), 0)
    # A crossing moves by (error of the discs) / (sine of the angle at which the circles cross).
    believed = PRECISION * (ri + rj) + rounding(centers, radii, i, j)
    sine = np.sqrt(above) * np.sqrt(below) / (2 * ri * rj)
    with np.errstate(divide="ignore"):
        error = np.minimum(believed / sine, np.maximum(WORST * np.minimum(ri, rj), believed))
    return Covers.about(i, across[:, 0], across[:, 1], above, below, error / ri)
