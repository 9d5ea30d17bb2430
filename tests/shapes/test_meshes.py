"""Triangle meshes as shapes: what is refused, and exact signs against rational arithmetic."""

import time
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from truth.meshes import CUBE, CUBE_FACES, cube, inward, moved, together

from polyskel_lite import DuplicatePointError, InputError, Shape, ShapeError
from polyskel_lite.exact.boxes import self_overlaps
from polyskel_lite.exact.nearest import nearest_facets
from polyskel_lite.exact.triangles import (
    locate_in_mesh,
    meeting_faces,
    point_triangle_distance,
    segment_meets_triangle,
)


def test_measures_of_a_cube():
    shape = Shape(*cube(2.0, low=10.0))
    assert shape.dimension == 3
    assert shape.volume() == shape.measure() == pytest.approx(8)
    assert shape.surface() == shape.boundary_measure() == pytest.approx(24)
    assert shape.betti() == (1, 0, 0)
    assert shape.covering_radius() == pytest.approx(2**0.5, rel=1e-5)
    assert shape.sampling_density([(10, 10, 10)]) == pytest.approx(1 / 12**0.5, rel=1e-5)


def test_cavity_island_and_two_solids():
    nested = together(cube(9), inward(cube(5, 1)), cube(3, 2), inward(cube(1, 3)), cube(1, 20))
    shape = Shape(*nested)
    assert shape.betti() == (3, 0, 2)
    assert shape.volume() == pytest.approx(729 - 125 + 27 - 1 + 1)
    heights = [(x, x, x) for x in (0.5, 1, 1.5, 2, 2.5, 3.5, 20.5, 30)]
    assert shape.locate(heights).tolist() == [1, 0, -1, 0, 1, -1, 1, -1]
    assert shape.contains([(0.5, 0.5, 0.5), (1, 1, 1), (1.5, 1.5, 1.5)]).tolist() == [True, True, False]


def test_from_mesh_turns_surfaces_and_drops_unused_vertices():
    points, faces = together(inward(cube(9)), cube(5, 1), inward(cube(3, 2)))
    extra = np.concatenate([[(99.0, 99, 99)], points])
    with pytest.raises(ShapeError, match="an outer surface is turned inward: surface 0 of 3, with face 0"):
        Shape.from_mesh(extra, faces + 1)
    shape = Shape.from_mesh(extra, faces + 1, turn=True)
    assert len(shape.points) == 24
    assert shape.volume() == pytest.approx(729 - 125 + 27)


def mangled(points=(), drop=(), add=(), base=None):
    """The cube with points appended, faces dropped and added."""
    V, F = cube() if base is None else base
    V = np.concatenate([V, np.reshape(points, (-1, 3))])
    F = np.delete(F, list(drop), axis=0)
    return V, np.concatenate([F, np.reshape(add, (-1, 3)).astype(int)])


