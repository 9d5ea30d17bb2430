"""The sentences under viewers and explorers: their numbers are computed here and looked for in the chapter.

What stands beside a slider is no output of a cell, so nbval cannot hold it to what the reader will see.
"""

import json
import re
from pathlib import Path

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import explore, figures

NOTEBOOKS = Path(__file__).resolve().parents[2] / "notebooks"


def assert_said(chapter, *sentences):
    cells = json.loads((NOTEBOOKS / f"{chapter}.ipynb").read_text(encoding="utf-8"))["cells"]
    text = " ".join(" ".join("".join(c["source"]) for c in cells if c["cell_type"] == "markdown").split())
    text = re.sub(r"\{(?:state|knob|reading)\}`(.*?) <[^>]*>`", r"\1", text)  # words that move an explorer
    for sentence in sentences:
        assert sentence in text, f"{chapter} does not say: {sentence}"


def ends(skeleton):
    return int((np.bincount(skeleton.edges.ravel()) == 1).sum())


def branches(hierarchy, *turns):
    return [hierarchy.branches(turn * np.pi).graph["branches"] for turn in turns]


@pytest.fixture(scope="module")
def vertebra():
    P = psl.delaunay_shape(psl.conform(psl.datasets.load("vertebra")))
    return {strategy: psl.hierarchy(P, strategy) for strategy in ("surface", "wireframe")}


def test_samples_of_the_horse():
    X = psl.datasets.load("horse")
    radius = [X.covering_radius(X.sample(n)) for n in (100, 200)]
    assert_said("02_1_shapes", f"{radius[0]:.4f} at n = 100 and {radius[1]:.4f} at n = 200")


def test_the_head_of_the_horse_goes_before_the_hooves():
    h = psl.hierarchy(psl.conform(psl.datasets.load("horse").resample(150)))
    assert branches(h, 2.85, 2.9) == [6, 5]
    tips = [node for _, node in h.branches(2.85 * np.pi).nodes(data=True) if node["kind"] == "end"]
    head = max(tips, key=lambda tip: tip["pos"][0])
    hooves = [tip for tip in tips if tip["pos"][1] < -0.2]
    assert len(hooves) == 4
    assert head["radius"] > 3 * max(tip["radius"] for tip in hooves)
    assert head["pos"] not in [node["pos"] for _, node in h.branches(2.9 * np.pi).nodes(data=True)]
    assert_said(
        "index", "At $2.9\\pi$ the branch of neck and head has gone", "more than three times as large"
    )


def test_noise_of_the_sampling_explorer():
    smooth = explore.sampling(psl.datasets.load("horse"), n=200)
    before = ends(psl.sk2(smooth.shape, smooth.shape.sample(200)))
    smooth.controls["noise"].value = 0.2
    after = next(v for k, v in smooth.numbers.items() if "end" in k)
    assert_said("02_1_shapes", f"makes {after} ends of {before}")


def test_holes_of_the_polyball():
    X = psl.datasets.load("horse")
    betti = {n: psl.sk2(X, X.sample(n)).balls().skeleton().betti() for n in (100, 200)}
    assert betti[200] == (1, 0)
    assert_said("03_2_polyballs", f"$b_1 = {betti[100][1]}$. With 200 they are gone")


def test_where_the_polyball_of_the_horse_has_holes():
    X = psl.datasets.load("horse")
    holes = {n: psl.sk2(X, X.sample(n)).balls().skeleton().betti()[1] for n in (25, 50, 100, 200)}
    assert holes == {25: 0, 50: 0, 100: 4, 200: 0}
    assert_said(
        "03_2_polyballs",
        "- [x] yes, with 100 samples, and neither with 50 nor with 200",
        "With 25, 50 and 200",
    )


