"""Triangle meshes from files, surfaces and complexes to files: trimesh and meshio (extra ``meshes``)."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from os import PathLike
from pathlib import Path

import numpy as np

from ..checks import as_path, library
from ..errors import InputError, PolyskelError
from .faces import obj_faces, off_faces, triangles

MESH_SUFFIXES = (".stl", ".ply", ".obj", ".off")
_SURFACE_SUFFIXES = (".stl", ".ply", ".obj", ".off", ".glb", ".vtk", ".vtu")
_TEXT = {".off": off_faces, ".obj": obj_faces}
#: Of what is in the plane; see `write_geometry`.
GEOMETRY_SUFFIXES = (".geojson", ".json", ".wkt", ".svg")
_LINE_SUFFIXES = (".ply", ".obj", ".glb", ".vtk", ".vtu")


def read_mesh(path: str | PathLike) -> tuple[np.ndarray, np.ndarray]:
    """Read the vertices and triangles of an STL, PLY, OBJ or OFF file.

    Parameters
    ----------
    path : str or path

    Returns
    -------
    vertices : (n, 3) float array
        Vertices at exactly one place are merged (STL has no shared ones).
    faces : (m, 3) int array
        Faces that then have two equal corners are dropped, polygons are cut into triangles. All objects of a
        file are read. Nothing else is repaired.

    Raises
    ------
    InputError
        If trimesh is missing, or the file is no mesh.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> corner = "OFF\\n4 4 0\\n0 0 0\\n1 0 0\\n0 1 0\\n0 0 6\\n3 0 2 1\\n3 0 1 3\\n3 0 3 2\\n3 1 2 3\\n"
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "corner.off"
    ...     _ = file.write_text(corner)
    ...     vertices, faces = read_mesh(file)
    >>> vertices[3].tolist(), faces.shape
    ([0.0, 0.0, 6.0], (4, 3))
    """
    path = as_path(path)
    log = logging.getLogger("trimesh.util")
    loud, log.disabled = log.disabled, True  # it would print tracebacks of what is refused here in words
    try:
        vertices, faces = _polygons(path)
    except PolyskelError:
        raise
    except Exception as error:  # the readers raise whatever a broken file makes them stumble over
        raise InputError(f"the mesh cannot be read ({error}); save it again.") from None
    finally:
        log.disabled = loud
    if not len(vertices) or not len(faces):
        raise InputError("there is no triangle in it; save the surface, not only its points.")
    for k, face in enumerate(faces):
        if min(face) < 0 or max(face) >= len(vertices):
            raise InputError(
                f"face {k} has the corners {list(face)}, and there are {len(vertices)} "
                "vertices, numbered from 0; save it again."
            )
    return _merged(vertices, triangles(vertices, faces))


def _polygons(path: Path) -> tuple[np.ndarray, Sequence]:
    """Vertices, and faces with any number of corners."""
    trimesh = library("trimesh")
    if path.suffix.lower() in _TEXT:
        return _TEXT[path.suffix.lower()](path.read_text(encoding="utf-8", errors="replace"))
    mesh = trimesh.load_mesh(path, process=False)
    raw = mesh.metadata.get("_ply_raw", {}).get("face", {"length": len(mesh.faces)})
    if raw["length"] != len(mesh.faces):  # trimesh has cut polygons, and concave ones wrongly
        mesh = library("meshio").read(path, file_format="ply")
        return mesh.points, [face for block in mesh.cells for face in block.data.tolist()]
    return np.array(mesh.vertices, dtype=float), mesh.faces.tolist()


def _merged(vertices: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """One vertex for each place, in the order in which they first come."""
    _, first, place = np.unique(vertices + 0.0, axis=0, return_index=True, return_inverse=True)
    rank = np.argsort(np.argsort(first))
    faces = rank[place.ravel()][faces]
    distinct = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return vertices[np.sort(first)], faces[distinct]


def write_surface(path: str | PathLike, points: np.ndarray, facets: np.ndarray) -> None:
    """Write a boundary: triangles in 3D, lines in 2D (with z = 0); the suffix says how.

    Parameters
    ----------
    path : str or path
    points : (n, N) float array
    facets : (m, N) int array

    Raises
    ------
    InputError
        If the suffix is not one of .stl, .ply, .obj, .off, .glb, .vtk, .vtu (2D: no .stl, .off), or the
        library for it is missing.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> points = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1 / 3)])
    >>> corner = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_surface(pathlib.Path(folder) / "corner.ply", points, corner)
    ...     vertices, _ = read_mesh(pathlib.Path(folder) / "corner.ply")
    >>> (vertices == points).all()
    np.True_
    """
    if points.shape[1] == 2:
        _write(
            _checked(path, GEOMETRY_SUFFIXES + _LINE_SUFFIXES, "a shape in the plane"), points, facets, [], {}
        )
        return
    path = _checked(path, _SURFACE_SUFFIXES, "a solid")
    if path.suffix.lower() in (".stl", ".off"):
        mesh = library("trimesh").Trimesh(points, facets, process=False)
        options = {"digits": 30} if path.suffix.lower() == ".off" else {}
        with writing(path):
            mesh.export(path, file_type=path.suffix.lower()[1:], **options)
    else:
        _write(path, points, np.zeros((0, 2), dtype=np.int64), facets, {})


def write_complex(path: str | PathLike, points, edges, polygons, data) -> None:
    """Write a cell complex, such as a skeleton: edges as lines, polygons as faces.

    PLY, VTK and VTU keep the data of each vertex. In PLY an edge is a face with two corners. GLB cuts
    polygons into triangles.

    Parameters
    ----------
    path : str or path
    points : (k, N) float array
    edges : (e, 2) int array
    polygons : Polygons or (t, 3) int array
    data : dict of str to (k,) array

    Raises
    ------
    InputError
        If the suffix is not one of .ply, .obj, .glb, .vtk, .vtu, if the library for it is missing, or if
        there is no vertex, or one at infinity.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "edge.obj"
    ...     write_complex(file, np.array([(2, 1), (2.25, 1.5)]), [(0, 1)], [], {})
    ...     print(file.read_text().splitlines()[1:])
    ['v 2.0 1.0 0.0', 'v 2.25 1.5 0.0', 'l 1 2']
    """
    flat = GEOMETRY_SUFFIXES if np.shape(points)[1:] == (2,) else ()
    path = _checked(path, flat + _LINE_SUFFIXES, "a skeleton")
    if not len(points) or not np.isfinite(points).all():
        raise InputError("the skeleton has no vertex, or one at infinity, and cannot be written.")
    _write(path, points, edges, polygons, data)


def _checked(path, suffixes, what: str) -> Path:
    path = as_path(path)
    if path.suffix.lower() not in suffixes:
        raise InputError(
            f"{path.name[:60]}: {what} cannot be written as {path.suffix[:9] or 'no suffix'!r}; "
            f"choose {', '.join(suffixes)}."
        )
    return path


@contextmanager
def writing(path) -> Iterator[Path]:
    """The path of a file to write; what the system says against it becomes an `InputError`.

    Examples
    --------
    >>> with writing("nowhere/a.stl") as path:  # doctest: +ELLIPSIS
    ...     path.touch()
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: a.stl cannot be written (No such file or directory); choose another ...
    """
    path = as_path(path)
    try:
        yield path
    except OSError as error:
        why = error.strerror or type(error).__name__
        raise InputError(f"{path.name[:60]} cannot be written ({why}); choose another place.") from None


def _write(path: Path, points, edges, polygons, data) -> None:
    points = np.pad(points, ((0, 0), (0, 3 - points.shape[1])))
    with writing(path):
        if path.suffix.lower() == ".glb":
            _write_glb(path, points, edges, polygons)
        else:
            _write_lines(path, points, edges, polygons, data)


def _write_lines(path: Path, points, edges, polygons, data) -> None:
    meshio = library("meshio")
    cells = []
    if len(edges) and path.suffix.lower() != ".obj":
        cells.append(("line", np.asarray(edges, dtype=np.int32)))
    kinds = {3: "triangle", 4: "quad"}
    cells += [(kinds.get(block.shape[1], "polygon"), block.astype(np.int32)) for block in _by_size(polygons)]
    kind = path.suffix.lower()[1:]
    meshio.write(path, meshio.Mesh(points, cells, point_data=data), file_format=kind)
    if kind == "obj":  # meshio's OBJ writer knows no lines
        with path.open("a", encoding="ascii") as stream:
            stream.writelines(f"l {a} {b}\n" for a, b in (np.asarray(edges) + 1).tolist())


def _by_size(polygons) -> list[np.ndarray]:
    if isinstance(polygons, np.ndarray):
        return [polygons]
    sizes = np.array([len(polygon) for polygon in polygons], dtype=int)
    return [np.array([polygons[k] for k in np.flatnonzero(sizes == size)]) for size in np.unique(sizes)]


def _write_glb(path: Path, points, edges, polygons) -> None:
    trimesh = library("trimesh")
    scene = trimesh.Scene()
    faces = polygons.triangles() if hasattr(polygons, "triangles") else polygons
    if len(faces):
        scene.add_geometry(trimesh.Trimesh(points, faces, process=False), geom_name="faces")
    if len(edges):
        lines = trimesh.path.Path3D(
            entities=[trimesh.path.entities.Line(edge) for edge in np.asarray(edges)],
            vertices=points,
            process=False,
        )
        scene.add_geometry(lines, geom_name="edges")
    scene.export(path, file_type="glb")
