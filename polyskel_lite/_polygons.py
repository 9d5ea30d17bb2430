"""Dual polygons in 3D: the cycles of kept tetrahedra around Delaunay edges."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


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
        self.corners = np.asarray(corners, dtype=np.int64)
        self.sizes = np.asarray(sizes, dtype=np.int64)
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
        polygons = [np.asarray(polygon, dtype=np.int64) for polygon in polygons]
        return cls(np.concatenate(polygons) if polygons else (), [len(polygon) for polygon in polygons])

    def __len__(self) -> int:
        return len(self.sizes)

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
    ends = np.sort(simplices[kept][:, _EDGES[:, :2]], axis=2).reshape(-1, 2)
    tetrahedron = np.repeat(kept, 6)
    leave = np.tile(_EDGES[:, 2], len(kept))
    # A positive tetrahedron seen along the edge the other way turns the other way.
    flipped = simplices[tetrahedron, np.tile(_EDGES[:, 0], len(kept))] != ends[:, 0]
    leave[flipped] = np.tile(_EDGES[:, 3], len(kept))[flipped]
    following = neighbors[tetrahedron, leave]
    open_side = number[following] < 0
    if cut is not None:
        open_side |= cut[tetrahedron, leave]
    key = ends[:, 0] * (simplices.max(initial=0) + 1) + ends[:, 1]
    order = np.lexsort((tetrahedron, key))
    key, tetrahedron, following, open_side = (
        key[order],
        tetrahedron[order],
        following[order],
        open_side[order],
    )
    first = np.flatnonzero(np.append(True, key[1:] != key[:-1])) if len(key) else np.zeros(0, dtype=np.int64)
    size = np.diff(np.append(first, len(key)))
    blocked = np.add.reduceat(open_side, first) > 0 if len(first) else np.zeros(0, dtype=bool)
    first, size = first[~blocked], size[~blocked]
    # Step around all edges at once; the records of one edge are sorted by tetrahedron.
    at, corners, length = (
        first.copy(),
        np.empty(size.sum(), dtype=np.int64),
        np.zeros(len(first), dtype=np.int64),
    )
    begin = np.cumsum(size) - size
    active = np.arange(len(first))
    position = _positions(key, tetrahedron, following, open_side)
    for step in range(int(size.max(initial=0))):
        corners[begin[active] + step] = number[tetrahedron[at[active]]]
        at[active] = position[at[active]]
        length[active] += 1
        active = active[at[active] != first[active]]
        if not len(active):
            break
    return _compact(corners, begin, length)


def _positions(key, tetrahedron, following, open_side):
    """Index of the record (same edge, next tetrahedron) of each record."""
    span = tetrahedron.max(initial=0) + 1
    # Ranks keep the combined key within 63 bits.
    rank = np.cumsum(np.append(False, key[1:] != key[:-1])) if len(key) else key
    own = rank * span + tetrahedron
    found = np.searchsorted(own, rank * span + np.where(open_side, 0, following))
    return np.minimum(found, max(len(own) - 1, 0))


def _compact(corners, begin, length) -> Polygons:
    keep = np.zeros(len(corners), dtype=bool)
    keep[
        np.repeat(begin, length) + np.arange(length.sum()) - np.repeat(np.cumsum(length) - length, length)
    ] = True
    return Polygons(corners[keep], length)
