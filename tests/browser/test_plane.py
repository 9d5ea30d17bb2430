"""The plane's geometry on pages without a kernel answers as the library does, in Chromium.

The library makes random cases and its answers; the page gets those of a family at once, and what it says is
compared here. A failure says how many cases of the family differ, in what, and which is the first.
"""

import json
from collections import Counter
from itertools import chain

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite.errors import PolyskelError, ShapeError, TangentBallsError, TessellationError
from polyskel_lite.exact import first_meeting
from polyskel_lite.explore.bundle import page_module
from polyskel_lite.shapes.rings import ring_facets
from polyskel_lite.skeletons import contact_points, grown_ball

# The modules in one, and the questions that the tests ask of them.
ASK = """
const lengthOf = (segments) => segments.reduce((sum, [p, q]) => sum + distanceTo(p, q), 0);
const questions = {
  graph({ points }) {
    const t = delaunay(points);
    if (!t) return null;
    const table = facetTable(t), rows = (mask) => table.filter((_, k) => mask[k]).map(({ ends }) => ends);
    return {
      simplices: t.simplices, balls: circumballs(t),
      closed: rows(gabrielMask(t, table)), open: rows(gabrielMask(t, table, false)),
    };
  },
  shape({ segments, points, facets, queries }) {
    const t = delaunay(points, facets), { inside, edges, pieces: cut, balls } = voronoiInShape(segments, t);
    const pieces = cut.map(({ line }) => line);
    const numbers = inside.map((within, k) => inside.slice(0, k).filter(Boolean).length);
    const drawn = edges.map(([s, u]) => [balls[s].center, balls[u].center]);
    return {
      simplices: t.simplices, inside, edges, pieces, length: lengthOf([...drawn, ...pieces]),
      betti: bettiOf(inside.filter(Boolean).length, edges.map((edge) => edge.map((s) => numbers[s]))),
      covering: coveringRadius(segments, points), located: queries.map((p) => locate(segments, p)),
      distances: queries.map((p) => Math.min(...segments.map((s) => distance(p, s)))),
    };
  },
  polygon({ points, facets }) {
    const { tessellation, inner, edges, missing } = sk0(points, facets), numbers = new Map();
    inner?.forEach((within, k) => { if (within) numbers.set(k, numbers.size); });
    const betti = inner && bettiOf(numbers.size, edges.map((edge) => edge.map((s) => numbers.get(s))));
    return { simplices: tessellation.simplices, inner, edges, missing, betti };
  },
  samples: ({ rings, n, start }) => sampleRings(rings, n, start)?.flat() ?? null,
  crossing: ({ points, facets }) => polygonCrosses(points, facets),
  ball({ segments, place }) {
    const found = grow(segments, place);
    return { ...found, contacts: contacts(segments, found.center, found.full) };
  },
  discs({ centers, radii }) {
    const balls = centers.map((c, k) => ({ c, r: radii[k] })), found = ballSkeleton(balls);
    const kept = generating(balls, found);
    const rim = ([i, ...ends]) => ends.map((angle) => onCircle(balls[i], angle));
    return {
      ...found, generating: kept, lonely: disconnected(balls, kept), length: lengthOf(found.segments),
      pairs: quasiDisconnected(balls, kept, found), rims: found.arcs.map(rim),
    };
  },
};
const answer = ({ question, ...given }) => questions[question](given);
window.answers = (cases) => JSON.stringify(JSON.parse(cases).map(answer));
"""

NAMES = ["horse", "leaf", "gear", "lake", "hawaii"]


def rows(array):
    """Rows of corners, each sorted, as a set."""
    return {tuple(sorted(row)) for row in np.asarray(array).tolist()}


def near(one, other, share=1e-9):
    return abs(one - other) <= share * (abs(one) + abs(other))


# --- one kind of case: what is asked, and what is wrong with an answer -------------------------------


