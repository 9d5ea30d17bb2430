"""Section 3.6: sizes and times."""

from __future__ import annotations

from time import process_time

import numpy as np

import polyskel_lite as psl

from .geometry import coarse_regions, gabriel_regions, skew_lines
from .registry import check, seen, verdict


@check("complexity-2d")
def size_in_the_plane():
    """At most 2n - 5 Voronoi vertices and 3n - 6 Delaunay edges; Sk0 has n + 2 holes - 2 pieces vertices."""
    rng = np.random.default_rng(5)
    sets = [rng.random((n, 2)) for n in (3, 10, 100, 1000)] + [s.points for s in coarse_regions()]
    for points in sets:
        t, n = psl.delaunay(points), len(points)
        if len(t.simplices) > 2 * n - 5 or len(t.edges()) > 3 * n - 6:
            return verdict(False)
    for shape in (*gabriel_regions(), *map(psl.datasets.load, psl.datasets.names())):
        b0, b1 = shape.betti()
        if len(psl.sk0(shape).vertices) != len(shape.points) + 2 * b1 - 2 * b0:
            return verdict(False)
    return verdict(True)


def _seconds(work) -> float:
    times = []
    for _ in range(3):
        start = process_time()
        work()
        times.append(process_time() - start)
    return min(times)


@check("complexity-time")
def time_in_the_plane():
    """Eight times the samples take far less than 64 times as long; Sk0 itself costs less than Delaunay."""
    rng = np.random.default_rng(6)
    small, large = rng.random((1500, 2)), rng.random((12000, 2))
    longer = _seconds(lambda: psl.delaunay(large))
    exponent = np.log(longer / _seconds(lambda: psl.delaunay(small))) / np.log(8)
    t = psl.delaunay(large)
    P = psl.DelaunayShape(t, t.circumradii < 0.02)
    dual = _seconds(lambda: psl.sk0(P))
    # In space the output alone is quadratic in the worst case.
    quadratic = [len(psl.delaunay(skew_lines(n)).simplices) / n**2 for n in (20, 40, 80)]
    return verdict(exponent < 1.6 and dual < longer and min(quadratic) > 0.15)


@check("complexity-3d")
def size_in_space():
    """Never more than n(n - 3)/2 tetrahedra, and (n/2 - 1)² on two skew lines: quadratic, and no better."""
    rng = np.random.default_rng(7)
    sets = [rng.random((n, 3)) for n in (5, 20, 200)] + [skew_lines(n) for n in (20, 60)]
    below = all(len(psl.delaunay(E).simplices) <= len(E) * (len(E) - 3) // 2 for E in sets)
    reached = all(len(psl.delaunay(skew_lines(n)).simplices) == (n // 2 - 1) ** 2 for n in (20, 60))
    return verdict(below and reached)


def capsule(n: int, length: float, seed: int = 0) -> np.ndarray:
    """n random points, uniform on the surface of a cylinder of radius 1 with round ends."""
    rng = np.random.default_rng(seed)
    tube = rng.random(n) * (length + 2) < length
    angle, z = rng.random(n) * 2 * np.pi, rng.uniform(-1, 1, n)
    radius = np.where(tube, 1, np.sqrt(1 - z**2))
    height = np.where(tube, z * length / 2, z + np.sign(z) * length / 2)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), height])


@check("complexity-3d-8n")
def eight_per_sample():
    """Our solids have below 8 per sample. It is no bound: a long capsule has more, skew lines any number."""
    per_sample = {
        name: len(psl.sk0(psl.datasets.load(name)).vertices) / len(psl.datasets.load(name).points)
        for name in ("fourbranch", "chromosome", "vertebra")
    }
    points = capsule(500, 30)  # convex, so every tetrahedron is inner
    assert len(psl.delaunay(points).simplices) > 8 * len(points)
    assert len(psl.delaunay(skew_lines(80)).simplices) > 19 * 80
    return seen(max(per_sample.values()) < 8)
