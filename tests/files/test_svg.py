"""SVG: shapes, transforms, curves within their tolerance, and a sentence for each kind of bad file."""

import sys

import numpy as np
import pytest

from polyskel_lite import InputError, Shape, ShapeError, datasets
from polyskel_lite.files.svg import svg_rings

SVG = '<svg xmlns="http://www.w3.org/2000/svg">{}</svg>'


def read_svg(folder, body, **options):
    path = folder / "drawing.svg"
    path.write_text(SVG.format(body), encoding="utf-8")
    return Shape.from_file(path, **options)


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
    with pytest.raises(InputError, match=r"pip install svgpathtools"):
        read_svg(tmp_path, '<rect width="1" height="1"/>')


def test_svg_rings_of_a_dataset_drawn_again(tmp_path):
    shape = datasets.load("gear")
    d = "".join(
        "M" + "L".join(f"{x!r} {-y!r} " for x, y in shape.points[r].tolist()) + "Z" for r in shape.rings()
    )
    (tmp_path / "gear.svg").write_text(SVG.format(f'<path d="{d}"/>'))
    assert (np.concatenate(svg_rings(tmp_path / "gear.svg")[0]) == shape.points).all()


def test_svg_tolerance_that_asks_for_too_much(tmp_path):
    with pytest.raises(
        InputError, match=r"tolerance = 1e-15 asks for .* vertices, and 1,000,000 are the most"
    ):
        read_svg(tmp_path, '<circle r="5"/>', tolerance=1e-15)


def test_svg_names_what_crosses(tmp_path):
    body = '<rect id="a" x="20" width="4" height="3"/><path id="b" d="M 30 0h1v1z M 21 1h9v1h-9z"/>'
    with pytest.raises(
        ShapeError, match=r"of <rect> with id 'a' meets .* of subpath 1 of <path> with id 'b'"
    ):
        read_svg(tmp_path, body)
