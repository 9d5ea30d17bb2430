"""Unions of discs against slow but plain computations, and the union of Delaunay discs of section 3.2."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Delaunay, cKDTree

from polyskel_lite import Shape, conform, datasets
from polyskel_lite.polyballs.discs import _wrapped
from polyskel_lite.polyballs.polyball import Polyball


def oracle(centers, radii, slack=1e-9):
    """Candidates for nearest boundary points, by looking at every crossing and every other disc.

    Returns the points of the boundary on two circles, and a function for distances: the nearest boundary
    point is such a point, or lies straight ahead of (or behind) a centre.
    """
    crossings = []
    for i in range(len(radii)):
        for j in range(i):
            across = centers[j] - centers[i]
            d = np.hypot(*across)
            if d == 0 or d > radii[i] + radii[j] + slack or d < abs(radii[i] - radii[j]) - slack:
                continue
            along = (d * d + radii[i] ** 2 - radii[j] ** 2) / (2 * d)
            aside = np.sqrt(max(radii[i] ** 2 - along**2, 0))
            for side in (aside, -aside):
                step = (along * across + side * np.array([-across[1], across[0]])) / d
                crossings.append(centers[i] + step)

    def on_boundary(points):
        far = np.hypot(*(points[:, None] - centers).transpose(2, 0, 1))
        return (far >= radii - slack).all(axis=1)

    crossings = np.array(crossings).reshape(-1, 2)
    crossings = crossings[on_boundary(crossings)] if len(crossings) else crossings

    def distance(q):
        away = q - centers
        far = np.hypot(*away.T)
        away[far == 0], far[far == 0] = (1, 0), 1
        ahead = centers + away * (radii / far)[:, None]
        points = np.concatenate([crossings, ahead[on_boundary(ahead)]])
        return np.hypot(*(points - q).T).min()

    return crossings, distance


def sliced_area(centers, radii, slices=4000):
    """Lengths of the union along horizontal lines, by merging intervals."""
    low, high = (centers[:, 1] - radii).min(), (centers[:, 1] + radii).max()
    step = (high - low) / slices
    total = 0.0
    for y in low + step * (np.arange(slices) + 0.5):
        cut = np.abs(centers[:, 1] - y) < radii
        half = np.sqrt(radii[cut] ** 2 - (centers[cut, 1] - y) ** 2)
        reach = -np.inf
        for a, b in sorted(zip(centers[cut, 0] - half, centers[cut, 0] + half, strict=True)):
            total += max(0, b - max(a, reach)) * step
            reach = max(reach, b)
    return total


def circumscribed(points, simplices):
    a, b, c = (points[simplices[:, k]] for k in range(3))
    b, c = b - a, c - a
    double = 2 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
    flat = double == 0  # Qhull leaves triangles without area between collinear samples of the hull
    a, b, c, double = (values[~flat] for values in (a, b, c, double))
    bb, cc = (b**2).sum(axis=1), (c**2).sum(axis=1)
    u = np.stack([c[:, 1] * bb - b[:, 1] * cc, b[:, 0] * cc - c[:, 0] * bb], axis=1) / double[:, None]
    return a + u, np.hypot(*u.T)


def inner_delaunay_discs(shape):
    """Y_w of section 3.2: the Delaunay discs whose centres are in the shape."""
    centers, radii = circumscribed(shape.points, Delaunay(shape.points).simplices)
    kept = shape.contains(centers)
    return Polyball(centers[kept], radii[kept])


def closed_chains(arcs, centers, radii, decimals=6):
    """Every end of an arc is the start of another one."""
    ball, start, end = arcs
    part = end - start < 2 * np.pi
    ends = [
        centers[ball[part]] + radii[ball[part], None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        for angle in (start[part], end[part])
    ]
    if not part.any():
        return True
    gap, _ = cKDTree(ends[0]).query(ends[1])
    return bool((gap < 10.0**-decimals).all())


def discs(number, radius):
    return st.lists(st.tuples(number, number, radius), min_size=1, max_size=9).map(
        lambda rows: (np.array(rows, dtype=float)[:, :2], np.array(rows, dtype=float)[:, 2])
    )


# Whole numbers make coincident, concentric and touching discs and triple crossings common.
WHOLE = discs(st.integers(0, 6), st.integers(1, 4))
REAL = discs(st.floats(0, 6), st.floats(0.5, 3))


# --- known answers


def test_one_disc_is_a_whole_circle():
    Y = Polyball([(1, 2)], [3])
    ball, start, end = Y.arcs()
    assert (ball.tolist(), start.tolist(), end.tolist()) == ([0], [-np.pi], [np.pi])
    assert Y.singular_points().shape == (0, 2)
    assert Y.area() == pytest.approx(9 * np.pi, rel=1e-14)
    assert Y.boundary_distance([(1, 2), (1, -1), (5, 2)]).tolist() == [3, 0, 1]


@pytest.mark.parametrize("shift", [(0, 0), (1e6, -3e5)])
@pytest.mark.parametrize("scale", [1e-5, 1, 1e7])
@pytest.mark.parametrize(
    ("d", "a", "b"), [(1, 1, 1), (1.2, 1, 0.5), (2.9, 2, 1), (1.9999, 1, 1), (0.51, 1, 0.5)]
)
def test_two_discs(d, a, b, scale, shift):
    """Area by the formula of the lens, singular points by the law of cosines; at any place and size."""
    turn = np.array([0.6, 0.8])
    Y = Polyball(scale * (np.array([(0, 0), d * turn]) + shift), [scale * a, scale * b])
    alpha = np.arccos((d * d + a * a - b * b) / (2 * d * a))
    beta = np.arccos((d * d + b * b - a * a) / (2 * d * b))
    lens = a * a * (alpha - np.sin(2 * alpha) / 2) + b * b * (beta - np.sin(2 * beta) / 2)
    digits = 1e-12 + 1e-15 * np.abs(shift).max() * 20
    assert Y.area() / scale**2 == pytest.approx(np.pi * (a * a + b * b) - lens, rel=digits)
    found = Y.singular_points() / scale - shift
    side = a * np.sin(alpha) * np.array([[-0.8, 0.6], [0.8, -0.6]])
    expected = a * np.cos(alpha) * turn + side
    assert cKDTree(found).query(expected)[0].max() < 200 * digits
    assert len(found) == 2


def test_holes_of_a_ring_of_discs():
    """Twelve discs around a hole: the boundary has two loops, the hole's area is missing."""
    angle = np.arange(12) * np.pi / 6
    centers = 2 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    Y = Polyball(centers, np.full(12, 0.6))
    assert len(Y.arcs().ball) == 24
    assert len(Y.singular_points()) == 24
    assert Y.area() == pytest.approx(sliced_area(Y.centers, Y.radii), rel=1e-4)
    assert Y.boundary_distance([(0, 0)])[0] == pytest.approx(2 - 0.6)


