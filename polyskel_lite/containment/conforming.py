"""Which boundary facets are in Del(E) or GG(E), and refining a boundary until all are (sections 3.4, 3.5)."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from ..checks import MOST_POINTS, as_choice, as_instance, as_number, near
from ..errors import InputError, TessellationError
from ..exact import point_segment_distance
from ..graphs import Tessellation, delaunay, facet_rows, gabriel_mask
from ..shapes import Shape, check_shape
from .conforming_solids import conform_solid

_GRAPHS = ("delaunay", "gabriel")


def missing_facets(
    shape: Shape, of: str = "delaunay", tessellation: Tessellation | None = None
) -> np.ndarray:
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
        tessellation = delaunay(shape.points, shape.facets)
    as_instance(tessellation, Tessellation, "tessellation", "delaunay(shape.points, shape.facets), or None")
    if not np.array_equal(tessellation.points, shape.points):
        raise InputError("tessellation is not that of the shape's vertices; leave it out.")
    rows = facet_rows(tessellation, shape.facets)
    missing = rows < 0
    if of == "gabriel":
        missing[~missing] = ~gabriel_mask(tessellation, closed=True, rows=rows[~missing])
    return np.flatnonzero(missing)


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
    if shape.dimension == 3:
        return conform_solid(shape, to, limit)
    for stage in _stages(shape, to, limit):
        last = stage
    return Shape(last.points, last.facets) if len(last.points) > len(shape.points) else shape


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
    return _stages(shape, to, _limit(limit))


def _limit(limit):
    if limit is not None:
        what = f"a whole number of vertices, 0 to {MOST_POINTS:,}, or None"
        limit = as_number(limit, "limit", what, 0, MOST_POINTS, whole=True)
    return limit


def _stages(shape: Shape, to: str, limit: int | None) -> Iterator[Stage]:
    points, facets = list(map(tuple, shape.points.tolist())), list(map(tuple, shape.facets.tolist()))
    acute = _acute_corners(shape)
    limit = 10_000 + 10 * len(points) if limit is None else limit
    while True:
        array = np.array(points)
        current = np.array(facets)
        tessellation = delaunay(array, current)
        rows = facet_rows(tessellation, current)
        missing = rows < 0
        if to == "gabriel":
            missing[~missing] = ~gabriel_mask(tessellation, closed=True, rows=rows[~missing])
        corners = sorted(acute & set(current[missing].ravel().tolist()))
        stage = Stage(array, current, np.flatnonzero(missing), np.array(corners, dtype=np.int64))
        yield stage
        if not missing.any():
            return
        cuts: dict[int, np.ndarray] = {}
        for corner in corners:
            _cut_corner(corner, array, current, cuts)
        acute -= set(corners)
        cuts |= {k: array[current[k]].mean(axis=0)[None] for k in stage.halved.tolist()}
        _insert(shape, points, facets, cuts)
        if len(points) > limit:
            k = np.flatnonzero(missing)[0]
            raise TessellationError(
                f"more than {limit} vertices are needed, and the boundary near {near(array[current[k]])} is "
                f"still not in the {to} graph: the shape is very thin there. Widen it, or raise the limit."
            )


def _insert(shape: Shape, points, facets, cuts) -> None:
    taken = set(points)
    for k, cut in cuts.items():
        a, b = facets[k]
        chain = [a]
        for point in map(tuple, cut.tolist()):
            if point in taken:
                # The reader knows the vertices of the shape, and none that were added.
                _, (i, j) = cKDTree(shape.points).query(point, k=2)
                apart = np.linalg.norm(shape.points[i] - shape.points[j])
                raise TessellationError(
                    f"near {near(np.array([point]))}, floats leave no room for another vertex: vertices "
                    f"{min(i, j)} and {max(i, j)} are {apart:.2g} apart there; merge vertices closer than "
                    f"{2 * apart:.1g}, or move the shape nearer to the origin."
                )
            taken.add(point)
            chain.append(len(points))
            points.append(point)
        chain.append(b)
        pieces = list(pairwise(chain))
        facets[k] = pieces[0]
        facets.extend(pieces[1:])


def _acute_corners(shape: Shape) -> set[int]:
    """Vertices whose two sides enclose less than 90 degrees."""
    before, after = np.empty(len(shape.points), dtype=np.int64), np.empty(len(shape.points), dtype=np.int64)
    before[shape.facets[:, 1]], after[shape.facets[:, 0]] = shape.facets[:, 0], shape.facets[:, 1]
    u, v = shape.points[before] - shape.points, shape.points[after] - shape.points
    # A sign in doubt may go either way: cutting a right angle does no harm and is not needed.
    return set(np.flatnonzero((u * v).sum(axis=1) > 0).tolist())


def _cut_corner(corner, points, facets, cuts) -> None:
    """Cut both sides at ``corner`` at one distance: a third of the way to anything else."""
    at = (facets == corner).any(axis=1)
    other = np.where(facets[at, 0] == corner, facets[at, 1], facets[at, 0])
    lengths = np.linalg.norm(points[other] - points[corner], axis=1)
    clearance = point_segment_distance(points[corner], points[facets[~at]]).min(initial=np.inf)
    distance = min(lengths.min(), clearance) / 3
    for k, end, length in zip(np.flatnonzero(at).tolist(), other.tolist(), lengths.tolist(), strict=True):
        new = points[corner] + (points[end] - points[corner]) * (distance / length)
        if k in cuts:  # both ends of this side are acute corners
            both = np.concatenate([cuts[k], new[None]])
            along = ((both - points[facets[k, 0]]) ** 2).sum(axis=1)
            cuts[k] = both[np.argsort(along)]
        else:
            cuts[k] = new[None]


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