def test_largest_ball_of_the_horse():
    X = psl.datasets.load("horse")
    skeleton = psl.sk2(X, X.sample(2000))
    k = skeleton.radii.argmax()
    (x, y), radius = skeleton.vertices[k], X.boundary_distance(skeleton.vertices[[k]])[0]
    assert_said(
        "01_introduction",
        f":place: {x:.3f} {y:.3f} 0.04",
        f"at $({x:.3f}, {y:.3f})$, with radius {radius:.3f}",
    )
    away = np.hypot(*(skeleton.vertices - skeleton.vertices[k]).T)
    assert skeleton.radii[away > 0.06].max() < 0.95 * radius  # so a mark that is far off is wrong


def test_samples_that_join_the_two_methods():
    P = psl.datasets.load("leaf").resample(70, 0.5)
    done = psl.conform(P)
    assert (psl.sk2(P).betti()[0], psl.sk2(done).betti()[0]) == (2, 1)
    added = done.points[len(P.points) :]
    in_stalk = (added[:, 0] > -0.02).sum()  # the blade is to the left
    assert in_stalk > 0.75 * len(added)
    assert_said("03_5_comparison", f"- [x] {len(added)} - [ ] 70", f"With {len(done.points)} samples")


def test_sizes_without_computing():
    wave = 1 + 0.1 * np.cos(5 * np.linspace(0, 2 * np.pi, 1000, endpoint=False))
    angle = np.linspace(0, 2 * np.pi, 1000, endpoint=False)
    ring = np.column_stack([wave * np.cos(angle), wave * np.sin(angle)])
    assert len(psl.sk0(psl.Shape.from_rings([ring])).vertices) == 998
    lake = psl.conform(psl.datasets.load("lake", n=100), to="delaunay")
    skeleton = psl.sk0(lake)
    assert_said(
        "03_6_complexity",
        "- [x] 998",
        f"for {len(lake.points)} samples?",
        f"- [x] {len(skeleton.vertices)} and {len(skeleton.edges)}",
    )


def test_lens_of_three_disks_in_a_row():
    rim = psl.Polyball([(0, 0), (0.7, 0)], [1, 1]).singular_points()
    x, y = np.abs(rim).max(axis=0)
    away = np.hypot(1.4 - x, y)
    assert_said("A_1_polyballs", f"above and below {x:.2f}, at height {y:.2f}, and so {away:.2f} away")


def test_lengths_in_molecules():
    assert 2 * 1.160 < 2 * 1.52
    assert_said("A_3_theorem_4", f"nuclei are {2 * 1.160:.2f} Å apart", f"part at ${1.3914 / 1.70 / 2:.2f}$")


def test_polygons_that_only_the_exact_skeleton_has():
    more = []
    for n in (150, 300):
        X = psl.implicit.solid(psl.implicit.torus(), n=n)
        more.append(len(psl.delaunay_balls(X).skeleton().polygons) - len(psl.sk2(X).polygons))
    assert more == [319, 636]
    assert_said("A_4_back_to_sk2", "- [x] no: there are more such polygons with 300 samples")


def test_a_ball_too_large_for_its_room():
    plan = [[(0, 0), (100, 0), (100, 10), (60, 10), (60, 60), (40, 60), (40, 10), (0, 10)]]
    with pytest.warns(psl.CoarseSamplingWarning, match="is 32.02 times as large"):
        psl.skeleton(plan, densify=False)
    assert_said("explore", "a ball is 32 times as large as the room around its centre")


def test_refinement_of_the_horse():
    P = psl.datasets.load("horse", n=40)
    steps = explore.refinement(P).numbers["missing_per_step"]
    done = psl.conform(P, to="gabriel")
    assert_said("03_5_comparison", ", ".join(map(str, steps)), f"40 samples have become {len(done.points)}")


def test_vertices_outside_the_polygon():
    X, words, outside = psl.datasets.load("horse"), {12: "twelve", 2: "two", 0: "none"}, {}
    for n in (50, 96, 200):
        P = psl.conform(X.resample(n, start=0.7), to="delaunay")
        outside[len(P.points)] = words[int((~P.contains(psl.sk0(P).vertices)).sum())]
    (a, x), (b, y), (c, z) = outside.items()
    assert_said("03_four_methods", f"with {a} samples {x} vertices", f"with {b} {y}, with {c} {z}")


