"""Space in fractions: spheres, inside and outside of a mesh, where segments cross it. Imports no library."""

from __future__ import annotations

from fractions import Fraction


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b, strict=True))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def volume(a, b, c, d):
    """Six times that of a tetrahedron, with its sign."""
    return dot(minus(d, a), cross(minus(b, a), minus(c, a)))


def sphere_center(a, b, c, d):
    """By Cramer's rule, from the planes between a and the others."""
    u, v, w = minus(b, a), minus(c, a), minus(d, a)
    twice = 2 * dot(u, cross(v, w))
    parts = zip(cross(v, w), cross(w, u), cross(u, v), strict=True)
    lifts = dot(u, u), dot(v, v), dot(w, w)
    return tuple(x + dot(lifts, part) / twice for x, part in zip(a, parts, strict=True))


def crossings(p, q, triangles):
    """Points where the segment p q goes through triangles, or None if it touches one at an end or edge."""
    found = []
    for a, b, c in triangles:
        begin, end = volume(a, b, c, p), volume(a, b, c, q)
        if begin == end == 0:
            if _flat_apart(p, q, (a, b, c)):
                continue
            return None
        if begin * end > 0:
            continue
        x = tuple(s + begin / (begin - end) * (t - s) for s, t in zip(p, q, strict=True))
        normal = cross(minus(b, a), minus(c, a))
        depth = min(dot(cross(minus(t, s), minus(x, s)), normal) for s, t in ((a, b), (b, c), (c, a)))
        if depth < 0:
            continue
        if depth == 0 or begin == 0 or end == 0:
            return None
        found.append(x)
    return found


def _flat_apart(p, q, triangle):
    """Whether boxes alone tell that a segment in the plane of a triangle does not meet it."""
    return any(
        max(p[k], q[k]) < min(x[k] for x in triangle) or min(p[k], q[k]) > max(x[k] for x in triangle)
        for k in range(3)
    )


def location(point, triangles):
    """+1 inside, -1 outside, by the parity of crossings along a skew ray; None if it may be on the mesh."""
    reach = 4 * (1 + max(abs(x) for t in [*triangles, (point,)] for p in t for x in p))
    for way in ((1, Fraction(3, 97), Fraction(5, 89)), (Fraction(7, 83), -1, Fraction(2, 79))):
        found = crossings(point, tuple(x + reach * w for x, w in zip(point, way, strict=True)), triangles)
        if found is not None:
            return 1 if len(found) % 2 else -1
    return None
