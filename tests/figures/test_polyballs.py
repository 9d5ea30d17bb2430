"""Figures 11 and 12 (appendix A) show what their captions say."""

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import figures
from polyskel_lite.figures import polyballs


def test_figure_11_has_the_four_cases_of_the_proof():
    """Maximal: in Y, and stopped by two corners, by three, by corners and an arc, by a whole circle."""
    Y = psl.Polyball(polyballs.CENTERS_11, polyballs.RADII_11)
    seen = []
    for center, radius in polyballs.kinds_of_balls(Y):
        assert Y.boundary_distance([center])[0] == pytest.approx(radius, rel=1e-12)
        points, arcs = polyballs.contacts(Y, center, radius)
        seen.append((len(points), len(arcs), float((arcs[:, 1] - arcs[:, 0]).sum())))
    assert [case[:2] for case in seen] == [(2, 0), (3, 0), (2, 1), (0, 1)]
    assert 0 < seen[2][2] < 2 * np.pi == seen[3][2]


def test_figure_11_shows_a_polyball_without_some_cases():
    figure = figures.figure_11(psl.Polyball([(0, 0)], [1]))
    assert len(figure.axes) == 4


def test_figure_11_refuses_what_it_cannot_show():
    with pytest.raises(psl.InputError, match="in the plane"):
        figures.figure_11(psl.Polyball([(0, 0, 0)], [1]))
    with pytest.raises(psl.TangentBallsError):
        figures.figure_11(psl.Polyball([(0, 0), (2, 0)], [1, 1]))


def test_figure_12_shows_points_segments_and_polygons():
    """A segment, a triangle, a chain that the printed theorem misses, a loop, sheets, a surface."""
    skeletons = [Y.skeleton() for Y in polyballs.examples_12()]
    assert [len(s.polygons) for s in skeletons] == [0, 1, 0, 0, 2, 20]
    assert [len(s.edges) for s in skeletons[:4]] == [1, 3, 3, 8]
    row = polyballs.examples_12()[2]
    assert not len(row.quasi_disconnected())
    ring = skeletons[3]
    assert len(np.setdiff1d(np.arange(len(ring.vertices)), ring.edges)) == 1
    assert skeletons[5].betti() == (1, 0, 1)


def test_what_the_cage_encloses_is_its_hollow():
    cage, row = polyballs.examples_12()[5], polyballs.examples_12()[2]
    vertices, triangles = polyballs._enclosed(cage)
    hollow = np.linalg.norm(vertices[triangles], axis=2)
    assert 0 < hollow.min() < hollow.max() < 0.5 < np.linalg.norm(cage.skeleton().vertices, axis=1).min()
    assert len(triangles) < len(cage.patches()[1]) / 2
    assert not len(polyballs._enclosed(row)[1])


@pytest.mark.parametrize("wrong", [[], [psl.Polyball([(0, 0)], [1])], 7 * [psl.Polyball([(0, 0, 0)], [1])]])
def test_figure_12_refuses_what_it_cannot_show(wrong):
    with pytest.raises(psl.InputError, match="one to six"):
        figures.figure_12(wrong)
