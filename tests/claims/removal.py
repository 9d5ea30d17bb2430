"""The process of section 4, written once more: slow, from its sentences, without the library's loop.

A `Region` is a set of simplices named by their corners. Neighbours, hats, salients, duals and Betti
numbers (ranks of boundary matrices over two elements) follow from the names alone.
"""

from __future__ import annotations

import random
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable
from functools import cache
from itertools import combinations, pairwise

import numpy as np
from truth.solids import random_region

import polyskel_lite as psl

from .geometry import flower, gabriel_regions, ring

Simplex = frozenset[int]


def rank(rows: Iterable[int]) -> int:
    """Rank over two elements; a row is a whole number whose bits are the entries."""
    pivots: dict[int, int] = {}
    for row in rows:
        while row:
            top = row.bit_length()
            if top not in pivots:
                pivots[top] = row
                break
            row ^= pivots[top]
    return len(pivots)


def betti(*cells: list[frozenset]) -> tuple[int, ...]:
    """Betti numbers of a complex: its 0-cells, 1-cells (sets of 0-cells), 2-cells (sets of 1-cells) ..."""
    ranks = [0]
    for lower, upper in pairwise(cells):
        number = {cell: k for k, cell in enumerate(lower)}
        ranks.append(rank(sum(1 << number[side] for side in cell) for cell in upper))
    ranks.append(0)
    return tuple(len(c) - ranks[k] - ranks[k + 1] for k, c in enumerate(cells))


class Region:
    """A set of Delaunay simplices that loses one after the other."""

    def __init__(self, points, simplices: Iterable[Iterable[int]]):
        self.points = np.asarray(points, dtype=float)
        self.alive: set[Simplex] = {frozenset(s) for s in simplices}
        self.dimension = self.points.shape[1]
        self.around: dict[frozenset, set[Simplex]] = defaultdict(set)
        for s in self.alive:
            for size in range(1, self.dimension + 1):
                for face in combinations(sorted(s), size):
                    self.around[frozenset(face)].add(s)

    @classmethod
    def of(cls, P: psl.DelaunayShape) -> Region:
        return cls(P.tessellation.points, P.tessellation.simplices[P.inner].tolist())

    def copy(self) -> Region:
        return Region(self.points, self.alive)

    def without(self, s: Simplex) -> Region:
        """A smaller region, only to look at: it shares the sets of simplices that do not change."""
        smaller = Region.__new__(Region)
        smaller.points, smaller.dimension, smaller.alive = self.points, self.dimension, self.alive - {s}
        smaller.around = self.around.copy()
        for size in range(1, self.dimension + 1):
            for face in map(frozenset, combinations(sorted(s), size)):
                smaller.around[face] = self.around[face] - {s}
        return smaller

    def remove(self, s: Simplex) -> None:
        self.alive.remove(s)
        for size in range(1, self.dimension + 1):
            for face in combinations(sorted(s), size):
                self.around[frozenset(face)].remove(s)

    def facets(self, s: Simplex) -> list[frozenset]:
        return [s - {corner} for corner in sorted(s)]

    def boundary_facets(self, s: Simplex) -> list[frozenset]:
        return [f for f in self.facets(s) if len(self.around[f]) == 1]

    def neighbors(self, s: Simplex) -> list[Simplex]:
        return [n for f in self.facets(s) for n in self.around[f] - {s}]

    def boundary(self) -> list[frozenset]:
        return [f for f, cells in self.around.items() if len(f) == self.dimension and len(cells) == 1]

    def is_inner_edge(self, edge: frozenset) -> bool:
        """In 3D: no boundary face has it."""
        return all(len(self.around[edge | {c}]) == 2 for s in self.around[edge] for c in s - edge)

    def inner_edges(self, s: Simplex) -> list[frozenset]:
        return [e for e in map(frozenset, combinations(sorted(s), 2)) if self.is_inner_edge(e)]

    def is_hat(self, s: Simplex) -> bool:
        return len(self.boundary_facets(s)) == self.dimension

    def is_salient(self, s: Simplex) -> bool:
        return self.dimension == 3 and len(self.boundary_facets(s)) == 2 and len(self.inner_edges(s)) == 1

    def dual(self) -> tuple[list, ...]:
        """Vertices, edges and in 3D polygons of Sk0, as in section 3.4."""
        vertices = list(self.alive)
        edges = [frozenset(c) for f, c in self.around.items() if len(f) == self.dimension and len(c) == 2]
        if self.dimension == 2:
            return vertices, edges
        polygons = []
        for edge, cells in self.around.items():
            if len(edge) == 2 and cells and self.is_inner_edge(edge):
                polygons.append(
                    frozenset(frozenset(self.around[edge | {c}]) for s in cells for c in s - edge)
                )
        return vertices, edges, polygons

    def dual_betti(self) -> tuple[int, ...]:
        return betti(*self.dual())

    def closed_betti(self) -> tuple[int, ...]:
        """Of the union of the closed simplices."""
        cells: list[list] = [sorted(set().union(*self.alive)) if self.alive else []]
        sides = {c: c for c in cells[0]}
        for size in range(2, self.dimension + 2):
            faces = {frozenset(f) for s in self.alive for f in combinations(s, size)}
            cells.append([frozenset(sides[g] for g in _sides(f)) for f in faces])
            sides = {f: frozenset(sides[g] for g in _sides(f)) for f in faces}
        return betti(*cells)

    def is_manifold(self) -> bool:
        """No pinches: the boundary facets around each boundary vertex (and 3D edge) make one fan."""
        boundary = self.boundary()
        if self.dimension == 2:
            return set(Counter(c for f in boundary for c in f).values()) <= {2}
        if set(Counter(frozenset(e) for f in boundary for e in combinations(f, 2)).values()) - {2}:
            return False
        links = defaultdict(list)
        for f in boundary:
            for c in f:
                links[c].append(f - {c})
        return all(_pieces(edges) == 1 for edges in links.values())

    def radius(self, s: Simplex) -> float:
        corners = self.points[sorted(s)]
        sides = corners[1:] - corners[0]
        center = np.linalg.solve(2 * sides, (sides**2).sum(axis=1))
        return float(np.sqrt(center @ center))

    def measure(self, facet: frozenset) -> float:
        corners = self.points[sorted(facet)]
        sides = corners[1:] - corners[0]
        gram = np.linalg.det(sides @ sides.T)
        return float(np.sqrt(max(gram, 0.0))) / (1 if self.dimension == 2 else 2)

    def normals_angle(self, s: Simplex) -> float:
        """Angle between the outward normals of the two boundary faces of a salient tetrahedron."""
        normals = []
        for f in self.boundary_facets(s):
            a, b, c = self.points[sorted(f)]
            (apex,) = self.points[list(s - f)]
            n = np.cross(b - a, c - a)
            normals.append(n * -np.sign(n @ (apex - a)) / np.linalg.norm(n))
        u, v = normals
        return float(np.arctan2(np.linalg.norm(np.cross(u, v)), u @ v))


