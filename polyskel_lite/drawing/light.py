"""Light and camera of the pictures in space: where faces look, how bright they are, who looks at them."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

#: Direction towards the light, for `draw_facets_3d`.
LIGHT = np.array([0.35, -0.6, 0.72])


def normals_of(corners) -> np.ndarray:
    """Normals of triangles, twice as long as their area, towards whoever sees them counter-clockwise.

    Examples
    --------
    >>> from polyskel_lite import drawing
    >>> drawing.normals_of([[(0, 0, 0), (1, 0, 0), (0, 2, 0)]]).tolist()
    [[0.0, 0.0, 2.0]]
    """
    a, b, c = np.asarray(corners, dtype=float).transpose(1, 0, 2)
    return np.cross(b - a, c - a)


def unit(vectors: np.ndarray) -> np.ndarray:
    """Vectors (m, 3) scaled to length one; those of no length stay as they are.

    Examples
    --------
    >>> unit(np.array([[0.0, 0.0, 2.0], [0.0, 0.0, 0.0]])).tolist()
    [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]
    """
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True).clip(np.finfo(float).tiny)


def shades(normals: np.ndarray, dark: float) -> np.ndarray:
    """How bright faces are under `LIGHT`, both sides alike: `dark` to 1, (m, 1) float array.

    Examples
    --------
    >>> from polyskel_lite import drawing
    >>> drawing.shades(drawing.LIGHT[None], 0.5).round(9).tolist()
    [[1.0]]
    """
    return dark + (1 - dark) * np.abs(unit(normals) @ (LIGHT / np.linalg.norm(LIGHT)))[:, None]


def view_direction(ax: Axes) -> np.ndarray:
    """Unit vector from the middle of a 3D axes to its camera.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes_3d()
    >>> ax.view_init(elev=90, azim=0)
    >>> drawing.view_direction(ax).round(9).tolist()
    [0.0, 0.0, 1.0]
    >>> plt.close(fig)
    """
    elev, azim = np.radians([ax.elev, ax.azim])
    direction = [np.cos(elev) * np.cos(azim), np.cos(elev) * np.sin(azim), np.sin(elev)]
    # The vertical axis of matplotlib's 3D axes can be x (0), y (1) or z (2); the others follow in a cycle.
    return np.roll(direction, ax._vertical_axis - 2)
