"""The tessellation that grows: Delaunay by definition, one answer for given points."""

from fractions import Fraction
from itertools import permutations, product
from unittest.mock import patch

import numpy as np
import pytest
from truth.point_sets import FAMILIES, draw

import polyskel_lite as psl
from polyskel_lite.compiling import Loops
from polyskel_lite.exact import components, in_ball, orientation
from polyskel_lite.exact.signs import loops as sign_loops
from polyskel_lite.exact.signs import whole_numbers
from polyskel_lite.graphs import growing, triangulation
from polyskel_lite.graphs.growing import Growing
from polyskel_lite.graphs.triangulation import problem


def rows(simplices, points) -> set:
    """Simplices as sets of coordinates."""
    return {frozenset(map(tuple, points[simplex].tolist())) for simplex in simplices}


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("name", FAMILIES)
def test_one_answer_that_is_delaunay(name, dimension):
    """Compiled, plain, in another order, in two parts: the same simplices, which pass the exact check."""
    for seed in range(6):
        points = draw(
            name, [seed, dimension], dimension, (30, 120)[seed % 2] if dimension == 2 else (14, 50)[seed % 2]
        )
        try:
            grown = Growing(points, compiled=seed < 4)
        except psl.TessellationError:
            assert not orientation(
                points[np.random.default_rng(0).integers(0, len(points), (400, dimension + 1))]
            ).any()
            continue
        simplices, neighbors = grown.simplices_and_neighbors()
        assert problem(points, simplices, neighbors) == ""
        assert_cones(points, simplices, neighbors)
        for again in (Growing(points, compiled=False), Growing(points, compiled=True)):
            assert all(map(np.array_equal, again.simplices_and_neighbors(), (simplices, neighbors)))
        order = np.random.default_rng(seed).permutation(len(points))
        other = Growing(points[order], compiled=True).simplices_and_neighbors()[0]
        assert rows(other, points[order]) == rows(simplices, points)
        assert_parts(points, simplices, neighbors, compiled=seed % 2 > 0)


def assert_cones(points, simplices, neighbors):
    """Every cospherical cell is divided from its first vertex by coordinates."""
    first, local = np.nonzero(neighbors >= 0)
    second = neighbors[first, local]
    apex = simplices[second].sum(axis=1) - (simplices[first].sum(axis=1) - simplices[first, local])
    tie = in_ball(points[simplices[first]], points[apex]) == 0
    _, label = components(len(simplices), np.stack([first[tie], second[tie]], axis=1))
    place = np.lexsort(points.T[::-1]).argsort()
    least = np.full(len(simplices), len(points))
    np.minimum.at(least, label, place[simplices].min(axis=1))
    assert (place[simplices].min(axis=1) == least[label]).all()


def assert_parts(points, simplices, neighbors, compiled):
    """Half of the points and then the rest make the same; what changed is what differs."""
    half = len(points) // 2
    try:
        grown = Growing(points[:half], compiled=compiled)
    except (psl.TessellationError, IndexError):
        return
    before = rows(grown.simplices_and_neighbors()[0], points)
    change = grown.add(points[half:])
    assert all(map(np.array_equal, grown.simplices_and_neighbors(), (simplices, neighbors)))
    gone, come = (rows(s[s.min(axis=1) >= 0], points) for s in (change.gone, change.come))
    after = rows(simplices, points)
    assert before - after <= gone <= before
    assert after - before <= come <= after
    for simplex, apexes in zip(change.come.tolist(), change.apexes.tolist(), strict=True):
        for k, apex in enumerate(apexes):
            facet = set(simplex[:k] + simplex[k + 1 :])
            if -1 not in facet:
                sides = [row for row in simplices.tolist() if facet <= set(row)]
                assert {simplex[k], apex} - {-1} == {v for row in sides for v in row} - facet


@pytest.mark.parametrize("dimension", [2, 3])
def test_signs_where_floats_are_wrong(dimension):
    """Points within a few last bits of a line, plane, circle or sphere: every sign by fractions."""
    rng = np.random.default_rng(dimension)
    turn, ball = ("turn_2d", "in_circle") if dimension == 2 else ("turn_3d", "in_sphere")
    seen, expected, rounded = [], [], []
    for k in range(400):
        points = rng.normal(size=(dimension + 2, dimension))
        if k % 2:
            points /= np.linalg.norm(points, axis=1)[:, None]
        else:  # the last corner is on the line or plane of the others, but for rounding
            points[-2] = rng.dirichlet(np.ones(dimension)) @ points[:dimension]
        points = points / 8 if k % 3 else (points * 2.0**20).round() / 2.0**24
        both = []
        for compiled in (False, True):
            loops = sign_loops.made(compiled)
            numbers = whole_numbers(points, compiled)
            flat = points.ravel() if compiled else points.ravel().tolist()
            sign = getattr(loops, turn)(flat, numbers, *range(dimension + 1))
            both.append((sign, getattr(loops, ball)(flat, numbers, *range(dimension + 2)) * sign))
        assert both[0] == both[1]
        *corners, query = [tuple(map(Fraction, point)) for point in points.tolist()]
        area = determinant([[x - y for x, y in zip(p, corners[-1], strict=True)] for p in corners[:-1]])
        seen.append(both[0])
        expected.append(((area > 0) - (area < 0), power(corners, query) if area else 0))
        lifted = np.column_stack([points, (points**2).sum(axis=1), np.ones(dimension + 2)])
        flat = np.delete(lifted[:-1], dimension, axis=1)
        rounded.append((np.sign(np.linalg.det(flat)), np.sign(np.linalg.det(flat) * np.linalg.det(lifted))))
    assert seen == expected
    for which in (0, 1):
        wrong = sum(x[which] != y[which] for x, y in zip(rounded, expected, strict=True))
        assert min(wrong, 400 - wrong) > 20  # the plain determinants have the other sign in one dimension