def _sides(face: frozenset):
    """What a face is bounded by; corners stand for themselves."""
    return [next(iter(face - {c})) for c in face] if len(face) == 2 else [face - {c} for c in face]


def _pieces(edges: list[frozenset]) -> int:
    """Connected pieces of a graph given by its edges."""
    left, count = set(edges), 0
    while left:
        count += 1
        reached, grown = set(left.pop()), True
        while grown:
            joined = {e for e in left if e & reached}
            left -= joined
            reached.update(*joined)
            grown = bool(joined)
    return count


Rule = Callable[[Region, Simplex, dict[Simplex, float]], float | None]


def branch(region: Region, s: Simplex, share) -> float | None:
    """2D: p(v)/r(v) of a hat."""
    return share[s] / region.radius(s) if region.is_hat(s) else None


def surface(region: Region, s: Simplex, share) -> float | None:
    """3D: hats always, salients by angle."""
    if region.is_hat(s):
        return -np.inf
    return region.normals_angle(s) if region.is_salient(s) else None


def wireframe(region: Region, s: Simplex, share) -> float | None:
    """3D: salients always, hats by p(v)/r(v)²."""
    if region.is_salient(s):
        return -np.inf
    return share[s] / region.radius(s) ** 2 if region.is_hat(s) else None


def simplify(region: Region, rule: Rule, threshold: float, choose=None, divide=None) -> list[Simplex]:
    """Run the process in place until nothing is left to remove; returns what went, in order.

    ``choose`` picks one of the removable (value, radius, simplex); by default the smallest.
    ``divide`` gives k in p(v)/k; by default the number of neighbours still there.
    """
    share = {s: sum(map(region.measure, region.boundary_facets(s))) for s in region.alive}
    region.share = share
    values = {s: rule(region, s, share) for s in region.alive}
    gone = []
    while True:
        removable = [
            (value, region.radius(s), s)
            for s, value in values.items()
            if value is not None and value < threshold
        ]
        if not removable:
            return gone
        _, _, s = choose(removable) if choose else min(removable, key=lambda entry: entry[:2])
        near = set().union(*(region.around[frozenset({c})] for c in s)) - {s}
        handed = region.neighbors(s)
        k = divide(region, s) if divide else len(handed)
        region.remove(s)
        del values[s]
        gone.append(s)
        for n in handed:
            share[n] += share[s] / k
        for n in near:
            values[n] = rule(region, n, share)


def torus(seed: int = 0) -> psl.DelaunayShape:
    """A solid torus from 45 samples: manifold, every sample on its boundary (seeds 0, 2, 3)."""
    rng = np.random.default_rng(seed)
    u, v = np.meshgrid(2 * np.pi * np.arange(9) / 9, 2 * np.pi * np.arange(5) / 5)
    u, v = (angle.ravel() + rng.normal(0, 0.12, 45) for angle in (u, v))
    across = 3 + np.cos(v)
    t = psl.delaunay(np.column_stack([across * np.cos(u), across * np.sin(u), np.sin(v)]))
    x, y, z = t.points[t.simplices].mean(axis=1).T
    return psl.DelaunayShape(t, np.hypot(np.hypot(x, y) - 3, z) < 1)


