"""Samples added where a boundary is too coarse for the width of its shape (section 2.1).

A skeleton from few samples is no approximation: between two parallel sides with corners only, the balls
through the corners are as large as the sides are long. What the density has to follow is the local width: the
radius of the largest ball inside the shape that touches the boundary at a point.
"""

from __future__ import annotations

import numpy as np

from ..checks import MOST_POINTS
from ..errors import InputError
from ..exact import locate, nearest_facets, nearest_on_facets
from ..graphs import delaunay, grown_from, preferring
from .splitting import split_edges

#: Samples are at most this share of the local width apart: then a ball through them is at most 1 % too large.
SHARE = 1 / 4
#: The least width that is followed into corners, as a share of the largest one, by dimension. In the plane a
#: corner costs the logarithm of it, in space an edge costs its inverse.
FLOOR = {2: 1 / 200, 3: 1 / 4}
#: Where more vertices than this, and ten for each one given, would be needed, the floor is raised.
MOST = 3_000
# How far a ball may be from touching before it counts as touching.
_TOUCH = 1e-9
# Where on a facet its width is measured, in shares of its corners.
_PLACES = {
    2: np.array([(5, 1), (3, 3), (1, 5)]) / 6,
    3: np.array([(4, 1, 1), (1, 4, 1), (1, 1, 4), (2, 2, 2)]) / 6,
}


def inner_normals(facets: np.ndarray) -> np.ndarray:
    """Unit normals of boundary facets (m, N, N) that point into the shape, (m, N).

    Examples
    --------
    >>> inner_normals(np.array([[[0, 0], [0, 2]]])).tolist()
    [[-1.0, 0.0]]
    """
    u = facets[:, 1] - facets[:, 0]
    if facets.shape[1] == 2:
        normal = np.stack([-u[:, 1], u[:, 0]], axis=1)
    else:
        normal = np.cross(facets[:, 2] - facets[:, 0], u)
    return normal / np.linalg.norm(normal, axis=1, keepdims=True)


