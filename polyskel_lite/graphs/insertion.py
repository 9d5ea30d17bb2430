"""One point after another into a Delaunay tessellation, exact in every case: loops to be compiled or not.

Vertices are numbers of points, simplices rows of N+1 of them, flat in ``T``; ``A`` has the simplex across
from each vertex. Beyond the hull there are ghosts, with vertex -1 at infinity; rows with `DEAD` are free.
All simplices that `turn` calls positive; ghosts as if -1 were outside.

Ties. Points on one sphere have several tessellations. All points count as lowered on the paraboloid by next
to nothing: the first in the order of `before` by most, the second by much less, and so on. Then no tie is
left, and the result depends on the points alone: each cospherical cell is a cone from its first vertex.

References
----------
Bowyer 1981, Watson 1981; ghosts as in Shewchuk, Lecture notes on Delaunay mesh generation, 2012; ties by
symbolic perturbation as in Devillers and Teillaud, Perturbations for Delaunay and weighted Delaunay 3D
triangulations, 2011.
"""

from __future__ import annotations

import numpy as np

from ..exact import flat_turn, in_circle, in_sphere, sign_loops, turn_2d, turn_3d

loops = sign_loops.extended()
_POINTS, _WHOLE, _INTS = "float64[::1]", "int64[:,::1]", "int32[::1]"
_SET = f"{_POINTS}, {_WHOLE}, {_INTS}"  # points, whole numbers, ranks
GHOST, DEAD = -1, -9
#: The dimension and the corners of a simplex; `Loops.made` sets them.
N, M = 0, 0
#: In ``state``: rows used, free rows, where the next walk begins, the last mark, a point met twice.
ROWS, FREE, LAST, MARK, TWICE = range(5)


def integers(n, fill):
    """So many whole numbers, as a list; compiled, as an array."""
    return [fill] * n


@loops(f"{_INTS}(int64, int64)", stands_for="integers")
def _integers(n, fill):
    return np.full(n, fill, np.int32)


@loops(f"int64({_POINTS}, {_WHOLE}, int64, int64, int64, int64)")
def turn(P, W, a, b, c, d):
    """`turn_2d` of a, b, c or `turn_3d` of all four."""
    return turn_2d(P, W, a, b, c) if N == 2 else turn_3d(P, W, a, b, c, d)


@loops(f"boolean({_POINTS}, {_INTS}, int64, int64)")
def before(P, R, a, b):
    """Whether a comes before b: by rank, then by coordinates."""
    if R[a] != R[b]:
        return R[a] < R[b]
    for k in range(N):
        if P[N * a + k] != P[N * b + k]:
            return P[N * a + k] < P[N * b + k]
    return False


@loops(f"int64({_SET}, int64, int64, int64, int64, int64)")
def untied(P, W, R, a, b, c, d, e):
    """The in-ball sign of e on the sphere: by the first vertex whose lowering turns the lifted simplex."""
    floor = -2
    while True:
        low = -2
        for v in (a, b, c, d, e) if N == 3 else (a, b, c, e, e):
            if (floor == -2 or before(P, R, floor, v)) and (low == -2 or before(P, R, v, low)):
                low = v
        if low == e:
            return 1
        s = turn(P, W, e if a == low else a, e if b == low else b, e if c == low else c, e if d == low else d)
        if s != 0:
            return -s
        floor = low


@loops(f"int64({_SET}, int64, int64, int64, int64, int64)")
def inside(P, W, R, a, b, c, d, e):
    """+1 where e is inside the ball of a simplex, -1 outside; never 0."""
    s = in_circle(P, W, a, b, c, e) if N == 2 else in_sphere(P, W, a, b, c, d, e)
    return s if s != 0 else untied(P, W, R, a, b, c, d, e)


@loops(f"int64({_SET}, {_INTS}, {_INTS}, int64, int64)")
def conflict(P, W, R, T, A, t, p):
    """+1 where p is inside the ball of simplex t, or beyond the hull's facet of ghost t."""
    g = -1
    for i in range(M):
        g = i if T[M * t + i] < 0 else g
    if g < 0:
        return inside(P, W, R, T[M * t], T[M * t + 1], T[M * t + 2], T[M * t + N], p)
    a = p if g == 0 else T[M * t]
    b = p if g == 1 else T[M * t + 1]
    c = p if g == 2 else T[M * t + 2]
    d = p if g == 3 else T[M * t + N]
    s = turn(P, W, a, b, c, d)
    if s != 0:
        return s
    # In the plane of the hull's facet: inside its disk exactly when inside the ball behind it.
    t = A[M * t + g]
    return inside(P, W, R, T[M * t], T[M * t + 1], T[M * t + 2], T[M * t + N], p)


