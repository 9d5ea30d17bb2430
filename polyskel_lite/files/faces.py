"""Faces of meshes with any number of corners: read from text as they stand, and cut into triangles."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from ..checks import library
from ..errors import InputError


def off_faces(text: str) -> tuple[np.ndarray, list[list[int]]]:
    """Vertices and faces of an OFF file; colours and normals are passed over.

    Examples
    --------
    >>> off_faces("OFF 3 1 0\\n0 0 0\\n1 0 0 # a comment\\n0 1 0\\n3 0 1 2 255 0 0")[1]
    [[0, 1, 2]]
    """
    lines = [words for line in text.splitlines() if (words := line.partition("#")[0].split())]
    head = re.fullmatch(r"(?:ST)?C?N?OFF(\d*)", lines[0][0])
    if not head:
        raise InputError(f"it begins with {lines[0][0][:9]!r}, not with OFF; save it again.")
    counts = [word for word in (head[1], *lines[0][1:]) if word]
    body = lines[1:] if counts else lines[2:]
    n, m = map(int, (counts or lines[1])[:2])
    faces = [[int(word) for word in words[1 : 1 + int(words[0])]] for words in body[n : n + m]]
    if len(faces) < m or any(
        len(face) != int(words[0]) for face, words in zip(faces, body[n:], strict=False)
    ):
        raise InputError("it ends before its last face; save it again.")
    return np.array([words[:3] for words in body[:n]], dtype=float).reshape(n, 3), faces


def obj_faces(text: str) -> tuple[np.ndarray, list[list[int]]]:
    """Vertices and faces of all objects of an OBJ file.

    Examples
    --------
    >>> obj_faces("v 0 0 0\\nv 1 0 0\\nv 0 1 0\\no a\\nf 1//7 2//7 -1//7")[1]
    [[0, 1, 2]]
    """
    points: list[list[str]] = []
    faces = []
    for line in text.replace("\\\n", " ").splitlines():
        kind, *words = line.partition("#")[0].split() or [""]
        if kind == "v":
            points.append(words[:3])
        elif kind == "f":
            corners = [int(word.partition("/")[0]) for word in words]
            faces.append([k - 1 if k > 0 else len(points) + k if k else -1 for k in corners])
    return np.array(points, dtype=float).reshape(-1, 3), faces


def triangles(points: np.ndarray, faces: Sequence) -> np.ndarray:
    """Cut faces into triangles, (m, 3), in their order; concave ones by manifold3d, in their plane.

    Examples
    --------
    >>> points = np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)], dtype=float)
    >>> triangles(points, [(0, 1, 2, 3)]).tolist()
    [[0, 1, 2], [0, 2, 3]]
    """
    sizes, parts, owners = np.array([len(face) for face in faces], dtype=int), [], []
    for size in np.unique(sizes[sizes > 2]):
        owner = np.flatnonzero(sizes == size)
        block = np.array([faces[k] for k in owner.tolist()], dtype=np.int64)
        fan = np.stack([np.repeat(block[:, :1], size - 2, axis=1), block[:, 1:-1], block[:, 2:]], axis=2)
        if size > 3:
            corners = points[block]
            along = np.roll(corners, -1, axis=1) - corners
            turns = np.cross(along, np.roll(along, -1, axis=1))
            # Twice the area of the face as a vector (Newell), which also says where a crooked one faces.
            normal = np.cross(corners - corners[:, :1], np.roll(corners, -1, axis=1) - corners[:, :1]).sum(
                axis=1
            )
            for k in np.flatnonzero(((turns * normal[:, None]).sum(axis=2) < 0).any(axis=1)):
                fan[k] = block[k][_cut(corners[k], normal[k])]
        parts.append(fan.reshape(-1, 3))
        owners.append(np.repeat(owner, size - 2))
    if not parts:
        return np.zeros((0, 3), dtype=np.int64)
    return np.concatenate(parts)[np.argsort(np.concatenate(owners), kind="stable")]


def _cut(corners: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Triangles of one concave face, seen along the axis nearest to its normal."""
    manifold = library("manifold3d", "cutting a face that is not convex", "mend")
    axis = int(np.abs(normal).argmax())
    flat = np.roll(corners, -1 - axis, axis=1)[:, :2] * (1, np.sign(normal[axis]))
    found = np.array(manifold.triangulate([flat]), dtype=np.int64)
    if len(found) != len(flat) - 2:
        raise InputError("a face with more than three corners crosses itself; save triangles.")
    return found
