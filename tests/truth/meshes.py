"""Cubes as closed triangle meshes, made by hand: a pair of corners and outward faces for each."""

from __future__ import annotations

from itertools import product

import numpy as np

CUBE = np.array(list(product((0, 1), repeat=3)), dtype=float)
# Two outward triangles for each side of the cube.
CUBE_FACES = np.array(
    [
        [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1)],
        [(2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)],
    ]
).reshape(-1, 3)


def cube(size=1.0, low=0.0) -> tuple[np.ndarray, np.ndarray]:
    return CUBE * size + low, CUBE_FACES


def moved(*by, size=1.0) -> tuple[np.ndarray, np.ndarray]:
    return CUBE * size + np.array(by), CUBE_FACES


def together(*meshes) -> tuple[np.ndarray, np.ndarray]:
    first = np.cumsum([0, *(len(points) for points, _ in meshes)])
    return (
        np.concatenate([points for points, _ in meshes]),
        np.concatenate([faces + k for (_, faces), k in zip(meshes, first[:-1], strict=True)]),
    )


def inward(mesh):
    return mesh[0], mesh[1][:, [0, 2, 1]]


def extruded(ring, triangles, height: float) -> tuple[np.ndarray, np.ndarray]:
    """The prism over a polygon that is given with its triangles."""
    n = len(ring)
    points = np.array([(x, y, z) for z in (0.0, height) for x, y in ring])
    faces = [t[::-1] for t in triangles] + [tuple(v + n for v in t) for t in triangles]
    for i in range(n):
        j = (i + 1) % n
        faces += [(i, j, j + n), (i, j + n, i + n)]
    return points, np.array(faces)


def capsule(length: float, around: int, along: int, over: int) -> tuple[np.ndarray, np.ndarray]:
    """A cylinder of radius 1 with round ends, whose centres are a length apart, in rings of vertices."""
    turn = np.linspace(-np.pi / 2, 0, over + 1)[1:]
    x = np.concatenate([np.sin(turn), np.linspace(0, length, along + 1)[1:-1], length - np.sin(turn[::-1])])
    r = np.concatenate([np.cos(turn), np.ones(along - 1), np.cos(turn[::-1])])
    angle = np.arange(around) * 2 * np.pi / around
    rings = np.stack([np.outer(np.ones(around), x), np.outer(np.cos(angle), r), np.outer(np.sin(angle), r)])
    points = np.concatenate([[(-1, 0, 0)], rings.T.reshape(-1, 3), [(length + 1, 0, 0)]])
    faces = []
    for j in range(around):
        k = (j + 1) % around
        faces += [
            (0, 1 + k, 1 + j),
            (len(points) - 1, len(points) - 1 - around + j, len(points) - 1 - around + k),
        ]
        for i in range(1, 1 + around * (len(x) - 1), around):
            faces += [(i + j, i + k, i + around + j), (i + k, i + around + k, i + around + j)]
    return points, np.array(faces)
