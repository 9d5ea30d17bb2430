"""Readers: every kind of file, every kind of bad file."""

import json
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from PIL import Image
from scipy.ndimage import label

from polyskel_lite import InputError, PolyskelError, Shape, ShapeError, datasets
from polyskel_lite.files.svg import svg_rings

SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]]
HOLE = [[1, 1], [1, 2], [2, 2], [2, 1], [1, 1]]
FAR = [[[6, 0], [8, 0], [8, 2], [6, 0]]]
FRAME = {"type": "Polygon", "coordinates": [SQUARE, HOLE]}
SVG = '<svg xmlns="http://www.w3.org/2000/svg">{}</svg>'


def read_text(folder, name, text):
    path = folder / name
    path.write_text(text if isinstance(text, str) else json.dumps(text), encoding="utf-8")
    return Shape.from_file(path)


def read_svg(folder, body, **options):
    path = folder / "drawing.svg"
    path.write_text(SVG.format(body), encoding="utf-8")
    return Shape.from_file(path, **options)


def read_picture(folder, pixels, **options):
    path = folder / "picture.png"
    Image.fromarray(np.asarray(pixels)).save(path)
    return Shape.from_file(path, **options)


# --- from_mask


def test_mask_is_placed_in_pixels_and_up_is_up():
    shape = Shape.from_mask([[0, 1, 1], [0, 0, 0], [0, 0, 0], [0, 0, 0]])
    assert shape.contains([(1.5, 3.5), (2.5, 3.5), (0.5, 3.5), (1.5, 0.5)]).tolist() == [1, 1, 0, 0]
    assert shape.points.max(axis=0).tolist() == [3, 4]
    assert shape.points.min(axis=0).tolist() == [1, 3]


def test_full_mask_is_closed_at_the_border():
    shape = Shape.from_mask(np.ones((3, 5), dtype=bool))
    assert shape.betti() == (1, 0)
    assert np.ptp(shape.points, axis=0).tolist() == [5, 3]
    assert shape.area() == 15 - 4 / 8  # the corners are cut at half a pixel


def test_grey_values_place_the_outline_between_pixels():
    ramp = np.tile(np.linspace(1, 0, 11), (40, 1))  # 1 - 0.1 column; falls to 0.25 at column 7.5, x = 8
    assert Shape.from_mask(ramp, level=0.25).points[:, 0].max() == pytest.approx(8)


def test_level_of_values_outside_zero_to_one():
    shape = Shape.from_mask(np.pad(np.full((4, 4), 1000.0), 2, constant_values=-1000), level=0)
    assert shape.area() == 16 - 4 / 8
    assert shape.points.min() == 2


def test_negative_values_and_a_flat_image_at_the_level():
    assert Shape.from_mask(np.full((2, 2), -3.0), level=-3.0).betti() == (1, 0)


def test_ring_has_a_hole():
    row, column = np.indices((40, 40)) - 19.5
    far = np.hypot(row, column)
    shape = Shape.from_mask((far < 15) & (far > 8))
    assert shape.betti() == (1, 1)
    assert shape.area() == pytest.approx(np.pi * (15**2 - 8**2), rel=0.01)


def test_smoothing_rounds_the_staircase():
    row, column = np.indices((60, 60)) - 29.5
    disc = np.hypot(row, column) < 20
    rough, smooth = Shape.from_mask(disc), Shape.from_mask(disc, smooth=2)
    off = [np.abs(np.hypot(*(shape.points - 30).T) - 20).max() for shape in (rough, smooth)]
    assert off[1] < 0.5 * off[0]
    assert smooth.area() == pytest.approx(rough.area(), rel=0.02)


def test_smoothing_at_the_border_stays_closed():
    shape = Shape.from_mask(np.ones((20, 30)), smooth=1.5)
    assert shape.betti() == (1, 0)
    assert shape.area() == pytest.approx(600, rel=0.02)


def test_crosswise_pixels_are_apart_in_yes_no_pictures():
    board = np.indices((8, 8)).sum(axis=0) % 2
    assert Shape.from_mask(board).betti() == (32, 0)


@pytest.mark.parametrize(("low", "components"), [(0.2, 1), (0.0, 2)])
def test_crosswise_pixels_follow_the_mean(low, components):
    """Two pixels at 0.9 on a ground of `low`: the mean of the four is 0.55 or 0.45."""
    image = np.full((4, 4), low)
    image[1, 1] = image[2, 2] = 0.9
    assert Shape.from_mask(image).betti() == (components, 0)