@loops(f"boolean({_POINTS}, {_WHOLE}, int64, int64, int64)")
def collinear(P, W, a, b, c):
    """Whether three points are in one line: in space, flat in all three projections."""
    if N == 2:
        return turn_2d(P, W, a, b, c) == 0
    return (
        flat_turn(P, W, 0, a, b, c) == 0
        and flat_turn(P, W, 1, a, b, c) == 0
        and flat_turn(P, W, 2, a, b, c) == 0
    )


@loops(f"UniTuple(int64, 2)({_POINTS}, {_WHOLE}, int64)")
def corners(P, W, count):
    """The first points that make a simplex with 0 and 1: twice one in the plane, -1 if all are flat."""
    i = 2
    while i < count and collinear(P, W, 0, 1, i):
        i += 1
    j = i
    if N == 3:
        while j < count and turn_3d(P, W, 0, 1, i, j) == 0:
            j += 1
    return (i, j) if j < count else (-1, -1)


@loops(f"void({_POINTS}, {_WHOLE}, {_INTS}, {_INTS}, {_INTS})")
def begin(P, W, T, A, state):
    """The simplex of the first N+1 points, and its ghosts."""
    for j in range(M):
        T[j] = j
    if turn(P, W, 0, 1, 2, N) < 0:
        T[0] = 1
        T[1] = 0
    for i in range(M):
        s = M * (i + 1)
        for j in range(M):
            T[s + j] = T[j]
        T[s + i] = GHOST
        a = s + (i + 1) % M
        b = s + (i + 2) % M
        T[a], T[b] = T[b], T[a]
        A[i] = i + 1
    for t in range(1, M + 1):
        for i in range(M):
            A[M * t + i] = 0
            for s in range(M):
                if T[M * t + i] == T[s]:  # across from v is the ghost that lacks v
                    A[M * t + i] = s + 1
    state[ROWS] = M + 1
    state[LAST] = 0


@loops(f"int64({_POINTS}, {_WHOLE}, {_INTS}, {_INTS}, int64, int64)")
def walk(P, W, T, A, t, p):
    """From simplex t to one that holds p, or to a ghost that p is beyond."""
    came = -1
    turned = p
    while True:
        a = T[M * t]
        b = T[M * t + 1]
        c = T[M * t + 2]
        d = T[M * t + N]
        if a < 0 or b < 0 or c < 0 or d < 0:
            return t
        stay = True
        for k in range(M):
            i = (k + turned) % M
            r = A[M * t + i]
            if r == came:
                continue
            s = turn(P, W, p if i == 0 else a, p if i == 1 else b, p if i == 2 else c, p if i == 3 else d)
            if s < 0:
                came = t
                t = r
                stay = False
                turned += 1
                break
        if stay:
            return t


