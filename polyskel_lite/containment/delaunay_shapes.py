"""Regions made of Delaunay simplices: the polygonal P_w whose dual is Sk0 (section 3.4)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..checks import as_array, as_instance, near
from ..errors import ContourContainmentError, InputError
from ..exact import components, orientation
from ..graphs import Tessellation, facet_rows, gabriel_mask
from ..shapes import Shape, check_shape
from ..tables import Described, bounds_and_betti


@dataclass(frozen=True, eq=False, repr=False)
class DelaunayShape(Described):
    """A region made of Delaunay simplices: the paper's P_w, whose dual is Sk0 (section 3.4).

    Attributes
    ----------
    tessellation : Tessellation
    inner : (t,) bool array
        The simplices that make up the region.

    Examples
    --------
    >>> shape = delaunay_shape(Shape.from_rings([[(0, 0), (2, 0), (2, 2), (1, 1), (0, 2)]]))
    >>> int(shape.inner.sum()), shape.betti()
    (3, (1, 0))
    """

    tessellation: Tessellation
    inner: NDArray[np.bool_]

    if TYPE_CHECKING:  # what is given may be any array-like, what is kept is an array

        def __init__(self, tessellation: Tessellation, inner: ArrayLike) -> None: ...

    def _facts(self) -> Iterator[tuple[str, object]]:
        kind = "triangles" if self.dimension == 2 else "tetrahedra"
        yield f"inner {kind} of {len(self.inner):,}", int(np.count_nonzero(self.inner))
        yield from bounds_and_betti(self.used_points(), self.betti)

    def __post_init__(self):
        as_instance(
            self.tessellation, Tessellation, "tessellation", "a Tessellation, such as delaunay(points)"
        )
        inner = as_array(self.inner, "inner", "one bool for each simplex")
        if inner.dtype != bool or inner.shape != (len(self.tessellation.simplices),):
            raise InputError(
                f"inner has shape {inner.shape} and type {inner.dtype}; pass one bool for each of the "
                f"{len(self.tessellation.simplices)} simplices."
            )
        object.__setattr__(self, "inner", inner.copy())
        self.inner.setflags(write=False)

    @property
    def dimension(self) -> int:
        """N, the dimension of the space."""
        return self.tessellation.dimension

    def used_points(self) -> NDArray[np.float64]:
        """The samples that are corners of inner simplices, (u, N).

        Examples
        --------
        >>> len(delaunay_shape(Shape.from_rings([[(0, 0), (2, 0), (0, 2)]])).used_points())
        3
        """
        return self.tessellation.points[np.unique(self.tessellation.simplices[self.inner])]

    def boundary_rows(self) -> NDArray[np.bool_]:
        """Rows of ``tessellation.facet_table`` with the region on exactly one side, (m,) bool array.

        Examples
        --------
        >>> delaunay_shape(Shape.from_rings([[(0, 0), (2, 0), (0, 2)]])).boundary_rows().tolist()
        [True, True, True]
        """
        inside = np.append(self.inner, False)[self.tessellation.facet_table[1]]
        return inside[:, 0] != inside[:, 1]

    def boundary(self) -> NDArray[np.int64]:
        """The oriented facets (m, N) around the region, which is on their left (2D) or behind them (3D).

        Examples
        --------
        >>> delaunay_shape(Shape.from_rings([[(0, 0), (2, 0), (0, 2)]])).boundary().tolist()
        [[0, 1], [1, 2], [2, 0]]
        """
        rows = np.flatnonzero(self.boundary_rows())
        facets = self.tessellation.facets()[rows].copy()
        sides, apexes = self.tessellation.facet_table[1][rows], self.tessellation.apexes()[rows]
        inside = np.append(self.inner, False)[sides[:, 1]].astype(int)
        apex = apexes[np.arange(len(rows)), inside]
        turned = orientation(self.tessellation.points[np.column_stack([facets, apex])])
        # In 2D an edge with the apex on its left is positive; in 3D an outward triangle sees it behind.
        wrong = turned < 0 if self.dimension == 2 else turned > 0
        facets[wrong, :2] = facets[wrong, 1::-1]
        return facets[np.lexsort(facets.T[::-1])]

    def betti(self) -> tuple[int, ...]:
        """Betti numbers of the closed region: (b0, b1) in 2D, (b0, b1, b2) in 3D.

        Components that touch in a vertex (or, in 3D, in an edge) count as one here and as two in Sk0,
        which is homotopy equivalent to the *interior*.

        Examples
        --------
        >>> from polyskel_lite import delaunay
        >>> ears = delaunay([(5, 0), (3, 4), (-3, 4), (-5, 0), (-3, -4), (3, -4)])
        >>> DelaunayShape(ears, np.ones(4, dtype=bool)).betti()
        (1, 0)
        """
        (t, _), n = self.tessellation.simplices.shape, len(self.tessellation.points)
        simplices = self.tessellation.simplices[self.inner]
        used = np.zeros(n, dtype=bool)
        used[simplices] = True
        spokes = np.stack(
            [np.broadcast_to(simplices[:, :1], simplices[:, 1:].shape), simplices[:, 1:]], axis=2
        )
        b0 = components(n, spokes)[0] - int((~used).sum())
        # Alexander duality: cavities (holes in 2D) are the bounded components of the open complement.
        sides = self.tessellation.facet_table[1]
        inside = np.append(self.inner, False)[sides].any(axis=1)
        # Every simplex inside is a component of its own here, and node t is what is beyond the hull.
        free = sides[~inside]
        cavities = components(t + 1, np.where(free < 0, t, free))[0] - len(simplices) - 1
        if self.dimension == 2:
            return b0, cavities
        edges = len(self.tessellation.edges(self.inner))
        characteristic = int(used.sum()) - edges + int(inside.sum()) - len(simplices)
        return b0, b0 + cavities - characteristic, cavities

    def is_gabriel(self, closed: bool = True) -> bool:
        """Whether the whole boundary is in the Gabriel graph, the premise of Theorems 1 and 2; exact.

        Examples
        --------
        >>> thin = delaunay_shape(Shape.from_rings([[(0, 0), (4, 0), (2, 1)]]))
        >>> thin.is_gabriel()
        False
        """
        return bool(gabriel_mask(self.tessellation, closed, rows=self.boundary_rows()).all())

    def to_shape(self) -> Shape:
        """The region as a `Shape`; the unused samples are dropped.

        Raises
        ------
        ShapeError
            If the region touches itself in a vertex.

        Examples
        --------
        >>> triangle = Shape.from_rings([[(0, 0), (2, 0), (0, 2)]])
        >>> delaunay_shape(triangle).to_shape().area()
        2.0
        """
        used, facets = np.unique(self.boundary(), return_inverse=True)
        return Shape(self.tessellation.points[used], facets.reshape(-1, self.dimension))


def delaunay_shape(shape: Shape) -> DelaunayShape:
    """Sort the Delaunay simplices of a shape's vertices into inner and outer ones (section 3.4).

    Parameters
    ----------
    shape : Shape
        Its boundary must be in Del(E), E being its vertices (contour containment).

    Returns
    -------
    DelaunayShape
        Labels are found by crossing facets, so no inside test is rounded.

    Raises
    ------
    ContourContainmentError
        If a facet is not Delaunay; ``.missing`` lists the indices. `conform` repairs that.

    Examples
    --------
    >>> pair = Shape.from_rings([[(0, 0), (10, 0), (5, 1)], [(5, -1), (4, -3), (6, -3)]])
    >>> delaunay_shape(pair)  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    polyskel_lite.errors.ContourContainmentError: 1 of 6 facets (first: 0, vertices 0-1 near (5, 0)) ...
    """
    check_shape(shape)
    tessellation = shape.tessellation
    rows = facet_rows(tessellation, shape.facets)
    missing = np.flatnonzero(rows < 0)
    if len(missing):
        first = missing[0]
        raise ContourContainmentError(
            f"{len(missing)} of {len(shape.facets)} facets (first: {first}, vertices "
            f"{'-'.join(map(str, shape.facets[first]))} near {near(shape.points[shape.facets[first]])}) are "
            "not in the Delaunay tessellation of the vertices; sample the boundary more densely, or call "
            'conform(shape, to="delaunay").',
            missing,
        )
    sides, apexes = tessellation.facet_table[1], tessellation.apexes()
    turned = orientation(tessellation.points[np.column_stack([shape.facets, apexes[rows, 0]])])
    # In 2D the inner apex is on the left of its segment, in 3D it is behind its outward triangle.
    first = turned > 0 if shape.dimension == 2 else turned < 0
    # Labels (1 inside, -1 outside, 0 not known yet) spread from the boundary, which they do not cross.
    label = np.zeros(len(tessellation.simplices) + 1, dtype=np.int8)
    label[-1] = -1  # beyond the hull
    label[sides[rows]] = np.where(first[:, None], [1, -1], [-1, 1])
    free = np.ones(len(sides), dtype=bool)
    free[rows] = False
    a, b = sides[free].T
    while True:
        one, other = label[a], label[b]
        open_ = np.flatnonzero((one == 0) | (other == 0))
        if not len(open_):
            return DelaunayShape(tessellation, label[:-1] > 0)
        a, b, one, other = a[open_], b[open_], one[open_], other[open_]
        label[a[other != 0]], label[b[one != 0]] = other[other != 0], one[one != 0]
