"""Random regions of the plane and hostile polygons, held against definitions in fractions."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from truth.rational import circumcenter, grid_region, location, rational, sk2_oracle

import polyskel_lite as psl


def region(rng) -> list:
    """Rings of a random region with integer corners, now and then moved, scaled or squeezed."""
    size = int(rng.integers(1, 5))
    rings = grid_region(rng, size=size, hole=size > 2 and rng.random() < 0.3)
    rings = [np.array(ring, dtype=float) for ring in rings]
    kind = rng.integers(6)
    if kind == 0:
        rings = [ring + 2.0 ** rng.integers(10, 40) for ring in rings]
    elif kind == 1:
        rings = [ring * 2.0 ** rng.integers(-60, 60) for ring in rings]
    elif kind == 2:
        rings = [ring * (1, 2.0 ** -rng.integers(1, 12)) for ring in rings]
    elif kind == 3:
        angle = rng.uniform(0, 2 * np.pi)
        turn = np.array([(np.cos(angle), -np.sin(angle)), (np.sin(angle), np.cos(angle))])
        rings = [ring @ turn for ring in rings]
    return rings


def polygon(rng) -> list:
    """One polygon of few corners on a small grid: cocircular, collinear, touching, crossing, or fine."""
    n = int(rng.integers(3, 9))
    corners = rng.integers(0, int(rng.integers(2, 8)), size=(n, 2)).astype(float)
    if rng.random() < 0.6:  # star-shaped around the middle: often simple
        middle = corners.mean(axis=0)
        corners = corners[np.argsort(np.arctan2(*(corners - middle).T))]
    return [corners]


def crossing(ring) -> bool:
    """Whether a polygon meets itself, or has a corner twice, by fractions."""
    points = rational(ring)
    n = len(points)
    if len(set(points)) < n:
        return True
    for i in range(n):
        a, b = points[i], points[(i + 1) % n]
        for j in range(i + 1, n):
            c, d = points[j], points[(j + 1) % n]
            if {a, b} & {c, d}:
                (p, q), (r, s) = ((a, b), (c, d)) if b in (c, d) else ((b, a), (c, d))
                other = s if r == q else r
                if n > 3 and _between(q, p, other):
                    return True
            elif _meet(a, b, c, d):
                return True
    return n == 3 and _turn(*points) == 0


def _turn(a, b, c):
    value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (value > 0) - (value < 0)


def _between(common, p, q) -> bool:
    """Two segments from one corner that lie on each other."""
    dot = (p[0] - common[0]) * (q[0] - common[0]) + (p[1] - common[1]) * (q[1] - common[1])
    return _turn(common, p, q) == 0 and dot > 0


def _meet(a, b, c, d) -> bool:
    one, two = _turn(a, b, c) * _turn(a, b, d), _turn(c, d, a) * _turn(c, d, b)
    boxes = all(
        max(min(a[k], b[k]), min(c[k], d[k])) <= min(max(a[k], b[k]), max(c[k], d[k])) for k in (0, 1)
    )
    return one <= 0 and two <= 0 and boxes


def run(rng: np.random.Generator) -> Iterator[str]:
    """One shape through everything; yields what it is, in words, first."""
    if rng.random() < 0.4:
        rings = polygon(rng)
        yield f"the polygon {rings[0].tolist()}"
        closed = len(rings[0]) > 3 and (rings[0][0] == rings[0][-1]).all()  # the last may repeat the first
        bad = crossing(rings[0][:-1] if closed else rings[0])
        try:
            shape = psl.Shape.from_rings(rings)
        except (psl.ShapeError, psl.DuplicatePointError):
            assert bad, "a simple polygon was refused"
            raise
        assert not bad, "a polygon that meets itself was taken"
    else:
        rings = region(rng)
        yield f"a region of {len(rings)} rings and {sum(map(len, rings))} corners, {rings[0][0].tolist()}"
        shape = psl.Shape.from_rings(rings)
    if len(shape.points) <= 14:
        _by_definition(shape)
    conformed = psl.conform(shape, limit=3000)
    assert not len(psl.missing_facets(conformed, "gabriel"))
    skeleton = psl.sk0(conformed)
    assert skeleton.betti() == shape.betti(), "Betti numbers of Sk0"
    assert psl.sk0(conformed).reconstruct().betti() == shape.betti()
    _sk1_of(conformed)
    _simplified(conformed, shape.betti())


def _by_definition(shape) -> None:
    """Sk1 and Sk2 of the vertices, both sides, against fractions."""
    samples, segments = rational(shape.points), [tuple(s) for s in map(rational, shape.segments)]
    try:
        tessellation = psl.delaunay(shape.points, shape.facets)
    except psl.TessellationError:
        return
    exact = [circumcenter(*(samples[k] for k in simplex)) for simplex in tessellation.simplices.tolist()]
    for name, side in (("inner", 1), ("outer", -1)):
        inside, kept, touching = sk2_oracle(samples, segments, side)
        found = {exact[k] for k in psl.sk1(shape, tessellation, name).simplices.tolist()}
        assert inside <= found <= inside | touching, f"Sk1, {name}"
        whole = psl.sk2(shape, tessellation, name)
        for a, b in whole.simplices[whole.edges].tolist():
            pair = frozenset(
                samples[k]
                for k in {*tessellation.simplices[a].tolist()} & {*tessellation.simplices[b].tolist()}
            )
            # Edges of no length, between simplices of one circle, are none for the oracle.
            assert exact[a] == exact[b] or pair in kept or exact[a] in touching or exact[b] in touching, name


def _sk1_of(shape) -> None:
    """Some vertices of Sk1 are where rational crossings say that they are."""
    t = psl.delaunay(shape.points, shape.facets)
    inner = set(psl.sk1(shape, t).simplices.tolist())
    segments = [tuple(s) for s in map(rational, shape.segments)]
    step = max(1, len(t.simplices) // 12)
    for k in range(0, len(t.simplices), step):
        corners = rational(t.points[t.simplices[k]])
        where = location(circumcenter(*corners), segments)
        assert where == 0 or (k in inner) == (where > 0), f"simplex {k} in Sk1"


def _simplified(shape, betti) -> None:
    """At every threshold the same topology; what a larger one keeps, a smaller one keeps too."""
    P = psl.delaunay_shape(shape)
    for criterion in ("corrected", "transcript"):
        h = psl.hierarchy(P, criterion=criterion)
        before = P.inner
        for threshold in (0.0, 0.5, 1.0, 2.0, 5.0, np.inf):
            kept = h.kept(threshold)
            assert not (kept & ~before).any(), "not nested"
            assert h.skeleton(threshold).betti() == betti, f"Betti numbers at {threshold}, {criterion}"
            before = kept
