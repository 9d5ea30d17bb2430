"""The exact skeleton of a union of balls (appendix A, theorems 3 and 4 as corrected).

Between two singular points p and q the skeleton is a convex piece of their Voronoi face: the points whose
nearest boundary points are p and q. Its corners are Voronoi vertices whose ball lies in the union, and
centres of balls through both p and q. So no face is clipped numerically: the corners are found one by one,
and sorted.
"""

from __future__ import annotations

from itertools import combinations
from typing import NamedTuple

import numpy as np
from scipy.optimize import nnls
from scipy.spatial import cKDTree

from ..errors import TessellationError
from ..exact import Polygons, components, edge_rings, unique_rows
from ..skeletons import Skeleton
from .incidence import Incidence, gather
from .pairs import found_at, lengths, units
from .power import PowerTriangulation, regular_triangulation
from .union import BallUnion

# Voronoi vertices nearer than this share of their radius are one: cospherical singular points have only one,
# and a vertex is known to some 1e-12 of its radius times what thin simplices lose.
_SAME = 1e-9
# Cospherical points are triangulated as if lifted by up to this share of the squared distance to the next.
# Far more than rounding, so that cells around one Voronoi vertex never contain flat simplices.
_LIFT = 1e-6
# A polygon narrower than this share of its length is a line.
_FLAT = 1e-8
# A vector that misses a cone by less than this share of its length is on its border, and the cone is closed:
# corners are known to some 1e-12 of their balls, and directions to them lose up to three more digits.
_CONE = 1e-9
# Corners of a simplex, or directions to centres, this near to one plane fix no point in it.
_PLANE = 1e-12


# If rounding spoils the skeleton, balls that differ by less than such shares of their radius count as one.
_ALIKE = (0.0, 1e-8, 1e-7, 1e-6, 1e-5)
# Of balls more alike than this, triangulations show holes that are not there.
_CLEAR = 1e-6


class _Faces(NamedTuple):
    """Vertices of the skeleton on each Voronoi face of the singular points: rows (face, vertex), sorted."""

    generators: np.ndarray
    face: np.ndarray
    vertex: np.ndarray


def ball_skeleton(union: BallUnion, alone, bridges) -> Skeleton:
    """Build the skeleton of a union of balls from its singular points and what hangs on none of them.

    Parameters
    ----------
    union : BallUnion
    alone : (k,) bool array
        Balls whose centre is in the skeleton whatever else is.
    bridges : (m, 2) int array
        In space, pairs of balls whose circle is on the boundary without any singular point on it.

    Returns
    -------
    Skeleton

    References
    ----------
    Attali and Montanvert 1997, appendix A.2; Amenta and Kolluri, The medial axis of a union of balls, 2001.

    Examples
    --------
    Three balls in a row, every two of which cross in a whole circle or not at all:

    >>> row = BallUnion(np.array([(0.0, 0, 0), (1.5, 0, 0), (3, 0, 0)]), np.ones(3))
    >>> ball_skeleton(row, row.exposed, row.crossing(bare=True)).edges.tolist()
    [[0, 1], [1, 2]]
    """
    vertices, sizes = union.centers, union.radii
    edges, polygons = [bridges], Polygons()
    if len(union.boundary.corners):
        corners, on = gather(union.boundary.corners, vertices, sizes, union.origin)
        t = _triangulate(corners)
        label, vertices, sizes = _voronoi_vertices(t, corners, on, vertices, sizes)
        lines = _faces(t, label, on, union.exposed, len(union.origin))
        edges.append(_chains(lines.face, lines.vertex, vertices))
        if union.in_space:
            sheets = _faces(t, label, on, union.exposed, 2)
            polygons, flat = _polygons(sheets, _ring_places(t, label, sheets), vertices, corners)
            edges += [flat, polygons.sides()]
    edges = unique_rows(np.sort(np.concatenate(edges), axis=1), len(vertices))[0]
    used = np.union1d(np.flatnonzero(alone), edges)
    polygons = Polygons(np.searchsorted(used, polygons.corners), polygons.sizes)
    edges, no_simplex = np.searchsorted(used, edges), np.full(len(used), -1)
    return Skeleton(vertices[used] + union.origin, sizes[used], no_simplex, edges, polygons)


def verified_skeleton(union: BallUnion) -> Skeleton:
    """Build the skeleton of a union of balls with the Betti numbers of its dual shape.

    Parameters
    ----------
    union : BallUnion
        Without balls that touch on the boundary.

    Returns
    -------
    Skeleton
        Of the balls themselves as a rule. Where many nearly coincide, nobody can tell how their spheres
        cross, and small false loops show that; then it is the skeleton with one ball for all that differ by
        less than 1e-8 (1e-7, 1e-6, 1e-5 if need be) of their radius, by which the union changes at most.

    Raises
    ------
    TessellationError
        If none of these has the right Betti numbers.

    Examples
    --------
    >>> verified_skeleton(BallUnion(np.array([(0.0, 0), (1, 0)]), np.ones(2))).edges.tolist()
    [[0, 1]]
    """
    tried, true, reason = 0, None, None
    # Every try costs; where even arcs are lost, the first ones are in vain.
    for share in _ALIKE if union.sound else _ALIKE[-2:]:
        like = union.alike(share) if share else union
        if len(like.radii) == tried or not like.sound:
            continue
        tried = len(like.radii)
        bridges = like.crossing(bare=True) if like.in_space else np.zeros((0, 2), dtype=np.int64)
        try:
            skeleton = ball_skeleton(like, like.exposed, bridges)
        except TessellationError as error:
            reason = error
            continue
        betti, allowed = skeleton.betti(), like.homotopy()
        true = true or union.alike(_CLEAR).homotopy()
        # Circles in space may surround a point: it is no hole of the union, but one of its interior.
        if betti in allowed[0 if like.in_space else 1 :] and (betti in true or _steady(like, share)):
            return skeleton
    raise TessellationError(_hidden(union)) from reason


