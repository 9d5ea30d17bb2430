"""Sections 4.1 and 4.2: what may go, and what goes with it."""

from __future__ import annotations

import numpy as np
from truth.solids import random_region

import polyskel_lite as psl

from .registry import check, drawn, verdict
from .removal import (
    Region,
    branch,
    egg,
    hollow_ball,
    polygons,
    simplify,
    solids,
    surface,
    torus,
    wireframe,
)


@check("duality-removal")
def what_goes_with_a_simplex():
    """Without T the dual is the old one without every element that has T's vertex; each T of four regions."""
    for P in (random_region(1), random_region(2), egg(), torus()):
        region = Region.of(P)
        before = [set(cells) for cells in region.dual()]
        for s in list(region.alive)[:40]:
            smaller = region.without(s)
            expected = [before[0] - {s}, {e for e in before[1] if s not in e}]
            if region.dimension == 3:
                expected.append({p for p in before[2] if not any(s in edge for edge in p)})
            if [set(cells) for cells in smaller.dual()] != expected:
                return verdict(False)
        sizes = [len(cells) for cells in before]
        skeleton = psl.sk0(P)
        counts = [len(skeleton.vertices), len(skeleton.edges), len(skeleton.polygons)]
        assert counts[: len(sizes)] == sizes
    return verdict(True)


@check("simplify-homotopy")
def topology_after_every_removal():
    """Polygons and solids without pinches: after each removal the closed region, its dual and the boundary.

    All three strategies, to their very end; Betti numbers are ranks of boundary matrices.
    """
    for P in (*polygons()[:8], torus(2), hollow_ball(), egg(1)):
        rules = (branch,) if P.dimension == 2 else (surface, wireframe)
        for rule in rules:
            gone = simplify(Region.of(P), rule, np.inf)
            region = Region.of(P)
            expected = region.closed_betti()
            assert region.dual_betti() == expected[: P.dimension]
            for k, s in enumerate(gone):
                region.remove(s)
                # Every removal of the plane; of space every fifth and the last.
                if P.dimension == 3 and k % 5 and k + 1 < len(gone):
                    continue
                same = region.dual_betti() == expected[: P.dimension] and region.closed_betti() == expected
                if not (same and region.is_manifold()):
                    return verdict(False)
    return verdict(True)


def _removable(P: psl.DelaunayShape):
    """Each simplex with: the dual keeps its Betti numbers, the closed region does, nothing is pinched."""
    region = Region.of(P)
    dual, closed = region.dual_betti(), region.closed_betti()
    for s in sorted(region.alive, key=sorted):
        smaller = region.without(s)
        yield (
            region,
            s,
            smaller.dual_betti() == dual,
            bool(smaller.alive) and smaller.closed_betti() == closed,
            smaller.is_manifold(),
        )


@check("hat-triangle")
def only_hats_in_the_plane():
    """Every triangle of 20 regions: the dual keeps its Betti numbers if the triangle is a hat, else never."""
    hats = 0
    for P in polygons():
        for region, s, dual, _, manifold in _removable(P):
            hats += region.is_hat(s)
            inner = 3 - len(region.boundary_facets(s))
            if dual != region.is_hat(s) or (dual and not (inner == 1 and manifold)):
                return verdict(False)
    return verdict(hats > 50)


@check("hat-tetrahedron")
def hats_end_branches():
    """A hat: three boundary faces. Its vertex is on one edge and no polygon; both go, nothing else."""
    hats = 0
    for seed in range(8):
        region = Region.of(random_region(seed, 3, 30))
        _, edges, polygons = region.dual()
        before = region.dual_betti()
        for s in [s for s in region.alive if region.is_hat(s)]:
            smaller = region.without(s)
            lost = [len(a) - len(b) for a, b in zip(region.dual(), smaller.dual(), strict=True)]
            on = sum(s in e for e in edges), sum(any(s in e for e in p) for p in polygons)
            hats += 1
            if on != (1, 0) or lost != [1, 1, 0] or smaller.dual_betti() != before:
                return verdict(False)
    return verdict(hats > 20)


@check("salient-tetrahedron")
def salients_are_borders():
    """A salient: two boundary faces, two inner ones, one inner edge. Exactly one polygon goes with it."""
    salients = 0
    for P in (*solids(), random_region(1, 3, 40), random_region(2, 3, 40)):
        region = Region.of(P)
        polygons = region.dual()[2]
        before = region.dual_betti()
        for s in [s for s in region.alive if region.is_salient(s)]:
            assert len(region.neighbors(s)) == 2
            smaller = region.without(s)
            lost = [len(a) - len(b) for a, b in zip(region.dual(), smaller.dual(), strict=True)]
            on = sum(any(s in e for e in p) for p in polygons)
            salients += 1
            if on != 1 or lost != [1, 2, 1] or smaller.dual_betti() != before:
                return verdict(False)
    return verdict(salients > 20)


@check("only-removable")
def other_removable_tetrahedra():
    """Every tetrahedron of three solids. Without pinches: hats and salients only. With: others too.

    One boundary face and two inner edges, or no boundary face and three: the dual's Betti numbers stay.
    """
    others, without_pinch = set(), True
    for P in solids():
        for region, s, dual, closed, manifold in _removable(P):
            known = region.is_hat(s) or region.is_salient(s)
            without_pinch &= (dual and closed and manifold) == known
            if dual and not known:
                others.add((len(region.boundary_facets(s)), len(region.inner_edges(s))))
    assert others <= {(1, 2), (0, 3)}
    return verdict(stands=not others, repaired=without_pinch)


@check("fig-6")
def figure_6():
    return drawn("figure_6", panels=6)


@check("fig-7")
def figure_7():
    return drawn("figure_7", panels=6)


@check("surface-strategy")
def hats_always_salients_sometimes():
    """No end is left at any threshold. But the torus ends as a loop of wire: not a surface."""
    wires, free = 0, 0
    for P in (*solids(), *(random_region(k, 3, 30) for k in range(4))):
        for threshold in (0.0, np.pi / 3, np.pi):
            region = Region.of(P)
            simplify(region, surface, threshold)
            _, edges, polygons = region.dual()
            wires += len(set(edges) - set().union(*polygons, set()))
            free += sum(map(region.is_hat, region.alive))
    return verdict(stands=wires == 0, repaired=free == 0)


@check("wireframe-strategy")
def salients_always_hats_sometimes():
    """No salient is left, and almost no polygon. But kept hats hold some, and a cavity all of its own."""
    held = 0
    for P in solids():
        for threshold in (0.0, 2 * np.pi, np.inf):
            region = Region.of(P)
            total = len(region.dual()[2])
            simplify(region, wireframe, threshold)
            left = len(region.dual()[2])
            assert not any(map(region.is_salient, region.alive))
            if P is solids()[1]:
                assert left == total
            else:
                held += left
    arms = psl.hierarchy(psl.datasets.load("fourbranch"), "wireframe")
    almost = len(arms.skeleton(2 * np.pi).polygons) < 0.01 * len(psl.sk0(arms.P).polygons)
    return verdict(stands=held == 0, repaired=almost)
