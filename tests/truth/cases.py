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

from .complexes import distance_to_complex, sample_complex
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
