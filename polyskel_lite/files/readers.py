"""Files and pictures to arrays, through well-kept readers.

Outlines come from GeoJSON (the standard library), SVG (svgpathtools) and pictures (Pillow, contours
by contourpy), solids from mesh files (trimesh). Whatever the source of an outline, rings inside rings
are holes (even-odd), and up is up: the rows of pictures and the y axis of SVG, which run downward, are
flipped.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from os import PathLike
from pathlib import Path

import numpy as np
from scipy.ndimage import gaussian_filter

from ..checks import as_flag, as_floats, as_number, as_path, shown
from ..errors import InputError, PolyskelError
from .arrays import read_arrays
from .meshes import MESH_SUFFIXES, read_mesh
from .svg import distinct, svg_rings

_PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".gif", ".tif", ".tiff", ".webp", ".pgm", ".pbm", ".ppm")
# Only these are tried, whatever the file is called: Pillow would start Ghostscript for PostScript.
_FORMATS = ("PNG", "JPEG", "BMP", "GIF", "TIFF", "WEBP", "PPM")
#: Bytes of a file: parsing text takes ten times as much memory.
MOST_BYTES = 2**28
#: Pixels of a picture: contours of more take minutes. 16 million are 4000 x 4000.
MOST_PIXELS = 16_000_000
# Values nearer to the level than this share of the largest difference are moved away from it.
_NUDGE = 1e-4


def read_file(
    path: str | PathLike,
    *,
    tolerance: float = 1e-3,
    level: float = 0.5,
    smooth: float = 0.0,
    invert: bool = False,
) -> tuple[str, tuple]:
    """Read a boundary from a file; the suffix says how.

    - ``.geojson``, ``.json``: all Polygons and MultiPolygons, alone, in Features or in collections.
      Longitude and latitude are taken as plane coordinates: project them first where that matters.
    - ``.svg``: all closed paths and basic shapes, transforms applied, in user units, y upward. Needs
      ``pip install svgpathtools``.
    - ``.png``, ``.jpg`` and other pictures: the silhouette, in pixels (see `trace`). It is the
      opaque part if the picture is transparent anywhere, otherwise the dark part.
    - ``.stl``, ``.ply``, ``.obj``, ``.off``: a closed triangle mesh (see `read_mesh`). Needs
      ``pip install trimesh``.
    - ``.npz``: the arrays ``points`` and ``facets`` of a `Shape`, or ``xy`` and ``off`` (the vertices
      of all rings and where each ring begins, with the total at the end).

    Parameters
    ----------
    path : str or path
    tolerance : float
        SVG only: how far the polygon may leave a curve, as a share of the diagonal of the drawing.
    level, smooth : float
        Pictures only: see `trace`. The values are opacity or darkness, from 0 to 1.
    invert : bool
        Pictures only: take the transparent or bright part.

    Returns
    -------
    kind : "rings", "mesh" or "facets"
        What the arrays are: arguments of `Shape.from_rings`, of `Shape.from_mesh` or of `Shape` itself.
    arrays : tuple
        Outlines from GeoJSON and SVG come with the names of their rings, for messages.

    Raises
    ------
    InputError
        If the file is missing, empty, broken or too large, has no closed outline, or is of a kind not read.

    Notes
    -----
    An SVG path that does not end where it begins is refused, unless it is drawn with fill "none":
    then it is a stroke and left out, as lines are. Other strokes count by their path, without width.
    A background rectangle is an outline like any other. Text, clipping and ``<use>`` are not followed.

    Examples
    --------
    >>> import json, pathlib, tempfile
    >>> square = {"type": "Polygon", "coordinates": [[[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]]]}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "square.geojson"
    ...     _ = file.write_text(json.dumps(square))
    ...     kind, (rings, names) = read_file(file)
    >>> kind, names, rings[0].tolist()
    ('rings', ['ring 0'], [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    """
    path = as_path(path)
    suffix = path.suffix.lower()
    known = (".geojson", ".json", ".svg", ".npz", *MESH_SUFFIXES, *_PICTURES)
    if suffix not in known:
        raise InputError(f"no reader for {suffix[:9] or 'no suffix'!r}; it reads {', '.join(known)}.")
    try:
        if not path.is_file():
            raise InputError(f"there is no such file; check the path {shown(str(path))}.")
        if not path.stat().st_size:
            raise InputError("the file is empty; save it again.")
        if path.stat().st_size > MOST_BYTES:
            raise InputError(f"the file has more than {MOST_BYTES:,} bytes; save it smaller.")
        if suffix == ".npz":
            return _read_npz(path)
        if suffix in MESH_SUFFIXES:
            return "mesh", read_mesh(path)
        if suffix in _PICTURES:
            return "rings", (_read_picture(path, level, smooth, invert),)
        return "rings", (svg_rings(path, tolerance) if suffix == ".svg" else _geojson_rings(path))
    except PolyskelError:
        raise
    except Exception as error:  # the readers raise whatever a broken file makes them stumble over
        raise InputError(f"the file cannot be read ({_short(error)}); save it again.") from error


def _short(error: Exception) -> str:
    return f"{type(error).__name__}: {error}"[:200]


def trace(image, level: float = 0.5, smooth: float = 0.0) -> list[np.ndarray]:
    """Trace the part of a picture whose values reach a level (marching squares).

    Pixel (row, column) is the unit square around (column + 0.5, rows - row - 0.5): the picture fills
    [0, columns] × [0, rows], and up is up. A part that reaches the border is closed there.

    Parameters
    ----------
    image : (rows, columns) array-like of bool or float
    level : float
        The outline passes where values, interpolated between the centres of pixels, are at this level.
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
    level = as_number(level, "level", "a finite number")
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


# --- pictures -------------------------------------------------------------------------------------


def _read_picture(path: Path, level: float, smooth: float, invert: bool) -> list[np.ndarray]:
    values, kind = _picture_values(path)
    if as_flag(invert, "invert"):
        values = 1 - values
    reach = values >= level
    if reach.all() or not reach.any():
        which = "all pixels are" if reach.all() else "no pixel is"
        raise InputError(
            f"{which} {kind} at level {level:g}, so there is no outline; change level, or use invert."
        )
    return trace(values, level, smooth)


def _picture_values(path: Path) -> tuple[np.ndarray, str]:
    """The opacity of a picture with transparent pixels, the darkness of another one; from 0 to 1."""
    from PIL import Image, UnidentifiedImageError

    try:
        with Image.open(path, formats=_FORMATS) as picture:
            _check_pixels(picture.size[::-1])
            if picture.mode.startswith(("I", "F")):  # 16 bits and more; Pillow would clip them to 8
                deep = np.asarray(picture, dtype=np.float64)
                return 1 - deep / max(float(deep.max()), 1.0), "dark"
            rgba = picture.convert("RGBA")
    except UnidentifiedImageError:  # its own message has the whole path, which may be a temporary one
        raise InputError("the picture cannot be opened (no known format); save it again, as PNG.") from None
    except PolyskelError:
        raise
    except Exception as error:
        raise InputError(f"the picture cannot be opened ({_short(error)}); save it again, as PNG.") from None
    opacity = np.asarray(rgba.getchannel("A"), dtype=np.float64) / 255
    if opacity.min() < 1:
        return opacity, "opaque"
    return 1 - np.asarray(rgba.convert("L"), dtype=np.float64) / 255, "dark"


# --- arrays ---------------------------------------------------------------------------------------


def _read_npz(path: Path) -> tuple[str, tuple]:
    arrays = read_arrays(path)
    if {"points", "facets"} <= arrays.keys():
        return "facets", (arrays["points"], arrays["facets"])
    if {"xy", "off"} <= arrays.keys():
        xy, off = arrays["xy"], arrays["off"]
        whole = off.ndim == 1 and len(off) > 1 and off.dtype.kind in "iu"
        if not whole or off[0] != 0 or off[-1] != len(xy) or (off[1:] <= off[:-1]).any():
            raise InputError("off must say where each ring begins, from 0 up, and at its end the total.")
        return "rings", (np.split(xy, off[1:-1]),)
    raise InputError(
        f"its arrays are {', '.join(sorted(arrays)) or 'none'}; it needs points and facets, or xy and off."
    )


# --- GeoJSON --------------------------------------------------------------------------------------


def _geojson_rings(path: Path) -> tuple[list[np.ndarray], list[str]]:
    try:
        content = json.loads(path.read_text(encoding="utf-8-sig"))
    except (ValueError, RecursionError) as error:
        raise InputError(f"this is not JSON ({error}); save it again as GeoJSON.") from None
    found = list(_linear_rings(content, ""))
    if not found:
        raise InputError("there is no Polygon or MultiPolygon in it; save an area, not an empty collection.")
    return [_position_ring(*ring) for ring in found], [where for _, where in found]


# What is below a GeoJSON object, and how messages call one of these.
_PARTS = {
    "FeatureCollection": ("features", "feature"),
    "GeometryCollection": ("geometries", "geometry"),
    "Feature": ("geometry", ""),
    "MultiPolygon": ("coordinates", "polygon"),
    "Polygon": ("coordinates", "ring"),
}


def _linear_rings(content, where: str) -> Iterator[tuple[list, str]]:
    """All rings below a GeoJSON object, each with its place in the file for messages."""
    kind = content.get("type") if isinstance(content, dict) else None
    if not isinstance(kind, str) or kind not in _PARTS:
        found = f"a {kind[:40]}" if isinstance(kind, str) else "no GeoJSON object"
        raise InputError(
            f"{where or 'the file'} is {found}; only Polygon and MultiPolygon have an inside: take it out."
        )
    name, each = _PARTS[kind]
    part = content.get(name)
    if kind == "Feature":
        if part is not None:  # a feature without a place is legal
            yield from _linear_rings(part, where)
        return
    if not isinstance(part, list):
        raise InputError(f"{where or 'the file'}: {name} is not a list; save the file again as GeoJSON.")
    for k, item in enumerate(part):
        here = f"{where}, {each} {k}" if where else f"{each} {k}"
        if kind == "Polygon":
            yield item, here
        else:
            below = {"type": "Polygon", "coordinates": item} if kind == "MultiPolygon" else item
            yield from _linear_rings(below, here)


def _position_ring(positions, where: str) -> np.ndarray:
    is_list = isinstance(positions, list) and all(isinstance(p, list) and len(p) > 1 for p in positions)
    if not is_list or not positions:
        raise InputError(f"{where} is not a list of positions [x, y]; save the file again as GeoJSON.")
    ring = as_floats([position[:2] for position in positions], where, "positions [x, y]")
    if ring.ndim != 2:
        raise InputError(f"{where} is not a list of positions [x, y]; save the file again as GeoJSON.")
    if (ring[0] != ring[-1]).any():
        raise InputError(
            f"{where} is open: it begins at {_place(ring[0])} and ends at {_place(ring[-1])}; "
            "repeat the first position at the end."
        )
    ring = distinct(ring[:-1])
    if len(ring) < 3:
        raise InputError(f"{where} has {len(ring)} different positions; a ring needs at least three.")
    return ring


def _place(point) -> str:
    return f"({point[0]:g}, {point[1]:g})"
