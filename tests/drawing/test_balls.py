"""Balls in the plane: a union without seams, outlines, centre and contacts."""

from __future__ import annotations

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import drawing


def test_union_of_balls_has_no_seam(ax):
    """Rendered: all pixels of a union of overlapping disks, also translucent, have one colour."""
    drawing.draw_balls(ax, [(0, 0), (1, 0), (0.5, 0.8)], [1, 1, 1], alpha=0.5)
    drawing.focus(ax, [(-0.1, -0.1), (1.1, 0.8)], margin=0)
    ax.figure.canvas.draw()
    pixels = np.asarray(ax.figure.canvas.buffer_rgba())
    low, high = ax.get_window_extent().extents.reshape(2, 2).round().astype(int)
    inside = pixels[-high[1] + 2 : -low[1] - 2, low[0] + 2 : high[0] - 2, :3].reshape(-1, 3)
    assert len(np.unique(inside, axis=0)) == 1


def test_balls_from_a_polyball_with_outlines(ax, frame):
    balls = psl.sk2(frame).balls()
    assert drawing.draw_balls(ax, balls, outlines=True) is ax
    (circles,) = ax.collections
    assert len(circles.get_paths()) == len(balls.radii)
    assert len(ax.patches) == 2


def test_balls_need_one_radius_each(ax):
    with pytest.raises(psl.InputError, match=r"radii \(k,\)"):
        drawing.draw_balls(ax, [(0, 0), (1, 0)], [1])


def test_ball_with_centre_and_contacts(ax):
    assert drawing.draw_ball(ax, (0, 0), 2, contacts=[(2, 0), (0, 2), (-2, 0)]) is ax
    assert len(ax.patches) == 1
    assert len(ax.collections[0].get_segments()) == 3
    assert sum(len(line.get_xdata()) for line in ax.lines) == 1 + 3
