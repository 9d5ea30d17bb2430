"""Section 4 on random solids with handles, cavities and several components: nothing but the shape changes."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import implicit

SOLIDS, BATCHES = 54, 6
THRESHOLDS = {
    "surface": [-np.inf, 0, *np.linspace(0.2, np.pi, 9), np.inf],
    "wireframe": [-np.inf, 0, *np.geomspace(0.5, 60, 9), np.inf],
}
# What each family is made of; sizes and places are drawn.
FAMILIES = ["ball", "torus", "two tori", "hollow", "hollow torus", "apart"]


def random_solid(seed: int) -> psl.Shape:
    rng = np.random.default_rng(seed)
    family = FAMILIES[seed % len(FAMILIES)]
    major, minor = rng.uniform(0.9, 1.1), rng.uniform(0.3, 0.4)
    ring = implicit.torus(major, minor)
    field = {
        "ball": lambda: implicit.union(implicit.ball(), implicit.ball((0.9, 0.2, 0), rng.uniform(0.5, 0.8))),
        "torus": lambda: ring,
        "two tori": lambda: implicit.double_torus(major, minor),
        "hollow": lambda: implicit.hollow_ball(1.0, rng.uniform(0.4, 0.6)),
        "hollow torus": lambda: implicit.difference(
            implicit.torus(major, 0.45), implicit.ball((major, 0, 0), rng.uniform(0.18, 0.25))
        ),
        "apart": lambda: implicit.union(ring, implicit.ball((0, 0, 2.0), rng.uniform(0.4, 0.6))),
    }[family]()
    return implicit.solid(field, n=int(rng.integers(350, 600)), seed=seed)


@pytest.mark.parametrize("batch", range(BATCHES))
def test_betti_numbers_stay_at_every_threshold(batch):
    seen = set()
    for seed in range(batch, SOLIDS, BATCHES):
        # Batches mix families: a step of BATCHES alone would meet one of them only.
        shape = random_solid(seed + seed // BATCHES)
        expected = shape.betti()
        seen.add(expected)
        P = psl.delaunay_shape(shape)
        for strategy, thresholds in THRESHOLDS.items():
            h = psl.hierarchy(P, strategy)
            for threshold in thresholds:
                assert h.shape(threshold).betti() == h.skeleton(threshold).betti() == expected
    assert len(seen) >= 3


@pytest.mark.parametrize("strategy", ["surface", "wireframe"])
@pytest.mark.parametrize("name", ["fourbranch", "vertebra"])
def test_turning_and_moving_change_next_to_nothing(name, strategy):
    """Angles and areas are rounded, and near ties may change places: almost all levels agree."""
    P = psl.delaunay_shape(psl.datasets.load(name))
    turn, _ = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    t = psl.delaunay(P.tessellation.points @ turn.T * 3 + [5, -4, 9])
    assert t.simplices.tolist() == P.tessellation.simplices.tolist()
    a = psl.hierarchy(P, strategy).level
    b = psl.hierarchy(psl.DelaunayShape(t, P.inner), strategy).level
    both = np.isfinite(a) & np.isfinite(b)
    same = a == b
    same[both] |= np.isclose(a[both], b[both], rtol=1e-6)
    assert same.mean() > 0.99


def test_branches_of_the_two_made_shapes():
    """Four each, as the paper finds on its own two shapes."""
    for name in ("fourbranch", "chromosome"):
        h = psl.hierarchy(psl.datasets.load(name), "wireframe")
        assert h.branches(2 * np.pi).graph["branches"] == 4


def test_size_as_printed_and_corrected():
    """p/r² finds four ends at any size; p/r, as printed, another number at each."""
    shape = psl.datasets.load("fourbranch")
    ends = {criterion: [] for criterion in ("corrected", "transcript")}
    for scale in (0.01, 1, 100, 1000):
        P = psl.delaunay_shape(psl.Shape(shape.points * scale, shape.facets))
        for criterion, found in ends.items():
            h = psl.hierarchy(P, "wireframe", criterion=criterion)
            found.append(h.branches(2 * np.pi).graph["branches"])
    assert ends["corrected"] == [4] * 4
    assert ends["transcript"] == sorted(ends["transcript"])
    assert ends["transcript"][0] < 4 < ends["transcript"][-1]