def power(corners, query) -> int:
    """+1 where the query is nearer to the centre of the corners' sphere than these; Cramer's rule."""
    base = corners[0]
    ways = [[x - y for x, y in zip(p, base, strict=True)] for p in corners[1:]]
    right = [sum(x * x for x in way) / 2 for way in ways]
    whole = determinant(ways)
    center = [
        determinant([[*way[:k], r, *way[k + 1 :]] for way, r in zip(ways, right, strict=True)]) / whole
        for k in range(len(base))
    ]
    radius2 = sum(x * x for x in center)
    distance2 = sum((q - b - c) ** 2 for q, b, c in zip(query, base, center, strict=True))
    return (radius2 > distance2) - (radius2 < distance2)


def determinant(rows):
    if len(rows) == 1:
        return rows[0][0]
    return sum(
        (-1) ** k * row[0] * determinant([r[1:] for r in rows[:k] + rows[k + 1 :]])
        for k, row in enumerate(rows)
    )


def test_where_scaling_loses_digits():
    """Coordinates of 1e300 and 1e-20 together have no common unit in floats; whole numbers have."""
    points = np.array(
        [(0.0, 0.0), (1e300, 0.0), (1e300, 1e300), (0.0, 1e300), (1e-20, 3e-20), (2e-20, 1e-20)]
    )
    grown = Growing(points, compiled=True)
    assert not grown.compiled
    assert len(grown.simplices_and_neighbors()[0]) == 6
    late = Growing(points[:4], compiled=True)
    assert late.compiled
    late.add(points[4:])
    assert not late.compiled
    assert np.array_equal(late.simplices_and_neighbors()[0], grown.simplices_and_neighbors()[0])


def test_points_that_scaling_makes_equal():
    """What is lost in scaling decides neither ties nor which points are equal; it went on for ever."""
    least = 2.0**-1074
    points = np.array([(0, 0), (least, 0), (2 * least, 0), (10, 0), (0, 10)])
    simplices, neighbors = Growing(points).simplices_and_neighbors()
    assert problem(points, simplices, neighbors) == ""
    order = [3, 1, 4, 0, 2]
    assert rows(Growing(points[order]).simplices_and_neighbors()[0], points[order]) == rows(simplices, points)
    with pytest.raises(psl.DuplicatePointError, match="points 1 and 5"):
        Growing(np.concatenate([points, points[1:2]]))


@pytest.mark.parametrize("dimension", [2, 3])
def test_qhull_and_the_loops_agree(dimension, monkeypatch):
    """Small sets without ties go through Qhull, unless compiled loops are at hand."""
    points = np.random.default_rng(0).random((60, dimension))
    monkeypatch.setattr(growing, "_used", set())
    monkeypatch.setattr(triangulation, "Growing", pytest.fail)
    quick = psl.delaunay(points)
    monkeypatch.undo()
    grown = Growing(points).simplices_and_neighbors()
    assert np.array_equal(quick.simplices, grown[0])
    assert np.array_equal(quick.neighbors, grown[1])


@pytest.mark.parametrize("spoil", ["nothing", "inside out", "error"])
def test_what_qhull_gets_wrong_is_not_taken(spoil, monkeypatch):
    class Wrong:
        def __init__(self, points):
            if spoil == "error":
                raise triangulation.QhullError("no")
            self.simplices = np.array(
                [[0, 1, 2], [0, 2, 3]] if spoil == "nothing" else [[0, 1, 2], [1, 2, 3]]
            )
            self.neighbors = np.array([[-1, 1, -1], [-1, -1, 0]])

    monkeypatch.setattr(growing, "_used", set())
    monkeypatch.setattr(triangulation, "Delaunay", Wrong)
    kite = np.array([(0.0, 0.0), (1.0, -3.0), (2.0, 0.0), (1.0, 3.0)])  # the short diagonal is right
    assert psl.delaunay(kite).simplices.tolist() == [[0, 1, 2], [0, 2, 3]]


