"""Containment in space: missing faces are named, conform repairs or refuses."""

import warnings

import numpy as np
import pytest
from truth.solids import FIELDS, random_solids, solid

import polyskel_lite as psl


def stretched(shape: psl.Shape, factor: float) -> psl.Shape:
    """Long thin triangles, as a decimated mesh has them: still closed and without meetings."""
    return psl.Shape(shape.points * (1, 1, factor), shape.facets)


@pytest.mark.parametrize("factor", [3, 8])
@pytest.mark.parametrize("name", ["torus", "hollow ball", "trefoil", "tetrapod", "vertebra"])
def test_badly_shaped_meshes_become_contained(name, factor):
    shape = stretched(solid(name) if name in FIELDS else psl.datasets.load(name), factor)
    missing = psl.missing_facets(shape)
    assert 0.08 < len(missing) / len(shape.facets) < 0.9
    with pytest.raises(psl.ContourContainmentError, match="are not in the Delaunay tessellation") as error:
        psl.delaunay_shape(shape)
    assert (error.value.missing == missing).all()
    repaired = psl.conform(shape, to="delaunay")
    assert len(psl.missing_facets(repaired)) == 0
    assert (repaired.points[: len(shape.points)] == shape.points).all()
    assert len(repaired.points) < 1.5 * len(shape.points)
    P = psl.delaunay_shape(repaired)
    assert shape.betti() == repaired.betti() == P.betti() == psl.sk0(P).betti()
    assert repaired.volume() == pytest.approx(shape.volume(), rel=0.05)


def test_contained_shapes_come_back_as_they_are():
    shape = solid("torus")
    assert psl.conform(shape, to="delaunay") is shape


def test_conform_to_gabriel():
    shape = psl.datasets.load("metacarpal")
    assert not psl.delaunay_shape(shape).is_gabriel()
    assert psl.delaunay_shape(psl.conform(shape, to="gabriel")).is_gabriel()


def test_jagged_solids_are_repaired_or_refused():
    """Needles and edges of all angles: whatever comes back is contained and has the same topology."""
    outcomes = {"same": 0, "repaired": 0, "refused": 0}
    for shape in random_solids(100):
        missing = psl.missing_facets(shape)
        repaired, refused = shape, None
        try:
            repaired = psl.conform(shape, to="delaunay", limit=150)
        except psl.ContourContainmentError as error:
            refused = error
        outcomes["refused" if refused else "repaired" if len(missing) else "same"] += 1
        if refused:
            assert refused.missing.tolist() == missing.tolist()
        else:
            assert len(psl.missing_facets(repaired)) == 0
            assert repaired.betti() == shape.betti() == psl.sk0(repaired).betti()
    assert outcomes["repaired"] > 20, outcomes


def test_what_cannot_be_contained_is_refused():
    """The halves of a right triangle in a plane are right triangles with a neighbour on their circle."""
    points = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    squares = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [f for a, b, c, d in squares for f in ((a, b, c), (a, c, d))]
    cube = psl.Shape(points, faces)
    message = (
        r"12 of 12 faces \(first: 0\) are not in the gabriel graph .* with 100 vertices \d+ still are not"
    )
    with pytest.raises(psl.ContourContainmentError, match=message) as error:
        psl.conform(cube, to="gabriel", limit=100)
    assert error.value.missing.tolist() == list(range(12))
    assert len(psl.conform(cube, to="delaunay").points) == 8


def test_right_angles_and_thin_walls_need_no_vertex():
    """Cocircular corners: flips choose among the diagonals. Thin walls: flips, too."""
    trimesh = pytest.importorskip("trimesh")
    for mesh in (
        trimesh.creation.box((3, 2, 1)),
        trimesh.creation.annulus(1, 1.05, 4, sections=32),
        trimesh.creation.box((10, 10, 0.01)),
    ):
        shape = psl.Shape.from_mesh(mesh.vertices, mesh.faces)
        fixed = psl.conform(shape, to="delaunay")
        assert len(fixed.points) == len(shape.points)
        assert fixed.betti() == psl.sk0(fixed).betti() == shape.betti()
        assert fixed.volume() == pytest.approx(shape.volume(), rel=1e-9)


def test_by_default_solids_conform_to_delaunay():
    shape = stretched(solid("torus"), 3.0)
    assert not len(psl.missing_facets(psl.conform(shape)))


@pytest.mark.parametrize("exponent", [-660, -500, 340])
def test_the_unit_does_not_matter(exponent):
    """An L whose flat faces have to be cut another way: areas of 1e-300, or of 1e200 and their squares."""
    outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    points = np.array([(x, y, z) for z in (0, 1) for x, y in outline], dtype=float)
    floor = np.array([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)])
    walls = [
        f
        for i, j in zip(range(6), (1, 2, 3, 4, 5, 0), strict=True)
        for f in ((i, j, j + 6), (i, j + 6, i + 6))
    ]
    faces = np.concatenate([floor[:, ::-1], floor + 6, walls])
    shape = psl.Shape.from_mesh(points, faces)
    ordinary = psl.conform(shape)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scaled = psl.conform(psl.Shape.from_mesh(np.ldexp(points, exponent), faces))
    assert np.array_equal(scaled.facets, ordinary.facets)
