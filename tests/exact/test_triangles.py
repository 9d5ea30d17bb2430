"""Exact signs of points, segments and triangles in space against rational arithmetic."""

import time
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polyskel_lite import Shape
from polyskel_lite.exact.boxes import self_overlaps
from polyskel_lite.exact.nearest import facet_distance, nearest_facets
from polyskel_lite.exact.regions import locate
from polyskel_lite.exact.triangles import meeting_faces, segment_meets_triangle

GRID = st.integers(0, 3)
POINT = st.tuples(GRID, GRID, GRID)


def _inside_rational(triangles, q) -> int:
    """Winding number along a ray in a direction that meets no edge, all in fractions; 0 on the mesh."""
    direction = (Fraction(1), Fraction(1, 1009), Fraction(1, 1000003))
    winding = 0
    for t in triangles:
        a, b, c = ([Fraction(x) for x in p] for p in t.tolist())
        u, v = ([y[k] - a[k] for k in range(3)] for y in (b, c))
        n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        slope = sum(x * y for x, y in zip(n, direction, strict=True))
        height = sum(n[k] * (a[k] - q[k]) for k in range(3))
        if slope == 0:
            continue
        s = height / slope
        w = [q[k] + s * direction[k] - a[k] for k in range(3)]
        uu, uv, vv = (sum(x * y for x, y in zip(*p, strict=True)) for p in ((u, u), (u, v), (v, v)))
        wu, wv = (sum(x * y for x, y in zip(w, p, strict=True)) for p in (u, v))
        det = uu * vv - uv * uv
        b1, b2 = (wu * vv - wv * uv) / det, (wv * uu - wu * uv) / det
        if b1 >= 0 and b2 >= 0 and b1 + b2 <= 1 and s >= 0:
            if s == 0:
                return 0
            winding += 1 if slope > 0 else -1
    return 1 if winding else -1


@settings(max_examples=60, deadline=None)
@given(st.lists(POINT, min_size=5, max_size=5, unique=True), st.lists(POINT, min_size=6, max_size=6))
def test_locate_agrees_with_rational_rays(corners, queries):
    """Rays through corners and along edges and faces: the grid makes all of them."""
    corners = np.array(corners, dtype=float)
    tetrahedron = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
    volume = np.linalg.det(corners[1:4] - corners[0])
    if round(volume) == 0:
        return
    triangles = corners[tetrahedron if volume > 0 else tetrahedron[:, [0, 2, 1]]]
    found = locate(triangles, np.array(queries, dtype=float))
    assert found.tolist() == [_inside_rational(triangles, q) for q in queries]


def _meets_rational(segment, triangle) -> bool:
    """The same by clipping the segment with the plane, or with the sides' planes when it lies in it."""
    p, q = ([Fraction(x) for x in s] for s in segment.tolist())
    a, b, c = ([Fraction(x) for x in s] for s in triangle.tolist())

    def minus(x, y):
        return [i - j for i, j in zip(x, y, strict=True)]

    def cross(x, y):
        return [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]]

    def dot(x, y):
        return sum(i * j for i, j in zip(x, y, strict=True))

    n = cross(minus(b, a), minus(c, a))
    t0, t1 = Fraction(0), Fraction(1)
    constraints = [(n, a), ([-x for x in n], a)]
    constraints += [(cross(n, minus(y, x)), x) for x, y in ((a, b), (b, c), (c, a))]
    for normal, at in constraints:  # keep the part with normal . (x - at) >= 0
        start, end = dot(normal, minus(p, at)), dot(normal, minus(q, at))
        if start < 0 and end < 0:
            return False
        if (start < 0) != (end < 0):
            cut = start / (start - end)
            t0, t1 = (max(t0, cut), t1) if start < 0 else (t0, min(t1, cut))
    return t0 <= t1


@settings(max_examples=150, deadline=None)
@given(st.lists(POINT, min_size=5, max_size=5))
def test_segment_meets_triangle_agrees_with_rational_clipping(points):
    points = np.array(points, dtype=float)
    segment, triangle = points[:2], points[2:]
    if (
        not np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0]).any()
        or (segment[0] == segment[1]).all()
    ):
        return
    expected = _meets_rational(segment, triangle)
    assert segment_meets_triangle(segment[None], triangle[None])[0] == expected


