"""A share of the cases at every commit, the handed files, any JSON, any array; and the harness can fail."""

import json
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays, scalar_dtypes

import polyskel_lite as psl
from fuzz import FAMILIES, files, running

# Different ones than `make fuzz` begins with; the slow family has fewer.
SEED, COUNTS = 20, {"arrays": 1500, "files": 1000, "shapes": 100, "solids": 60, "plane": 150, "space": 100}


@pytest.mark.parametrize("family", FAMILIES)
def test_nothing_is_raw_late_or_wrong(family):
    tally = running.run_family(family, COUNTS[family], SEED)
    assert not tally.bad, "\n".join(f"{family} {k} {what}: {words}" for k, what, words in tally.bad)
    assert tally.counts["answered"] + tally.counts["refused"] == COUNTS[family]
    if family in ("arrays", "files", "shapes"):  # of the others few are refused
        assert tally.counts["refused"] > COUNTS[family] // 20
    assert tally.counts["answered"] > COUNTS[family] // 20


def test_the_same_seed_makes_the_same_cases(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    for family in FAMILIES:
        assert running.outcome(family, SEED, 3) == running.outcome(family, SEED, 3)


TRIANGLE = psl.sk0(psl.Shape.from_rings([[(0, 0), (3, 0), (0, 4)]]))


def hang(*_):
    while True:
        pass


@pytest.mark.parametrize(
    ("broken", "what"), [(lambda *_: 1 / 0, "raw"), (lambda *_: TRIANGLE, "wrong"), (hang, "late")]
)
def test_a_fault_is_seen(monkeypatch, broken, what):
    """A raw error, a wrong number of holes, and an endless loop."""
    good = (k for k in range(100) if running.outcome("shapes", SEED, k)[0] == "answered")
    number = next(k for k in good if "of 2 rings" in running.outcome("shapes", SEED, k)[1])
    monkeypatch.setattr(psl, "sk0", broken)
    monkeypatch.setattr(running, "LATE", 1)
    with running.alarm():
        assert running.outcome("shapes", SEED, number)[0] == what


@pytest.mark.parametrize(("name", "what"), [("sk1", "Sk1"), ("sk2", "Sk2"), ("sk3", "Sk3 has")])
def test_a_wrong_skeleton_of_a_solid_is_seen(monkeypatch, name, what):
    """One element of the other side, or none: every third solid or so tells."""
    right = getattr(psl, name)
    sides = {"inner": "outer", "outer": "inner"}
    broken = psl.sk2 if name == "sk3" else lambda shape, t, side: right(shape, t, sides[side])
    monkeypatch.setattr(psl, name, broken)
    seen = [running.outcome("solids", SEED, k) for k in range(6)]
    assert any(kind == "wrong" and what in words for kind, words in seen)


@pytest.mark.parametrize("name", sorted(path.name for path in files.CORPUS.glob("*/*.*")))
def test_handed_files_are_read_or_refused_in_words(tmp_path, name):
    (tmp_path / name).write_bytes(files.originals()[name])
    try:
        shape = psl.Shape.from_file(tmp_path / name)
    except psl.PolyskelError as error:
        words = str(error)
    else:
        words = f"{name}: {shape.measure()}"
    assert words.startswith(f"{name}: ")


def test_the_area_of_the_truth():
    assert files.area_of([[(0, 0), (2, 0), (2, 2), (0, 2)], [(1, 1), (1, 0.5), (0.5, 1)]]) == Fraction(31, 4)


numbers = st.one_of(st.integers(), st.floats(), st.none(), st.booleans(), st.text(max_size=3))
values = st.recursive(numbers, lambda below: st.lists(below, max_size=5), max_leaves=12)
geometries = st.recursive(
    st.fixed_dictionaries({"type": st.sampled_from(["Polygon", "MultiPolygon", "Point", [], None])})
    | st.builds(
        lambda c, kind: {"type": kind, "coordinates": c}, values, st.sampled_from(["Polygon", "MultiPolygon"])
    ),
    lambda below: st.builds(
        lambda parts: {"type": "GeometryCollection", "geometries": parts}, st.lists(below, max_size=3)
    ),
    max_leaves=4,
)


@settings(max_examples=150)
@given(geometries | values)
def test_any_json_is_answered_or_refused(tmp_path_factory, content):
    path = tmp_path_factory.getbasetemp() / "any.geojson"
    path.write_text(json.dumps(content), encoding="utf-8")
    try:
        shape = psl.Shape.from_file(path)
    except psl.PolyskelError:
        return
    assert shape.area() > 0


@settings(max_examples=150)
@given(arrays(scalar_dtypes(), array_shapes(min_dims=0, max_side=6)))
def test_any_array_is_taken_as_it_is_or_refused(array):
    try:
        taken = psl.Polyball(array, np.ones(len(array) if array.ndim else 1)).centers
    except psl.PolyskelError:
        return
    assert array.dtype.kind in "biuf"
    assert (taken == array).all()


def test_masked_complex_and_large_integers_are_refused():
    points = [(0, 0), (2, 0), (2, 2), (0, 2)]
    for bad, words in (
        (np.ma.array(points, mask=np.eye(4)[:, :2]), "is masked"),
        ([np.ma.array(row, mask=[0, 1]) for row in points], "is masked"),
        (np.array(points) + 1j, "holds complex numbers"),
        (np.array(points) + 2**53, r"\[1, 0\] is .*an integer above 2\*\*53"),
        ([(0.5, 0), (2**53 + 1, 1), (0, 1)], r"\[1, 0\] is .*an integer above 2\*\*53"),
        ([("0", "1"), ("2", "3"), ("4", "7")], "not an array of numbers"),
        ([(0, 0), (10**400, 0), (0, 1)], r"\[1, 0\] is .*an integer above 2\*\*53"),
    ):
        for taker in (psl.delaunay, psl.voronoi, lambda p: psl.Shape.from_rings([p]), psl.reconstruct_curve):
            with pytest.raises(psl.InputError, match=words):
                taker(bad)


@pytest.mark.parametrize("kind", [np.int8, np.uint16, np.int64, np.float32, object, Fraction])
def test_other_numbers_are_taken(kind):
    points = [(0, 0), (2, 0), (2, 2), (0, 2)]
    points = [[Fraction(x) for x in p] for p in points] if kind is Fraction else np.array(points, dtype=kind)
    assert psl.Shape.from_rings([points]).area() == 4
    assert psl.delaunay([(2**53, 0), (0, 1), (1, 0)]).points[0, 0] == 2**53
    assert psl.Shape.from_mask(np.ones((3, 3), dtype=bool)).betti() == (1, 0)
