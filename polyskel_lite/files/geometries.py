"""Outlines and lines in the plane to files that maps and drawing programs read: GeoJSON, WKT and SVG."""

from __future__ import annotations

import json
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from .meshes import writing

# What SVG says of an area, a line and a point; a line of no length has a round end on both sides.
_LOOK = {
    "Polygon": 'fill="#c9d3da" fill-rule="evenodd" stroke="none"',
    "LineString": 'fill="none" stroke="#1f4e79" stroke-width="{width:g}" stroke-linecap="round"',
    "Point": 'fill="none" stroke="#1f4e79" stroke-width="{width:g}" stroke-linecap="round"',
}


def write_geometry(path: Path, content: dict[str, Any]) -> None:
    """Write a GeoJSON object to a file; the suffix says how. All digits are kept.

    Parameters
    ----------
    path : path
        In .geojson, .json, .wkt or .svg.
    content : dict
        A (multi-) polygon, line or point, or a FeatureCollection of these; WKT and SVG have no properties.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "line.wkt"
    ...     write_geometry(file, {"type": "LineString", "coordinates": [[0.5, 0.0], [1.0, 2.0]]})
    ...     print(file.read_text())
    LINESTRING (0.5 0.0, 1.0 2.0)
    """
    how = {".wkt": as_wkt, ".svg": as_svg}.get(path.suffix.lower(), json.dumps)
    with writing(path) as place:
        place.write_text(how(content) + "\n", encoding="utf-8")


def as_wkt(content: dict[str, Any]) -> str:
    """Well-known text: one geometry, or a collection where there are points besides lines.

    Examples
    --------
    >>> as_wkt({"type": "MultiPoint", "coordinates": [[0.5, 0.0], [1.0, 2.0]]})
    'MULTIPOINT (0.5 0.0, 1.0 2.0)'
    """

    def words(x) -> str:
        return "(" + ", ".join(map(words, x)) + ")" if np.ndim(x[0]) else f"{x[0]!r} {x[1]!r}"

    said = []
    for kind, group in groupby(sorted(_parts(content), key=lambda part: part[0]), lambda part: part[0]):
        parts = [x for _, x in group]
        one = len(parts) == 1 and kind != "Point"
        said.append(f"{'' if one else 'MULTI'}{kind.upper()} {words(parts[0] if one else parts)}")
    return (
        said[0]
        if len(said) == 1
        else f"GEOMETRYCOLLECTION {'(' + ', '.join(said) + ')' if said else 'EMPTY'}"
    )


def as_svg(content: dict[str, Any]) -> str:
    """A drawing, in the unit of the coordinates; its y axis runs downward, so that up stays up.

    Examples
    --------
    >>> print(as_svg({"type": "LineString", "coordinates": [[0.5, 0.0], [1.0, 2.0]]}))
    <svg xmlns="http://www.w3.org/2000/svg" viewBox="0.46 -2.04 0.58 2.08">
    <path d="M0.5,-0.0 L1.0,-2.0" fill="none" stroke="#1f4e79" stroke-width="0.01" stroke-linecap="round"/>
    </svg>
    """
    parts = list(_parts(content))
    lines = [(kind, rings if kind == "Polygon" else [np.atleast_2d(rings)]) for kind, rings in parts]
    points = np.concatenate([np.zeros((0, 2)), *(np.array(line) for _, some in lines for line in some)])
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else (np.zeros(2), np.ones(2))
    size = float((high - low).max()) or 1.0
    (x, y), (w, h) = (low[0], -high[1]) - np.full(2, 0.02 * size), high - low + 0.04 * size
    text = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{x:.12g} {y:.12g} {w:.12g} {h:.12g}">']
    for kind, some in lines:
        d = " ".join(_pen(np.asarray(line).tolist(), kind == "Polygon") for line in some)
        text.append(f'<path d="{d}" {_LOOK[kind].format(width=size / 200)}/>')
    return "\n".join([*text, "</svg>"])


def _pen(line: list[list[float]], closed: bool) -> str:
    places = [f"{x!r},{-y!r}" for x, y in line]
    return f"M{' L'.join(places[:-1])} Z" if closed else f"M{' L'.join(places if places[1:] else 2 * places)}"


def _parts(content: dict[str, Any]) -> Iterator[tuple[str, list]]:
    """The single areas, lines and points of a GeoJSON object, each with its kind."""
    kind = content["type"]
    if kind == "FeatureCollection":
        for feature in content["features"]:
            yield from _parts(feature["geometry"])
    elif kind.startswith("Multi"):
        yield from ((kind[5:], part) for part in content["coordinates"])
    else:
        yield kind, content["coordinates"]
