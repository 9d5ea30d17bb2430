"""Small random solids: Sk1, Sk2 and Sk3 of their vertices, both sides, held against fractions."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from truth.rational import rational
from truth.rational_space import cross, crossings, dot, location, minus, sphere_center, volume

import polyskel_lite as psl


def solid(rng) -> psl.Shape:
    """Part of a random tessellation, squeezed, so that its own Voronoi graph leaves it."""
    while True:
        size = int(rng.integers(2, 12))
        points = rng.integers(0, size + 1, size=(int(rng.integers(6, 11)), 3)).astype(float)
        points = np.unique(points, axis=0)
        try:
            t = psl.delaunay(points)
            shape = psl.DelaunayShape(t, rng.random(len(t.simplices)) < 0.8).to_shape()
        except (psl.TessellationError, psl.ShapeError):
            continue
        unit = 2.0 ** rng.integers(-60, 60) if rng.random() < 0.3 else 1.0
        way = unit * 2.0 ** -rng.integers(0, 4, size=3)
        return psl.Shape.from_mesh(shape.points * way, shape.facets)


def run(rng: np.random.Generator) -> Iterator[str]:
    """One solid: yields what it is, in words, first."""
    shape = solid(rng)
    yield f"a solid of {len(shape.points)} vertices and {len(shape.facets)} triangles"
    samples, triangles = rational(shape.points), [tuple(map(tuple, t)) for t in map(rational, shape.segments)]
    t = psl.delaunay(shape.points)
    corners = [[samples[k] for k in simplex] for simplex in t.simplices.tolist()]
    centers = [sphere_center(*four) for four in corners]
    for m, four in zip(centers, corners, strict=True):
        square = dot(minus(m, four[0]), minus(m, four[0]))
        assert all(dot(minus(m, s), minus(m, s)) >= square for s in samples), "a sample in a Delaunay ball"
    where = [location(m, triangles) for m in centers]
    edges = _voronoi_edges(t, samples, centers, triangles)
    for name, side in (("inner", 1), ("outer", -1)):
        found = set(psl.sk1(shape, t, name).simplices.tolist())
        assert all(w is None or (k in found) == (w == side) for k, w in enumerate(where)), f"Sk1, {name}"
        whole, cut = psl.sk2(shape, t, name), psl.sk3(shape, t, name)
        kept = {frozenset(pair) for pair in whole.simplices[whole.edges].tolist()}
        for pair, met in edges.items():
            inside = met == [] and where[min(pair)] == side
            if len(pair) == 2 and met is not None and where[min(pair)] is not None:
                assert (pair in kept) == inside, f"Sk2, {name}"
        _cuts(cut, edges, np.ptp(shape.points), name)


def _voronoi_edges(t, samples, centers, triangles) -> dict:
    """By the simplices at the ends, one for a ray, where each edge crosses the mesh; None for in doubt."""
    edges, rays = {}, {}
    reach = 8 * (1 + max(abs(x) for p in [*samples, *centers] for x in p))
    for facet, (first, second) in zip(*(a.tolist() for a in t.facet_table), strict=True):
        start = centers[first]
        if second >= 0:
            same = start == centers[second]
            edges[frozenset((first, second))] = None if same else crossings(start, centers[second], triangles)
            continue
        a, b, c = (samples[k] for k in facet)
        normal = cross(minus(b, a), minus(c, a))
        if volume(a, b, c, next(s for s in samples if volume(a, b, c, s))) > 0:
            normal = tuple(-x for x in normal)
        far = reach / max(map(abs, normal))
        end = tuple(x + far * n for x, n in zip(start, normal, strict=True))
        rays.setdefault(first, []).append(crossings(start, end, triangles))
    for first, several in rays.items():
        edges[frozenset((first,))] = None if None in several else [x for some in several for x in some]
    return edges


def _cuts(skeleton, edges, size, name) -> None:
    """The vertices that Sk3 has more are where the edges cross the mesh, each once."""
    made = skeleton.vertices[skeleton.simplices < 0]
    true = [x for met in edges.values() if met for x in met]
    doubt = sum(met is None for met in edges.values())
    assert len(made) >= len(true), f"Sk3 has {len(made)} cuts of {len(true)}, {name}"
    assert doubt or len(made) == len(true), f"Sk3 has {len(made)} cuts of {len(true)}, {name}"
    for x in true:
        assert np.abs(made - np.array(list(map(float, x)))).max(axis=1).min() <= 1e-9 * size, f"Sk3, {name}"
