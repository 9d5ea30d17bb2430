"""Outlines of pictures: which part of one is the shape, and contours half way between its tones."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
from scipy.ndimage import gaussian_filter

from ..checks import as_flag, as_floats, as_number
from ..errors import InputError, LeftOutWarning, PolyskelError

PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".gif", ".tif", ".tiff", ".webp", ".pgm", ".pbm", ".ppm")
# Only these are tried, whatever the file is called: Pillow would start Ghostscript for PostScript.
_FORMATS = ("PNG", "JPEG", "BMP", "GIF", "TIFF", "WEBP", "PPM")
#: Pixels of a picture: contours of more take minutes. 16 million are 4000 x 4000.
MOST_PIXELS = 16_000_000
# Values nearer to the level than this share of the largest difference are moved away from it.
_NUDGE = 1e-4
# How bright a colour is; colours that differ by less are one; how far others may be from between two tones.
_GREY = np.array([0.299, 0.587, 0.114])
_ONE_TONE = 3 / 255
_OFF_TONES = 0.2


def trace(image, level: float | None = None, smooth: float = 0.0) -> list[np.ndarray]:
    """Trace the part of a picture whose values reach a level (marching squares).

    Pixel (row, column) is the unit square around (column + 0.5, rows - row - 0.5): the picture fills
    [0, columns] × [0, rows], and up is up. A part that reaches the border is closed there.

    Parameters
    ----------
    image : (rows, columns) array-like of bool or float
    level : float, optional
        The outline passes where values, interpolated between the centres of pixels, are at this level. By
        default half way between the least and the largest value, as for masks of 0 and 255; at 0.5 where
        values are fractions between 0 and 1.
    smooth : float
        Standard deviation, in pixels, of a Gaussian blur beforehand; 0 for none. It rounds the
        staircase of a yes-no picture and swallows smaller details.

    Returns
    -------
    list of (k, 2) float arrays
        Closed rings, with one vertex between every two neighbouring pixels on different sides of the level.

    Raises
    ------
    InputError
        If `image` is not a finite two-dimensional array, or no pixel reaches the level.

    Notes
    -----
    Contours are computed by contourpy. Two rules keep them from touching. Where two pixels reach the
    level and two do not, crosswise, the two are connected if the mean of the four is above the level;
    in a yes-no picture they are not. And values nearer to the level than 1e-4 of the largest
    difference are moved to that distance (values at the level count as reaching it), so that no
    contour passes through the centre of a pixel.

    Examples
    --------
    >>> (ring,) = trace([[0, 0, 0], [0, 1, 1], [0, 0, 0]])
    >>> ring.min(axis=0).tolist(), ring.max(axis=0).tolist()
    ([1.0, 1.0], [3.0, 2.0])
    """
    values = _as_image(image)
    level = _half_way(values) if level is None else as_number(level, "level", "a finite number")
    # A blur reaches four times as far, and a wider one than the picture leaves nothing of it.
    smooth = as_number(smooth, "smooth", f"a width in pixels, 0 to {max(values.shape)}", 0, max(values.shape))
    if values.max() < level:
        raise InputError(f"no pixel reaches the level {level:g}, the largest is {values.max():g}; lower it.")
    # Outside, the mirror of the largest value: what reaches the border ends with the border's pixels,
    # blurred or not.
    values = np.pad(values, 1, constant_values=level - (values.max() - level or 1.0))
    if smooth:
        values = gaussian_filter(values, smooth, mode="nearest")
        if values.max() < level:
            raise InputError(f"no pixel reaches the level {level:g} smoothed by {smooth:g}; smooth less.")
    values = _off_level(values, level)
    rows = values.shape[0] - 2
    return [(ring - 0.5) * (1, -1) + (0, rows) for ring in _contours(values, level)]


def _half_way(values: np.ndarray) -> float:
    low, high = float(values.min()), float(values.max())
    if low >= 0 and high <= 1 and (values % 1).any():
        return 0.5
    return (low + high) / 2 if low < high else high / 2 if high > 0 else 0.5


def _as_image(image) -> np.ndarray:
    values = as_floats(image, "image", "an array (rows, columns)")
    if values.ndim != 2 or not values.size:
        raise InputError(f"image has shape {values.shape}; pass one channel, an array (rows, columns).")
    _check_pixels(values.shape)
    return values


def _check_pixels(shape) -> None:
    rows, columns = shape
    if rows * columns > MOST_PIXELS:
        raise InputError(
            f"the picture has {rows} x {columns} pixels, and {MOST_PIXELS:,} are the most; make it smaller."
        )


def _off_level(values: np.ndarray, level: float) -> np.ndarray:
    """The values, with those at the level or very near it moved a little away from it."""
    above = values - level
    least = _NUDGE * np.abs(above).max()
    return np.where(np.abs(above) < least, level + np.where(above >= 0, least, -least), values)


def _contours(values: np.ndarray, level: float) -> list[np.ndarray]:
    """Closed contours in (column, row) coordinates, without the repeated last vertex."""
    from contourpy import LineType, contour_generator

    generator = contour_generator(z=values, name="serial", line_type=LineType.Separate)
    return [np.asarray(line)[:-1] for line in generator.lines(level)]


def picture_rings(path: Path, level: float, smooth: float, invert) -> list[np.ndarray]:
    """The silhouette in a picture file; see `read_file`.

    Examples
    --------
    >>> import tempfile
    >>> from PIL import Image
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "a.png"
    ...     Image.fromarray(np.pad(np.full((2, 2), 90, np.uint8), 1, constant_values=100)).save(file)
    ...     picture_rings(file, 0.5, 0, "auto")[0].shape
    (8, 2)
    """
    auto = isinstance(invert, str) and invert == "auto"
    asked = not auto and as_flag(invert, "invert")
    values, kind, turned = _silhouette(_colours(path), level)
    reach = values >= level
    if reach.all() or not reach.any():
        which = "all pixels are" if reach.all() else "no pixel is"
        raise InputError(
            f"{which} {kind} at level {level:g}, so there is no outline; change level, or use invert."
        )
    if auto and turned:
        warnings.warn(
            f"{path.name[:60]}: its border is dark, so the bright part is the shape; for the dark part pass "
            "invert=False.",
            LeftOutWarning,
            stacklevel=5,
        )
    return trace(1 - values if asked or (auto and turned) else values, level, smooth)


def _colours(path: Path) -> np.ndarray:
    """Red, green, blue and opacity of each pixel, from 0 to 1."""
    from PIL import Image, UnidentifiedImageError

    try:
        with Image.open(path, formats=_FORMATS) as picture:
            _check_pixels(picture.size[::-1])
            if picture.mode.startswith(("I", "F")):  # 16 bits and more; Pillow would clip them to 8
                deep = np.asarray(picture, dtype=np.float64)
                deep = deep / max(float(deep.max()), 1.0)
                return np.stack([deep, deep, deep, np.ones_like(deep)], axis=2)
            return np.asarray(picture.convert("RGBA"), dtype=np.float64) / 255
    except UnidentifiedImageError:  # its own message has the whole path, which may be a temporary one
        raise InputError("the picture cannot be opened (no known format); save it again, as PNG.") from None
    except PolyskelError:
        raise
    except Exception as error:
        why = f"{type(error).__name__}: {error}"[:200]
        raise InputError(f"the picture cannot be opened ({why}); save it again, as PNG.") from None


def _silhouette(pixels: np.ndarray, level: float) -> tuple[np.ndarray, str, bool]:
    """Values from 0 to 1, what those near 1 are, and whether these are the ground, as the border tells."""
    colours, opacity = pixels[..., :3], pixels[..., 3]
    seen = opacity > opacity.max() / 2
    border = np.ones(seen.shape, dtype=bool)
    border[1:-1, 1:-1] = False
    if not seen.any():
        return opacity, "opaque", False
    if not seen.all():
        if seen[border].mean() < 0.5 or np.ptp(colours[seen], axis=0).max() < _ONE_TONE:
            return opacity / opacity.max(), "opaque", False
        colours = np.where(seen[..., None], colours, _commonest(colours[border & seen]))
    grey = colours @ _GREY
    ground = _commonest(colours[border])
    away = np.linalg.norm(colours - ground, axis=2)
    shape = _commonest(colours[away >= away.max() / 2])
    way = shape - ground
    if (length := float(way @ way)) == 0:
        return 1 - grey, "dark", False
    share = np.clip((colours - ground) @ way / length, 0, 1)
    off = np.linalg.norm(colours - ground - share[..., None] * way, axis=2)
    if (off > _OFF_TONES * length**0.5).mean() > _OFF_TONES**2:  # more than two tones: what is dark
        return 1 - grey, "dark", bool(grey[border].mean() < 1 - level)
    bright = bool(way @ _GREY > 0)
    return 1 - share if bright else share, "dark", bright


def _commonest(colours: np.ndarray) -> np.ndarray:
    """The colour that most of some colours (k, 3) are near."""
    _, kind, count = np.unique(
        (colours * 16).astype(int) @ (1, 32, 1024), return_inverse=True, return_counts=True
    )
    return np.median(colours[kind == count.argmax()], axis=0)
