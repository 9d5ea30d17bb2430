"""The paper's figures: of real data, with caption and alt text, looking as they did when last looked at."""

from __future__ import annotations

import io
import itertools
import re
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import figures
from polyskel_lite.figures import definitions, proof

# The comparison is of layers, not of pixels: small pictures, and a tolerance (root mean square, of 255) under
# what the least layer of a figure makes (`test_tolerance_sees_every_layer`) and far over what last digits
# make, which differ between processors (0.0 for points moved by 1e-12). Another version of matplotlib draws
# fonts and edges otherwise (3.8: 1.5 to 14), so the pictures are compared under the version of the lock only.
TOLERANCE = 1.0
BASELINE_VERSION = "3.11"
SAVED = {"dpi": 40, "facecolor": "white"}
same_matplotlib = pytest.mark.skipif(
    not matplotlib.__version__.startswith(BASELINE_VERSION + "."),
    reason=f"the stored pictures are of matplotlib {BASELINE_VERSION}",
)


def compared(name: str):
    """Compare the returned figure with `baseline/NAME.png` (under ``pytest --mpl``)."""
    compare = pytest.mark.mpl_image_compare(
        baseline_dir="baseline",
        filename=f"{name}.png",
        style="default",
        tolerance=TOLERANCE,
        savefig_kwargs=SAVED,
    )
    return lambda test: same_matplotlib(compare(test))


@pytest.fixture(autouse=True)
def _close_figures():
    yield
    plt.close("all")


@compared("figure_1")
def test_figure_1():
    return figures.figure_1()


@compared("figure_2")
def test_figure_2():
    return figures.figure_2()


@compared("figure_2_3d")
def test_figure_2_3d():
    return figures.figure_2_3d()


@compared("figure_3")
def test_figure_3():
    return figures.figure_3()


@compared("figure_4")
def test_figure_4():
    return figures.figure_4()


@compared("figure_5")
def test_figure_5():
    return figures.figure_5()


@compared("figure_6")
def test_figure_6():
    return figures.figure_6()


@compared("figure_7")
def test_figure_7():
    return figures.figure_7()


@compared("figure_8")
def test_figure_8():
    return figures.figure_8()


@compared("figure_9")
def test_figure_9():
    return figures.figure_9()


@compared("figure_10")
def test_figure_10():
    return figures.figure_10()


@compared("figure_11")
def test_figure_11():
    return figures.figure_11()


@compared("figure_12")
def test_figure_12():
    return figures.figure_12()


@compared("figure_13")
def test_figure_13():
    return figures.figure_13()


# --- the comparison itself -------------------------------------------------------------------------------


def pixels(figure) -> np.ndarray:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", **SAVED)
    buffer.seek(0)
    return plt.imread(buffer)[:, :, :3] * 255.0


def layers(figure) -> list:
    return [a for ax in figure.axes for a in [*ax.collections, *ax.patches, *ax.lines]]


@same_matplotlib
@pytest.mark.parametrize("name", ["figure_2", "figure_2_3d"])
def test_tolerance_sees_every_layer(name):
    """Hiding any one layer of these figures changes more than the tolerance."""
    with plt.style.context("default"):
        figure = figures.FIGURES[name]()
        whole = pixels(figure)
        for layer in layers(figure):
            layer.set_visible(False)
            changed = np.sqrt(((pixels(figure) - whole) ** 2).mean())
            layer.set_visible(True)
            assert changed > TOLERANCE, (type(layer).__name__, changed)


def test_stored_pictures_are_small_and_none_is_left_over():
    stored = {path.stem: path.stat().st_size for path in (Path(__file__).parent / "baseline").glob("*.png")}
    assert sorted(stored) == sorted(figures.FIGURES)
    assert max(stored.values()) < 80_000  # figure 10 has fifteen panels


