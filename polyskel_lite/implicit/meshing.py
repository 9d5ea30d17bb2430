"""Solids from fields: a uniform mesh of the zero set, from samples and their Delaunay tetrahedra."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..checks import as_points
from ..containment import DelaunayShape
from ..errors import InputError, ShapeError
from ..graphs import delaunay
from ..shapes import Shape
from .fields import Field
from .isosurface import dense_points, grid_of, spread, topology_of_grid


def solid(field: Field | Callable, n: int = 1000, box=None, seed: int = 0) -> Shape:
    """A uniform closed mesh of an implicit surface, with all its triangles in Del(E).

    Parameters
    ----------
    field : Field or callable
        Negative inside.
    n : int
        Number of vertices, spread evenly on the surface.
    box : (2, 3) array-like, optional
        Two corners of a box around the solid; needed for a plain function.
    seed : int
        The same seed gives the same mesh.

    Returns
    -------
    Shape
        With ``n`` vertices, or a few less: those that end inside the solid are dropped.

    Raises
    ------
    InputError
        If the surface is not wholly inside the box, or ``n`` is too small.
    ShapeError
        If no seed gave a manifold mesh with the topology that the field has on a grid: ``n`` is too
        small for the thinnest part.

    Notes
    -----
    Candidates on the surface are thinned to ``n`` points and evened out by Lloyd's iteration; they
    leave the surface by a hundred-thousandth of their spacing, so that no five are on one sphere.
    The Delaunay tetrahedra with their circumcenter inside the solid are the mesh's inside, so its
    faces are Delaunay faces by construction.

    Examples
    --------
    >>> from polyskel_lite.implicit import torus
    >>> ring = solid(torus(), n=300)
    >>> len(ring.points), ring.betti()
    (300, (1, 1, 0))
    """
    if box is None:
        box = getattr(field, "box", None)
    if box is None:
        raise InputError("box is missing; pass the two corners of a box around the solid.")
    box = as_points(box, name="box", dimensions=(3,))
    if box.shape != (2, 3) or not (box[0] < box[1]).all():
        raise InputError("box must have two rows, its lowest and its highest corner.")
    if n < 20:
        raise InputError(f"n = {n} vertices; a smooth surface needs 20 or more.")
    grid = grid_of(field, box, n)
    wanted, reason = topology_of_grid(grid.inside), ""
    for attempt in range(6):
        random = np.random.default_rng([seed, attempt])
        points, weights, spacing = dense_points(field, grid, n, random)
        samples = spread(field, points, weights, n, spacing, random)
        try:
            shape = _mesh(field, samples)
        except ShapeError as error:
            reason = str(error)
            continue
        if shape.betti() == wanted:
            return shape
        reason = f"its Betti numbers are {shape.betti()}, those of the field on a grid {wanted}."
    raise ShapeError(f"{n} samples make no mesh of this surface; ask for more. The last try: {reason}")


def _mesh(field, samples: np.ndarray) -> Shape:
    tessellation = delaunay(samples)
    centers = tessellation.circumcenters
    far = ~np.isfinite(centers).all(axis=1)
    inner = ~far
    inner[inner] = field(centers[inner]) < 0
    return DelaunayShape(tessellation, inner).to_shape()
