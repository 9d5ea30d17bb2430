"""Samples added where a boundary is too coarse for the width of its shape (section 2.1).

A skeleton from few samples is no approximation: between two parallel sides with corners only, the balls
through the corners are as large as the sides are long. What the density has to follow is the local width: the
radius of the largest ball inside the shape that touches the boundary at a point.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..checks import MOST_POINTS
from ..errors import InputError
from ..exact import locate, nearest_facets, nearest_on_facets
from ..graphs import delaunay, grown_from, moved_back, preferring
from ..progress import Progress
from .splitting import split_edges

#: Samples are at most this share of the local width apart: then a ball through them is at most 1 % too large.
SHARE = 1 / 4
#: The least width that is followed into corners, as a share of the largest one, by dimension. In the plane a
#: corner costs the logarithm of it, in space an edge costs its inverse.
FLOOR = {2: 1 / 200, 3: 1 / 4}
#: Where corners would need more vertices than this, the floor is raised, by dimension; and so many more for
#: each vertex given.
MOST, EACH = {2: 3_000, 3: 8_000}, {2: 10, 3: 2}
#: The same for all samples, so that it takes seconds. Shapes that are thinner than that are told.
LIMIT = {2: 60_000, 3: 30_000}
# Of the coordinates: below it, floats leave no room for samples in a corner.
_FINEST = 1e-12
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
    boundary = np.asarray(boundary, dtype=np.float64)
    radius = np.full(len(places), float(np.ptp(boundary, axis=(0, 1)).max()))
    corners = boundary.reshape(-1, boundary.shape[1])
    tree = cKDTree(corners)

    def through(point, x, n):
        """Radius of the ball that touches at x and goes through another point."""
        way = point - x
        depth = (way * n).sum(axis=1)
        return np.where(depth > 0, (way**2).sum(axis=1), np.inf) / np.where(depth > 0, 2 * depth, 1)

    # Large balls have many facets near their surface, but one nearest corner: these shrink them first.
    def by_corners(x, n, r):
        distance, corner = tree.query(x + r[:, None] * n)
        return distance, through(corners[corner], x, n)

    def by_facets(x, n, r):
        distance, facet = nearest_facets(boundary, x + r[:, None] * n)
        facet = boundary[facet]
        smaller = through(nearest_on_facets(x + r[:, None] * n, facet), x, n)
        # The ball that touches its plane is the last one at once, if it touches inside the facet.
        m = inner_normals(facet)
        with np.errstate(divide="ignore", invalid="ignore"):
            last = ((x - facet[:, 0]) * m).sum(axis=1) / (1 - (m * n).sum(axis=1))
        last = np.where((last > 0) & (last < smaller), last, np.minimum(smaller, r))
        return distance, np.minimum(smaller, through(nearest_on_facets(x + last[:, None] * n, facet), x, n))

    for shrunk in (by_corners, by_facets):
        active = np.arange(len(places))
        while len(active):
            r = radius[active]
            distance, smaller = shrunk(places[active], normals[active], r)
            shrinks = (distance < r * (1 - _TOUCH)) & (smaller < r * (1 - _TOUCH))
            active = active[shrinks]
            radius[active] = smaller[shrinks]
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
    exponent = int(np.frexp(np.abs(points).max())[1])
    if abs(exponent) <= 200:
        return _densified(points, facets, spacing, floor)
    # In a unit in which squares of lengths are ordinary floats; a power of two changes no digit.
    spacing, floor = (
        None if value is None else float(np.ldexp(value, -exponent)) for value in (spacing, floor)
    )
    small = np.ldexp(points, -exponent)
    more, facets, tessellation = _densified(small, facets, spacing, floor, exponent)
    back = None if tessellation is None else moved_back(tessellation, exponent, points)
    if back is not None:
        return back.points, facets, back
    return np.concatenate([points, np.ldexp(more[len(points) :], exponent)]), facets, None


def _densified(points, facets, spacing, floor, exponent=0):
    boundary = points[facets]
    if spacing is not None:
        _check_count(boundary, spacing, exponent)
        return *_refined(points, facets, spacing), None
    rule = _Rule(boundary, len(points), floor, exponent)
    points, facets = _refined(points, facets, None, rule)
    if points.shape[1] == 3:
        return points, facets, None
    # What is narrow between the places is shown by the balls of the samples.
    tessellation, growing = delaunay(points), None
    with Progress("densify, samples between", rule.limit) as progress:
        while len(coarse := _coarse(boundary, tessellation, facets, rule.least)):
            more, facets, cut = _cut_segments(points, facets, coarse, np.full(len(coarse), 2))
            if not len(cut):
                break  # floats leave no room
            growing = growing or grown_from(tessellation)
            growing.add(more[len(points) :])
            points, tessellation = more, growing.tessellation()
            progress.at(len(points))
    return points, facets, preferring(tessellation, facets)


def _check_count(boundary, spacing, exponent) -> None:
    """Raise `InputError` where the spacing asks for more vertices than a tessellation can have."""
    u = boundary[:, 1:] - boundary[:, :1]
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        if boundary.shape[1] == 2:
            count = (np.linalg.norm(u[:, 0], axis=1) / spacing).sum()
        else:  # two triangles to a vertex, none larger than the equilateral one
            area = np.linalg.norm(np.cross(u[:, 0] / spacing, u[:, 1] / spacing), axis=1).sum() / 2
            count = area / (3**0.5 / 4) / 2
    if not count < MOST_POINTS:
        raise InputError(
            f"spacing is {np.ldexp(spacing, exponent):g}, which takes more than {MOST_POINTS:,} vertices; "
            "pass a larger one."
        )


class _Rule:
    """How close samples have to be for the width, and the least width that is followed."""

    def __init__(self, boundary: np.ndarray, n: int, floor: float | None, exponent: int):
        dimension = boundary.shape[1]
        self.boundary, self.floor, self.exponent = boundary, floor, exponent
        self.most, self.limit = (each[dimension] + EACH[dimension] * n for each in (MOST, LIMIT))
        self.largest = self.widths(boundary).max()
        self.least = FLOOR[dimension] * self.largest if floor is None else floor
        finest = _FINEST * np.abs(boundary).max()
        if floor is not None and floor < finest:
            self._refuse("is below the rounding of the coordinates", finest)

    def widths(self, pieces: np.ndarray) -> np.ndarray:
        """The local width at some places of each piece."""
        places = _PLACES[pieces.shape[1]] @ pieces
        normals = np.repeat(inner_normals(pieces), places.shape[1], axis=0)
        return local_width(self.boundary, places.reshape(len(normals), -1), normals).reshape(len(pieces), -1)

    def settle(self, n: int, longest: np.ndarray, widths: np.ndarray) -> None:
        """Raise the floor, or refuse it, where pieces of these lengths and widths make too many samples."""
        if n < (self.most / 4 if self.floor is None else self.limit / 8):
            return  # the pieces are too long to tell

        def wanted():
            times = longest[:, None] / (SHARE * np.maximum(widths, self.least))
            return n + (times**2 / 1.4 if widths.shape[1] == 4 else times).mean(axis=1).sum()

        def fit(most, highest=np.inf):
            while self.least < highest and wanted() > most:
                self.least *= 2

        if self.floor is None:
            fit(self.most, self.largest)  # corners are given up first
            # What is far too thin everywhere stays wrong with more samples, too.
            fit(self.limit if wanted() < 10 * self.limit else self.most)
            return
        fit(self.limit)
        if self.least > self.floor:
            self._refuse(f"takes more than {self.limit:,} vertices", self.least)

    def _refuse(self, why, least):
        floor, least = np.ldexp([self.floor, least], self.exponent)
        raise InputError(f"floor is {floor:g}, which {why}; pass {least:.1g} or more, or a spacing.")


def _refined(points, facets, spacing, rule=None):
    """Cut facets longer than the spacing, or than the rule says, until none is."""
    fresh, widths = np.arange(len(facets)), np.full((len(facets), len(_PLACES[points.shape[1]])), np.nan)
    limit = rule.limit if rule else MOST_POINTS
    with Progress(f"densify, of {limit:,} samples at most", limit) as progress:
        while len(fresh):
            progress.at(len(points))
            pieces = points[facets[fresh]]
            sides = np.linalg.norm(np.roll(pieces, -1, axis=1) - pieces, axis=2)
            longest = sides.max(axis=1)
            if rule is not None:
                # What is short enough for the least width need not know its own.
                new = np.isnan(widths[fresh, 0]) & (longest > SHARE * rule.least)
                if new.any():
                    widths[fresh[new]] = rule.widths(pieces[new])
                width = np.nan_to_num(widths[fresh])
                rule.settle(len(points), longest, width)
                spacing = SHARE * np.maximum(width.min(axis=1), rule.least)
            times = longest / spacing
            rows = times > 1 + 1e-9
            coarse, times, sides = fresh[rows], times[rows], sides[rows]
            if points.shape[1] == 3:
                before = facets
                points, facets, fresh = _cut_triangles(points, facets, coarse, sides.argmax(axis=1))
                widths[(facets[: len(before)] != before).any(axis=1)] = np.nan
            elif rule is not None:
                points, facets, fresh = _cut_segments(points, facets, coarse, np.full(len(coarse), 2))
                widths[:] = np.nan
            else:
                return _cut_segments(points, facets, coarse, np.ceil(times - 1e-9).astype(int))[:2]
            more = np.full((len(facets) - len(widths), widths.shape[1]), np.nan)
            widths = np.concatenate([widths, more])
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
