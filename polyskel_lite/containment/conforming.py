"""Which boundary facets are in Del(E) or GG(E), and refining a boundary until all are (sections 3.4, 3.5)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..checks import MOST_POINTS, as_choice, as_instance, as_number, near
from ..errors import DuplicatePointError, InputError, TessellationError
from ..exact import facet_distance, in_gabriel_ball, overlapping_pairs
from ..graphs import (
    OPPOSITE,
    Change,
    Tessellation,
    facet_rows,
    gabriel_mask,
    grown_from,
    moved_back,
    ordinary,
    preferring,
)
from ..shapes import Shape, check_shape, edge_keys
from .conforming_solids import conform_solid

_GRAPHS = ("delaunay", "gabriel")


def missing_facets(
    shape: Shape, of: str = "delaunay", tessellation: Tessellation | None = None
) -> NDArray[np.int64]:
    """The boundary facets that are not in Del(E), or not in GG(E), E being the shape's own vertices; exact.

    Parameters
    ----------
    shape : Shape
    of : "delaunay" or "gabriel"
        The strict (closed ball) Gabriel graph, as Theorems 1 and 2 need it.
    tessellation : Tessellation, optional
        That of ``shape.points``, if it is already there.

    Returns
    -------
    (k,) int array
        Indices into ``shape.facets``; empty when the boundary is contained.

    Examples
    --------
    >>> pair = Shape.from_rings([[(0, 0), (10, 0), (5, 1)], [(5, -1), (4, -3), (6, -3)]])
    >>> missing_facets(pair).tolist(), missing_facets(conform(pair)).tolist()
    ([0], [])
    """
    check_shape(shape)
    as_choice(of, "graph", _GRAPHS)
    if tessellation is None:
        tessellation = shape.tessellation
    as_instance(tessellation, Tessellation, "tessellation", "delaunay(shape.points, shape.facets), or None")
    if not np.array_equal(tessellation.points, shape.points):
        raise InputError("tessellation is not that of the shape's vertices; leave it out.")
    return np.flatnonzero(~_in_graph(tessellation, shape.facets, of))


def _in_graph(tessellation: Tessellation, facets: np.ndarray, of: str) -> np.ndarray:
    rows = facet_rows(tessellation, facets)
    there = rows >= 0
    if of == "gabriel":
        there[there] = gabriel_mask(tessellation, closed=True, rows=rows[there])
    return there


def conform(shape: Shape, to: str | None = None, limit: int | None = None) -> Shape:
    """Add boundary points until every facet is in the strict Gabriel graph, or in the Delaunay tessellation.

    In 3D edges are flipped first, which often suffices; see `polyskel_lite.containment.conforming_solids`.

    Parameters
    ----------
    shape : Shape
    to : "gabriel" or "delaunay", optional
        "gabriel", the default in 2D, makes Theorems 1 and 2 apply. "delaunay" makes Sk0 defined; it is the
        default in 3D, where right triangles in one plane can keep "gabriel" out of reach.
    limit : int, optional
        Give up beyond this many vertices; by default 10,000 and ten times as many as there are (in 3D:
        2,000 and four times as many).

    Returns
    -------
    Shape
        The given vertices first, with their indices and coordinates; the added ones after them.

    Raises
    ------
    TessellationError
        2D: if more than ``limit`` vertices are needed, or if floats are too coarse to halve a segment
        further. It takes a needle: an angle of 1e-3 radians needs 500 vertices, one of 1e-4 needs 7,000.
    ContourContainmentError
        3D: if the limit is reached; ``.missing`` are the faces of the given shape that are not in the graph.

    Notes
    -----
    Halving alone never ends where two sides meet at an acute angle: the halves keep encroaching upon
    each other. There, all sides at the vertex are first cut at one distance from it; the end pieces
    are then Gabriel for good, and the other pieces keep a positive distance, so halving ends.

    References
    ----------
    Ruppert, A Delaunay refinement algorithm for quality 2-dimensional mesh generation, 1995 (the cut
    at one distance from acute corners). Attali and Montanvert 1997, section 3.5.

    Examples
    --------
    >>> acute = Shape.from_rings([[(0, 0), (13, 0), (10 * 3**0.5 / 2, 5)]])
    >>> len(missing_facets(acute, of="gabriel")), len(missing_facets(conform(acute), of="gabriel"))
    (1, 0)
    """
    check_shape(shape)
    if to is None:
        to = "gabriel" if shape.dimension == 2 else "delaunay"
    as_choice(to, "graph", _GRAPHS)
    limit = _limit(limit)
    scaled, exponent = ordinary(shape.tessellation)
    if exponent:  # in a unit in which squares of lengths are ordinary floats
        small = conform(Shape.refined(shape.facets, scaled), to, limit)
        if np.array_equal(small.facets, shape.facets):
            return shape
        back = moved_back(small.tessellation, exponent, shape.points)
        if back is None:
            raise TessellationError("the vertices are among the smallest floats, multiply all by 2**200.")
        return Shape.refined(small.facets, back)
    if shape.dimension == 3:
        return conform_solid(shape, to, limit)
    *_, (last, tessellation) = _stages(shape, to, limit)
    if tessellation is None or len(last.points) == len(shape.points):
        return shape
    return Shape.refined(last.facets, tessellation)


class Stage(NamedTuple):
    """The boundary on its way into a graph: one round of `conform_stages`.

    Attributes
    ----------
    points : (n, 2) float array
        The vertices so far; those of the rounds before come first.
    facets : (m, 2) int array
        The sides so far, oriented.
    missing : (k,) int array
        Rows of ``facets`` that are not in the graph; empty in the last stage.
    corners : (c,) int array
        The acute corners whose two sides are cut at one distance in this round.
    """

    points: np.ndarray
    facets: np.ndarray
    missing: np.ndarray
    corners: np.ndarray

    @property
    def halved(self) -> np.ndarray:
        """Rows of ``facets`` that are halved in this round: the other missing sides."""
        return self.missing[~np.isin(self.facets[self.missing], self.corners).any(axis=1)]


def conform_stages(shape: Shape, to: str = "gabriel", limit: int | None = None) -> Iterator[Stage]:
    """Follow `conform` in the plane round by round, from the given boundary to the last one (section 3.5).

    Parameters
    ----------
    shape : Shape
        In 2D.
    to : "gabriel" or "delaunay"
    limit : int, optional
        As for `conform`.

    Yields
    ------
    Stage
        The first is ``shape`` itself, the last is ``conform(shape, to)``.

    Raises
    ------
    InputError
        If the shape is in space, or the graph unknown.
    TessellationError
        As `conform`, when the round is reached.

    Examples
    --------
    >>> acute = Shape.from_rings([[(0, 0), (13, 0), (10 * 3**0.5 / 2, 5)]])
    >>> [(len(stage.points), len(stage.missing), len(stage.corners)) for stage in conform_stages(acute)]
    [(3, 1, 2), (7, 0, 0)]
    """
    check_shape(shape)
    as_choice(to, "graph", _GRAPHS)
    if shape.dimension != 2:
        raise InputError("the rounds of refinement are shown for shapes in the plane; use conform(shape).")
    return (stage for stage, _ in _stages(shape, to, _limit(limit)))


def _limit(limit):
    if limit is not None:
        what = f"a whole number of vertices, 0 to {MOST_POINTS:,}, or None"
        limit = as_number(limit, "limit", what, 0, MOST_POINTS, whole=True)
    return limit


def _stages(shape: Shape, to: str, limit: int | None) -> Iterator[tuple[Stage, Tessellation | None]]:
    """The stages, the last one with its tessellation."""
    points, facets, tessellation = shape.points, shape.facets, shape.tessellation
    acute = _acute_corners(shape)
    limit = 10_000 + 10 * len(points) if limit is None else limit
    there = _in_graph(tessellation, facets, to)
    growing = None
    while not there.all():
        missing = np.flatnonzero(~there)
        corners = np.intersect1d(facets[missing], acute)
        acute = np.setdiff1d(acute, corners)
        stage = Stage(points, facets, missing, corners)
        yield stage, None
        if growing is None:
            growing = grown_from(tessellation)
        where = near(points[facets[missing[0]]])
        new, facets, cut = _cut(stage)
        try:
            change = growing.add(new)
        except DuplicatePointError:
            raise _no_room(shape, points, new) from None
        points = growing.points
        if len(points) > limit:
            raise TessellationError(
                f"more than {limit} vertices are needed, and the boundary near {where} is "
                f"still not in the {to} graph: the shape is very thin there. Widen it, or raise the limit."
            )
        if to == "gabriel":
            there = np.append(there, np.zeros(len(facets) - len(there), dtype=bool))
            there[cut] = False
            _update(there, points, facets, change)
        else:  # a diagonal of cocircular samples may be in another tessellation
            tessellation = preferring(growing.tessellation(), facets)
            there = _in_graph(tessellation, facets, to)
    if growing is not None and to == "gabriel":  # Gabriel facets are in every tessellation
        tessellation = growing.tessellation()
    yield Stage(points, facets, *np.zeros((2, 0), dtype=np.int64)), tessellation


def _cut(stage: Stage) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points that cut the facets of a stage, the facets then, and which of the old ones were cut.

    The first piece of a facet keeps its row, the others come after all.
    """
    points, facets = stage.points, stage.facets
    ends = points[facets]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    share = np.full((2, len(facets)), np.nan)  # of the length, where there is a cut near either end
    if len(stage.corners):
        distance = np.full(len(points), np.nan)
        distance[stage.corners] = _distances(stage.corners, points, facets)
        near_end = distance[facets]
        for end in range(2):
            at = ~np.isnan(near_end[:, end])
            share[end, at] = near_end[at, end] / length[at]
    share[0, stage.halved] = 1 / 2
    cut = ~np.isnan(share)
    first, second = (
        ends[c, k] + (ends[c, 1 - k] - ends[c, k]) * share[k, c, None] for k, c in enumerate(cut)
    )
    first[np.searchsorted(np.flatnonzero(cut[0]), stage.halved)] = ends[stage.halved].mean(axis=1)
    n = len(points)
    number = np.full((2, len(facets)), -1)
    number[0, cut[0]] = n + np.arange(len(first))
    number[1, cut[1]] = n + len(first) + np.arange(len(second))
    begin = np.where(cut[0], number[0], facets[:, 0])  # of the last piece
    both = cut.all(axis=0)
    rows = np.flatnonzero(cut.any(axis=0))
    out = facets.copy()
    out[rows, 1] = np.where(cut[0], number[0], number[1])[rows]
    middle = np.column_stack([number[0], number[1]])[both]
    last = np.column_stack([np.where(cut[1], number[1], begin), facets[:, 1]])[rows]
    return np.concatenate([first, second]), np.concatenate([out, middle, last]), rows


