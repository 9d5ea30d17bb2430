"""Boundaries in the graphs of their own vertices: contour containment and refinement (sections 3.4 and 3.5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .errors import ContourContainmentError, InputError, TessellationError
from .graphs import Tessellation, delaunay, gabriel_mask
from .predicates import orientation
from .segments import point_segment_distance
from .shapes import Shape
from .topology import components

_GRAPHS = ("delaunay", "gabriel")


def facet_rows(tessellation: Tessellation, facets: np.ndarray) -> np.ndarray:
    """The row of ``tessellation.facet_table`` of each facet, in any vertex order; -1 if it is not Delaunay.

    Examples
    --------
    >>> facet_rows(delaunay([(0, 0), (4, 0), (4, 1), (0, 1), (2, 3)]), np.array([[1, 0], [0, 4]])).tolist()[1]
    -1
    """
    n = len(tessellation.points)

    def keys(rows):
        rows = np.sort(np.asarray(rows, dtype=np.int64), axis=1)
        # n**3 fits in 63 bits for two million points.
        return (rows * n ** np.arange(rows.shape[1])[::-1]).sum(axis=1)

    table = keys(tessellation.facets())
    order = np.argsort(table)
    wanted = keys(facets)
    at = np.searchsorted(table[order], wanted)
    at[at == len(table)] = 0
    row = order[at]
    return np.where(table[row] == wanted, row, -1)


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
    _check_name(of)
    tessellation = tessellation or delaunay(shape.points)
    rows = facet_rows(tessellation, shape.facets)
    missing = rows < 0
    if of == "gabriel":
        missing[~missing] = ~gabriel_mask(tessellation, closed=True, rows=rows[~missing])
    return np.flatnonzero(missing)


def conform(shape: Shape, to: str = "gabriel") -> Shape:
    """Add boundary points until every facet is in the strict Gabriel graph, or in the Delaunay tessellation.

    Parameters
    ----------
    shape : Shape
    to : "gabriel" or "delaunay"
        "gabriel" makes Theorems 1 and 2 apply, "delaunay" makes Sk0 defined.

    Returns
    -------
    Shape
        The given vertices first, with their indices and coordinates; the added ones after them.

    Raises
    ------
    TessellationError
        If floats are too coarse to halve a segment further.

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
    _check_name(to)
    points, facets = list(map(tuple, shape.points.tolist())), list(map(tuple, shape.facets.tolist()))
    acute = _acute_corners(shape)
    while True:
        array = np.array(points)
        tessellation = delaunay(array)
        current = np.array(facets)
        rows = facet_rows(tessellation, current)
        missing = rows < 0
        if to == "gabriel":
            missing[~missing] = ~gabriel_mask(tessellation, closed=True, rows=rows[~missing])
        if not missing.any():
            break
        cuts: dict[int, np.ndarray] = {}
        corners = acute & set(current[missing].ravel().tolist())
        for corner in sorted(corners):
            _cut_corner(corner, array, current, cuts)
        acute -= corners
        for k in np.flatnonzero(missing).tolist():
            if k not in cuts and not corners & set(facets[k]):
                cuts[k] = array[current[k]].mean(axis=0)[None]
        _insert(points, facets, cuts)
    return Shape(array, current) if len(points) > len(shape.points) else shape


def _insert(points, facets, cuts) -> None:
    for k, cut in cuts.items():
        a, b = facets[k]
        chain = [a]
        for point in map(tuple, cut.tolist()):
            if point in (points[a], points[b]):
                raise TessellationError(
                    f"the segment from {points[a]} to {points[b]} is too short to be halved in floats; "
                    "remove vertices that nearly coincide, or move the shape nearer to the origin."
                )
            chain.append(len(points))
            points.append(point)
        chain.append(b)
        pieces = list(zip(chain[:-1], chain[1:], strict=True))
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
    """Cut both sides at ``corner`` at one distance, a third of what keeps the cut away from everything else."""
    at = (facets == corner).any(axis=1)
    other = np.where(facets[at, 0] == corner, facets[at, 1], facets[at, 0])
    lengths = np.sqrt(((points[other] - points[corner]) ** 2).sum(axis=1))
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


