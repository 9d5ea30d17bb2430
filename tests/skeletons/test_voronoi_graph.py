"""The Voronoi graph against its definition."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

import polyskel_lite as psl


@pytest.mark.parametrize("n", [2, 3])
def test_voronoi_elements_are_equidistant(n):
    points = np.random.default_rng(3).random((30, n))
    graph = psl.voronoi(points)
    d = np.sqrt(((graph.vertices[:, None] - points) ** 2).sum(axis=2))
    nearest = np.sort(d, axis=1)
    # Rounding of far circumcenters is relative to their distance.
    assert np.allclose(nearest[:, : n + 1], graph.radii[:, None], rtol=1e-9)
    for a, b in graph.edges:
        shared = np.intersect1d(
            graph.tessellation.simplices[graph.simplices[a]], graph.tessellation.simplices[graph.simplices[b]]
        )
        assert len(shared) == n
    for polygon in graph.polygons:
        simplices = graph.tessellation.simplices[graph.simplices[polygon]]
        assert len(set.intersection(*map(set, simplices.tolist()))) == 2
    hull = ConvexHull(points)
    assert len(graph.rays) == len(hull.simplices)
    assert np.allclose(np.linalg.norm(graph.rays, axis=1), 1)


def test_rays_point_away_from_the_points():
    points = np.random.default_rng(4).random((30, 2))
    graph = psl.voronoi(points)
    for start, ray in zip(graph.vertices[graph.ray_vertices], graph.rays, strict=True):
        # Far along a ray, the nearest samples are the two ends of its hull edge, at one distance.
        far = np.sort(np.sqrt(((start + 100 * ray - points) ** 2).sum(axis=1)))
        assert far[0] == pytest.approx(far[1], rel=1e-9)