def test_discs_in_discs_and_equal_discs_have_one_set_of_arcs():
    Y = Polyball([(0, 0), (3, 0), (0, 0), (0.5, 0), (0, 0)], [1, 1, 1, 0.5, 0.2])
    assert Y.arcs().ball.tolist() == [0, 1]
    assert Y.area() == pytest.approx(2 * np.pi)


def test_touching_discs():
    """Outer touching points are singular by definition 4, unless a third disc covers them."""
    pair = Polyball([(0, 0), (2, 0)], [1, 1])
    assert pair.arcs().ball.tolist() == [0, 1]
    assert pair.singular_points().tolist() == [[1, 0]]
    assert pair.boundary_distance([(1, 0)])[0] == 0
    covered = Polyball([(0, 0), (2, 0), (1, 0)], [1, 1, 0.5])
    assert len(covered.singular_points()) == 4
    assert covered.boundary_distance([(1, 0)])[0] == pytest.approx(0.5)
    assert len(Polyball([(0, 0), (0.5, 0)], [1, 0.5]).singular_points()) == 0  # touching from inside
    for angle in np.arange(20.0):
        turn = np.array([np.cos(angle), np.sin(angle)])
        rounded = Polyball([0.3 - 0.1 * turn, 0.3 + 1.3 * turn], [0.6, 0.8])
        assert rounded.singular_points() == pytest.approx(0.3 + 0.5 * turn[None])


def test_a_point_surrounded_by_three_circles_through_it_is_inside():
    """Each two circles cross at the origin, but it has no neighbour outside the union."""
    angle = np.array([0.1, 2.2, 4.3])
    Y = Polyball(np.stack([np.cos(angle), np.sin(angle)], axis=1), np.ones(3))
    assert np.hypot(*Y.singular_points().T).min() > 0.5
    assert len(Y.singular_points()) == 3
    assert Y.boundary_distance([(0, 0)])[0] > 0.5


