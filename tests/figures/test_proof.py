"""Figure 13 shows what its caption says."""

from __future__ import annotations

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import figures
from polyskel_lite.figures import proof


def test_figure_13_shows_a_boundary_edge_that_cannot_be_gabriel():
    tessellation = psl.delaunay(proof.POINTS_A)
    triangle = [set(s) == {0, 1, 2} for s in tessellation.simplices.tolist()].index(True)
    crossed = proof.crossed_edges(tessellation, triangle, 0)
    assert [crossing[:2] for crossing in crossed] == [(1, 2), (2, 3), (3, 4)]
    gabriel = {tuple(edge) for edge in psl.gabriel(tessellation).tolist()}
    delaunay = {tuple(edge) for edge in tessellation.edges().tolist()}
    a = tessellation.points[0]
    for e0, e1, m in crossed:
        p, q = tessellation.points[[e0, e1]]
        assert (e0, e1) in delaunay - gabriel
        assert np.linalg.norm((p + q) / 2 - a) < np.linalg.norm(p - q) / 2
        assert np.linalg.norm(m - a) < min(np.linalg.norm(m - p), np.linalg.norm(m - q))


def test_figure_13_refuses_points_that_do_not_show_it():
    with pytest.raises(psl.InputError, match="circumcentre"):
        figures.figure_13(points_a=[(0, 1), (-0.5, 0), (0.5, 0)])
    with pytest.raises(psl.InputError, match="convex polygon"):
        figures.figure_13(points_b=[(0, 0), (1, 0), (0, 1)])
