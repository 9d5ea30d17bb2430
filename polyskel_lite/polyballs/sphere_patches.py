"""Triangles for the boundary of a union of balls in space, good enough to draw and without gaps.

First the exposed arcs get their vertices, which the spheres on both sides share. Then each sphere adds the
vertices of an icosphere that lie in its patch, and the convex hull of all of them is their Delaunay
triangulation on the sphere. Vertices that follow each other on an arc are always joined: the plane of their
circle has all vertices of the patch on one side, so that it holds a facet of the hull. Therefore the edges of
the arcs separate the triangles of the patch from those over the part that other balls cover, and these are
thrown away.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.spatial import ConvexHull, QhullError, cKDTree

from ..checks import as_number
from ..errors import InputError
from ..exact import components, spread_out
from .discs import Boundary
from .pairs import found_at, units
from .union import BallUnion, Caps

#: Triangles on all spheres together: one million take ten seconds, and no screen shows more.
MOST_TRIANGLES = 1_000_000
_EDGE = np.arctan(2)  # of the icosahedron in the unit sphere, as an angle
_COARSEST = 2  # edges of the icosahedron are cut into so many at least: 42 vertices on a whole sphere
_CLEAR = 0.5  # vertices stay this share of an edge away from arcs
_TURN = np.pi / 4  # no edge of an arc turns by more


def patches(union: BallUnion, fineness: float = 0.03) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Triangulate the boundary of a union of balls.

    Parameters
    ----------
    union : BallUnion
        Of balls in space.
    fineness : float
        Length of the edges as a share of the longest side of the box around all balls. However small a ball
        is in the whole, its edges span about half a radian at most.

    Returns
    -------
    vertices : (v, 3) float array
        Seen from the origin of the union. On the spheres to rounding; those of an arc are on both spheres,
        singular points on all of theirs.
    triangles : (t, 3) int array
        Counter-clockwise as seen from outside the union.
    ball : (t,) int array
        The sphere on which the corners of each triangle lie.

    Raises
    ------
    InputError
        If `fineness` is not positive.

    Notes
    -----
    Watertight: every edge is used as often in one direction as in the other, because patches share the
    vertices of their arcs. Where many spheres pass through nearly one point or nearly coincide, rounding may
    break what the construction rests on; such a patch is filled with triangles that all have one corner in
    common, which leaves the mesh closed but draws this patch flat.

    References
    ----------
    Brown, Voronoi diagrams from convex hulls, Inform. Process. Lett. 9, 1979, 223-228, for Delaunay
    triangulations on a sphere as hulls.

    Examples
    --------
    >>> two = BallUnion(np.array([(-0.5, 0, 0), (0.5, 0, 0)]), np.ones(2))
    >>> vertices, triangles, ball = patches(two)
    >>> edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    >>> len(vertices) - len(edges) + len(triangles)
    2
    >>> spokes = vertices[triangles] - two.centers[ball][:, None]
    >>> np.unique(ball).tolist(), bool(np.allclose(np.linalg.norm(spokes, axis=2), 1))
    ([0, 1], True)
    """
    what = "a share of the size of the whole, such as 0.03"
    fineness = as_number(fineness, "fineness", what, 0, above=True)
    centers, radii = union.centers, union.radii
    size = ((centers + radii[:, None]).max(axis=0) - (centers - radii[:, None]).min(axis=0)).max()
    parts = np.maximum(np.ceil(_EDGE * radii / (fineness * size)), _COARSEST)
    count = 20 * (parts**2).sum()
    if not count <= MOST_TRIANGLES:
        raise InputError(
            f"fineness = {fineness:g} asks for {count:.2g} triangles, and {MOST_TRIANGLES:,} are the most; "
            f"pass {fineness * np.sqrt(count / MOST_TRIANGLES):.2g} or more."
        )
    parts = parts.astype(np.int64)
    shared, rims = _rims(union.boundary, radii * _EDGE / parts)
    hulls = _hulls(union, parts, shared, rims)
    kept, broken = _patch_side(hulls)
    triangles = hulls.triangles[kept]
    ball, triangles = hulls.ball[triangles[:, 0]], hulls.names[triangles]
    if len(broken):
        whole = ~np.isin(ball, broken)
        fans = [_fan(rims[b]) for b in broken]
        triangles = np.concatenate([triangles[whole], *fans])
        ball = np.concatenate([ball[whole], np.repeat(broken, [len(fan) for fan in fans])])
    used, triangles = np.unique(triangles, return_inverse=True)
    return hulls.vertices[used], triangles.reshape(-1, 3), ball


