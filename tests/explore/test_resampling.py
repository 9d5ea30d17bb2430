"""The explorer of samplings shows what the public functions return."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import explore

HORSE = psl.datasets.load("horse")


@pytest.mark.parametrize(("n", "start"), [(50, 0.0), (120, 0.35), (400, 0.95)])
def test_sampling_shows_what_the_functions_return(n, start):
    explorer = explore.sampling(HORSE)
    with explorer.together():
        explorer.controls["n"].value = n
        explorer.controls["start"].value = start
        explorer.controls["polyball"].value = True
    E = HORSE.sample(n, start)
    skeleton, layers = psl.sk2(HORSE, E), explorer.board.layers
    assert np.array_equal(layers["samples"].points, E)
    assert np.array_equal(layers["skeleton"].lines, skeleton.segments())
    assert np.array_equal(layers["polyball"].circles[0], skeleton.balls().centers)
    assert explorer.numbers["covering_radius"] == HORSE.covering_radius(E)
    assert explorer.numbers["density_w"] == HORSE.sampling_density(E)
    assert explorer.numbers["Betti_numbers_of_Sk2"] == skeleton.betti()
    assert explorer.numbers["those_of_the_shape"] == (1, 0)
    assert (explorer.numbers["vertices"], explorer.numbers["edges"]) == (
        len(skeleton.vertices),
        len(skeleton.edges),
    )


def test_noise_is_seeded():
    noisy = [explore.sampling(HORSE, seed=seed) for seed in (0, 0, 1)]
    for explorer in noisy:
        explorer.controls["noise"].value = 0.5
    one, same, other = (explorer.samples() for explorer in noisy)
    assert np.array_equal(one, same)
    assert not np.array_equal(one, other)
    step = one - HORSE.sample(100)
    size = np.hypot(*np.ptp(HORSE.points, axis=0))
    assert step.std() == pytest.approx(0.005 * size, rel=0.2)
    noisy[0].controls["noise"].value = 0
    assert np.array_equal(noisy[0].samples(), HORSE.sample(100))


@pytest.mark.parametrize("n", [2, 401])
def test_sampling_refuses_what_is_not_on_the_slider(n):
    with pytest.raises(psl.InputError, match="from 3 to 400"):
        explore.sampling(HORSE, n=n)
