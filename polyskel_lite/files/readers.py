"""Files and pictures to arrays, through well-kept readers.

Outlines come from GeoJSON (the standard library), SVG (svgpathtools) and pictures (Pillow, contours
by contourpy), solids from mesh files (trimesh). Whatever the source of an outline, rings inside rings
are holes (even-odd), and up is up: the rows of pictures and the y axis of SVG, which run downward, are
flipped.
"""

from __future__ import annotations

import json
import zipfile
import zlib
from collections.abc import Iterator
from numbers import Real
from os import PathLike
from pathlib import Path

import numpy as np
from scipy.ndimage import gaussian_filter

from ..errors import InputError
from .meshes import MESH_SUFFIXES, read_mesh
from .svg import distinct, svg_rings

_PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".gif", ".tif", ".tiff", ".webp", ".pgm", ".pbm", ".ppm")
# What np.load raises for a file that is cut short, has a byte changed, or is none of its files at all.
_BROKEN_ARRAYS = (
    *(OSError, ValueError, TypeError, IndexError, EOFError, NotImplementedError, RuntimeError),
    *(OverflowError, zipfile.BadZipFile, zlib.error),
)
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
      ``pip install polyskel-lite[files]``.
    - ``.png``, ``.jpg`` and other pictures: the silhouette, in pixels (see `trace`). It is the
      opaque part if the picture is transparent anywhere, otherwise the dark part.
    - ``.stl``, ``.ply``, ``.obj``, ``.off``: a closed triangle mesh (see `read_mesh`). Needs
      ``pip install polyskel-lite[meshes]``.
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

    Raises
    ------
    InputError
        If the file is missing, empty or broken, has no closed outline, or is of a kind not read.

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
    ...     kind, (rings,) = read_file(file)
    >>> kind, rings[0].tolist()
    ('rings', [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    """
    path = Path(path)
    suffix = path.suffix.lower()
    known = (".geojson", ".json", ".svg", ".npz", *MESH_SUFFIXES, *_PICTURES)
    if suffix not in known:
        raise InputError(f"no reader for {suffix or 'no suffix'!r}; it reads {', '.join(known)}.")
    if not path.is_file():
        raise InputError(f"there is no such file; check the path {path}.")
    if not path.stat().st_size:
        raise InputError("the file is empty; save it again.")
    if suffix == ".npz":
        return _read_npz(path)
    if suffix in MESH_SUFFIXES:
        return "mesh", read_mesh(path)
    if suffix in _PICTURES:
        return "rings", (_read_picture(path, level, smooth, invert),)
    return "rings", (svg_rings(path, tolerance) if suffix == ".svg" else _geojson_rings(path),)


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
    if not (isinstance(level, Real) and np.isfinite(level)):
        raise InputError(f"level is {level!r}; pass a finite number.")
    if not (isinstance(smooth, Real) and np.isfinite(smooth) and smooth >= 0):
        raise InputError(f"smooth is {smooth!r}; pass a width in pixels, 0 or more.")
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
    try:
        values = np.array(image, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"image is not an array of numbers ({error}); pass (rows, columns).") from None
    if values.ndim != 2 or not values.size:
        raise InputError(f"image has shape {values.shape}; pass one channel, an array (rows, columns).")
    bad = np.argwhere(~np.isfinite(values))
    if len(bad):
        row, column = bad[0]
        raise InputError(f"image[{row}, {column}] is {values[row, column]}; all pixels have to be finite.")
    return values


def _off_level(values: np.ndarray, level: float) -> np.ndarray:
    """The values, with those at the level or very near it moved a little away from it."""
    above = values - level
    least = _NUDGE * np.abs(above).max()
    return np.where(np.abs(above) < least, level + np.where(above >= 0, least, -least), values)


def _contours(values: np.ndarray, level: float) -> list[np.ndarray]:
    """Closed contours in (column, row) coordinates, without the repeated last vertex."""
    from contourpy import LineType, contour_generator

    generator = contour_generator(z=values, name="serial", line_type=LineType.Separate)
    return [line[:-1] for line in generator.lines(level)]


# --- pictures -------------------------------------------------------------------------------------


def _read_picture(path: Path, level: float, smooth: float, invert: bool) -> list[np.ndarray]:
    values, kind = _picture_values(path)
    if invert:
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
        with Image.open(path) as picture:
            if picture.mode.startswith(("I", "F")):  # 16 bits and more; Pillow would clip them to 8
                deep = np.asarray(picture, dtype=np.float64)
                return 1 - deep / max(float(deep.max()), 1.0), "dark"
            rgba = picture.convert("RGBA")
    except UnidentifiedImageError:  # its own message has the whole path, which may be a temporary one
        raise InputError("the picture cannot be opened (no known format); save it again, as PNG.") from None
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        raise InputError(f"the picture cannot be opened ({error}); save it again, as PNG.") from None
    opacity = np.asarray(rgba.getchannel("A"), dtype=np.float64) / 255
    if opacity.min() < 1:
        return opacity, "opaque"
    return 1 - np.asarray(rgba.convert("L"), dtype=np.float64) / 255, "dark"


# --- arrays ---------------------------------------------------------------------------------------


def _read_npz(path: Path) -> tuple[str, tuple]:
    try:
        with path.open("rb") as stream, np.load(stream) as data:
            arrays = {name: data[name] for name in data.files}
        if {"xy", "off"} <= arrays.keys():
            rings = np.split(arrays["xy"], arrays["off"][1:-1])
    except _BROKEN_ARRAYS as error:
        raise InputError(f"not a file of arrays of numbers ({error}); save it with numpy.savez.") from None
    if {"points", "facets"} <= arrays.keys():
        return "facets", (arrays["points"], arrays["facets"])
    if {"xy", "off"} <= arrays.keys():
        return "rings", (rings,)
    raise InputError(
        f"its arrays are {', '.join(sorted(arrays)) or 'none'}; it needs points and facets, or xy and off."
    )


# --- GeoJSON --------------------------------------------------------------------------------------


def _geojson_rings(path: Path) -> list[np.ndarray]:
    try:
        content = json.loads(path.read_text(encoding="utf-8-sig"))
    except (ValueError, RecursionError) as error:
        raise InputError(f"this is not JSON ({error}); save it again as GeoJSON.") from None
    rings = [_position_ring(*found) for found in _linear_rings(content, "the file")]
    if not rings:
        raise InputError("there is no Polygon or MultiPolygon in it; save an area, not an empty collection.")
    return rings


def _linear_rings(content, where: str) -> Iterator[tuple[list, str]]:
    """All rings below a GeoJSON object, each with its place in the file for messages."""
    kind = content.get("type") if isinstance(content, dict) else None
    parts = {
        "FeatureCollection": "features",
        "GeometryCollection": "geometries",
        "Feature": "geometry",
        "MultiPolygon": "coordinates",
        "Polygon": "coordinates",
    }
    if kind not in parts:
        found = f"a {kind}" if kind else "no GeoJSON object"
        raise InputError(f"{where} is {found}; only Polygon and MultiPolygon have an inside: take it out.")
    name = parts[kind]
    part, below = content.get(name), name if where == "the file" else f"{where}.{name}"
    if kind == "Feature":
        if part is not None:  # a feature without a place is legal
            yield from _linear_rings(part, below)
        return
    for k, item in _items(part, below):
        if kind == "Polygon":
            yield item, f"{below}[{k}]"
        elif kind == "MultiPolygon":
            yield from ((ring, f"{below}[{k}][{m}]") for m, ring in _items(item, f"{below}[{k}]"))
        else:
            yield from _linear_rings(item, f"{below}[{k}]")


def _items(part, where: str) -> Iterator[tuple[int, object]]:
    if not isinstance(part, list):
        raise InputError(f"{where} is not a list; save the file again as GeoJSON.")
    return enumerate(part)


def _position_ring(positions, where: str) -> np.ndarray:
    try:
        ring = np.array([position[:2] for position in positions], dtype=np.float64)
    except (TypeError, ValueError):
        ring = np.empty(0)
    if ring.ndim != 2 or ring.shape[1] != 2:
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
