"""Point sets that are hard for a Delaunay tessellation, from a seed: ties, near ties, flat parts, scales."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

#: By name: from a random generator, a dimension and a size to points, (about n, N).
FAMILIES: dict[str, Callable] = {}


def family(function: Callable) -> Callable:
    """Note a family under the name of its function."""
    FAMILIES[function.__name__] = function
    return function


def unit(rng, n, d):
    """Random directions."""
    x = rng.normal(size=(n, d))
    return x / np.linalg.norm(x, axis=1)[:, None]


def turned(rng, points):
    """The points in a random position: what was exact is so but for the last bits."""
    return points @ np.linalg.qr(rng.normal(size=(points.shape[1],) * 2))[0]


@family
def uniform(rng, d, n):
    """No ties."""
    return rng.random((n, d))


@family
def lattice(rng, d, n):
    """Small whole numbers: cocircular and cospherical sets are the rule."""
    return rng.integers(0, 2 + round(n ** (1 / d)), (n, d)).astype(float)


@family
def far_lattice(rng, d, n):
    """The same, thirds of it, far from the origin."""
    return lattice(rng, d, n) / rng.choice([1, 3]) + 1e8 * rng.normal(size=d)


@family
def turned_lattice(rng, d, n):
    """Nearly cospherical everywhere."""
    return turned(rng, lattice(rng, d, n))


@family
def sphere(rng, d, n):
    """On a sphere but for rounding."""
    return unit(rng, n, d)


@family
def sphere_and_middle(rng, d, n):
    """The same with points inside, and one in the middle."""
    return np.concatenate([unit(rng, n, d), unit(rng, n // 4, d) / 2, np.zeros((1, d))])


@family
def exact_sphere(rng, d, n):
    """Whole numbers with one sum of squares, all signs and orders of them."""
    base = {
        2: [(65, 0), (63, 16), (60, 25), (56, 33), (52, 39)],
        3: [(9, 0, 0), (8, 4, 1), (7, 4, 4), (6, 6, 3)],
    }[d]
    orders = {2: [(0, 1), (1, 0)], 3: [(0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)]}[d]
    signs = np.stack(np.meshgrid(*[(-1, 1)] * d), axis=-1).reshape(-1, d)
    points = np.concatenate([np.array(base)[:, list(order)] * s for order in orders for s in signs])
    return rng.permutation(np.unique(points, axis=0))[:n].astype(float)


@family
def round_grid(rng, d, n):
    """A circle in equal steps; in space a globe or a torus of circles."""
    k = max(3, round(n ** (1 / (d - 1))))
    a = np.arange(k) * 2 * np.pi / k
    if d == 2:
        return np.stack([np.cos(a), np.sin(a)], axis=1)
    a, b = (x.ravel() for x in np.meshgrid(a, a))
    r = 2 + np.cos(b) if rng.random() < 0.5 else np.sin(b / 2 + 0.1)
    return np.stack([r * np.cos(a), r * np.sin(a), np.sin(b) if r.max() > 2 else np.cos(b / 2 + 0.1)], axis=1)


@family
def box(rng, d, n):
    """The surface of a box, in rows."""
    k = max(2, round((n / (2 * d)) ** (1 / (d - 1))))
    grid = np.stack(np.meshgrid(*[np.arange(k + 1.0)] * d), axis=-1).reshape(-1, d)
    return grid[((grid == 0) | (grid == k)).any(axis=1)] * rng.choice([1, 0.1, 1 / 3], size=d)


@family
def turned_box(rng, d, n):
    """Samples nearly in lines or planes."""
    return turned(rng, box(rng, d, n))


@family
def nearly_flat(rng, d, n):
    """In a plane but for very little."""
    points = rng.random((n, d))
    points[:, -1] *= 10.0 ** -rng.integers(3, 18)
    return turned(rng, points) if rng.random() < 0.5 else points


@family
def two_lines(rng, d, n):
    """All samples on two skew lines."""
    t = np.sort(rng.random(n))
    ends = rng.integers(-3, 4, (2, 2, d)).astype(float)
    line = rng.integers(0, 2, n)
    return ends[line, 0] + t[:, None] * (ends[line, 1] - ends[line, 0])


@family
def clusters(rng, d, n):
    """Points close together in places far apart."""
    return rng.integers(0, 3, (n, d)) + rng.random((n, d)) * 10.0 ** -rng.integers(2, 14)


@family
def scales(rng, d, n):
    """Very large, very small, or both at once: then scaling would lose digits."""
    size = 2.0 ** rng.choice([-300, -60, 60, 300])
    points = lattice(rng, d, n) * size
    return points + (rng.random((n, d)) * 2.0**-900 if rng.random() < 0.3 and size < 1 else 0)


def draw(name: str, seed, dimension: int, size: int) -> np.ndarray:
    """Distinct points of a family in a random order."""
    rng = np.random.default_rng(seed)
    points = np.unique(FAMILIES[name](rng, dimension, size) + 0.0, axis=0)
    return rng.permutation(points)
