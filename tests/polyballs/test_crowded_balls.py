"""Balls that nearly coincide: the skeleton has the topology of the union, or is refused with a reason.

What the topology is, nobody computes here: unions of Delaunay balls of stadiums, capsules and rings have
that of the shape, also with radii larger by up to a tenth; copies of balls that differ by next to nothing
change nothing (`truth.nerves` counts the holes of the first ones).
"""

import numpy as np
import pytest
from truth.nerves import nerve_betti
from truth.polyballs import FAMILIES, random_polyball

import polyskel_lite as psl
from polyskel_lite.polyballs.power import homotopy
from polyskel_lite.polyballs.union import BallUnion

GROWTH = [1.0, 1.01, 1.02, 1.05, 1.1]
NOISE = [0, 1e-15, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6]
each_noise = pytest.mark.parametrize("noise", NOISE)


def arc(start, end, n):
    angle = np.linspace(start, end, n)
    return np.column_stack([np.cos(angle), np.sin(angle)])


def stadium(n):
    cap, x = arc(-np.pi / 2, np.pi / 2, n // 4 + 1), np.linspace(2, -2, n // 4)[1:-1, None]
    half = np.concatenate([cap + np.array([2, 0]), x * (1, 0) + np.array([0, 1])])
    return [np.concatenate([half, -half])]


def rounded(n):
    """A rectangle with round corners."""
    places = [(2, 1), (-2, 1), (-2, -1), (2, -1)]
    return [
        np.concatenate(
            [c + arc(q * np.pi / 2, (q + 1) * np.pi / 2, n // 8) / 2 for q, c in enumerate(places)]
        )
    ]


def annulus(n):
    return [2 * arc(0, 2 * np.pi, n + 1)[1:], arc(2 * np.pi, 0, n + 1)[1:]]


def verdict(centers, radii, betti):
    """1 if the skeleton is right, 0 if it is refused; a wrong one fails."""
    try:
        assert psl.Polyball(centers, radii).skeleton().betti() == betti
    except psl.TessellationError as error:
        assert "leave out balls that are almost equal" in str(error)  # noqa: PT017
        return 0
    return 1


@each_noise
@pytest.mark.parametrize(("kind", "betti"), [(stadium, (1, 0)), (rounded, (1, 0)), (annulus, (1, 1))])
def test_round_caps_in_the_plane(kind, betti, noise):
    right = []
    for n in (24, 64, 160):
        for seed in range(2):
            rng = np.random.default_rng([n, seed])
            turn = np.linalg.qr(rng.standard_normal((2, 2)))[0]
            turn[:, 0] *= np.sign(np.linalg.det(turn))
            rings = [ring @ turn.T for ring in kind(n)]
            rings = [ring + noise * rng.standard_normal(ring.shape) for ring in rings]
            Y = psl.delaunay_balls(psl.Shape.from_rings(rings))
            right += [verdict(Y.centers, Y.radii * growth, betti) for growth in GROWTH]
    assert np.mean(right) > 0.9


@pytest.mark.parametrize("N", [2, 3])
@pytest.mark.parametrize("twin", [1e-14, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7])
def test_copies_of_balls_that_differ_by_next_to_nothing(N, twin):
    right = []
    for number in range(4 * len(FAMILIES)):
        _, c, r = random_polyball(number, N)
        if len(r) > 12 or nerve_betti(c, r * (1 - 1e-5)) != nerve_betti(c, r * (1 + 1e-5)):
            continue  # holes that open or close with the copies
        rng = np.random.default_rng([number, N])
        copies = rng.integers(1, 4)
        centers = [c + twin * r[:, None] * rng.standard_normal(c.shape) for _ in range(copies)]
        radii = [r * (1 + twin * rng.standard_normal(len(r))) for _ in range(copies)]
        right.append(verdict(np.concatenate([c, *centers]), np.concatenate([r, *radii]), nerve_betti(c, r)))
    assert len(right) > 20
    assert np.mean(right) > 0.9


@pytest.mark.parametrize(
    ("solid", "betti"),
    [("capsule", (1, 0, 0)), ("tetrapod", (1, 0, 0)), ("torus", (1, 1, 0))],
)
def test_delaunay_balls_of_round_solids(solid, betti):
    """Never wrong; the dual shape that decides is right nearly always."""
    clear = []
    for n in (200,) if solid == "capsule" else (100, 300):
        Y = psl.delaunay_balls(psl.implicit.solid(getattr(psl.implicit, solid)(), n=n))
        for growth in GROWTH:
            verdict(Y.centers, Y.radii * growth, betti)
            union = BallUnion(Y.centers, Y.radii * growth)
            clear.append(any(union.alike(share).homotopy()[1] == betti for share in (1e-6, 1e-5)))
    assert np.mean(clear) >= 0.6


@pytest.mark.parametrize("N", [2, 3])
def test_the_dual_shape_is_the_nerve(N):
    for number in range(6 * len(FAMILIES)):
        _, c, r = random_polyball(number, N)
        if len(r) < 15:
            found = BallUnion(c, r)
            low, high = homotopy(found.power, found.radii)
            assert high == nerve_betti(c, r * (1 + 1e-9)), number
            assert low == nerve_betti(c, r * (1 - 1e-9)), number


def test_one_ball_for_all_that_are_alike_holds_them():
    rng = np.random.default_rng(0)
    c = np.repeat(rng.random((5, 3)) * 10, 20, axis=0)
    c, r = c + 1e-7 * rng.standard_normal(c.shape), 1 + 1e-7 * rng.standard_normal(100)
    like = BallUnion(c, r).alike(1e-5)
    assert len(like.radii) == 5
    places = c - like.origin
    inside = np.linalg.norm(places[:, None] - like.centers, axis=2) + r[:, None] <= like.radii * (1 + 1e-15)
    assert inside.any(axis=1).all()
    assert like.radii.max() < 1 + 2e-6


def test_a_wrong_skeleton_is_not_handed_out(monkeypatch):
    """If what comes out has other Betti numbers than the dual shape, the most alike balls are named."""
    Y = psl.Polyball([(0, 0), (1, 0), (2.5, 0)], [1, 1, 1])
    wrong = psl.Polyball([(0, 0), (5, 0)], [1, 1]).skeleton()
    monkeypatch.setattr("polyskel_lite.polyballs.skeleton.ball_skeleton", lambda *_: wrong)
    with pytest.raises(
        psl.TessellationError, match=r"most alike are balls 0 and 1, .* 1\.0e\+00 of a radius"
    ):
        Y.skeleton()