def _steady(union: BallUnion, share: float) -> bool:
    """Whether no hole opens or closes if radii change by twice a share, of balls that stand for others."""
    low, high = union.homotopy(4 * share)
    return share > 0 and low == high


def _hidden(union: BallUnion) -> str:
    """Why there is no skeleton."""
    distance, other = cKDTree(union.centers).query(union.centers, k=min(2, len(union.radii)))
    apart = (distance[:, -1] + np.abs(union.radii - union.radii[other[:, -1]])) / union.radii
    least = apart.argmin()
    i, j = np.sort(union.rows[[least, other[least, -1]]])
    return (
        "too many of these balls nearly coincide, as around samples that lie on one sphere, and rounding "
        f"hides which of them are on the boundary; most alike are balls {i} and {j}, which differ by "
        f"{apart[least]:.1e} of a radius; leave out balls that are almost equal."
    )


def _triangulate(corners) -> PowerTriangulation:
    """The Delaunay simplices of the singular points, ghosts around them, ties broken one way for all."""
    near = cKDTree(corners).query(corners, k=2)[0][:, 1] if len(corners) > 1 else np.zeros(1)
    near[~np.isfinite(near)] = 0
    lift = np.random.default_rng(1997).random(len(corners)) * _LIFT * near**2
    size = float(lengths(corners).max()) or 1.0
    try:
        return regular_triangulation(corners, lift, size, hide=False)
    except TessellationError:  # where points crowd together, lifting them by less than rounding does harm
        return regular_triangulation(corners, np.zeros(len(corners)), size, hide=False)


def _voronoi_vertices(t, corners, on: Incidence, centers, radii):
    """The skeleton vertex of each simplex (-1: none), and places and radii of all vertices, balls first."""
    k, real = len(radii), t.real()
    label = np.full(len(t.simplices), -1)
    row, ball = on.common(t.simplices[real])
    first = np.unique(row, return_index=True)[1]
    label[np.flatnonzero(real)[row[first]]] = ball[first]
    rest = np.flatnonzero(real & (label < 0))
    place, size = _circumballs(corners[t.simplices[rest]], t.orthocenters[rest])
    # The same ball may be one of the given ones, or that of a neighbouring simplex.
    distance, nearest = cKDTree(centers).query(place)
    given = (distance <= _SAME * size) & (np.abs(radii[nearest] - size) <= _SAME * size)
    label[rest[given]] = nearest[given]
    kept = ~given
    kept[kept] = _in_union(t.simplices[rest[kept]], place[kept], corners, on, centers)
    rest, place, size = rest[kept], place[kept], size[kept]
    number = np.full(len(t.simplices), -1)
    number[rest] = np.arange(len(rest))
    beside = number[t.neighbors[rest]]
    row, side = np.nonzero(beside >= 0)
    pairs = np.column_stack([row, beside[row, side]])
    twins = pairs[lengths(place[pairs[:, 0]] - place[pairs[:, 1]]) <= _SAME * size[pairs].min(axis=1)]
    count, group = components(len(rest), twins)
    representative = np.zeros(count, dtype=np.int64)
    representative[group] = np.arange(len(rest))
    label[rest] = k + group
    return label, np.concatenate([centers, place[representative]]), np.append(radii, size[representative])


def _circumballs(corners, fallback) -> tuple[np.ndarray, np.ndarray]:
    """Centres and radii of the balls through the corners (m, N+1, N) of simplices."""
    legs = corners[:, 1:] - corners[:, :1]
    flat = np.abs(np.linalg.det(legs)) <= _PLANE * np.prod(lengths(legs), axis=1)
    legs[flat] = np.eye(corners.shape[2])
    place = corners[:, 0] + np.linalg.solve(legs, (legs**2).sum(axis=2)[:, :, None])[:, :, 0] / 2
    place[flat] = fallback[flat]
    return place, lengths(place[:, None] - corners).mean(axis=1)


