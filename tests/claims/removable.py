"""Sections 4.1 and 4.2: what may go, and what goes with it."""

from __future__ import annotations

import numpy as np
from truth.solids import random_region

import polyskel_lite as psl
from polyskel_lite import simplification
from polyskel_lite.figures import removals

from .pictures import dots, faces, figure_is, lines, pieces
from .registry import check, seen, verdict
from .removal import (
    Region,
    branch,
    egg,
    hollow_ball,
    in_order,
    library_betti,
    library_dual,
    names,
    polygons,
    simplify,
    solids,
    surface,
    torus,
    wireframe,
)


@check("duality-removal")
def what_goes_with_a_simplex():
    """Without T the dual is the old one without every element that has T's vertex; each T of four regions.

    Cell by cell, and so is the library's Sk0.
    """
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
            if list(library_dual(P, smaller.alive)) != expected:
                return verdict(False)
        assert list(library_dual(P, region.alive)) == before
    return verdict(True)


@check("simplify-homotopy")
def topology_after_every_removal():
    """Polygons and solids without pinches: after each removal the closed region, its dual and the boundary.

    All three strategies, to their very end; Betti numbers are ranks of boundary matrices. The library takes
    away the same simplices in the same order.
    """
    for P in (*polygons()[:8], torus(2), hollow_ball(), egg(1)):
        rules = (branch,) if P.dimension == 2 else (surface, wireframe)
        for rule in rules:
            gone = simplify(Region.of(P), rule, np.inf)
            if in_order(psl.hierarchy(P, rule.__name__)) != gone:
                return verdict(False)
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
    """Every triangle of 20 regions: the dual keeps its Betti numbers if the triangle is a hat, else never.

    The library counts the same sides as inner, and its Sk0 keeps its Betti numbers for the same triangles.
    """
    hats = 0
    for P in polygons():
        kinds = simplification.simplices_by_type(P)
        sides = dict(zip(map(frozenset, P.tessellation.simplices.tolist()), kinds.tolist(), strict=True))
        before = psl.sk0(P).betti()
        for region, s, dual, _, manifold in _removable(P):
            hats += region.is_hat(s)
            inner = 3 - len(region.boundary_facets(s))
            if dual != region.is_hat(s) or (dual and not (inner == 1 and manifold)) or inner != sides[s]:
                return verdict(False)
            if (library_betti(P, region.alive - {s}) == before) != dual:
                return verdict(False)
    return verdict(hats > 50)


def _kinds_are_right(P: psl.DelaunayShape, strategy: str, counts: dict[int, int]) -> bool:
    """Whether all that the library removes is a hat or a salient when it goes, as it says; counts both."""
    h, region = psl.hierarchy(P, strategy), Region.of(P)
    for s, kind in zip(in_order(h), h.kind[h.order].tolist(), strict=True):
        if (kind == 1) != region.is_hat(s) or (kind == 2) != region.is_salient(s):
            return False
        counts[kind] += 1
        region.remove(s)
    return True


@check("hat-tetrahedron")
def hats_end_branches():
    """A hat: three boundary faces. Its vertex is on one edge and no polygon; both go, nothing else.

    What the library removes as a hat is one when it goes.
    """
    hats, removed = 0, {1: 0, 2: 0}
    for seed in range(8):
        P = random_region(seed, 3, 30)
        region = Region.of(P)
        if not all(_kinds_are_right(P, strategy, removed) for strategy in ("surface", "wireframe")):
            return verdict(False)
        _, edges, polygons = region.dual()
        before = region.dual_betti()
        for s in [s for s in region.alive if region.is_hat(s)]:
            smaller = region.without(s)
            lost = [len(a) - len(b) for a, b in zip(region.dual(), smaller.dual(), strict=True)]
            on = sum(s in e for e in edges), sum(any(s in e for e in p) for p in polygons)
            hats += 1
            if on != (1, 0) or lost != [1, 1, 0] or smaller.dual_betti() != before:
                return verdict(False)
    return verdict(hats > 20 and removed[1] > 200)