@settings(max_examples=60, derandomize=True, deadline=None)
@given(arrays(bool, st.tuples(st.integers(1, 12), st.integers(1, 12))))
def test_any_yes_no_mask_has_its_topology(mask):
    """Components joined by edges of pixels, holes by edges and corners; every pixel on its side."""
    if not mask.any():
        with pytest.raises(InputError, match="no pixel"):
            Shape.from_mask(mask)
        return
    shape = Shape.from_mask(mask)
    components = label(mask)[1]
    ground = label(~np.pad(mask, 1), structure=np.ones((3, 3)))[1]
    assert shape.betti() == (components, ground - 1)
    rows, columns = mask.shape
    x, y = np.meshgrid(np.arange(columns) + 0.5, rows - np.arange(rows) - 0.5)
    inside = shape.contains(np.stack([x.ravel(), y.ravel()], axis=1))
    assert (inside == mask.ravel()).all()


@settings(max_examples=60, derandomize=True, deadline=None)
@given(
    arrays(np.int8, st.tuples(st.integers(2, 10), st.integers(2, 10)), elements=st.integers(-2, 2)),
    st.sampled_from([-1, -0.5, 0, 0.25, 1]),
)
def test_values_at_the_level_never_make_outlines_touch(image, level):
    if image.max() < level:
        return
    shape = Shape.from_mask(image, level=level)  # Shape refuses rings that touch
    rows, columns = image.shape
    x, y = np.meshgrid(np.arange(columns) + 0.5, rows - np.arange(rows) - 0.5)
    inside = shape.contains(np.stack([x.ravel(), y.ravel()], axis=1))
    assert (inside == (image >= level).ravel()).all()


@pytest.mark.parametrize(
    ("image", "options", "message"),
    [
        (np.zeros((3, 3)), {}, "no pixel reaches the level 0.5, the largest is 0"),
        (np.zeros((3, 3, 3)), {}, r"shape \(3, 3, 3\)"),
        (np.zeros((0, 3)), {}, r"shape \(0, 3\)"),
        ([[1, 2], [3]], {}, "not an array of numbers"),
        ([[1.0, np.nan]], {}, r"image\[0, 1\] is nan"),
        ([[1.0]], {"level": np.inf}, "level is inf"),
        ([[1.0]], {"smooth": -1}, "smooth is -1"),
        (np.pad([[1.0]], 5), {"smooth": 3}, "smoothed by 3; smooth less"),
    ],
)
def test_bad_masks(image, options, message):
    with pytest.raises(InputError, match=message):
        Shape.from_mask(image, **options)


def test_shape_has_the_readers(tmp_path):
    Image.fromarray(np.pad(np.zeros((4, 4), np.uint8), 2, constant_values=255)).save(tmp_path / "a.png")
    shape = Shape.from_file(tmp_path / "a.png", invert=False)
    assert (shape.points == Shape.from_mask(np.pad(np.ones((4, 4)), 2)).points).all()


