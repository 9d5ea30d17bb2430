"""Exact signs: orientation, in-ball and Gabriel tests.

Every test evaluates one polynomial of coordinate differences twice in floats: once as it stands
and once with all terms made positive. The second value times a small constant bounds the rounding
error of the first (Shewchuk 1997). Where the first value is inside its bound, the same polynomial
is evaluated again on integers, which Python computes without rounding. So every sign is right.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from ..errors import InputError

# Unit roundoff of float64 and a floor for products that underflow (inputs are scaled to size one).
_UNIT = 2.0**-53
_FLOOR = 1e-280


def as_integers(*arrays: np.ndarray) -> list[np.ndarray]:
    """Return the float arrays times one common power of two, as exact Python integers.

    A float is an integer times a power of two, so one factor makes all of them integers. Signs of
    homogeneous polynomials do not change. Arrays of ``object`` dtype are computed by NumPy with
    Python's unbounded integers.

    Examples
    --------
    >>> as_integers(np.array([0.5, 3.0]))[0].tolist()
    [1, 6]
    """
    mantissa, exponent = np.frexp(np.concatenate([array.ravel() for array in arrays]))
    whole = np.ldexp(mantissa, 53).astype(np.int64)
    # The exponent of the last binary digit; zero has none.
    last = exponent - 54 + np.frexp((whole & -whole).astype(float))[1]
    shift = np.where(whole == 0, 0, last - last[whole != 0].min(initial=0))
    whole >>= np.where(whole == 0, 0, last - exponent + 53)
    flat = whole.astype(object) << shift.astype(object)
    return [
        part.reshape(array.shape)
        for part, array in zip(np.split(flat, np.cumsum([a.size for a in arrays])[:-1]), arrays, strict=True)
    ]


def fractions(array) -> np.ndarray:
    """The same floats as fractions: an array of ``object`` dtype, with which NumPy computes without rounding.

    Examples
    --------
    >>> fractions([0.5, 3]).tolist()
    [Fraction(1, 2), Fraction(3, 1)]
    """
    return np.frompyfunc(Fraction, 1, 1)(np.asarray(array, dtype=object))


def _dot(u, v):
    return (u * v).sum(axis=-1)


def _minor(a, b, minus):
    """Determinant (``minus=-1``) or permanent (``minus=+1``) of the first two coordinates of two rows."""
    return a[:, 0] * b[:, 1] + minus * a[:, 1] * b[:, 0]


def _signs(differences: np.ndarray, polynomial, degree: int, terms: int, exact_rows) -> np.ndarray:
    """Sign of ``polynomial(differences, -1)`` with exact arithmetic where the float sign is in doubt.

    Each of the ``terms`` products of ``degree`` differences is rounded fewer than 8 degree times, sums
    included, so that many units of the sum of their absolute values bound the error with room to spare.
    """
    bound = 8 * degree * _UNIT
    with np.errstate(under="ignore"):
        value = polynomial(differences, -1)
        # A quick bound first: every factor is at most the largest difference of its row.
        largest = np.maximum(differences.max(axis=(1, 2)), -differences.min(axis=(1, 2)))
        rows = np.flatnonzero(np.abs(value) <= bound * terms * largest**degree + _FLOOR)
        some = np.abs(differences[rows])
        rows = rows[np.abs(value[rows]) <= bound * polynomial(some, 1) + _FLOOR]
    sign = np.sign(value).astype(np.int8)
    # In blocks, because one common denominator for a whole block keeps NumPy in charge of the loop.
    for block in np.array_split(rows, max(1, len(rows) // 4096)) if len(rows) else ():
        numbers = exact_rows(block)
        if int(np.abs(numbers).max()) ** degree * terms < 2**63:  # as on grids: NumPy's own integers hold all
            numbers = numbers.astype(np.int64)
        exact = polynomial(numbers, -1)
        sign[block] = [(v > 0) - (v < 0) for v in exact.tolist()]
    return sign


def _differences(base: np.ndarray, others: np.ndarray):
    """Differences scaled to size one (by a power of two, exactly) and the same as exact integers."""
    base, others = _by_coordinate(base), _by_coordinate(others)
    with np.errstate(over="ignore"):
        differences = others - base[:, None, :]
    largest = max(differences.max(initial=0.0), -differences.min(initial=0.0))
    if not np.isfinite(largest):
        raise InputError("coordinates differ by more than the largest float; divide all of them by 2**60.")
    if largest:
        exponent = -int(np.frexp(largest)[1])
        if exponent < 1000:
            differences *= np.ldexp(1.0, exponent)
        else:  # the power itself would overflow
            differences = np.ldexp(differences, exponent)

    def exact_rows(rows):
        b, o = as_integers(base[rows], others[rows])
        return o - b[:, None, :]

    return differences, exact_rows


def _by_coordinate(array: np.ndarray) -> np.ndarray:
    """The same array, laid out so that each coordinate of all rows is contiguous: long loops for NumPy."""
    return np.moveaxis(np.ascontiguousarray(np.moveaxis(array, 0, -1)), -1, 0)


def _orientation(d, minus):
    if d.shape[2] == 2:
        return d[:, 0, 0] * d[:, 1, 1] + minus * d[:, 0, 1] * d[:, 1, 0]
    a, b, c = d[:, 0], d[:, 1], d[:, 2]
    return (
        a[:, 2] * _minor(b, c, minus) + minus * b[:, 2] * _minor(a, c, minus) + c[:, 2] * _minor(a, b, minus)
    )


def orientation(simplices: np.ndarray) -> np.ndarray:
    """Sign of the signed volume of each simplex: +1 positive, -1 negative, 0 flat.

    Parameters
    ----------
    simplices : (k, N+1, N) float array, or one of fractions (dtype object)
        In 2D +1 means counter-clockwise.

    Returns
    -------
    (k,) int8 array
        Exact signs.

    References
    ----------
    Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates, 1997.

    Examples
    --------
    >>> orientation(np.array([[[0, 0], [1, 0], [0, 1]], [[0, 0], [0.1, 0.1], [0.3, 0.3]]]))
    array([1, 0], dtype=int8)

    Three tenths times one third is not one tenth in floats, so this triangle has an area (of 1e-17):

    >>> orientation(np.array([[[0, 0], [0.1, 0.3], [1 / 3, 1.0]]]))
    array([1], dtype=int8)
    """
    simplices = np.asarray(simplices)
    if simplices.dtype == object:
        return np.sign(_orientation(simplices[:, 1:] - simplices[:, :1], -1)).astype(np.int8)
    simplices = simplices.astype(np.float64, copy=False)
    scaled, exact = _differences(simplices[:, 0], simplices[:, 1:])
    n = simplices.shape[2]
    return _signs(scaled, _orientation, n, 2 if n == 2 else 6, exact)


def _in_ball(d, minus):
    # d: simplex corners seen from the query point; the lifted determinant, Guibas and Stolfi 1985.
    lift = _dot(d, d)
    if d.shape[2] == 2:
        a, b, c = d[:, 0], d[:, 1], d[:, 2]
        value = lift[:, 0] * _minor(b, c, minus) + minus * lift[:, 1] * _minor(a, c, minus)
        return value + lift[:, 2] * _minor(a, b, minus)
    a, b, c, e = (d[:, i] for i in range(4))
    ab, bc, ce = _minor(a, b, minus), _minor(b, c, minus), _minor(c, e, minus)
    ac, be, ae = _minor(a, c, minus), _minor(b, e, minus), _minor(a, e, minus)
    abc = a[:, 2] * bc + minus * b[:, 2] * ac + c[:, 2] * ab
    bce = b[:, 2] * ce + minus * c[:, 2] * be + e[:, 2] * bc
    ace = a[:, 2] * ce + minus * c[:, 2] * ae + e[:, 2] * ac
    abe = a[:, 2] * be + minus * b[:, 2] * ae + e[:, 2] * ab
    return (lift[:, 0] * bce + minus * lift[:, 1] * ace) + (lift[:, 2] * abe + minus * lift[:, 3] * abc)


def in_ball(simplices: np.ndarray, queries: np.ndarray, positive: bool = False) -> np.ndarray:
    """Where each query is from the ball circumscribed to its simplex: +1 inside, 0 on the sphere, -1 outside.

    Parameters
    ----------
    simplices : (k, N+1, N) float array
        Not flat; either orientation.
    queries : (k, N) float array
    positive : bool
        Say that all simplices are positively oriented, which saves looking.

    Returns
    -------
    (k,) int8 array
        Exact signs (the empty-ball test of the paper's section 2.2).

    References
    ----------
    Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates, 1997.

    Examples
    --------
    >>> square = np.array([[[0, 0], [1, 0], [0, 1]]] * 3)
    >>> in_ball(square, np.array([[0.5, 0.5], [1, 1], [2, 2]]))
    array([ 1,  0, -1], dtype=int8)
    """
    simplices = np.asarray(simplices, dtype=np.float64)
    scaled, exact = _differences(np.asarray(queries, dtype=np.float64), simplices)
    n = simplices.shape[2]
    sign = _signs(scaled, _in_ball, n + 2, 12 if n == 2 else 72, exact)
    return sign if positive else sign * orientation(simplices)


def _outside_gabriel(d, minus):
    # d: facet corners 2..N and the query, all seen from the first corner. Power of the query with
    # respect to the smallest ball through the facet, times the (positive) Gram determinant.
    w = d[:, -1]
    if d.shape[1] == 2:
        return _dot(w, w) + minus * _dot(w, d[:, 0])
    u, v = d[:, 0], d[:, 1]
    uu, vv, uv, wu, wv = _dot(u, u), _dot(v, v), _dot(u, v), _dot(w, u), _dot(w, v)
    gram = uu * vv + minus * uv * uv
    return gram * _dot(w, w) + minus * (wu * vv * (uu + minus * uv)) + minus * (wv * uu * (vv + minus * uv))


def in_gabriel_ball(facets: np.ndarray, queries: np.ndarray) -> np.ndarray:
    """Where each query is from the smallest ball through its facet: +1 inside, 0 on the sphere, -1 outside.

    Parameters
    ----------
    facets : (k, N, N) float array
        Segments in 2D, triangles (not flat) in 3D. In 2D the ball has the segment as diameter; in
        3D its centre is the circumcenter of the triangle.
    queries : (k, N) float array

    Returns
    -------
    (k,) int8 array
        Exact signs (the paper's section 2.2, Gabriel graph).

    Examples
    --------
    >>> segment = np.array([[[0, 0], [2, 0]]] * 3)
    >>> in_gabriel_ball(segment, np.array([[1, 0.5], [1, 1], [1, 1.5]]))
    array([ 1,  0, -1], dtype=int8)
    """
    facets = np.asarray(facets, dtype=np.float64)
    others = np.concatenate([facets[:, 1:], np.asarray(queries, dtype=np.float64)[:, None]], axis=1)
    scaled, exact = _differences(facets[:, 0], others)
    n = facets.shape[2]
    return -_signs(scaled, _outside_gabriel, 2 if n == 2 else 6, 4 if n == 2 else 162, exact)
