"""Delaunay tessellations of hard point sets, in the plane and in space, held against their definition."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from truth.point_sets import FAMILIES, draw

import polyskel_lite as psl
from polyskel_lite.graphs.growing import Growing
from polyskel_lite.graphs.triangulation import problem


def plane(rng) -> Iterator[str]:
    """A case in the plane."""
    return _case(rng, 2, int(rng.integers(3, 40)))


def space(rng) -> Iterator[str]:
    """A case in space."""
    return _case(rng, 3, int(rng.integers(4, 60)))


def _case(rng, dimension, size) -> Iterator[str]:
    name = rng.choice([*FAMILIES])
    points = draw(name, rng, dimension, size)
    yield f"{len(points)} points in {dimension}D, {name}"
    t = psl.delaunay(points)
    assert not (fault := problem(t.points, t.simplices, t.neighbors)), fault
    order = rng.permutation(len(points))
    again = order[psl.delaunay(points[order]).simplices]
    assert {*map(frozenset, again.tolist())} == {*map(frozenset, t.simplices.tolist())}, "relabelled"
    # Half first and the rest later, in compiled loops and in plain ones.
    half = len(points) // 2
    try:
        grown = Growing(points[:half], compiled=bool(rng.integers(2)))
    except (psl.TessellationError, IndexError):
        grown = Growing(points, compiled=bool(rng.integers(2)))
    else:
        grown.add(points[half:])
    assert np.array_equal(grown.simplices_and_neighbors()[0], t.simplices), "in two parts"
    # Some sets have simplices of no width in floats; the others need not all pay for the hierarchies.
    if name not in ("scales", "nearly_flat", "two_lines") and rng.random() < 0.3:
        P = psl.DelaunayShape(t, rng.random(len(t.simplices)) < 0.8)
        for strategy in psl.simplification.STRATEGIES[dimension]:
            _simplified(P, strategy)


def _simplified(P, strategy) -> None:
    """At every threshold the topology of Sk0; what a larger one keeps, a smaller one keeps too."""
    if not P.inner.any():
        return
    h = psl.hierarchy(P, strategy)
    betti, before = psl.sk0(P).betti(), P.inner
    for threshold in (0.0, 1.0, 3.0, np.inf):
        kept = h.kept(threshold)
        assert not (kept & ~before).any(), "not nested"
        assert h.skeleton(threshold).betti() == betti, f"Betti numbers at {threshold}, {strategy}"
        before = kept
