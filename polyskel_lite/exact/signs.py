"""One sign at a time, exact, for loops that decide millions: where a point is from a plane or a ball.

Floats with an error bound decide nearly everything, whole numbers the rest. `loops` holds the functions, to
be compiled or not. In all of them ``P`` has coordinate k of point v at P[n v + k], scaled by a power of two
to below one, and ``W`` is what `whole_numbers` makes of the same points.

The bounds. With u = 2**-53 every operation errs by a factor of at most 1 + u. A term that went through k of
them errs by k u of itself, so the sum of the terms' sizes times their largest k, times u, bounds the error:
k counts the differences, products and sums on the way of a term. ``_TINY`` covers what underflows.

References
----------
Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates, 1997.
"""

from __future__ import annotations

import math

import numpy as np

from ..compiling import Loops
from .predicates import as_integers

loops = Loops()
_POINTS, _WHOLE = "float64[::1]", "int64[:,::1]"
_TINY = 1e-280


def whole_numbers(points: np.ndarray, compiled: bool):
    """The points (n, N) as whole numbers, or what it takes to read them so.

    Returns
    -------
    list of int, or (18, k) int64 array
        Plain: the coordinates in a common unit. Compiled: registers for sums and products; the last row has
        the number of digits in base 2**26, and the exponent of the unit.

    Examples
    --------
    >>> whole_numbers(np.array([[0.5, 3.0]]), compiled=False)
    [1, 6]
    """
    if not compiled:
        return as_integers(points)[0].ravel().tolist()
    mantissa, exponent = np.frexp(points[points != 0])
    whole = np.ldexp(mantissa, 53).astype(np.int64)
    last = np.frexp((whole & -whole).astype(float))[1] - 1  # the place of the last binary digit
    unit = int((exponent - 53 + last).min(initial=0))
    k = (int(exponent.max(initial=0)) - unit + 25) // 26 + 1
    registers = np.zeros((18, max(5 * k + 4, 8)), np.int64)
    registers[17, :2] = k, unit
    return registers


def _determinant(rows):
    if len(rows) == 2:
        return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]
    a, b, c = rows
    value = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
    return value + a[2] * (b[0] * c[1] - b[1] * c[0])


def whole_turn(P, W, n, a, b, c, d):
    """The sign of the determinant of points seen from the last one (c in the plane, d in space)."""
    vertices = (a, b, c, d)
    base = vertices[n]
    value = _determinant([[W[n * i + k] - W[n * base + k] for k in range(n)] for i in vertices[:n]])
    return (value > 0) - (value < 0)


def whole_ball(P, W, n, a, b, c, d, e):
    """The sign of the lifted determinant; d counts in space only."""
    rows = [[W[n * i + k] - W[n * e + k] for k in range(n)] for i in (a, b, c, d)[: n + 1]]
    value = 0
    for i in range(n + 1):
        term = _determinant(rows[:i] + rows[i + 1 :]) * sum(x * x for x in rows[i])
        value += term if (i % 2 == 0) == (n == 2) else -term
    return (value > 0) - (value < 0)


def flat_turn(P, W, i, a, b, c):
    """The sense of three points in space, seen along an axis: coordinates i and i + 1."""
    j = (i + 1) % 3
    left = (W[3 * a + i] - W[3 * c + i]) * (W[3 * b + j] - W[3 * c + j])
    right = (W[3 * a + j] - W[3 * c + j]) * (W[3 * b + i] - W[3 * c + i])
    return (left > right) - (left < right)


# Compiled only: whole numbers in base 2**26, the last digit first. Differences are not carried, so a digit is
# below 2**27 in size; a product sums at most 2 * 81 products of digits, and 64 bits are enough.


@loops(f"void({_WHOLE}, float64, int64, int64, int64)")
def _digits(R, x, sign, unit, out):
    """R[out] += sign * x / 2**unit."""
    mantissa, e = math.frexp(x)
    whole = int(mantissa * 9007199254740992.0)
    if whole < 0:
        whole = -whole
        sign = -sign
    shift = e - 53 - unit
    if shift < 0:
        whole >>= -shift
        shift = 0
    q = shift // 26
    r = shift - 26 * q
    while whole:
        piece = (whole & 67108863) << r
        R[out, q] += sign * (piece & 67108863)
        piece >>= 26
        if piece:
            R[out, q + 1] += sign * piece
        whole >>= 26
        q += 1


@loops(f"void({_WHOLE}, int64, int64, int64, int64, int64, int64)")
def _add_product(R, a, na, b, nb, sign, out):
    for i in range(na):
        x = sign * R[a, i]
        if x:
            for j in range(nb):
                R[out, i + j] += x * R[b, j]