def test_a_tiny_hole_is_found():
    """Three unit circles that nearly meet at the origin leave a hole of about 1e-5."""
    angle = np.arange(3) * 2 * np.pi / 3
    Y = Polyball((1 + 1e-5) * np.stack([np.cos(angle), np.sin(angle)], axis=1), np.ones(3))
    hole = Y.singular_points()[np.hypot(*Y.singular_points().T) < 1e-3]
    assert len(hole) == 3
    assert Y.boundary_distance([(0, 0)])[0] == pytest.approx(1e-5, rel=1e-6)
    assert not Y.contains([(0, 0)])[0]


def test_very_unequal_discs():
    Y = Polyball([(0, 0), (1e6, 0), (1e6 + 1, 0), (-1e6, 0)], [1e6, 1e-3, 1e-4, 1e-3])
    assert Y.arcs().ball.tolist() == [0, 0, 1, 2, 3]
    assert len(Y.singular_points()) == 4


def test_area_far_from_the_origin_loses_no_digits():
    near, far = (Polyball([(x, x), (x + 1, x)], [1, 1]).area() for x in (0, 2**30))
    assert far == pytest.approx(near, rel=1e-14)


def test_a_real_gap_beside_a_badly_known_crossing_stays_open():
    """Two nearly equal circles cross at (0, ±1), known to 1e-7; a third disc leaves 1e-4 free there."""
    free = 1e-4
    lean = np.array([np.cos(np.pi + free), np.sin(np.pi + free)])
    # Its circle crosses the unit circle a quarter turn to both sides of `lean`.
    Y = Polyball([(0, 0), (1e-9, 0), lean], [1, 1, 2**0.5])
    arcs = Y.arcs()
    own = arcs.ball == 0
    assert (arcs.end - arcs.start)[own] == pytest.approx([free], rel=1e-2)
    assert arcs.start[own] == pytest.approx([np.pi / 2], abs=1e-6)


def test_noisy_circles_through_two_points_have_two_singular_points():
    """Centres and radii with the errors of circumcentres of thin triangles."""
    rng = np.random.default_rng(5)
    height = np.linspace(-3, 2, 25)
    centers = np.stack([height, 0 * height], axis=1)
    radii = np.hypot(height, 1) * (1 + 1e-13 * rng.standard_normal(25))
    found = Polyball(centers, radii).singular_points()
    assert sorted(found[:, 1]) == pytest.approx([-1, 1])


def test_angles_begin_at_minus_pi():
    turned = _wrapped(np.array([np.nextafter(-np.pi, -9), -np.pi, np.pi, np.nextafter(3 * np.pi, 0), 7.0]))
    assert (turned >= -np.pi).all()
    assert (turned < np.pi).all()
    assert turned[-1] == pytest.approx(7 - 2 * np.pi)


# --- against the oracle


@settings(max_examples=150, derandomize=True, deadline=None)
@given(st.one_of(WHOLE, REAL))
def test_any_discs(balls):
    centers, radii = balls
    Y = Polyball(centers, radii)
    crossings, distance = oracle(centers, radii)
    grid = np.stack(np.meshgrid(np.linspace(-3, 9, 7), np.linspace(-3, 9, 7)), axis=-1).reshape(-1, 2)
    queries = np.concatenate([grid, centers])
    expected = np.array([distance(q.copy()) for q in queries])
    assert Y.boundary_distance(queries) == pytest.approx(expected, abs=1e-6)
    found = Y.singular_points()
    assert len(found) == 0 or len(crossings)
    if len(found):
        assert cKDTree(crossings).query(found)[0].max() < 1e-6
    assert closed_chains(Y.arcs(), Y.centers, Y.radii, decimals=5)


@settings(max_examples=60, derandomize=True, deadline=None)
@given(WHOLE)
def test_singular_points_of_whole_discs_are_all_found(balls):
    """Both ways round; discs that lie in another one are no generating discs and are left out first."""
    centers, radii = (np.unique(np.column_stack(balls), axis=0)[:, k] for k in (slice(0, 2), 2))
    far = np.hypot(*(centers[:, None] - centers).transpose(2, 0, 1))
    inside = (far + radii[:, None] <= radii + 1e-9) & ~np.eye(len(radii), dtype=bool)
    centers, radii = centers[~inside.any(axis=1)], radii[~inside.any(axis=1)]
    crossings, _ = oracle(centers, radii)
    # An oracle crossing that is surrounded is in the interior: some point close by has to be outside.
    # Fine enough for the cusp between two touching circles.
    angle = np.linspace(0, 2 * np.pi, 7200, endpoint=False)
    ring = 0.01 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    Y = Polyball(centers, radii)
    bare = [p for p in crossings if not Y.contains(p + ring).all()]
    found = Y.singular_points()
    assert len(found) == len(np.unique(np.round(bare, 6) + 0.0, axis=0))
    if bare:
        assert cKDTree(found).query(bare)[0].max() < 1e-6