def _update(there: np.ndarray, points: np.ndarray, facets: np.ndarray, change: Change) -> None:
    """Which facets are in the strict Gabriel graph after a change: only those next to it can have changed."""
    touched = np.zeros(len(points), dtype=bool)
    solid, came = change.gone.min(axis=1) >= 0, change.come.min(axis=1) >= 0
    touched[change.gone[solid]] = touched[change.come[came]] = True
    rows = np.flatnonzero(touched[facets].all(axis=1))
    n = len(points)
    key = edge_keys(facets[rows], n)
    lost = np.isin(key, edge_keys(change.gone[solid][:, OPPOSITE[3]].reshape(-1, 2), n))
    there[rows[lost]] = False
    edge = edge_keys(change.come[came][:, OPPOSITE[3]].reshape(-1, 2), n)
    order = np.argsort(edge)
    at = order[np.searchsorted(edge, key, sorter=order).clip(max=len(edge) - 1)]
    found = edge[at] == key
    rows, at = rows[found], at[found]
    there[rows] = True
    for apex in (change.come[came].ravel()[at], change.apexes[came].ravel()[at]):
        some = apex >= 0
        there[rows[some]] &= in_gabriel_ball(points[facets[rows[some]]], points[apex[some]]) < 0


def _no_room(shape: Shape, points: np.ndarray, new: np.ndarray) -> TessellationError:
    """The error where a new point is one that is there; the reader knows the vertices of the shape only."""
    _, first, count = np.unique(np.concatenate([new, points]), axis=0, return_index=True, return_counts=True)
    point = new[first[count > 1].min()]
    _, (i, j) = cKDTree(shape.points).query(point, k=2)
    apart = np.linalg.norm(shape.points[i] - shape.points[j])
    where = f"near {near(point[None])}, floats leave no room for another vertex"
    before, after = (shape.points[shape.facets[shape.facets[:, k] == i, 1 - k][0]] for k in (1, 0))
    u, v = before - shape.points[i], after - shape.points[i]
    angle = np.arctan2(abs(u[0] * v[1] - u[1] * v[0]), u @ v)
    if angle < 1e-3 and apart > 1e-6 * np.abs(shape.points[i]).max():
        return TessellationError(
            f"{where}: the sides at vertex {i} enclose {angle:.1g} radians, so that the shape is "
            f"{angle * apart:.1g} wide at a distance of {apart:.2g}. Cut the tip off, or widen it."
        )
    return TessellationError(
        f"{where}: vertices {min(i, j)} and {max(i, j)} are {apart:.2g} apart there; merge vertices closer "
        f"than {2 * apart:.1g}, or move the shape nearer to the origin."
    )


