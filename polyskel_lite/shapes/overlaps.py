"""Rings that cross, touch or run there and back made into outlines of what they enclose, by shapely."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from scipy.spatial import cKDTree

from ..checks import as_number, library
from ..errors import InputError
from ..exact import locate, spread_out
from ..files import Area
from .rings import check_meetings, may_surround, ring_facets, turn_of

#: What is merged by default, as a share of the size; and how wide pinches are opened.
TOLERANCE, WIDTH = 1e-6, 1e-4
# What is cut off at a pinch: no side or corner of it is in a direction in which drawings have theirs.
_CUT = np.exp(1j * (0.4 + np.arange(8) * np.pi / 4)).view(float).reshape(8, 2) / 2
# A narrow tip can touch again beside the cut, but not often, and not beside a larger one.
_OPENINGS = 8


def shown_rings(areas: Sequence[Area]) -> tuple[list, list[str]]:
    """The rings, with their names, that bound the union of some areas, which do not meet each other.

    Parameters
    ----------
    areas : sequence of Area

    Returns
    -------
    rings, names : list
        Those with what is shown on one side only; rings inside rings are holes (even-odd).

    Raises
    ------
    ShapeError
        If a ring would go, but meets another one.

    Examples
    --------
    >>> square = np.array([(0, 0), (3, 0), (3, 3), (0, 3)], dtype=float)
    >>> both = [square, square / 3 + 1]
    >>> [shown_rings([Area(both, ["a", "b"], rule)])[1] for rule in ("evenodd", "nonzero")]
    [['a', 'b'], ['a']]
    """
    rings = [ring for area in areas for ring in area.rings]
    names = [name for area in areas for name in area.names]
    owner = [k for k, area in enumerate(areas) for _ in area.rings]
    turn = [turn_of(ring) for ring in rings]
    around: list[list[int]] = [[] for _ in rings]
    first = np.array([ring[0] for ring in rings])
    for k in np.flatnonzero(may_surround(rings, first)).tolist():
        ring = rings[k]
        near = np.flatnonzero(((first >= ring.min(axis=0)) & (first <= ring.max(axis=0))).all(axis=1))
        inside = locate(np.stack([ring, np.roll(ring, -1, axis=0)], axis=1), first[near]) > 0
        for inner in near[inside].tolist():
            around[inner].append(k)

    def shown(inside: list[int]) -> bool:
        winding: dict[int, int] = {}
        for k in inside:
            step = turn[k] if areas[owner[k]].rule == "nonzero" else 1
            winding[owner[k]] = winding.get(owner[k], 0) + step
        return any(n != 0 if areas[k].rule == "nonzero" else n % 2 for k, n in winding.items())

    kept = [k for k in range(len(rings)) if shown(around[k]) != shown([*around[k], k])]
    if len(kept) < len(rings):
        of, number = spread_out(np.array([*map(len, rings)]))
        facets = ring_facets([*map(len, rings)])
        check_meetings(np.concatenate(rings), facets, lambda vertex: (names[of[vertex]], int(number[vertex])))
    return [rings[k] for k in kept], [names[k] for k in kept]


def mended_rings(
    areas: Sequence[Area],
    tolerance: float | None = None,
    width: float | None = 0.0,
    largest: bool = False,
    least: float = 0.0,
) -> tuple[list[np.ndarray], list[str], dict[str, int]]:
    """Outlines of the union of areas, and what was done; see `polyskel_lite.mend`.

    A vertex that stays is the one given, to the last bit; a new one is on a grid of the tolerance.

    Examples
    --------
    >>> square = np.array([(0, 0), (2, 0), (2, 2), (0, 2)], dtype=float)
    >>> areas = [Area([square + k], [f"square {k}"], "nonzero") for k in (0, 1)]
    >>> rings, names, report = mended_rings(areas)
    >>> len(rings[0]), report
    (8, {'rings': 2, 'outlines': 1})
    """
    shapely = library("shapely", "mending", "mend")
    every = list(_with_clips(areas))
    given = np.concatenate([ring for area in every for ring in area.rings])
    owner = [name for area in every for name, ring in zip(area.names, area.rings, strict=True) for _ in ring]
    size = float(np.hypot(*np.ptp(given, axis=0)))
    width = _length(width, "width", WIDTH, size)
    least = as_number(least, "least", "an area", 0)
    report = {"rings": sum(len(area.rings) for area in areas)}
    finest = _length(tolerance, "tolerance", TOLERANCE, size)
    for grid in (finest,) if tolerance else (finest, 10 * finest, 100 * finest):
        regions = [_region(shapely, area, grid) for area in areas]
        whole = shapely.set_precision(shapely.union_all(regions, grid_size=grid), grid)
        whole, opened, left = _opened(shapely, whole, grid, width)
        if not (left and width):  # else there is a seam, narrower than the cuts and wider than the grid
            break
    merged = len(np.unique(given, axis=0)) - len(np.unique(np.round(given / grid), axis=0))
    report |= {"vertices merged": merged, "pinches opened": opened}
    parts = shapely.get_parts(whole)
    parts = parts[shapely.area(parts) > 0]
    area = shapely.area(parts)
    kept = parts[area == area.max()][:1] if largest and len(parts) else parts[area >= least]
    report["parts left out"] = len(parts) - len(kept)
    if not len(kept):
        raise InputError(f"nothing that is left is wider than {grid:.3g}; lower tolerance or least.")
    outlines = [shapely.get_coordinates(ring)[:-1] for ring in shapely.get_rings(kept)]
    report["outlines"] = len(outlines)
    rings, names = _given_back(outlines, given, owner, grid)
    return rings, names, {what: count for what, count in report.items() if count}


def _with_clips(areas) -> Iterator[Area]:
    for area in areas:
        yield area
        for clip in area.clips:
            yield from _with_clips(clip)


def _opened(shapely, whole, grid: float, width: float) -> tuple:
    """The region cut where it touches itself; how often that was, and how often it still is."""
    opened = 0
    for step in range(_OPENINGS):
        pinches = _pinches(shapely, whole, grid)
        if not (len(pinches) and width):
            break
        opened += len(pinches)
        cut = shapely.union_all(shapely.polygons(pinches[:, None] + 1.5**step * width * _CUT))
        whole = shapely.difference(whole, cut, grid_size=grid)
    return whole, opened, len(pinches)


def _length(value, name: str, share: float, size: float) -> float:
    if value is not None:
        return as_number(value, name, "a length, in units of the vertices", 0, above=name == "tolerance")
    return 10.0 ** np.floor(np.log10(share * size)) if size else 1.0  # decimal coordinates are on such a grid


def _region(shapely, area: Area, grid: float):
    """What an area covers, its clips applied."""
    if area.rule == "nested":
        return _nested(shapely, area.rings, grid)
    if area.rule == "first":
        first, *rest = (_filled(shapely, [ring], "nonzero", grid) for ring in area.rings)
        region = shapely.difference(first, shapely.union_all(rest), grid_size=grid) if rest else first
    else:
        region = _filled(shapely, area.rings, area.rule, grid)
    for clip in area.clips:
        inside = shapely.union_all([_region(shapely, part, grid) for part in clip], grid_size=grid)
        region = shapely.intersection(region, inside, grid_size=grid)
    return region


def _nested(shapely, rings: list, grid: float):
    """What rings cover if one inside another is a hole, and those that cross are united."""
    parts = np.array([_filled(shapely, [ring], "nonzero", grid) for ring in rings])
    wide = shapely.buffer(parts, grid, join_style="mitre")  # or a hole that touches would count as crossing
    inner, outer = shapely.STRtree(wide).query(parts, predicate="covered_by")
    area = shapely.area(parts)
    depth = np.bincount(inner[area[inner] < area[outer] - grid**2], minlength=len(parts))
    whole = shapely.Polygon()
    for level in range(depth.max() + 1):
        layer = shapely.union_all(parts[depth == level], grid_size=grid)
        whole = (shapely.difference if level % 2 else shapely.union)(whole, layer, grid_size=grid)
    return whole


def _filled(shapely, rings: list, rule: str, grid: float):
    if len(rings) == 1 and (simple := shapely.Polygon(rings[0])).is_valid:
        return simple
    lines = shapely.union_all([shapely.LinearRing(ring) for ring in rings], grid_size=grid)
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(lines)))
    if not len(faces):
        return shapely.Polygon()
    within = shapely.get_coordinates(shapely.point_on_surface(faces))
    winding = sum(_winding(ring, within) for ring in rings)
    return shapely.union_all(faces[winding != 0 if rule == "nonzero" else winding % 2 == 1], grid_size=grid)


def _winding(ring: np.ndarray, queries: np.ndarray) -> np.ndarray:
    """How often a ring runs around each query, which is not on it."""
    turns = []
    for query in queries:
        seen = (ring - query) @ (1, 1j)
        turns.append(np.angle(np.roll(seen, -1) / seen).sum() / (2 * np.pi))
    return np.rint(turns).astype(int)


def _pinches(shapely, whole, grid: float) -> np.ndarray:
    """Where the boundary of a region touches itself, (k, 2)."""
    lines = shapely.get_parts(shapely.union_all([shapely.boundary(whole)], grid_size=grid))
    ends = shapely.get_coordinates([shapely.get_point(lines, 0), shapely.get_point(lines, -1)])
    places, count = np.unique(ends, axis=0, return_counts=True)
    return places[count > 2]


def _given_back(outlines, given, owner, grid) -> tuple[list[np.ndarray], list[str]]:
    """The outlines with the vertices that were given where these have only been moved to the grid."""
    far, index = cKDTree(given).query(np.concatenate(outlines))
    nearest = np.full(len(given), 0.7072 * grid)  # half the diagonal of a cell of the grid
    np.minimum.at(nearest, index, far)
    same = (far == nearest[index])[:, None]
    first = np.cumsum([0, *map(len, outlines)])
    rings, names = [], []
    for k, ring in enumerate(outlines):
        here = slice(first[k], first[k + 1])
        names.append(owner[index[here][far[here].argmin()]])
        rings.append(np.where(same[here], given[index[here]], ring))
    return rings, names
