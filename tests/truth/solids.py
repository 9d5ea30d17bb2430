"""Regions and solids that several tests share: of known topology, jagged, or any. Made by the library."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np

import polyskel_lite as psl
from polyskel_lite import implicit

FIELDS = {
    "ball": (implicit.ball(), 200, (1, 0, 0)),
    "torus": (implicit.torus(), 400, (1, 1, 0)),
    "double torus": (implicit.double_torus(), 700, (1, 2, 0)),
    "hollow ball": (implicit.hollow_ball(), 400, (1, 0, 1)),
    "trefoil": (implicit.trefoil(), 800, (1, 1, 0)),
    "capsule": (implicit.capsule(), 200, (1, 0, 0)),
    "tetrapod": (implicit.tetrapod(), 500, (1, 0, 0)),
}


@cache
def solid(name: str) -> psl.Shape:
    field, n, _ = FIELDS[name]
    return implicit.solid(field, n)


def random_solids(count: int) -> Iterator[psl.Shape]:
    """Pieces of random Delaunay tessellations that are manifold: jagged, of any topology."""
    random = np.random.default_rng(11)
    while count:
        points = random.normal(size=(14, 3))
        tessellation = psl.delaunay(points)
        inner = random.random(len(tessellation.simplices)) < 0.9
        try:
            shape = psl.DelaunayShape(tessellation, inner).to_shape()
        except psl.ShapeError:
            continue
        count -= 1
        yield psl.Shape(shape.points * 10 ** random.uniform(-1.5, 0, 3), shape.facets)


def random_region(seed: int, n: int = 2, points: int = 40, fill: float = 0.7) -> psl.DelaunayShape:
    """Any set of Delaunay simplices: pinched, in pieces, with holes and cavities."""
    rng = np.random.default_rng(seed)
    t = psl.delaunay(rng.random((points, n)))
    return psl.DelaunayShape(t, rng.random(len(t.simplices)) < fill)
