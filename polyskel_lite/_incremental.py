"""Exact incremental Delaunay triangulation in the plane, for the inputs where Qhull's rounding shows.

Typical: samples on straight sides, collinear but for the last bit, on the convex hull. Qhull merges
or drops the needle triangles there; this method decides every sign exactly and keeps them. It is
pure Python, some 50 microseconds a point, and runs only when the check of `_triangulate` fails.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np

_GHOST = -1  # the vertex at infinity: an edge of the hull and the ghost make a ghost triangle


def incremental_delaunay(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Delaunay triangles (t, 3), counter-clockwise, and their neighbors (t, 3); empty if all are collinear.

    References
    ----------
    Bowyer 1981, Watson 1981; ghost triangles as in Shewchuk, Lecture notes on Delaunay mesh generation, 2012.

    Examples
    --------
    >>> triangles, neighbors = incremental_delaunay(np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]))
    >>> len(triangles), (neighbors < 0).sum().item()
    (2, 4)
    """
    return _Triangulation(points).arrays()


class _Triangulation:
    """A map from directed edges (a, b) to the vertex left of them."""

    def __init__(self, points: np.ndarray):
        self.points = [tuple(p) for p in points.tolist()]
        self.left: dict[tuple[int, int], int] = {}
        order = _local_order(points)
        start = self._first_triangle(order)
        if start is None:
            return
        self.recent = start
        for vertex in order:
            if vertex not in start:
                self._insert(vertex)

    def _first_triangle(self, order):
        a, b = order[0], order[1]
        for c in order[2:]:
            turn = self._turn(a, b, c)
            if turn:
                a, b, c = (a, b, c) if turn > 0 else (b, a, c)
                for u, v in ((a, b), (b, c), (c, a)):
                    self._add(v, u, _GHOST)
                self._add(a, b, c)
                return a, b, c
        return None

    def _add(self, a, b, c):
        self.left[a, b] = c
        self.left[b, c] = a
        self.left[c, a] = b

    def _insert(self, vertex):
        stack = [self._locate(vertex)]
        a, b, c = stack[0]
        for edge in ((a, b), (b, c), (c, a)):
            self.left.pop(edge)
        border = [(b, a), (c, b), (a, c)]  # each edge seen from outside the cavity
        fan = []
        while border:
            u, v = border.pop()
            w = self.left.get((u, v))
            if w is not None and self._conflicts(u, v, w, vertex):
                for edge in ((u, v), (v, w), (w, u)):
                    self.left.pop(edge)
                border += [(w, v), (u, w)]
            elif w is not None:
                fan.append((v, u))
        for u, v in fan:
            self._add(u, v, vertex)
            if _GHOST not in (u, v):
                self.recent = (u, v, vertex)

    def _locate(self, vertex):
        """Walk to a triangle, maybe a ghost, that conflicts with the vertex."""
        a, b, c = self.recent
        while True:
            for u, v, w in ((a, b, c), (b, c, a), (c, a, b)):
                if self._turn(u, v, vertex) < 0:
                    w = self.left[v, u]
                    if w == _GHOST:
                        return v, u, w
                    a, b, c = v, u, w
                    break
            else:
                return a, b, c

    def _conflicts(self, a, b, c, vertex):
        while c != _GHOST and _GHOST in (a, b):
            a, b, c = b, c, a
        if c == _GHOST:
            turn = self._turn(a, b, vertex)
            return turn > 0 or (turn == 0 and self._between(a, b, vertex))
        return self._in_circle(a, b, c, vertex) > 0

    def _between(self, a, b, vertex):
        (ax, ay), (bx, by), (x, y) = (self.points[i] for i in (a, b, vertex))
        return min(ax, bx) <= x <= max(ax, bx) and min(ay, by) <= y <= max(ay, by)

    def _turn(self, a, b, c):
        (ax, ay), (bx, by), (cx, cy) = self.points[a], self.points[b], self.points[c]
        left, right = (bx - ax) * (cy - ay), (by - ay) * (cx - ax)
        if abs(left - right) > 1e-15 * (abs(left) + abs(right)) + 1e-290:
            return 1 if left > right else -1
        ax, ay, bx, by, cx, cy = map(Fraction, (ax, ay, bx, by, cx, cy))
        value = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        return (value > 0) - (value < 0)

    def _in_circle(self, *vertices):
        corners = [self.points[i] for i in vertices]
        value, bound = _circle_determinant(*corners)
        if abs(value) > 1e-14 * bound + 1e-280:
            return 1 if value > 0 else -1
        value, _ = _circle_determinant(*[tuple(map(Fraction, p)) for p in corners])
        return (value > 0) - (value < 0)

    def arrays(self) -> tuple[np.ndarray, np.ndarray]:
        index: dict[tuple[int, int], int] = {}
        triangles = []
        for (a, b), c in self.left.items():
            if _GHOST not in (a, b, c) and a < b and a < c:
                index.update({(a, b): len(triangles), (b, c): len(triangles), (c, a): len(triangles)})
                triangles.append((a, b, c))
        neighbors = [[index.get(e, -1) for e in ((c, b), (a, c), (b, a))] for a, b, c in triangles]
        return np.array(triangles, dtype=np.int64).reshape(-1, 3), np.array(
            neighbors, dtype=np.int64
        ).reshape(-1, 3)


def _circle_determinant(a, b, c, d):
    ax, ay, bx, by, cx, cy = a[0] - d[0], a[1] - d[1], b[0] - d[0], b[1] - d[1], c[0] - d[0], c[1] - d[1]
    la, lb, lc = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
    value = la * (bx * cy - by * cx) + lb * (cx * ay - cy * ax) + lc * (ax * by - ay * bx)
    bound = (
        la * (abs(bx * cy) + abs(by * cx))
        + lb * (abs(cx * ay) + abs(cy * ax))
        + lc * (abs(ax * by) + abs(ay * bx))
    )
    return value, bound


def _local_order(points: np.ndarray) -> list[int]:
    """Indices row by row of a square grid, to and fro, so that the next point is near the last one."""
    low, high = points.min(axis=0), points.max(axis=0)
    cells = max(1, int(np.sqrt(len(points))))
    with np.errstate(over="ignore"):
        column, row = (
            (np.minimum((points - low) / np.where(high > low, high - low, 1) * cells, cells - 1))
            .astype(int)
            .T
        )
    along = np.where(row % 2, -points[:, 0], points[:, 0])
    return np.lexsort((along, row)).tolist()