@settings(max_examples=25, derandomize=True, deadline=None)
@given(st.one_of(WHOLE, REAL))
def test_area_by_slices(balls):
    Y = Polyball(*balls)
    assert Y.area() == pytest.approx(sliced_area(Y.centers, Y.radii), rel=2e-4)


def test_contains_is_the_plain_definition_in_any_dimension():
    rng = np.random.default_rng(7)
    for dimension in (2, 3):
        Y = Polyball(rng.random((300, dimension)), rng.random(300) / 8)
        queries = rng.random((5000, dimension)) * 1.4 - 0.2
        far = np.linalg.norm(queries[:, None] - Y.centers, axis=2)
        assert (Y.contains(queries) == (far <= Y.radii).any(axis=1)).all()
        assert 0.05 < Y.contains(queries).mean() < 0.95
    assert Polyball([(0, 0)], [5]).contains([(3, 4), (3, 4.0001)]).tolist() == [True, False]


def test_chunks_do_not_change_results(monkeypatch):
    rng = np.random.default_rng(8)
    Y = Polyball(rng.random((60, 2)), rng.random(60) / 8)
    queries = rng.random((500, 2))
    whole = Y.contains(queries), Y.boundary_distance(queries)
    monkeypatch.setattr("polyskel_lite.polyballs.pairs._CHUNK", 700)
    monkeypatch.setattr("polyskel_lite.polyballs.distance._CHUNK", 700)
    assert (Y.contains(queries) == whole[0]).all()
    assert (Y.boundary_distance(queries) == whole[1]).all()


# --- Delaunay discs (section 3.2)


@pytest.mark.parametrize("name", datasets.names())
def test_inner_delaunay_discs_of_outlines(name):
    """In the Gabriel graph: all samples are on ∂Y_w and all singular points are samples."""
    shape = conform(datasets.load(name), to="gabriel")
    Y = inner_delaunay_discs(shape)
    assert Y.boundary_distance(shape.points).max() < 1e-12
    gap, sample = cKDTree(shape.points).query(Y.singular_points())
    assert gap.max() < 1e-12
    assert len(np.unique(sample)) == len(sample)
    assert len(Y.arcs().ball) == len(sample)
    assert closed_chains(Y.arcs(), Y.centers, Y.radii, decimals=9)
    assert shape.area() < Y.area() < 1.03 * shape.area()


@pytest.mark.parametrize(("name", "samples"), [("elephant", [185]), ("kangaroo", list(range(309, 316)))])
def test_stored_outlines_that_swallow_samples(name, samples):
    """Two stored outlines are in Del(E) but not in GG(E), and each has samples inside Y_w."""
    shape = datasets.load(name)
    swallowed = np.flatnonzero(inner_delaunay_discs(shape).boundary_distance(shape.points) > 1e-9)
    assert swallowed.tolist() == samples


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("shift", [0, 1e4])
def test_random_delaunay_discs_are_empty_of_samples(seed, shift):
    """All Delaunay discs of a region: no sample is strictly inside one, those at the rim are on ∂Y."""
    rng = np.random.default_rng(seed)
    points = rng.random((60, 2)) + shift
    centers, radii = circumscribed(points, Delaunay(points).simplices)
    kept = (np.abs(centers - 0.5 - shift) < 0.5).all(axis=1)
    Y = Polyball(centers[kept], radii[kept])
    _, distance = oracle(Y.centers, Y.radii, slack=1e-9 * (1 + shift))
    expected = np.array([distance(p.copy()) for p in points])
    # The oracle takes each sample for a boundary point: it is on circles and in no open disc. Samples
    # with discs all around are interior, and there the polyball has to say more.
    found = Y.boundary_distance(points)
    around = found > 1e-6
    assert found[~around] == pytest.approx(expected[~around], abs=1e-7)
    angle = np.linspace(0, 2 * np.pi, 3600, endpoint=False)
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    for p, free in zip(points[around], found[around], strict=True):
        assert Y.contains(p + 0.99 * free * ring).all()
    assert closed_chains(Y.arcs(), Y.centers, Y.radii)
    assert Y.area() == pytest.approx(sliced_area(Y.centers, Y.radii, 1500), rel=1e-3)