class _Hulls(NamedTuple):
    """Triangulated spheres, each with its own copy of the vertices on its arcs.

    `names` is the row in `vertices` of each copy, `ball` its sphere; `rims` are the edges of arcs.
    """

    vertices: np.ndarray
    names: np.ndarray
    triangles: np.ndarray
    rims: np.ndarray
    ball: np.ndarray


def _rims(boundary: Boundary, edge: np.ndarray) -> tuple[np.ndarray, list[np.ndarray]]:
    """Cut all exposed arcs into edges not longer than those of the finer one of both spheres.

    The vertices, and for each ball its edges: polygons along its arcs, with its patch on their left.
    """
    row, start, end = boundary.arcs
    circles, corners = boundary.circles, boundary.corners
    whole = boundary.arcs.whole
    places = circles.points(np.tile(row, 2), np.concatenate([start, end]))
    ends = cKDTree(corners).query(places)[1].reshape(2, -1)
    # An arc shorter than the error of its ends is nothing.
    kept = whole | (ends[0] != ends[1]) | (end - start > np.pi)
    row, start, end, whole, ends = row[kept], start[kept], end[kept], whole[kept], ends[:, kept]
    length = (end - start) * circles.radii[row] / edge[circles.pairs[row]].min(axis=1)
    # Two edges at least, or two arcs between the same singular points would be the same edge.
    pieces = np.maximum(np.ceil(np.maximum(length, (end - start) / _TURN)).astype(np.intp), 2)
    arc, place = spread_out(pieces)
    begin = np.where((place == 0) & ~whole[arc], ends[0, arc], 0)
    inner = (place > 0) | whole[arc]
    begin[inner] = len(corners) + np.arange(inner.sum())
    angle = start[arc] + place / pieces[arc] * (end - start)[arc]
    vertices = np.concatenate([corners, circles.points(row[arc[inner]], angle[inner])])
    last = np.cumsum(pieces) - 1
    after = np.roll(begin, -1)
    after[last] = np.where(whole, begin[last - pieces + 1], ends[1])
    i, j = circles.pairs[row[arc]].T
    ball = np.concatenate([i, j])
    edges = np.concatenate([np.stack([after, begin], axis=1), np.stack([begin, after], axis=1)])
    order = np.argsort(ball, kind="stable")
    return vertices, np.split(edges[order], np.searchsorted(ball[order], np.arange(1, len(edge))))


def _hulls(union: BallUnion, parts, on_arcs, rims) -> _Hulls:
    """Triangulate each sphere with its arcs' vertices and the vertices of an icosphere between them."""
    centers, radii, balls, covered = union.centers, union.radii, np.flatnonzero(union.exposed), union.caps
    vertices, names, triangles, edges = [on_arcs], [], [], []
    number, copies = len(on_arcs), 0
    for ball in balls:
        rim = rims[ball]
        if len(rim):
            shared, rim = np.unique(rim, return_inverse=True)
            rim = rim.reshape(-1, 2)
            places = (on_arcs[shared] - centers[ball]) / radii[ball]
            inner = _inner(covered, int(ball), parts[ball], places[rim])
            found = _hull(np.concatenate([places, inner]))
        else:
            shared = np.zeros(0, dtype=np.int64)
            inner, found = _icosphere(parts[ball])
        vertices.append(centers[ball] + radii[ball] * inner)
        names += [shared, np.arange(number, number + len(inner))]
        triangles.append(found + copies)
        edges.append(rim + copies)
        number += len(inner)
        copies += len(shared) + len(inner)
    owner = np.repeat(np.repeat(balls, 2), [len(part) for part in names])
    places, called, faces, rims = map(np.concatenate, (vertices, names, triangles, edges))
    return _Hulls(places, called, faces, rims, owner)


