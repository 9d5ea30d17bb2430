"""The signs of the predicates against rational arithmetic done in another way."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from truth.rational import rational

from polyskel_lite.checks import as_points
from polyskel_lite.errors import InputError
from polyskel_lite.exact.predicates import as_integers, in_ball, in_gabriel_ball, orientation

# Small integers give many exact zeros, the factor puts them where floats cannot represent them exactly.
coordinate = st.integers(-3, 3)
factor = st.sampled_from([1.0, 0.1, 1 / 3, 1e-150, 1e100])


def sign(value):
    return (value > 0) - (value < 0)


def solve(rows, right):
    """Gauss elimination on rationals; None if singular."""
    rows = [[*row, r] for row, r in zip(rows, right, strict=True)]
    n = len(rows)
    for i in range(n):
        pivot = next((k for k in range(i, n) if rows[k][i]), None)
        if pivot is None:
            return None
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [x / rows[i][i] for x in rows[i]]
        for k in range(n):
            if k != i:
                rows[k] = [x - rows[k][i] * y for x, y in zip(rows[k], rows[i], strict=True)]
    return [row[-1] for row in rows]


def power(query, corner, center):
    """Positive if the query is nearer to the center than the corner is."""
    d = [sum((x - c) ** 2 for x, c in zip(p, center, strict=True)) for p in (query, corner)]
    return sign(d[1] - d[0])


def points_of(n, count):
    return st.lists(st.tuples(*[coordinate] * n), min_size=count, max_size=count)


@pytest.mark.parametrize("n", [2, 3])
@given(data=st.data(), scale=factor)
def test_in_ball_is_exact(n, data, scale):
    points = np.array(data.draw(points_of(n, n + 2)), dtype=float) * scale
    exact = rational(points)
    sides = [[2 * (x - y) for x, y in zip(p, exact[0], strict=True)] for p in exact[1:-1]]
    lift = [sum(x * x for x in p) - sum(x * x for x in exact[0]) for p in exact[1:-1]]
    center = solve(sides, lift)
    turned = orientation(points[None, :-1])[0]
    assert (turned == 0) == (center is None)
    if center is not None:
        assert in_ball(points[None, :-1], points[None, -1])[0] == power(exact[-1], exact[0], center)


@pytest.mark.parametrize("n", [2, 3])
@given(data=st.data(), scale=factor)
def test_in_gabriel_ball_is_exact(n, data, scale):
    points = np.array(data.draw(points_of(n, n + 1)), dtype=float) * scale
    exact = rational(points)
    a = exact[0]
    u = [[x - y for x, y in zip(p, a, strict=True)] for p in exact[1:-1]]
    gram = [[sum(x * y for x, y in zip(p, q, strict=True)) for q in u] for p in u]
    weights = solve(gram, [g[i] / 2 for i, g in enumerate(gram)])
    if weights is None:
        return
    center = [x + sum(w * p[k] for w, p in zip(weights, u, strict=True)) for k, x in enumerate(a)]
    assert in_gabriel_ball(points[None, :-1], points[None, -1])[0] == power(exact[-1], a, center)


def test_the_last_bit_counts():
    """A point one unit in the last place off a circle is off it."""
    corner = np.array([[[3.0, 4.0], [-5.0, 0.0], [4.0, -3.0]]])
    for x, expected in ((5.0, 0), (np.nextafter(5, 9), -1), (np.nextafter(5, 0), 1)):
        assert in_ball(corner, np.array([[x, 0.0]]))[0] == expected


def test_thousands_of_zeros_in_blocks():
    squares = (
        np.tile(np.array([[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]]), (10_000, 1, 1))
        + np.arange(10_000)[:, None, None] % 7
    )
    assert not in_ball(squares, squares[:, 0] + [0, 1]).any()


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=2, max_size=6))
def test_as_integers_keeps_ratios(values):
    (integers,) = as_integers(np.array(values))
    for x, i in zip(values, integers.tolist(), strict=True):
        for y, j in zip(values, integers.tolist(), strict=True):
            assert Fraction(x) * j == Fraction(y) * i


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([(0, 0), (1, np.nan)], r"points\[1, 1\] is nan"),
        ([(0, 0), (np.inf, 1)], r"points\[1, 0\] is inf"),
        ([0, 1, 2], r"shape \(3,\)"),
        ([(0, 0, 0, 0)], r"N = 2 or 3"),
        ([(0, 0), (1,)], "not an array of numbers"),
        ("abc", "not an array of numbers"),
    ],
)
def test_bad_points_are_named(points, message):
    with pytest.raises(InputError, match=message):
        as_points(points)


def test_coordinates_beyond_the_largest_float():
    with pytest.raises(InputError, match="largest float"):
        orientation(np.array([[[-1e308, 0], [1e308, 0], [0, 1.0]]]))
