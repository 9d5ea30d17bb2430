"""The Gabriel graph against its definition."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from truth.points import distinct

import polyskel_lite as psl
from polyskel_lite.exact.predicates import in_gabriel_ball


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("n", [2, 3])
@given(data=st.data())
def test_gabriel_by_definition(n, closed, data):
    """All Delaunay facets, by looking at every other sample; the library looks at two."""
    points = data.draw(distinct(n, n + 2, 11))
    try:
        t = psl.delaunay(points)
    except psl.TessellationError:
        return
    limit = 0 if closed else 1
    expected = set()
    for facet in t.facets().tolist():
        others = np.delete(points, facet, axis=0)
        corners = np.broadcast_to(points[facet], (len(others), n, n))
        if (in_gabriel_ball(corners, others) < limit).all():
            expected.add(tuple(facet))
    assert set(map(tuple, psl.gabriel(t, closed).tolist())) == expected


@given(distinct(2, 4, 11))
def test_strict_gabriel_edges_are_always_delaunay(points):
    """Nothing is missed by looking at Delaunay facets only."""
    try:
        t = psl.delaunay(points)
    except psl.TessellationError:
        return
    found = set(map(tuple, psl.gabriel(t).tolist()))
    for p, q in combinations(range(len(points)), 2):
        others = np.delete(points, [p, q], axis=0)
        empty = (in_gabriel_ball(np.broadcast_to(points[[p, q]], (len(others), 2, 2)), others) < 0).all()
        assert empty == ((p, q) in found)