def test_side_that_is_not_delaunay():
    X = psl.datasets.load("horse")
    missing = [len(psl.missing_facets(X.resample(200, start=start))) for start in (0.7, 0)]
    assert missing == [1, 0]
    assert_said("03_four_methods", "at n = 200 with shift 0.7 a single side", "no shift all sides are")


def test_neck_that_goes_before_the_legs():
    h = psl.hierarchy(psl.conform(psl.datasets.load("horse").resample(150)))
    in_front = []
    for turns in (2.87, 2.91):
        graph = h.branches(turns * np.pi)
        ends = np.array([data["pos"] for node, data in graph.nodes(data=True) if graph.degree(node) == 1])
        in_front.append(int(((ends > (0.15, 0)).all(axis=1)).sum()))  # above the legs
        assert (ends[:, 1] < -0.2).sum() == 4
    assert in_front == [1, 0]
    assert_said("index", "At $2.9\\pi$ the branch of neck and head has gone, before those of the legs")


def test_size_of_the_lake():
    X = psl.datasets.load("lake")
    for n in (100, 200):
        skeleton = psl.sk0(psl.conform(X.resample(n)))
        count = len(skeleton.tessellation.points)
        assert (len(skeleton.vertices) - count, len(skeleton.edges) - count) == (2, 3)
    assert_said("03_6_complexity", "$n + 2$ vertices and $n + 3$ edges")


def test_hairs_and_arms():
    clean = figures.regular_shape(300)
    noise = np.random.default_rng(2).normal(size=(300, 2)) * 0.004
    h = psl.hierarchy(psl.Shape(clean.points + noise, clean.facets))
    assert branches(h, 0.5, 0.8, 1.0) == [5, 3, 3]
    assert_said("04_simplifying", f"five of the {branches(h, 0)[0]} ends are left")


def test_last_lobe_of_the_leaf():
    h = psl.hierarchy(psl.datasets.load("leaf"))
    assert branches(h, 2.4, 10) == [2, 2]
    assert_said("04_simplifying", "At $2.4\\pi$ the last lobe has gone, and one line with two ends is left")


def test_sheet_and_wire_of_the_vertebra(vertebra):
    surface, wire = vertebra["surface"], vertebra["wireframe"]
    all_, a, b, c = (len(surface.skeleton(t * np.pi).polygons) for t in (-np.inf, 1 / 3, 0.5, 0.6))
    k = branches(wire, 0.5, 1, 2, 3)
    assert_said(
        "04_3_criteria",
        f"holds {a} of its {all_} polygons at $\\pi/3$, {b} at $\\tfrac12\\pi$ and {c} at $0.6\\pi$",
        f"{k[0]} at $\\tfrac12\\pi$, {k[1]} at $\\pi$, {k[2]} at $2\\pi$, {k[3]} at $3\\pi$",
    )


def test_thirteen_branches_are_there_for_a_moment(vertebra):
    wire = vertebra["wireframe"]
    moments = np.unique(
        np.append(wire.level[(wire.level > 2 * np.pi) & (wire.level < 2.2 * np.pi)], 2.2 * np.pi)
    )
    counts = branches(wire, 2.0, *(np.nextafter(moments, np.inf) / np.pi))
    steps = [n for n, before in zip(counts, [None, *counts], strict=False) if n != before]
    assert_said("04_results", f"runs through {', '.join(map(str, steps[:-1]))} and {steps[-1]}")


def test_four_branches_for_long():
    h = psl.hierarchy(psl.delaunay_shape(psl.conform(psl.datasets.load("fourbranch"))), "wireframe")
    assert set(branches(h, *np.linspace(0.5, 5.7, 14))) == {4}
    assert_said("04_results", "From $\\tfrac12\\pi$ to $5.7\\pi$ there are four")


