"""Sections 1 and 2.1: skeletons, samplings, polygons."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from matplotlib.patches import Circle
from truth import space
from truth.cases import check_complete, check_medial
from truth.complexes import distance_to_complex
from truth.rational import location
from truth.solids import solid

import polyskel_lite as psl

from .appendix_a import library, truth
from .geometry import annulus, coarse_regions, ellipse, ends, exact, flower, in_space, ring, small_solids
from .pictures import default, figure_is, lines, pieces
from .registry import check, definition, seen, transcript, verdict


@check("fig-1")
def figure():
    return seen(figure_is("figure_1", 1, _maximal_balls))


def _maximal_balls(figure, panels) -> bool:
    """All circles but one, two or more, are centred on the skeleton drawn, as large as the horse allows."""
    horse = psl.datasets.load("horse")
    skeleton = psl.sk0(horse.resample(default("figure_1", "n")))
    circles = [patch for patch in panels[0].patches if isinstance(patch, Circle)]
    centers, radii = np.array([c.center for c in circles]), np.array([c.radius for c in circles])
    gap = np.abs(horse.boundary_distance(centers) - radii)
    away = distance_to_complex(centers, skeleton.vertices, skeleton.edges)
    maximal = ((gap < 2e-3) & (away < 1e-9)).sum()  # a line is 2e-3 wide
    return pieces(skeleton.segments()) <= lines(panels[0]) and maximal == len(circles) - 1 >= 2


@check("def-skeleton")
def centers_of_maximal_balls():
    """All balls of a grid in a rectangle: the library's skeleton is where the maximal ones are.

    Of random polyballs, in the plane and in space: grown balls are centred on the library's skeleton, and
    balls around its points cannot grow.
    """
    for N in (2, 3):
        for number in range(10):
            Y, rng = truth(number, N), np.random.default_rng(number)
            skeleton = library(Y).skeleton()
            check_complete(Y, skeleton, rng)
            check_medial(Y, skeleton, rng)
    return definition(_rectangle())


def _rectangle() -> bool:
    """The rectangle [0,4] x [0,2] in eighths."""
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
    shape = ring([(0, 0), (4, 0), (4, 2), (0, 2)])
    found = psl.sk2(shape, shape.sample(480, start=0.5))
    places, step = np.array(sorted(maximal)) / 8, 12 / 480
    reached = distance_to_complex(places, found.vertices, found.edges).max() < step
    # Nearer to the corners two samples of one side can be the nearest.
    inner = found.vertices[found.radii > 10 * step]
    beyond = np.linalg.norm(inner[:, None] - places, axis=2).min(axis=1)
    return bool(maximal == known and reached and beyond.max() < 2**0.5 / 16 + step)


@check("branches-loops")
def branches_and_loops():
    """Petals and ends, holes and loops; in space arms and ends of the wires, tunnels and loops."""
    petals = all(ends(psl.sk0(flower(k, 120))) == k for k in (3, 5))
    arms = ends(psl.hierarchy(solid("tetrapod"), "wireframe").skeleton(2 * np.pi)) == 4
    shapes = [*map(psl.datasets.load, ("gear", "lake")), solid("torus"), solid("double torus")]
    loops = all(psl.sk0(s).betti() == s.betti() for s in shapes)
    return verdict(petals and arms and loops and [s.betti()[1] for s in shapes] == [1, 2, 1, 2])


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
    """In the union: in one of the balls, in whole numbers, in the plane and in space; one area."""
    rng, same, on = np.random.default_rng(4), True, 0
    for N in (2, 3):
        centers, radii = rng.integers(-5, 6, (6, N)), rng.integers(1, 6, 6)
        queries = rng.integers(-9, 10, (2000, N))
        square = ((queries[:, None] - centers) ** 2).sum(axis=2) - radii**2
        same &= (psl.Polyball(centers, radii).contains(queries) == (square <= 0).any(axis=1)).all()
        on += (square.min(axis=1) == 0).sum()
    assert on > 20  # points on spheres, which belong to closed balls
    lens = 2 * np.pi / 3 - np.sqrt(3) / 2
    area = psl.Polyball([(0, 0), (1, 0)], [1, 1]).area()
    return definition(bool(same) and abs(area - (2 * np.pi - lens)) < 1e-12)


@check("transcript-element-of")
def element_of():
    """Shapes hold many points: their samples, and middles of these as far as counting crossings says."""
    single, subsets = False, True
    for shape in (*coarse_regions(), *small_solids()):
        where = space.location if shape.dimension == 3 else location
        if shape.dimension == 3:
            corners, boundary = in_space(shape).points, in_space(shape).faces
        else:
            corners, boundary = exact(shape)
        middles = [tuple((x + y) / 2 for x, y in zip(p, corners[0], strict=True)) for p in corners[1:]]
        expected = [where(m, boundary) >= 0 for m in middles]
        inside = shape.contains(np.array(middles, dtype=float))
        subsets &= bool(shape.contains(shape.points).all()) and inside.tolist() == expected
        single |= len(corners) + sum(expected) == 1
    return transcript(stands=single, other=subsets)


@check("def-density")
def density():
    """w⁻¹ against its definition on many boundary points, of regions and of solids; of a square exactly."""
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
    weights = np.array([(i, j, 20 - i - j) for i in range(21) for j in range(21 - i)]) / 20
    for shape in small_solids():
        corners = shape.points[shape.facets]
        along, E = (weights @ corners).reshape(-1, 3), shape.points[::2]
        brute = np.linalg.norm(along[:, None] - E, axis=2).min(axis=1).max()
        value, step = shape.covering_radius(E), np.linalg.norm(np.diff(corners, axis=1), axis=2).max() / 20
        agree &= brute - 1e-9 <= value <= brute + step + 1e-9
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
    falls = all(b < a for a, b in pairwise(radii)) and radii[-1] < radii[0] / 10
    box = psl.Shape(CUBE, CUBE_FACES)
    for n in (1, 2, 4, 8):
        k = np.stack(np.meshgrid(*[np.arange(n + 1)] * 3), axis=-1).reshape(-1, 3) / n
        E = k[((k == 0) | (k == 1)).any(axis=1)]
        # The middle of a small square of the grid is the farthest.
        falls &= abs(box.covering_radius(E) - 2**0.5 / 2 / n) < 1e-6
    return verdict(bool(falls))


CUBE = np.stack(np.meshgrid([0, 1], [0, 1], [0, 1], indexing="ij"), axis=-1).reshape(-1, 3).astype(float)
CUBE_FACES = np.array(
    [
        *[(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1)],
        *[(2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)],
    ]
)


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
    try:
        # Two cubes that reach into each other.
        psl.Shape(np.concatenate([CUBE, CUBE + 0.4]), np.concatenate([CUBE_FACES, CUBE_FACES + 8]))
        refused = False
    except psl.ShapeError:
        pass
    frame, ball = annulus(np.arange(6), np.arange(6)), solid("ball")
    # The samples leave the sphere by a hundred-thousandth of their spacing, on purpose.
    on_sphere = np.abs(np.linalg.norm(ball.points, axis=1) - 1).max() < 1e-5
    return definition(bool(on_outline and on_sphere) and refused and frame.betti() == (1, 1))