def test_without_numba_the_loops_are_plain(monkeypatch):
    points = draw("box", 0, 3, 300)
    monkeypatch.setattr(growing, "_used", set())
    with patch.dict("sys.modules", {"numba": None}):
        grown = Growing(points)
    assert not grown.compiled
    assert np.array_equal(
        grown.simplices_and_neighbors()[0], Growing(points, compiled=True).simplices_and_neighbors()[0]
    )


def test_a_numba_that_shall_not_compile(monkeypatch):
    config = pytest.importorskip("numba").config
    monkeypatch.setattr(growing, "_used", set())
    monkeypatch.setattr(config, "DISABLE_JIT", True)
    assert not Growing(draw("box", 0, 3, 300)).compiled


def test_no_folder_for_the_cache(monkeypatch):
    """A library that belongs to another user, and no home: numba refuses to cache, not to compile."""
    caching = pytest.importorskip("numba.core.caching")
    monkeypatch.setattr(caching.CompileResultCacheImpl, "_locator_classes", [])
    loops = Loops()
    loops("int64(int64)")(_twice)
    assert not loops.is_cached()
    assert loops.made(True)._twice(4) == 8


def _twice(a):
    return 2 * a


def test_small_sets_compile_nothing(monkeypatch):
    monkeypatch.setattr(growing, "_used", set())
    monkeypatch.setattr(growing.loops, "is_cached", lambda **_: False)
    monkeypatch.setattr(
        growing.loops, "made", lambda compiled, **_: pytest.fail("compiled") if compiled else None
    )
    assert not growing.compiled_wanted(1_999, 3, hard=True)


@pytest.mark.parametrize("compiled", [False, True])
def test_equal_points_are_named(compiled):
    points = draw("uniform", 0, 3, 40)
    with pytest.raises(psl.DuplicatePointError, match="points 7 and 40"):
        Growing(np.concatenate([points, points[7:8]]), compiled=compiled)
    grown = Growing(points, compiled=compiled)
    with pytest.raises(psl.DuplicatePointError, match="points 7 and 40"):
        grown.add(points[7:8])


def test_room_runs_out():
    """More simplices than expected: points on two skew lines are all joined with each other."""
    t = np.linspace(0, 1, 60)
    points = np.concatenate([np.stack([t, 0 * t, 0 * t], axis=1), np.stack([0 * t, t, 0 * t + 1], axis=1)])
    for compiled in (False, True):
        assert len(Growing(points, compiled=compiled).simplices_and_neighbors()[0]) == 59 * 59


QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def cube(diagonals) -> psl.Shape:
    """A cube whose six faces have these diagonals, 0 or 1 each."""
    points = np.array([(x, y, z) for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)])
    faces = []
    for (a, b, c, d), diagonal in zip(QUADS, diagonals, strict=True):
        faces += [(a, b, c), (a, c, d)] if diagonal else [(b, c, d), (b, d, a)]
    return psl.Shape.from_mesh(points, faces)


def test_diagonals_of_a_cube():
    """Where cones in some order of vertices have all diagonals, they are there; `conform` flips others."""
    reached = set()
    for order in permutations(range(8)):
        least = [min(quad, key=order.index) for quad in QUADS]
        reached.add(tuple(int(v in (quad[0], quad[2])) for v, quad in zip(least, QUADS, strict=True)))
    kept = set()
    for diagonals in product((0, 1), repeat=6):
        shape = cube(diagonals)
        t = shape.tessellation
        assert problem(t.points, t.simplices, t.neighbors) == ""
        if not len(psl.missing_facets(shape)):
            kept.add(diagonals)
        refined = psl.conform(shape)
        assert (len(refined.points), refined.volume(), len(psl.missing_facets(refined))) == (8, 1, 0)
        order = np.random.default_rng(0).permutation(8)
        other = psl.Shape(shape.points[order], np.argsort(order)[shape.facets])
        assert rows(other.tessellation.simplices, other.points) == rows(t.simplices, t.points)
    assert reached <= kept


def test_the_prism_that_no_tessellation_has():
    """A right prism over a triangle: with cyclic diagonals on its sides it cannot be cut without a point."""
    points = np.array([(x, y, z) for z in (0.0, 1) for x, y in ((0, 0), (4, 0), (1, 3))])
    sides = [face for i in range(3) for j in [(i + 1) % 3] for face in ((i, j, j + 3), (i, j + 3, i + 3))]
    shape = psl.Shape.from_mesh(points, [(0, 2, 1), (3, 4, 5), *sides])
    with pytest.raises(psl.ContourContainmentError, match="are not in the Delaunay tessellation"):
        psl.delaunay_shape(shape)
    refined = psl.conform(shape)
    assert (len(refined.points), refined.volume()) == (6, shape.volume())
    assert psl.delaunay_shape(refined).betti() == (1, 0, 0)