def unit_vectors(seed: int, n: int) -> np.ndarray:
    g = np.random.default_rng(seed).normal(size=(n, 3))
    return g / np.linalg.norm(g, axis=1)[:, None]


def hollow_ball(seed: int = 0) -> psl.DelaunayShape:
    """A ball with a cavity: 30 samples outside, 10 inside."""
    points = unit_vectors(seed, 40)
    points[:10] *= 0.4
    t = psl.delaunay(points)
    return psl.DelaunayShape(t, t.simplices.max(axis=1) >= 10)


def egg(seed: int = 0) -> psl.DelaunayShape:
    """The convex hull of 25 samples of an ellipsoid."""
    t = psl.delaunay(unit_vectors(seed, 25) * [1, 0.8, 0.6])
    return psl.DelaunayShape(t, np.ones(len(t.simplices), dtype=bool))


THRESHOLDS = (0.5, 1.5, np.pi, 2 * np.pi, 50.0)
RULES = {"branch": branch, "surface": surface, "wireframe": wireframe}


@cache
def solids() -> tuple[psl.DelaunayShape, ...]:
    """A torus, a hollow ball and an egg: manifolds with every sample on the boundary."""
    found = (torus(), hollow_ball(), egg())
    for P in found:
        region = Region.of(P)
        assert region.is_manifold()
        assert set().union(*region.alive) == set().union(*region.boundary())
    return found


@cache
def polygons() -> tuple[psl.DelaunayShape, ...]:
    return tuple(psl.delaunay_shape(s) for s in gabriel_regions()[:20])


@cache
def noisy_flower(noise: float, petals: int = 5, n: int = 300) -> psl.Shape:
    """A smooth shape with equal petals; every sample is moved along its ray, by about ``noise``."""
    smooth = flower(petals, n).points
    moved = smooth * (1 + noise * np.random.default_rng(petals).normal(size=n)[:, None])
    return psl.conform(ring(moved))


def shuffled(seed: int):
    """Choose what goes next at random."""
    choice = random.Random(seed).choice
    return lambda removable: choice(sorted(removable, key=lambda entry: sorted(entry[2])))


def in_order(h: psl.Hierarchy) -> list[Simplex]:
    """What the library removes, one after the other."""
    return [frozenset(s) for s in h.P.tessellation.simplices[h.simplices[h.order]].tolist()]


def library_dual(P: psl.DelaunayShape, alive: Iterable[Simplex]) -> tuple[set, ...]:
    """Sk0 of some simplices of a region by the library, its cells named as `Region.dual` names them."""
    alive, t = set(alive), P.tessellation
    inner = np.array([frozenset(s) in alive for s in t.simplices.tolist()])
    skeleton = psl.sk0(psl.DelaunayShape(t, inner))
    vertices = [frozenset(s) for s in t.simplices[skeleton.simplices].tolist()]
    edges = {frozenset(vertices[k] for k in edge) for edge in skeleton.edges.tolist()}
    if t.dimension == 2:
        return set(vertices), edges
    polygons = {
        frozenset(frozenset(vertices[k] for k in pair) for pair in pairwise([*p, p[0]]))
        for p in map(list, skeleton.polygons)
    }
    return set(vertices), edges, polygons


def library_betti(P: psl.DelaunayShape, alive: Iterable[Simplex]) -> tuple[int, ...]:
    """Betti numbers of Sk0 of some simplices of a region, by the library."""
    alive, t = set(alive), P.tessellation
    inner = np.array([frozenset(s) in alive for s in t.simplices.tolist()])
    return psl.sk0(psl.DelaunayShape(t, inner)).betti()


def names(P: psl.DelaunayShape, rows: np.ndarray) -> set[frozenset[int]]:
    return {frozenset(s) for s in P.tessellation.simplices[rows].tolist()}


def scaled(P: psl.DelaunayShape, factor: float) -> psl.DelaunayShape:
    """The same region, larger; a power of two rounds nothing."""
    return psl.DelaunayShape(psl.delaunay(P.tessellation.points * factor), P.inner)


def size_changes(strategy: str, factor: float, criterion: str = "corrected") -> bool:
    """Whether the library keeps other simplices when a region is scaled."""
    for seed in range(5):
        P = random_region(seed, 2 if strategy == "branch" else 3)
        h, large = (psl.hierarchy(Q, strategy, criterion) for Q in (P, scaled(P, factor)))
        if not all((h.kept(t) == large.kept(t)).all() for t in THRESHOLDS):
            return True
    return False


def survivors(P: psl.DelaunayShape, rule, threshold: float, choose=None) -> frozenset:
    region = Region.of(P)
    simplify(region, rule, threshold, choose=choose)
    return frozenset(region.alive)
