"""Random polyballs as the library sees them beside the truth of `medial`, and how far both may be apart.

Tolerances are shares of the size of the polyball (radius of a ball around it). `TOLERANCE` is what both sides
can lose where circles cross at ordinary angles: corners are known to 1e-12 of the size or better (corners
within 1e-12 / sine of the crossing angle are one corner to the library), and a centre found from corners that
are seen 1/10 rad or more apart amplifies that some 200 times. Where contacts are closer together, the oracle
reports its own error, and ten times that is allowed. Balls whose error is above `BLUNT` say nothing; fewer
than one in twenty may be left out so.
"""

from __future__ import annotations

from functools import cache

import numpy as np

import polyskel_lite as psl
from polyskel_lite.polyballs.distance import distance_to_boundary
from polyskel_lite.polyballs.sphere_patches import patches
from polyskel_lite.polyballs.union import BallUnion
from polyskel_lite.polyballs.volumes import surface_area, volume

from .complexes import distance_to_complex, lengths, sample_complex
from .medial import Union
from .polyballs import FAMILIES, random_polyball

PER_FAMILY = 40
TOLERANCE = 1e-9
BLUNT = 1e-6


class Case:
    """Polyball `number` of dimension N with the oracle's and the library's view of it."""

    def __init__(self, number, N):
        self.name = f"polyball {number} in {N}D"
        _, self.centers, self.radii = random_polyball(number, N)
        self.truth = Union(self.centers, self.radii, seed=number)
        self.size = self.truth.size
        self.Y = psl.Polyball(self.centers, self.radii)
        self.skeleton = self.Y.skeleton()
        self.rng = np.random.default_rng([number, N, 1])


@cache
def case(number, N) -> Case:
    return Case(number, N)


def cases(family, N, count=PER_FAMILY):
    return [case(number, N) for number in range(family, count * len(FAMILIES), len(FAMILIES))]


def away(points, skeleton):
    """Distance from points to a skeleton of the library."""
    return distance_to_complex(points, skeleton.vertices, skeleton.edges, skeleton.polygons)


def samples_of(skeleton, rng, **numbers):
    return sample_complex(rng, skeleton.vertices, skeleton.edges, skeleton.polygons, **numbers)


def farthest(a, b) -> float:
    """Largest distance from a point of a to the nearest of b."""
    return float(lengths(np.asarray(a)[:, None] - np.asarray(b)).min(axis=1, initial=np.inf).max(initial=0))


def both_ways(a, b) -> float:
    """Hausdorff distance of two finite point sets."""
    return max(farthest(a, b), farthest(b, a))


def hausdorff(one, other, rng):
    """Both directed distances between samples of one skeleton and the whole of the other."""
    return max(away(samples_of(one, rng), other).max(), away(samples_of(other, rng), one).max())


def check_complete(truth, skeleton, rng, name=""):
    """Every maximal ball that can be grown has its centre on the skeleton; how many balls were too blunt."""
    m, _, error = truth.medial_points(rng)
    sharp = error <= BLUNT * truth.size
    gap = away(m, skeleton)
    missed = sharp & (gap > TOLERANCE * truth.size + 10 * error)
    assert not missed.any(), (name, m[missed], gap[missed])
    return int((~sharp).sum()), len(m)


def check_medial(truth, skeleton, rng, name=""):
    """Around every point of the skeleton there is a maximal ball; how many points were too blunt."""
    m = samples_of(skeleton, rng)
    growth, error = truth.growth(m)
    wrong = growth > TOLERANCE * truth.size + 10 * error
    assert not wrong.any(), (name, m[wrong], growth[wrong], error[wrong])
    return int((error > BLUNT * truth.size).sum()), len(m)


class Balls:
    """Balls where they stand, and the functions under test, which see them from their middle."""

    def __init__(self, centers, radii):
        centers, radii = np.array(centers, dtype=float), np.array(radii, dtype=float)
        self.union = BallUnion(centers, radii)
        self.centers, self.radii = centers[self.union.rows], self.union.radii

    def __len__(self):
        return len(self.radii)

    @property
    def size(self):
        low, high = self.box()
        return float((high - low).max())

    def box(self):
        reach = self.radii[:, None]
        return (self.centers - reach).min(axis=0), (self.centers + reach).max(axis=0)

    def volume(self):
        return volume(self.union)

    def area(self):
        return surface_area(self.union)

    def distance(self, queries):
        return distance_to_boundary(np.asarray(queries, dtype=float) - self.union.origin, self.union)

    def mesh(self, fineness=0.03):
        vertices, triangles, ball = patches(self.union, fineness)
        return vertices + self.union.origin, triangles, ball

    def inside(self, points, share=0.0):
        """Deeper inside some ball than a share of its radius."""
        square = ((points[:, None] - self.centers) ** 2).sum(axis=2)
        return (square < (self.radii * (1 - share)) ** 2).any(axis=1)


@cache
def family_member(number) -> Balls:
    """One of the oracle's polyballs, every ball once (that is how `Polyball` calls the functions)."""
    _, centers, radii = random_polyball(number, 3)
    rows = np.unique(np.column_stack([centers, radii]), axis=0)
    return Balls(rows[:, :3], rows[:, 3])


def of_all_families(count):
    return range(count * len(FAMILIES))
