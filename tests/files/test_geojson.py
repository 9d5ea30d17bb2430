"""GeoJSON: what becomes a shape, and a sentence for each kind of bad file."""

import json
import sys

import pytest

from polyskel_lite import InputError, LeftOutWarning, PolyskelError, Shape, ShapeError

SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]]
HOLE = [[1, 1], [1, 2], [2, 2], [2, 1], [1, 1]]
FAR = [[[6, 0], [8, 0], [8, 2], [6, 0]]]
FRAME = {"type": "Polygon", "coordinates": [SQUARE, HOLE]}


def read_text(folder, name, text):
    path = folder / name
    path.write_text(text if isinstance(text, str) else json.dumps(text), encoding="utf-8")
    return Shape.from_file(path)


@pytest.mark.parametrize(
    ("content", "betti", "area"),
    [
        (FRAME, (1, 1), 15),
        ({"type": "MultiPolygon", "coordinates": [FRAME["coordinates"], FAR]}, (2, 1), 17),
        ({"type": "Feature", "properties": {}, "geometry": FRAME}, (1, 1), 15),
        (
            {
                "type": "FeatureCollection",
                "features": [
                    {"type": "Feature", "geometry": FRAME},
                    {"type": "Feature", "geometry": None},
                    {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": FAR}},
                ],
            },
            (2, 1),
            17,
        ),
        (
            {
                "type": "GeometryCollection",
                "geometries": [{"type": "GeometryCollection", "geometries": [FRAME]}],
            },
            (1, 1),
            15,
        ),
        ({"type": "Polygon", "coordinates": [[[*p, 7.5] for p in SQUARE]]}, (1, 0), 16),  # with heights
        ({"type": "Polygon", "coordinates": [[*SQUARE[:2], *SQUARE[1:]]]}, (1, 0), 16),  # a vertex twice
    ],
)
def test_geojson(tmp_path, content, betti, area):
    for name in ("a.geojson", "A.JSON"):
        shape = read_text(tmp_path, name, content)
        assert shape.betti() == betti
        assert shape.area() == area


def collection(geometry):
    return {"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": geometry}]}


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("{not json", "a.geojson: this is not JSON"),
        ("[" * 100_000, "this is not JSON"),
        ([1, 2], "the file is no GeoJSON object"),
        (
            {"type": "LineString", "coordinates": SQUARE},
            "no Polygon or MultiPolygon in it, only 1 LineString",
        ),
        (
            collection({"type": "Point", "coordinates": [0, 0]}),
            "no Polygon or MultiPolygon in it, only 1 Point",
        ),
        (collection({"type": "Circle", "coordinates": [0, 0]}), "feature 0 is a Circle; only Polygon"),
        (collection(None), "no Polygon or MultiPolygon in it"),
        ({"type": "Polygon"}, "coordinates is not a list"),
        (
            {"type": "Polygon", "coordinates": [SQUARE, HOLE[:-1]]},
            r"ring 1 is open: .*\(1, 1\) and .*\(2, 1\)",
        ),
        ({"type": "Polygon", "coordinates": [[]]}, "ring 0 is not a list of positions"),
        ({"type": "Polygon", "coordinates": SQUARE}, "ring 0 is not a list of positions"),
        (
            {"type": "Polygon", "coordinates": [[[0, 0], ["x", 1], [0, 0]]]},
            "ring 0 is not an array of numbers",
        ),
        ({"type": "Polygon", "coordinates": [[[0, 0], [1, 1], [0, 0]]]}, "2 different positions"),
        (
            {"type": "MultiPolygon", "coordinates": [[HOLE], [[[0, 0]]]]},
            "polygon 1, ring 0 has 0 different",
        ),
        ('{"type": "Polygon", "coordinates": [[[0, 0], [NaN, 1], [1, 1], [0, 0]]]}', "not a finite number"),
    ],
)
def test_bad_geojson(tmp_path, content, message):
    with pytest.raises(InputError, match=message) as error:
        read_text(tmp_path, "a.geojson", content)
    assert str(error.value).startswith("a.geojson: ")


def test_geojson_with_a_byte_order_mark(tmp_path):
    (tmp_path / "a.geojson").write_text(json.dumps(FRAME), encoding="utf-8-sig")
    assert Shape.from_file(tmp_path / "a.geojson").area() == 15


def test_bytes_that_are_no_text(tmp_path):
    (tmp_path / "a.geojson").write_bytes(b"\xff\xfe\xfa")
    with pytest.raises(InputError, match="not JSON"):
        Shape.from_file(tmp_path / "a.geojson")


