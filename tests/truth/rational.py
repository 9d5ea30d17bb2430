"""The plane in fractions: Delaunay, Voronoi, Gabriel, inside and outside, Sk2; and random regions.

Nothing here calls the library's geometry: Delaunay comes from the definition (no sample strictly
inside the circle), inside tests from rational crossings. Slow, small and easy to believe.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from math import lcm

import numpy as np

Point = tuple[Fraction, Fraction]


def turn(a, b, c):
    value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (value > 0) - (value < 0)


def dot(a, b, c):
    """(b - a) . (c - a)"""
    return (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1])


def circumcenter(a, b, c) -> Point:
    bx, by, cx, cy = b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]
    twice = 2 * (bx * cy - by * cx)
    lb, lc = bx * bx + by * by, cx * cx + cy * cy
    return a[0] + (cy * lb - by * lc) / twice, a[1] + (bx * lc - cx * lb) / twice


def strictly_gabriel(p, q, samples) -> bool:
    """No other sample in the closed disk of diameter pq."""
    return all(dot(s, p, q) > 0 for s in samples if s not in (p, q))


def location(point, segments) -> int:
    """+1 inside, 0 on the boundary, -1 outside, by counting rational crossings to the right."""
    x, y = point
    crossings = 0
    for a, b in segments:
        side = turn(a, b, point)
        if side == 0 and dot(point, a, b) <= 0:
            return 0
        if (a[1] <= y) != (b[1] <= y):
            at = a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
            crossings += at > x
    return 1 if crossings % 2 else -1


def segment_side(p, q, segments) -> int | None:
    """+1 if the closed segment pq is in the open region, -1 if in its open complement, None if neither."""
    for a, b in segments:
        d1, d2, d3, d4 = turn(a, b, p), turn(a, b, q), turn(p, q, a), turn(p, q, b)
        if d1 * d2 < 0 and d3 * d4 < 0:
            return None
        for s, (u, v), t in ((d1, (a, b), p), (d2, (a, b), q), (d3, (p, q), a), (d4, (p, q), b)):
            if s == 0 and dot(t, u, v) <= 0:
                return None
    return location(p, segments)


def empty_circles(samples: list[Point]) -> list[frozenset]:
    """The samples of every circle that has three or more samples on it and none inside, on integers."""
    common = lcm(*(c.denominator for s in samples for c in s))
    xy = np.array([[int(c * common) for c in s] for s in samples], dtype=object)
    triples = np.array(list(combinations(range(len(samples)), 3)))
    a, b, c = (xy[triples[:, k]] for k in range(3))
    u, v = b - a, c - a
    turned = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    lift_u, lift_v = (u * u).sum(axis=1), (v * v).sum(axis=1)
    # Power of each sample with respect to each circle, times twice its area (of either sign).
    w = xy[None] - a[:, None]
    power = turned[:, None] * (w * w).sum(axis=2)
    power -= w[:, :, 0] * (v[:, 1] * lift_u - u[:, 1] * lift_v)[:, None]
    power -= w[:, :, 1] * (u[:, 0] * lift_v - v[:, 0] * lift_u)[:, None]
    power *= np.where(turned > 0, 1, -1)[:, None]
    empty = np.flatnonzero((turned != 0) & (power.min(axis=1) == 0))
    return list({frozenset(samples[i] for i in np.flatnonzero(power[k] == 0)) for k in empty})


def voronoi_elements(samples: list[Point]):
    """Voronoi vertices {centre: samples on the circle}, edges [(p, q, centre, centre or None)]."""
    vertices: dict[Point, frozenset] = {}
    for on in empty_circles(samples):
        vertices[circumcenter(*sorted(on)[:3])] = on
    sharing: dict[frozenset, list[Point]] = {}
    for m, on in vertices.items():
        for pair in combinations(on, 2):
            sharing.setdefault(frozenset(pair), []).append(m)
    edges = []
    for pair, ends in sharing.items():
        p, q = pair
        if len(ends) == 2:
            edges.append((p, q, ends[0], ends[1]))
            continue
        # One empty circle only: neighbours on the convex hull, or the diagonal of a cocircular set.
        others = [turn(p, q, s) for s in samples if s not in pair]
        if all(t >= 0 for t in others) or all(t <= 0 for t in others):
            edges.append((p, q, ends[0], None))
    return vertices, edges


def ray_end(p, q, start, samples, segments) -> Point:
    """A point of the ray dual to the hull edge pq, beyond the bounding box of everything."""
    normal = (q[1] - p[1], p[0] - q[0])
    if any(turn(p, q, s) < 0 for s in samples):
        normal = (-normal[0], -normal[1])
    size = max(max(abs(x), abs(y)) for x, y in [*samples, *(a for a, _ in segments), start]) + 1
    reach = 4 * size / max(abs(normal[0]), abs(normal[1]))
    return start[0] + reach * normal[0], start[1] + reach * normal[1]


def sk2_oracle(samples, segments, side: int):
    """The Voronoi vertices and edges (by their two samples) in the open region or its open complement."""
    vertices, edges = voronoi_elements(samples)
    inside = {m for m in vertices if location(m, segments) == side}
    touching = {m for m in vertices if location(m, segments) == 0}
    kept = set()
    for p, q, a, b in edges:
        end = ray_end(p, q, a, samples, segments) if b is None else b
        if b is None and side > 0:
            continue
        if segment_side(a, end, segments) == side:
            kept.add(frozenset((p, q)))
    return inside, kept, touching


def grid_region(
    rng: np.random.Generator, size: int = 5, fill: float = 0.55, hole: bool = False
) -> list[list[tuple[int, int]]]:
    """Rings of a random union of grid cells, skewed and jittered: components, holes, all kinds of corners.

    Cells are on a lattice of step 12 and every corner is moved by up to 2, so rings never meet.
    With ``hole`` an inner cell is empty and the ones around it are full.
    """
    while True:
        cells = np.zeros((size + 2, size + 2), dtype=bool)
        cells[1:-1, 1:-1] = rng.random((size, size)) < fill
        if hole:
            i, j = rng.integers(2, size, size=2)
            cells[i - 1 : i + 2, j - 1 : j + 2] = True
            cells[i, j] = False
        # No two cells may touch in a corner only: that would pinch the region.
        a, b, c, d = cells[:-1, :-1], cells[1:, 1:], cells[1:, :-1], cells[:-1, 1:]
        for i, j in np.argwhere((a & b & ~c & ~d) | (c & d & ~a & ~b)):
            cells[i + 1, j] = cells[i, j] = cells[i, j + 1] = cells[i + 1, j + 1] = True
        a, b, c, d = cells[:-1, :-1], cells[1:, 1:], cells[1:, :-1], cells[:-1, 1:]
        if cells.any() and not ((a & b & ~c & ~d) | (c & d & ~a & ~b)).any():
            break
    follow = {}
    for i, j in np.argwhere(cells).tolist():
        for (u, v), neighbour in (
            (((i, j), (i + 1, j)), (i, j - 1)),
            (((i + 1, j), (i + 1, j + 1)), (i + 1, j)),
            (((i + 1, j + 1), (i, j + 1)), (i, j + 1)),
            (((i, j + 1), (i, j)), (i - 1, j)),
        ):
            x, y = neighbour
            if not (0 <= x < size + 2 and 0 <= y < size + 2 and cells[x, y]):
                follow[u] = v
    shear = int(rng.integers(-6, 7))
    jitter = {v: rng.integers(-2, 3, size=2) for v in sorted(follow)}

    def place(vertex):
        dx, dy = jitter[vertex]
        x, y = 12 * vertex[0] + int(dx), 12 * vertex[1] + int(dy)
        return x + shear * vertex[1], y

    rings, seen = [], set()
    for start in sorted(follow):
        if start in seen:
            continue
        ring, current = [], start
        while current not in seen:
            seen.add(current)
            ring.append(current)
            current = follow[current]
        placed = [place(v) for v in ring]
        # Lattice runs make many collinear triples; keep some vertices only, but every real corner.
        keep = [
            k
            for k, v in enumerate(ring)
            if (ring[k - 1][0] + ring[(k + 1) % len(ring)][0], ring[k - 1][1] + ring[(k + 1) % len(ring)][1])
            != (2 * v[0], 2 * v[1])
            or rng.random() < 0.5
        ]
        rings.append([placed[k] for k in keep])
    return rings


def rational(points) -> list[Point]:
    """Points, also of space, as fractions."""
    return [tuple(map(Fraction, p)) for p in np.asarray(points, dtype=float).tolist()]
