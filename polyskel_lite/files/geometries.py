"""Outlines and lines in the plane to files that maps and drawing programs read: GeoJSON, WKT and SVG."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from ..checks import library
from .meshes import writing

#: Behind the point, in WKT: enough for every float; GEOS leaves out those that say nothing.
_DIGITS = 330


def write_geometry(path: Path, content: dict[str, Any]) -> None:
    """Write a GeoJSON object to a file; the suffix says how. All digits are kept.

    Parameters
    ----------
    path : path
        In .geojson, .json, .wkt or .svg; the last two need shapely.
    content : dict
        A (multi-) polygon, line or point, or a FeatureCollection of these; WKT and SVG have no properties.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "line.wkt"
    ...     write_geometry(file, {"type": "LineString", "coordinates": [[0.5, 0.0], [1.0, 2.0]]})
    ...     print(file.read_text())
    LINESTRING (0.5 0, 1 2)
    """
    how = {".wkt": as_wkt, ".svg": as_svg}.get(path.suffix.lower(), json.dumps)
    with writing(path) as place:
        place.write_text(how(content) + "\n", encoding="utf-8")


def as_wkt(content: dict[str, Any]) -> str:
    """Well-known text: one geometry, or a collection where there are points besides lines.

    Examples
    --------
    >>> as_wkt({"type": "MultiPoint", "coordinates": [[0.5, 0.0], [1.0, 2.0]]})
    'MULTIPOINT ((0.5 0), (1 2))'
    """
    return library("shapely").to_wkt(_geometry(content), rounding_precision=_DIGITS)


def as_svg(content: dict[str, Any]) -> str:
    """A drawing, in the unit of the coordinates; its y axis runs downward, so that up stays up.

    Examples
    --------
    >>> print(as_svg({"type": "LineString", "coordinates": [[0.5, 0.0], [1.0, 2.0]]}))  # doctest: +ELLIPSIS
    <svg xmlns="http://www.w3.org/2000/svg" viewBox="0.46 -2.04 0.58 2.08"><g transform="scale(1,-1)">
    <polyline fill="none" stroke="#66cc99" stroke-width="0.01" points="0.5,0.0 1.0,2.0" opacity="0.8" />
    </g></svg>
    """
    geometry = _geometry(content)
    west, south, east, north = (0, 0, 1, 1) if geometry.is_empty else geometry.bounds
    size = max(east - west, north - south) or 1.0
    box = west - size / 50, -north - size / 50, east - west + size / 25, north - south + size / 25
    frame = " ".join(f"{x:.12g}" for x in box)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{frame}"><g transform="scale(1,-1)">\n'
        f"{geometry.svg(scale_factor=size / 400)}\n</g></svg>"
    )


def _geometry(content: dict[str, Any]):
    """The same for shapely, which knows no features: lines alone are one geometry, others a collection."""
    shapely = library("shapely")
    if content["type"] != "FeatureCollection":
        return shapely.geometry.shape(content)
    parts = [shapely.geometry.shape(feature["geometry"]) for feature in content["features"]]
    lines = {part.geom_type for part in parts} == {"LineString"}
    return shapely.multilinestrings(parts) if lines else shapely.geometrycollections(parts)
