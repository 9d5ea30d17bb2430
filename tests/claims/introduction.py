"""Sections 1 and 2.1: skeletons, samplings, polygons."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

import polyskel_lite as psl

from .geometry import annulus, coarse_regions, ellipse, ends, flower, ring
from .registry import check, definition, drawn, transcript, verdict


@check("fig-1")
def figure():
    return drawn("figure_1", 1)


@check("def-skeleton")
def skeleton_of_a_rectangle():
    """All balls of a grid in the rectangle [0,4] x [0,2]: the maximal ones are those of its skeleton."""
    balls = {}
    for i in range(1, 32):
        for j in range(1, 16):
            balls[i, j] = min(i, 32 - i, j, 16 - j)  # unit: one eighth

    def inside_another(m):
        return any(
            q != m and r > balls[m] and (q[0] - m[0]) ** 2 + (q[1] - m[1]) ** 2 <= (r - balls[m]) ** 2
            for q, r in balls.items()
        )

    maximal = {m for m in balls if not inside_another(m)}
    walls = {m: sorted((m[0], 32 - m[0], m[1], 16 - m[1])) for m in balls}
    known = {m for m, distances in walls.items() if distances[0] == distances[1]}
    return definition(maximal == known)


@check("branches-loops")
def branches_and_loops():
    petals = all(ends(psl.sk0(flower(k, 120))) == k for k in (3, 5))
    loops = all(psl.sk0(s).betti() == s.betti() for s in map(psl.datasets.load, ("gear", "lake")))
    return verdict(petals and loops)


def _sites(polygon: np.ndarray, m: np.ndarray) -> np.ndarray:
    """Distances from points to the vertices and the open edges of a polygon, the two smallest ones."""
    a, b = polygon, np.roll(polygon, -1, axis=0)
    d = b - a
    t = ((m[:, None] - a) * d).sum(axis=2) / (d**2).sum(axis=1)
    foot = np.linalg.norm(m[:, None] - a - t[..., None] * d, axis=2)
    to_edges = np.where((t > 1e-9) & (t < 1 - 1e-9), foot, np.inf)
    to_corners = np.linalg.norm(m[:, None] - a, axis=2)
    return np.sort(np.concatenate([to_edges, to_corners], axis=1), axis=1)[:, :2]


L_SHAPE = np.array([(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)], dtype=float)


@check("polygon-skeleton")
def polygon_skeleton():
    """Skeleton points of an L have two nearest sites, and those between corner and side are on a parabola."""
    shape, n = ring(L_SHAPE), 640
    step = shape.length() / n
    found = psl.sk2(shape, shape.sample(n, start=0.5))
    inner = found.vertices[found.radii > 4 * step]
    nearest = _sites(L_SHAPE, inner)
    on_graph = (nearest[:, 1] - nearest[:, 0] < step / 2).all()
    x, y = inner.T
    between = (x > 1.25) & (x < 1.9) & (y < 1.4)
    parabola = ((x - 2) ** 2 + 4) / 4  # focus (2, 2), directrix y = 0
    curved = between.sum() > 10 and np.abs(y - parabola)[between].max() < step / 2
    rng = np.random.default_rng(1)
    somewhere = rng.uniform(0, 2, (200, 2))
    elsewhere = np.diff(_sites(L_SHAPE, somewhere)).ravel()
    assert (elsewhere > step).mean() > 0.8  # points off the skeleton are told apart
    return verdict(bool(on_graph and curved))


@check("discrete-skeleton")
def discrete_skeleton():
    """Thinning leaves one piece of pixels when diagonal neighbours count, many pieces when they do not."""
    from scipy.ndimage import label
    from skimage.morphology import skeletonize

    shape = psl.datasets.load("horse")
    low, high = shape.points.min(axis=0), shape.points.max(axis=0)
    x, y = np.meshgrid(np.linspace(low[0], high[0], 120), np.linspace(low[1], high[1], 120))
    mask = shape.contains(np.column_stack([x.ravel(), y.ravel()])).reshape(x.shape)
    thin = skeletonize(mask)
    whole = label(mask)[1]
    eight, four = label(thin, np.ones((3, 3)))[1], label(thin)[1]
    return verdict(eight == whole and four > eight)


@check("noise-barbs")
def noise_makes_barbs():
    """A bump whose height goes to zero keeps a branch of length 2/3; noise makes ends by the dozen."""
    heights, branches = [], []
    for n in (50, 100, 200, 400):
        t = 2 * np.pi * np.arange(n) / n
        circle = np.column_stack([np.cos(t), np.sin(t)])
        circle[0] *= 1 + (2 * np.pi / n) ** 2
        heights.append(circle[0, 0] - 1)
        branches.append(psl.sk0(ring(circle)).length())
    jump = heights[-1] < 3e-4 and min(branches) > 0.66
    clean = ellipse(200)
    noisy = clean + np.random.default_rng(5).normal(0, 0.004, clean.shape)
    barbs = ends(psl.sk0(psl.conform(ring(noisy), to="delaunay"))) - ends(psl.sk0(ring(clean)))
    return verdict(jump and barbs > 30)


@check("def-polyball")
def polyball():
    """In the union: in one of the balls, in whole numbers; and the area of two crossing discs."""
    rng = np.random.default_rng(4)
    centers, radii = rng.integers(-9, 10, (6, 2)), rng.integers(1, 6, 6)
    queries = rng.integers(-14, 15, (300, 2))
    brute = [any(sum((q - c) ** 2) <= r * r for c, r in zip(centers, radii, strict=True)) for q in queries]
    same = (psl.Polyball(centers, radii).contains(queries) == np.array(brute)).all()
    lens = 2 * np.pi / 3 - np.sqrt(3) / 2
    area = psl.Polyball([(0, 0), (1, 0)], [1, 1]).area()
    return definition(bool(same) and abs(area - (2 * np.pi - lens)) < 1e-12)


@check("transcript-element-of")
def element_of():
    """A shape, a polygon, a sample set are subsets of the plane, not single points of it."""
    shapes = coarse_regions()
    points = any(len(shape.points) == 1 for shape in shapes)
    return transcript(stands=points, other=all(shape.area() > 0 for shape in shapes))


@check("def-density")
def density():
    """w⁻¹ against its definition on many boundary points, and against the formula for gaps on circles."""
    agree = True
    for shape in coarse_regions()[:10]:
        a, b = shape.segments[:, 0], shape.segments[:, 1]
        t = np.linspace(0, 1, 101)[:, None, None]
        along = (a + t * (b - a)).reshape(-1, 2)
        E = shape.points[::2]
        brute = np.linalg.norm(along[:, None] - E, axis=2).min(axis=1).max()
        value, step = shape.covering_radius(E), np.linalg.norm(b - a, axis=1).max() / 200
        agree &= brute - 1e-9 <= value <= brute + step + 1e-9
        agree &= abs(shape.sampling_density(E) * value - 1) < 1e-12
    square = ring([(0, 0), (2, 0), (2, 2), (0, 2)])
    return definition(bool(agree) and abs(square.covering_radius() - 1) < 1e-8)


@check("density-converges")
def density_and_convergence():
    """The samples are on the boundary, so their Hausdorff distance to it is w⁻¹: both go to 0 together."""
    horse = psl.datasets.load("horse")
    radii = []
    for n in (25, 50, 100, 200, 400):
        E = horse.sample(n)
        radii.append(horse.covering_radius(E))
        step = 1e-3
        if abs(psl.hausdorff(horse, E, step=step) - radii[-1]) > step:
            return verdict(False)
    return verdict(all(b < a for a, b in pairwise(radii)) and radii[-1] < radii[0] / 10)


@check("def-polygonal-approximation")
def polygonal_approximation():
    """Vertices are on the outline, rings are simple closed curves; crossing ones are refused."""
    on_outline = True
    for name in ("horse", "lake", "gear"):
        outline = psl.datasets.load(name)
        polygon = outline.resample(150, start=0.3)
        on_outline &= outline.boundary_distance(polygon.points).max() < 1e-12
        on_outline &= polygon.betti() == outline.betti()
    try:
        ring([(0, 0), (2, 2), (2, 0), (0, 2)])
        refused = False
    except psl.ShapeError:
        refused = True
    frame = annulus(np.arange(6), np.arange(6))
    return definition(bool(on_outline) and refused and frame.betti() == (1, 1))