class Graph:
    """Delaunay, Gabriel, Voronoi vertices of some points."""

    def __init__(self, points):
        self.given = {"question": "graph", "points": np.asarray(points, dtype=float).tolist()}

    def wrong(self, said):
        points = np.array(self.given["points"])
        try:
            t = psl.delaunay(points)
        except PolyskelError:
            return ["refused"] * (said is not None)
        if said is None:
            return ["refused"]
        found = []
        if rows(said["simplices"]) != rows(t.simplices):
            return ["triangles"]
        for name, closed in (("closed", True), ("open", False)):
            if rows(said[name]) != rows(psl.gabriel(t, closed=closed)):
                found.append(f"Gabriel, {name} balls")
        mine = {row: k for k, row in enumerate(map(tuple, np.sort(t.simplices, axis=1).tolist()))}
        order = [mine[tuple(sorted(row))] for row in said["simplices"]]
        if not np.isfinite(t.circumcenters).all():
            return found
        error = np.array([ball["error"] for ball in said["balls"]]) + t.circumcenter_errors[order]
        moved = np.array([ball["center"] for ball in said["balls"]], dtype=float) - t.circumcenters[order]
        grown = np.array([ball["r"] for ball in said["balls"]]) - t.circumradii[order]
        if not (np.hypot(*moved.T) <= error).all():
            found.append("centres")
        if not (np.abs(grown) <= 2 * error).all():
            found.append("radii")
        return found


class Seen:
    """Sk1, Sk2, Sk3 of samples in a shape, the covering radius, and where places are."""

    def __init__(self, shape, E=None):
        self.shape, self.E = shape, E
        points = shape.points if E is None else E
        low, high = shape.points.min(axis=0), shape.points.max(axis=0)
        queries = low + (high - low) * np.random.default_rng(len(points)).random((5, 2))
        self.queries = np.concatenate([queries, shape.points[:2], shape.segments[:2].mean(axis=1)])
        self.given = {
            "question": "shape",
            "segments": shape.segments.tolist(),
            "points": points.tolist(),
            "facets": shape.facets.tolist() if E is None else [],
            "queries": self.queries.tolist(),
        }

    def wrong(self, said):
        shape = self.shape
        t = shape.tessellation if self.E is None else psl.delaunay(self.E)
        if rows(said["simplices"]) != rows(t.simplices):
            return ["triangles"]
        ones, twos, threes = (method(shape, t) for method in (psl.sk1, psl.sk2, psl.sk3))
        corners, inside = np.sort(said["simplices"], axis=1), np.array(said["inside"])
        edges = corners[np.array(said["edges"], dtype=int).reshape(-1, 2)]
        mine = np.sort(t.simplices, axis=1)[twos.simplices[twos.edges]]
        drawn = np.linalg.norm(np.subtract(*threes.segments().swapaxes(0, 1)), axis=1).sum()
        cut, ends = threes.vertices[len(twos.vertices) :], np.reshape(said["pieces"], (-1, 1, 2))
        blur = 1e-12 * np.abs(shape.points).max()
        good = {
            "Sk1": rows(corners[inside]) == rows(t.simplices[ones.simplices]),
            "Sk2": {frozenset(map(tuple, pair)) for pair in edges.tolist()}
            == {frozenset(map(tuple, pair)) for pair in mine.tolist()},
            "Betti numbers of Sk2": tuple(said["betti"]) == twos.betti(),
            "edges of Sk3": len(said["edges"]) + len(said["pieces"]) == len(threes.edges),
            "length of Sk3": near(said["length"], drawn) or drawn == 0 == said["length"],
            "covering radius": near(said["covering"], shape.covering_radius(t.points)),
            "located": said["located"] == shape.locate(self.queries).tolist(),
            "distances": np.allclose(said["distances"], shape.boundary_distance(self.queries), 1e-9, blur),
            "ends of Sk3": not len(cut) or np.linalg.norm(cut - ends, axis=2).min(axis=0).max() <= blur,
        }
        return [what for what, right in good.items() if not right]


class Polygon:
    """Sk0 of a polygon, or the sides that are not Delaunay."""

    def __init__(self, shape):
        self.shape = shape
        self.given = {"question": "polygon", "points": shape.points.tolist(), "facets": shape.facets.tolist()}

    def wrong(self, said):
        shape = self.shape
        if rows(said["simplices"]) != rows(shape.tessellation.simplices):
            return ["triangles"]
        try:
            P = psl.delaunay_shape(shape)
        except psl.ContourContainmentError as error:
            return ["missing sides"] * (rows(said["missing"]) != rows(shape.facets[error.missing]))
        if said["missing"]:
            return ["missing sides"]
        skeleton, corners = psl.sk0(P), np.array(said["simplices"])
        good = {
            "inner triangles": rows(corners[said["inner"]]) == rows(P.tessellation.simplices[P.inner]),
            "edges of Sk0": len(said["edges"]) == len(skeleton.edges),
            "Betti numbers of Sk0": tuple(said["betti"]) == skeleton.betti(),
        }
        return [what for what, right in good.items() if not right]


