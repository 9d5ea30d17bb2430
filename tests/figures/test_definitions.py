"""Figures 1 and 2 show what their captions say."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite.figures import definitions


def test_figure_1_shows_maximal_balls_and_one_inside_another():
    """Centres on the skeleton, contacts on the boundary; the other ball touches it inside the largest."""
    horse = psl.datasets.load("horse")
    skeleton = psl.sk0(horse.resample(400))
    chosen = definitions._disjoint(skeleton.vertices, skeleton.radii, 7)
    gap = horse.boundary_distance(skeleton.vertices[chosen]) - skeleton.radii[chosen]
    assert np.abs(gap).max() < 2e-3  # a line's width in the picture
    for i, j in itertools.combinations(chosen, 2):
        distance = np.linalg.norm(skeleton.vertices[i] - skeleton.vertices[j])
        assert distance > skeleton.radii[i] + skeleton.radii[j]
    center, radius, contact = definitions._smaller_ball(skeleton, chosen[0])
    largest = skeleton.vertices[chosen[0]], skeleton.radii[chosen[0]]
    assert np.linalg.norm(center - largest[0]) + radius == pytest.approx(largest[1])
    assert np.linalg.norm(center - contact) == pytest.approx(radius)
    assert horse.boundary_distance([contact])[0] < 2e-3


def test_figure_2_in_space_shows_the_cell_of_the_first_point():
    """The filled polygons close up: each edge of the cell belongs to two of them; no hull face is Gabriel."""
    tessellation = psl.delaunay(definitions.POINTS_3D)
    graph = psl.voronoi(tessellation)
    has_first = (tessellation.simplices[graph.simplices] == 0).any(axis=1)
    cell = [p.tolist() for p in graph.polygons if has_first[p].all()]
    sides = [tuple(sorted(pair)) for p in cell for pair in zip(p, [*p[1:], p[0]], strict=True)]
    assert len(cell) == 6
    assert all(sides.count(side) == 2 for side in sides)
    assert all(0 in facet for facet in psl.gabriel(tessellation).tolist())