def _in_union(simplices, place, corners, on: Incidence, centers) -> np.ndarray:
    """Which Voronoi balls of singular points lie in the union of the given balls, (m,) bool array.

    A Voronoi ball around m that passes through the singular point p lies in the union if and only if m - p is
    a positive combination of the directions from p to the centres of its balls. All corners of the simplex
    agree on that; the one that is clearest decides.
    """
    own = on.balls_of_each(place.shape[1])[simplices]
    towards = units(centers[own] - corners[simplices][:, :, None])
    offset = place[:, None] - corners[simplices]
    clear = (own[..., 0] >= 0) & (np.abs(np.linalg.det(towards)) > _PLANE)
    towards[~clear] = np.eye(place.shape[1])
    share = np.linalg.solve(towards.swapaxes(2, 3), offset[..., None])[..., 0].min(axis=2)
    margin = np.where(clear, share / lengths(offset), 0)
    clearest = margin[np.arange(len(margin)), np.abs(margin).argmax(axis=1)]
    inside = clearest > -_CONE
    # Where more than N balls meet in every corner, look for the combination itself.
    for row in np.flatnonzero(np.abs(clearest) < _FLAT):
        inside[row] = all(
            _in_cone(place[row] - corners[p], centers[on.balls(p)] - corners[p]) for p in simplices[row]
        )
    return inside


def _in_cone(vector, directions) -> bool:
    _, residual = nnls(units(directions).T, vector)
    return residual <= _CONE * np.sqrt(vector @ vector)


def _faces(t, label, on: Incidence, exposed, size: int) -> _Faces:
    """The Voronoi faces of `size` singular points, each with its skeleton vertices."""
    columns = list(combinations(range(t.simplices.shape[1]), size))
    groups = np.sort(t.simplices[:, columns], axis=2).reshape(-1, size)
    owner = np.repeat(np.arange(len(t.simplices)), len(columns))
    real = groups[:, -1] < t.count
    generators, face = unique_rows(groups[real], t.count)
    vertex = label[owner[real]]
    through, ball = on.common(generators)
    through, ball = through[exposed[ball]], ball[exposed[ball]]
    rows = np.column_stack([np.append(face[vertex >= 0], through), np.append(vertex[vertex >= 0], ball)])
    rows, _ = unique_rows(rows, max(len(generators), len(exposed), int(label.max()) + 1))
    return _Faces(generators, rows[:, 0], rows[:, 1])


def _chains(face, vertex, vertices) -> np.ndarray:
    """Edges between consecutive vertices of faces that are parts of lines, (e, 2)."""
    offset, direction, _ = _about_middle(face, vertices[vertex])
    along = np.einsum("mi,mi->m", offset, direction)
    order = np.lexsort((along, face))
    face, vertex = face[order], vertex[order]
    joined = face[1:] == face[:-1]
    return np.column_stack([vertex[:-1], vertex[1:]])[joined]


def _about_middle(face, places) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places seen from the middle of their face, the farthest of the face for each row, sizes of faces."""
    first = np.flatnonzero(np.diff(face, prepend=-1))
    size = np.diff(first, append=len(face))
    offset = places - np.repeat(np.add.reduceat(places, first) / size[:, None], size, axis=0)
    farthest = np.lexsort(((offset**2).sum(axis=1), face))[np.cumsum(size) - 1]
    return offset, np.repeat(offset[farthest], size, axis=0), size


def _ring_places(t, label, faces: _Faces) -> np.ndarray:
    """The place of each skeleton vertex in the ring around its face, -1 on faces that are cut."""
    _, edge, owner, position = edge_rings(t.simplices, t.neighbors, t.count)
    vertex = label[owner]
    rows = np.argsort(position)
    rows = rows[vertex[rows] >= 0]
    bound = 1 + max(label.max(), faces.vertex.max(initial=0))
    at = found_at(edge[rows] * bound + vertex[rows], faces.face * bound + faces.vertex)
    place = np.append(position[rows], -1)[at]
    # A centre of a ball that is no vertex of the ring is where the face was cut.
    cut = np.append(edge[vertex < 0], faces.face[place < 0])
    return np.where(np.isin(faces.face, cut), -1, place)


def _polygons(faces: _Faces, place, vertices, corners) -> tuple[Polygons, np.ndarray]:
    """The convex polygons with three corners or more, in order, and the edges of those that are flat."""
    face, vertex = faces.face, faces.vertex
    offset, x, size = _about_middle(face, vertices[vertex])
    first = np.cumsum(size) - size
    normal = corners[faces.generators[face, 1]] - corners[faces.generators[face, 0]]
    y = np.cross(units(normal), x)
    along, across = np.einsum("mi,mi->m", offset, x), np.einsum("mi,mi->m", offset, y)
    extent = np.maximum.reduceat(np.abs(along), first)
    wide = np.repeat(np.maximum.reduceat(np.abs(across), first) > _FLAT * extent, size)
    solid = np.where(place >= 0, np.repeat(size >= 3, size), wide)
    # Faces that are in as a whole keep the order of their ring, which no rounding can change. For the others:
    # the middle of a convex polygon is inside it, so its corners are in order as seen from there.
    turn = np.where(place >= 0, place, np.arctan2(across, along))
    rows = np.flatnonzero(solid)
    rows = rows[np.lexsort((turn[rows], face[rows]))]
    polygons = Polygons(vertex[rows], np.unique(face[rows], return_counts=True)[1])
    return polygons, _chains(face[~solid], vertex[~solid], vertices)