class Samples:
    """Samples at equal distances, shared among rings."""

    def __init__(self, shape, n, start):
        self.shape, self.n, self.start = shape, n, start
        rings = [shape.points[ring].tolist() for ring in shape.rings()]
        self.given = {"question": "samples", "rings": rings, "n": n, "start": start}

    def wrong(self, said):
        try:
            E = self.shape.sample(self.n, self.start)
        except psl.InputError:
            return ["refused"] * (said is not None)
        same = said is not None and np.shape(said) == E.shape
        size = np.abs(self.shape.points).max()
        return [] if same and np.abs(E - said).max() <= 1e-12 * size else ["samples"]


class Crossing:
    """Whether the polygon through samples crosses itself."""

    def __init__(self, shape, n, start):
        self.shape, self.n, self.start = shape, n, start
        self.points = shape.sample(n, start)
        self.facets = ring_facets([len(ring) for ring in shape._samples(n, start)])
        self.given = {"question": "crossing", "points": self.points.tolist(), "facets": self.facets.tolist()}

    def wrong(self, said):
        try:
            self.shape.resample(self.n, self.start)
            refused = False
        except ShapeError:
            refused = True
        pair = first_meeting(self.points, self.facets)
        return ["crossing"] * (refused != (said is not None)) + ["pair"] * (said != (pair and list(pair)))


class Ball:
    """The maximal ball around a place of a polygon."""

    def __init__(self, shape, place):
        self.shape, self.place = shape, place
        self.given = {"question": "ball", "segments": shape.segments.tolist(), "place": place.tolist()}

    def wrong(self, said):
        radius, center, full = grown_ball(self.shape, self.place)
        touched = contact_points(self.shape, center, full)
        good = {
            "radius": near(said["radius"], radius),
            "maximal radius": near(said["full"], full, 1e-6),
            "centre": np.hypot(*(said["center"] - center)) <= 1e-6 * full,
            "contacts": len(said["contacts"]) == len(touched),
        }
        return [what for what, right in good.items() if not right]


class Discs:
    """The union of discs, definitions 1 to 3, the exact skeleton."""

    def __init__(self, centers, radii):
        self.Y = psl.Polyball(centers, radii)
        self.given = {"question": "discs", "centers": self.Y.centers.tolist(), "radii": self.Y.radii.tolist()}

    def wrong(self, said):
        Y, size = self.Y, np.abs(self.Y.centers).max() + self.Y.radii.max()
        ball, start, end = Y.arcs()
        turns = np.stack([start, end], axis=1)[:, :, None] - [0, np.pi / 2]  # the sine is a cosine, too
        rims = Y.centers[ball][:, None] + Y.radii[ball][:, None, None] * np.cos(turns)
        mine = sorted(zip(ball.tolist(), rims.reshape(-1, 4).tolist(), strict=True))
        other = sorted((i, [*a, *b]) for (i, _, _), (a, b) in zip(said["arcs"], said["rims"], strict=True))
        good = {
            "arcs": [i for i, _ in mine] == [i for i, _ in other] and _close(mine, other, 1e-6 * size),
            "singular points": _paired(Y.singular_points(), said["singular"], 1e-6 * size),
            "area": near(said["area"], Y.area()),
            "generating": said["generating"] == Y.generating().tolist(),
            "needed": said["needed"] == len(Y.minimal()),
            "disconnected": said["lonely"] == Y.disconnected().tolist()
            and said["disconnected"] == len(said["lonely"]),
            "quasi-disconnected": said["pairs"] == Y.quasi_disconnected().tolist()
            and said["quasiDisconnected"] == len(said["pairs"]),
        }
        try:
            skeleton = Y.skeleton()
        except TangentBallsError:
            good["tangent"] = said.get("refused") == "tangent"
        except TessellationError:
            good["rounding"] = said.get("refused") == "rounding"
        else:
            drawn = np.linalg.norm(np.subtract(*skeleton.segments().swapaxes(0, 1)), axis=1).sum()
            good |= {
                "not refused": "refused" not in said,
                "Betti numbers": tuple(said["betti"] or ()) == skeleton.betti(),
                "vertices": _paired(skeleton.vertices, said["dots"], 1e-6 * size),
                "edges": len(said["segments"]) == len(skeleton.edges),
                "length": abs(said["length"] - drawn) <= 1e-6 * size,
            }
        return [what for what, right in good.items() if not right]


