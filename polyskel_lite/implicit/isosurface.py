"""Points spread evenly on the zero set of a function in space, and the topology of its inside on a grid."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.ndimage import generate_binary_structure, label
from scipy.spatial import cKDTree

from ..checks import as_array, near
from ..errors import InputError

_MOST_CELLS = 4_000_000
_DENSE = 14  # candidates per sample


class Grid(NamedTuple):
    """A function on a grid: the lowest corner, the step, which nodes are inside, and the crossings (c, 3)."""

    low: np.ndarray
    step: float
    inside: np.ndarray
    crossings: np.ndarray


def grid_of(field, box: np.ndarray, n: int) -> Grid:
    """The field on a grid that is fine enough for ``n`` samples: about two crossings of grid lines for each.

    Examples
    --------
    >>> grid = grid_of(lambda x: (x**2).sum(axis=1) - 1, np.array([[-1.5] * 3, [1.5] * 3]), 100)
    >>> len(grid.crossings) > 200
    True
    """
    size = box[1] - box[0]
    step = float((size.prod() / 40_000) ** (1 / 3))
    for _ in range(4):
        nodes = np.ceil(size / step) + 1
        if not nodes.prod() <= 5 * _MOST_CELLS:
            raise InputError(f"the box is too flat or too long for a grid ({size}); make it more of a cube.")
        counts = nodes.astype(int)
        axes = [box[0, k] + step * np.arange(counts[k]) for k in range(3)]
        nodes = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
        flat = nodes.reshape(-1, 3)
        parts = np.array_split(flat, len(flat) // 100_000 + 1)
        value = np.concatenate([np.atleast_1d(as_array(field(part), "what field returns")) for part in parts])
        if value.shape != (len(flat),) or not np.isfinite(value).all():
            raise InputError("field must map (k, 3) points to (k,) finite numbers; it does not in this box.")
        value = value.reshape(nodes.shape[:3])
        inside = value < 0
        crossings = _crossings(nodes, value, inside)
        if len(crossings) >= 2 * n or counts.prod() >= _MOST_CELLS / 2:
            break
        step *= max(0.5, float(np.sqrt(max(len(crossings), 1) / (2.3 * n))))
    if not inside.any():
        raise InputError("the field is negative nowhere on a grid in the box; make the box tighter.")
    hull = np.ones(inside.shape, dtype=bool)
    hull[1:-1, 1:-1, 1:-1] = False
    if (inside & hull).any():
        where = near(nodes[inside & hull][:1])
        raise InputError(f"the field is negative at {where}, on the box; make the box larger.")
    return Grid(box[0], step, inside, crossings)


def _crossings(nodes, value, inside) -> np.ndarray:
    found = []
    for axis in range(3):
        first = tuple(slice(None, -1) if k == axis else slice(None) for k in range(3))
        second = tuple(slice(1, None) if k == axis else slice(None) for k in range(3))
        cut = inside[first] != inside[second]
        a, b = value[first][cut], value[second][cut]
        t = (a / (a - b))[:, None]
        found.append(nodes[first][cut] * (1 - t) + nodes[second][cut] * t)
    return np.concatenate(found)


def topology_of_grid(inside: np.ndarray) -> tuple[int, int, int]:
    """Betti numbers of the cubes, squares, edges and nodes whose corners are all inside.

    Examples
    --------
    >>> ring = np.zeros((5, 5, 3), dtype=bool)
    >>> ring[1:4, 1:4, 1], ring[2, 2, 1] = True, False
    >>> topology_of_grid(ring)
    (1, 1, 0)
    """
    b0 = label(inside)[1]
    outside = np.pad(~inside, 1, constant_values=True)
    cavities = label(outside, structure=generate_binary_structure(3, 3))[1] - 1
    characteristic = 0
    for spans in np.ndindex(2, 2, 2):
        cells = inside
        for axis, span in enumerate(spans):
            if span:
                cells = np.logical_and(*(np.delete(cells, end, axis=axis) for end in (0, -1)))
        characteristic += (-1) ** sum(spans) * int(cells.sum())
    return b0, b0 + cavities - characteristic, cavities


def gradient(field, points: np.ndarray, step: float) -> np.ndarray:
    """Central differences, (k, 3).

    Examples
    --------
    >>> gradient(lambda x: x[:, 0] ** 2, np.array([[1.0, 0.0, 0.0]]), 1e-4).round(6).tolist()
    [[2.0, 0.0, 0.0]]
    """
    shifts = step * np.eye(3)
    return np.stack([(field(points + s) - field(points - s)) / (2 * step) for s in shifts], axis=1)


def project(field, points: np.ndarray, step: float, rounds: int) -> tuple[np.ndarray, np.ndarray]:
    """Newton's method along the gradient: points near the zero set, and how far the last step was.

    Examples
    --------
    >>> sphere = lambda x: (x**2).sum(axis=1) - 1
    >>> project(sphere, np.array([[0.8, 0.0, 0.0]]), 0.1, rounds=6)[0].round(9).tolist()
    [[1.0, 0.0, 0.0]]
    """
    points = points.copy()
    moved = np.zeros(len(points))
    for _ in range(rounds):
        slope = gradient(field, points, 1e-3 * step)
        way = (field(points) / np.maximum((slope**2).sum(axis=1), 1e-300))[:, None] * slope
        moved = np.linalg.norm(way, axis=1)
        # A long step is a sign of a crease, where the gradient says little.
        points -= way * np.minimum(1, step / np.maximum(moved, 1e-300))[:, None]
    return points, moved


def dense_points(field, grid: Grid, n: int, random) -> tuple[np.ndarray, np.ndarray, float]:
    """Many points on the surface, the area that each stands for, and the spacing of ``n`` even samples."""
    crossings = grid.crossings
    copies = max(1, round(_DENSE * n / len(crossings)))
    jitter = random.uniform(-0.6, 0.6, (copies, len(crossings), 3)) * grid.step
    jitter[0] = 0
    points, moved = project(field, (crossings + jitter).reshape(-1, 3), grid.step, rounds=4)
    normal = gradient(field, points, 1e-3 * grid.step)
    length = np.linalg.norm(normal, axis=1)
    good = (moved < 0.01 * grid.step) & (length > 0) & np.isfinite(points).all(axis=1)
    points, normal = points[good], normal[good] / length[good, None]
    # Grid lines of three directions cross a unit of area |nx| + |ny| + |nz| times.
    weights = grid.step**2 / np.abs(normal).sum(axis=1) / copies
    return points, weights, float(np.sqrt(weights.sum() / n))


def spread(field, points: np.ndarray, weights: np.ndarray, n: int, spacing: float, random) -> np.ndarray:
    """``n`` of the points, evenly spread: thinned to a least distance, then Lloyd's iteration."""
    chosen = _thin(points, n, 0.9 * spacing, random)
    centers = points[chosen]
    dense = cKDTree(points)
    for _ in range(15):
        owner = cKDTree(centers).query(points)[1]
        mass = np.bincount(owner, weights, minlength=n)
        moved = np.stack([np.bincount(owner, weights * points[:, k], minlength=n) for k in range(3)], axis=1)
        has = mass > 0
        centers[has] = moved[has] / mass[has, None]
        # Back to the surface, each at the nearest candidate (two centres never take the same one).
        nearest = dense.query(centers)[1]
        once = np.unique(nearest, return_index=True)[1]
        centers[once] = points[nearest[once]]
    samples, moved = project(field, centers, 0.2 * spacing, rounds=8)
    samples = samples[moved < 1e-3 * spacing]
    # Of samples on a sphere up to rounding, nearly every sign would be in doubt: leave it by a little more.
    return samples + 1e-5 * spacing * random.uniform(-1, 1, samples.shape)


def _thin(points, n, distance, random) -> np.ndarray:
    """Indices of ``n`` points, kept greedily in random order as long as none is nearer than a distance."""
    order = random.permutation(len(points))
    while True:
        near = cKDTree(points).query_ball_point(points, distance)
        free, chosen = np.ones(len(points), dtype=bool), []
        for k in order.tolist():
            if free[k]:
                free[near[k]] = False
                chosen.append(k)
                if len(chosen) == n:
                    return np.array(chosen)
        distance *= 0.97 * np.sqrt(len(chosen) / n)