@pytest.mark.parametrize("turn", [0, 0.3, 1.0])
@pytest.mark.parametrize("shift", [0, 1e5])
def test_delaunay_discs_of_a_grid(turn, shift):
    """Two equal discs per cell, up to rounding; four circles through each inner sample."""
    grid = np.stack(np.meshgrid(np.arange(6.0), np.arange(5.0)), axis=-1).reshape(-1, 2)
    points = grid @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]) + shift
    centers, radii = circumscribed(points, Delaunay(points).simplices)
    kept = radii < 1  # rounding leaves thin triangles at the rim of a turned grid
    Y = Polyball(centers[kept], radii[kept])
    rim = ((grid == 0) | (grid == (5, 4))).any(axis=1)
    found = Y.boundary_distance(points)
    assert found[rim].max() < 1e-9 * (1 + shift)
    assert found[~rim].min() > 0.5
    corner = ((grid == 0) | (grid == (5, 4))).all(axis=1)
    # The two arcs beside a corner of the grid lie on one circle: corners are not singular.
    gap, sample = cKDTree(points).query(Y.singular_points())
    assert gap.max() < 1e-9 * (1 + shift)
    assert sorted(sample) == np.flatnonzero(rim & ~corner).tolist()
    cells, edges = 20, 18
    segment = np.pi / 8 - 0.25
    assert Y.area() == pytest.approx(cells + edges * segment, rel=1e-9 * (1 + shift))


@pytest.mark.parametrize("noise", [1e-16, 1e-13, 1e-11, 1e-9, 1e-7])
def test_nearly_cocircular_samples(noise):
    """Nearly equal circles: their crossings are badly known, the distance is not."""
    rng = np.random.default_rng(3)
    angle = np.arange(40) * np.pi / 20
    points = np.stack([np.cos(angle), np.sin(angle)], axis=1) + noise * rng.standard_normal((40, 2))
    triangles = Delaunay(points).simplices
    Y = Polyball(*circumscribed(points, triangles))
    assert Y.boundary_distance([(0, 0), (2, 0)]) == pytest.approx([1, 1], abs=1e3 * noise + 1e-9)
    assert Y.area() == pytest.approx(np.pi, rel=1e3 * noise + 1e-8)


def test_swallowed_sample():
    """Against Sk2 = Sk(Y_w): all six edges are strictly Gabriel, and the reflex sample lies inside Y_w."""
    samples = np.array([(0, 0), (0, 3), (-3, 1), (-2, -2), (1, -2), (3, 0)], dtype=float)
    shape = Shape.from_rings([samples])
    Y = inner_delaunay_discs(shape)
    distance = Y.boundary_distance(samples)
    assert distance[0] == pytest.approx(1)  # the reflex one, between the arms
    assert distance[1:].max() < 1e-12
    angle = np.linspace(0, 2 * np.pi, 3600)
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    assert Y.contains(0.999 * ring).all()
    assert not Y.contains(1.001 * ring).all()
    # The place of the sample is taken by a singular point that is no sample.
    gap, _ = cKDTree(samples).query(Y.singular_points())
    stranger = Y.singular_points()[gap > 1e-9]
    assert stranger == pytest.approx(np.array([[0.6, 0.8]]))


def test_thousands_of_discs():
    rng = np.random.default_rng(11)
    points = rng.random((2500, 2))
    centers, radii = circumscribed(points, Delaunay(points).simplices)
    kept = (np.abs(centers - 0.5) < 0.5).all(axis=1)
    Y = Polyball(centers[kept], radii[kept])
    assert len(Y) > 4500
    assert closed_chains(Y.arcs(), Y.centers, Y.radii)
    assert len(Y.singular_points()) == len(Y.arcs().ball)


def test_crowded_discs_are_read_off_the_power_diagram(monkeypatch):
    rng = np.random.default_rng(5)
    centers, radii = rng.random((400, 2)) * 3, rng.random(400) * 0.4 + 0.3
    plain, crowded = Polyball(centers, radii), Polyball(centers, radii)
    area, arcs = plain.area(), plain.arcs()
    monkeypatch.setattr("polyskel_lite.polyballs.union._PAIRS", 0)
    assert crowded.area() == pytest.approx(area, rel=1e-12)
    assert crowded.arcs().ball.tolist() == arcs.ball.tolist()
    assert len(crowded.skeleton().edges) == len(plain.skeleton().edges)
