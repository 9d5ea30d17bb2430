"""Labels of Delaunay shapes: inside and outside, cavities, refusals."""

import numpy as np
import pytest
from truth.rational import grid_region

import polyskel_lite as psl


@pytest.mark.parametrize("seed", range(10))
def test_labels_agree_with_an_inside_test(seed):
    shape = psl.conform(psl.Shape.from_rings(grid_region(np.random.default_rng(seed), size=4)), to="delaunay")
    P = psl.delaunay_shape(shape)
    centroids = P.tessellation.points[P.tessellation.simplices].mean(axis=1)
    assert (P.inner == (shape.locate(centroids) > 0)).all()
    assert P.betti() == shape.betti()
    assert P.to_shape().area() == pytest.approx(shape.area())
    edges = {tuple(edge) for edge in shape.facets.tolist()}
    assert edges == {tuple(edge) for edge in P.boundary().tolist()}


def test_solid_of_tetrahedra():
    """A shell of tetrahedra around an empty one has a cavity; Sk0 does too."""
    corner = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)], dtype=float)
    t = psl.delaunay(np.concatenate([corner, -6 * corner]))
    inner = np.array([set(s) != {0, 1, 2, 3} for s in t.simplices.tolist()])
    assert (~inner).sum() == 1
    P = psl.DelaunayShape(t, inner)
    assert P.betti() == (1, 0, 1)
    assert psl.sk0(P).betti() == (1, 0, 1)
    # Filled, the four samples are inside the region: Sk0, a surface, closes around each of them.
    assert psl.sk0(psl.DelaunayShape(t, np.ones_like(inner))).betti() == (1, 0, 4)


def test_wrong_labels():
    t = psl.delaunay([(0, 0), (1, 0), (0, 1)])
    with pytest.raises(psl.InputError, match="one bool for each of the 1 simplices"):
        psl.DelaunayShape(t, np.array([1, 0]))
