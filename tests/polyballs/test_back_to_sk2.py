"""When is Sk2 the skeleton of its Delaunay balls? The five conditions, and touching balls above all."""

import numpy as np
import pytest

import polyskel_lite as psl

# Whole numbers whose conditions (a) to (d) hold, and two kept discs touch in a corner.
PINCHED = [
    [(0, 0), (0, 4), (-4, 1), (-3, 0), (-2, -2), (3, -4), (3, 0)],
    [(0, 0), (1, 2), (-3, 2), (-2, -2), (-1, -4), (3, -2), (4, -1), (2, 0)],
    [(0, 0), (0, 2), (-5, 1), (-4, -3), (2, -3), (4, 0)],
]


@pytest.mark.parametrize("ring", PINCHED)
def test_two_kept_discs_touch_in_a_corner(ring):
    shape = psl.Shape.from_rings([ring])
    found, t, Y = psl.sk2_conditions(shape), psl.delaunay(shape.points), psl.delaunay_balls(shape)
    assert found.hold == {"a": True, "b": True, "c": True, "d": True, "e": False}
    (pair,) = found.touching
    c, r = t.circumcenters[pair], t.circumradii[pair]
    assert np.hypot(*(c[1] - c[0])) == pytest.approx(r.sum(), rel=1e-14)
    (p,) = np.intersect1d(*t.simplices[pair])  # where they touch
    assert np.hypot(*(c - t.points[p]).T) == pytest.approx(r, rel=1e-14)
    assert Y.boundary_distance(t.points[[p]])[0] < 1e-12
    with pytest.raises(psl.TangentBallsError):
        Y.skeleton()


def polygons(count, whole):
    rng = np.random.default_rng(whole)
    while count:
        k = rng.integers(5, 12)
        angle, radius = np.sort(rng.uniform(0, 2 * np.pi, k)), rng.uniform(1.5, 5, k)
        ring = np.round(radius * np.stack([np.cos(angle), np.sin(angle)]), 0 if whole else 2).T
        try:
            shape = psl.Shape.from_rings([ring])
            psl.delaunay_balls(shape)
        except psl.PolyskelError:
            continue
        count -= 1
        yield shape


@pytest.mark.parametrize("whole", [False, True])
def test_where_all_five_hold_they_are_equal(whole):
    """Corners at whole numbers make tangent and equal discs in numbers."""
    holding, pinched = 0, 0
    for shape in polygons(300, whole):
        found = psl.sk2_conditions(shape)
        if all(found.hold.values()):
            holding += 1
            assert psl.hausdorff(psl.sk2(shape), psl.delaunay_balls(shape).skeleton()) < 1e-9
        elif not found.hold["e"]:
            pinched += 1
            assert len(found.touching) == len(psl.delaunay_balls(shape).touching())
    assert holding > 60
    assert pinched > 3 or not whole
