"""Meshes made closed and manifold: welded, wound alike, holes closed, crossing parts united."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..checks import as_number, library
from ..errors import InputError, ShapeError
from ..exact import components, meeting_faces
from .meshes import signed_volume, surfaces_of, turn_of_surface, turned, twin_faces

#: What is welded by default, as a share of the size; and how many edges a hole that is closed may have.
TOLERANCE, HOLE = 1e-5, 100


def mended_mesh(
    points: np.ndarray,
    faces: np.ndarray,
    tolerance: float | None = None,
    largest: bool = False,
    least: float = 0.0,
) -> tuple[np.ndarray, np.ndarray, dict[str, int]]:
    """A closed, manifold, outward mesh, and what was done to make it; see `polyskel_lite.mend`.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 6]], dtype=float)
    >>> points, faces, report = mended_mesh(points, np.array([[0, 1, 2], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    >>> signed_volume(points[faces]), report
    (1.0, {'faces turned': 1})
    """
    tolerance = _length(tolerance, points)
    least = as_number(least, "least", "a volume", 0)
    report: dict[str, int] = {}
    given = points, faces
    points, faces = _welded(points, faces, tolerance, report)
    try:
        twin_faces(points, faces)
    except ShapeError:
        points, faces = _closed(points, faces, report)
    points, faces = _kept(points, faces, largest, least, report)
    crossing = meeting_faces(points, faces)
    if len(crossing):
        points, faces = _united(points, faces, np.unique(crossing), report)
    points, faces = _used(points, turned(points, faces))
    report["faces turned"] = _turned_faces(*given, points, faces)
    return points, faces, {what: int(count) for what, count in report.items() if count}


def _length(tolerance: float | None, points: np.ndarray) -> float:
    if tolerance is None:
        return TOLERANCE * float(np.linalg.norm(np.ptp(points, axis=0)))
    return as_number(tolerance, "tolerance", "a length, in units of the vertices", 0)


def _used(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    used, faces = np.unique(faces, return_inverse=True)
    return points[used], faces.reshape(-1, 3)


def _welded(points, faces, tolerance, report) -> tuple[np.ndarray, np.ndarray]:
    """Vertices of edges without two faces are one where they are near, and no face is there twice."""
    edges = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    loose = np.unique(edges[count != 2])
    if len(loose):
        pairs = cKDTree(points[loose]).query_pairs(tolerance, output_type="ndarray")
        _, label = components(len(points), loose[pairs])
        first = np.unique(label, return_index=True)[1]
        report["vertices welded"] = len(points) - len(first)
        faces = first[label][faces]
    whole = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    _, once = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    kept = np.intersect1d(np.flatnonzero(whole), once)
    report["faces left out"] = len(faces) - len(kept)
    return _used(points, faces[kept])


def _closed(points, faces, report) -> tuple[np.ndarray, np.ndarray]:
    """Faces wound alike and holes closed, by pymeshfix."""
    mesh = library("pymeshfix", "mending", "mend").PyTMesh()
    mesh.set_quiet(True)
    mesh.load_array(np.ascontiguousarray(points), np.ascontiguousarray(faces, dtype=np.int32))
    report["holes closed"] = mesh.fill_small_boundaries(HOLE, False)
    points, faces = mesh.return_arrays()
    if not len(faces):
        raise InputError("no surface is left of the mesh; repair it in another program.")
    return points.astype(float), faces.astype(np.int64)


def _kept(points, faces, largest, least, report) -> tuple[np.ndarray, np.ndarray]:
    """The largest surface, or those that enclose enough."""
    if not largest and not least:
        return points, faces
    count, label = surfaces_of(faces, twin_faces(points, faces))
    volume = np.array([signed_volume(points[faces[label == k]]) for k in range(count)])
    kept = volume == volume[np.abs(volume).argmax()] if largest else np.abs(volume) >= least
    report["surfaces left out"] = count - kept.sum()
    if not kept.any():
        raise InputError(f"no surface encloses {least:g}; lower least.")
    return _used(points, faces[kept[label]])


def _united(points, faces, crossing, report) -> tuple[np.ndarray, np.ndarray]:
    """The union of closed surfaces that cross, without the cavities of others, by manifold3d."""
    manifold = library("manifold3d", "mending", "mend")
    count, label = surfaces_of(faces, twin_faces(points, faces))
    turn = np.array([turn_of_surface(points[faces[label == k]]) for k in range(count)])
    if (turn < 0).all():
        faces, turn = faces[:, ::-1], -turn
    cavity = (turn < 0) & ~np.isin(np.arange(count), label[crossing])
    solids = []
    for k in range(count):
        part = faces[label == k] if turn[k] > 0 else faces[label == k][:, ::-1]
        corners, part = _used(points, part)
        solids.append(manifold.Manifold(manifold.Mesh64(corners, part.astype(np.uint64))))
        if solids[-1].status() != manifold.Error.NoError:
            raise InputError(f"surface {k} cannot be united with others ({solids[-1].status().name}).")
    union = manifold.Manifold.batch_boolean(
        [s for s, c in zip(solids, cavity, strict=True) if not c], manifold.OpType.Add
    )
    for k in np.flatnonzero(cavity):
        union -= solids[k]
    report["surfaces united"] = count - cavity.sum()
    mesh = union.to_mesh64()
    return np.array(mesh.vert_properties)[:, :3], np.array(mesh.tri_verts).astype(np.int64)


def _turned_faces(points, faces, after, mended) -> int:
    """How many faces run the other way round than before."""
    _, index = cKDTree(points).query(after)
    before, back = (
        {tuple(np.roll(face, -face.argmin())) for face in some} for some in (faces, index[mended][:, ::-1])
    )
    return len(before & back)
