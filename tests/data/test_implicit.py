"""Solids of functions: contained, uniform, of the right topology, and converging."""

import numpy as np
import pytest
from truth.solids import FIELDS, solid

import polyskel_lite as psl
from polyskel_lite import InputError, ShapeError, implicit


@pytest.mark.parametrize("name", FIELDS)
def test_implicit_solids_are_contained_uniform_and_of_the_right_topology(name):
    field, n, betti = FIELDS[name]
    shape = solid(name)
    assert 0.98 * n <= len(shape.points) <= n
    assert shape.betti() == betti
    assert len(psl.missing_facets(shape)) == 0
    sides = np.linalg.norm(shape.segments - np.roll(shape.segments, 1, axis=1), axis=2)
    assert sides.std() < 0.25 * sides.mean()
    assert np.abs(field(shape.points)).max() < 1e-3 * sides.mean()


def test_volume_converges():
    """A torus has the volume 2 pi^2 R r^2 and the surface 4 pi^2 R r."""
    errors = []
    for n in (300, 1200):
        shape = implicit.solid(implicit.torus(1.0, 0.4), n)
        errors.append(1 - shape.volume() / (2 * np.pi**2 * 0.16))
    assert 3 < errors[0] / errors[1] < 5
    assert shape.surface() == pytest.approx(4 * np.pi**2 * 0.4, rel=0.01)


def test_same_seed_same_mesh():
    one, two, three = (implicit.solid(implicit.tetrapod(), 150, seed=s) for s in (1, 1, 2))
    assert (one.points == two.points).all()
    assert one.points.shape != three.points.shape or (one.points != three.points).any()


def test_plain_function_needs_a_box():
    def value(x):
        return (x**4).sum(axis=1) - 1

    assert implicit.solid(value, 150, box=[(-1.2,) * 3, (1.2,) * 3]).betti() == (1, 0, 0)
    with pytest.raises(InputError, match="box is missing"):
        implicit.solid(value, 150)
    with pytest.raises(
        InputError, match=r"negative at \(-0.5, -0.5, -0.5\), on the box; make the box larger"
    ):
        implicit.solid(value, 150, box=[(-0.5,) * 3, (0.5,) * 3])
    with pytest.raises(InputError, match="negative nowhere"):
        implicit.solid(value, 150, box=[(3,) * 3, (4,) * 3])
    with pytest.raises(InputError, match="lowest and its highest"):
        implicit.solid(value, 150, box=[(3,) * 3, (2,) * 3])
    with pytest.raises(InputError, match="n is 4; pass a whole number of vertices, 20 to 50,000"):
        implicit.solid(value, 4, box=[(-2,) * 3, (2,) * 3])
    with pytest.raises(InputError, match="finite numbers"):
        implicit.solid(lambda x: np.full(len(x), np.nan), 150, box=[(-2,) * 3, (2,) * 3])


def test_too_few_samples_for_a_thin_part():
    with pytest.raises(ShapeError, match="60 samples make no mesh of this surface; ask for more"):
        implicit.solid(implicit.torus(1.0, 0.05), 60)
