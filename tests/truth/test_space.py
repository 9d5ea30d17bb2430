"""The oracle for space against what is known of small solids."""

from fractions import Fraction

import pytest

from truth import space

#: An L-shaped prism: its corners, and its faces counter-clockwise from outside.
CORNERS = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4))]
CAP = [(0, 1, 3), (1, 2, 3), (0, 3, 4), (0, 4, 5)]
FACES = [
    *[face[::-1] for face in CAP],
    *[tuple(k + 6 for k in face) for face in CAP],
    *[side for k in range(6) for side in ((k, (k + 1) % 6, (k + 1) % 6 + 6), (k, (k + 1) % 6 + 6, k + 6))],
]


@pytest.mark.parametrize(
    ("point", "side"),
    [((1, 1, Fraction(1, 2)), 1), ((3, 3, Fraction(1, 2)), -1), ((1, 1, 2), -1), ((3, 2, Fraction(1, 2)), 0)],
)
def test_location_in_a_prism(point, side):
    assert space.location(point, [tuple(CORNERS[k] for k in face) for face in FACES]) == side


@pytest.mark.parametrize("corner", CORNERS)
def test_corners_are_on_the_boundary(corner):
    assert space.location(corner, [tuple(CORNERS[k] for k in face) for face in FACES]) == 0


def test_centers():
    assert space.circumcenter((0, 0, 0), (2, 0, 0), (0, 4, 0), (0, 0, 6)) == (1, 2, 3)
    assert space.face_center((0, 0, 5), (2, 0, 5), (0, 4, 5)) == (1, 2, 5)
    assert space.strictly_gabriel((0, 0, 0), (2, 0, 0), (1, 2, 0), [(1, 1, 2)])
    assert not space.strictly_gabriel((0, 0, 0), (2, 0, 0), (1, 2, 0), [(1, 1, 1)])


def test_segments_and_triangles():
    triangle = (0, 0, 0), (4, 0, 0), (0, 4, 0)
    assert space.meets((1, 1, -1), (1, 1, 1), *triangle)
    assert space.meets((1, 1, -1), (1, 1, 0), *triangle)
    assert not space.meets((1, 1, 1), (1, 1, 2), *triangle)
    assert not space.meets((3, 3, -1), (3, 3, 1), *triangle)


def test_three_tetrahedra_around_an_edge():
    """The edge 0-1 is inner: a ring of three; each face at it is shared by two of them."""
    points = [(0, 0, -3), (0, 0, 4), (4, 1, 0), (-2, 4, 0), (-3, -3, 0)]
    spheres = space.empty_spheres(points)
    assert set(spheres) == {frozenset({0, 1, *pair}) for pair in ((2, 3), (3, 4), (2, 4))}
    assert [len(ring) for ring in space.rings(spheres).values()] == [3]
    shared = {face for face, both in space.sides(spheres).items() if len(both) == 2}
    assert shared == {frozenset({0, 1, k}) for k in (2, 3, 4)}
    faces = [face for face, both in space.sides(spheres).items() if len(both) == 1]
    hull = space.Samples(points, [sorted(face) for face in faces])
    assert hull.sk0() == (set(spheres), shared, {frozenset({0, 1})})