def _close(mine, other, most):
    # Arcs of one disc are compared one by one in the order of their first ends.
    rims = np.array([rim for _, rim in mine]) - np.array([rim for _, rim in other])
    return bool((np.abs(rims) <= most).all())


def _paired(mine, other, most):
    other = np.reshape(other, (-1, 2))
    away = np.linalg.norm(np.asarray(mine)[:, None] - other[None], axis=2)
    return len(mine) == len(other) and bool((away.min(axis=0, initial=np.inf) <= most).all())


# --- families ----------------------------------------------------------------------------------------


def random_points(rng):
    return [Graph(rng.random((rng.integers(3, 60), 2))) for _ in range(300)]


def grids(rng):
    for _ in range(150):
        cells = rng.integers(0, rng.integers(2, 8), (rng.integers(3, 40), 2))
        points = np.unique(cells, axis=0) * rng.choice([1.0, 0.1, 1e-3]) + rng.choice([0, 1e6, 0.1])
        yield Graph(rng.permutation(points))


def circles(rng):
    for _ in range(80):
        angle = rng.random((rng.integers(3, 30), 1)) * 2 * np.pi
        away = 1 + rng.choice([0, 1e-16, 1e-12, 1e-3]) * rng.standard_normal(angle.shape)
        yield Graph(np.hstack([np.cos(angle), np.sin(angle)]) * away)
    whole = [(5, 0), (3, 4), (4, 3), (0, 5), (-3, 4), (-4, 3), (-5, 0), (0, -5), (3, -4), (0, 0), (-4, -3)]
    for _ in range(70):
        some = rng.permutation(whole)[: rng.integers(4, 12)]
        yield Graph(some * rng.choice([1, 0.1, 7e5, 2.0**-300]))


def near_lines(rng):
    for _ in range(100):
        x = rng.random(rng.integers(3, 25))
        y = 0.3 * x + rng.choice([0, 1e-17, 1e-12, 1e-8]) * rng.standard_normal(len(x))
        yield Graph(np.column_stack([x, y]))


def scales(rng):
    for size in [1e-140, 1e-120, 1e-100, 1e-50, 1e-20, 1e20, 1e50, 1e100, 1e120, 1e140] * 6:
        points = rng.random((rng.integers(3, 20), 2)) + rng.choice([0, 1e3])
        yield Graph(points * size)
        yield Graph(np.unique(rng.integers(0, 4, (12, 2)), axis=0) * size)
    yield Graph(np.array([(0, 0), (1, 1), (2, 2), (3, 3), (1, 3)]) * 1e140)  # a radius of 1e156


def no_tessellation(rng):
    for k in range(20):
        points = rng.random((k % 5, 2))
        yield Graph(points)
        yield Graph(np.concatenate([points, rng.random((5, 2)), points[:1]]))
        yield Graph(np.outer(rng.integers(-9, 9, 7), (1, 3)))


def star(rng, noise):
    angle = np.sort(rng.random(rng.integers(6, 60))) * 2 * np.pi
    radius = np.abs(1 + noise * rng.standard_normal(len(angle)))
    return psl.Shape.from_rings([radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])])


def tried(count, make):
    """As many as asked for of what is a shape."""
    found = []
    for _ in range(20 * count):
        if len(found) == count:
            break
        try:
            found.append(make())
        except PolyskelError:
            continue
    return found


def stars(rng):
    for shape in tried(90, lambda: star(rng, rng.choice([0, 0.05, 0.3]))):
        yield Seen(shape)
        yield Polygon(shape)


def sampled(rng):
    for k in range(80):
        shape = psl.datasets.load(NAMES[k % 5])
        E = shape.sample(int(rng.integers(24, 160)), float(rng.random()))
        if k % 2:
            E = E + 0.004 * np.ptp(shape.points) * rng.standard_normal(E.shape)
        yield Seen(shape, E)


def resampled(rng):
    def make():
        shape = psl.datasets.load(rng.choice(NAMES))
        return shape.resample(int(rng.integers(40, 150)), float(rng.random()))

    for shape in tried(50, make):
        yield Seen(shape)
        yield Polygon(shape)