def test_stored_pictures_belong_to_the_locked_matplotlib():
    """After an upgrade: make the pictures anew, look at them, and change BASELINE_VERSION.

    ``pytest tests/figures/test_pictures.py --mpl-generate-path=tests/figures/baseline`` makes them.
    """
    lock = Path(__file__).parents[2] / "requirements.lock"
    (version,) = re.findall(r"^matplotlib==(\S+)", lock.read_text(encoding="utf-8"), flags=re.MULTILINE)
    assert version.startswith(BASELINE_VERSION + ".")


# --- words -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", figures.FIGURES)
def test_every_figure_has_caption_and_alt_text(name):
    draw = figures.FIGURES[name]
    assert 100 < len(draw.alt) < 600
    assert 100 < len(draw.caption) < 900
    assert draw.caption != draw.alt
    for text in (draw.caption, draw.alt):
        assert "\n" not in text
        assert "  " not in text
        assert text.endswith(".")


@pytest.mark.parametrize("name", figures.FIGURES)
def test_captions_name_the_panels_that_there_are(name):
    draw = figures.FIGURES[name]
    figure = draw()
    drawn = {ax.get_title(loc="left") for ax in figure.axes} | {
        t.get_text() for ax in figure.axes for t in ax.texts
    }
    drawn = {text for text in drawn if re.fullmatch(r"\([a-z]\)", text)}
    named = set(re.findall(r"(?<!\w)\([a-z]\)", draw.caption))  # A(v) is no panel
    if "(b) to (e)" in draw.caption:
        named |= {"(c)", "(d)"}
    assert drawn == named


def test_writing_figures_makes_files_and_captions(tmp_path):
    names = ["figure_2", "figure_13"]
    assert list(figures.write_figures(tmp_path / "new", names, ["svg"])) == names
    assert sorted(p.name for p in (tmp_path / "new").iterdir()) == [
        "captions.txt",
        "figure_13.svg",
        "figure_2.svg",
    ]
    text = (tmp_path / "new" / "captions.txt").read_text(encoding="utf-8")
    assert figures.figure_13.alt in text
    assert "figure_1\n" not in text


def test_the_same_figure_makes_the_same_file(tmp_path):
    for folder in ("once", "twice"):
        list(figures.write_figures(tmp_path / folder, ["figure_2"], ["svg", "pdf"]))
    for suffix in ("svg", "pdf"):
        first, second = (
            (tmp_path / folder / f"figure_2.{suffix}").read_bytes() for folder in ("once", "twice")
        )
        assert first == second


def test_unknown_figure_is_refused(tmp_path):
    with pytest.raises(psl.InputError, match="figure_99"):
        list(figures.write_figures(tmp_path, ["figure_99"]))


# --- what the figures say is true of what they show ------------------------------------------------------


def test_figure_1_shows_maximal_balls_and_one_inside_another():
    """Centres on the skeleton, contacts on the boundary; the other ball touches it inside the largest."""
    horse = psl.datasets.load("horse")
    skeleton = psl.sk0(horse.resample(400))
    chosen = definitions._disjoint(skeleton.vertices, skeleton.radii, 7)
    gap = horse.boundary_distance(skeleton.vertices[chosen]) - skeleton.radii[chosen]
    assert np.abs(gap).max() < 2e-3  # a line's width in the picture
    for i, j in itertools.combinations(chosen, 2):
        distance = np.linalg.norm(skeleton.vertices[i] - skeleton.vertices[j])
        assert distance > skeleton.radii[i] + skeleton.radii[j]
    center, radius, contact = definitions._smaller_ball(skeleton, chosen[0])
    largest = skeleton.vertices[chosen[0]], skeleton.radii[chosen[0]]
    assert np.linalg.norm(center - largest[0]) + radius == pytest.approx(largest[1])
    assert np.linalg.norm(center - contact) == pytest.approx(radius)
    assert horse.boundary_distance([contact])[0] < 2e-3


