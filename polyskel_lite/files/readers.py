"""Files to arrays, through well-kept readers, whatever the file is."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

import numpy as np

from ..checks import as_path, shown
from ..errors import InputError, PolyskelError
from .arrays import read_arrays
from .geojson import geojson_areas
from .meshes import MESH_SUFFIXES, read_mesh
from .pictures import PICTURES, picture_rings
from .svg import svg_areas

#: Bytes of a file: parsing text takes ten times as much memory.
MOST_BYTES = 2**28


def read_file(
    path: str | PathLike,
    *,
    tolerance: float = 1e-3,
    level: float = 0.5,
    smooth: float = 0.0,
    invert: bool | str = "auto",
    stroke: bool = False,
) -> tuple[str, tuple]:
    """Read a boundary from a file; the suffix says how.

    - ``.geojson``, ``.json``: all Polygons and MultiPolygons, alone, in Features or in collections; points
      and lines are left out, which a warning counts. Longitude and latitude are taken as plane coordinates:
      project them first where that matters.
    - ``.svg``: what a renderer fills, in any colour, in user units, y upward: overlapping elements are
      united, open paths closed, what is hidden, clipped or outside of the frame is left out. Paths, basic
      shapes and transforms need ``pip install svgpathtools``, everything else the extra ``svg``. Text,
      images, masks and filters are named in a warning.
    - ``.png``, ``.jpg`` and other pictures: the silhouette, in pixels (see `trace`). It is the opaque part
      of a picture with a transparent ground, otherwise what differs from the border.
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
        Pictures only: see `trace`. The values go from 0 for the tone of the ground to 1 for that of the
        shape, so that the outline is half way between them; with more than two tones they are darkness.
    invert : bool or "auto"
        Pictures only. False takes the dark or opaque part, True the other one; "auto" the bright part if
        the border is dark, and says so in a warning.
    stroke : bool
        SVG only: whether lines count too, with their widths. Without it a drawing in which nothing is
        filled is read by its closed lines.

    Returns
    -------
    kind : "rings", "areas", "drawing", "mesh" or "facets"
        What the arrays are: arguments of `Shape.from_rings`, of `Shape.from_mesh` or of `Shape` itself; or
        from GeoJSON and SVG a list of `Area`, whose rings have names for messages.
    arrays : tuple

    Raises
    ------
    InputError
        If the file is missing, empty, broken or too large, has no closed outline, or is of a kind not read.

    Examples
    --------
    >>> import json, pathlib, tempfile
    >>> square = {"type": "Polygon", "coordinates": [[[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]]]}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "square.geojson"
    ...     _ = file.write_text(json.dumps(square))
    ...     kind, ((area,),) = read_file(file)
    >>> kind, area.names, area.rings[0].tolist()
    ('areas', ['ring 0'], [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    """
    path = as_path(path)
    suffix = path.suffix.lower()
    known = (".geojson", ".json", ".svg", ".npz", *MESH_SUFFIXES, *PICTURES)
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
        if suffix in PICTURES:
            return "rings", (picture_rings(path, level, smooth, invert),)
        if suffix == ".svg":
            return "drawing", (svg_areas(path, tolerance, stroke),)
        return "areas", (geojson_areas(path),)
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
