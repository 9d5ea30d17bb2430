"""Solids: implicit surfaces, and Betti numbers that agree between shape, Delaunay shape and Sk0."""

import numpy as np
import pytest
from truth.solids import FIELDS, random_solids, solid

import polyskel_lite as psl
from polyskel_lite import InputError, ShapeError, implicit


@pytest.mark.parametrize("name", FIELDS)
def test_implicit_solids_are_contained_uniform_and_of_the_right_topology(name):
    field, n, betti = FIELDS[name]
    shape = solid(name)
    assert 0.98 * n <= len(shape.points) <= n
    assert shape.betti() == betti
    assert len(psl.missing_facets(shape)) == 0
    sides = np.linalg.norm(shape.segments - np.roll(shape.segments, 1, axis=1), axis=2)
    assert sides.std() < 0.25 * sides.mean()
    assert np.abs(field(shape.points)).max() < 1e-3 * sides.mean()


@pytest.mark.parametrize("name", [*FIELDS, "vertebra", "fourbranch"])
def test_betti_numbers_of_shape_delaunay_shape_and_sk0(name):
    shape = solid(name) if name in FIELDS else psl.datasets.load(name)
    P = psl.delaunay_shape(shape)
    skeleton = psl.sk0(P)
    assert shape.betti() == P.betti() == skeleton.betti()
    back = skeleton.reconstruct()
    assert (back.inner == P.inner).all()
    faces = {tuple(np.roll(f, -f.argmin())) for f in shape.facets}
    assert {tuple(np.roll(f, -f.argmin())) for f in P.boundary()} == faces
    corners = P.tessellation.points[P.tessellation.simplices[P.inner]]
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6
    assert volume == pytest.approx(shape.volume(), rel=1e-9)


def test_volume_converges():
    """A torus has the volume 2 pi^2 R r^2 and the surface 4 pi^2 R r."""
    errors = []
    for n in (300, 1200):
        shape = implicit.solid(implicit.torus(1.0, 0.4), n)
        errors.append(1 - shape.volume() / (2 * np.pi**2 * 0.16))
    assert 3 < errors[0] / errors[1] < 5
    assert shape.surface() == pytest.approx(4 * np.pi**2 * 0.4, rel=0.01)


def test_same_seed_same_mesh():
    one, two, three = (implicit.solid(implicit.tetrapod(), 150, seed=s) for s in (1, 1, 2))
    assert (one.points == two.points).all()
    assert one.points.shape != three.points.shape or (one.points != three.points).any()


def test_plain_function_needs_a_box():
    def value(x):
        return (x**4).sum(axis=1) - 1

    assert implicit.solid(value, 150, box=[(-1.2,) * 3, (1.2,) * 3]).betti() == (1, 0, 0)
    with pytest.raises(InputError, match="box is missing"):
        implicit.solid(value, 150)
    with pytest.raises(
        InputError, match=r"negative at \(-0.5, -0.5, -0.5\), on the box; make the box larger"
    ):
        implicit.solid(value, 150, box=[(-0.5,) * 3, (0.5,) * 3])
    with pytest.raises(InputError, match="negative nowhere"):
        implicit.solid(value, 150, box=[(3,) * 3, (4,) * 3])
    with pytest.raises(InputError, match="lowest and its highest"):
        implicit.solid(value, 150, box=[(3,) * 3, (2,) * 3])
    with pytest.raises(InputError, match="n = 4 vertices"):
        implicit.solid(value, 4, box=[(-2,) * 3, (2,) * 3])
    with pytest.raises(InputError, match="finite numbers"):
        implicit.solid(lambda x: np.full(len(x), np.nan), 150, box=[(-2,) * 3, (2,) * 3])


def test_too_few_samples_for_a_thin_part():
    with pytest.raises(ShapeError, match="60 samples make no mesh of this surface; ask for more"):
        implicit.solid(implicit.torus(1.0, 0.05), 60)


# --- containment: missing faces are named, conform repairs or refuses ---------------------------


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