def test_figure_2_in_space_shows_the_cell_of_the_first_point():
    """The filled polygons close up: each edge of the cell belongs to two of them; no hull face is Gabriel."""
    tessellation = psl.delaunay(definitions.POINTS_3D)
    graph = psl.voronoi(tessellation)
    has_first = (tessellation.simplices[graph.simplices] == 0).any(axis=1)
    cell = [p.tolist() for p in graph.polygons if has_first[p].all()]
    sides = [tuple(sorted(pair)) for p in cell for pair in zip(p, [*p[1:], p[0]], strict=True)]
    assert len(cell) == 6
    assert all(sides.count(side) == 2 for side in sides)
    assert all(0 in facet for facet in psl.gabriel(tessellation).tolist())


def test_figure_3_shows_where_the_methods_differ():
    """So few samples that inner triangles have outer centres, outer ones inner, and Sk2 falls apart."""
    horse = psl.datasets.load("horse")
    polygon = horse.resample(96, 0.7)
    P = psl.delaunay_shape(polygon)
    assert (~horse.contains(psl.sk0(P).vertices)).sum() == 3
    assert (~P.inner[psl.sk1(horse, polygon.points).simplices]).sum() == 9
    assert psl.sk2(horse, polygon.points).betti() == (3, 0)
    assert psl.sk0(P).betti() == (1, 0)


def test_figure_4_compares_samplings_of_one_density():
    kangaroo = psl.datasets.load("kangaroo")
    first, second = kangaroo.sample(90), kangaroo.sample(90, start=0.5)
    assert kangaroo.covering_radius(second) == pytest.approx(kangaroo.covering_radius(first), rel=0.05)
    assert np.linalg.norm(first[:, None] - second[None], axis=2).min() > 0


def test_figure_5_comes_closer_with_more_samples():
    shape = figures.regular_shape()
    exact = psl.sk2(shape)
    distances = [psl.hausdorff(psl.sk2(shape, shape.sample(n)), exact) for n in (10, 50, 200)]
    assert distances == sorted(distances, reverse=True)
    assert distances[-1] < 0.1 * distances[0]


def test_figure_13_shows_a_boundary_edge_that_cannot_be_gabriel():
    tessellation = psl.delaunay(proof.POINTS_A)
    triangle = [set(s) == {0, 1, 2} for s in tessellation.simplices.tolist()].index(True)
    crossed = proof.crossed_edges(tessellation, triangle, 0)
    assert [crossing[:2] for crossing in crossed] == [(1, 2), (2, 3), (3, 4)]
    gabriel = {tuple(edge) for edge in psl.gabriel(tessellation).tolist()}
    delaunay = {tuple(edge) for edge in tessellation.edges().tolist()}
    a = tessellation.points[0]
    for e0, e1, m in crossed:
        p, q = tessellation.points[[e0, e1]]
        assert (e0, e1) in delaunay - gabriel
        assert np.linalg.norm((p + q) / 2 - a) < np.linalg.norm(p - q) / 2
        assert np.linalg.norm(m - a) < min(np.linalg.norm(m - p), np.linalg.norm(m - q))


def test_figure_13_refuses_points_that_do_not_show_it():
    with pytest.raises(psl.InputError, match="circumcentre"):
        figures.figure_13(points_a=[(0, 1), (-0.5, 0), (0.5, 0)])
    with pytest.raises(psl.InputError, match="convex polygon"):
        figures.figure_13(points_b=[(0, 0), (1, 0), (0, 1)])


def test_figure_10_names_its_columns_and_counts_branches():
    pod = psl.implicit.solid(psl.implicit.tetrapod(), n=300)
    figure = figures.figure_10({"tetrapod": pod, "again": psl.delaunay_shape(pod)})
    words = [text.get_text() for ax in figure.axes for text in ax.texts]
    assert len(figure.axes) == 10
    assert f"tetrapod, {len(pod.points)} samples" in words
    assert words.count("4 branches") == 2
