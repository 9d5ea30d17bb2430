"""Dual polygons in 3D: the cycles of kept tetrahedra around Delaunay edges."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from ..checks import as_indices, shown
from ..errors import InputError
from .arrays import spread_out, unique_rows


class Polygons(Sequence):
    """A list of index arrays of different lengths, stored as two flat arrays.

    Attributes
    ----------
    corners : (c,) int array
        All polygons one after the other.
    sizes : (m,) int array
        How many corners each polygon has.

    Examples
    --------
    >>> cells = Polygons(np.array([4, 5, 6, 0, 1, 2, 3]), np.array([3, 4]))
    >>> len(cells), cells[1].tolist(), [polygon.tolist() for polygon in cells]
    (2, [0, 1, 2, 3], [[4, 5, 6], [0, 1, 2, 3]])
    """

    def __init__(self, corners=(), sizes=()):
        most = np.iinfo(np.intp).max
        self.corners = as_indices(corners, "polygon_corners", most).astype(np.intp, copy=False)
        # Two corners: a sheet of a polyball as thin as rounding, which its own check judges.
        self.sizes = as_indices(sizes, "polygon_sizes", most, low=2).astype(np.intp, copy=False)
        if self.sizes.sum() != len(self.corners):
            raise InputError(
                f"polygons of {self.sizes.sum()} corners in all have {len(self.corners)} corners."
            )
        self._ends = np.cumsum(self.sizes)

    @classmethod
    def of(cls, polygons) -> Polygons:
        """The same from any sequence of index sequences.

        Examples
        --------
        >>> Polygons.of([[0, 1, 2]]).sizes.tolist()
        [3]
        """
        if isinstance(polygons, Polygons):
            return polygons
        if not isinstance(polygons, (Sequence, np.ndarray)) or isinstance(polygons, (str, bytes)):
            raise InputError(f"polygons is {shown(polygons)}; pass a list of lists of vertices.")
        polygons = [as_indices(polygon, f"polygon {k}", 2**31) for k, polygon in enumerate(polygons)]
        return cls(np.concatenate(polygons) if polygons else (), [len(polygon) for polygon in polygons])

    def __len__(self) -> int:
        return len(self.sizes)

    def sides(self) -> np.ndarray:
        """The sides of all polygons one after the other, (s, 2).

        Examples
        --------
        >>> Polygons.of([[0, 1, 2, 3]]).sides().tolist()
        [[0, 1], [1, 2], [2, 3], [3, 0]]
        """
        after = np.arange(1, len(self.corners) + 1)
        after[self._ends - 1] = self._ends - self.sizes
        return np.column_stack([self.corners, self.corners[after]])

    def triangles(self) -> np.ndarray:
        """Every polygon cut into triangles from its first corner, (t, 3).

        Examples
        --------
        >>> Polygons.of([[4, 5, 6], [0, 1, 2, 3]]).triangles().tolist()
        [[4, 5, 6], [0, 1, 2], [0, 2, 3]]
        """
        polygon, along = spread_out(self.sizes - 2)
        first = (self._ends - self.sizes)[polygon]
        along += first + 1
        return self.corners[np.column_stack([first, along, along + 1])]

    def __getitem__(self, k):
        if isinstance(k, slice):
            return [self[i] for i in range(*k.indices(len(self)))]
        k = range(len(self))[k]
        return self.corners[self._ends[k] - self.sizes[k] : self._ends[k]]


# For each edge (i, j) of a positive tetrahedron, the two others (k, l) such that (i, j, k, l) is an even
# permutation: leaving through the facet opposite k turns one way around the edge in every tetrahedron.
_EDGES = np.array([(0, 1, 2, 3), (0, 2, 3, 1), (0, 3, 1, 2), (1, 2, 0, 3), (1, 3, 2, 0), (2, 3, 0, 1)])


def dual_polygons(simplices: np.ndarray, neighbors: np.ndarray, number: np.ndarray, cut=None) -> Polygons:
    """The cycle of kept tetrahedra around every Delaunay edge that they surround.

    Parameters
    ----------
    simplices, neighbors : (t, 4) int arrays
        Positively oriented.
    number : (t + 1,) int array
        Vertex number of each simplex, -1 if it is not kept; the last entry (for no neighbor) is -1.
    cut : (t, 4) bool array, optional
        Facets that may not be crossed.

    Returns
    -------
    Polygons
        Of vertex numbers, in the order of the edges' vertices.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> ring = [(0, 0, -1), (0, 0, 1), (1, 0, 0), (0, 1.1, 0), (-1.2, 0, 0), (0, -1.3, 0)]
    >>> t = psl.delaunay(ring)
    >>> [len(polygon) for polygon in dual_polygons(t.simplices, t.neighbors, np.array([0, 1, 2, 3, -1]))]
    [4]
    """
    kept = np.flatnonzero(number[:-1] >= 0)
    if not len(kept):
        return Polygons()
    cell = np.full(len(number), -1)
    cell[kept] = np.arange(len(kept))
    a, b = simplices[kept][:, _EDGES[:, 0]], simplices[kept][:, _EDGES[:, 1]]
    # A positive tetrahedron seen along the edge the other way turns the other way.
    leave = np.where(a < b, _EDGES[:, 2], _EDGES[:, 3])
    following = cell[np.take_along_axis(neighbors[kept], leave, axis=1)]
    if cut is not None:
        following[np.take_along_axis(cut[kept], leave, axis=1)] = -1
    edge = (np.minimum(a, b) * (simplices.max() + 1) + np.maximum(a, b)).ravel()
    edge, owner, following = _surrounded(edge, np.repeat(np.arange(len(kept)), 6), following.ravel())
    # The record of the same edge in the next tetrahedron.
    position = np.searchsorted(edge * len(kept) + owner, edge * len(kept) + following)
    first = np.flatnonzero(np.diff(edge, prepend=-1))
    corners, length = np.empty(len(edge), dtype=np.int64), np.zeros(len(first), dtype=np.intp)
    # Step around all edges at once, each from its first tetrahedron.
    at, active = first.copy(), np.arange(len(first))
    while len(active):
        corners[first[active] + length[active]] = number[kept[owner[at[active]]]]
        length[active] += 1
        at[active] = position[at[active]]
        active = active[at[active] != first[active]]
    polygon, place = spread_out(length)
    return Polygons(corners[first[polygon] + place], length)


def _surrounded(edge, owner, following):
    """The records of edges with kept tetrahedra all around, sorted by edge (numbered from 0) and owner."""
    order = np.argsort(edge)
    edge, owner, following = edge[order], owner[order], following[order]
    first = np.flatnonzero(np.diff(edge, prepend=-1))
    size = np.diff(first, append=len(edge))
    closed = np.minimum.reduceat(following, first) >= 0
    keep = np.repeat(closed, size)
    edge = np.repeat(np.arange(np.count_nonzero(closed), dtype=np.int64), size[closed])
    owner, following = owner[keep], following[keep]
    # Edge numbers are small, so that both fit into one key of 63 bits: sorting one is many times faster.
    order = np.argsort(edge * (owner.max(initial=0) + 1) + owner)
    return edge, owner[order], following[order]


_PAIRS = list(combinations(range(4), 2))
_OTHERS = [[c for c in range(4) if c not in pair] for pair in _PAIRS]


def edge_rings(simplices, neighbors, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Walk around every edge between two of the first `count` points.

    Parameters
    ----------
    simplices, neighbors : (t, 4) int arrays
        A triangulation in which no such edge is on the outside. Flat and wrongly oriented tetrahedra are
        welcome: only neighbourhood counts.
    count : int

    Returns
    -------
    edges : (e, 2) int array
        Sorted.
    edge, owner, position : (r,) int arrays
        Tetrahedron `owner` is at `position` (from 0) in the ring around `edge`; sorted by edge and owner.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> t = psl.delaunay([(0, 0, -1), (0, 0, 1), (1, 0, 0), (0, 1.1, 0), (-1.2, 0, 0), (0, -1.3, 0)])
    >>> edges, edge, owner, position = edge_rings(t.simplices, t.neighbors, 2)
    >>> edges.tolist(), sorted(position.tolist())
    ([[0, 1]], [0, 1, 2, 3])
    """
    pairs = np.sort(simplices[:, _PAIRS], axis=2).reshape(-1, 2)
    real = np.flatnonzero(pairs[:, 1] < count)
    edges, edge = unique_rows(pairs[real], count)
    owner = real // len(_PAIRS)
    order = np.lexsort((owner, edge))
    edge, owner = edge[order], owner[order]
    beside = neighbors[:, _OTHERS].reshape(-1, 2)[real][order]
    # The record of the same edge in each of the two neighbours that share it.
    key = edge * len(simplices) + owner
    links = np.searchsorted(key, edge[:, None] * len(simplices) + beside)
    at = np.flatnonzero(np.diff(edge, prepend=-1))
    start, before, position = at, links[at, 1], np.zeros(len(edge), dtype=np.int64)
    for step in range(len(simplices)):
        position[at] = step
        after = np.where(links[at, 0] == before, links[at, 1], links[at, 0])
        # In a ring of two both links are the same.
        going = after != start
        at, before, start = after[going], at[going], start[going]
        if not len(at):
            break
    return edges, edge, owner, position
