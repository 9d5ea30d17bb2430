"""Polygons of GeoJSON, by the standard library."""

from __future__ import annotations

import json
import warnings
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..checks import as_floats
from ..errors import InputError, LeftOutWarning
from .areas import Area, distinct


def geojson_areas(path: Path) -> list[Area]:
    """All polygons of a GeoJSON file, each one area; points and lines are counted in a warning.

    Examples
    --------
    >>> import tempfile
    >>> square = {"type": "Polygon", "coordinates": [[[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]]]}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "square.geojson"
    ...     _ = file.write_text(json.dumps(square))
    ...     geojson_areas(file)[0].rings[0].tolist()
    [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8-sig"))
    except (ValueError, RecursionError) as error:
        raise InputError(f"this is not JSON ({error}); save it again as GeoJSON.") from None
    skipped: Counter[str] = Counter()
    found = list(_polygons(content, "", skipped))
    left = ", ".join(f"{count} {kind}{'s' * (count > 1)}" for kind, count in sorted(skipped.items()))
    if not found:
        raise InputError(
            f"there is no Polygon or MultiPolygon in it{left and f', only {left}'}; save an area, "
            "not an empty collection."
        )
    if left:
        warnings.warn(f"{path.name[:60]}: left out what has no inside: {left}.", LeftOutWarning, stacklevel=5)
    return [
        Area([_position_ring(*ring) for ring in polygon], [where for _, where in polygon], "first")
        for polygon in found
    ]


# What is below a GeoJSON object, and how messages call one of these.
_PARTS = {
    "FeatureCollection": ("features", "feature"),
    "GeometryCollection": ("geometries", "geometry"),
    "Feature": ("geometry", ""),
    "MultiPolygon": ("coordinates", "polygon"),
    "Polygon": ("coordinates", "ring"),
}
_WITHOUT_INSIDE = ("Point", "MultiPoint", "LineString", "MultiLineString")


def _polygons(content, where: str, skipped: Counter) -> Iterator[list[tuple[list, str]]]:
    """All polygons below a GeoJSON object: their rings, each with its place in the file for messages."""
    kind = content.get("type") if isinstance(content, dict) else None
    if isinstance(kind, str) and kind in _WITHOUT_INSIDE:
        skipped[kind] += 1
        return
    if not isinstance(kind, str) or kind not in _PARTS:
        found = f"a {kind[:40]}" if isinstance(kind, str) else "no GeoJSON object"
        raise InputError(
            f"{where or 'the file'} is {found}; only Polygon and MultiPolygon have an inside: take it out."
        )
    name, each = _PARTS[kind]
    part = content.get(name)
    if kind == "Feature":
        if part is not None:  # a feature without a place is legal
            yield from _polygons(part, where, skipped)
        return
    if not isinstance(part, list):
        raise InputError(f"{where or 'the file'}: {name} is not a list; save the file again as GeoJSON.")
    places = [f"{where}, {each} {k}" if where else f"{each} {k}" for k in range(len(part))]
    if kind == "Polygon":
        if part:
            yield list(zip(part, places, strict=True))
        return
    for item, here in zip(part, places, strict=True):
        below = {"type": "Polygon", "coordinates": item} if kind == "MultiPolygon" else item
        yield from _polygons(below, here, skipped)


def _position_ring(positions, where: str) -> np.ndarray:
    is_list = isinstance(positions, list) and all(isinstance(p, list) and len(p) > 1 for p in positions)
    pairs = [position[:2] for position in positions] if is_list else []
    ring = as_floats(pairs, where, "positions [x, y]")
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