def staircase(rng):
    """A skyline on a lattice; some with all lattice points on it, some refined to be Delaunay."""
    heights = rng.integers(1, 6, rng.integers(2, 7))
    tops = chain.from_iterable(((x, h), (x + 1, h)) for x, h in enumerate(heights.tolist()))
    ring = [(len(heights), 0), (0, 0), *tops]
    ring = [p for k, p in enumerate(ring) if p != ring[k - 1]]
    shape = psl.Shape.from_rings([ring])
    return psl.conform(shape) if rng.random() < 0.5 else shape


def staircases(rng):
    for k, steps in enumerate(tried(120, lambda: staircase(rng))):
        # In thirds and tenths what touched on the lattice misses by a rounding.
        shape = psl.Shape(steps.points * (1, 1 / 3, 0.1)[k % 3], steps.facets)
        yield Seen(shape)
        yield Polygon(shape)


def several_rings(rng):
    def make():
        rings, holes = [(0, 0), (9, 0), (9, 9), (0, 9)], rng.integers(0, 3, (rng.integers(1, 4), 2))
        corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
        turned = rng.choice([0, 0, 0.2]) * rng.standard_normal((len(holes), 4, 2))
        return psl.Shape.from_rings([rings, *(1 + 3 * holes[:, None] + corners + turned)])

    for k, shape in enumerate(tried(40, make)):
        yield Seen(shape)
        yield Seen(shape, shape.sample(60, k / 40))
        yield Polygon(psl.conform(shape) if k % 2 else shape)


def scaled_shapes(rng):
    # A Voronoi edge of which all is inside, but the last 3e-32.
    steps = np.array([(4, 0), (4, 5), (3, 5), (3, 3), (2, 3), (2, 2), (1, 2), (1, 4), (0, 4), (0, 0)])
    yield Seen(psl.Shape(steps * 1e-120, ring_facets([10])))
    for size in [1e-120, 1e-60, 1e-7, 1e7, 1e60, 1e120] * 4:
        shape = tried(1, lambda: star(rng, 0.1))[0]
        moved = psl.Shape((shape.points + rng.choice([0, 100])) * size, shape.facets)
        yield Seen(moved)
        yield Polygon(moved)
        steps = staircase(rng)
        yield Seen(psl.Shape(steps.points * size, steps.facets))


def samples_on_lines(rng):
    """Nearly on the sides of a box, so that many centres are far away."""
    box = psl.Shape.from_rings([[(0, 0), (3, 0), (3, 2), (0, 2)]])
    for k in range(40):
        E = box.sample(int(rng.integers(6, 25)), k / 40)
        yield Seen(box, E + rng.choice([1e-13, 1e-10, 1e-7, 1e-4]) * rng.standard_normal(E.shape))


def samples(rng):
    for k in range(100):
        shape = psl.datasets.load(NAMES[k % 5])
        yield Samples(shape, int(rng.integers(3, 400)), float(rng.choice([0, 0.5, -0.3, 2.7, rng.random()])))


def crossings(rng):
    for k in range(100):
        shape = psl.datasets.load(NAMES[k % 5])
        yield Crossing(shape, int(rng.integers(3 * len(shape.rings()), 90)), float(rng.random()))


def maximal_balls(rng):
    for k in range(100):
        shape = psl.datasets.load(NAMES[k % 3 * 2]) if k % 2 else tried(1, lambda: star(rng, 0.1))[0]
        low, high = shape.points.min(axis=0), shape.points.max(axis=0)
        places = low + (high - low) * rng.random((200, 2))
        inside = places[
            shape.contains(places) & (shape.boundary_distance(places) > 1e-6 * (high - low).max())
        ]
        yield from (Ball(shape, place) for place in inside[:2])


def random_discs(rng):
    for _ in range(200):
        n = int(rng.integers(1, 17))
        yield Discs(rng.random((n, 2)) * rng.choice([2, 4, 7]), 0.3 + rng.random(n) * rng.choice([0.3, 1]))


def nested_discs(rng):
    for _ in range(60):
        n = int(rng.integers(2, 12))
        centers, radii = rng.random((n, 2)) * rng.choice([0.3, 3]), rng.random(n) + 0.05
        some = rng.integers(0, n, rng.integers(0, 4))
        yield Discs(
            np.concatenate([centers, centers[some]]), np.append(radii, radii[some] * rng.choice([1, 0.5]))
        )


def chains_of_discs(rng):
    for k in range(80):
        n = int(rng.integers(2, 15))
        step = rng.choice([0.5, 1.0, 1.5, 1.9, 2.1, 3])
        centers = np.column_stack([step * np.arange(n), np.zeros(n)])
        if k % 2:
            centers = centers + 0.05 * rng.standard_normal((n, 2))
        yield Discs(centers + rng.choice([0, 1e4]), np.full(n, 1.0))


