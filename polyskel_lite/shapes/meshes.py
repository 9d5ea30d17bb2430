"""Closed triangle meshes: what a boundary in space must be before it is a shape, and its topology."""

from __future__ import annotations

import numpy as np

from ..checks import near
from ..errors import ShapeError
from ..exact import as_integers, components, locate, meeting_faces, occurrences, shadow_signs


def check_mesh(points: np.ndarray, faces: np.ndarray, doubtful=None) -> None:
    """Raise `ShapeError` unless the faces are a closed, manifold, outward mesh that does not meet itself.

    Parameters
    ----------
    points : (n, 3) float array
    faces : (m, 3) int array
        Counter-clockwise seen from outside; cavities are surfaces turned the other way.
    doubtful : callable, optional
        Without arguments, to the faces (k,) that can meet others, or None for all.

    Raises
    ------
    ShapeError
        The sentence names the faces, the edge or the vertex.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    >>> check_mesh(points, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    >>> check_mesh(points, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2]]))  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    polyskel_lite.errors.ShapeError: the mesh is open: edge 1-2 near (0.5, 0.5, 0) has 1 face (0)...
    """
    _check_faces(points, faces)
    twins = twin_faces(points, faces)
    _check_vertices(points, faces, twins)
    pairs = meeting_faces(points, faces, doubtful and doubtful())
    if len(pairs):
        i, j = pairs[0]
        raise ShapeError(
            f"face {i} (vertices {_name(faces[i])}) meets face {j} (vertices {_name(faces[j])}) near "
            f"{near(points[faces[i]])}; a boundary may not cross or touch itself: move a vertex, or repair "
            f"the mesh ({_such(len(pairs), 'pair')})."
        )
    _check_orientation(points, faces, twins)


def _check_faces(points, faces) -> None:
    if not len(faces):
        raise ShapeError("the mesh has no face; a closed surface has at least four.")
    repeated = (faces == np.roll(faces, 1, axis=1)).any(axis=1)
    flat = repeated.copy()
    flat[~repeated] = ~shadow_signs(points[faces[~repeated]]).any(axis=1)
    if flat.any():
        k = np.flatnonzero(flat)[0]
        raise ShapeError(
            f"face {k} (vertices {_name(faces[k])}) near {near(points[faces[k]])} has no area: its corners "
            f"are in one line; remove it and close the gap ({_such(flat.sum(), 'face')})."
        )
    unused = np.flatnonzero(occurrences(faces, len(points)) == 0)
    if len(unused):
        raise ShapeError(
            f"vertex {unused[0]} at {near(points[unused[:1]])} is in no face; remove it "
            f"({_such(len(unused), 'vertex', 'vertices')})."
        )


def twin_faces(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The face across each side of each face, (m, 3); side i runs from corner i to corner i + 1.

    Raises
    ------
    ShapeError
        As `twin_sides`.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    >>> twin_faces(points, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])).tolist()
    [[2, 3, 1], [0, 3, 2], [1, 3, 0], [0, 2, 1]]
    """
    return twin_sides(points, faces).reshape(-1, 3) // 3


def twin_sides(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The side that runs back along each side, (3 m,); side 3 f + i is from corner i of face f to the next.

    Raises
    ------
    ShapeError
        If an edge has not exactly two faces, or if both run along it in the same direction.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    >>> twin_sides(points, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])).tolist()
    [8, 9, 3, 2, 11, 6, 5, 10, 0, 1, 7, 4]
    """
    n = len(points)
    begin, end = faces.ravel().astype(np.int64), np.roll(faces, -1, axis=1).ravel().astype(np.int64)
    key = np.minimum(begin, end) * n + np.maximum(begin, end)
    order = np.argsort(key, kind="stable")
    _, first, count = np.unique(key[order], return_index=True, return_counts=True)
    if (count != 2).any():
        k = np.flatnonzero(count != 2)[0]
        owners = order[first[k] : first[k] + count[k]]
        a, b = begin[owners[0]], end[owners[0]]
        kind = "the mesh is open" if count[k] == 1 else "the mesh is not manifold"
        repair = "fill the hole" if count[k] == 1 else "split the surfaces that meet there"
        raise ShapeError(
            f"{kind}: edge {min(a, b)}-{max(a, b)} near {near(points[[a, b]])} has {count[k]} "
            f"face{'s' if count[k] > 1 else ''} ({_name(owners // 3, ', ')}), not two; {repair} "
            f"({_such((count != 2).sum(), 'edge')})."
        )
    one, two = order[0::2], order[1::2]
    same = begin[one] == begin[two]
    if same.any():
        k = np.flatnonzero(same)[0]
        raise ShapeError(
            f"faces {one[k] // 3} and {two[k] // 3} both run from vertex {begin[one[k]]} to {end[one[k]]}: "
            f"one of them is turned inside out; reverse its corners ({_such(same.sum(), 'edge')})."
        )
    twins = np.empty(len(key), dtype=np.int64)
    twins[one], twins[two] = two, one
    return twins


