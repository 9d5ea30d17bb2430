"""Pictures: which part of them is the shape."""

import numpy as np
import pytest
from PIL import Image

from polyskel_lite import InputError, LeftOutWarning, Shape


def read_picture(folder, pixels, **options):
    path = folder / "picture.png"
    Image.fromarray(np.asarray(pixels)).save(path)
    return Shape.from_file(path, **options)


def test_shape_has_the_readers(tmp_path):
    Image.fromarray(np.pad(np.zeros((4, 4), np.uint8), 2, constant_values=255)).save(tmp_path / "a.png")
    shape = Shape.from_file(tmp_path / "a.png", invert=False)
    assert (shape.points == Shape.from_mask(np.pad(np.ones((4, 4)), 2)).points).all()


INK = np.full((6, 8), 255, dtype=np.uint8)
INK[1:3, 1:5] = 0  # a dark bar near the top, 4 by 2 pixels
BAR = 8 - 4 / 8  # its area with cut corners


def test_dark_part_of_an_opaque_picture(tmp_path):
    for pixels in (INK, np.stack([INK] * 3, axis=2), INK > 0, INK.astype(np.uint16) * 257):
        shape = read_picture(tmp_path, pixels)
        assert shape.area() == pytest.approx(BAR, abs=1e-9)
        assert shape.points.min(axis=0).tolist() == [1, 3]


def test_deep_grey_counts_from_its_brightest_value(tmp_path):
    """Sixteen bits, of which a camera used ten."""
    pixels = np.where(INK > 0, 1000, 300).astype(np.uint16)
    assert read_picture(tmp_path, pixels).betti() == (1, 0)


def test_opaque_part_of_a_transparent_picture(tmp_path):
    """The bar is white here: opacity decides, whatever the colour."""
    rgba = np.stack([np.full_like(INK, 255)] * 3 + [255 - INK], axis=2)
    assert read_picture(tmp_path, rgba).area() == pytest.approx(BAR)


def test_palette_with_transparency(tmp_path):
    picture = Image.fromarray((INK > 0).astype(np.uint8)).convert("P")
    picture.save(tmp_path / "a.gif", transparency=int(picture.getpixel((0, 0))))
    assert Shape.from_file(tmp_path / "a.gif").area() == pytest.approx(BAR)


def test_invert_takes_the_other_part(tmp_path):
    assert read_picture(tmp_path, 255 - INK, invert=True).area() == pytest.approx(BAR)
    assert read_picture(tmp_path, INK, invert=True).betti() == (1, 1)


def test_level_and_smooth_reach_the_picture(tmp_path):
    grey = np.where(INK == 0, 100, 255).astype(np.uint8)
    edges = [read_picture(tmp_path, grey, level=level).points[:, 0].min() for level in (0.25, 0.5, 0.75)]
    assert edges == pytest.approx([0.75, 1, 1.25])  # a share of the way from one tone to the other
    assert read_picture(tmp_path, INK, smooth=0.7).area() != pytest.approx(BAR, rel=1e-3)


ROW, COLUMN = np.indices((120, 120))
RING = np.abs(np.hypot(ROW - 60, COLUMN - 60) - 27.5) < 12.5
TONES = {
    "black on white": ((0, 0, 0), (255, 255, 255)),
    "cyan on white": ((0, 200, 220), (255, 255, 255)),
    "yellow on white": ((250, 220, 0), (255, 255, 255)),
    "light grey on white": ((250, 250, 250), (255, 255, 255)),
    "red on green of one brightness": ((200, 0, 0), (0, 102, 0)),
}