def test_crossing_outline_keeps_its_error_class_and_names_the_file(tmp_path):
    bow = {"type": "Polygon", "coordinates": [[[0, 0], [1, 1], [1, 0], [0, 1], [0, 0]]]}
    with pytest.raises(ShapeError, match=r"^bow\.json: segment"):
        read_text(tmp_path, "bow.json", bow)


def test_rings_that_cross_are_named_by_feature(tmp_path):
    part = [[x + 3, y + 1] for x, y in SQUARE]
    parts = [
        {"type": "Polygon", "coordinates": [ring]}
        for ring in ([[9, 9], [9, 8], [8, 9], [9, 9]], SQUARE, part)
    ]
    features = [{"type": "Feature", "geometry": geometry} for geometry in parts]
    with pytest.raises(ShapeError, match=r"of feature 1, ring 0 meets segment .* of feature 2, ring 0 near"):
        read_text(tmp_path, "a.json", {"type": "FeatureCollection", "features": features})


@pytest.mark.parametrize("kind", [[], {}, None, 3, "x" * 1000])
def test_a_type_that_is_no_name(tmp_path, kind):
    with pytest.raises(InputError, match=r"the file is (no GeoJSON object|a x{40});"):
        read_text(tmp_path, "a.json", {"type": kind, "coordinates": []})


def features(*geometries):
    return {
        "type": "FeatureCollection",
        "features": [{"type": "Feature", "properties": {}, "geometry": geometry} for geometry in geometries],
    }


def test_points_and_lines_are_left_out_and_counted(tmp_path):
    others = [
        {"type": "Point", "coordinates": [9, 9]},
        {"type": "LineString", "coordinates": [[0, 0], [1, 1]]},
        {"type": "GeometryCollection", "geometries": [{"type": "Point", "coordinates": [1, 1]}]},
    ]
    with pytest.warns(
        LeftOutWarning, match=r"a\.json: left out what has no inside: 1 LineString, 2 Points\."
    ):
        assert read_text(tmp_path, "a.json", features(FRAME, *others)).area() == 15


def square(x, y, size=4):
    ring = [[x, y], [x + size, y], [x + size, y + size], [x, y + size], [x, y]]
    return {"type": "Polygon", "coordinates": [ring]}


def test_a_feature_in_another_one_is_no_hole(tmp_path):
    """Italy with the Vatican: what is in one of two features is in their union."""
    assert read_text(tmp_path, "a.json", features(square(0, 0, 10), square(4, 4, 1))).area() == 100
    inside_its_hole = {"type": "Polygon", "coordinates": [square(1.25, 1.25, 0.5)["coordinates"][0]]}
    assert read_text(tmp_path, "a.json", features(FRAME, inside_its_hole)).betti() == (2, 1)


@pytest.mark.parametrize(
    ("content", "area", "betti"),
    [
        (features(square(0, 0), square(2, 2)), 28, (1, 0)),
        (features(square(0, 0), square(4, 0)), 32, (1, 0)),
        (features(square(0, 0), square(0, 0)), 16, (1, 0)),
        (features(square(0, 0), square(4, 4)), 32, (2, 0)),
        ({"type": "Polygon", "coordinates": [[*SQUARE[:3], [9, 4], [4, 4], *SQUARE[3:]]]}, 16, (1, 0)),
        ({"type": "Polygon", "coordinates": [SQUARE, [[0, 2], [2, 1], [2, 3], [0, 2]]]}, 14, (1, 0)),
        (
            {"type": "Polygon", "coordinates": [SQUARE, [[-1, 1], [2, 1], [2, 3], [-1, 3], [-1, 1]]]},
            12,
            (1, 0),
        ),
    ],
)
def test_usual_data_is_mended(tmp_path, content, area, betti):
    with pytest.raises(PolyskelError, match=r"^a\.json: .* of .*ring \d.* Or pass mend=True"):
        read_text(tmp_path, "a.json", content)
    shape = Shape.from_file(tmp_path / "a.json", mend=True)
    assert shape.betti() == betti
    assert shape.area() == pytest.approx(area, rel=1e-6)


def test_without_shapely_the_message_names_the_extra(tmp_path, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(ShapeError, match=r'mend=True, after pip install "polyskel-lite\[mend\]"'):
        read_text(tmp_path, "a.json", features(square(0, 0), square(2, 2)))
    monkeypatch.setitem(sys.modules, "shapely", None)
    with pytest.raises(InputError, match=r'^a\.json: mending needs shapely; run: pip install "polyskel-lite'):
        Shape.from_file(tmp_path / "a.json", mend=True)