@dataclass(frozen=True, eq=False)
class DelaunayShape:
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
    inner: np.ndarray

    def __post_init__(self):
        inner = np.asarray(self.inner)
        if inner.dtype != bool or inner.shape != (len(self.tessellation.simplices),):
            raise InputError(
                f"inner has shape {inner.shape} and type {inner.dtype}; pass one bool for each of the "
                f"{len(self.tessellation.simplices)} simplices."
            )
        object.__setattr__(self, "inner", inner)

    @property
    def dimension(self) -> int:
        """N, the dimension of the space."""
        return self.tessellation.dimension

    def boundary_rows(self) -> np.ndarray:
        """Rows of ``tessellation.facet_table`` with the region on exactly one side, (m,) bool array.

        Examples
        --------
        >>> delaunay_shape(Shape.from_rings([[(0, 0), (2, 0), (0, 2)]])).boundary_rows().tolist()
        [True, True, True]
        """
        inside = np.append(self.inner, False)[self.tessellation.facet_table[1]]
        return inside[:, 0] != inside[:, 1]

    def boundary(self) -> np.ndarray:
        """The oriented facets between the region and the rest, (m, N), region on the left (2D) or behind (3D).

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
        >>> ears = delaunay([(5, 0), (3, 4), (-3, 4), (-5, 0), (-3, -4), (3, -4)])
        >>> DelaunayShape(ears, np.ones(4, dtype=bool)).betti()
        (1, 0)
        """
        t, corners = self.tessellation.simplices.shape
        simplices = self.tessellation.simplices[self.inner]
        pairs = np.unique(
            np.sort(np.concatenate([simplices[:, [i, j]] for i in range(corners) for j in range(i)]), axis=1),
            axis=0,
        )
        used, pairs = np.unique(pairs, return_inverse=True)
        pairs = pairs.reshape(-1, 2)
        b0 = components(len(used), pairs)[0]
        # Alexander duality: cavities (holes in 2D) are the bounded components of the open complement.
        facets, sides = self.tessellation.facet_table
        inside = np.append(self.inner, False)[sides]
        free = sides[~inside.any(axis=1)]
        outside = np.flatnonzero(~self.inner)
        number = np.full(t + 1, -1)
        number[outside] = np.arange(len(outside))
        number[t] = len(outside)  # beyond the hull
        cavities = components(len(outside) + 1, number[np.where(free < 0, t, free)])[0] - 1
        if self.dimension == 2:
            return b0, cavities
        triangles = int(inside.any(axis=1).sum())
        characteristic = len(used) - len(pairs) + triangles - len(simplices)
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
    polyskel_lite.errors.ContourContainmentError: 1 of 6 facets (first: 0, vertices 0-1 near (5, 0)) are not ...
    """
    tessellation = delaunay(shape.points)
    rows = facet_rows(tessellation, shape.facets)
    missing = np.flatnonzero(rows < 0)
    if len(missing):
        first = missing[0]
        middle = ", ".join(f"{x:g}" for x in shape.points[shape.facets[first]].mean(axis=0))
        raise ContourContainmentError(
            f"{len(missing)} of {len(shape.facets)} facets (first: {first}, vertices "
            f"{'-'.join(map(str, shape.facets[first]))} near ({middle})) are not in the Delaunay tessellation of "
            'the vertices; sample the boundary more densely, or call conform(shape, to="delaunay").',
            missing,
        )
    sides, apexes = tessellation.facet_table[1], tessellation.apexes()
    t = len(tessellation.simplices)
    wall = np.zeros(len(sides), dtype=bool)
    wall[rows] = True
    # Simplices connected without crossing the boundary are on one side of it; node t is the unbounded rest.
    _, label = components(t + 1, np.where(sides < 0, t, sides)[~wall])
    left = orientation(tessellation.points[np.column_stack([shape.facets, apexes[rows, 0]])]) > 0
    inside = np.zeros(label.max() + 1, dtype=bool)
    inner_side = np.where(left, 0, 1)
    inside[label[sides[rows, inner_side]]] = True
    return DelaunayShape(tessellation, inside[label[:t]])


def _check_name(graph: str) -> None:
    if graph not in _GRAPHS:
        raise InputError(f"unknown graph {graph!r}; choose one of {', '.join(_GRAPHS)}.")
