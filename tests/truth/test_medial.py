"""The truth itself: unions of balls that can be worked out on paper."""

from __future__ import annotations

import numpy as np
import pytest

from truth.complexes import distance_to_complex, lengths
from truth.medial import Union
from truth.nerves import components
from truth.polyballs import random_polyball


def test_oracle_by_hand():
    """Distances and maximal balls that can be worked out on paper."""
    one = Union([(3.0, 4.0)], [2.0])
    assert one.boundary_distance([(3, 4), (3, 5), (3, 9)]) == pytest.approx([2, 1, 3])
    m, t, _ = one.medial_points(np.random.default_rng(0))
    assert lengths(m - (3, 4)).max() < 1e-9
    assert t == pytest.approx(np.full(len(t), 2.0))
    two = Union([(0, 0), (1, 0)], [1, 1])
    assert two.boundary_distance([(0.5, 0), (0, 0), (0.5, 0.5)]) == pytest.approx(
        [np.sqrt(0.75), 1, np.sqrt(0.75) - 0.5]
    )
    m, _, error = two.medial_points(np.random.default_rng(0))
    assert (distance_to_complex(m, [(0, 0), (1, 0)], [(0, 1)]) < 1e-12 + error).all()
    assert np.median(error) < 1e-9
    growth, _ = two.growth([(0.5, 0), (0, 0), (0.3, 0), (-0.1, 0), (0.5, 0.1), (5, 0)])
    assert growth[:3].max() < 1e-9
    assert growth[3] == pytest.approx(0.1)
    assert growth[4] > 0.05
    assert growth[5] == np.inf
    line = Union([(0, 0, 0), (0.5, 0, 0), (1, 0, 0)], [1, 1, 1])
    assert line.boundary_distance([(0.25, 0, 0), (0.5, 0, 0)]) == pytest.approx([np.sqrt(15 / 16), 1])
    assert line.growth([(0.25, 0, 0), (0.9, 0, 0), (1, 0, 0)])[0].max() < 1e-9
    assert line.growth([(1.1, 0, 0), (0.5, 0.01, 0)])[0].min() > 1e-3
    assert line.betti() == (1, 0, 0)


def test_oracle_distance_against_dense_points():
    rng = np.random.default_rng(5)
    for number in range(40):
        _, c, r = random_polyball(number, 2)
        truth = Union(c, r)
        angle = np.linspace(0, 2 * np.pi, 2000)
        points = (c[:, None] + r[:, None, None] * np.column_stack([np.cos(angle), np.sin(angle)])).reshape(
            -1, 2
        )
        inside = (lengths(points[:, None] - c) - r < -1e-9).any(axis=1)
        queries = rng.uniform((c - r[:, None]).min(axis=0), (c + r[:, None]).max(axis=0), (30, 2))
        dense = lengths(queries[:, None] - points[~inside]).min(axis=1)
        distance = truth.boundary_distance(queries)
        assert (distance < dense + 1e-6 * truth.size).all()
        assert (distance > dense - 4e-3 * r.max()).all()


def test_oracle_point_to_complex():
    square = np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (1, 0.5, 0), (0, 2, 0)], dtype=float)  # not convex
    polygon = [np.arange(5)]
    points = [(1, 0.2, 1), (1, 1.5, 0), (3, 0, 0), (0.2, 0.5, -2)]
    expected = [1, distance_to_complex([(1, 1.5, 0)], square, [(2, 3), (3, 4)])[0], 1, 2]
    assert distance_to_complex(points, square, (), polygon) == pytest.approx(expected)
    assert expected[1] > 0.3


def test_oracle_betti():
    angle = np.arange(6) * np.pi / 3
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    assert Union(ring, np.full(6, 0.6)).betti() == (1, 1)
    assert Union(ring, np.full(6, 0.4)).betti() == (6, 0)
    assert Union(ring, np.full(6, 1.01)).betti() == (1, 0)
    assert components(3, np.array([[0, 1]])) == 2
