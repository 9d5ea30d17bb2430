"""Polyballs at every scale: powers of two change no digit, other factors the last digits only."""

import numpy as np
import pytest
from truth.polyballs import random_polyball

import polyskel_lite as psl

TWOS = [-1000, -700, -540, -300, -1, 1, 100, 520, 900, 1000]
TENS = [-290, -200, -165, -160, -80, -3, 5, 77, 155, 200, 290]
each_dimension = pytest.mark.parametrize("N", [2, 3])


def balls(number, N):
    """Random balls, rounded so that no coordinate is much smaller than the whole."""
    _, centers, radii = random_polyball(number, N)
    return np.round(centers * 2**20) / 2**20, np.round(radii * 2**20) / 2**20


def answers(Y, queries):
    """What a polyball says, with the power of the unit of length by which each of it grows."""
    skeleton, N = Y.skeleton(), Y.dimension
    printed = Y.skeleton(statement="transcript")
    lengths = {
        "vertices": skeleton.vertices,
        "sizes": skeleton.radii,
        "printed": printed.vertices,
        "singular": Y.singular_points(),
        "distance": Y.boundary_distance(queries),
    }
    numbers = {
        "edges": skeleton.edges,
        "inside": Y.contains(queries),
        "generating": Y.generating(),
        "alone": Y.disconnected(),
        "pairs": Y.quasi_disconnected(),
        "exposed": Y.exposed_pairs(),
    }
    if N == 2:
        numbers |= dict(zip(("ball", "start", "end"), Y.arcs(), strict=True))
    else:
        numbers["corners"], numbers["sides"] = skeleton.polygons.corners, skeleton.polygons.sizes
        lengths["patches"], numbers["triangles"], numbers["sphere"] = Y.patches(0.3)
    return lengths, numbers


def questions(centers, radii):
    low, high = (centers - radii[:, None]).min(axis=0), (centers + radii[:, None]).max(axis=0)
    q = np.random.default_rng(0).uniform(low, high, (30, centers.shape[1]))
    return np.concatenate([np.round(q * 2**20) / 2**20, centers])


@each_dimension
@pytest.mark.parametrize("number", range(6))
def test_powers_of_two_change_no_digit(number, N):
    centers, radii = balls(number, N)
    queries = questions(centers, radii)
    lengths, numbers = answers(psl.Polyball(centers, radii), queries)
    for k in TWOS:
        scaled, same = answers(psl.Polyball(np.ldexp(centers, k), np.ldexp(radii, k)), np.ldexp(queries, k))
        for name, value in numbers.items():
            assert np.array_equal(same[name], value), (k, name)
        for name, value in lengths.items():
            normal = np.abs(np.ldexp(value, k)) >= np.finfo(float).tiny
            assert np.array_equal(scaled[name][normal], np.ldexp(value, k)[normal]), (k, name)


@each_dimension
@pytest.mark.parametrize("number", range(6))
def test_powers_of_ten_change_the_last_digits_only(number, N):
    centers, radii = balls(number, N)
    queries = questions(centers, radii)
    Y = psl.Polyball(centers, radii)
    size = np.ptp(queries, axis=0).max() + np.abs(centers).max()
    skeleton, distance = Y.skeleton(), Y.boundary_distance(queries)
    for k in TENS:
        factor = float(f"1e{k}")
        Z = psl.Polyball(centers * factor, radii * factor)
        assert Z.skeleton().betti() == skeleton.betti(), k
        assert len(Z.singular_points()) == len(Y.singular_points()), k
        assert Z.boundary_distance(queries * factor) / factor == pytest.approx(distance, abs=1e-7 * size), k
        assert Z.generating().tolist() == Y.generating().tolist(), k


@each_dimension
def test_area_and_volume_are_scaled_or_refused(N):
    centers, radii = balls(N, N)
    Y = psl.Polyball(centers, radii)
    measures = {"area": 2} if N == 2 else {"area": 2, "volume": 3}
    for name, power in measures.items():
        value = getattr(Y, name)()
        for k in TWOS:
            Z = psl.Polyball(np.ldexp(centers, k), np.ldexp(radii, k))
            if -1000 < power * k < 1000:
                assert getattr(Z, name)() == np.ldexp(value, power * k)
            else:
                with pytest.raises(
                    psl.InputError, match=rf"the {name} of these balls, .* scale them by 2.0\*\*"
                ):
                    getattr(Z, name)()


def test_two_discs_whose_squares_are_no_numbers():
    """At 1e-165 the square of a coordinate is 0 and the discs were one."""
    for k in (-300, -165, -160, 0, 160, 300):
        scale = float(f"1e{k}")
        skeleton = psl.Polyball([(0, 0), (scale, 0)], [scale, scale]).skeleton()
        assert skeleton.vertices / scale == pytest.approx(np.array([(0, 0), (1, 0)]))
        assert skeleton.edges.tolist() == [[0, 1]]


def test_queries_far_away_are_far_away():
    Y = psl.Polyball([(0, 0)], [1e-200])
    assert Y.contains([(1e200, 0), (0, 0)]).tolist() == [False, True]
    for x in (1e-90, 1e100, 1e200):
        for balls in (Y, psl.Polyball([(0, 0, 0)], [1e-200])):
            far = balls.boundary_distance([np.eye(balls.dimension)[0] * x])
            assert far[0] == pytest.approx(x)
