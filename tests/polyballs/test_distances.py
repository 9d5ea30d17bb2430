"""Distances to the boundary of polyballs in space, and the caps that other balls take off a sphere."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree
from truth.cases import family_member, of_all_families
from truth.medial import Union


@pytest.mark.parametrize("number", of_all_families(3))
def test_points_of_a_sphere_in_no_cap_are_on_the_boundary(number):
    Y = family_member(number)
    covered = Y.union.caps
    u = np.random.default_rng(number).standard_normal((500, 3))
    u /= np.linalg.norm(u, axis=1)[:, None]
    for ball in np.flatnonzero(Y.union.exposed):
        rows = slice(covered.first[ball], covered.first[ball + 1])
        free = (u @ covered.axes[rows].T <= covered.heights[rows]).all(axis=1)
        points = Y.centers[ball] + Y.radii[ball] * u
        assert not Y.inside(points[free], 1e-9).any()
        assert Y.inside(points[~free], -1e-9).all()


def queries_for(Y, rng, count=200):
    """Anywhere, and where it is hard: centres, axes of circles, singular points, arcs, next to these."""
    low, high = Y.box()
    origin, (circles, arcs, corners) = Y.union.origin, Y.union.boundary[1:4]
    row, start, end = arcs
    hard = [
        Y.centers - origin,
        circles.centers,
        circles.centers + circles.frames[:, 2] * rng.uniform(-1, 1, (len(circles.pairs), 1)),
        corners,
        circles.points(row, (start + end) / 2),
        Y.centers.mean(axis=0)[None] - origin,
    ]
    hard = np.concatenate(hard) + origin
    near = hard + 1e-4 * Y.size * rng.standard_normal(hard.shape)
    return np.concatenate(
        [
            rng.uniform(2 * low - high, 2 * high - low, (count, 3)),
            rng.uniform(low, high, (count, 3)),
            hard,
            near,
        ]
    )


@pytest.mark.parametrize("number", of_all_families(10))
def test_distance_against_all_candidates(number):
    """`truth.medial.Union` looks at every circle and crossing of three spheres, and at no power diagram."""
    Y = family_member(number)
    rng = np.random.default_rng(number)
    queries = queries_for(Y, rng)
    truth = Union(Y.centers, Y.radii, seed=number).boundary_distance(queries)
    rounding = 1e-13 * Y.size + 1e-14 * np.abs(Y.centers).max()
    # Singular points are believed to 1e-12 of the radius over the sine of the angle of their circles.
    assert np.abs(Y.distance(queries) - truth).max() < rounding + 1e-11 * Y.size


def test_distance_between_bounds_from_samples():
    """Samples of the boundary are no nearer than the boundary, and hardly farther if they are dense."""
    for number in of_all_families(1):
        Y = family_member(number)
        vertices, triangles, _ = Y.mesh(0.02)
        queries = np.random.default_rng(number).uniform(*Y.box(), (2_000, 3))
        found, upper = Y.distance(queries), cKDTree(vertices).query(queries)[0]
        edges = vertices[triangles] - vertices[np.roll(triangles, 1, axis=1)]
        longest = np.linalg.norm(edges, axis=2).max()
        assert (found <= upper + 1e-12 * np.abs(Y.centers).max()).all()
        assert (upper <= found + longest).all()
        # Lipschitz: the distance changes by no more than the way between two queries.
        assert (np.abs(np.diff(found)) <= np.linalg.norm(np.diff(queries, axis=0), axis=1) + 1e-12).all()


def test_distance_does_not_depend_on_the_company():
    Y = family_member(3)
    queries = np.random.default_rng(0).uniform(*Y.box(), (300, 3))
    together = Y.distance(queries)
    assert together.tolist() == [Y.distance(q[None])[0] for q in queries]
    assert Y.distance(np.zeros((0, 3))).shape == (0,)