def test_ends_that_noise_makes():
    explorer, counts = explore.sampling(figures.regular_shape(), n=50), {}
    for noise in (0.1, 0):
        explorer.controls["noise"].value = noise
        counts[noise] = []
        for n in (50, 100, 200):
            explorer.controls["n"].value = n
            counts[noise].append(next(v for k, v in explorer.numbers.items() if "end" in k))
    a, b = counts[0.1], counts[0]
    assert_said(
        "03_2_convergence",
        f"{a[0]} ends, {a[1]} ends, {a[2]} ends",
        f"Without noise there are {b[0]}, {b[1]} and {b[2]}",
    )


def test_removals_of_the_gear():
    h = psl.hierarchy(psl.datasets.load("gear", n=60))
    ring = np.isinf(h.level)
    inner = np.append(np.zeros(len(h.P.inner), dtype=bool), False)
    inner[h.simplices[ring]] = True
    assert (inner[h.P.tessellation.neighbors[h.simplices[ring]]].sum(axis=1) == 2).all()
    assert_said(
        "04_2_homotopy",
        f"After {len(h.order)} removals {ring.sum()} of the {len(h.level)} triangles are left, a ring",
    )


def letter_a(angle: float) -> psl.Shape:
    """The letter A of strips with round ends, its legs opening by an angle in degrees."""
    size, width, half = 120.0, 9.0, np.radians(angle) / 2
    legs = [size * np.array([side * np.sin(half), np.cos(half)]) for side in (-1, 1)]
    wide = size * np.sin(half) + 2 * width
    y, x = np.mgrid[-2 * width : size * np.cos(half) + 2 * width, -wide:wide]
    places, tip = np.stack([x, y], axis=-1), np.zeros(2)
    distance = np.full(x.shape, np.inf)
    for a, b in ((tip, legs[0]), (tip, legs[1]), (0.62 * legs[0], 0.62 * legs[1])):
        share = np.clip(((places - a) @ (b - a)) / ((b - a) @ (b - a)), 0, 1)[..., None]
        distance = np.minimum(distance, np.linalg.norm(places - a - share * (b - a), axis=-1))
    return psl.Shape.from_mask(width - distance, 0.0)


def worth_of_the_tip(angle: float) -> float:
    """p/r of the ball that touches both outer sides of an A and its inner corner, over the half width."""
    alpha, s, c = np.radians(angle), np.sin(np.radians(angle) / 2), np.cos(np.radians(angle) / 2)
    depth = (1 - s) / (s * (1 + s))  # of its centre, below that of the tip
    return (np.pi - alpha + 2 * depth * c) / (1 + depth * s)


@pytest.mark.parametrize(("angle", "ends"), [(21, 3), (44, 3), (57, 2), (69, 2)])
def test_a_steep_letter_a_keeps_its_tip(angle, ends):
    """Exercise ex-capitals (a)."""
    h = psl.hierarchy(psl.conform(letter_a(angle)))
    assert {h.branches(share * np.pi).graph["branches"] for share in (0.9, 0.94, 0.98)} == {ends}
    assert_said("explore", "3 ends if it is steep, 2 if its legs open wide")


@pytest.mark.parametrize("angle", [44, 57, 69])
def test_what_the_tip_of_a_letter_a_is_worth(angle):
    h = psl.hierarchy(psl.conform(letter_a(angle)))
    worth = worth_of_the_tip(angle)
    s, half = np.sin(np.radians(angle) / 2), np.radians(angle) / 2
    assert worth == pytest.approx((1 + s) / 2 * (np.pi - 2 * half) + (1 - s) / s * np.cos(half))  # as printed
    counts = [h.branches(share * worth).graph["branches"] for share in (0.97, 1.03)]
    assert counts == [3, 2]


def test_where_the_two_answers_for_a_part():
    share = {angle: f"${worth_of_the_tip(angle) / np.pi:.2f}\\pi$" for angle in (44, 57)}
    assert_said(
        "explore", f"at $44°$ the branch is worth {share[44]} and stays", f"At $57°$ it is worth {share[57]}"
    )
    assert worth_of_the_tip(44) > np.pi > worth_of_the_tip(45.5)
    assert_said("explore", "part at about $45°$, a little more if the threshold is lower")
    assert worth_of_the_tip(50) > 0.9 * np.pi > worth_of_the_tip(53)
