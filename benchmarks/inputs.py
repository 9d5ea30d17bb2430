"""The shapes that are measured: made from a seed, at any size."""

from __future__ import annotations

import numpy as np

import polyskel_lite as psl


def lobed_curve(n: int, lobes: int = 24, seed: int = 0) -> psl.Shape:
    """A random smooth closed curve, star-shaped, with n samples evenly spaced along it."""
    rng = np.random.default_rng(seed)
    waves = np.arange(2, lobes + 1)
    height, phase = 0.06 * rng.normal(size=len(waves)), rng.uniform(0, 2 * np.pi, len(waves))

    def at(angle):
        radius = np.exp((height[:, None] * np.cos(waves[:, None] * angle + phase[:, None])).sum(axis=0))
        return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)

    angle = np.linspace(0, 2 * np.pi, 8 * n + 1)
    way = np.append(0, np.cumsum(np.sqrt((np.diff(at(angle), axis=0) ** 2).sum(axis=1))))
    return ring(at(np.interp(np.arange(n) / n * way[-1], way, angle)))


def outline(n: int) -> psl.Shape:
    """The horse: a polygon's straight sides, resampled evenly. Samples are nearly in line, the hard case."""
    return psl.datasets.load("horse").resample(n)


def ring(points: np.ndarray) -> psl.Shape:
    """The shape inside a closed curve of samples, counter-clockwise."""
    k = np.arange(len(points))
    return psl.Shape(points, np.stack([k, np.roll(k, -1)], axis=1))


def bumpy_radius(directions: np.ndarray) -> np.ndarray:
    """Distance from the origin to the bumpy sphere's surface in unit directions (k, 3)."""
    x, y, z = directions.T
    return 1 + 0.25 * np.sin(4 * x + 1) * np.sin(5 * y) * np.cos(3 * z)


def bumpy_samples(n: int, seed: int = 0) -> np.ndarray:
    """n random samples of the bumpy sphere, (n, 3)."""
    directions = np.random.default_rng(seed).normal(size=(n, 3))
    directions /= np.sqrt((directions**2).sum(axis=1))[:, None]
    return directions * bumpy_radius(directions)[:, None]


def bumpy_inside(tessellation: psl.Tessellation) -> np.ndarray:
    """Which simplices have their circumcenter inside the bumpy sphere."""
    centers = np.where(np.isfinite(tessellation.circumcenters), tessellation.circumcenters, 1e9)
    distance = np.sqrt((centers**2).sum(axis=1))
    return distance < bumpy_radius(centers / np.maximum(distance, 1e-12)[:, None])