def _inner(covered: Caps, ball: int, parts: int, rim: np.ndarray) -> np.ndarray:
    """Vertices of the icosphere that are in no cap and not near one; if none is, the middle of the patch."""
    rows = slice(covered.first[ball], covered.first[ball + 1])
    angle = np.arccos(np.clip(covered.heights[rows], -1, 1)) + _CLEAR * _EDGE / parts
    below = np.where(angle < np.pi, np.cos(angle), -2)
    points = _icosphere(parts)[0]
    points = points[(points @ covered.axes[rows].T < below).all(axis=1)]
    if len(points):
        return points
    middle = np.cross(rim[:, 0], rim[:, 1]).sum(axis=0)
    middle /= max(np.sqrt(middle @ middle), np.finfo(float).tiny)
    free = (covered.axes[rows] @ middle < covered.heights[rows]).all()
    return middle[None] if free else points


def _hull(places: np.ndarray) -> np.ndarray:
    """Facets of the convex hull, counter-clockwise from outside; none if the points are in one plane."""
    try:
        hull = ConvexHull(places)
    except QhullError:
        return np.zeros((0, 3), dtype=np.int64)
    triangles = hull.simplices.astype(np.int64)
    a, b, c = places[triangles].transpose(1, 0, 2)
    turned = (np.cross(b - a, c - a) * hull.equations[:, :3]).sum(axis=1) < 0
    triangles[turned] = triangles[turned, ::-1]
    return triangles


def _patch_side(hulls: _Hulls) -> tuple[np.ndarray, np.ndarray]:
    """Which triangles are on the patches' side of the arcs, and the balls where this cannot be told."""
    count = len(hulls.names)
    a, b = hulls.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).T
    triangle = np.arange(len(a)) // 3
    key, twin, rim = a * count + b, b * count + a, hulls.rims @ (count, 1)
    at = found_at(key, twin)
    # Not so where an edge has no twin, or where it is there twice.
    paired = (at >= 0) & (at[at] == np.arange(len(at)))
    left, right = np.isin(key, rim), np.isin(twin, rim)
    through = paired & ~left & ~right
    links = np.column_stack([triangle, triangle[at]])[through]
    number, region = components(len(hulls.triangles), links)
    inside, outside = (np.isin(np.arange(number), region[triangle[side]]) for side in (left, right))
    ball, rim_ball = hulls.ball[hulls.triangles[:, 0]], hulls.ball[hulls.rims[:, 0]]
    lost, whole = ~np.isin(rim, key), ~np.isin(ball, rim_ball)
    unclear = (inside == outside)[region] & ~whole
    doubtful = np.concatenate([np.flatnonzero(unclear), triangle[~paired]])
    return inside[region] | whole, np.union1d(rim_ball[lost], ball[doubtful])


def _fan(edges: np.ndarray) -> np.ndarray:
    """Triangles from one vertex of the rims to all their edges, so that the rims are their boundary."""
    top = edges[0, 0]
    edges = edges[(edges != top).all(axis=1)]
    return np.column_stack([np.full(len(edges), top), edges])


@lru_cache(maxsize=64)
def _icosphere(parts: int) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and triangles of the icosahedron with edges cut into `parts`, on the unit sphere."""
    golden = (1 + 5**0.5) / 2
    corners = np.array([(0, a, b * golden) for a in (-1, 1) for b in (-1, 1)])
    corners = np.concatenate([corners, np.roll(corners, 1, axis=1), np.roll(corners, 2, axis=1)])
    faces = _hull(corners)
    i, j = np.array([(i, j) for i in range(parts + 1) for j in range(parts + 1 - i)]).T
    weights = np.stack([parts - i - j, i, j]) / parts
    row = np.full((parts + 2, parts + 2), -1)
    row[i, j] = np.arange(len(i))
    up = np.stack([row[i, j], row[i + 1, j], row[i, j + 1]], axis=1)
    down = np.stack([row[i + 1, j], row[i + 1, j + 1], row[i, j + 1]], axis=1)
    small = np.concatenate([up, down])
    small = small[(small >= 0).all(axis=1)]
    points = np.einsum("wp,fwx->fpx", weights, corners[faces])
    triangles = (np.arange(len(faces))[:, None, None] * len(i) + small).reshape(-1, 3)
    points = points.reshape(-1, 3)
    # Edges of the faces have their points twice: one of each is enough.
    first, same = np.unique(points.round(9), axis=0, return_index=True, return_inverse=True)[1:]
    return units(points[first]), same.reshape(-1)[triangles]