def _check_vertices(points, faces, twins) -> None:
    """Around every vertex the faces must be one fan, not two that touch there."""
    corner = np.arange(faces.size).reshape(-1, 3)
    links = []
    for side in range(3):
        for here in (side, (side + 1) % 3):
            other = twins[:, side]
            there = (faces[other] == faces[:, here, None]).argmax(axis=1)
            links.append(np.stack([corner[:, here], corner[other, there]], axis=1))
    fans, label = components(faces.size, np.concatenate(links))
    if fans == len(points):
        return
    vertex = np.empty(fans, dtype=np.int64)
    vertex[label] = faces.ravel()
    bad = np.flatnonzero(occurrences(vertex, len(points)) > 1)
    raise ShapeError(
        f"the mesh is not manifold: at vertex {bad[0]} near {near(points[bad[:1]])} two or more surfaces "
        f"touch; give each its own vertex and move them apart ({_such(len(bad), 'vertex', 'vertices')})."
    )


def surfaces_of(faces: np.ndarray, twins: np.ndarray) -> tuple[int, np.ndarray]:
    """Number of connected surfaces, and the surface of each face.

    Examples
    --------
    >>> faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> surfaces_of(faces, twin_faces(np.zeros((4, 3)), faces))[0]
    1
    """
    return components(len(faces), np.stack([np.repeat(np.arange(len(faces)), 3), twins.ravel()], axis=1))


def signed_volume(triangles: np.ndarray) -> float:
    """Volume behind closed triangles (m, 3, 3); negative if they are turned inward.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 6]], dtype=float)
    >>> signed_volume(points[[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]])
    1.0
    """
    corners = triangles - triangles.reshape(-1, triangles.shape[-1]).mean(axis=0)
    return float((corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])).sum() / 6)


def turn_of_surface(triangles: np.ndarray) -> int:
    """+1 for a closed surface turned outward, -1 for one turned inward; exact.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    >>> turn_of_surface(points[[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]])
    -1
    """
    scaled = np.ldexp(triangles, -np.frexp(np.abs(triangles).max())[1])  # in any unit volumes are floats
    volume, size = signed_volume(scaled), np.ptp(scaled.reshape(-1, 3), axis=0).max()
    # Each of the 6 m products is off by a few units; far outside of that the sign is sure.
    if abs(volume) > 1e-13 * len(triangles) * size**3:
        return 1 if volume > 0 else -1
    a, b, c = as_integers(triangles)[0].transpose(1, 0, 2)
    exact = (a * np.cross(b, c)).sum()
    return (exact > 0) - (exact < 0)


def nesting_of_surfaces(points, faces, twins) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The surface of each face; how many others surround each surface; and how each is turned.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    >>> faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> [x.tolist() for x in nesting_of_surfaces(points, faces, twin_faces(points, faces))]
    [[0, 0, 0, 0], [0], [1]]
    """
    count, label = surfaces_of(faces, twins)
    first = points[faces[np.unique(label, return_index=True)[1], 0]]
    depth, turn = np.zeros(count, dtype=int), np.zeros(count, dtype=int)
    for k in range(count):
        triangles = points[faces[label == k]]
        turn[k] = turn_of_surface(triangles)
        if count > 1:
            inside = locate(triangles, first) > 0
            inside[k] = False
            depth += inside
    return label, depth, turn


def _check_orientation(points, faces, twins) -> None:
    label, depth, turn = nesting_of_surfaces(points, faces, twins)
    wrong = np.flatnonzero((turn > 0) != (depth % 2 == 0))
    if len(wrong):
        k = wrong[0]
        face = np.flatnonzero(label == k)[0]
        kind = "an outer surface is turned inward" if depth[k] % 2 == 0 else "a cavity is turned outward"
        raise ShapeError(
            f"{kind}: surface {k} of {len(depth)}, with face {face} near {near(points[faces[face]])}, has "
            "the inside in front of it; reverse its faces, or use Shape.from_mesh(V, F, turn=True)."
        )


def turned(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The faces with every connected surface turned outward, or inward if it bounds a cavity.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    >>> turned(points, np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]))[0].tolist()
    [0, 2, 1]
    """
    _check_faces(points, faces)
    label, depth, turn = nesting_of_surfaces(points, faces, twin_faces(points, faces))
    wrong = ((turn > 0) != (depth % 2 == 0))[label]
    return np.where(wrong[:, None], faces[:, [0, 2, 1]], faces)


def mesh_betti(points: np.ndarray, faces: np.ndarray) -> tuple[int, int, int]:
    """Betti numbers of the solid: outer surfaces, handles of all surfaces, cavities.

    Half of the loops on the boundary of a solid can be filled inside it, so a surface of genus g
    brings g loops, whichever side of it the solid is on.

    Examples
    --------
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    >>> mesh_betti(points, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    (1, 0, 0)
    """
    count, label = surfaces_of(faces, twin_faces(points, faces))
    turns = [turn_of_surface(points[faces[label == k]]) for k in range(count)]
    characteristic = len(points) - len(faces) // 2  # V - E + F, and E = 3 F / 2
    return turns.count(1), (2 * count - characteristic) // 2, turns.count(-1)


def _such(count, one: str, many: str = "") -> str:
    return f"{count} such {one if count == 1 else many or one + 's'}"


def _name(indices, between: str = "-") -> str:
    return between.join(map(str, np.asarray(indices).tolist()))
