"""Solids from fields: a uniform mesh of the zero set, from samples and their Delaunay tetrahedra."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from ..checks import as_number, shown
from ..containment import DelaunayShape
from ..errors import InputError, ShapeError
from ..graphs import delaunay
from ..shapes import Shape
from .fields import Field, as_box
from .isosurface import dense_points, grid_of, spread, topology_of_grid

#: Vertices of one mesh: it takes some minutes, and the grid has no more crossings.
MOST_VERTICES = 50_000


def solid(field: Field | Callable, n: int = 1000, box: ArrayLike | None = None, seed: int = 0) -> Shape:
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
    if not callable(field):
        raise InputError(
            f"field is {shown(field)}; pass a Field, or a function from (k, 3) points to (k,) numbers."
        )
    if box is None:
        box = getattr(field, "box", None)
    if box is None:
        raise InputError("box is missing; pass the two corners of a box around the solid.")
    box = as_box(box)
    what = f"a whole number of vertices, 20 to {MOST_VERTICES:,}"
    n = as_number(n, "n", what, 20, MOST_VERTICES, whole=True)
    seed = as_number(seed, "seed", "a whole number, 0 or more", 0, 2**63, whole=True)
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
    inner = np.asarray(np.isfinite(centers).all(axis=1))
    inner[inner] = field(centers[inner]) < 0
    return DelaunayShape(tessellation, inner).to_shape()
