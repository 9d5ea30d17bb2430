"""Skeletons of many balls against their dual shape: both have the homotopy type of the union.

The brute-force truth of `truth.medial` knows some twenty balls. The dual shape (Edelsbrunner 1995) knows a
thousand: the simplices of the power triangulation whose balls have a common point, found from the definition.
"""

from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial import ConvexHull

import polyskel_lite as psl
from polyskel_lite.exact.topology import components
from polyskel_lite.polyballs.power import power_triangulation


def orthoballs(points, weights, simplices):
    """Centres and powers of the smallest balls orthogonal to the corners of simplices."""
    a, legs = points[simplices[:, 0]], points[simplices[:, 1:]] - points[simplices[:, :1]]
    right = ((legs**2).sum(axis=2) - weights[simplices[:, 1:]] + weights[simplices[:, :1]]) / 2
    share = np.linalg.solve(np.einsum("mij,mkj->mik", legs, legs), right[..., None])[..., 0]
    z = a + np.einsum("mi,mij->mj", share, legs)
    return z, ((z - a) ** 2).sum(axis=1) - weights[simplices[:, 0]]


def dual_shape(centers, radii):
    """Simplices of the dual shape as sorted tuples, and the triangulation."""
    t = power_triangulation(centers, radii)
    weights = np.append(radii**2, np.zeros(len(t.points) - len(radii)))
    top = np.sort(t.simplices, axis=1)
    value = dict(zip(map(tuple, top.tolist()), orthoballs(t.points, weights, top)[1], strict=True))
    for size in range(top.shape[1] - 1, 0, -1):
        above = {}
        for simplex in [s for s in value if len(s) == size + 1]:
            for k in range(size + 1):
                above.setdefault(simplex[:k] + simplex[k + 1 :], []).append((simplex, simplex[k]))
        z, power = orthoballs(t.points, weights, np.array(list(above)))
        for (face, around), middle, own in zip(above.items(), z, power, strict=True):
            hit = any(((t.points[k] - middle) ** 2).sum() - weights[k] < own - 1e-13 for _, k in around)
            value[face] = min(value[s] for s, _ in around) if hit else own
    return {s for s, power in value.items() if power < 0 and s[-1] < t.count}, t


def betti(centers, radii):
    """Betti numbers of the union, from its dual shape and the gaps in it."""
    shape, t = dual_shape(centers, radii)
    edges = [s for s in shape if len(s) == 2]
    used, ends = np.unique(np.array(edges).reshape(-1, 2), return_inverse=True)
    b0 = components(len(used), ends.reshape(-1, 2))[0] + sum(len(s) == 1 for s in shape) - len(used)
    gaps = [tuple(sorted(s)) not in shape for s in t.simplices.tolist()] + [True]
    open_facets = [
        (k, t.neighbors[k, c] if t.neighbors[k, c] >= 0 else len(t.simplices))
        for k, s in enumerate(t.simplices.tolist())
        for c in range(len(s))
        if tuple(sorted(s[:c] + s[c + 1 :])) not in shape
    ]
    _, label = components(len(gaps), np.array(open_facets))
    cavities = len(np.unique(label[gaps])) - 1
    characteristic = sum((-1) ** (len(s) - 1) for s in shape)
    return (b0, cavities) if centers.shape[1] == 2 else (b0, b0 + cavities - characteristic, cavities)


@pytest.mark.parametrize("N", [2, 3])
@pytest.mark.parametrize(("count", "spread"), [(300, 1.0), (300, 1.6), (1000, 1.3)])
def test_random_balls(N, count, spread):
    rng = np.random.default_rng([N, count])
    centers = rng.random((count, N)) * spread * (count / 4) ** (1 / N)
    radii = rng.random(count) * 0.4 + 0.3
    assert psl.Polyball(centers, radii).skeleton().betti() == betti(centers, radii)


@pytest.mark.parametrize("growth", [0.05, 0.01, 0.001])
@pytest.mark.parametrize("n", [20, 50, 80])
def test_delaunay_balls_a_little_too_large(n, growth):
    """Around each sample a dozen spheres cross that all went through it: small, almost degenerate."""
    points = np.random.default_rng(n).normal(size=(n, 3))
    points *= (2, 1, 0.7) / np.sqrt((points**2).sum(axis=1, keepdims=True))
    t = psl.delaunay(points)
    small = t.circumradii < 2.5
    centers, radii = t.circumcenters[small], t.circumradii[small] * (1 + growth)
    assert psl.Polyball(centers, radii).skeleton().betti() == betti(centers, radii)


def test_thousands_of_delaunay_balls():
    """Of these 5,454 balls Qhull loses some on some machines; what comes out is the same on all."""
    Y = psl.delaunay_balls(psl.implicit.solid(psl.implicit.torus(), n=1000))
    assert Y.skeleton().betti() == (1, 1, 0)


@pytest.mark.parametrize(("n", "count"), [(100, 1), (100, 20), (300, 4)])
def test_balls_that_qhull_loses_are_looked_for_and_found(monkeypatch, n, count):
    """Whether Qhull loses any by itself depends on the machine, so here some that show are kept from it."""
    Y = psl.delaunay_balls(psl.implicit.solid(psl.implicit.torus(), n=n))
    lost = np.sort(np.random.default_rng(n).choice(np.flatnonzero(Y.exposed()), count, replace=False))
    Z = psl.Polyball(Y.centers, Y.radii)
    with monkeypatch.context() as patch:
        patch.setattr("polyskel_lite.polyballs.power.ConvexHull", partial(hull_without, lost))
        found = Z.union.power
    assert not np.isin(lost, found.simplices).any()  # lost indeed
    assert np.isin(lost, found.found[0]).all()
    assert (Z.exposed() == Y.exposed()).all()
    assert (Z.area(), Z.volume()) == pytest.approx((Y.area(), Y.volume()), rel=1e-12)
    assert Z.skeleton().betti() == Y.skeleton().betti() == (1, 1, 0)


def hull_without(rows, points, **options):
    """What Qhull returns if it loses some of the points."""
    kept = np.delete(np.arange(len(points)), rows)
    hull = ConvexHull(points[kept], **options)
    return SimpleNamespace(
        equations=hull.equations,
        simplices=kept[hull.simplices],
        neighbors=hull.neighbors,
        vertices=kept[hull.vertices],
    )


def test_too_many_nearly_equal_balls_are_refused():
    """Samples on one sphere: the balls around them differ by rounding only."""
    Y = psl.delaunay_balls(psl.implicit.solid(psl.implicit.capsule(), n=300))
    with pytest.raises(psl.TessellationError, match="too many of these balls nearly coincide"):
        Y.skeleton()