# --- GeoJSON


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
        ({"type": "LineString", "coordinates": SQUARE}, "the file is a LineString; only Polygon"),
        (collection({"type": "Point", "coordinates": [0, 0]}), r"features\[0\].geometry is a Point"),
        (collection(None), "no Polygon or MultiPolygon in it"),
        ({"type": "Polygon"}, "coordinates is not a list"),
        (
            {"type": "Polygon", "coordinates": [SQUARE, HOLE[:-1]]},
            r"coordinates\[1\] is open: .*\(1, 1\) and .*\(2, 1\)",
        ),
        ({"type": "Polygon", "coordinates": [[]]}, r"coordinates\[0\] is not a list of positions"),
        ({"type": "Polygon", "coordinates": SQUARE}, r"coordinates\[0\] is not a list of positions"),
        ({"type": "Polygon", "coordinates": [[[0, 0], ["x", 1], [0, 0]]]}, "not a list of positions"),
        ({"type": "Polygon", "coordinates": [[[0, 0], [1, 1], [0, 0]]]}, "2 different positions"),
        (
            {"type": "MultiPolygon", "coordinates": [[HOLE], [[[0, 0]]]]},
            r"coordinates\[1\]\[0\] has 0 different",
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


# --- SVG


def test_svg_basic_shapes_and_y_up(tmp_path):
    shape = read_svg(tmp_path, '<rect x="1" y="2" width="3" height="4"/>')
    assert shape.area() == 12
    assert shape.points.min(axis=0).tolist() == [1, -6]


def test_svg_transforms_nest(tmp_path):
    body = '<g transform="translate(10,20)"><g transform="scale(2)"><rect width="1" height="3"/></g></g>'
    shape = read_svg(tmp_path, body)
    assert shape.points.min(axis=0).tolist() == [10, -26]
    assert shape.points.max(axis=0).tolist() == [12, -20]


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-5])
@pytest.mark.parametrize(
    "body",
    [
        '<circle cx="7" cy="8" r="2"/>',
        # four cubic Bézier curves would be a circle to 3e-4 of the radius only; arcs are exact
        '<path d="M 9 8 A 2 2 0 0 1 5 8 A 2 2 0 0 1 9 8 Z"/>',
        '<ellipse rx="1" ry="4" transform="translate(7 8) rotate(30) scale(2 .5)"/>',
        '<g transform="scale(.001)"><circle cx="7000" cy="8000" r="2000"/></g>',
        '<g transform="scale(1000)"><circle cx=".007" cy=".008" r=".002"/></g>',
    ],
)
def test_svg_curves_within_tolerance(tmp_path, body, tolerance):
    shape = read_svg(tmp_path, body, tolerance=tolerance)
    diagonal = 2 * 2 * 2**0.5
    middle = shape.segments.mean(axis=1)
    off = np.abs(np.hypot(*(np.concatenate([shape.points, middle]) - (7, -8)).T) - 2).max()
    assert off <= tolerance * diagonal * 1.001
    assert tolerance > 1e-4 or off > 0.05 * tolerance * diagonal  # not many more vertices than needed


def test_svg_beziers_within_tolerance(tmp_path):
    """Areas by integration: 2/3 · 6 · 4 under the parabola, 864 ∫ t²(1-t)² dt under the cubic."""
    quadratic = read_svg(tmp_path, '<path d="M0 0 Q 3 8 6 0 Z"/>', tolerance=1e-5)
    assert quadratic.area() == pytest.approx(16, rel=1e-4)
    cubic = read_svg(tmp_path, '<path d="M0 0 C 0 8 6 8 6 0 Z"/>', tolerance=1e-5)
    assert cubic.area() == pytest.approx(28.8, rel=1e-4)


@pytest.mark.parametrize("matrix", ["0 1 1 0 0 0", "-1 0 0 1 0 0", "2 1 -1 3 5 6", "0 -2 1 0 3 3"])
def test_svg_turned_arcs_under_any_transform(tmp_path, matrix):
    """Area scales with the determinant; a point of the turned ellipse lands where the matrix sends it."""
    arc = '<path d="M 0 0 A 2 1 30 0 1 3 1 A 2 1 30 1 1 0 0 Z"/>'
    plain = read_svg(tmp_path, arc, tolerance=1e-4)
    a, b, c, d, e, f = map(float, matrix.split())
    moved = read_svg(tmp_path, f'<g transform="matrix({matrix})">{arc}</g>', tolerance=1e-4)
    assert moved.area() == pytest.approx(abs(a * d - b * c) * plain.area(), rel=1e-3)
    x, y = plain.points[:, 0], -plain.points[:, 1]
    image = np.stack([a * x + c * y + e, -(b * x + d * y + f)], axis=1)
    assert moved.boundary_distance(image).max() < 1e-3 * np.hypot(*np.ptp(image, axis=0))


def test_svg_holes_by_even_odd_and_relative_subpaths(tmp_path):
    shape = read_svg(
        tmp_path, '<path d="M0 0H9V9H0Z m 3 3h3v3h-3z"/><rect x="4" y="4" width="1" height="1"/>'
    )
    assert shape.betti() == (2, 1)
    assert shape.area() == 81 - 9 + 1