@settings(max_examples=150, deadline=None)
@given(st.lists(POINT, min_size=6, max_size=6, unique=True), st.sampled_from([0, 1, 2]))
def test_meeting_faces_agrees_with_rational_clipping(points, shared):
    points = np.array(points, dtype=float)
    faces = np.array([(0, 1, 2), (3 - shared, 4 - shared, 5 - shared)])
    s, t = points[faces]
    if any(not np.cross(x[1] - x[0], x[2] - x[0]).any() for x in (s, t)):
        return
    common = [points[k] for k in set(faces[0]) & set(faces[1])]
    # Cut what is shared away: pull each triangle a little (exactly) from the common corners.
    sides = [(x, [x[i], x[(i + 1) % 3]], y) for x, y in ((s, t), (t, s)) for i in range(3)]
    if shared == 0:
        expected = any(_meets_rational(np.array(side), y) for _, side, y in sides)
    else:
        expected = any(_more_than_common(np.array(side), y, common) for _, side, y in sides)
    assert bool(len(meeting_faces(points, faces))) == expected


def _more_than_common(side, triangle, common) -> bool:
    """Whether a side meets a triangle elsewhere than in common corners (or in the common edge)."""
    is_common = [any((p == c).all() for c in common) for p in side]
    if all(is_common):
        return False
    p, q = side if not is_common[0] else side[::-1]
    if not any(is_common):
        return _meets_rational(np.array([p, q]), triangle)
    # From the free end nearly to the common one: anything beyond it would reach further away (convexity).
    return _meets_rational(np.array([p, p + (q - p) * (1 - 2.0**-12)]), triangle)


def test_distance_to_facets_is_the_least_of_all():
    random = np.random.default_rng(3)
    size = 10.0 ** random.uniform(-3, 0, (60, 1, 1))
    triangles = random.normal(size=(60, 1, 3)) + size * random.normal(size=(60, 3, 3))
    queries = 2 * random.normal(size=(200, 3))
    every = [facet_distance(queries, np.broadcast_to(t, (200, 3, 3))) for t in triangles]
    assert nearest_facets(triangles, queries)[0] == pytest.approx(np.min(every, axis=0), abs=1e-12)
    # And a dense sample of one triangle is never nearer, and nearly as near.
    u, v = np.meshgrid(np.linspace(0, 1, 60), np.linspace(0, 1, 60))
    u, v = (x[u + v <= 1] for x in (u, v))
    t = triangles[0]
    samples = t[0] + u[:, None] * (t[1] - t[0]) + v[:, None] * (t[2] - t[0])
    nearest = np.sqrt(((queries[:, None] - samples) ** 2).sum(axis=2)).min(axis=1)
    spacing = np.sqrt(((t[1:] - t[0]) ** 2).sum(axis=1)).max() / 59
    assert (every[0] <= nearest + 1e-12).all()
    assert (nearest <= every[0] + spacing).all()


@pytest.mark.parametrize("spread", [0.0, 1.5])
def test_self_overlaps_are_all_and_only_once(spread):
    random = np.random.default_rng(8)
    low = random.integers(0, 40, (300, 3)) / 4  # many boxes touch exactly
    high = low + np.round(10 ** random.normal(0, spread, (300, 3)) * 4) / 4
    found = [(i, j) for a, b in self_overlaps(low, high) for i, j in zip(a.tolist(), b.tolist(), strict=True)]
    every = (low[:, None] <= high[None]).all(axis=2)
    assert sorted(found) == list(map(tuple, np.argwhere(np.triu(every & every.T, 1)).tolist()))


def test_twenty_thousand_faces_take_seconds():
    """The brute force would look at 200 million pairs."""
    t, u = np.meshgrid(*[np.arange(100) * 2 * np.pi / 100] * 2, indexing="ij")
    ring = 3 + np.cos(u)
    points = np.stack([ring * np.cos(t), ring * np.sin(t), np.sin(u)], axis=-1).reshape(-1, 3)
    k = np.arange(10_000).reshape(100, 100)
    right, up, both = np.roll(k, -1, axis=0), np.roll(k, -1, axis=1), np.roll(k, -1, axis=(0, 1))
    faces = np.stack([np.stack([k, right, both], axis=-1), np.stack([k, both, up], axis=-1)]).reshape(-1, 3)
    begin = time.process_time()
    shape = Shape(points, faces)
    assert time.process_time() - begin < 8  # about one second on an idle machine
    assert shape.betti() == (1, 1, 0)
