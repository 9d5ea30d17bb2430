"""What each check is worth: the library mistaken in one plausible way, the check says something else."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

import polyskel_lite as psl
from claims import CHECKS, pictures
from claims import mutations as m
from polyskel_lite import drawing, simplification
from polyskel_lite.figures import FIGURES, definitions, methods, polyballs, removals, results
from polyskel_lite.figures import simplification as simplified

REGISTER = Path(__file__).resolve().parents[2] / "notebooks" / "claims.toml"
VERDICTS = {
    claim["id"]: claim["verdict"] for claim in tomllib.loads(REGISTER.read_text(encoding="utf-8"))["claim"]
}
SHAPE, BALLS = psl.Shape, psl.Polyball

#: Mistakes that several checks are tried with.
SIMPLEX_LOST = ("the last simplex is lost", m.instead(psl, "delaunay", m.last_simplex_lost))
FLIP = ("one flip too many", m.instead(psl, "delaunay", m.one_flip_too_many))
BARYCENTRES = (
    "barycentres for circumcentres",
    m.instead(psl.Tessellation, "circumcenters", m.barycentres),
)
OPEN_FOR_CLOSED = ("open balls for closed ones", m.instead(psl, "gabriel", m.open_for_closed))
ACUTE_ONLY = ("faces that meet their dual edge only", m.instead(psl, "gabriel", m.acute_only))
EDGE_LOST = ("Sk0 loses its last edge", m.instead(psl, "sk0", m.last_edge_lost(m.SK0)))
VERTEX_LOST = ("Sk0 loses its last vertex", m.instead(psl, "sk0", m.last_vertex_lost(m.SK0)))
SIMPLIFIED = ("Sk0 comes simplified", m.instead(psl, "sk0", m.simplified_sk0))
SK0_FOR_SK2 = ("Sk0 for Sk2", m.instead(psl, "sk2", m.sk0_for_sk2))
SK1_FOR_SK2 = ("Sk2 without its edges", m.instead(psl, "sk2", m.sk1_for_sk2))
SK3_FOR_SK2 = ("pieces at the boundary kept in Sk2", m.instead(psl, "sk2", m.sk3_for_sk2))
SK2_FOR_SK3 = ("pieces at the boundary left out of Sk3", m.instead(psl, "sk3", m.sk2_for_sk3))
ENDS_ENOUGH = ("edges that leave the shape kept", m.instead(psl, "sk2", m.both_ends_are_enough))
BY_CENTRES = ("sorted by circumcentres", m.instead(psl, "delaunay_shape", m.by_their_centres))
NOTHING_MISSING = ("no facet is missing", m.instead(psl, "missing_facets", m.nothing_missing))
NOT_REFINED = ("refinement adds nothing", m.instead(psl, "conform", m.nothing_added))
CORNERS_ONLY = ("w⁻¹ measured at corners only", m.instead(SHAPE, "covering_radius", m.at_the_corners))
SMALLER_BALLS = ("radii 0.9 times", m.instead(psl.Skeleton, "balls", m.smaller_balls))
TRANSCRIPT = ("criteria of the transcript", m.instead(psl, "hierarchy", m.always_transcript))
NEVER_TRANSCRIPT = ("criteria never of the transcript", m.instead(psl, "hierarchy", m.never_transcript))
ONE_TOO_MANY = ("the last one that stays goes too", m.instead(psl, "hierarchy", m.one_too_many))
KINDS_SWAPPED = ("hats for salients", m.instead(psl, "hierarchy", m.kinds_swapped))
SMALLER_SKELETON = ("radii 0.9 times", m.instead(BALLS, "skeleton", m.skeleton_of_smaller_balls))
LENS_SKELETON = ("the lens for the circle", m.instead(BALLS, "skeleton", m.printed_skeleton))

MUTATIONS: dict[str, tuple[str, m.Mutation]] = {
    # 1, 2.1
    "fig-1": ("Sk0 loses its last edge", m.instead(definitions, "sk0", m.last_edge_lost(m.SK0))),
    "branches-loops": EDGE_LOST,
    "polygon-skeleton": BARYCENTRES,
    "def-polyball": ("open balls for closed ones", m.instead(BALLS, "contains", m.open_balls)),
    "noise-barbs": SIMPLIFIED,
    "transcript-element-of": (
        "open shapes for closed ones",
        m.instead(SHAPE, "contains", m.open_shape),
    ),
    "def-skeleton": SMALLER_SKELETON,
    "def-density": CORNERS_ONLY,
    "density-converges": CORNERS_ONLY,
    "def-polygonal-approximation": (
        "samples in the middle of chords",
        m.instead(SHAPE, "resample", m.resampled_beside),
    ),
    # 2.2
    "def-voronoi": ("the last edge is lost", m.instead(psl, "voronoi", m.last_edge_lost(m.VORONOI))),
    "voronoi-convex": BARYCENTRES,
    "voronoi-cost": SIMPLEX_LOST,
    "def-delaunay": FLIP,
    "delaunay-dual": SIMPLEX_LOST,
    "general-position": SIMPLEX_LOST,
    "def-gabriel": OPEN_FOR_CLOSED,
    "gabriel-in-delaunay": FLIP,
    "gabriel-by-voronoi-2d": OPEN_FOR_CLOSED,
    "gabriel-by-voronoi-3d": ACUTE_ONLY,
    "transcript-n-face": ("simplices for facets", m.instead(psl, "gabriel", m.simplices_for_facets)),
    "fig-2": ("one flip too many", m.instead(definitions, "delaunay", m.one_flip_too_many)),
    # 3 to 3.4
    "fig-3": ("Sk2 without its edges", m.instead(methods, "sk2", m.sk1_for_sk2)),
    "common-scheme": ("radii squared", m.instead(psl, "sk3", m.radii_squared(m.SK3))),
    "def-good-skeleton": EDGE_LOST,
    "homotopy-2d": EDGE_LOST,
    "def-sk1": (
        "vertices of inner simplices",
        m.instead(psl, "sk1", m.inner_simplices_for_inner_centres),
    ),
    "sk1-converges-2d": BARYCENTRES,
    "sk1-converges-3d": ("poles only", m.instead(psl, "sk1", m.poles_only)),
    "sk1-disconnected": ("Sk1 with edges", m.instead(psl, "sk1", m.sk2_for_sk1)),
    "def-sk2": ENDS_ENOUGH,
    "voronoi-elements": (
        "corners of polygons out of order",
        m.instead(psl, "voronoi", m.polygons_out_of_order(m.VORONOI)),
    ),
    "def-r-nice": (
        "distances to the corners for those to the boundary",
        m.instead(SHAPE, "boundary_distance", m.to_the_corners),
    ),
    "sk2-converges": SK3_FOR_SK2,
    "def-yw": SMALLER_BALLS,
    "sk2-polyball": ("Sk2 by its reading", m.instead(psl, "sk2", m.skeleton_of_the_balls)),
    "polyball-approximates": SMALLER_BALLS,
    "polyball-skeleton-simple": LENS_SKELETON,
    "fig-4": ("Sk2 without its edges", m.instead(methods, "sk2", m.sk1_for_sk2)),
    "sampling-stable": SK3_FOR_SK2,
    "polygon-skeleton-branches": SK3_FOR_SK2,
    "fig-5": ("pieces at the boundary kept in Sk2", m.instead(methods, "sk2", m.sk3_for_sk2)),
    "def-sk3": SK2_FOR_SK3,
    "sk3-overset": SK2_FOR_SK3,
    "sk3-peripheral": SK2_FOR_SK3,
    "def-contour-containment": (
        "Gabriel for Delaunay",
        m.instead(psl, "missing_facets", m.gabriel_for_delaunay),
    ),
    "sk0-partition": BY_CENTRES,
    "sk0-partition-3d": BY_CENTRES,
    "def-sk0": ("Sk2 for Sk0", m.instead(psl, "sk0", m.sk2_for_sk0)),
    "sk0-homotopy": (
        "vertices at one place are one",
        m.instead(psl, "sk0", m.one_vertex_a_place(m.SK0)),
    ),
    "sk0-reversible": VERTEX_LOST,
    "containment-2r": NOTHING_MISSING,
    "gabriel-r": ("holes are lost", m.instead(psl, "reconstruct_curve", m.holes_lost)),
    "sk0-undefined": ("Sk0 of a refined boundary", m.instead(psl, "sk0", m.conformed_sk0)),
    # 3.5
    "inclusions": ("Sk1 for Sk3", m.instead(psl, "sk3", m.sk1_for_sk3)),
    "not-equivalent": SK0_FOR_SK2,
    "sk0-may-leave": ("Sk2 for Sk0", m.instead(psl, "sk0", m.sk2_for_sk0)),
    "sk2-stays-inside": ENDS_ENOUGH,
    "sk2-homotopy": SK0_FOR_SK2,
    "triangle-vertex-mismatch": BY_CENTRES,
    "figs-gabriel": (
        "is_gabriel asks for contour containment only",
        m.instead(psl.DelaunayShape, "is_gabriel", lambda P, closed=True: True),
    ),
    "theorem-1": ("inner for outer", m.instead(psl, "sk0", m.other_side_sk0)),
    "theorem-2": SK0_FOR_SK2,
    "theorem-2-complement": ("no rays", m.instead(psl, "sk0", m.without_rays(m.SK0))),
    "theorem-2-3d": ACUTE_ONLY,
    "sk0-sk2-differ-3d": SK0_FOR_SK2,
    "gabriel-refinement": NOT_REFINED,
    "acute-corners": ("halving alone", m.instead(psl, "conform", m.halving_alone)),
    "gabriel-no-density": SK1_FOR_SK2,
    "transcript-p-in-gg": (
        "the last Gabriel edge is lost",
        m.instead(psl, "gabriel", m.last_facet_lost),
    ),
    "transcript-del-p": ("shapes are taken for points", m.instead(psl, "delaunay", m.takes_shapes)),
    # 3.6
    "complexity-2d": VERTEX_LOST,
    "complexity-time": (
        "computed anew for every 2,000 points",
        m.instead(psl, "delaunay", m.slow),
    ),
    "complexity-3d": SIMPLEX_LOST,
    "complexity-3d-8n": (
        "half of the simplices are lost",
        m.instead(psl, "delaunay", m.half_of_the_simplices),
    ),
    # 4, 4.1, 4.2
    "noise-motivates": SIMPLIFIED,
    "simplify-subset": ONE_TOO_MANY,
    "absolute-thresholds": (
        "triangles that have gone come back",
        m.instead(psl.Skeleton, "reconstruct", m.whole_shape),
    ),
    "size-invariant": TRANSCRIPT,
    "angle-importance": ("sign flipped", m.instead(psl, "hierarchy", m.sign_flipped)),
    "hierarchy-nested": TRANSCRIPT,
    "duality-removal": EDGE_LOST,
    "simplify-homotopy": ONE_TOO_MANY,
    "hat-triangle": (
        "boundary sides for shared ones",
        m.instead(simplification, "simplices_by_type", m.boundary_sides),
    ),
    "hat-tetrahedron": KINDS_SWAPPED,
    "salient-tetrahedron": KINDS_SWAPPED,
    "only-removable": ("no polygons", m.instead(psl, "sk0", m.without_polygons(m.SK0))),
    "fig-6": (
        "boundary sides for shared ones",
        m.instead(removals, "simplices_by_type", m.boundary_sides),
    ),
    "fig-7": ("Sk0 loses its last vertex", m.instead(removals, "sk0", m.last_vertex_lost(m.SK0))),
    "surface-strategy": TRANSCRIPT,
    "wireframe-strategy": TRANSCRIPT,
    # 4.3
    "alpha-criterion": TRANSCRIPT,
    "alpha-normals": NEVER_TRANSCRIPT,
    "p-over-r-angle": TRANSCRIPT,
    "perimeter-2d": NEVER_TRANSCRIPT,
    "branch-criterion": TRANSCRIPT,
    "a-of-v": TRANSCRIPT,
    "a-of-v-depth": ("v itself is lost", m.instead(simplification, "behind", m.last_of_them_lost)),
    "fig-8": ("criteria of the transcript", m.instead(simplified, "hierarchy", m.always_transcript)),
    "transcript-fig-8": ("degrees for radians", m.instead(psl, "hierarchy", m.in_degrees)),
    "fig-9": ("a triangle of A(v) is lost", m.instead(simplified, "behind", m.first_of_them_lost)),
    "raw-threshold-wrong": TRANSCRIPT,
    "def-p-3d": (
        "parallelograms for triangles",
        m.instead(simplification, "facet_measures", m.twice_the_area),
    ),
    "p-constant": TRANSCRIPT,
    "p-over-r-squared": NEVER_TRANSCRIPT,
    "order-dependence": TRANSCRIPT,
    # results, 5
    "branches-found": TRANSCRIPT,
    "fig-10": ("criteria of the transcript", m.instead(results, "hierarchy", m.always_transcript)),
    "time-under-30s": TRANSCRIPT,
    "almost-wireframe": ("what goes for what stays", m.instead(psl.Hierarchy, "kept", m.what_goes)),
    "parametrized-by-an-angle": TRANSCRIPT,
    "transcript-section-4": ("a wrong section is cited", m.instead(psl, "sk2", m.section_four)),
    "transcript-angel": ("words are taken for thresholds", m.instead(psl.Hierarchy, "kept", m.any_threshold)),
    # A
    "def-minimal": ("all balls are needed", m.instead(BALLS, "generating", m.all_balls)),
    "def-disconnected": ("all that generate", m.instead(BALLS, "disconnected", m.GENERATING)),
    "def-quasi-disconnected": (
        "the circle for the lens",
        m.instead(BALLS, "quasi_disconnected", m.EXPOSED),
    ),
    "def-singular": ("the last point is lost", m.instead(BALLS, "singular_points", m.last_point_lost)),
    "singular-finite": (
        "each point once for each ball",
        m.instead(BALLS, "singular_points", m.once_for_each_ball),
    ),
    "fig-11": ("radii 0.9 times", m.instead(polyballs, "kinds_of_balls", m.balls_too_small)),
    "fig-12": ("the last edge is lost", m.instead(polyballs, "free_edges", m.last_free_edge_lost)),
    "two-contacts": SMALLER_SKELETON,
    "theorem-3": SMALLER_SKELETON,
    "theorem-3-contact": SMALLER_SKELETON,
    "theorem-3-converse": SMALLER_SKELETON,
    "through-centres": LENS_SKELETON,
    "theorem-4": LENS_SKELETON,
    "polyball-by-voronoi": SMALLER_SKELETON,
    # B
    "proof-path": NOT_REFINED,
    "proof-gap": ("open shapes for closed ones", m.instead(psl, "sk1", m.of_the_open_shape)),
    "proof-quadrilateral": SK1_FOR_SK2,
    "fig-13": ("the last line is lost", m.instead(drawing, "draw_lines", m.last_line_lost)),
    # Added later
    "schmitt-complement": ("inner for outer", m.instead(psl, "sk1", m.other_side_sk1)),
    "sk2-converges-any": SK3_FOR_SK2,
    "equivalence-pays": EDGE_LOST,
    "no-element-crosses": NOTHING_MISSING,
    "exact-skeletons-known": BARYCENTRES,
    "polygon-skeleton-cost": SIMPLIFIED,
    "theorem-3-cases": SMALLER_SKELETON,
    "theorem-4-contacts": SMALLER_SKELETON,
    "volume-of-unions": ("overlaps count twice", m.instead(BALLS, "area", m.overlaps_twice)),
    "chromosome-distance": TRANSCRIPT,
    "remarkably-representative": SMALLER_BALLS,
    "theorem-2-converse": SK0_FOR_SK2,
    "sk2-five-conditions": (
        "condition (b) is forgotten",
        m.instead(psl, "sk2_conditions", m.forgotten("extra")),
    ),
}

#: Checks that no mistake of the library can fail, and why.
WITHOUT = {
    "discrete-skeleton": "about thinning pictures, which the library does not do: scikit-image does",
    "polyhedron-quadrics": "pure mathematics: the check is its own proof",
}


def test_every_check_has_a_mutation_or_a_reason():
    assert not set(MUTATIONS) & set(WITHOUT)
    assert set(MUTATIONS) | set(WITHOUT) == set(CHECKS)


@pytest.fixture
def fresh(monkeypatch):
    """Nothing that a check or its inputs remember from before, and nothing remembered afterwards."""
    m.clear_caches()
    yield monkeypatch
    monkeypatch.undo()
    m.clear_caches()


def caught(claim: str, right: str) -> bool:
    try:
        return CHECKS[claim]() != right
    except AssertionError:
        return True


@pytest.mark.parametrize("claim", MUTATIONS)
def test_mistake_is_noticed(claim, fresh):
    # A row that is not in the register yet is held against what the right library gives.
    right = VERDICTS[claim] if claim in VERDICTS else CHECKS[claim]()
    m.clear_caches()
    name, mutate = MUTATIONS[claim]
    mutate(fresh)
    assert caught(claim, right), name


@pytest.mark.parametrize("claim", [claim for claim in CHECKS if claim.startswith("fig-")])
def test_dots_are_no_figure(claim, fresh):
    name = claim.replace("fig-", "figure_")
    fresh.setitem(FIGURES, name, pictures.eight_dots(name))
    assert caught(claim, VERDICTS[claim])