@loops(f"int64({_SET}, int64, int64, {_INTS}, {_INTS}, {_INTS}, {_INTS}, {_INTS})")
def insert(P, W, R, start, end, T, A, mark, free, state):
    """Insert points from start on; returns the first one that is not in: end, or where rows or room run out.

    Where a point equals one that is in, it is named in ``state``.
    """
    capacity = len(mark)
    cavity = integers(256, 0)
    border = integers(1024, 0)
    size = 1024
    key1 = integers(size, -2)
    key2 = integers(size, -2)
    side = integers(size, 0)
    used = integers(size, 0)
    rows = state[ROWS]
    spare = state[FREE]
    last = state[LAST]
    stamp = state[MARK]
    for p in range(start, end):
        t = walk(P, W, T, A, last, p)
        for i in range(M):
            v = T[M * t + i]
            if v >= 0 and P[N * v] == P[N * p] and not before(P, R, v, p) and not before(P, R, p, v):
                state[TWICE] = v
                return p
        # Simplices whose balls hold p, and their border.
        stamp += 1
        count = 1
        cavity[0] = t
        mark[t] = stamp
        facets = 0
        h = 0
        while h < count:
            if count + M > len(cavity) or facets + M > len(border):
                more = integers(2 * len(cavity), 0)
                for i in range(count):
                    more[i] = cavity[i]
                cavity = more
                more = integers(2 * len(border), 0)
                for i in range(facets):
                    more[i] = border[i]
                border = more
            c = cavity[h]
            h += 1
            for i in range(M):
                s = A[M * c + i]
                if mark[s] == stamp:
                    continue
                if mark[s] != -stamp:
                    if conflict(P, W, R, T, A, s, p) > 0:
                        mark[s] = stamp
                        cavity[count] = s
                        count += 1
                        continue
                    mark[s] = -stamp
                border[facets] = M * c + i
                facets += 1
        if rows + facets > capacity:
            state[MARK] = stamp
            return p
        if 4 * facets > size:
            while 4 * facets > size:
                size *= 2
            key1 = integers(size, -2)
            key2 = integers(size, -2)
            side = integers(size, 0)
            used = integers(size, 0)
        # A new simplex on each facet of the border; two that share a ridge find each other by its vertices.
        ridges = 0
        for f in range(facets):
            c = border[f] // M
            i = border[f] % M
            out = A[M * c + i]
            if spare > 0:
                spare -= 1
                t = free[spare]
            else:
                t = rows
                rows += 1
            for j in range(M):
                T[M * t + j] = T[M * c + j]
            T[M * t + i] = p
            mark[t] = 0
            A[M * t + i] = out
            for j in range(M):
                if A[M * out + j] == c:
                    A[M * out + j] = t
                    break
            solid = True
            for j in range(M):
                a = -2
                b = -2
                for k in range(M):
                    v = T[M * t + k]
                    if v < 0:
                        solid = False
                    if k != i and k != j:
                        if v > a:
                            b = a
                            a = v
                        else:
                            b = v
                if j == i:
                    continue
                x = ((a + 1) * 40503 + (b + 2) * 30011) & (size - 1)
                while key1[x] != -2 and (key1[x] != a or key2[x] != b):
                    x = (x + 1) & (size - 1)
                if key1[x] == -2:
                    key1[x] = a
                    key2[x] = b
                    side[x] = M * t + j
                    used[ridges] = x
                    ridges += 1
                else:
                    o = side[x]
                    A[M * t + j] = o // M
                    A[o] = t
            if solid:
                last = t
        for f in range(ridges):
            key1[used[f]] = -2
        for f in range(count):
            c = cavity[f]
            free[spare] = c
            spare += 1
            mark[c] = 0
            T[M * c] = DEAD
        if T[M * last] == DEAD:  # only ghosts are new: p is in a plane of the hull
            last = t
            for i in range(M):
                if T[M * t + i] < 0:
                    last = A[M * t + i]
        state[ROWS] = rows
        state[FREE] = spare
        state[LAST] = last
        state[MARK] = stamp
    return end


@loops(f"boolean(int64[:,::1], int64, {_INTS})")
def later(simplices, at, row):
    """Whether a row comes after another one."""
    for i in range(M):
        if simplices[at, i] != row[i]:
            return simplices[at, i] > row[i]
    return False


@loops(f"void(int64, {_INTS}, {_INTS}, {_INTS}, {_INTS}, {_INTS}, int64[:,::1], int64[:,::1])")
def collect(rows, T, A, labels, begin, number, simplices, neighbors):
    """Simplices by their labels, sorted as `triangulation.canonical` does: buckets by the least label."""
    for t in range(rows):
        number[t] = -1
        low = labels[T[M * t]] if T[M * t] >= 0 else -1
        for i in range(1, M):
            v = labels[T[M * t + i]] if T[M * t + i] >= 0 else -1
            low = v if v < low else low
        if low >= 0:
            number[t] = low
            begin[low + 1] += 1
    for v in range(1, len(begin)):
        begin[v] += begin[v - 1]
    filled = begin.copy()
    origin = integers(begin[-1], 0)
    row = integers(M, 0)
    for t in range(rows):
        if number[t] < 0:
            continue
        odd = M == 4  # `turn_3d` calls those positive that the library calls negative
        for i in range(M):
            v = labels[T[M * t + i]]
            j = i
            while j > 0 and row[j - 1] > v:
                row[j] = row[j - 1]
                j -= 1
                odd = not odd
            row[j] = v
        if odd:
            row[M - 2], row[M - 1] = row[M - 1], row[M - 2]
        at = filled[row[0]]
        filled[row[0]] += 1
        while at > begin[row[0]] and later(simplices, at - 1, row):
            for i in range(M):
                simplices[at, i] = simplices[at - 1, i]
            origin[at] = origin[at - 1]
            at -= 1
        for i in range(M):
            simplices[at, i] = row[i]
        origin[at] = t
    for at in range(len(origin)):
        number[origin[at]] = at
    for t in range(rows):
        at = number[t]
        if at < 0:
            continue
        for i in range(M):
            v = labels[T[M * t + i]]
            for j in range(M):
                if simplices[at, j] == v:
                    neighbors[at, j] = number[A[M * t + i]]
