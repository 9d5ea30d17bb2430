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
