"""The last paragraphs of section 4.3, and section 5: results."""

from __future__ import annotations

import tomllib
from pathlib import Path
from time import perf_counter

import numpy as np

import polyskel_lite as psl

from .geometry import ends
from .registry import check, drawn, seen, transcript, verdict
from .removal import (
    RULES,
    hollow_ball,
    noisy_flower,
    size_changes,
)


def results(name: str) -> psl.Hierarchy:
    return psl.hierarchy(psl.datasets.load(name), "wireframe")


@check("branches-found")
def ends_of_the_wireframe():
    """Ends at 2π, counted from the edges alone: 4 and 4 as printed; our vertebra is another bone."""
    found = {
        name: ends(results(name).skeleton(2 * np.pi)) for name in ("fourbranch", "chromosome", "vertebra")
    }
    assert all(results(n).branches(2 * np.pi).graph["branches"] == k for n, k in found.items())
    same = found["fourbranch"] == found["chromosome"] == 4
    return seen(same and found["vertebra"] > 10 and results("vertebra").P.betti() == (1, 1, 0))


@check("fig-10")
def figure_10():
    sizes = [len(psl.datasets.load(name).points) for name in ("fourbranch", "chromosome", "vertebra")]
    assert sizes == [1191, 2290, 2011]
    return drawn("figure_10", panels=15)


@check("time-under-30s")
def time_of_the_three_shapes():
    """From the file to both simplified skeletons, all three shapes together."""
    start = perf_counter()
    for name in ("fourbranch", "chromosome", "vertebra"):
        P = psl.delaunay_shape(psl.datasets.load(name))
        for strategy, threshold in (("surface", np.pi / 3), ("wireframe", 2 * np.pi)):
            psl.hierarchy(P, strategy).skeleton(threshold)
    return seen(perf_counter() - start < 30)


@check("almost-wireframe")
def polygons_left():
    """At 2π under one polygon in a hundred is left of the three shapes; of the hollow ball all."""
    shares = []
    for name in ("fourbranch", "chromosome", "vertebra"):
        h = results(name)
        shares.append(len(h.skeleton(2 * np.pi).polygons) / len(psl.sk0(h.P).polygons))
    ball = psl.hierarchy(hollow_ball(), "wireframe")
    closed = len(ball.skeleton(2 * np.pi).polygons) / len(psl.sk0(ball.P).polygons)
    assert closed == 1
    return verdict(stands=max(*shares, closed) < 0.01, repaired=max(shares) < 0.01)


@check("parametrized-by-an-angle")
def one_angle():
    """p/r² of a hat seen from its vertex is a solid angle: a fine mesh of a sphere sums up to 4π."""
    t = psl.delaunay(_sphere(400))
    P = psl.DelaunayShape(t, np.ones(len(t.simplices), dtype=bool))
    corners = t.points[P.boundary()]
    area = (
        np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum()
        / 2
    )
    angle = abs(area - 4 * np.pi) < 0.02 * 4 * np.pi
    return verdict(angle and not any(size_changes(s, 2.0**10) for s in RULES))


def _sphere(n: int) -> np.ndarray:
    k = np.arange(n) + 0.5
    z, a = 1 - 2 * k / n, np.pi * (1 + 5**0.5) * k
    r = np.sqrt(1 - z * z)
    return np.column_stack([r * np.cos(a), r * np.sin(a), z])


@check("transcript-section-4")
def where_the_review_is():
    """The four methods are reviewed where their definitions are: in section 3."""
    path = Path(__file__).resolve().parents[2] / "notebooks" / "claims.toml"
    claims = tomllib.loads(path.read_text(encoding="utf-8"))["claim"]
    sections = {
        c["section"][0] for c in claims if c["id"] in ("def-sk0", "def-sk1", "def-sk2", "def-sk3", "def-yw")
    }
    return transcript(stands=sections == {"4"}, other=sections == {"3"})


@check("transcript-angel")
def what_a_threshold_is():
    h = psl.hierarchy(noisy_flower(0.005))
    try:
        h.kept("angel")
        printed = True
    except (TypeError, psl.InputError):
        printed = False
    return transcript(printed, other=bool(h.kept(np.pi).sum() < h.kept(0.0).sum()))
