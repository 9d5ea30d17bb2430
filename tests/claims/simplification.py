"""Section 4: why a skeleton is simplified, and what there was in 2D.

Removals are simulated by `claims.removal`, which does not share a line with the library's loop.
"""

from __future__ import annotations

import random
from itertools import pairwise

import numpy as np
from truth.solids import random_region

import polyskel_lite as psl

from .geometry import ends, flower, ring
from .registry import check, verdict
from .removal import (
    RULES,
    THRESHOLDS,
    Region,
    library_dual,
    names,
    noisy_flower,
    shuffled,
    simplify,
    size_changes,
    survivors,
)


@check("noise-motivates")
def noise_changes_the_skeleton():
    """Noise of half a percent: the shape moves by less than 0.03, its skeleton gets ten times the ends."""
    smooth, noisy = flower(5, 300), noisy_flower(0.005)
    moved = psl.hausdorff(smooth, noisy)
    before, after = (psl.sk0(s) for s in (smooth, noisy))
    assert moved < 0.03
    return verdict(ends(before) == 5 and ends(after) > 50 and psl.hausdorff(before, after) > 10 * moved)


@check("simplify-subset")
def shortened_branches():
    """End points removed one after the other, while any criterion whatever says so: here dice decide.

    And by the library's own criteria, in the plane and in space: parts of Sk0, with its Betti numbers.
    """
    for seed in range(12):
        if not _parts_of_the_dual(random_region(seed)):
            return verdict(False)
        region = Region.of(random_region(seed))
        vertices, edges = map(set, region.dual())
        before = region.dual_betti()
        dice = random.Random(seed).random
        values = {s: dice() for s in region.alive}
        gone = simplify(region, lambda r, s, _: values[s] if r.is_hat(s) else None, 0.7)  # noqa: B023
        left = list(map(set, region.dual()))
        subset = left[0] < vertices and left[1] < edges
        if not (gone and subset and region.dual_betti() == before):
            return verdict(False)
    return verdict(all(_parts_of_the_dual(random_region(seed, 3)) for seed in range(4)))


def _parts_of_the_dual(P: psl.DelaunayShape) -> bool:
    """Whether the library's simplified skeletons are parts of the initial dual with its Betti numbers."""
    region = Region.of(P)
    whole, before = list(map(set, region.dual())), region.dual_betti()
    for strategy in ("branch",) if P.dimension == 2 else ("surface", "wireframe"):
        h = psl.hierarchy(P, strategy)
        for threshold in THRESHOLDS:
            kept = names(P, h.kept(threshold))
            part = library_dual(P, kept)
            skeleton = h.skeleton(threshold)
            if not all(a <= b for a, b in zip(part, whole, strict=True)) or skeleton.betti() != before:
                return False
            if len(skeleton.vertices) != len(kept) or len(skeleton.edges) != len(part[1]):
                return False
    return bool(len(h.order))


@check("absolute-thresholds")
def thresholds_in_lengths_and_areas():
    """What a simplification loses, of a shape and of one ten times as large: no threshold fits both.

    The lost area is a hundred times as large, the Hausdorff distance of the shapes ten times.
    """
    area, distance = [], []
    for size in (1, 10):
        shape = psl.datasets.load("horse", n=160)
        h = psl.hierarchy(psl.Shape(shape.points * size, shape.facets))
        rebuilt = h.skeleton(np.pi).reconstruct()
        corners = rebuilt.tessellation.points[rebuilt.tessellation.simplices[rebuilt.inner]]
        u, v = (corners[:, 1:] - corners[:, :1]).transpose(1, 2, 0)
        area.append(size**2 * shape.area() - np.abs(u[0] * v[1] - u[1] * v[0]).sum() / 2)
        # The farthest of what is lost is a sample.
        distance.append(rebuilt.to_shape().boundary_distance(h.P.tessellation.points).max())
    scales = np.isclose(area[1], 100 * area[0]) and np.isclose(distance[1], 10 * distance[0])
    return verdict(bool(area[0] > 0 and distance[0] > 0 and scales))


@check("size-invariant")
def all_criteria_under_scaling():
    """2D p/r, angles, and 3D p/r²: the same simplices at 1/1024 and 1,024 times the size. 3D p/r: not."""
    assert size_changes("wireframe", 2.0**10, "transcript")
    return verdict(not any(size_changes(s, f) for s in RULES for f in (2.0**-10, 2.0**10)))


@check("angle-importance")
def greater_angle_more_important():
    """Four bumps on a disc: the higher a bump, the larger the angle up to which its branch stays."""
    t = 2 * np.pi * np.arange(400) / 400
    heights, places = (0.05, 0.1, 0.2, 0.4), (0.5, 2.0, 3.5, 5.0)
    r = 1 + sum(h * np.exp(-(((t - c) / 0.15) ** 2)) for h, c in zip(heights, places, strict=True))
    h = psl.hierarchy(ring(np.column_stack([r * np.cos(t), r * np.sin(t)])))
    x, y = psl.sk0(h.P).vertices.T
    near = [np.abs(np.arctan2(y, x) % (2 * np.pi) - c) < 0.2 for c in places]
    levels = [h.level[here & (np.hypot(x, y) > 0.6)].max() for here in near]
    return verdict(bool((np.diff(levels) > 0.3).all()))


@check("hierarchy-nested")
def thresholds_make_a_hierarchy():
    """Smallest criterion first: what goes at a threshold goes at every larger one. Any order: it may not."""
    nested, by_chance = True, True
    for seed in range(6):
        for strategy, rule in RULES.items():
            P = random_region(seed, 2 if strategy == "branch" else 3, 30 if strategy == "branch" else 16)
            kept = [survivors(P, rule, t) for t in THRESHOLDS]
            h = psl.hierarchy(P, strategy)
            assert kept == [names(P, h.kept(t)) for t in THRESHOLDS]
            any_order = [survivors(P, rule, t, shuffled(k)) for k, t in enumerate(THRESHOLDS)]
            nested &= all(b <= a for a, b in pairwise(kept))
            by_chance &= all(b <= a for a, b in pairwise(any_order))
    return verdict(stands=nested and by_chance, repaired=nested)
