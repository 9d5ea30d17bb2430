"""Space in fractions: Delaunay, Voronoi, Gabriel, inside and outside, Sk0 to Sk3 of a few samples.

By definition and by brute force over all four samples, like `rational` for the plane. Samples are in general
position: no five are cospherical, and no Voronoi vertex is on the boundary (both are asserted).
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from itertools import combinations, pairwise

#: Directions of rays; one of them passes through no edge.
RAYS = ((1, 0, 0), (101, 7, 13), (17, 103, -5), (-11, 19, 107), (97, -89, 61))


def minus(p, q):
    return tuple(a - b for a, b in zip(p, q, strict=True))


def inner(p, q):
    return sum(a * b for a, b in zip(p, q, strict=True))


def cross(p, q):
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])


def sign(x) -> int:
    return (x > 0) - (x < 0)


def volume(a, b, c, d):
    """Six times the signed volume."""
    return inner(minus(b, a), cross(minus(c, a), minus(d, a)))


def circumcenter(a, b, c, d):
    """Centre of the sphere through four points, which are not in one plane."""
    u, v, w = (minus(p, a) for p in (b, c, d))
    twice = 2 * inner(u, cross(v, w))
    weighted = [tuple(inner(x, x) * t for t in cross(y, z)) for x, y, z in ((u, v, w), (v, w, u), (w, u, v))]
    return tuple(p + Fraction(sum(t)) / twice for p, t in zip(a, zip(*weighted, strict=True), strict=True))


def face_center(a, b, c):
    """Centre of the circle through three points."""
    n = cross(minus(b, a), minus(c, a))
    lift = tuple(x + t for x, t in zip(a, n, strict=True))
    # The sphere through a, b, c and any further point has its centre above that of the circle.
    m = circumcenter(a, b, c, lift)
    along = Fraction(inner(minus(m, a), n)) / inner(n, n)
    return tuple(x - along * t for x, t in zip(m, n, strict=True))


def squared(p, q):
    return inner(minus(p, q), minus(p, q))


def strictly_gabriel(a, b, c, samples) -> bool:
    """No other sample in the closed ball around the circle through three."""
    m = face_center(a, b, c)
    return all(squared(m, s) > squared(m, a) for s in samples if s not in (a, b, c))


def empty_spheres(samples) -> dict[frozenset[int], tuple]:
    """Centres of the spheres through four samples with none inside, by the numbers of the four."""
    found = {}
    for four in combinations(range(len(samples)), 4):
        corners = [samples[k] for k in four]
        if volume(*corners) == 0:
            continue
        m = circumcenter(*corners)
        r = squared(m, corners[0])
        others = [squared(m, samples[k]) for k in range(len(samples)) if k not in four]
        if all(d >= r for d in others):
            assert all(d > r for d in others), "five cospherical samples"
            found[frozenset(four)] = m
    return found


def sides(spheres) -> dict[frozenset[int], list[frozenset[int]]]:
    """For every three samples on empty spheres those spheres, two, or one on the hull."""
    found: dict = {}
    for four in spheres:
        for three in combinations(sorted(four), 3):
            found.setdefault(frozenset(three), []).append(four)
    return found


def rings(spheres) -> dict[frozenset[int], list[frozenset[int]]]:
    """For every two samples that are no hull edge the spheres through both, in order around them."""
    beside, found = sides(spheres), {}
    for pair in {frozenset(p) for four in spheres for p in combinations(sorted(four), 2)}:
        around = [four for four in spheres if pair <= four]
        walk, last = [around[0]], None
        while True:
            ahead = [
                n
                for three, both in beside.items()
                if pair < three and walk[-1] in both
                for n in both
                if n != walk[-1] and three != last
            ]
            if not ahead:
                break  # the hull
            step = ahead[0]
            last = walk[-1] & step
            if step == walk[0]:
                found[pair] = walk
                break
            walk.append(step)
    return found


def location(p, faces) -> int:
    """+1 inside a closed surface, 0 on it, -1 outside, by counting rational crossings."""
    for a, b, c in faces:
        if volume(a, b, c, p) == 0:
            above = tuple(x + t for x, t in zip(p, cross(minus(b, a), minus(c, a)), strict=True))
            turns = {sign(volume(above, p, u, v)) for u, v in ((a, b), (b, c), (c, a))}
            if not {1, -1} <= turns:
                return 0
    for ray in RAYS:
        ahead, crossings, doubtful = tuple(x + t for x, t in zip(p, ray, strict=True)), 0, False
        for a, b, c in faces:
            turns = {sign(volume(p, ahead, u, v)) for u, v in ((a, b), (b, c), (c, a))}
            if {1, -1} <= turns:
                continue
            if 0 in turns:
                doubtful = True
                break
            n = cross(minus(b, a), minus(c, a))
            crossings += inner(minus(a, p), n) * inner(ray, n) > 0
        if not doubtful:
            return 1 if crossings % 2 else -1
    raise AssertionError("every ray meets an edge")


def meets(p, q, a, b, c) -> bool:
    """Whether the closed segment pq and the closed triangle abc have a point in common."""
    high, low = volume(a, b, c, p), volume(a, b, c, q)
    if high * low > 0:
        return False
    assert high != 0 or low != 0, "a segment in the plane of a triangle"
    turns = {sign(volume(p, q, u, v)) for u, v in ((a, b), (b, c), (c, a))}
    return not {1, -1} <= turns


@cache
def samples(points: tuple, facets: tuple) -> Samples:
    """The same object for the same numbers."""
    return Samples(points, facets)


class Samples:
    """The boundary points of a solid with its faces, and its skeletons by definition.

    Vertices are named by four samples, edges by three, polygons by two.
    """

    def __init__(self, points, facets):
        self.points = [tuple(map(Fraction, p)) for p in points]
        self.facets = [frozenset(f) for f in facets]
        self.faces = [tuple(self.points[k] for k in f) for f in facets]
        self.centers = empty_spheres(self.points)
        self.sides, self.rings = sides(self.centers), rings(self.centers)

    def side(self, p) -> int:
        return location(p, self.faces)

    @cache  # noqa: B019 - there are a dozen of them
    def sk0(self, inside=1):
        """The dual of the simplices on one side; the boundary is made of Delaunay faces."""
        assert all(f in self.sides for f in self.facets)
        kept = {four for four in self.centers if self.side(self._middle(four)) == inside}
        walls = set(self.facets)
        edges = {
            f for f, both in self.sides.items() if len(both) == 2 and set(both) <= kept and f not in walls
        }
        polygons = {
            pair
            for pair, ring in self.rings.items()
            if set(ring) <= kept and not any(pair < f for f in walls)
        }
        return kept, edges, polygons

    @cache  # noqa: B019
    def sk1(self, inside=1):
        where = {four: self.side(m) for four, m in self.centers.items()}
        assert 0 not in where.values(), "a Voronoi vertex on the boundary"
        return {four for four, place in where.items() if place == inside}

    @cache  # noqa: B019
    def sk2(self, inside=1):
        """Vertices, bounded edges and polygons that are wholly on one side."""
        kept = self.sk1(inside)
        edges = {
            f for f, both in self.sides.items() if len(both) == 2 and set(both) <= kept and self._free(*both)
        }
        polygons = {
            pair
            for pair, ring in self.rings.items()
            if set(ring) <= kept
            and all(a & b in edges for a, b in zip(ring, ring[1:] + ring[:1], strict=True))
            and not self._pierced(ring)
        }
        return kept, edges, polygons

    def _between(self, kept) -> set[frozenset[int]]:
        """The three samples of every two neighbours."""
        return {f for f, both in self.sides.items() if len(both) == 2 and set(both) <= kept}

    def _middle(self, four):
        return tuple(sum(x) / 4 for x in zip(*(self.points[k] for k in four), strict=True))

    def _free(self, one, other) -> bool:
        return not any(meets(self.centers[one], self.centers[other], *face) for face in self.faces)

    def _pierced(self, ring) -> bool:
        """Whether a boundary edge goes through a Voronoi polygon, which is convex."""
        corners = [self.centers[four] for four in ring]
        ends = {frozenset(pair) for f in self.facets for pair in combinations(f, 2)}
        segments = [[self.points[k] for k in pair] for pair in ends]
        return any(meets(p, q, corners[0], b, c) for b, c in pairwise(corners[1:]) for p, q in segments)
