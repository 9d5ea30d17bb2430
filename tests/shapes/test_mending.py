"""Boundaries that are none as they are: what `mend` makes of them, what it says, and what it leaves alone."""

import sys

import numpy as np
import pytest
from truth.meshes import CUBE_FACES, cube, inward, moved, together

from polyskel_lite import InputError, PolyskelError, Shape, ShapeError, mend

SQUARE = np.array([(0, 0), (4, 0), (4, 4), (0, 4)], dtype=float)
STAR = np.array([(np.cos(a), np.sin(a)) for a in 0.8 * np.pi * np.arange(5)])
# Rings, the area of what they enclose, its Betti numbers.
RINGS = {
    "fine": ([SQUARE, SQUARE / 4 + 1], 15, (1, 1)),
    "overlap": ([SQUARE, SQUARE + 2], 28, (1, 0)),
    "overlap, one clockwise": ([SQUARE, SQUARE[::-1] + 2], 28, (1, 0)),
    "shared edge": ([SQUARE, SQUARE + np.array((4, 0))], 32, (1, 0)),
    "shared part of an edge": ([SQUARE, SQUARE / 2 + np.array((4, 1))], 20, (1, 0)),
    "twice": ([SQUARE, SQUARE], 16, (1, 0)),
    "touching corners": ([SQUARE, SQUARE + 4], 32, (2, 0)),
    "hole at a side": ([SQUARE, [(0, 2), (2, 1), (2, 3)]], 14, (1, 0)),
    "hole at a slanted side": ([[(0, 0), (3, 1), (0, 4)], [(0.9, 0.3), (1, 1), (0.5, 1)]], 6 - 0.175, (1, 0)),
    "hole along a side": ([SQUARE, SQUARE / 4], 15, (1, 0)),
    "holes that touch": ([SQUARE, SQUARE / 4 + 1, SQUARE / 4 + 2], 14, (1, 1)),
    "holes that overlap": ([SQUARE, SQUARE / 4 + 1, SQUARE / 4 + 1.5], 16 - 1.75, (1, 1)),
    "island in a hole": ([SQUARE, SQUARE / 2 + 1, SQUARE / 4 + 1.5], 13, (2, 1)),
    "spike": ([[(0, 0), (4, 0), (4, 2), (9, 2), (4, 2), (4, 4), (0, 4)]], 16, (1, 0)),
    "repeated vertices": ([np.repeat(SQUARE, 2, axis=0)], 16, (1, 0)),
    "pinch": ([[(0, 0), (5, 0), (5, 5), (10, 5), (10, 10), (5, 10), (5, 5), (0, 5)]], 50, (2, 0)),
    "bow tie": ([[(0, 0), (2, 2), (2, 0), (0, 2)]], 2, (2, 0)),
    "star": ([STAR], 1.12256994, (1, 0)),
    "there and back": ([SQUARE, [(9, 9), (10, 10), (11, 11)]], 16, (1, 0)),
}


@pytest.mark.parametrize("scale", [1e-6, 1, 1e5])
@pytest.mark.parametrize("name", RINGS)
def test_rings(name, scale):
    rings, area, betti = RINGS[name]
    rings = [np.asarray(ring) * scale for ring in rings]
    shape, report = mend(rings)
    assert shape.betti() == betti
    assert shape.area() == pytest.approx(area * scale**2, rel=1e-6)
    assert report["rings"] == len(rings)
    assert report["outlines"] == len(shape.rings())
    assert ("pinches opened" in report) == (name in NAMES_OF_PINCHES)
    given = {tuple(p) for ring in rings for p in ring.tolist()}
    if "overlap" in name or "edge" in name:
        assert sum(tuple(p) in given for p in shape.points.tolist()) >= 4  # not moved by a bit
    assert Shape.from_rings(rings, mend=True).area() == shape.area()
    if scale == 1 and name not in ("fine", "island in a hole"):
        with pytest.raises(PolyskelError, match=r"Or pass mend=True, see polyskel_lite\.mend\."):
            Shape.from_rings(rings)


NAMES_OF_PINCHES = {
    "touching corners",
    "hole at a side",
    "hole at a slanted side",
    "holes that touch",
    "pinch",
    "bow tie",
}


def test_good_rings_stay_as_they_are():
    ring = np.random.default_rng(3).normal(size=(9, 2))
    ring = ring[np.argsort(np.arctan2(*(ring - ring.mean(axis=0)).T))]
    shape, report = mend([ring])
    assert {tuple(p) for p in shape.points} == {tuple(p) for p in ring}
    assert report == {"rings": 1, "outlines": 1}


def test_vertices_within_the_tolerance_are_one():
    """A ring in metres of a map, whose first and last vertex are 4e-8 apart."""
    ring = np.array([(0.0679737709, 0.374763639), (20.06, 0.37), (20.06, 20.3), (0.06, 20.3)])
    ring = np.array([*ring, (0.0679737704, 0.374763602)]) + np.array((536520, 5438764))
    shape, report = mend([ring])
    assert (len(shape.points), report["vertices merged"]) == (4, 1)
    assert len(mend([ring], tolerance=1e-9)[0].points) == 5
    sliver = [(64440, 218000), (64438, 218000), (64438, 218000.00000000032), (64440, 218000.00000000032)]
    with pytest.raises(InputError, match="nothing that is left is wider than 1e-06; lower tolerance"):
        mend([sliver])


