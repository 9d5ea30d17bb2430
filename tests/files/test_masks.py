"""Outlines of masks: where they run, and that any picture has the topology of its pixels."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.ndimage import label

from polyskel_lite import InputError, Shape


def test_mask_is_placed_in_pixels_and_up_is_up():
    shape = Shape.from_mask([[0, 1, 1], [0, 0, 0], [0, 0, 0], [0, 0, 0]])
    assert shape.contains([(1.5, 3.5), (2.5, 3.5), (0.5, 3.5), (1.5, 0.5)]).tolist() == [1, 1, 0, 0]
    assert shape.points.max(axis=0).tolist() == [3, 4]
    assert shape.points.min(axis=0).tolist() == [1, 3]


def test_full_mask_is_closed_at_the_border():
    shape = Shape.from_mask(np.ones((3, 5), dtype=bool))
    assert shape.betti() == (1, 0)
    assert np.ptp(shape.points, axis=0).tolist() == [5, 3]
    assert shape.area() == 15 - 4 / 8  # the corners are cut at half a pixel


def test_grey_values_place_the_outline_between_pixels():
    ramp = np.tile(np.linspace(1, 0, 11), (40, 1))  # 1 - 0.1 column; falls to 0.25 at column 7.5, x = 8
    assert Shape.from_mask(ramp, level=0.25).points[:, 0].max() == pytest.approx(8)


def test_level_of_values_outside_zero_to_one():
    shape = Shape.from_mask(np.pad(np.full((4, 4), 1000.0), 2, constant_values=-1000), level=0)
    assert shape.area() == 16 - 4 / 8
    assert shape.points.min() == 2


def test_negative_values_and_a_flat_image_at_the_level():
    assert Shape.from_mask(np.full((2, 2), -3.0), level=-3.0).betti() == (1, 0)


def test_ring_has_a_hole():
    row, column = np.indices((40, 40)) - 19.5
    far = np.hypot(row, column)
    shape = Shape.from_mask((far < 15) & (far > 8))
    assert shape.betti() == (1, 1)
    assert shape.area() == pytest.approx(np.pi * (15**2 - 8**2), rel=0.01)


def test_smoothing_rounds_the_staircase():
    row, column = np.indices((60, 60)) - 29.5
    disc = np.hypot(row, column) < 20
    rough, smooth = Shape.from_mask(disc), Shape.from_mask(disc, smooth=2)
    off = [np.abs(np.hypot(*(shape.points - 30).T) - 20).max() for shape in (rough, smooth)]
    assert off[1] < 0.5 * off[0]
    assert smooth.area() == pytest.approx(rough.area(), rel=0.02)


def test_smoothing_at_the_border_stays_closed():
    shape = Shape.from_mask(np.ones((20, 30)), smooth=1.5)
    assert shape.betti() == (1, 0)
    assert shape.area() == pytest.approx(600, rel=0.02)


def test_crosswise_pixels_are_apart_in_yes_no_pictures():
    board = np.indices((8, 8)).sum(axis=0) % 2
    assert Shape.from_mask(board).betti() == (32, 0)


@pytest.mark.parametrize(("low", "components"), [(0.2, 1), (0.0, 2)])
def test_crosswise_pixels_follow_the_mean(low, components):
    """Two pixels at 0.9 on a ground of `low`: the mean of the four is 0.55 or 0.45."""
    image = np.full((4, 4), low)
    image[1, 1] = image[2, 2] = 0.9
    assert Shape.from_mask(image).betti() == (components, 0)


@settings(max_examples=60, derandomize=True, deadline=None)
@given(arrays(bool, st.tuples(st.integers(1, 12), st.integers(1, 12))))
def test_any_yes_no_mask_has_its_topology(mask):
    """Components joined by edges of pixels, holes by edges and corners; every pixel on its side."""
    if not mask.any():
        with pytest.raises(InputError, match="no pixel"):
            Shape.from_mask(mask)
        return
    shape = Shape.from_mask(mask)
    components = label(mask)[1]
    ground = label(~np.pad(mask, 1), structure=np.ones((3, 3)))[1]
    assert shape.betti() == (components, ground - 1)
    rows, columns = mask.shape
    x, y = np.meshgrid(np.arange(columns) + 0.5, rows - np.arange(rows) - 0.5)
    inside = shape.contains(np.stack([x.ravel(), y.ravel()], axis=1))
    assert (inside == mask.ravel()).all()


@settings(max_examples=60, derandomize=True, deadline=None)
@given(
    arrays(np.int8, st.tuples(st.integers(2, 10), st.integers(2, 10)), elements=st.integers(-2, 2)),
    st.sampled_from([-1, -0.5, 0, 0.25, 1]),
)
def test_values_at_the_level_never_make_outlines_touch(image, level):
    if image.max() < level:
        return
    shape = Shape.from_mask(image, level=level)  # Shape refuses rings that touch
    rows, columns = image.shape
    x, y = np.meshgrid(np.arange(columns) + 0.5, rows - np.arange(rows) - 0.5)
    inside = shape.contains(np.stack([x.ravel(), y.ravel()], axis=1))
    assert (inside == (image >= level).ravel()).all()


@pytest.mark.parametrize(
    ("image", "options", "message"),
    [
        (np.zeros((3, 3)), {}, "no pixel reaches the level 0.5, the largest is 0"),
        (np.zeros((3, 3, 3)), {}, r"shape \(3, 3, 3\)"),
        (np.zeros((0, 3)), {}, r"shape \(0, 3\)"),
        ([[1, 2], [3]], {}, "not an array of numbers"),
        ([[1.0, np.nan]], {}, r"image\[0, 1\] is nan"),
        ([[1.0]], {"level": np.inf}, "level is inf"),
        ([[1.0]], {"smooth": -1}, "smooth is -1"),
        (np.pad([[1.0]], 5), {"smooth": 3}, "smoothed by 3; smooth less"),
    ],
)
def test_bad_masks(image, options, message):
    with pytest.raises(InputError, match=message):
        Shape.from_mask(image, **options)


def test_noise_of_thousands_of_specks():
    mask = np.random.default_rng(0).random((150, 150)) < 0.5
    ground = label(~np.pad(mask, 1), structure=np.ones((3, 3)))[1]
    assert Shape.from_mask(mask).betti() == (label(mask)[1], ground - 1)


@pytest.mark.parametrize("kind", [np.uint8, np.int32, np.float64])
def test_masks_of_0_and_255_have_the_outline_of_0_and_1(kind):
    mask = np.pad(np.ones((9, 5)), 3)
    right = Shape.from_mask(mask)
    assert (Shape.from_mask((255 * mask).astype(kind)).points == right.points).all()
    assert (Shape.from_mask((1 + mask).astype(kind)).points == right.points).all()
    assert (Shape.from_mask(np.full((4, 4), 255)).points == Shape.from_mask(np.ones((4, 4))).points).all()