@pytest.mark.parametrize("smooth", [0, 1])
@pytest.mark.parametrize("tones", TONES)
def test_outline_is_half_way_between_the_tones(tmp_path, tones, smooth):
    shape, ground = np.array(TONES[tones], dtype=np.uint8)
    pixels = np.where(RING[..., None], shape, ground)
    right = Shape.from_mask(RING, smooth=smooth)
    pictures = {
        "colours": Image.fromarray(pixels),
        "palette": Image.fromarray(pixels).quantize(2),
        "opaque": Image.fromarray(np.dstack([pixels, np.full(RING.shape, 255, np.uint8)])),
    }
    stray = np.array(pictures["opaque"])
    stray[0, 0, 3] = 254
    pictures["a stray pixel"] = Image.fromarray(stray)
    stray = stray.copy()
    stray[5, 5, 3] = 0
    pictures["a hole"] = Image.fromarray(stray)
    for name, picture in pictures.items():
        picture.save(tmp_path / "a.png")
        found = Shape.from_file(tmp_path / "a.png", smooth=smooth)
        assert found.betti() == (1, 1), name
        assert found.area() == pytest.approx(right.area(), rel=1e-2), name


@pytest.mark.parametrize("high", [1, 255])
def test_mask_files_with_a_dark_ground(tmp_path, high):
    with pytest.warns(
        LeftOutWarning, match=r"picture\.png: its border is dark, so the bright part is the shape"
    ):
        shape = read_picture(tmp_path, RING.astype(np.uint8) * np.uint8(high))
    assert shape.area() == RING.sum()
    ground = read_picture(tmp_path, RING.astype(np.uint8) * np.uint8(high), invert=False)
    assert ground.area() == pytest.approx(120**2 - RING.sum(), abs=1)


def test_half_transparent_shape(tmp_path):
    pixels = np.zeros((*RING.shape, 4), dtype=np.uint8)
    pixels[RING] = (9, 9, 9, 100)
    assert read_picture(tmp_path, pixels).area() == RING.sum()


def test_drawing_in_many_tones_is_what_is_dark(tmp_path):
    pixels = np.full((30, 30, 3), 255, dtype=np.uint8)
    for k, colour in enumerate([(200, 0, 0), (0, 100, 0), (0, 0, 200), (0, 0, 0)]):
        pixels[3 + 6 * k : 6 + 6 * k, 5:25] = colour
    assert read_picture(tmp_path, pixels).betti() == (4, 0)


@pytest.mark.parametrize(
    ("pixels", "message"),
    [
        (np.zeros((5, 5), np.uint8), "all pixels are dark at level 0.5, so there is no outline; .* invert"),
        (np.full((5, 5), 255, np.uint8), "no pixel is dark"),
        (np.zeros((5, 5, 4), np.uint8), "no pixel is opaque"),
    ],
)
def test_pictures_without_an_outline(tmp_path, pixels, message):
    with pytest.raises(InputError, match=message):
        read_picture(tmp_path, pixels)


def test_broken_pictures(tmp_path):
    Image.fromarray(np.random.default_rng(0).integers(0, 255, (50, 50), dtype=np.uint8)).save(
        tmp_path / "a.png"
    )
    whole = (tmp_path / "a.png").read_bytes()
    for content in (b"no picture at all", whole[: len(whole) // 2]):
        (tmp_path / "b.png").write_bytes(content)
        with pytest.raises(InputError, match=r"^b\.png: the picture cannot be opened"):
            Shape.from_file(tmp_path / "b.png")


def test_only_pictures_are_opened_as_pictures(tmp_path):
    """PostScript would start Ghostscript, whatever the file is called."""
    (tmp_path / "a.png").write_bytes(
        b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n%%EndComments\nshowpage\n"
    )
    with pytest.raises(InputError, match="no known format"):
        Shape.from_file(tmp_path / "a.png")


def test_pictures_of_too_many_pixels(tmp_path):
    Image.fromarray(np.zeros((4100, 4100), dtype=bool)).save(tmp_path / "a.png")
    with pytest.raises(InputError, match="4100 x 4100 pixels, and 16,000,000 are the most; make it smaller"):
        Shape.from_file(tmp_path / "a.png")