def test_svg_strokes_hidden_parts_and_definitions_are_left_out(tmp_path):
    body = (
        '<defs><rect width="50" height="50"/></defs><g style="display:none"><rect width="70" height="1"/></g>'
        '<line x2="5" y2="5"/><g fill="none"><path d="M0 0L5 5"/></g><path style="fill: none" d="M0 0L9 9"/>'
        '<rect fill="none" width="2" height="2"/><text>words</text>'
    )
    assert read_svg(tmp_path, body).area() == 4


def test_svg_vertices_that_repeat_are_dropped(tmp_path):
    shape = read_svg(tmp_path, '<path d="M0 0 L2 0 L2 0 L2 2 L0 2 L0 0 Z"/>')
    assert len(shape.points) == 4


def test_svg_without_namespace(tmp_path):
    (tmp_path / "a.svg").write_text('<svg><rect width="2" height="2"/></svg>')
    assert Shape.from_file(tmp_path / "a.svg").area() == 4


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("", "no closed path"),
        ('<text>words</text><line x2="5" y2="5"/>', "no closed path"),
        (
            '<path id="coast" d="M0 0L5 0L5 5"/>',
            r"<path> with id 'coast' is open: .*\(0, 0\) .*\(5, 5\); close it",
        ),
        ('<path d="M0 0 H4 V4 Z M8 8 h1 v1"/>', r"<path> is open: it begins at \(8, 8\)"),
        ('<rect width="10mm" height="3"/>', "<rect> cannot be read"),
        ('<rect width="1" height="3" transform="turn(3)"/>', "<rect> cannot be read"),
        ('<path d="M0 0 L1 0 Z"/>', "no path in it encloses an area"),
        ('<path d="M1 1 Q1 1 1 1 Z"/>', "all its paths are one point"),
        ('<circle r="0"/>', "cannot be read|one point|no closed path"),
        ("<g>", "not XML"),
    ],
)
def test_bad_svg(tmp_path, body, message):
    with pytest.raises(InputError, match=message) as error:
        read_svg(tmp_path, body)
    assert str(error.value).startswith("drawing.svg: ")


@pytest.mark.parametrize("tolerance", [0, -1, 1, np.nan, "fine"])
def test_bad_svg_tolerance(tmp_path, tolerance):
    with pytest.raises(InputError, match="tolerance is"):
        read_svg(tmp_path, '<rect width="1" height="1"/>', tolerance=tolerance)


def test_svg_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "svgpathtools", None)
    with pytest.raises(InputError, match=r"pip install polyskel-lite\[files\]"):
        read_svg(tmp_path, '<rect width="1" height="1"/>')


def test_svg_rings_of_a_dataset_drawn_again(tmp_path):
    shape = datasets.load("gear")
    d = "".join(
        "M" + "L".join(f"{x!r} {-y!r} " for x, y in shape.points[r].tolist()) + "Z" for r in shape.rings()
    )
    (tmp_path / "gear.svg").write_text(SVG.format(f'<path d="{d}"/>'))
    assert (np.concatenate(svg_rings(tmp_path / "gear.svg")) == shape.points).all()


# --- pictures

INK = np.full((6, 8), 255, dtype=np.uint8)
INK[1:3, 1:5] = 0  # a dark bar near the top, 4 by 2 pixels
BAR = 8 - 4 / 8  # its area with cut corners


def test_dark_part_of_an_opaque_picture(tmp_path):
    for pixels in (INK, np.stack([INK] * 3, axis=2), INK > 0, INK.astype(np.uint16) * 257):
        shape = read_picture(tmp_path, pixels)
        assert shape.area() == pytest.approx(BAR, abs=1e-9)
        assert shape.points.min(axis=0).tolist() == [1, 3]


def test_deep_grey_counts_from_its_brightest_value(tmp_path):
    """Sixteen bits, of which a camera used ten."""
    pixels = np.where(INK > 0, 1000, 300).astype(np.uint16)
    assert read_picture(tmp_path, pixels).betti() == (1, 0)


def test_opaque_part_of_a_transparent_picture(tmp_path):
    """The bar is white here: opacity decides, whatever the colour."""
    rgba = np.stack([np.full_like(INK, 255)] * 3 + [255 - INK], axis=2)
    assert read_picture(tmp_path, rgba).area() == pytest.approx(BAR)


def test_palette_with_transparency(tmp_path):
    picture = Image.fromarray((INK > 0).astype(np.uint8)).convert("P")
    picture.save(tmp_path / "a.gif", transparency=int(picture.getpixel((0, 0))))
    assert Shape.from_file(tmp_path / "a.gif").area() == pytest.approx(BAR)


