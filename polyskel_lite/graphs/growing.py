"""A Delaunay tessellation that grows: points come in, simplices are read off."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..checks import check_distinct
from ..errors import TessellationError
from ..exact import whole_numbers
from ..progress import Progress
from .insertion import DEAD, ROWS, TWICE, loops
from .tessellation import Tessellation

#: From so many points on, compiling pays; from so many on, it pays to look whether that was done before.
COMPILE_FROM, LOOK_FROM = 2_000, 200
# Compiled loops insert so many points between two looks at the keyboard.
_CHUNK = 20_000
_used: set[int] = set()  # dimensions whose compiled loops are at hand in this process


def _constants(dimension):
    return {"N": dimension, "M": dimension + 1}


def compiled_wanted(n: int, dimension: int, hard: bool = False) -> bool:
    """Whether n points shall go through compiled loops: they are at hand, or pay for compiling.

    Points that are ``hard`` have no other way: for them it is looked whether the loops have been compiled
    before.

    Examples
    --------
    >>> compiled_wanted(10, 2, hard=True) in (False, compiled_wanted(10, 2))
    True
    """
    if dimension in _used or n < (LOOK_FROM if hard else COMPILE_FROM) or not loops.can_compile():
        return dimension in _used
    if n >= COMPILE_FROM or loops.is_cached(**_constants(dimension)):
        loops.made(True, **_constants(dimension))
        _used.add(dimension)
    return dimension in _used


class Change(NamedTuple):
    """What new points did to a tessellation; -1 is the vertex at infinity.

    Attributes
    ----------
    gone : (k, N+1) int array
        Simplices that were, and facets of the hull with -1.
    come : (m, N+1) int array
        Simplices and facets of the hull that are new.
    apexes : (m, N+1) int array
        What completes the facet opposite each vertex of these on its other side.
    """

    gone: np.ndarray
    come: np.ndarray
    apexes: np.ndarray


class Growing:
    """A Delaunay tessellation into which points come, exact at every time.

    The result is the same whatever the order of the points, compiled or not.

    Parameters
    ----------
    points : (n, N) float array
    ranks : (n,) int array, optional
        Cospherical cells are divided from the vertex of lowest rank, among equals from the first by
        coordinates.
    compiled : bool, optional
        Ask for compiled or plain loops; by default `compiled_wanted` decides.

    Raises
    ------
    DuplicatePointError
        If two points are equal.
    TessellationError
        If all points are in one line or plane.

    Examples
    --------
    >>> triangle = Growing(np.array([(0.0, 0.0), (2.0, 0.0), (0.0, 2.0)]))
    >>> _ = triangle.add(np.array([(3.0, 3.0)]))
    >>> triangle.simplices_and_neighbors()[0].tolist()
    [[0, 1, 2], [1, 3, 2]]
    """

    def __init__(self, points: np.ndarray, ranks: np.ndarray | None = None, compiled: bool | None = None):
        n, self.dimension = points.shape
        self.points = points
        order = _local_order(points)
        self.compiled = (
            compiled_wanted(n, self.dimension, hard=True) if compiled is None else compiled
        ) and _exact(points)
        self._loops = loops.made(self.compiled, **_constants(self.dimension))
        ranks = np.zeros(n, dtype=np.int32) if ranks is None else ranks.astype(np.int32)
        corners = self._loops.corners(*self._numbers(points[order]), n)
        if corners[0] < 0:
            where = "line" if self.dimension == 2 else "plane"
            check_distinct(points)
            raise TessellationError(f"all {n} points are in one {where}; add a point outside of it.")
        for place, k in zip((2, 3), dict.fromkeys(corners), strict=False):
            order[[place, k]] = order[[k, place]]
        self._order, self._ranks = order, ranks[order]
        room = (3 if self.dimension == 2 else 9) * n + 64
        self._table, self._across = (
            self._new(room * (self.dimension + 1), DEAD),
            self._new(room * (self.dimension + 1), 0),
        )
        self._mark, self._free, self._state = self._new(room, 0), self._new(room, 0), self._new(5, 0)
        self._state[TWICE] = -1
        numbers = self._numbers(points[order])
        self._loops.begin(*numbers, self._table, self._across, self._state)
        self._insert(numbers, self.dimension + 1)

    def add(self, points: np.ndarray) -> Change:
        """Insert more points; they are numbered after those that are there. Returns what changed.

        Raises
        ------
        DuplicatePointError
            If one is there already; then nothing more can be done with this tessellation.

        Examples
        --------
        >>> square = Growing(np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]))
        >>> change = square.add(np.array([(1.0, 1.0)]))
        >>> len(change.gone), len(change.come)
        (2, 4)
        """
        before = self._rows(self._table).copy()
        start = len(self.points)
        self.points = np.concatenate([self.points, points])
        self._order = np.concatenate([self._order, start + _local_order(points)])
        self._ranks = np.concatenate([self._ranks, np.zeros(len(points), dtype=np.int32)])
        if self.compiled and not _exact(self.points):
            self._table, self._across, self._mark, self._free, self._state = (
                a.tolist() for a in self._arrays()
            )
            self.compiled, self._loops = False, loops.made(False, **_constants(self.dimension))
        self._insert(self._numbers(self.points[self._order]), start)
        table, across = self._rows(self._table), self._rows(self._across)
        changed = np.ones(len(table), dtype=bool)
        changed[: len(before)] = (table[: len(before)] != before).any(axis=1)
        gone = before[changed[: len(before)] & (before[:, 0] != DEAD)]
        come = np.flatnonzero(changed & (table[:, 0] != DEAD))
        facing = table[across[come]].sum(axis=2) - (table[come].sum(axis=1)[:, None] - table[come])
        label = np.append(self._order, -1)  # a ghost's vertex stays -1
        return Change(label[gone], label[table[come]], label[facing])

    def simplices_and_neighbors(self) -> tuple[np.ndarray, np.ndarray]:
        """Simplices (t, N+1), positively oriented, and neighbors (t, N+1), in the order of `canonical`.

        Examples
        --------
        >>> Growing(np.array([(0.0, 0.0), (2.0, 0.0), (0.0, 2.0)])).simplices_and_neighbors()[1].tolist()
        [[-1, -1, -1]]
        """
        table, across = self._rows(self._table), self._rows(self._across)
        solid = table.min(axis=1) >= 0
        if self.compiled:
            out = np.empty((2, np.count_nonzero(solid), self.dimension + 1), dtype=np.int64)
            room = self._new(len(self.points) + 1, 0), self._new(len(table), 0)
            self._loops.collect(
                len(table), self._table, self._across, self._order.astype(np.int32), *room, *out
            )
            return out[0], out[1]
        number = np.where(solid, np.cumsum(solid) - 1, -1)
        table, across = self._order[table[solid]], number[across[solid]]
        if self.dimension == 3:  # `turn_3d` calls those positive that the library calls negative
            table, across = table[:, [1, 0, 2, 3]], across[:, [1, 0, 2, 3]]
        return canonical(table, across)

    def tessellation(self) -> Tessellation:
        """The tessellation as it is now.

        Examples
        --------
        >>> Growing(np.array([(0.0, 0.0), (2.0, 0.0), (0.0, 2.0)])).tessellation().circumcenters.tolist()
        [[1.0, 1.0]]
        """
        return Tessellation.trusted(self.points, *self.simplices_and_neighbors())

    def _rows(self, flat) -> np.ndarray:
        rows, size = self._state[ROWS], self.dimension + 1
        return np.asarray(flat[: rows * size], dtype=np.int32).reshape(rows, size)

    def _arrays(self):
        return self._table, self._across, self._mark, self._free, self._state

    def _new(self, n, fill):
        return np.full(n, fill, dtype=np.int32) if self.compiled else [fill] * n

    def _numbers(self, points):
        scaled = np.ldexp(points, -_exponent(points)).ravel()
        return (
            (scaled, whole_numbers(scaled, True))
            if self.compiled
            else (scaled.tolist(), whole_numbers(points, False))
        )

    def _insert(self, numbers, start) -> None:
        ranks = self._ranks if self.compiled else self._exact_ranks().tolist()
        end = len(self._order)
        with Progress("Delaunay tessellation", end) as progress:
            while start < end:
                stop = min(start + (_CHUNK if self.compiled else _CHUNK // 100), end)
                start = self._loops.insert(*numbers, ranks, start, stop, *self._arrays())
                if self._state[TWICE] >= 0:
                    check_distinct(self.points)
                if start < stop:
                    self._widen()
                progress.at(start)

    def _exact_ranks(self) -> np.ndarray:
        """Ranks that decide alone where the scaled coordinates of different points may be equal."""
        points = self.points[self._order]
        if _exact(points):
            return self._ranks
        rows = np.column_stack([self._ranks, points])
        return np.unique(rows, axis=0, return_inverse=True)[1].ravel()

    def _widen(self) -> None:
        more = len(self._mark)
        for name, fill, each in (("_table", DEAD, 1), ("_across", 0, 1), ("_mark", 0, 0), ("_free", 0, 0)):
            array, new = getattr(self, name), self._new(more * (self.dimension + 1 if each else 1), fill)
            setattr(self, name, np.concatenate([array, new]) if self.compiled else array + new)


def _exponent(points) -> int:
    return int(np.frexp(np.abs(points).max())[1])


def _exact(points) -> bool:
    """Whether the power of two that brings the coordinates below one loses no digit."""
    exponent = _exponent(points)
    return bool((np.ldexp(np.ldexp(points, -exponent), exponent) == points).all())


# Even permutations that bring a corner to the front, then the least of the other three to the second place.
_TURNS = {
    3: [np.array([(0, 1, 2), (1, 2, 0), (2, 0, 1)])],
    4: [
        np.array([(0, 1, 2, 3), (1, 0, 3, 2), (2, 0, 1, 3), (3, 0, 2, 1)]),
        np.array([(0, 1, 2, 3), (0, 2, 3, 1), (0, 3, 1, 2)]),
    ],
}


def canonical(simplices: np.ndarray, neighbors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The same in one order: rows and vertices increasing, but for the last two of odd simplices.

    Examples
    --------
    >>> canonical(np.array([[3, 1, 2], [1, 0, 2]]), np.array([[1, -1, -1], [-1, 0, -1]]))[0].tolist()
    [[0, 2, 1], [1, 2, 3]]
    """
    size = simplices.shape[1]
    for k, turns in enumerate(_TURNS[size]):
        turn = turns[simplices[:, k:].argmin(axis=1)]
        simplices, neighbors = (np.take_along_axis(array, turn, axis=1) for array in (simplices, neighbors))
    order = np.lexsort(simplices.T[::-1])
    new = np.append(np.argsort(order), -1)
    return simplices[order], new[neighbors[order]]