@check("salient-tetrahedron")
def salients_are_borders():
    """A salient: two boundary faces, two inner ones, one inner edge. Exactly one polygon goes with it.

    What the library removes as a salient is one when it goes.
    """
    salients, removed = 0, {1: 0, 2: 0}
    for P in (*solids(), random_region(1, 3, 40), random_region(2, 3, 40)):
        region = Region.of(P)
        if not all(_kinds_are_right(P, strategy, removed) for strategy in ("surface", "wireframe")):
            return verdict(False)
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
    return verdict(salients > 20 and removed[2] > 100)


@check("only-removable")
def other_removable_tetrahedra():
    """Every tetrahedron of three solids. Without pinches: hats and salients only. With: others too.

    One boundary face and two inner edges, or no boundary face and three: the dual's Betti numbers stay, and
    those of the library's Sk0 do for the same tetrahedra.
    """
    others, without_pinch = set(), True
    for P in solids():
        before = psl.sk0(P).betti()
        for region, s, dual, closed, manifold in _removable(P):
            if (library_betti(P, region.alive - {s}) == before) != dual:
                return verdict(False)
            known = region.is_hat(s) or region.is_salient(s)
            without_pinch &= (dual and closed and manifold) == known
            if dual and not known:
                others.add((len(region.boundary_facets(s)), len(region.inner_edges(s))))
    assert others <= {(1, 2), (0, 3)}
    return verdict(stands=not others, repaired=without_pinch)


def _without(P: psl.DelaunayShape, row: int) -> psl.DelaunayShape:
    inner = P.inner.copy()
    inner[row] = False
    return psl.DelaunayShape(P.tessellation, inner)


@check("fig-6")
def figure_6():
    return seen(figure_is("figure_6", 6, _three_of_six))


def _three_of_six(figure, panels) -> bool:
    """Solids and polygons in pieces; the first three lose their simplex and keep their Betti numbers."""
    examples = removals.examples_6()
    kept = [psl.sk0(_without(P, row)).betti() == psl.sk0(P).betti() for P, row in examples]
    types = [int(simplification.simplices_by_type(P)[row]) for P, row in examples]
    pieces_ = [max(faces(ax), default=0) // 4 or len(ax.patches) for ax in panels]
    return kept == 3 * [True] + 3 * [False] and types[:3] == [1, 1, 2] and min(pieces_) > 1


@check("fig-7")
def figure_7():
    return seen(figure_is("figure_7", 6, _before_and_after))


def _before_and_after(figure, panels) -> bool:
    """Dots at the vertices of Sk0, above before and below after the removal; in the plane its edges."""
    examples = removals.examples_7()
    shapes = [P for P, _ in examples] + [_without(P, row) for P, row in examples]
    for ax, P in zip(panels, shapes, strict=True):
        skeleton = psl.sk0(P)
        if {*map(tuple, np.round(dots(ax), 9).tolist())} != {
            *map(tuple, np.round(skeleton.vertices, 9).tolist())
        }:
            return False
        if P.dimension == 2 and not pieces(skeleton.segments()) <= lines(ax):
            return False
    return True


@check("surface-strategy")
def hats_always_salients_sometimes():
    """No end is left at any threshold. But the torus ends as a loop of wire: not a surface."""
    wires, free = 0, 0
    for P in (*solids(), *(random_region(k, 3, 30) for k in range(4))):
        for threshold in (0.0, np.pi / 3, np.pi):
            region = Region.of(P)
            simplify(region, surface, threshold)
            if names(P, psl.hierarchy(P, "surface").kept(threshold)) != region.alive:
                return verdict(False)
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
            if names(P, psl.hierarchy(P, "wireframe").kept(threshold)) != region.alive:
                return verdict(False)
            left = len(region.dual()[2])
            assert not any(map(region.is_salient, region.alive))
            if P is solids()[1]:
                assert left == total
            else:
                held += left
    arms = psl.hierarchy(psl.datasets.load("fourbranch"), "wireframe")
    almost = len(arms.skeleton(2 * np.pi).polygons) < 0.01 * len(psl.sk0(arms.P).polygons)
    return verdict(stands=held == 0, repaired=almost)
