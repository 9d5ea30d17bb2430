"""The shapes that are measured: made from a seed, at any size."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

import polyskel_lite as psl

# The twelve triangles of a cube whose corners are numbered as `divided_box` does, in trimesh's order.
BOX = (
    *((1, 3, 0), (4, 1, 0), (0, 3, 2), (2, 4, 0), (1, 7, 3), (5, 1, 4)),
    *((5, 7, 1), (3, 7, 2), (6, 4, 2), (2, 7, 6), (6, 5, 4), (7, 5, 6)),
)


def lobed_curve(n: int, lobes: int = 24, seed: int = 0) -> psl.Shape:
    """A random smooth closed curve, star-shaped, with n samples evenly spaced along it."""
    angle = np.linspace(0, 2 * np.pi, 8 * n + 1)
    steps = np.diff(lobed(angle, lobes, seed), axis=0)
    way = np.append(0, np.cumsum(np.sqrt((steps**2).sum(axis=1))))
    return ring(lobed(np.interp(np.arange(n) / n * way[-1], way, angle), lobes, seed))


def lobed(angle: np.ndarray, lobes: int, seed: int) -> np.ndarray:
    """Points (k, 2) of a random smooth closed curve, star-shaped."""
    rng = np.random.default_rng(seed)
    waves = np.arange(2, lobes + 1)
    height, phase = 0.06 * rng.normal(size=len(waves)), rng.uniform(0, 2 * np.pi, len(waves))
    radius = np.exp((height[:, None] * np.cos(waves[:, None] * angle + phase[:, None])).sum(axis=0))
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)


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


def random_curve(n: int, lobes: int = 24, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Points and facets of the curve of `lobed_curve`, at n sorted random angles: gaps and near pairs."""
    angle = np.sort(np.random.default_rng([seed, n]).uniform(0, 2 * np.pi, n))
    k = np.arange(n)
    return lobed(angle, lobes, seed), np.stack([k, np.roll(k, -1)], axis=1)


def coast(n: int, seed: int = 0) -> np.ndarray:
    """One ring of n vertices, (n, 2): an island with bays on every scale, in degrees with seven decimals."""
    rng = np.random.default_rng(seed)
    waves = np.arange(1, n // 2)
    wave = waves**-1.3 * np.exp(2j * np.pi * rng.uniform(size=len(waves)))
    height = np.fft.irfft(np.append(0, wave), n) * n
    angle = 2 * np.pi * np.arange(n) / n
    radius = np.exp(0.3 * height / height.std())
    return np.round(np.stack([5 + radius * np.cos(angle), 50 + radius * np.sin(angle)], axis=1), 7)


def write_geojson(path: Path, ring: np.ndarray) -> None:
    """A polygon without holes as a GeoJSON file."""
    ring = np.vstack([ring, ring[:1]]).tolist()
    path.write_text(json.dumps({"type": "Polygon", "coordinates": [ring]}), encoding="utf-8")


def write_off(path: Path, points: np.ndarray, faces: np.ndarray) -> None:
    """A triangle mesh as an OFF file, coordinates to the last bit."""
    lines = ["OFF", f"{len(points)} {len(faces)} 0", *(" ".join(map(repr, p)) for p in points.tolist())]
    lines += ["3 " + " ".join(map(str, face)) for face in faces.tolist()]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def primitives() -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Vertices (n, 3) and triangles (m, 3) of the solids that mesh programs offer, as trimesh has them.

    The sizes are the defaults of ``trimesh.creation``; a torus has radii 1 and 0.25, a cylinder radius and
    height 1, the cube is divided three times. Nearly all samples are cospherical, up to rounding.
    """
    up = np.linspace(0, np.pi, 32)
    around = np.linspace(0, 2 * np.pi, 33)
    low, high = np.linspace(-np.pi / 2, 0, 17), np.linspace(0, np.pi / 2, 17)
    ends = np.concatenate([low, high])
    lift = np.repeat([-0.5, 0.5], 17)
    return {
        "icosphere": icosphere(3),
        "uv sphere": revolved(np.column_stack([np.sin(up), -np.cos(up)]), 64),
        "torus": revolved(np.column_stack([1 + 0.25 * np.cos(around), 0.25 * np.sin(around)])[:-1], 32, True),
        "box": divided_box(3),
        "cylinder": revolved(np.array([(0, -0.5), (1, -0.5), (1, 0.5), (0, 0.5)]), 32),
        "capsule": revolved(np.column_stack([np.cos(ends), np.sin(ends) + lift]), 64),
    }


def revolved(profile: np.ndarray, sections: int, closed: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """The solid that a profile (k, 2) of radii and heights sweeps around the z axis; one vertex at a pole."""
    angle = np.linspace(0, 2 * np.pi, sections + 1)[:-1]
    radius, height = profile.T
    points = np.stack(
        [
            np.cos(angle)[:, None] * radius,
            np.sin(angle)[:, None] * radius,
            np.broadcast_to(height, (sections, len(height))),
        ],
        axis=2,
    )
    number = np.arange(sections * len(profile)).reshape(sections, -1)
    number[:, radius < 1e-8] = number[0, radius < 1e-8]
    after = np.roll(number, -1, axis=0)
    if closed:
        number, after = (np.hstack([a, a[:, :1]]) for a in (number, after))
    a, b, c, d = number[:, :-1], after[:, :-1], number[:, 1:], after[:, 1:]
    return compact(points.reshape(-1, 3), np.stack([a, b, c, c, b, d], axis=-1).reshape(-1, 3))


def compact(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Without faces that have a vertex twice and vertices that are in no face."""
    faces = faces[[len({*face}) == 3 for face in faces.tolist()]]
    used, faces = np.unique(faces, return_inverse=True)
    return points[used], faces.reshape(-1, 3)


def divided(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Every triangle in four, by the midpoints of its sides."""
    sides = np.sort(faces[:, [(0, 1), (1, 2), (2, 0)]].reshape(-1, 2), axis=1)
    pairs, middle = np.unique(sides, axis=0, return_inverse=True)
    ab, bc, ca = (middle.reshape(-1, 3) + len(points)).T
    a, b, c = faces.T
    faces = np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)
    return np.vstack([points, points[pairs].mean(axis=1)]), faces


def icosphere(times: int) -> tuple[np.ndarray, np.ndarray]:
    """The icosahedron, divided and pushed out to the unit sphere."""
    from scipy.spatial import ConvexHull

    golden = (1 + 5**0.5) / 2
    points = np.array([(0, s, t * golden) for s in (-1, 1) for t in (-1, 1)])
    points = np.vstack([np.roll(points, k, axis=1) for k in range(3)])
    points /= np.sqrt((points**2).sum(axis=1))[:, None]
    faces = ConvexHull(points).simplices
    inward = np.linalg.det(points[faces]) < 0
    faces[inward] = faces[inward, ::-1]
    for _ in range(times):
        points, faces = divided(points, faces)
        size = np.sqrt((points**2).sum(axis=1))[:, None]
        points = points + points / size * (1 - size)
    return points, faces


def divided_box(times: int) -> tuple[np.ndarray, np.ndarray]:
    """The unit cube, every side of two triangles, these divided."""
    points = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    faces = np.array(BOX)
    for _ in range(times):
        points, faces = divided(points, faces)
    return points, faces