def local_width(boundary: np.ndarray, places: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Radius of the largest ball that touches a boundary at given places, from inside.

    Parameters
    ----------
    boundary : (m, N, N) float array
        All facets.
    places : (k, N) float array
        Points of the boundary.
    normals : (k, N) float array
        Unit vectors into the shape.

    Returns
    -------
    (k,) float array

    Notes
    -----
    Shrinking balls: a ball that is too large has a nearest boundary point; the next one goes through that.

    References
    ----------
    Ma, Bae and Choi, 3D medial axis point approximation using nearest neighbors and the normal field, 2012.

    Examples
    --------
    >>> from polyskel_lite import Shape
    >>> rectangle = Shape.from_rings([[(0, 0), (20, 0), (20, 4), (0, 4)]])
    >>> up = np.array([[0.0, 1], [0, 1]])
    >>> local_width(rectangle.segments, np.array([[10.0, 0], [1, 0]]), up).round(9).tolist()
    [2.0, 1.0]
    """
    radius = np.full(len(places), float(np.ptp(boundary, axis=(0, 1)).max()))
    active = np.arange(len(places))
    while len(active):
        x, n, r = places[active], normals[active], radius[active]
        center = x + r[:, None] * n
        distance, facet = nearest_facets(boundary, center)
        way = nearest_on_facets(center, boundary[facet]) - x
        depth = (way * n).sum(axis=1)
        shrinks = (distance < r * (1 - _TOUCH)) & (depth > 0)
        smaller = (way[shrinks] ** 2).sum(axis=1) / (2 * depth[shrinks])
        radius[active[shrinks]] = np.minimum(smaller, r[shrinks])
        active = active[shrinks][smaller < r[shrinks] * (1 - _TOUCH)]
    return radius


def densified(points: np.ndarray, facets: np.ndarray, spacing: float | None, floor: float | None):
    """Points and facets of the same boundary with more samples, and their tessellation if it was needed.

    The given ones come first; see `Shape.densify`.

    Examples
    --------
    >>> square = np.array([(0.0, 0), (2, 0), (2, 2), (0, 2)])
    >>> len(densified(square, np.array([(0, 1), (1, 2), (2, 3), (3, 0)]), 0.5, None)[0])
    16
    """
    if spacing is not None:
        _check_count(points[facets], spacing)
        return *_refined(points, facets, None, lambda _, __: spacing, parts=None), None
    boundary = points[facets]
    widths = _widths(boundary, boundary)
    most = MOST + 10 * len(points)
    least = FLOOR[points.shape[1]] * widths.max() if floor is None else floor

    def wanted(widths, count):
        nonlocal least, most
        # Needles: the sharper a corner, the more samples for each halving of the width.
        if count > most:
            least, most = 4 * least, most + MOST
        return SHARE * np.maximum(widths, least)

    points, facets = _refined(points, facets, boundary, wanted, parts=2)
    if points.shape[1] == 3:
        return points, facets, None
    # What is narrow between the places is shown by the balls of the samples.
    tessellation, growing = delaunay(points), None
    while len(coarse := _coarse(boundary, tessellation, facets, least)):
        more, facets, cut = _cut_segments(points, facets, coarse, np.full(len(coarse), 2))
        if not len(cut):
            break  # floats leave no room
        growing = growing or grown_from(tessellation)
        growing.add(more[len(points) :])
        points, tessellation = more, growing.tessellation()
    return points, facets, preferring(tessellation, facets)


def _check_count(boundary, spacing) -> None:
    """Raise `InputError` where the spacing asks for more vertices than a tessellation can have."""
    u = boundary[:, 1:] - boundary[:, :1]
    with np.errstate(over="ignore", invalid="ignore"):
        if boundary.shape[1] == 2:
            count = (np.linalg.norm(u[:, 0], axis=1) / spacing).sum()
        else:  # two triangles to a vertex, none larger than the equilateral one
            area = np.linalg.norm(np.cross(u[:, 0] / spacing, u[:, 1] / spacing), axis=1).sum() / 2
            count = area / (3**0.5 / 4) / 2
    if not count < MOST_POINTS:
        raise InputError(
            f"spacing is {spacing:g}, which takes more than {MOST_POINTS:,} vertices; pass a larger one."
        )


def _widths(boundary, pieces) -> np.ndarray:
    """The local width at some places of each piece."""
    places = _PLACES[pieces.shape[1]] @ pieces
    normals = np.repeat(inner_normals(pieces), places.shape[1], axis=0)
    return local_width(boundary, places.reshape(len(normals), -1), normals).reshape(len(pieces), -1)


def _refined(points, facets, boundary, wanted, parts):
    """Cut facets longer than wanted, into `parts` or as many as that takes, until none is."""
    fresh, widths = np.arange(len(facets)), np.full(len(facets), np.nan)
    while len(fresh):
        pieces = points[facets[fresh]]
        sides = np.linalg.norm(np.roll(pieces, -1, axis=1) - pieces, axis=2)
        longest = sides.max(axis=1)
        # What is short enough for the least width need not know its own.
        new = np.isnan(widths[fresh]) & (longest > wanted(0.0, len(points)))
        if boundary is not None and new.any():
            widths[fresh[new]] = _widths(boundary, pieces[new]).min(axis=1)
        times = longest / wanted(np.nan_to_num(widths[fresh]), len(points))
        rows = times > 1 + 1e-9
        coarse, times, sides = fresh[rows], times[rows], sides[rows]
        if points.shape[1] == 3:
            before = facets
            points, facets, fresh = _cut_triangles(points, facets, coarse, sides.argmax(axis=1))
            widths[(facets[: len(before)] != before).any(axis=1)] = np.nan
        elif parts:
            points, facets, fresh = _cut_segments(points, facets, coarse, np.full(len(coarse), parts))
            widths[:] = np.nan
        else:
            return _cut_segments(points, facets, coarse, np.ceil(times - 1e-9).astype(int))[:2]
        widths = np.append(widths, np.full(len(facets) - len(widths), np.nan))
    return points, facets


def _coarse(boundary, tessellation, facets, floor) -> np.ndarray:
    """Segments too long for a ball of the samples that they touch, or that reaches across them."""
    pieces = tessellation.points[facets]
    centers = tessellation.circumcenters
    centers = centers[np.isfinite(centers).all(axis=1)]
    centers = centers[locate(boundary, centers) > 0]
    distance, piece = nearest_facets(pieces, centers)
    length = np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=1)[piece]
    return np.unique(piece[(distance > floor) & (length > SHARE * distance * (1 + 1e-9))])


def _cut_segments(points, facets, rows, count):
    """Cut segments into equal parts; those that were cut, and the new ones."""
    a, b = facets[rows].T
    extra = count - 1
    row = np.repeat(np.arange(len(rows)), extra)
    step = np.arange(len(row)) - np.repeat(np.cumsum(extra) - extra, extra) + 1
    share = (step / count[row])[:, None]
    new = points[a[row]] * (1 - share) + points[b[row]] * share
    _, place, times = np.unique(
        np.concatenate([points, new]), axis=0, return_inverse=True, return_counts=True
    )
    whole = np.isin(
        np.arange(len(rows)), row[times[place.ravel()[len(points) :]] > 1]
    )  # floats leave no room
    kept = ~whole[row]
    row, step, new = row[kept], step[kept], new[kept]
    number = len(points) + np.arange(len(row))
    last = step == extra[row]
    ends = np.where(last, b[row], number + 1)
    facets = facets.copy()
    facets[rows[row[step == 1]], 1] = number[step == 1]
    added = np.column_stack([number, ends])
    fresh = np.concatenate([rows[~whole], len(facets) + np.arange(len(added))])
    return np.concatenate([points, new]), np.concatenate([facets, added]), fresh


def _cut_triangles(points, facets, rows, longest):
    """Halve the longest side of triangles, one a triangle; those that changed or wait, and the new ones."""
    if not len(rows):
        return points, facets, rows
    edges = np.stack([facets[rows, longest], facets[rows, (longest + 1) % 3]], axis=1)
    more, cut = split_edges(points, facets, edges)
    if len(cut) == len(facets):  # floats leave no room
        return points, facets, rows[:0]
    changed = np.flatnonzero((cut[: len(facets)] != facets).any(axis=1))
    return more, cut, np.union1d(np.union1d(changed, rows), np.arange(len(facets), len(cut)))
