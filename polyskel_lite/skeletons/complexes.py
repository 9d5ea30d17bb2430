"""Vertices with balls, edges and polygons: what branches, axes and files are read off."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..exact import Polygons
from ..tables import Described


class BallComplex(Described):
    """The part of a `Skeleton` that needs no samples; `Skeleton` says what its arrays are.

    Attributes
    ----------
    vertices : (k, N) float array
    radii : (k,) float array
    simplices : (k,) int array
    edges : (e, 2) int array
    polygons : sequence of int arrays

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> isinstance(psl.voronoi([(0, 0), (2, 0), (0, 2)]), BallComplex)
    True
    """

    vertices: NDArray[np.float64]
    radii: NDArray[np.float64]
    simplices: NDArray[np.int64]
    edges: NDArray[np.int64]
    polygons: Polygons

    @property
    def dimension(self) -> int:
        """N, the dimension of the space."""
        return self.vertices.shape[1]

    def segments(self) -> NDArray[np.float64]:
        """End points of every edge, (e, 2, N).

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> psl.voronoi([(0, 0), (4, 0), (0, 2), (4, 3)]).segments().shape
        (1, 2, 2)
        """
        return self.vertices[self.edges]

    def lengths(self) -> NDArray[np.float64]:
        """Length of every edge, (e,).

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> psl.voronoi([(0, 0), (4, 0), (0, 2), (4, 3)]).lengths().round(3).tolist()
        [0.559]
        """
        return np.hypot.reduce(self.vertices[self.edges[:, 1]] - self.vertices[self.edges[:, 0]], axis=1)

    def length(self) -> float:
        """Total length of the edges (rays not counted).

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> psl.voronoi([(0, 0), (2, 0), (0, 2), (2, 2)]).length()
        0.0
        """
        return float(self.lengths().sum())

    def ends(self) -> NDArray[np.intp]:
        """The vertices with exactly one edge, in increasing order.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> psl.voronoi([(0, 0), (4, 0), (0, 2), (4, 3)]).ends().tolist()
        [0, 1]
        """
        return np.flatnonzero(np.bincount(self.edges.ravel()) == 1)