REFUSED = {
    "no faces": (mangled(drop=range(12)), "has no face"),
    "open": (
        mangled(drop=[0]),
        r"open: edge \d-\d near .* has 1 face \(\d+\), not two; fill .*\(3 such edges\)",
    ),
    "fin": (mangled([(2, 2, 2)], add=[(0, 1, 8), (1, 0, 8)]), r"not manifold: edge 0-1 .* 4 faces \(0, .*\)"),
    "turned face": (mangled(drop=[0], add=[(0, 3, 1)]), r"faces \d+ and \d+ both run from vertex"),
    "inside out": (inward(cube()), "outer surface is turned inward"),
    "filled cavity": (together(cube(9), cube(2, 1)), "a cavity is turned outward: surface 1 of 2"),
    "unused": (mangled([(5, 5, 5)]), r"vertex 8 at \(5, 5, 5\) is in no face"),
    "flat face": (
        mangled([(0.5, 0, 0)], drop=[4], add=[(0, 8, 4), (0, 4, 8), (0, 4, 5)]),
        r"face 11 \(vertices 0-8-4\) .* no area",
    ),
    "repeated corner": (mangled(add=[(0, 0, 1)]), r"face 12 \(vertices 0-0-1\)"),
    "crossing": (together(cube(), cube(1, 0.5)), r"face \d+ \(vertices .*\) meets face \d+ .* such pairs"),
    "touching planes": (together(cube(), moved(1, 0.25, 0.25)), "meets face"),
    "touching edge": (together(cube(), moved(1, 1, 0.5)), "meets face"),
    "touching corner": (together(cube(), moved(1, 0.25, 0.25, size=0.5)), "meets face"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refused(case):
    (points, faces), message = REFUSED[case]
    with pytest.raises(ShapeError, match=message):
        Shape(points, faces)


def test_two_surfaces_at_one_vertex():
    points, faces = together(cube(), (CUBE + 1, CUBE_FACES))
    faces = np.where(faces == 8, 7, faces)  # the lowest corner of one is the highest of the other
    faces[faces > 8] -= 1
    with pytest.raises(ShapeError, match=r"at vertex 7 near \(1, 1, 1\) two or more surfaces touch"):
        Shape(np.delete(points, 8, axis=0), faces)


def test_pillow_of_two_equal_triangles():
    with pytest.raises(ShapeError, match=r"face 0 \(vertices 0-1-2\) meets face 1 \(vertices 0-2-1\)"):
        Shape([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 1)])


def test_folded_flat():
    """Two neighbours in one plane on one side of their edge."""
    points = [(0, 0, 0), (4, 0, 0), (2, 4, 0), (2, 2, 0)]
    faces = [(0, 1, 2), (1, 0, 3), (1, 3, 2), (0, 2, 3)]
    with pytest.raises(ShapeError, match=r"face 0 \(vertices 0-1-2\) meets face 1"):
        Shape(points, faces)


def test_bad_arrays():
    points, faces = cube()
    with pytest.raises(InputError, match=r"facets has shape \(12, 2\) .* pass an \(m, 3\) array of int"):
        Shape(points, faces[:, :2])
    with pytest.raises(InputError, match=r"facets\[0, 0\] is 8, but vertices are 0 to 7"):
        Shape(points, faces + 8)
    with pytest.raises(InputError, match=r"V\[0, 0\] is nan"):
        Shape.from_mesh(np.full((8, 3), np.nan), faces)
    with pytest.raises(DuplicatePointError, match="points 0 and 8 are both at"):
        Shape(*together(cube(), cube()))


@pytest.mark.parametrize("name", ["rings", "area", "length"])
def test_plane_only_methods_say_what_to_use(name):
    with pytest.raises(InputError, match=rf"{name}\(\) is for shapes in the plane; .* use "):
        getattr(Shape(*cube()), name)()


def test_space_only_methods_and_sampling():
    with pytest.raises(InputError, match=r"volume\(\) is for shapes in space; this one is in 2D: use area"):
        Shape.from_rings([[(0, 0), (1, 0), (0, 1)]]).volume()
    with pytest.raises(InputError, match=r"sample\(\) is for shapes in the plane"):
        Shape(*cube()).resample(10)


def test_far_away_and_tiny():
    for scale, shift in ((1e-9, 0.0), (1.0, 2.0**40), (1e9, -1e12)):
        shape = Shape(CUBE * scale + shift, CUBE_FACES)
        assert shape.betti() == (1, 0, 0)
        middle = shape.points.mean(axis=0)
        assert shape.locate([middle, shape.points[3], middle + 2 * scale]).tolist() == [1, 0, -1]


# --- exact signs against rational arithmetic ------------------------------------------------------

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
    found = locate_in_mesh(triangles, np.array(queries, dtype=float))
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
    every = [point_triangle_distance(queries, np.broadcast_to(t, (200, 3, 3))) for t in triangles]
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
