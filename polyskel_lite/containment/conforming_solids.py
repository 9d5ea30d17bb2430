"""Refining the boundary of a solid until its triangles are in Del(E) or GG(E) (section 3.4 in 3D)."""

from __future__ import annotations

import numpy as np

from ..checks import near
from ..errors import ContourContainmentError, ShapeError
from ..graphs import Tessellation, facet_rows, gabriel_mask, grown_from
from ..shapes import Shape, edge_keys, split_edges
from .surface_edits import flip_toward


def conform_solid(shape: Shape, to: str = "delaunay", limit: int | None = None) -> Shape:
    """Flip edges, then halve edges, until every triangle is in the graph; see `polyskel_lite.conform`.

    Parameters
    ----------
    shape : Shape
        In 3D.
    to : "delaunay" or "gabriel"
    limit : int, optional
        Give up beyond this many vertices; by default 2,000 and four times as many as there are.

    Returns
    -------
    Shape
        The given vertices first. Flipped edges move the surface by no more than the gap between the two
        diagonals of a quadrangle, and never where it bends by 60 degrees or more. The Betti numbers are
        those of the given shape, and the mesh has passed all checks of `Shape`.

    Raises
    ------
    ContourContainmentError
        If the limit is reached, or floats are too coarse; ``.missing`` are the faces of the *given*
        shape that are not in the graph of its own vertices.

    Notes
    -----
    Flips alone make uniform meshes Delaunay; decimated ones need vertices too. Nothing guarantees an end
    where two sheets of the surface are very near to each other compared with the edges, or at needle-sharp
    edges: that is what the limit is for.

    References
    ----------
    Dyer, Zhang and Möller, Delaunay mesh construction, 2007 (flips and splits toward a Delaunay mesh).

    Examples
    --------
    >>> from polyskel_lite import datasets, missing_facets
    >>> fixed = conform_solid(datasets.load("fourbranch"))
    >>> len(fixed.points), len(missing_facets(fixed))
    (1191, 0)
    """
    points, faces = shape.points, shape.facets
    limit = 2_000 + 4 * len(points) if limit is None else limit
    given = _Graph(shape.tessellation, to).missing(faces)
    if not len(given):
        return shape
    growing = grown_from(shape.tessellation)
    while True:
        graph = _Graph(growing.tessellation(), to)
        faces, _ = flip_toward(points, faces, graph.score)
        missing = graph.missing(faces)
        if not len(missing):
            break
        where = near(points[faces[missing[0]]])
        if len(points) < limit:
            points, faces = split_edges(points, faces, _to_halve(graph, points, faces[missing]))
            growing.add(points[graph.n :])
        if len(points) >= limit or len(points) == graph.n:
            why = f"{limit} vertices" if len(points) >= limit else "edges too short to be halved"
            flat = " or has right angles in a plane" if to == "gabriel" else ""
            raise ContourContainmentError(
                f"{len(given)} of {len(shape.facets)} faces (first: {given[0]}) are not in the {to} graph of "
                f"the vertices, and with {why} {len(missing)} still are not, one near {where}: the surface "
                f"is very near to itself, has a sharp edge{flat} there. Remesh it more evenly, widen it, or "
                "raise the limit.",
                given,
            )
    try:
        result = Shape.refined(faces, graph.tessellation)
    except ShapeError as error:
        raise ContourContainmentError(
            f"{len(given)} of {len(shape.facets)} faces are not in the {to} graph, and rounding spoiled the "
            f"mesh that is: {error}",
            given,
        ) from None
    if result.betti() != shape.betti():
        raise ContourContainmentError(
            f"{len(given)} of {len(shape.facets)} faces are not in the {to} graph, and flipping edges would "
            f"change the Betti numbers from {shape.betti()} to {result.betti()}; remesh it more evenly.",
            given,
        )
    return result


class _Graph:
    """The triangles and edges that a mesh should be made of."""

    def __init__(self, tessellation: Tessellation, to: str):
        self.n = len(tessellation.points)
        self.tessellation = tessellation
        rows = len(tessellation.facets())
        self.good = gabriel_mask(tessellation) if to == "gabriel" else np.ones(rows, dtype=bool)
        self.good = np.append(self.good, False)
        self.edges = edge_keys(tessellation.edges(), self.n)

    def has(self, faces: np.ndarray) -> np.ndarray:
        return self.good[facet_rows(self.tessellation, faces)]

    def has_edges(self, edges: np.ndarray) -> np.ndarray:
        return np.isin(edge_keys(edges, self.n), self.edges)

    def missing(self, faces: np.ndarray) -> np.ndarray:
        return np.flatnonzero(~self.has(faces))

    def score(self, pairs: np.ndarray, edges: np.ndarray) -> np.ndarray:
        """Faces count double, and the edge between them once: flips that raise the sum must end."""
        faces = self.has(pairs.reshape(-1, 3)).reshape(-1, 2).sum(axis=1)
        return 2 * faces + self.has_edges(edges)


def _to_halve(graph: _Graph, points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """One edge of each face: its longest that is not in the graph, or its longest if all are."""
    sides = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2)
    length = np.linalg.norm(points[sides[:, :, 1]] - points[sides[:, :, 0]], axis=2)
    there = graph.has_edges(sides.reshape(-1, 2)).reshape(-1, 3)
    first = np.where(there, length, length + 2 * length.max()).argmax(axis=1)
    return sides[np.arange(len(faces)), first]
