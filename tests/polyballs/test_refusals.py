"""Bad balls and bad queries are named; arrays are copied and frozen."""

import numpy as np
import pytest

from polyskel_lite import InputError
from polyskel_lite.polyballs.discs import disc_boundary
from polyskel_lite.polyballs.polyball import Polyball


@pytest.mark.parametrize(
    ("centers", "radii", "message"),
    [
        ([(0, 0), (1, 1)], [1, 0], r"radii\[1\] is 0; radii are positive"),
        ([(0, 0), (1, 1)], [1, -2], r"radii\[1\] is -2"),
        ([(0, 0)], [np.nan], r"radii\[0\] is nan"),
        ([(0, 0)], [np.inf], r"radii\[0\] is inf"),
        ([(0, 0)], [1, 2], r"radii has shape \(2,\) for 1 centers; pass a \(1,\) array"),
        ([(0, 0)], [[1]], r"radii has shape \(1, 1\)"),
        ([(0, 0)], ["one"], "radii is not an array of numbers"),
        ([(0, np.inf)], [1], r"centers\[0, 1\] is inf"),
        ([(0, 0, 0, 0)], [1], r"centers has shape \(1, 4\)"),
        (np.empty((0, 2)), [], "at least one ball"),
    ],
)
def test_bad_balls(centers, radii, message):
    with pytest.raises(InputError, match=message):
        Polyball(centers, radii)


def test_queries_are_checked():
    Y = Polyball([(0, 0)], [1])
    for ask in (Y.contains, Y.boundary_distance):
        with pytest.raises(InputError, match="queries has shape"):
            ask([(0, 0, 0)])
        assert ask(np.empty((0, 2))).shape == (0,)


@pytest.mark.parametrize(
    ("method", "centers", "words"),
    [
        ("arcs", [(0, 0, 0)], "polyballs in the plane"),
        ("volume", [(0, 0)], "polyballs in space"),
        ("patches", [(0, 0)], "polyballs in space"),
    ],
)
def test_methods_of_one_dimension_refuse_the_other(method, centers, words):
    with pytest.raises(InputError, match=rf"{method}\(\) is for {words}"):
        getattr(Polyball(centers, [1]), method)()


def test_arrays_are_copies_and_frozen():
    centers = np.zeros((1, 2))
    Y = Polyball(centers, [1])
    centers[0] = 5
    assert Y.centers.tolist() == [[0, 0]]
    for array in (Y.centers, Y.radii):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 2
    assert disc_boundary(Y.centers, Y.radii).arcs.ball.tolist() == [0]


def test_patches_that_would_be_too_many():
    with pytest.raises(
        InputError, match=r"asks for .* triangles, and 1,000,000 are the most; pass 0\.\d+ or more"
    ):
        Polyball([(0, 0, 0)], [1]).patches(1e-9)
