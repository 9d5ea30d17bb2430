"""Triangle meshes as shapes: what they measure and what is refused."""

import numpy as np
import pytest
from truth.meshes import CUBE, CUBE_FACES, cube, inward, moved, together

from polyskel_lite import DuplicatePointError, InputError, Shape, ShapeError


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
    with pytest.raises(InputError, match=r"facets\[0, 0\] is 8, but there are only 0 to 7"):
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
