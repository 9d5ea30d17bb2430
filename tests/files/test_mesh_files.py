"""Meshes from files and back: what is read exactly, what is refused, what other programs get."""

import builtins

import meshio
import numpy as np
import pytest
import trimesh

import polyskel_lite as psl
from polyskel_lite import InputError, Shape, ShapeError

CORNER = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1 / 3)]


def corners(shape: Shape) -> set:
    """The triangles by their coordinates, each from its smallest corner: what is left when indices change."""
    faces = shape.points.astype(np.float32)[shape.facets].tolist()
    return {tuple(map(tuple, f[(k := f.index(min(f))) :] + f[:k])) for f in faces}


@pytest.mark.parametrize("suffix", [".stl", ".ply", ".obj", ".off", ".PLY"])
def test_round_trip(tmp_path, suffix):
    shape = psl.datasets.load("vertebra")
    shape.to_file(tmp_path / f"bone{suffix}")
    back = Shape.from_file(tmp_path / f"bone{suffix}")
    assert corners(back) == corners(shape)
    assert back.betti() == (1, 1, 0)
    if suffix != ".stl":
        assert (back.points == shape.points).all()
        assert (back.facets == shape.facets).all()


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".off", ".vtk", ".vtu"])
def test_coordinates_to_the_last_bit(tmp_path, suffix):
    shape = Shape(np.array(POINTS) * 1e-7 + 1 / 3, CORNER)
    shape.to_file(tmp_path / f"a{suffix}")
    points = (meshio.read if suffix[1] == "v" else Shape.from_file)(tmp_path / f"a{suffix}").points
    assert (points == shape.points).all()


def stl(triangles) -> str:
    facets = "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join(f"vertex {x} {y} {z}\n" for x, y, z in triangle)
        + "endloop\nendfacet\n"
        for triangle in triangles
    )
    return f"solid a\n{facets}endsolid a\n"


def test_vertices_of_stl_are_merged_and_slivers_of_one_edge_dropped(tmp_path):
    points = np.array(POINTS)
    triangles = [*points[CORNER].tolist(), points[[1, 1, 2]].tolist()]
    (tmp_path / "a.stl").write_text(stl(triangles))
    shape = Shape.from_file(tmp_path / "a.stl")
    assert (len(shape.points), len(shape.facets)) == (4, 4)


def test_mesh_errors_name_the_file(tmp_path):
    points = np.array(POINTS)
    (tmp_path / "open.stl").write_text(stl(points[CORNER[:3]].tolist()))
    with pytest.raises(ShapeError, match=r"open.stl: the mesh is open: edge .* has 1 face \(\d\)"):
        Shape.from_file(tmp_path / "open.stl")
    (tmp_path / "in.stl").write_text(stl(points[np.array(CORNER)[:, ::-1]].tolist()))
    with pytest.raises(ShapeError, match=r"in.stl: an outer surface is turned inward.* turn=True"):
        Shape.from_file(tmp_path / "in.stl")
    assert Shape.from_file(tmp_path / "in.stl", turn=True).volume() > 0
    fan = [*points[CORNER].tolist(), *(points[CORNER] * (1, 1, -1))[:, ::-1].tolist()]
    (tmp_path / "two.stl").write_text(stl(fan))
    with pytest.raises(ShapeError, match=r"two.stl: the mesh is not manifold: edge .* has 4 faces"):
        Shape.from_file(tmp_path / "two.stl")


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.off", "words", "begins with 'words', not with OFF"),
        ("a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "ends before its last face"),
        ("a.ply", "ply\nformat ascii 1.0\nelement vertex 9\nend_header\n", "cannot be read|no triangle"),
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "cannot be read|no triangle"),
        ("a.stl", "solid a\nendsolid a\n", "cannot be read|no triangle"),
    ],
)
def test_broken_meshes(tmp_path, name, text, message):
    (tmp_path / name).write_text(text)
    with pytest.raises(InputError, match=f"{name}: .*({message})"):
        Shape.from_file(tmp_path / name)


def test_quads_are_cut_into_triangles(tmp_path):
    points = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    squares = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    lines = [f"v {x} {y} {z}" for x, y, z in points]
    lines += ["f " + " ".join(str(k + 1) for k in square) for square in squares]
    (tmp_path / "cube.obj").write_text("\n".join(lines) + "\n")
    cube = Shape.from_file(tmp_path / "cube.obj")
    assert len(cube.facets) == 12
    assert cube.volume() == pytest.approx(1)


@pytest.mark.parametrize("library", ["trimesh", "meshio"])
def test_missing_extra(tmp_path, monkeypatch, library):
    real = builtins.__import__

    def without(name, *rest):
        if name == library:
            raise ImportError
        return real(name, *rest)

    (tmp_path / "a.off").write_text("OFF")
    monkeypatch.setattr(builtins, "__import__", without)
    shape = Shape(POINTS, CORNER)
    ask, name = (Shape.from_file, "a.off") if library == "trimesh" else (shape.to_file, "a.vtk")
    with pytest.raises(InputError, match=rf"{library} is not installed; run: pip install {library}"):
        ask(tmp_path / name)


@pytest.fixture(scope="module")
def skeleton() -> psl.Skeleton:
    return psl.sk0(psl.datasets.load("fourbranch"))