def _acute_corners(shape: Shape) -> np.ndarray:
    """Vertices whose two sides enclose less than 90 degrees."""
    before, after = np.empty(len(shape.points), dtype=np.int64), np.empty(len(shape.points), dtype=np.int64)
    before[shape.facets[:, 1]], after[shape.facets[:, 0]] = shape.facets[:, 0], shape.facets[:, 1]
    u, v = shape.points[before] - shape.points, shape.points[after] - shape.points
    # A sign in doubt may go either way: cutting a right angle does no harm and is not needed.
    return np.flatnonzero((u * v).sum(axis=1) > 0)


def _distances(corners: np.ndarray, points: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """How far from each corner both sides are cut: a third of the way to the nearest end or other side."""
    ends = points[facets]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    reach = np.full(len(points), np.inf)
    np.minimum.at(reach, facets.ravel(), np.repeat(length, 2))
    reach, place = reach[corners], points[corners]
    nearest = reach.copy()
    boxes = place - reach[:, None], place + reach[:, None], ends.min(axis=1), ends.max(axis=1)
    for i, j in overlapping_pairs(*boxes):
        other = (facets[j] != corners[i, None]).all(axis=1)
        i, j = i[other], j[other]
        np.minimum.at(nearest, i, facet_distance(place[i], ends[j]))
    return nearest / 3


# Samples on the circle count: the strict rule of Theorems 1 and 2.
_ON_CIRCLE = 1 + 1e-12


def diametral_balls(stage: Stage) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The smallest balls through the missing sides of a stage, and the samples that keep the sides out.

    Parameters
    ----------
    stage : Stage
        See `polyskel_lite.containment.conform_stages`.

    Returns
    -------
    centers : (k, 2) float array
    radii : (k,) float array
    intruders : (i,) int array
        Samples in at least one of the closed balls, other than the two ends of its side.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> acute = psl.Shape.from_rings([[(0, 0), (13, 0), (10 * 3**0.5 / 2, 5)]])
    >>> first, *_ = conform_stages(acute)
    >>> centers, radii, intruders = diametral_balls(first)
    >>> centers.tolist(), radii.tolist(), intruders.tolist()
    ([[6.5, 0.0]], [6.5], [2])
    """
    sides = stage.facets[stage.missing]
    ends = stage.points[sides]
    centers = ends.mean(axis=1)
    radii = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) / 2
    if not len(sides):
        return centers, radii, np.zeros(0, dtype=np.int64)
    within = cKDTree(stage.points).query_ball_point(centers, radii * _ON_CIRCLE)
    found = {v for side, ball in zip(sides.tolist(), within, strict=True) for v in ball if v not in side}
    return centers, radii, np.array(sorted(found), dtype=np.int64)
