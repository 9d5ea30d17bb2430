"""The one hot loop of section 4: remove hats and salients, smallest criterion first.

`remove_in_order` is plain Python on flat sequences. With numba installed (the extra ``fast``) it is compiled,
without it the same lines run as they are; the results are the same.
"""

from __future__ import annotations

import sys
from heapq import heappop, heappush

import numpy as np

from ..compiling import Loops
from ..progress import Progress

_RULES = {"branch": 0, "surface": 1, "wireframe": 2}
_INF = float("inf")
# Simplices removed between two looks at the keyboard.
_CHUNK = 500_000
# For fewer simplices numba is not fetched.
_COMPILE_FROM = 4_000
loops = Loops()
_INTS, _FLOATS = "int64[::1]", "float64[::1]"


@loops(
    f"int64(int64, int64, boolean, {_INTS}, {_INTS}, boolean[::1], {_INTS}, {_FLOATS}, {_FLOATS}, {_FLOATS}, "
    f"{_FLOATS}, {_INTS}, int64, int64)"
)
def remove_in_order(
    size,
    rule,
    printed,
    simplices,
    neighbors,
    alive,
    count,
    share,
    values,
    radii,
    keys,
    order,
    removed,
    stop,
):
    """Remove simplices until none can go, or so many are gone; fills ``keys`` and ``order``.

    It may be called again to go on: nothing is removed in another order.

    Parameters
    ----------
    size : int
        Corners of a simplex: 3 or 4.
    rule : int
        0 branch, 1 surface, 2 wireframe.
    printed : bool
        The criteria as the paper prints them.
    simplices, neighbors : flat sequences of int
        Row after row.
    alive : sequence of bool
        The simplices of the shape; changed.
    count : sequence of int
        How many neighbours of each are alive, or were when it went; changed.
    share : sequence of float
        p(v): the boundary each simplex stands for; changed.
    values : flat sequence of float
        Length or area of the facet opposite each corner; for the surface rule the angles of its six pairs.
    radii : sequence of float
    keys, order : sequences
        Results: the criterion of each when it goes, and which one is the first, second, ... to go.
    removed, stop : int
        How many are gone, and how many shall be.

    Returns
    -------
    int
        How many are gone; fewer than ``stop`` when no more can go.
    """
    heap = [(0.0, 0.0, 0, 0)]
    heappop(heap)
    todo = [v for v in range(len(alive)) if alive[v]]
    while removed < stop:
        while len(todo) > 0:
            v = todo.pop()
            c = count[v]
            key = 0.0
            if c == 1:
                if rule == 1:
                    key = -_INF
                else:
                    p = share[v]
                    if printed and rule == 0:
                        for i in range(size):  # the perimeter of A(v) has its inner side as well
                            n = neighbors[size * v + i]
                            if n >= 0 and alive[n]:
                                p += values[size * v + i]
                    key = p / radii[v]
                    if rule == 2 and not printed:
                        key /= radii[v]
            elif c == 2 and size == 4 and rule > 0:
                if rule == 2:
                    key = -_INF
                else:
                    pair = 0
                    for i in range(4):
                        n = neighbors[4 * v + i]
                        if n < 0 or not alive[n]:
                            for j in range(i + 1, 4):
                                n = neighbors[4 * v + j]
                                if n < 0 or not alive[n]:
                                    pair = i * (7 - i) // 2 + j - i - 1
                    key = values[6 * v + pair]
            else:
                continue
            heappush(heap, (key, radii[v], v, c))
        if len(heap) == 0:
            return removed
        key, _, v, c = heappop(heap)
        if not alive[v] or count[v] != c:
            continue
        if c == 2:
            # Salient only if the edge of its two inner facets is inner: turn around it till back or out.
            a, b, leave = -1, -1, -1
            for i in range(4):
                n = neighbors[4 * v + i]
                if n >= 0 and alive[n]:
                    leave = i
                elif a < 0:
                    a = simplices[4 * v + i]
                else:
                    b = simplices[4 * v + i]
            s = v
            while True:
                r = neighbors[4 * s + leave]
                if r < 0 or not alive[r] or r == v:
                    break
                following = -1
                for i in range(4):
                    x = simplices[4 * r + i]
                    if x != a and x != b and neighbors[4 * r + i] != s:
                        following = i
                s = r
                leave = following
            if r != v:
                continue
        alive[v] = False
        keys[v] = key
        order[removed] = v
        removed += 1
        k = size - c if printed else c
        for i in range(size):
            n = neighbors[size * v + i]
            if n >= 0 and alive[n]:
                count[n] -= 1
                share[n] += share[v] / k
                todo.append(n)
    return removed


def run(rule: str, printed: bool, simplices, neighbors, values, radii, compiled: bool | None = None):
    """Levels, kinds and order of removal for the simplices of a region, numbered from 0.

    Parameters
    ----------
    rule : "branch", "surface" or "wireframe"
    printed : bool
    simplices, neighbors : (t, N+1) int arrays
        Across the region's boundary the neighbor is -1.
    values : (t, N+1) float array
        Lengths or areas of the facets; for "surface" the angles of their pairs, (t, 6).
    radii : (t,) float array
    compiled : bool, optional
        Ask for the compiled or the plain loop; by default the compiled one for many
        simplices, or where numba is in use.

    Returns
    -------
    level : (t,) float array
        inf for what never goes.
    kind : (t,) int8 array
    order : (r,) int array
    share : (t,) float array
        p(v) at the time of removal, or at the end.
    """
    t, size = simplices.shape
    there = neighbors >= 0
    arrays = [
        simplices.flatten(),
        neighbors.flatten(),
        np.ones(t, dtype=bool),
        there.sum(axis=1),
        np.zeros(t) if rule == "surface" else np.where(there, 0.0, values).sum(axis=1),
        values.ravel(),
        radii,
        np.zeros(t),
        np.zeros(t, dtype=np.int64),
    ]
    if compiled is None:
        compiled = t >= _COMPILE_FROM or "numba" in sys.modules
    compiled = compiled and loops.can_compile()
    loop = loops.made(compiled).remove_in_order
    # Python reads lists several times faster than arrays.
    filled = arrays if compiled else [array.tolist() for array in arrays]
    removed, stop = 0, 0
    with Progress("hierarchy", t) as progress:
        while removed == stop and removed < t:
            stop = min(removed + _CHUNK, t)
            removed = loop(size, _RULES[rule], printed, *filled, removed, stop)
            progress.at(removed)
    count, share, keys, order = (np.asarray(filled[k], dtype=arrays[k].dtype) for k in (3, 4, 7, 8))
    order, level, kind = order[:removed], np.full(t, np.inf), np.zeros(t, dtype=np.int8)
    level[order], kind[order] = np.maximum.accumulate(keys[order]), count[order]
    return level, kind, order, share