def _local_order(points: np.ndarray) -> np.ndarray:
    """Random rounds, each eight times the last, and neighbours in turn within a round: along Morton's curve.

    Amenta, Choi and Rote, Incremental constructions con BRIO, 2003.
    """
    n, dimension = points.shape
    low, high = points.min(axis=0) / 2, points.max(axis=0) / 2
    bits = 48 // dimension
    span = max((high - low).max(), 2.0**-1000)
    cells = ((points / 2 - low) / span * (2**bits - 1)).astype(np.uint64)
    spread = np.zeros(256, dtype=np.uint64)
    for bit in range(8):
        spread |= ((np.arange(256, dtype=np.uint64) >> np.uint64(bit)) & np.uint64(1)) << np.uint64(
            bit * dimension
        )
    key = np.zeros(n, dtype=np.uint64)
    for axis in range(dimension):
        for byte in range(bits // 8):
            part = spread[(cells[:, axis] >> np.uint64(8 * byte)) & np.uint64(255)]
            key |= part << np.uint64(8 * byte * dimension + axis)
    shuffled = np.random.default_rng(0).permutation(n)
    rounds, end = [], n
    while end > 0:
        start = end // 8 if end > 500 else 0
        block = shuffled[start:end]
        rounds.append(block[np.argsort(key[block], kind="stable")])
        end = start
    return np.concatenate(rounds[::-1])
