"""Random polyballs of eleven families, without tangent balls."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from .complexes import lengths


def _unit(rng, k, N):
    v = rng.standard_normal((k, N))
    return v / lengths(v)[:, None]


def chain(rng, N):
    k = int(rng.integers(2, 14))
    r = rng.uniform(0.6, 1.2, k)
    steps = _unit(rng, k, N) * rng.uniform(0.5, 1.3, (k, 1))
    steps[:, 0] += rng.uniform(0, 1)
    return np.cumsum(steps, axis=0), r


def cluster(rng, N):
    k = int(rng.integers(1, 16 if N == 2 else 11))
    return rng.standard_normal((k, N)) * rng.uniform(0.5, 1.6), rng.uniform(0.3, 1.3, k)


def ring(rng, N):
    k = int(rng.integers(5, 15))
    angle = np.arange(k) * 2 * np.pi / k
    c = np.zeros((k, N))
    c[:, 0], c[:, 1] = np.cos(angle), np.sin(angle)
    side = 2 * np.sin(np.pi / k)
    c += rng.normal(0, 0.05 * side, c.shape)
    return c, side * rng.uniform(0.62, 0.85, k)


def cage(rng, N):
    """Balls around a cavity (some holes may stay open)."""
    k = 8 if N == 2 else int(rng.integers(12, 23))
    if N == 2:
        angle = np.arange(k) * 2 * np.pi / k
        c, r = np.column_stack([np.cos(angle), np.sin(angle)]), 0.48
    else:
        z = 1 - (2 * np.arange(k) + 1) / k
        angle = np.arange(k) * np.pi * (3 - np.sqrt(5))
        c = np.column_stack([np.sqrt(1 - z * z) * np.cos(angle), np.sqrt(1 - z * z) * np.sin(angle), z])
        r = 2.6 / np.sqrt(k)
    extra = int(rng.integers(0, 3))  # small balls in the cavity
    c = np.concatenate([c + rng.normal(0, 0.04, c.shape), rng.normal(0, 0.1, (extra, N))])
    return c, np.concatenate([r * rng.uniform(0.9, 1.05, k), np.full(extra, 0.07)])


def scattered(rng, N):
    """Isolated balls among pairs and triples."""
    k = int(rng.integers(3, 16))
    return rng.uniform(0, 6 if N == 2 else 4, (k, N)), rng.uniform(0.3, 1.1, k)


def lattice(rng, N):
    """Integer centres, radii square roots of integers: many circles and spheres through one point."""
    k = int(rng.integers(3, 12 if N == 2 else 10))
    c = rng.integers(-2, 3, (k, N)).astype(float)
    return c, np.sqrt(rng.choice([1.0, 2.0, 3.0, 4.0, 5.0], k))


def grid(rng, N):
    """Equal balls on neighbouring integer points: the most symmetric case."""
    sides = rng.integers(1, 4, N) if N == 2 else rng.integers(1, 3, N) + (rng.random(N) < 0.3)
    c = np.stack(np.meshgrid(*(np.arange(s) for s in sides), indexing="ij"), axis=-1).reshape(-1, N)
    c = c[rng.random(len(c)) < 0.85]
    c = c if len(c) else np.zeros((1, N))
    return c.astype(float), np.full(len(c), rng.choice([0.6, 0.8, np.sqrt(0.5) + 0.05, 0.9]))


def nested(rng, N):
    """Redundant balls: in one ball, touching it from inside, in the union of two, and doubles."""
    c, r = cluster(rng, N)
    small = _unit(rng, 3, N) * 0.4 * r[0] + c[0]
    touching = c[:1] + 0.5 * r[0] * _unit(rng, 1, N)
    parts = [c, small, touching, c[-1:], (c[:1] + c[-1:]) / 2]
    between = min(r[0], r[-1]) * 0.5
    return np.concatenate(parts), np.concatenate([r, 0.3 * r[:1].repeat(3), 0.5 * r[:1], r[-1:], [between]])


def unequal(rng, N):
    k = int(rng.integers(3, 14))
    r = 10 ** rng.uniform(-2, 0.3, k)
    c = [np.zeros(N)]
    for i in range(1, k):  # each on the rim of an earlier one
        j = rng.integers(i)
        c.append(c[j] + _unit(rng, 1, N)[0] * r[j] * rng.uniform(0.9, 1.02))
    return np.array(c), r


def distant(rng, N):
    """A chain 1,000 times its size away from the origin."""
    c, r = chain(rng, N)
    return c + 1e4 * _unit(rng, 1, N), r


def delaunay_balls(rng, N):
    """Balls through N + 1 of some points with none inside, a few left out: the paper's Y_w."""
    points = rng.standard_normal((int(rng.integers(6, 14 if N == 2 else 9)), N))
    corners = points[list(combinations(range(len(points)), N + 1))]
    legs = corners[:, 1:] - corners[:, :1]
    c = corners[:, 0] + np.linalg.solve(legs, (legs**2).sum(axis=-1)[..., None])[..., 0] / 2
    r = lengths(c - corners[:, 0])
    empty = (lengths(c[:, None] - points) > r[:, None] * (1 - 1e-9)).all(axis=1)
    keep = np.flatnonzero(empty & (r < 3) & (rng.random(len(r)) < 0.8))[:25]
    return (c[keep], r[keep]) if len(keep) else (np.zeros((1, N)), np.ones(1))


FAMILIES = (
    chain,
    cluster,
    ring,
    cage,
    scattered,
    lattice,
    grid,
    nested,
    unequal,
    distant,
    delaunay_balls,
)


def random_polyball(number: int, N: int):
    """Polyball `number` of a fixed list without tangent balls: family, centres, radii."""
    rng = np.random.default_rng([number, N])
    family = FAMILIES[number % len(FAMILIES)]
    while True:
        c, r = family(rng, N)
        keep = np.ones(len(r), dtype=bool)
        for i, j in combinations(range(len(r)), 2):
            gap = lengths(c[i] - c[j]) - r[i] - r[j]
            if keep[i] and keep[j] and abs(gap) < 1e-6 * max(r[i], r[j]):
                keep[j] = False
        if keep.any():
            return family.__name__, c[keep], r[keep]
