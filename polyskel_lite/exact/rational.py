"""Fractions: rational points against segments and triangles, the last word where floats are in doubt.

Points are tuples of fractions, in the plane and in space alike.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np

Point = tuple[Fraction, ...]
#: The three coordinate planes: whatever is not flat in space has a shadow in one that is not flat.
PLANES = ((0, 1), (1, 2), (2, 0))


def exact(point) -> Point:
    """A float point as fractions.

    Examples
    --------
    >>> exact([0.5, 0, 3])[0]
    Fraction(1, 2)
    """
    return tuple(Fraction(x) for x in np.asarray(point, dtype=float).tolist())


def minus(a: Point, b: Point) -> Point:
    """The way from b to a.

    Examples
    --------
    >>> minus((3, 2), (1, 1))
    (2, 1)
    """
    return tuple(x - y for x, y in zip(a, b, strict=True))


def dot(a: Point, b: Point) -> Fraction:
    """The inner product.

    Examples
    --------
    >>> dot((3, 2), (1, 1))
    5
    """
    return sum(x * y for x, y in zip(a, b, strict=True))


def between(a: Point, b: Point, t: Fraction) -> Point:
    """The point at a share t of the way from a to b.

    Examples
    --------
    >>> between((0, 0), (4, 2), Fraction(1, 2))
    (Fraction(2, 1), Fraction(1, 1))
    """
    return tuple(x + t * (y - x) for x, y in zip(a, b, strict=True))


def normal_of(*corners: Point) -> Point:
    """A normal of a segment in the plane, to its right, or of a triangle in space, not of length one.

    Examples
    --------
    >>> normal_of((0, 0), (2, 0)), normal_of((0, 0, 0), (1, 0, 0), (0, 1, 0))
    ((0, -2), (0, 0, 1))
    """
    u, *others = (minus(corner, corners[0]) for corner in corners[1:])
    return (u[1], -u[0]) if not others else _cross(u, *others)


def _cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _turn(a, b, q, i=0, j=1):
    """Twice the area of the triangle a b q in the plane of two coordinates."""
    return (b[i] - a[i]) * (q[j] - a[j]) - (b[j] - a[j]) * (q[i] - a[i])


def circumcenter_terms(d: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Twice the determinant of sides d (t, N, N) of simplices, and that times the way to the circumcenter.

    Polynomials, so that floats, Python's whole numbers and fractions can all be put in.

    Examples
    --------
    >>> circumcenter_terms(np.array([[[2, 0], [0, 4]]]))
    (array([16]), array([[16, 32]]))
    """
    lift = (d * d).sum(axis=2)
    if d.shape[2] == 2:
        (ax, ay), (bx, by) = d[:, 0].T, d[:, 1].T
        numerator = [by * lift[:, 0] - ay * lift[:, 1], ax * lift[:, 1] - bx * lift[:, 0]]
        return 2 * (ax * by - ay * bx), np.stack(numerator, axis=1)
    a, b, c = d[:, 0], d[:, 1], d[:, 2]
    # numpy.cross does not take Python's unbounded integers.
    bc, ca, ab = (np.stack(_cross(u.T, v.T), axis=1) for u, v in ((b, c), (c, a), (a, b)))
    return 2 * (a * bc).sum(axis=1), lift[:, :1] * bc + lift[:, 1:2] * ca + lift[:, 2:] * ab


def rational_circumcenter(simplex: np.ndarray) -> Point:
    """Circumcenter of a triangle (3, 2) or tetrahedron (4, 3) that is not flat.

    Examples
    --------
    >>> rational_circumcenter(np.array([(0, 0), (1, 0), (0, 3)]))
    (Fraction(1, 2), Fraction(3, 2))
    >>> rational_circumcenter(np.array([(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 3)]))
    (Fraction(1, 1), Fraction(1, 1), Fraction(3, 2))
    """
    corners = np.array([exact(corner) for corner in simplex], dtype=object)
    (twice,), (way,) = circumcenter_terms((corners[1:] - corners[:1])[None])
    return tuple((corners[0] + way / twice).tolist())


def locate_rational(boundary: np.ndarray, q: Point) -> int:
    """+1 if a rational point is inside a closed boundary (m, N, N), 0 on it, -1 outside.

    The boundary as for `locate` (segments, interior on the left) or `locate_in_mesh` (outward triangles).

    Examples
    --------
    >>> triangle = np.array([[[0, 0], [1, 0]], [[1, 0], [0, 1]], [[0, 1], [0, 0]]], dtype=float)
    >>> locate_rational(triangle, (Fraction(1, 3), Fraction(2, 3)))
    0
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    >>> tetrahedron = points[[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]]
    >>> [locate_rational(tetrahedron, (x, x, x)) for x in (Fraction(1, 4), Fraction(1, 3), Fraction(1, 2))]
    [1, 0, -1]
    """
    at = np.array([float(x) for x in q])
    # A ray to the right, or upward in space, meets what is left; far wider than the rounding of the query.
    slack = 1e-9 * (1 + np.abs(at).max())
    low, high = boundary.min(axis=1), boundary.max(axis=1)
    across = slice(1, 2) if len(q) == 2 else slice(0, 2)
    near = (low[:, across] <= at[across] + slack).all(axis=1) & (high >= at - slack).all(axis=1)
    winding, passes = 0, _passes_segment if len(q) == 2 else _passes_triangle
    for corners in boundary[near]:
        passed = passes(*(exact(corner) for corner in corners), q)
        if passed is None:
            return 0
        winding += passed
    return 1 if winding else -1


