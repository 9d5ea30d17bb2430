"""Curves from samples alone."""

import numpy as np
import pytest

import polyskel_lite as psl


def stadium(n, length=3.0, r=1.0, shift=0.0):
    """Evenly spaced samples of a stadium: r-regular with this r."""
    total = 2 * length + 2 * np.pi * r
    s = (np.arange(n) + shift) * total / n % total
    x, y = np.empty(n), np.empty(n)
    for k, at in enumerate(s):
        if at < length:
            x[k], y[k] = at, -r
        elif at < length + np.pi * r:
            angle = (at - length) / r - np.pi / 2
            x[k], y[k] = length + r * np.cos(angle), r * np.sin(angle)
        elif at < 2 * length + np.pi * r:
            x[k], y[k] = length - (at - length - np.pi * r), r
        else:
            angle = (at - 2 * length - np.pi * r) / r + np.pi / 2
            x[k], y[k] = r * np.cos(angle), r * np.sin(angle)
    return np.column_stack([x, y])


@pytest.mark.parametrize("shift", [0.0, 0.25, 0.7])
@pytest.mark.parametrize("n", [7, 8, 12, 40, 300])
def test_stadium_with_gaps_below_r(n, shift):
    E = stadium(n, shift=shift)
    true = psl.Shape.from_rings([stadium(4000)])
    # The promise holds for w^-1 < r = 1, measured on a much finer polygon of the same curve.
    assert true.covering_radius(E) < 1
    found = psl.reconstruct_curve(np.random.default_rng(n).permutation(E))
    assert found.betti() == (1, 0)
    assert not len(psl.missing_facets(found, of="gabriel"))
    expected = {frozenset((tuple(E[k]), tuple(E[k - 1]))) for k in range(n)}
    assert {frozenset(map(tuple, ends)) for ends in found.segments.tolist()} == expected


def test_holes_and_components():
    circle = lambda n, r, x: np.column_stack(  # noqa: E731
        [x + r * np.cos(np.arange(n) * 2 * np.pi / n), r * np.sin(np.arange(n) * 2 * np.pi / n)]
    )
    E = np.concatenate([circle(40, 5, 0), circle(20, 2.5, 0), circle(20, 2, 12)])
    found = psl.reconstruct_curve(E)
    assert found.betti() == (2, 1)
    assert np.array_equal(found.points, E)


def test_vertices_keep_their_indices():
    E = np.random.default_rng(1).permutation(stadium(50))
    assert np.array_equal(psl.reconstruct_curve(E).points, E)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (
            [(0, 0), (4, 0), (4, 1), (0, 1), (2, 0.5)],
            "has .* Gabriel neighbours nearer|fewer than two|Delaunay disk",
        ),
        ([(0, 0), (4, 0), (2, 1)], "fewer than two"),
        (np.random.default_rng(0).random((100, 2)), "Gabriel neighbours|fewer than two"),
    ],
)
def test_refusals_name_a_sample(points, message):
    with pytest.raises(psl.ReconstructionError, match=message):
        psl.reconstruct_curve(points)


def test_thin_necks_are_refused():
    """The horse has legs and ears thinner than its gaps at n = 100."""
    with pytest.raises(psl.ReconstructionError, match="not samples of an r-regular shape"):
        psl.reconstruct_curve(psl.datasets.load("horse").sample(100))


def test_space_curves_are_refused():
    with pytest.raises(psl.InputError, match="in the plane only"):
        psl.reconstruct_curve(np.random.default_rng(0).random((9, 3)))
