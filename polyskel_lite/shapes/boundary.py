"""Boundaries: their closed curves, how densely samples cover them, and the measures of what they enclose."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..checks import as_points
from ..errors import InputError
from ..exact import nearest_facets
from ..tables import Described
from .inscribed import Ball, largest_inside
from .meshes import mesh_betti, signed_volume
from .rings import rings_of, turn_of
from .sampling import covering_radius


def only_in(dimension: int, thing, method: str, instead: str, kind: str = "shapes") -> None:
    """Raise `InputError` if a method of a shape, or of a thing of another kind, is not for its dimension.

    Examples
    --------
    >>> from polyskel_lite import Shape
    >>> only_in(3, Shape.from_rings([[(0, 0), (1, 0), (0, 1)]]), "volume", "area()")
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: volume() is for shapes in space; this one is in 2D: use area().
    """
    if thing.dimension != dimension:
        where = "the plane" if dimension == 2 else "space"
        raise InputError(
            f"{method}() is for {kind} in {where}; this one is in {thing.dimension}D: use {instead}."
        )


class Boundary(Described):
    """Oriented facets that enclose a region, and what can be measured on them; `Shape` checks that they do.

    Attributes
    ----------
    points : (n, N) float array
    facets : (m, N) int array

    Examples
    --------
    >>> from polyskel_lite import Shape
    >>> isinstance(Shape.from_rings([[(0, 0), (1, 0), (0, 1)]]), Boundary)
    True
    """

    points: NDArray[np.float64]
    facets: NDArray[np.int64]

    @property
    def dimension(self) -> int:
        """N, the dimension of the space."""
        return self.points.shape[1]

    @property
    def segments(self) -> NDArray[np.float64]:
        """The corners of every facet, (m, N, N): the ends of segments in 2D, of triangles in 3D."""
        return self.points[self.facets]

    def rings(self) -> list[NDArray[np.intp]]:
        """The vertex indices of every closed curve in order, starting at its smallest index (2D only).

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> Shape([(0, 0), (1, 0), (0, 1)], [(1, 2), (0, 1), (2, 0)]).rings()
        [array([0, 1, 2])]
        """
        only_in(2, self, "rings", "facets")
        return rings_of(self.facets)

    def boundary_distance(self, queries: ArrayLike) -> NDArray[np.float64]:
        """Distance (a length, never negative) from each query to the boundary.

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> square = Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]])
        >>> square.boundary_distance([(1, 1), (5, 6)])
        array([1., 5.])
        """
        queries = as_points(queries, name="queries", dimensions=(self.dimension,))
        return nearest_facets(self.segments, queries)[0]

    def largest_ball(self) -> Ball:
        """The largest ball inside: its centre is the place for a label, its diameter the greatest width.

        Of the boundary itself, not of samples. Where balls of this size form a row, as in a bar, it is the
        one in the middle.

        Returns
        -------
        Ball
            With ``center`` and ``radius``, right to rounding.

        Notes
        -----
        Balls grow and move among planes that keep each facet out (linear programs) until they are stuck. They
        begin in cells that are halved as long as one could hold a larger ball; in shapes that are thousands
        of times as long as they are wide, in the 64 most promising ones only.

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> center, radius = Shape.from_rings([[(0, 0), (20, 0), (20, 4), (0, 4)]]).largest_ball()
        >>> center.round(9).tolist(), round(radius, 9)
        ([10.0, 2.0], 2.0)
        """
        return largest_inside(self.points, self.facets)

    def covering_radius(self, E: ArrayLike | None = None) -> float:
        """w⁻¹, the largest distance from a boundary point to the samples (section 2.1); a length.

        Parameters
        ----------
        E : (n, N) array-like, optional
            The samples; by default the vertices of the shape.

        Returns
        -------
        float
            Right to about 1e-9 of itself (1e-6 in 3D): facets are cut as long as a piece could hold the
            maximum.

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> square = Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]])
        >>> round(square.covering_radius(), 6)
        1.0
        """
        E = self.points if E is None else as_points(E, name="E", dimensions=(self.dimension,))
        if not len(E):
            raise InputError("E is empty; pass at least one sample.")
        return covering_radius(self.segments, self.points, E)

    def sampling_density(self, E: ArrayLike | None = None) -> float:
        """The paper's w (section 2.1): one over the largest distance from the boundary to the samples.

        Parameters
        ----------
        E : (n, N) array-like, optional
            The samples; by default the vertices of the shape.

        Returns
        -------
        float
            One over a length; infinite if E covers the boundary, which no finite set does.

        See Also
        --------
        covering_radius : w⁻¹ itself.

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> square = Shape.from_rings([[(0, 0), (4, 0), (4, 4), (0, 4)]])
        >>> round(square.sampling_density(), 6)
        0.5
        """
        return 1 / self.covering_radius(E)

    def area(self) -> float:
        """Area of the region (2D only; in space there are `volume` and `surface`).

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).area()
        4.0
        """
        only_in(2, self, "area", "volume() or surface()")
        a, b = (self.segments - self.points.mean(axis=0)).transpose(1, 0, 2)
        return float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2)

    def length(self) -> float:
        """Length of the boundary, holes included (2D only).

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).length()
        8.0
        """
        only_in(2, self, "length", "surface()")
        return float(np.hypot(*(self.segments[:, 1] - self.segments[:, 0]).T).sum())

    def volume(self) -> float:
        """Volume of the solid, without its cavities (3D only).

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> corner = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        >>> Shape([(0, 0, 0), (3, 0, 0), (0, 3, 0), (0, 0, 4)], corner).volume()
        6.0
        """
        only_in(3, self, "volume", "area()")
        return signed_volume(self.segments)

    def surface(self) -> float:
        """Area of the boundary, cavities included (3D only).

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> corner = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        >>> round(Shape([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], corner).surface(), 6)
        2.366025
        """
        only_in(3, self, "surface", "length()")
        a, b, c = self.segments.transpose(1, 0, 2)
        return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)

    def measure(self) -> float:
        """Area in 2D, volume in 3D.

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).measure()
        4.0
        """
        return self.area() if self.dimension == 2 else self.volume()

    def boundary_measure(self) -> float:
        """Length of the boundary in 2D, its area in 3D.

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).boundary_measure()
        8.0
        """
        return self.length() if self.dimension == 2 else self.surface()

    def betti(self) -> tuple[int, ...]:
        """Betti numbers of the region: (components, holes) in 2D, (components, handles, cavities) in 3D.

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).betti()
        (1, 0)
        """
        if self.dimension == 3:
            return mesh_betti(self.points, self.facets)
        turns = [turn_of(self.points[ring]) for ring in self.rings()]
        return turns.count(1), turns.count(-1)
