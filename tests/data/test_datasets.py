"""The shipped outlines: all there, of the right topology, with their licences."""

from importlib.resources import files

import numpy as np
import pytest

from polyskel_lite import InputError, Shape, datasets, missing_facets

# name: (samples stored, components, holes), as listed with the sources of the shapes
STORED = {
    "elephant": (600, 1, 0),
    "gear": (500, 1, 1),
    "hawaii": (600, 8, 0),
    "horse": (400, 1, 0),
    "kangaroo": (600, 1, 0),
    "lake": (1000, 1, 2),
    "leaf": (1308, 1, 0),
}
# name: (samples, triangles, Betti numbers of the solid)
SOLIDS = {
    "chromosome": (2290, 4576, (1, 0, 0)),
    "fourbranch": (1191, 2378, (1, 0, 0)),
    "metacarpal": (1500, 2996, (1, 0, 0)),
    "vertebra": (2011, 4022, (1, 1, 0)),
}


def test_names_are_the_stored_files():
    stored = {entry.name for entry in files(datasets).iterdir() if entry.name.endswith(".npz")}
    assert datasets.names() == datasets.names(2) == sorted(STORED)
    assert datasets.names(3) == sorted(SOLIDS)
    assert datasets.names(None) == sorted([*STORED, *SOLIDS])
    assert stored == {f"{name}.npz" for name in datasets.names(None)}
    with pytest.raises(InputError, match="dimension is 4; choose 2"):
        datasets.names(4)


@pytest.mark.parametrize("name", SOLIDS)
def test_solids_are_in_their_delaunay_tessellation(name):
    samples, triangles, betti = SOLIDS[name]
    shape = datasets.load(name)
    assert (shape.points.shape, shape.facets.shape) == ((samples, 3), (triangles, 3))
    assert shape.betti() == betti
    assert len(missing_facets(shape)) == 0
    assert np.linalg.norm(np.ptp(shape.points, axis=0)) == pytest.approx(1, abs=0.01)
    text = datasets.info(name)
    assert f"({samples} samples, {triangles} triangles)" in text
    assert "CC0" in text or "Apache-2.0" in text


def test_solids_are_not_resampled():
    assert len(datasets.load("fourbranch", n=1191).points) == 1191
    with pytest.raises(InputError, match="stored with 1191 samples and not made anew with 500"):
        datasets.load("fourbranch", n=500)


@pytest.mark.parametrize("name", STORED)
def test_stored_samples_and_topology(name):
    n, components, holes = STORED[name]
    shape = datasets.load(name)
    assert isinstance(shape, Shape)
    assert len(shape.points) == n
    assert shape.betti() == (components, holes)


@pytest.mark.parametrize("name", STORED)
def test_size_and_place(name):
    points = datasets.load(name).points
    assert np.hypot(*np.ptp(points, axis=0)) == pytest.approx(1, abs=0.01)
    assert np.abs(points).max() < 0.51


@pytest.mark.parametrize("name", STORED)
def test_samples_are_uniform(name):
    shape = datasets.load(name)
    step = np.hypot(*np.diff(shape.segments, axis=1)[:, 0].T)
    assert step.max() < 1.25 * np.median(step)


@pytest.mark.parametrize("name", STORED)
def test_resampling_keeps_count_topology_and_outline(name):
    stored, fine = datasets.load(name), datasets.load(name, n=900)
    assert len(fine.points) == 900
    assert fine.betti() == stored.betti()
    assert fine.area() == pytest.approx(stored.area(), rel=5e-3)
    assert stored.boundary_distance(fine.points).max() < 5e-3


def test_many_samples_follow_the_fine_outline():
    """Resampling the 400 stored samples instead would cut corners by 4e-4."""
    with (files(datasets) / "horse.npz").open("rb") as stream:
        fine = np.load(stream)["fine_xy"].astype(float)
    assert len(fine) > len(datasets.load("horse").points)
    assert datasets.load("horse", n=6000).boundary_distance(fine).max() < 1.5e-4
    assert datasets.load("horse").boundary_distance(fine).max() > 3e-4


@pytest.mark.parametrize("name", STORED)
def test_info_has_the_licence_line(name):
    text = datasets.info(name)
    assert text.startswith(f"{name}: ")
    assert f"{STORED[name][0]} samples" in text
    assert "\nsource: " in text
    assert "\nlicence: " in text
    assert ("CC0" in text) or ("public domain" in text)


def test_horse_stands_on_its_feet():
    """Up is up: the feet touch the bottom in several places, the head is one place at the top."""
    low, high = np.sort(datasets.load("horse").points[:, 1])[[0, -1]]
    x, y = datasets.load("horse").points.T
    feet, head = x[y < low + 0.02], x[y > high - 0.02]
    assert np.ptp(feet) > 0.3 > 0.1 > np.ptp(head)


@pytest.mark.parametrize("ask", [datasets.load, datasets.info])
def test_unknown_name(ask):
    with pytest.raises(
        InputError, match=r"'hrose'; did you mean 'horse'\? .* elephant, gear, hawaii"
    ) as error:
        ask("hrose")
    assert all(name in str(error.value) for name in STORED)


def test_too_few_samples():
    with pytest.raises(InputError, match="8 rings"):
        datasets.load("hawaii", n=20)
