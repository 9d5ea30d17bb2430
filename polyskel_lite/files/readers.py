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


