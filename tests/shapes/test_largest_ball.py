"""The largest inscribed ball: known ones, and never smaller than what shapely or a fine grid finds."""

import numpy as np
import pytest
import shapely

import polyskel_lite as psl


def box(a, b, c):
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.creation.box((a, b, c))
    return psl.Shape.from_trimesh(mesh)


def in_place(ring):
    """The largest ball of a ring, which is inside and as far from the boundary as its radius says."""
    shape = psl.Shape.from_rings([ring])
    ball = shape.largest_ball()
    assert shape.contains([ball.center]).all()
    assert shape.boundary_distance([ball.center])[0] == pytest.approx(ball.radius, rel=1e-6)
    return ball


@pytest.mark.parametrize(
    ("ring", "center", "radius"),
    [
        ([(0, 0), (4, 0), (0, 3)], (1, 1), 1),
        ([(0, 0), (20, 0), (20, 4), (0, 4)], (10, 2), 2),
        ([(0, 0), (6, 0), (6, 2), (2, 2), (2, 6), (0, 6)], (4 - 8**0.5, 4 - 8**0.5), 4 - 8**0.5),
        ([(0, 0), (1e6, 0), (1e6, 1), (0, 1)], (5e5, 0.5), 0.5),
    ],
)
@pytest.mark.parametrize("unit", [1.0, 2.0**-700, 2.0**600])
def test_known_circles(ring, center, radius, unit):
    ball = in_place(np.array(ring) * unit)
    assert ball.radius / unit == pytest.approx(radius, rel=1e-12)
    assert np.allclose(ball.center / unit, center, rtol=1e-6)


def test_a_needle():
    ball = in_place([(0, 0), (1, 1e-9), (2, 0)])
    assert ball.radius == pytest.approx(0.5e-9, rel=1e-6)  # area / half the perimeter


def test_known_balls():
    ball = box(20, 20, 4).largest_ball()
    assert ball.radius == pytest.approx(2, rel=1e-12)
    assert abs(ball.center[2]) < 1e-9
    rng = np.random.default_rng(4)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    bar = box(9, 3, 4)
    assert psl.Shape(bar.points @ turn.T, bar.facets).largest_ball().radius == pytest.approx(1.5, rel=1e-12)


@pytest.mark.parametrize("seed", range(30))
def test_never_smaller_than_what_shapely_finds(seed):
    rng = np.random.default_rng(seed)
    turn = np.sort(rng.uniform(0, 2 * np.pi, int(rng.integers(5, 40))))
    if np.diff(turn, append=turn[0] + 2 * np.pi).max() > 3:
        turn = np.linspace(0, 2 * np.pi, 9, endpoint=False)
    reach = rng.uniform(0.1, 1, len(turn))
    shape = psl.Shape.from_rings([np.column_stack([reach * np.cos(turn), reach * np.sin(turn)])])
    ball = shape.largest_ball()
    found = shapely.maximum_inscribed_circle(shape.to_shapely(), tolerance=1e-5).length
    assert found <= ball.radius * (1 + 1e-12)
    assert ball.radius - found < 2e-5
    assert shape.boundary_distance([ball.center])[0] == pytest.approx(ball.radius, rel=1e-12)


def test_holes_and_several_pieces():
    square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=float)
    shape = psl.Shape.from_rings([10 * square, 8 * square + 1, 3 * square + np.array((20, 5))])
    assert shape.largest_ball().radius == pytest.approx(1.5, rel=1e-12)
    assert np.allclose(shape.largest_ball().center, (21.5, 6.5))
