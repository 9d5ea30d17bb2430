"""Rational points and segments against a triangle mesh: the last word where floats are in doubt."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np

Point = tuple[Fraction, Fraction, Fraction]
_PLANES = ((0, 1), (1, 2), (2, 0))


def exact(point) -> Point:
    """A float point as fractions.

    Examples
    --------
    >>> exact([0.5, 0, 3])[0]
    Fraction(1, 2)
    """
    return tuple(Fraction(x) for x in np.asarray(point, dtype=float).tolist())


def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def between(a, b, t):
    return tuple(x + t * (y - x) for x, y in zip(a, b, strict=True))


def rational_circumcenter(tetrahedron: np.ndarray) -> Point:
    """Circumcenter of a tetrahedron (4, 3).

    Examples
    --------
    >>> rational_circumcenter(np.array([(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 3)]))
    (Fraction(1, 1), Fraction(1, 1), Fraction(3, 2))
    """
    base, *others = (exact(p) for p in tetrahedron)
    a, b, c = (minus(p, base) for p in others)
    bc, ca, ab = cross(b, c), cross(c, a), cross(a, b)
    twice = 2 * dot(a, bc)
    aa, bb, cc = dot(a, a), dot(b, b), dot(c, c)
    return tuple(base[k] + (aa * bc[k] + bb * ca[k] + cc * ab[k]) / twice for k in range(3))


def locate_rational(triangles: np.ndarray, q: Point) -> int:
    """+1 if a rational point is inside a closed outward mesh (m, 3, 3), 0 on it, -1 outside.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    >>> tetrahedron = points[[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]]
    >>> [locate_rational(tetrahedron, (x, x, x)) for x in (Fraction(1, 4), Fraction(1, 3), Fraction(1, 2))]
    [1, 0, -1]
    """
    at = np.array([float(x) for x in q])
    slack = 1e-9 * (1 + np.abs(at).max())  # far more than the rounding of the query
    low, high = triangles.min(axis=1), triangles.max(axis=1)
    near = (low[:, :2] <= at[:2] + slack).all(axis=1) & (high >= at - (slack, slack, slack)).all(axis=1)
    winding = 0
    for a, b, c in ([exact(p) for p in t] for t in triangles[near]):
        side = dot(cross(minus(b, a), minus(c, a)), minus(q, a))
        if side == 0 and in_rational_triangle(a, b, c, q):
            return 0
        turns = {_shifted_turn(x, y, q) for x, y in ((a, b), (b, c), (c, a))}
        if len(turns) == 1 and (turn := turns.pop()) and (side > 0) - (side < 0) == -turn:
            winding += turn
    return 1 if winding else -1


def in_rational_triangle(a, b, c, q) -> bool:
    """Whether a point of the plane of a triangle is in the triangle."""
    for i, j in _PLANES:
        turns = [
            (y[i] - x[i]) * (q[j] - x[j]) - (y[j] - x[j]) * (q[i] - x[i]) for x, y in ((a, b), (b, c), (c, a))
        ]
        if min(turns) < 0 < max(turns):
            return False
    return True


def _shifted_turn(a, b, q) -> int:
    # As in `triangles.locate_in_mesh`: the query is moved by (ε, ε²).
    turn = (b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0])
    turn = turn or a[1] - b[1] or b[0] - a[0]
    return (turn > 0) - (turn < 0)


def clip_rational(
    triangles: np.ndarray, near: np.ndarray, start, end, side: int
) -> list[tuple[Fraction, Fraction]]:
    """The parameter intervals of a segment in the closed solid (or, side -1, in its closed complement).

    Parameters
    ----------
    triangles : (m, 3, 3) float array
        The whole mesh.
    near : (k,) int array
        Triangles that the segment can meet.
    start, end : triples of Fraction
    side : +1 or -1

    Returns
    -------
    list of (t0, t1)
        As `segments.clip_exactly`.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]], dtype=float)
    >>> tetrahedron = points[[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]]
    >>> ends = [(Fraction(x), Fraction(1, 2), Fraction(1, 2)) for x in (-2, 6)]
    >>> clip_rational(tetrahedron, np.arange(4), *ends, 1)
    [(Fraction(1, 4), Fraction(1, 2))]
    """
    way = minus(end, start)
    if way == (0, 0, 0):
        return [(Fraction(0), Fraction(1))] if side * locate_rational(triangles, start) >= 0 else []
    cuts = {Fraction(0), Fraction(1)}
    for a, b, c in ([exact(p) for p in t] for t in triangles[near]):
        normal = cross(minus(b, a), minus(c, a))
        slope, height = dot(normal, way), dot(normal, minus(a, start))
        if slope:
            t = height / slope
            if 0 < t < 1 and in_rational_triangle(a, b, c, between(start, end, t)):
                cuts.add(t)
        elif not height:  # in the plane: where the line meets the lines of the sides
            for x, y in ((a, b), (b, c), (c, a)):
                across = cross(normal, minus(y, x))
                if slope := dot(across, way):
                    t = dot(across, minus(x, start)) / slope
                    cuts |= {t} if 0 < t < 1 else set()
    pieces: list[tuple[Fraction, Fraction]] = []
    for t0, t1 in pairwise(sorted(cuts)):
        if side * locate_rational(triangles, between(start, end, (t0 + t1) / 2)) < 0:
            continue
        if pieces and pieces[-1][1] == t0:
            pieces[-1] = (pieces[-1][0], t1)
        else:
            pieces.append((t0, t1))
    return pieces


def exact_circumcenter(triangle: np.ndarray) -> tuple[Fraction, Fraction]:
    """Circumcenter of one triangle (3, 2) as rational numbers.

    Examples
    --------
    >>> exact_circumcenter(np.array([(0, 0), (1, 0), (0, 3)]))
    (Fraction(1, 2), Fraction(3, 2))
    """
    (ax, ay), (bx, by), (cx, cy) = [
        (Fraction(x), Fraction(y)) for x, y in np.asarray(triangle, dtype=float).tolist()
    ]
    bx, by, cx, cy = bx - ax, by - ay, cx - ax, cy - ay
    twice = 2 * (bx * cy - by * cx)
    lb, lc = bx * bx + by * by, cx * cx + cy * cy
    return ax + (cy * lb - by * lc) / twice, ay + (bx * lc - cx * lb) / twice


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