def test_gaps_narrower_than_the_tolerance_are_closed():
    squares = [SQUARE, SQUARE + np.array((4.0000001, 0.5))]
    assert mend(squares)[0].betti() == (1, 0)
    assert mend(squares, tolerance=1e-8)[0].betti() == (2, 0)


def test_largest_least_and_width():
    parts = [SQUARE, SQUARE / 4 + 9, SQUARE / 40 + 20]
    assert mend(parts, largest=True)[0].area() == 16
    shape, report = mend(parts, least=0.5)
    assert (shape.betti(), report["parts left out"]) == ((2, 0), 1)
    corners = [SQUARE, SQUARE + 4]
    for width in (0.1, 0.5):
        gap = mend(corners, width=width)[0]
        assert gap.boundary_distance([(4, 4)])[0] == pytest.approx(width / 2, rel=0.1)
    with pytest.raises(PolyskelError, match=r"ring [01]\D.*keep one of them\. That is after mending\.$"):
        mend(corners, width=0)
    for wrong in ({"tolerance": 0}, {"width": -1}, {"least": "x"}, {"largest": 2}):
        with pytest.raises(InputError, match=f"{next(iter(wrong))} is "):
            mend(corners, **wrong)


CORNER = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
FACES = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
TURNED = np.array([(0, 1, 2), (0, 1, 3), (0, 3, 2), (1, 2, 3)])


def soup(V, F):
    """Every triangle with corners of its own."""
    return np.asarray(V, dtype=float)[F].reshape(-1, 3), np.arange(3 * len(F)).reshape(-1, 3)


def rounded():
    V, F = soup(CORNER, FACES)
    V[1] += (1e-6, 0, 0)
    return V, F


def open_box():
    V, F = cube()
    return V, F[2:]


MESHES = {
    "one face turned": ((CORNER, TURNED), 1 / 6, (1, 0, 0), {"faces turned": 1}),
    "inside out": (inward(cube()), 1, (1, 0, 0), {"faces turned": 12}),
    "soup": (soup(*cube()), 1, (1, 0, 0), {"vertices welded": 28}),
    "rounded": (rounded(), 1 / 6, (1, 0, 0), {"vertices welded": 8}),
    "a hole": (open_box(), 1, (1, 0, 0), {"holes closed": 1}),
    "a face twice": ((CORNER, np.concatenate([FACES, FACES[:1]])), 1 / 6, (1, 0, 0), {"faces left out": 1}),
    "crossing": (together(cube(), cube(1, 0.5)), 2 - 1 / 8, (1, 0, 0), {"surfaces united": 2}),
    "common side": (together(cube(), moved(1, 0, 0)), 2, (1, 0, 0), {"surfaces united": 2}),
    "cavity": (together(cube(9), cube(2, 1)), 729 - 8, (1, 0, 1), {"faces turned": 12}),
    "crossing, with a cavity": (
        together(cube(9), inward(cube(2, 1)), cube(9, 6)),
        2 * 729 - 8 - 27,
        (1, 0, 1),
        {"surfaces united": 2},
    ),
}


@pytest.mark.parametrize("name", MESHES)
def test_meshes(name):
    (V, F), volume, betti, did = MESHES[name]
    with pytest.raises(PolyskelError, match=r"Or pass mend=True, see polyskel_lite\.mend"):
        Shape.from_mesh(V, F)
    shape, report = mend((V, F))
    assert shape.betti() == betti
    assert shape.volume() == pytest.approx(volume, rel=1e-5)
    assert did.items() <= report.items()
    assert Shape.from_mesh(V, F, mend=True).volume() == pytest.approx(volume, rel=1e-5)


def test_a_good_mesh_stays_as_it_is():
    V, F = cube()
    shape, report = mend((V, F))
    assert (shape.points == V).all()
    assert (shape.facets == F).all()
    assert report == {}


def test_largest_surface_and_least_volume():
    both = together(cube(2), moved(9, 9, 9))
    for options in ({"largest": True}, {"least": 2}):
        shape, report = mend(both, **options)
        assert (shape.volume(), report["surfaces left out"]) == (8, 1)
    with pytest.raises(InputError, match="no surface encloses 99"):
        mend(both, least=99)


def test_what_is_too_open_is_refused():
    with pytest.raises(PolyskelError):
        mend((CORNER, FACES[:1]))


def test_mend_of_files(tmp_path):
    (tmp_path / "a.svg").write_text('<svg><path d="M0 0H5V5H10V10H5V5H0Z"/></svg>')
    with pytest.raises(PolyskelError, match=r"a\.svg: .* of <path> .* \(5, -5\); .* mend=True"):
        Shape.from_file(tmp_path / "a.svg")
    shape, report = mend(tmp_path / "a.svg")
    assert (shape.betti(), report["pinches opened"]) == ((2, 0), 1)
    shape = Shape(*cube())
    np.savez(tmp_path / "a.npz", points=shape.points, facets=np.concatenate([CUBE_FACES, CUBE_FACES[:1]]))
    assert Shape.from_file(tmp_path / "a.npz", mend=True).volume() == 1


@pytest.mark.parametrize(
    ("package", "thing"), [("shapely", [SQUARE, SQUARE + 2]), ("pymeshfix", (CORNER, TURNED))]
)
def test_missing_extra(monkeypatch, package, thing):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(
        InputError, match=rf'mending needs {package}; run: pip install "polyskel-lite\[mend\]"'
    ):
        mend(thing)


def test_without_the_extra_the_refusal_names_it(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(ShapeError, match=r'Or pass mend=True, after pip install "polyskel-lite\[mend\]"\.'):
        Shape.from_mesh(CORNER, TURNED)
