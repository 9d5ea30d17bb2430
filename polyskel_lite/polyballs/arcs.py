"""Arcs of circles: what is left when parts of circles are covered, each part known to an error of its own.

Neighbouring circles nearly coincide when many samples are almost cocircular, and rounded centres and radii
keep nothing exactly. So each end of a covered part carries the angle by which rounding may have moved it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .pairs import ROUNDING

TURN = 2 * np.pi


class Arcs(NamedTuple):
    """Arcs of the boundary of a union of discs, counter-clockwise (the union on their left).

    Attributes
    ----------
    ball : (a,) int array
        The disc on whose circle the arc lies.
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


def ends_of(arcs: Arcs, errors: np.ndarray, radii: np.ndarray, points) -> tuple[np.ndarray, np.ndarray]:
    """Where arcs that are not whole circles start and end, and by how much each end may be off, a length.

    Parameters
    ----------
    arcs, errors
        As `uncovered` returns them.
    radii : (k,) float array
        Of the circles.
    points : callable
        ``(circles, angles) -> (m, N) float array``, places on circles.

    Examples
    --------
    >>> half = Arcs(np.array([0]), np.zeros(1), np.array([np.pi]))
    >>> ends_of(half, np.zeros((2, 1)), np.ones(1), lambda _, angle: np.cos(angle)[:, None])[0].tolist()
    [[1.0], [-1.0]]
    """
    part = ~arcs.whole
    circle = np.tile(arcs.ball[part], 2)
    ends = points(circle, np.concatenate([arcs.start[part], arcs.end[part]]))
    slack = errors[:, part].ravel() * radii[circle]
    return ends, slack + ROUNDING * (np.abs(ends).max(axis=1, initial=0) + radii[circle])


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
    none = np.zeros(len(whole))
    arcs = Arcs(
        np.concatenate([ball[before], whole]),
        np.concatenate([first, none - np.pi]),
        np.concatenate([first + (start[after] - end[before]), none + np.pi]),
    )
    errors = np.array([np.concatenate([error[before], none]), np.concatenate([error[after], none])])
    order = np.lexsort((arcs.start, arcs.ball))
    return Arcs(*(values[order] for values in arcs)), errors[:, order]


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