def test_invert_takes_the_other_part(tmp_path):
    assert read_picture(tmp_path, 255 - INK, invert=True).area() == pytest.approx(BAR)
    assert read_picture(tmp_path, INK, invert=True).betti() == (1, 1)


def test_level_and_smooth_reach_the_picture(tmp_path):
    grey = np.where(INK == 0, 100, 255).astype(np.uint8)  # darkness 0.61
    with pytest.raises(InputError, match=r"picture\.png: no pixel is dark at level 0\.7"):
        read_picture(tmp_path, grey, level=0.7)
    edge = read_picture(tmp_path, grey, level=0.5).points[:, 0].min()
    assert edge == pytest.approx(0.5 + 0.5 / (155 / 255))
    assert read_picture(tmp_path, INK, smooth=0.7).area() != pytest.approx(BAR, rel=1e-3)


@pytest.mark.parametrize(
    ("pixels", "message"),
    [
        (np.zeros((5, 5), np.uint8), "all pixels are dark at level 0.5, so there is no outline; .* invert"),
        (np.full((5, 5), 255, np.uint8), "no pixel is dark"),
        (np.zeros((5, 5, 4), np.uint8), "no pixel is opaque"),
    ],
)
def test_pictures_without_an_outline(tmp_path, pixels, message):
    with pytest.raises(InputError, match=message):
        read_picture(tmp_path, pixels)


def test_broken_pictures(tmp_path):
    Image.fromarray(np.random.default_rng(0).integers(0, 255, (50, 50), dtype=np.uint8)).save(
        tmp_path / "a.png"
    )
    whole = (tmp_path / "a.png").read_bytes()
    for content in (b"no picture at all", whole[: len(whole) // 2]):
        (tmp_path / "b.png").write_bytes(content)
        with pytest.raises(InputError, match=r"^b\.png: the picture cannot be opened"):
            Shape.from_file(tmp_path / "b.png")


# --- arrays, and what all files share


def test_npz_of_both_kinds(tmp_path):
    shape = datasets.load("lake")
    np.savez(tmp_path / "a.npz", points=shape.points, facets=shape.facets)
    again = Shape.from_file(tmp_path / "a.npz")
    assert (again.points == shape.points).all()
    assert (again.facets == shape.facets).all()
    off = np.cumsum([0, *map(len, shape.rings())])
    np.savez(tmp_path / "b.npz", xy=shape.points, off=off)
    assert Shape.from_file(tmp_path / "b.npz").betti() == (1, 2)


def test_bad_npz(tmp_path):
    np.savez(tmp_path / "a.npz", V=np.zeros((3, 3)))
    with pytest.raises(InputError, match=r"a\.npz: its arrays are V; it needs points and facets"):
        Shape.from_file(tmp_path / "a.npz")
    np.savez(tmp_path / "b.npz", xy=np.zeros((3, 2)), off="words")
    with pytest.raises(InputError, match="not a file of arrays"):
        Shape.from_file(tmp_path / "b.npz")
    (tmp_path / "c.npz").write_text("words")
    with pytest.raises(InputError, match="not a file of arrays"):
        Shape.from_file(tmp_path / "c.npz")
    with (tmp_path / "d.npz").open("wb") as stream:
        np.save(stream, np.zeros(3))
    with pytest.raises(InputError, match="not a file of arrays"):
        Shape.from_file(tmp_path / "d.npz")


@pytest.mark.parametrize("suffix", [".geojson", ".svg", ".png", ".npz"])
def test_missing_empty_and_folder(tmp_path, suffix):
    path = tmp_path / f"a{suffix}"
    with pytest.raises(InputError, match="no such file"):
        Shape.from_file(path)
    path.touch()
    with pytest.raises(InputError, match="the file is empty"):
        Shape.from_file(str(path))
    path.unlink()
    path.mkdir()
    with pytest.raises(PolyskelError, match="no such file"):
        Shape.from_file(path)


@pytest.mark.parametrize("name", ["outline.xyz", "outline"])
def test_unknown_suffix(tmp_path, name):
    with pytest.raises(InputError, match=r"no reader for .*; it reads \.geojson, \.json, \.svg"):
        Shape.from_file(tmp_path / name)
