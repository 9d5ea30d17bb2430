"""Shapes from and to other libraries, open files, maps and drawings: nothing is lost on the way."""

import io
import json
import zipfile

import numpy as np
import pytest
import shapely

import polyskel_lite as psl

SQUARE = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=float)
#: A frame with an island in its hole, the island with a hole, and a square far away.
NESTED = [9 * SQUARE, 7 * SQUARE + 1, 5 * SQUARE + 2, 1 / 3 * SQUARE + 3, SQUARE + np.array((20.1, 0.7))]
CORNER = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def corners(shape):
    return sorted(map(tuple, shape.points.tolist()))


@pytest.fixture(scope="module", params=["nested", "lake", "triangle"])
def shape(request):
    rings = {"nested": NESTED, "triangle": [[(0, 0), (0.1, 0.2), (-1e-7, 3e5)]]}
    return (
        psl.datasets.load("lake") if request.param == "lake" else psl.Shape.from_rings(rings[request.param])
    )


def test_shapely_and_back(shape):
    geometry = shape.to_shapely()
    assert geometry.is_valid
    assert geometry.area == pytest.approx(shape.area())
    parts = getattr(geometry, "geoms", [geometry])
    assert (len(parts), sum(len(part.interiors) for part in parts)) == shape.betti()
    assert corners(psl.Shape.from_shapely(geometry)) == corners(shape)
    assert corners(psl.Shape.from_shapely(shape)) == corners(shape)
    assert shapely.geometry.shape(shape).equals(geometry)


@pytest.mark.parametrize("suffix", ["geojson", "json", "wkt", "svg"])
def test_files_are_read_back_digit_by_digit(shape, suffix, tmp_path):
    path = tmp_path / f"shape.{suffix}"
    shape.to_file(path)
    text = path.read_text()
    if suffix == "wkt":
        again = psl.Shape.from_shapely(shapely.from_wkt(text))
    else:
        again = psl.Shape.from_file(path, **({"tolerance": 1e-6} if suffix == "svg" else {}))
    assert corners(again) == corners(shape)
    assert again.betti() == shape.betti()
    if "json" in suffix:
        assert shapely.from_geojson(text).equals(shape.to_shapely())


@pytest.mark.parametrize(
    ("thing", "word"),
    [
        (shapely.Point(1, 2), "Point"),
        (shapely.LineString([(0, 0), (1, 1)]), "LineString"),
        (shapely.Polygon(), "no Polygon"),
        (3, "no GeoJSON"),
        (object(), "no GeoJSON"),
    ],
)
def test_what_has_no_inside_is_refused(thing, word):
    with pytest.raises(psl.PolyskelError, match=word):
        psl.Shape.from_shapely(thing)


def test_trimesh_and_back():
    trimesh = pytest.importorskip("trimesh")
    solid = psl.Shape([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 6)], CORNER)
    mesh = solid.to_trimesh()
    assert mesh.volume == pytest.approx(1)
    again = psl.Shape.from_trimesh(mesh)
    assert (again.points == solid.points).all()
    assert (again.facets == solid.facets).all()
    mesh.invert()
    assert psl.Shape.from_trimesh(mesh, turn=True).volume() == pytest.approx(1)
    with pytest.raises(psl.InputError, match="to_mesh"):
        psl.Shape.from_trimesh(trimesh.Scene())
    with pytest.raises(psl.InputError, match="to_trimesh"):
        solid.to_shapely()
    with pytest.raises(psl.InputError, match="to_shapely"):
        psl.Shape.from_rings([SQUARE]).to_trimesh()


def test_open_files_of_bytes_and_text(tmp_path):
    text = json.dumps(psl.Shape.from_rings(NESTED).__geo_interface__)
    path = tmp_path / "a.geojson"
    path.write_text(text)
    with path.open("rb") as binary, path.open() as words:
        assert psl.Shape.from_file(binary).betti() == psl.Shape.from_file(words).betti() == (3, 2)
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.write(path, "inside/a.geojson")
        with archive.open("inside/a.geojson") as member:
            assert psl.Shape.from_file(member).betti() == (3, 2)
    assert psl.Shape.from_file(io.BytesIO(text.encode()), name="b.json").betti() == (3, 2)
    assert psl.skeleton(io.StringIO(text), threshold=3, name="b.json").skeleton.betti() == (3, 2)


def test_open_files_that_cannot_be_read_say_why(tmp_path):
    with pytest.raises(psl.InputError, match="name="):
        psl.Shape.from_file(io.BytesIO(b"x"))
    with (
        (tmp_path / "a.svg").open("w") as writing,
        pytest.raises(psl.InputError, match=r"a\.svg .*for reading"),
    ):
        psl.Shape.from_file(writing)
    with pytest.raises(psl.InputError, match=r"^c\.geojson: "):
        psl.Shape.from_file(io.BytesIO(b"{"), name="c.geojson")