def rings_of_discs(rng):
    for k in range(80):
        n = int(rng.integers(3, 15))
        angle = 2 * np.pi * np.arange(n) / n
        centers = rng.choice([1.5, 2, 3]) * np.column_stack([np.cos(angle), np.sin(angle)])
        radii = 1 + 0.2 * rng.random(n) * (k % 2)
        if k % 3 == 0:  # something in the hole that may be needed to fill it
            centers, radii = np.concatenate([centers, [(0, 0.05)]]), np.append(radii, rng.choice([0.2, 0.6]))
        yield Discs(centers, radii)


def filled_holes(rng):
    """Three discs around a gap, and some in the middle."""
    outer = np.array([(1.1, 0), (-0.55, 0.9526), (-0.55, -0.9526)])
    for _ in range(60):
        n = int(rng.integers(1, 6))
        centers, radii = 0.25 * rng.standard_normal((n, 2)), 0.15 + 0.4 * rng.random(n)
        yield Discs(np.concatenate([outer, centers]), np.append(np.ones(3), radii))


def nearly_tangent_discs(rng):
    for k in range(100):
        r = 0.3 + rng.random(3)
        away = rng.choice([1e-3, 1e-6, 1e-8, 1e-10, 0, -1e-3, -1e-6, -1e-8])
        x = [0, r[0] + r[1] + away, r[0] + 2 * r[1] + r[2] + rng.choice([0.1, -0.1, away])]
        turn = np.array([(np.cos(k), np.sin(k))]) if k % 2 else np.array([(1, 0)])
        yield Discs(np.outer(x, turn[0]), r)


def discs_through_one_point(rng):
    """Or two; centres anywhere, or rims dragged over a corner of the board."""
    for k in range(216):
        n, noise = int(rng.integers(2, 17)), (0, 1e-12, 1e-9)[k % 3]
        centers, corner, kind = rng.random((n, 2)) * (4, 3), np.array((4, 3)), k // 3 % 6
        if kind == 1:  # two points, centres on a line
            centers = centers[:, :1] * (0.8, 0.6) + (1, 1)
            corner = np.array((0.4, 1.8))
        elif kind == 2:  # one of two points
            corner = (rng.random((2, 2)) * (4, 3))[rng.integers(0, 2, n)]
        elif kind == 3:  # most rims in the corner
            corner = np.where(rng.random((n, 1)) < 0.7, corner, rng.random((n, 2)) * (4, 3))
        elif kind == 4:  # a point with discs all around it
            corner = rng.random(2) * (4, 3)
        elif kind == 5:  # in pixels
            centers, corner = centers * 80, corner * 80
        radii = np.linalg.norm(centers - corner, axis=1)
        yield Discs(centers, radii * (1 + noise * rng.standard_normal(n)))


FAMILIES = [
    *(random_points, grids, circles, near_lines, scales, no_tessellation),
    *(stars, sampled, resampled, staircases, several_rings, scaled_shapes, samples_on_lines),
    *(samples, crossings, maximal_balls),
    *(random_discs, nested_discs, chains_of_discs, rings_of_discs, filled_holes, nearly_tangent_discs),
    discs_through_one_point,
]


@pytest.fixture(scope="module")
def answers(browser):
    """answers(cases): what a page with the modules in it says."""
    page, errors = browser.new_page(), []
    page.on("pageerror", lambda error: errors.append(error))
    modules = page_module(["Balls", "FourMethods", "Graphs", "MaximalBall", "Sampling"])
    page.set_content(f"<script type='module'>{modules}{ASK}</script>")
    assert errors == []

    def ask(cases):
        given = json.dumps([case.given for case in cases])
        return json.loads(page.evaluate("(cases) => window.answers(cases)", given))

    yield ask
    page.close()


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.__name__)
def test_page_answers_as_the_library(answers, family):
    cases = list(family(np.random.default_rng(FAMILIES.index(family))))
    wrong, first = Counter(), ""
    for k, (case, said) in enumerate(zip(cases, answers(cases), strict=True)):
        found = case.wrong(said)
        wrong.update(found)
        if found and not first:
            first = f"the first is {k}, {type(case).__name__}: {found}"
    assert not wrong, f"of {len(cases)} cases differ {dict(wrong)}; {first}"