def _passes_segment(a, b, q) -> int | None:
    """What a ray to the right winds around at a segment; None if the point is on it."""
    side = _turn(a, b, q)
    if side == 0 and all(min(x, y) <= z <= max(x, y) for x, y, z in zip(a, b, q, strict=True)):
        return None
    return (a[1] <= q[1] < b[1] and side > 0) - (b[1] <= q[1] < a[1] and side < 0)


def _passes_triangle(a, b, c, q) -> int | None:
    """What a ray upward winds around at a triangle; None if the point is on it."""
    side = dot(normal_of(a, b, c), minus(q, a))
    if side == 0 and _in_triangle(a, b, c, q):
        return None
    turns = {_shifted_turn(x, y, q) for x, y in ((a, b), (b, c), (c, a))}
    if len(turns) == 1 and (turn := turns.pop()) and (side > 0) - (side < 0) == -turn:
        return turn
    return 0


def _in_triangle(a, b, c, q) -> bool:
    """Whether a point of the plane of a triangle is in the triangle."""
    for plane in PLANES:
        turns = [_turn(x, y, q, *plane) for x, y in ((a, b), (b, c), (c, a))]
        if min(turns) < 0 < max(turns):
            return False
    return True


def _shifted_turn(a, b, q) -> int:
    # As in `triangles.locate_in_mesh`: the query is moved by (ε, ε²).
    turn = _turn(a, b, q) or a[1] - b[1] or b[0] - a[0]
    return (turn > 0) - (turn < 0)


def clip_rational(boundary: np.ndarray, near, start: Point, end: Point, side: int) -> list[tuple]:
    """The parameter intervals of the segment start-end that lie in the closed region.

    Parameters
    ----------
    boundary : (m, N, N) float array
        All of it, as for `locate_rational`.
    near : (k,) int array or slice
        The facets that can meet the segment.
    start, end : tuples of Fraction
    side : +1 or -1
        The closed region inside, or the closure of its complement.

    Returns
    -------
    list of (t0, t1)
        Increasing, 0 <= t0 < t1 <= 1; ``[(0, 1)]`` when all of it is contained. A segment without
        length gives ``[(0, 1)]`` or ``[]``. Isolated touching points are left out.

    Examples
    --------
    >>> triangle = np.array([[[0, 0], [3, 0]], [[3, 0], [0, 3]], [[0, 3], [0, 0]]], dtype=float)
    >>> clip_rational(triangle, slice(None), exact((-1, 1)), exact((5, 1)), side=1)
    [(Fraction(1, 6), Fraction(1, 2))]
    """
    way = minus(end, start)
    if not any(way):
        return [(Fraction(0), Fraction(1))] if side * locate_rational(boundary, start) >= 0 else []
    meetings = _segment_meetings if len(start) == 2 else _triangle_meetings
    cuts = {Fraction(0), Fraction(1)}
    for corners in boundary[near]:
        cuts.update(t for t in meetings(start, way, *(exact(p) for p in corners)) if 0 < t < 1)
    pieces: list[tuple] = []
    for t0, t1 in pairwise(sorted(cuts)):
        if side * locate_rational(boundary, between(start, end, (t0 + t1) / 2)) < 0:
            continue
        if pieces and pieces[-1][1] == t0:
            pieces[-1] = (pieces[-1][0], t1)
        else:
            pieces.append((t0, t1))
    return pieces


def _segment_meetings(start, way, a, b):
    """Parameters at which the line from `start` meets a segment, its ends if it lies on the line."""
    normal = normal_of(a, b)
    slope, height = dot(normal, way), dot(normal, minus(a, start))
    if slope:
        across = normal_of((0, 0), way)
        if 0 <= dot(across, minus(start, a)) / dot(across, minus(b, a)) <= 1:
            yield height / slope
    elif not height:
        yield from (dot(minus(x, start), way) / dot(way, way) for x in (a, b))


def _triangle_meetings(start, way, a, b, c):
    """The same for a triangle; where it lies in its plane, parameters on the lines of its sides."""
    normal = normal_of(a, b, c)
    slope, height = dot(normal, way), dot(normal, minus(a, start))
    if slope:
        t = height / slope
        if _in_triangle(a, b, c, tuple(x + t * v for x, v in zip(start, way, strict=True))):
            yield t
    elif not height:
        for x, y in ((a, b), (b, c), (c, a)):
            across = _cross(normal, minus(y, x))
            if slope := dot(across, way):
                yield dot(across, minus(x, start)) / slope