@loops(f"void({_WHOLE}, int64, int64)")
def _carry(R, out, n):
    """All digits from 0 to 2**26 - 1 but for the first one, which has the sign."""
    for i in range(n - 1):
        c = R[out, i] >> 26
        R[out, i] -= c << 26
        R[out, i + 1] += c


@loops(f"int64({_WHOLE}, int64, int64)")
def _sign_of(R, out, n):
    for i in range(n - 1, -1, -1):
        if R[out, i]:
            return 1 if R[out, i] > 0 else -1
    return 0


@loops(f"void({_POINTS}, {_WHOLE}, int64, int64)")
def _rows(P, R, n, last):
    """Registers n i + j: coordinate j of vertex i seen from the last one; the vertices are in R[17, 2:]."""
    for i in range(last):
        for j in range(n):
            R[n * i + j, : R[17, 0] + 1] = 0
            _digits(R, P[n * R[17, 2 + i] + j], 1, R[17, 1], n * i + j)
            _digits(R, P[n * R[17, 2 + last] + j], -1, R[17, 1], n * i + j)


@loops(f"void({_WHOLE}, int64, int64, int64, int64)")
def _product_of_rows(R, n, p, q, r):
    """R[14], of n k + 2 digits: the determinant of n rows of n registers each, from p, q and r on."""
    k = R[17, 0]
    R[14, : n * k + 3] = 0
    out = 14 if n == 2 else 13
    for _ in range(1 if n == 2 else 3):
        R[out, : 2 * k + 2] = 0
        _add_product(R, p, k, q + 1, k, 1, out)
        _add_product(R, p + 1, k, q, k, -1, out)
        _carry(R, out, 2 * k + 1)
        if n == 3:
            _add_product(R, r + 2, k, 13, 2 * k + 1, 1, 14)
            p, q, r = q, r, p
    _carry(R, 14, n * k + 2)


@loops(f"int64({_POINTS}, {_WHOLE}, int64, int64, int64, int64, int64)", stands_for="whole_turn")
def _digits_turn(P, R, n, a, b, c, d):
    R[17, 2] = a
    R[17, 3] = b
    R[17, 4] = c
    R[17, 5] = d
    _rows(P, R, n, n)
    _product_of_rows(R, n, 0, n, 2 * n)
    return _sign_of(R, 14, n * R[17, 0] + 2)


@loops(f"int64({_POINTS}, {_WHOLE}, int64, int64, int64, int64, int64, int64)", stands_for="whole_ball")
def _digits_ball(P, R, n, a, b, c, d, e):
    R[17, 2] = a
    R[17, 3] = b
    R[17, 4] = c
    R[17, 5] = d if n == 3 else e
    R[17, 6] = e
    k = R[17, 0]
    _rows(P, R, n, n + 1)
    R[16, :] = 0
    sign = -1 if n == 3 else 1
    for i in range(n + 1):
        R[15, :] = 0
        for j in range(n):
            _add_product(R, n * i + j, k, n * i + j, k, 1, 15)
        _carry(R, 15, 2 * k + 1)
        _product_of_rows(R, n, n * (1 if i == 0 else 0), n * (1 if i > 1 else 2), n * (2 if i == 3 else 3))
        _add_product(R, 15, 2 * k + 1, 14, n * k + 2, sign, 16)
        sign = -sign
    _carry(R, 16, 5 * k + 4)
    return _sign_of(R, 16, 5 * k + 4)


@loops(f"int64({_POINTS}, {_WHOLE}, int64, int64, int64, int64)", stands_for="flat_turn")
def _digits_flat_turn(P, W, i, a, b, c):
    shadow = np.empty(6)
    for m in range(2):
        k = (i + m) % 3
        shadow[m] = P[3 * a + k]
        shadow[2 + m] = P[3 * b + k]
        shadow[4 + m] = P[3 * c + k]
    return whole_turn(shadow, W, 2, 0, 1, 2, 2)


@loops(f"int64({_POINTS}, {_WHOLE}, int64, int64, int64)")
def turn_2d(P, W, a, b, c):
    """+1 where c is on the left of the line from a to b, 0 on it."""
    left = (P[2 * a] - P[2 * c]) * (P[2 * b + 1] - P[2 * c + 1])
    right = (P[2 * a + 1] - P[2 * c + 1]) * (P[2 * b] - P[2 * c])
    value = left - right
    bound = 3.4e-16 * (abs(left) + abs(right)) + _TINY  # 3 u: Shewchuk's bound A
    if abs(value) > bound:
        return 1 if value > 0 else -1
    return whole_turn(P, W, 2, a, b, c, c)


