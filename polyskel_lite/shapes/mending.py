"""Shapes from outlines and meshes that are no boundary as they are, and what was done to them."""

from __future__ import annotations

from os import PathLike
from typing import Any

import numpy as np

from ..checks import as_flag, as_indices, as_points
from ..files import read_file
from .reading import mended, of_mended
from .shape import Shape


def mend(
    boundary: Any,
    *,
    tolerance: float | None = None,
    width: float | None = None,
    largest: bool = False,
    least: float = 0.0,
) -> tuple[Shape, dict[str, int]]:
    """Make a shape from rings or from a mesh that cross or touch themselves, have gaps, or run both ways.

    Parameters
    ----------
    boundary : list of (k, 2) array-like, tuple (V, F), or path
        Rings, of any orientation, as for `Shape.from_rings`; vertices (n, 3) and triangles (m, 3) of a mesh;
        or a file, as for `Shape.from_file`.
    tolerance : float, optional
        Vertices nearer to each other are one. By default a millionth of the size of rings, or the power of
        ten below that, and up to a hundred times as much where that leaves narrow seams; a hundred-thousandth
        of the size of a mesh, of which only vertices at gaps are merged.
    width : float, optional
        Rings only: how wide the boundary is opened where it touches itself, which cuts the shape apart
        there. By default a ten-thousandth of the size, or the power of ten below; 0 leaves it, and then it is
        refused.
    largest : bool
        Keep the part with the largest area or volume only.
    least : float
        Leave out parts with less area or volume than this.

    Returns
    -------
    shape : Shape
    report : dict of str to int
        What was done, and how often; empty for a mesh that was good.

    Raises
    ------
    InputError
        If an array is wrong, a package of the extra ``mend`` is missing, or nothing is left.
    ShapeError
        If it could not be mended.

    Notes
    -----
    Rings: each is filled (nonzero), one inside another one is a hole, those that cross or share an edge are
    united, spikes go. Vertices that stay are not moved. shapely does it. Meshes: vertices at gaps are welded,
    faces there twice dropped, wound alike, holes of up to 100 edges closed (pymeshfix), closed surfaces that
    cross united (manifold3d).

    Examples
    --------
    >>> squares = [[(0, 0), (2, 0), (2, 2), (0, 2)], [(1, 1), (3, 1), (3, 3), (1, 3)]]
    >>> shape, report = mend(squares)
    >>> shape.area(), report
    (7.0, {'rings': 2, 'outlines': 1})
    """
    if isinstance(boundary, (str, PathLike)):
        kind, arrays = read_file(boundary)
    elif isinstance(boundary, tuple) and len(boundary) == 2 and np.shape(boundary[0])[1:] == (3,):
        V = as_points(boundary[0], name="V", dimensions=(3,))
        kind, arrays = "mesh", (V, as_indices(boundary[1], "facets", len(V), 3))
    else:
        kind, arrays = "rings", (boundary,)
    kind, arrays, report = mended(kind, arrays, tolerance, width, as_flag(largest, "largest"), least)
    return of_mended(Shape, kind, arrays), report