@pytest.mark.parametrize("suffix", [".vtk", ".vtu", ".ply"])
def test_skeleton_cells_and_radii(tmp_path, skeleton, suffix):
    skeleton.to_file(tmp_path / f"s{suffix}")
    mesh = meshio.read(tmp_path / f"s{suffix}")
    assert (mesh.points == skeleton.vertices).all()
    assert (mesh.point_data["radius"] == skeleton.radii).all()
    assert (mesh.point_data["simplex"] == skeleton.simplices).all()
    lines = np.concatenate([block.data for block in mesh.cells if block.type == "line"])
    assert (lines == skeleton.edges).all()
    polygons = {tuple(row) for block in mesh.cells if block.type != "line" for row in block.data.tolist()}
    assert polygons == {tuple(polygon.tolist()) for polygon in skeleton.polygons}


def test_skeleton_as_obj_and_gltf(tmp_path, skeleton):
    skeleton.to_file(tmp_path / "s.obj")
    kinds = [line[:2] for line in (tmp_path / "s.obj").read_text().splitlines()]
    assert kinds.count("v ") == len(skeleton.vertices)
    assert kinds.count("l ") == len(skeleton.edges)
    assert kinds.count("f ") == len(skeleton.polygons)
    skeleton.to_file(tmp_path / "s.glb")
    scene = trimesh.load(tmp_path / "s.glb")
    assert len(scene.geometry["faces"].faces) == sum(len(p) - 2 for p in skeleton.polygons)
    # GL_LINES (mode 1), a pair of points for each edge: trimesh itself reads them back as one long chain.
    assert b'"mode":1' in (tmp_path / "s.glb").read_bytes()
    ends = np.asarray(scene.geometry["edges"].vertices).reshape(-1, 2, 3)
    assert ends == pytest.approx(skeleton.segments(), abs=1e-6)


@pytest.mark.parametrize("suffix", [".vtk", ".vtu", ".ply", ".obj", ".glb"])
def test_plane_shapes_and_skeletons(tmp_path, suffix):
    shape = psl.datasets.load("horse")
    shape.to_file(tmp_path / f"shape{suffix}")
    psl.sk0(psl.conform(shape)).to_file(tmp_path / f"skeleton{suffix}")
    assert (tmp_path / f"shape{suffix}").stat().st_size > 1000
    assert (tmp_path / f"skeleton{suffix}").stat().st_size > 1000


def test_what_cannot_be_written(tmp_path, skeleton):
    with pytest.raises(InputError, match=r"a.xyz: a solid cannot be written as '.xyz'; choose .stl, .ply"):
        Shape(POINTS, CORNER).to_file(tmp_path / "a.xyz")
    with pytest.raises(InputError, match=r"a: a skeleton cannot be written as 'no suffix'"):
        skeleton.to_file(tmp_path / "a")
    empty = psl.sk1(psl.Shape.from_rings([[(0, 0), (4, 0), (2, 1)]]))
    with pytest.raises(InputError, match="no vertex"):
        empty.to_file(tmp_path / "a.vtk")


PRISM = [(3, 0), (3, 1), (1, 1), (1, 3), (0, 3), (0, 0)]  # an L, area 5


def prism_faces(n=6):
    side = [[k, (k + 1) % n, n + (k + 1) % n, n + k] for k in range(n)]
    return [list(range(n))[::-1], list(range(n, 2 * n)), *side]


def as_off(points, faces):
    lines = [f"OFF\n# made by hand\n{len(points)} {len(faces)} 0", *(" ".join(map(str, p)) for p in points)]
    return "\n".join([*lines, *(f"{len(f)} {' '.join(map(str, f))} 255 0 0" for f in faces)])


def as_obj(points, faces):
    lines = [f"v {x} {y} {z}" for x, y, z in points]
    lines += [f"f {' '.join(f'{k - len(points)}//1' for k in face)}" for face in faces]
    return "\n".join(lines)


def as_ply(points, faces):
    head = f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n"
    head += "".join(f"property float {x}\n" for x in "xyz")
    head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    rows = [*points, *([len(face), *face] for face in faces)]
    return head + "\n".join(" ".join(map(str, row)) for row in rows) + "\n"


@pytest.mark.parametrize(("suffix", "write"), [(".off", as_off), (".obj", as_obj), (".ply", as_ply)])
@pytest.mark.parametrize("axes", [(0, 1, 2), (1, 2, 0), (2, 0, 1), (1, 0, 2)])
def test_concave_faces_with_many_corners(tmp_path, suffix, write, axes):
    points = np.array([(*p, z) for z in (0, 2) for p in PRISM])[:, axes]
    faces = prism_faces()
    if axes == (1, 0, 2):
        faces = [face[::-1] for face in faces]
    (tmp_path / f"L{suffix}").write_text(write(points.tolist(), faces))
    solid = Shape.from_file(tmp_path / f"L{suffix}")
    assert solid.volume() == pytest.approx(10)
    assert (len(solid.points), len(solid.facets)) == (12, 20)


def test_all_objects_of_a_file_are_read(tmp_path):
    two = "".join(f"o part{k}\n" + "".join(f"v {x + 9 * k} {y} {z}\n" for x, y, z in POINTS) for k in (0, 1))
    faces = "".join(
        f"f {a + 1 + 4 * k} {b + 1 + 4 * k} {c + 1 + 4 * k}\n" for k in (0, 1) for a, b, c in CORNER
    )
    (tmp_path / "a.obj").write_text(two + faces)
    assert Shape.from_file(tmp_path / "a.obj").betti() == (2, 0, 0)
    (tmp_path / "a.stl").write_text(stl(np.array(POINTS)[CORNER]) + stl(np.array(POINTS)[CORNER] + 9))
    assert Shape.from_file(tmp_path / "a.stl").betti() == (2, 0, 0)
