"""Boxes, chains of edges, insets."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import polyskel_lite as psl
from polyskel_lite import drawing

POINTS = np.array([(0, 0), (4, 0), (5, 3), (2, 4), (-1, 2), (2, 1.5)], dtype=float)


coordinate = st.floats(-10, 10).map(lambda x: round(x, 3))
segment = st.tuples(*[st.tuples(coordinate, coordinate)] * 2).filter(lambda ends: ends[0] != ends[1])


@given(st.lists(segment, min_size=1, max_size=8))
def test_clipping_agrees_with_dense_points(segments):
    """A point of a segment is in the box exactly when it lies on what was kept of the segment."""
    box = np.array([(-3.0, -2.0), (4.0, 5.0)])
    for one in np.array(segments):
        kept = drawing.clip_segments([one], box)
        points = one[0] + np.linspace(0, 1, 101)[:, None] * (one[1] - one[0])
        inside = ((points > box[0] + 1e-9) & (points < box[1] - 1e-9)).all(axis=1)
        if len(kept) == 0:
            assert not inside.any()
            continue
        assert (kept >= box[0] - 1e-9).all()
        assert (kept <= box[1] + 1e-9).all()
        length = np.linalg.norm(one[1] - one[0])
        shares = np.linalg.norm(kept[0] - one[0], axis=1) / length
        between = (np.linspace(0, 1, 101) >= shares[0] - 1e-9) & (np.linspace(0, 1, 101) <= shares[1] + 1e-9)
        assert (between | ~inside).all()


def test_clipping_leaves_out_what_is_infinite():
    kept = drawing.clip_segments([[(0, 0), (np.inf, 0)], [(0, 0), (1, 0)]], [(-2, -2), (2, 2)])
    assert kept.tolist() == [[[0, 0], [1, 0]]]


@given(st.sets(st.tuples(st.integers(0, 9), st.integers(0, 9)).filter(lambda e: e[0] < e[1]), min_size=1))
def test_chains_hold_every_edge_once(edges):
    paths = drawing.chains(sorted(edges))
    found = [tuple(sorted(pair)) for path in paths for pair in itertools.pairwise(path.tolist())]
    assert sorted(found) == sorted(edges)


def test_a_cycle_is_one_chain():
    (path,) = drawing.chains([(0, 1), (1, 2), (2, 3), (3, 0)])
    assert path.tolist() == [0, 1, 2, 3, 0]


def test_box_needs_points():
    with pytest.raises(psl.InputError, match="at least one point"):
        drawing.box_of(np.empty((0, 2)))


def test_inset_shows_the_box(ax):
    drawing.draw_samples(ax, POINTS)
    glass = drawing.inset(ax, [(0, 0), (1, 1)])
    drawing.draw_samples(glass, POINTS)
    assert glass.get_xlim() == (0, 1)
    assert glass.get_ylim() == (0, 1)
