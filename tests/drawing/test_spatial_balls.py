"""Polyballs in space: circles where balls meet, layers before and behind the skeleton."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import drawing
from polyskel_lite.drawing.spatial_balls import _edges_by_side


def test_circles_are_drawn_where_two_balls_meet():
    Y = psl.Polyball([(0, 0, 0), (1.2, 0, 0), (0.6, 1, 0)], [1, 1, 1])
    vertices, triangles, ball = Y.patches()
    edges, owner = _edges_by_side(triangles)
    assert 2 * len(edges) == 3 * len(triangles)
    assert ((ball[owner[0]] != ball[owner[1]]).sum()) > 30
    rim = edges[ball[owner[0]] != ball[owner[1]]]
    two = np.abs(np.linalg.norm(vertices[rim][:, :, None] - Y.centers, axis=3) - 1) < 1e-9
    assert (two.sum(axis=2) >= 2).all()


def test_polyball_in_space_is_drawn_in_layers():
    Y = psl.Polyball([(0, 0, 0), (1.2, 0, 0), (0.6, 1, 0)], [1, 1, 1])
    _, ax = drawing.axes_3d()
    drawing.draw_polyball_3d(ax, Y)
    back, front = ax.collections[0], ax.collections[1]
    assert back.get_zorder() < drawing.KINDS["sk0"].zorder < front.get_zorder()
    dots = [len(line.get_data_3d()[0]) for line in ax.lines]
    assert sum(dots) == len(Y.singular_points()) == 2
    with pytest.raises(psl.InputError, match="draw_balls"):
        drawing.draw_polyball_3d(ax, psl.Polyball([(0, 0)], [1]))