@loops(f"int64({_POINTS}, {_WHOLE}, int64, int64, int64, int64)")
def turn_3d(P, W, a, b, c, d):
    """+1 where a, b, c are counter-clockwise seen from d, 0 if the four are in a plane."""
    ax = P[3 * a] - P[3 * d]
    ay = P[3 * a + 1] - P[3 * d + 1]
    az = P[3 * a + 2] - P[3 * d + 2]
    bx = P[3 * b] - P[3 * d]
    by = P[3 * b + 1] - P[3 * d + 1]
    bz = P[3 * b + 2] - P[3 * d + 2]
    cx = P[3 * c] - P[3 * d]
    cy = P[3 * c + 1] - P[3 * d + 1]
    cz = P[3 * c + 2] - P[3 * d + 2]
    value = ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)
    mx = max(abs(ax), abs(bx), abs(cx))
    my = max(abs(ay), abs(by), abs(cy))
    mz = max(abs(az), abs(bz), abs(cz))
    # Six terms of mx my mz: k is 8 for four of them, 7 for the two last ones; 46 u, and second order.
    bound = 5.2e-15 * (mx * my * mz) + _TINY
    if abs(value) > bound:
        return 1 if value > 0 else -1
    return whole_turn(P, W, 3, a, b, c, d)


@loops(f"int64({_POINTS}, {_WHOLE}, int64, int64, int64, int64)")
def in_circle(P, W, a, b, c, e):
    """+1 where e is inside the circle of the positive triangle a b c, 0 on it."""
    ax = P[2 * a] - P[2 * e]
    ay = P[2 * a + 1] - P[2 * e + 1]
    bx = P[2 * b] - P[2 * e]
    by = P[2 * b + 1] - P[2 * e + 1]
    cx = P[2 * c] - P[2 * e]
    cy = P[2 * c + 1] - P[2 * e + 1]
    al = ax * ax + ay * ay
    bl = bx * bx + by * by
    cl = cx * cx + cy * cy
    p1 = bx * cy
    q1 = cx * by
    p2 = cx * ay
    q2 = ax * cy
    p3 = ax * by
    q3 = bx * ay
    value = al * (p1 - q1) + bl * (p2 - q2) + cl * (p3 - q3)
    size = al * (abs(p1) + abs(q1)) + bl * (abs(p2) + abs(q2)) + cl * (abs(p3) + abs(q3))
    bound = 1.2e-15 * size + _TINY  # 10 u: Shewchuk's bound A
    if abs(value) > bound:
        return 1 if value > 0 else -1
    return whole_ball(P, W, 2, a, b, c, e, e)


@loops(f"int64({_POINTS}, {_WHOLE}, int64, int64, int64, int64, int64)")
def in_sphere(P, W, a, b, c, d, e):
    """+1 where e is inside the sphere of a b c d, which `turn_3d` calls positive, 0 on it."""
    ex = P[3 * e]
    ey = P[3 * e + 1]
    ez = P[3 * e + 2]
    ax = P[3 * a] - ex
    ay = P[3 * a + 1] - ey
    az = P[3 * a + 2] - ez
    bx = P[3 * b] - ex
    by = P[3 * b + 1] - ey
    bz = P[3 * b + 2] - ez
    cx = P[3 * c] - ex
    cy = P[3 * c + 1] - ey
    cz = P[3 * c + 2] - ez
    dx = P[3 * d] - ex
    dy = P[3 * d + 1] - ey
    dz = P[3 * d + 2] - ez
    ab = ax * by - bx * ay
    bc = bx * cy - cx * by
    cd = cx * dy - dx * cy
    da = dx * ay - ax * dy
    ac = ax * cy - cx * ay
    bd = bx * dy - dx * by
    abc = az * bc - bz * ac + cz * ab
    bcd = bz * cd - cz * bd + dz * bc
    cda = cz * da + dz * ac + az * cd
    dab = dz * ab + az * bd + bz * da
    al = ax * ax + ay * ay + az * az
    bl = bx * bx + by * by + bz * bz
    cl = cx * cx + cy * cy + cz * cz
    dl = dx * dx + dy * dy + dz * dz
    value = (dl * abc - cl * dab) + (bl * cda - al * bcd)
    mx = max(abs(ax), abs(bx), abs(cx), abs(dx))
    my = max(abs(ay), abs(by), abs(cy), abs(dy))
    mz = max(abs(az), abs(bz), abs(cz), abs(dz))
    # 24 terms of mx my mz times the largest lift: k is 8 for a minor, 5 for a lift, 3 more: 384 u = 4.3e-14.
    bound = 4.5e-14 * (mx * my * mz * max(al, bl, cl, dl)) + _TINY
    if abs(value) > bound:
        return 1 if value > 0 else -1
    return whole_ball(P, W, 3, a, b, c, d, e)
