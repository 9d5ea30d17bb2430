"""Outlines of SVG drawings: paths, basic shapes and transforms, parsed by svgpathtools.

The tree is walked and transforms are applied to points here, because svgpathtools' own transform of
elliptic arcs is wrong for turned ellipses and for some reflections. A drawing with more in it (styles,
``<use>``, units, clips, strokes) is first made one of plain paths, see `normalised`.
"""

from __future__ import annotations

import re
import warnings
from collections import Counter
from collections.abc import Iterator
from os import PathLike
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from ..checks import as_flag, as_number, library
from ..errors import InputError, LeftOutWarning
from .areas import Area, distinct
from .usvg import normalised, stroked

#: Vertices of all outlines together: a polygon of more is no longer a drawing.
MOST_VERTICES = 1_000_000
# What is named in a warning, and what takes more than is read here.
_LEFT_OUT = ("text", "image", "foreignObject", "mask", "filter", "pattern")
_BEYOND = ("style", "use", "switch")
_BEYOND_ATTRIBUTES = {"clip-path", "marker", "marker-start", "marker-mid", "marker-end", "transform-origin"}
_BEYOND_ATTRIBUTES |= {"systemLanguage", "requiredExtensions", "requiredFeatures"}
_INHERITED = {"fill", "fill-rule", "clip-rule", "visibility", "fill-opacity"}
_UNITS = {"": 1, "px": 1, "pt": 4 / 3, "pc": 16, "mm": 96 / 25.4, "cm": 96 / 2.54, "in": 96}
_CLEAR = re.compile(r"transparent|rgba|hsla|/|^#(.{4}|.{8})$")


class _Beyond(Exception):
    """The drawing has something in it that plain paths have not; the text is what."""


class _Part(NamedTuple):
    """One element: its closed subpaths as segments, where they go, and how they are filled."""

    subpaths: list
    matrix: np.ndarray
    name: str
    rule: str
    clips: tuple
    filled: bool


def svg_areas(path: str | PathLike, tolerance: float = 1e-3, stroke: bool = False) -> list[Area]:
    """Read what an SVG file shows as polygons: what is filled, in any colour, one area an element.

    Parameters
    ----------
    path : str or path
    tolerance : float
        How far a polygon may leave a curve, as a share of the diagonal of the drawing.
    stroke : bool
        Whether lines count too, with their widths.

    Returns
    -------
    list of Area
        In user units with transforms applied, y upward; rings are in no particular orientation, and called
        by the element, its id, and which of its subpaths they are.

    Raises
    ------
    InputError
        If the file is no SVG, shows no area, or needs the extra ``svg`` and that is missing.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> drawing = '<svg xmlns="http://www.w3.org/2000/svg"><rect width="3" height="2"/></svg>'
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "drawing.svg"
    ...     _ = file.write_text(drawing)
    ...     (area,) = svg_areas(file)
    >>> area.names, (area.rings[0] + 0.0).tolist()
    (['<rect>'], [[0.0, 0.0], [3.0, 0.0], [3.0, -2.0], [0.0, -2.0]])
    """
    what = "a share of the size between 0 and 1"
    tolerance = as_number(tolerance, "tolerance", what, 0, np.nextafter(1, 0), above=True)
    stroke, path = as_flag(stroke, "stroke"), Path(path)
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, ValueError, LookupError) as error:  # the last two: unknown encodings
        raise InputError(f"this is not XML ({error}); save it again as SVG.") from None
    tools = library("svgpathtools", "reading SVG")
    try:
        if stroke:
            raise _Beyond("the width of lines")
        _check_plain(root)
        parts = list(_parts(root, np.eye(3), {}, (), tools))
    except _Beyond as what:
        drawn = normalised(path, root, str(what))
        clips = {f"url(#{e.get('id')})": e for e in drawn.iter() if _tag(e) == "clipPath"}
        parts = list(_parts(drawn, np.eye(3), {"clips": clips, "stroke": stroke}, (), tools))
    _tell_left_out(path.name, root)
    filled = [part for part in parts if part.filled]
    if not filled and parts:
        _warn(
            path.name, "nothing in it is filled: lines are taken as outlines; stroke=True reads their width"
        )
    areas = _areas([part for part in filled or parts if part.subpaths], tolerance)
    return _framed(areas, _frame(root))


def _areas(parts: list[_Part], tolerance: float) -> list[Area]:
    if not parts:
        raise InputError(
            "there is no closed path in it; turn text into paths, or pass stroke=True for lines."
        )
    rough = np.concatenate([_polygon(s, part.matrix, np.inf) for part in parts for s in part.subpaths])
    chord = tolerance * float(np.hypot(*np.ptp(rough, axis=0)))
    if chord == 0:
        raise InputError("all its paths are one point; draw an outline.")
    count = sum(_count(s, _share(p.matrix, chord)) for p in parts for pieces in p.subpaths for s in pieces)
    if not count <= MOST_VERTICES:
        raise InputError(
            f"tolerance = {tolerance:g} asks for {count:.3g} vertices, and {MOST_VERTICES:,} are the most; "
            "pass a larger one."
        )
    areas = [_area(part, chord) for part in parts]
    if not any(area.rings for area in areas):
        raise InputError("no path in it encloses an area; draw an outline.")
    return [area for area in areas if area.rings]


def _area(part: _Part, chord: float) -> Area:
    rings = [distinct(_polygon(pieces, part.matrix, chord)) for pieces in part.subpaths]
    names = [f"subpath {k} of {part.name}" if len(rings) > 1 else part.name for k in range(len(rings))]
    some = [(ring, name) for ring, name in zip(rings, names, strict=True) if len(ring) > 2]
    clips = tuple([_area(p, chord) for p in clip] for clip in part.clips)  # the others enclose nothing
    return Area([ring for ring, _ in some], [name for _, name in some], part.rule, clips)


# --- what is in the tree --------------------------------------------------------------------------


def _tag(element) -> str:
    return str(element.tag).rpartition("}")[2]


def _properties(element) -> dict[str, str]:
    """Attributes, and over them what the style says."""
    style = (part.split(":", 1) for part in element.get("style", "").split(";") if ":" in part)
    declared = {name.strip(): value.replace("!important", "").strip() for name, value in style}
    return {name: value.strip() for name, value in (element.attrib | declared).items() if value != "inherit"}


def _check_plain(root) -> None:
    for element in root.iter():
        tag, own = _tag(element), _properties(element)
        if (tag in _BEYOND and (tag != "style" or element.text)) or (tag == "svg" and element is not root):
            raise _Beyond(f"<{tag}>")
        beyond = {name for name in own.keys() & _BEYOND_ATTRIBUTES if own[name] != "none"}
        beyond |= {name for name in ("transform", "d") if own.get(name) != element.get(name)}
        if beyond:
            raise _Beyond(f"the property {min(beyond)}")


def _tell_left_out(name: str, root) -> None:
    hidden = {id(inner) for element in root.iter() if _tag(element) == "defs" for inner in element.iter()}
    seen = [element for element in root.iter() if id(element) not in hidden]
    count = Counter(_tag(e) for e in seen if _tag(e) in _LEFT_OUT[:3])
    for word in _LEFT_OUT[3:5]:
        count[word] = sum(_properties(e).get(word, "none") != "none" for e in seen)
    patterns = {f"url(#{e.get('id')})" for e in root.iter() if _tag(e) == "pattern"}
    count["pattern"] = sum(_properties(e).get("fill") in patterns for e in seen)
    left = ", ".join(f"{count[word]} {word}" for word in _LEFT_OUT if count[word])
    if left:
        _warn(name, f"not followed: {left}; turn them into paths if they matter")


def _warn(name: str, what: str) -> None:
    warnings.warn(f"{name[:60]}: {what}.", LeftOutWarning, stacklevel=6)


def _parts(element, matrix: np.ndarray, around: dict, clips: tuple, tools) -> Iterator[_Part]:
    """All elements with an area at or below one; `around` is what they inherit."""
    tag, own = _tag(element), _properties(element)
    around = around | {name: own[name] for name in own.keys() & _INHERITED}
    if own.get("display") == "none" or _nothing(own.get("opacity")):
        return
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)  # a skipped transform would be a wrong shape
            matrix = matrix @ tools.parser.parse_transform(element.get("transform"))
    except Exception as error:  # svgpathtools raises whatever its parts raise
        raise _Beyond(f"the transform of {_called(element, tag)} ({error})") from None
    if "clip-path" in own:
        clips = (*clips, *_clips(own["clip-path"], matrix, around, tools))
    visible = around.get("visibility", "visible") == "visible"
    if visible and tag in tools.document.CONVERSIONS and tag != "line":
        fill = around.get("fill", "")
        if _CLEAR.search(fill) and not fill.startswith("url"):
            raise _Beyond(f"the colour {fill}")
        filled = fill != "none" and not _nothing(around.get("fill-opacity"))
        rule = around.get("fill-rule", "nonzero")
        subpaths = _subpaths(element, tag, tools)
        if not filled:
            subpaths = [pieces for pieces in subpaths if _closed(pieces)]
        if subpaths:
            yield _Part(subpaths, matrix, _called(element, tag), rule, clips, filled)
    stroke = around.get("stroke") and tag == "path" and own.get("stroke", "none") != "none"
    if visible and stroke and (outline := stroked(own)):
        subpaths = tools.parse_path(outline).continuous_subpaths()
        yield _Part(subpaths, matrix, f"the line of {_called(element, tag)}", "nonzero", clips, True)
    if tag in ("svg", "g", "a"):
        for child in element:
            yield from _parts(child, matrix, around, clips, tools)


def _nothing(opacity) -> bool:
    return opacity is not None and re.fullmatch(r"[-+]?0*\.?0*%?", opacity) is not None


def _clips(reference: str, matrix: np.ndarray, around: dict, tools) -> Iterator[list[_Part]]:
    """The areas of a clip path, and of those that it is clipped by itself; `normalised` has resolved them."""
    if (found := around["clips"].get(reference)) is None:
        return
    if found.get("clipPathUnits") == "objectBoundingBox":
        raise InputError("it has a clip path in shares of what it clips; clip it in the drawing program.")
    inner = matrix @ tools.parser.parse_transform(found.get("transform"))
    inside = {"clips": around["clips"]}
    yield [
        part._replace(rule=child.get("clip-rule", "nonzero"))
        for child in found
        for part in _parts(child, inner, inside, (), tools)
    ]
    if "clip-path" in found.attrib:
        yield from _clips(found.get("clip-path"), matrix, around, tools)


def _called(element, tag: str) -> str:
    name = element.get("id")
    return f"<{tag}> with id {name!r}" if name else f"<{tag}>"


def _subpaths(element, tag: str, tools) -> list[list]:
    attributes = dict(element.attrib)
    try:
        if tag == "rect":
            _round(attributes)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # arcs without a radius are lines
            path = tools.parse_path(tools.document.CONVERSIONS[tag](attributes))
        return path.continuous_subpaths() if path else []
    except Exception as error:  # svgpathtools raises whatever its parts raise
        raise _Beyond(f"{_called(element, tag)} ({error})") from None


def _round(rect: dict) -> None:
    """Radii of a rectangle's corners as SVG means them: at most half a side, and both or none."""
    rx, ry = rect.pop("rx", None), rect.pop("ry", None)
    given = {"rx": (rx or ry or 0, "width"), "ry": (ry or rx or 0, "height")}
    radii = {name: min(float(r), float(rect.get(side, 0)) / 2) for name, (r, side) in given.items()}
    if min(radii.values()) > 0:
        rect |= radii


def _closed(pieces: list) -> bool:
    begin, end = pieces[0].start, pieces[-1].end
    return abs(begin - end) <= 1e-9 * max(abs(begin), abs(end))


# --- the frame ------------------------------------------------------------------------------------


def _frame(root) -> np.ndarray | None:
    """The corners of the picture in user units, y upward; None if the file does not say."""
    sizes = [re.fullmatch(r"\s*([\d.]+)\s*([a-z]*)\s*", root.get(side, "")) for side in ("width", "height")]
    given = [float(size[1]) * _UNITS.get(size[2], np.nan) for size in sizes if size]
    if len(given) == 2 and not min(given) > 0:
        given = []
    if "viewBox" in root.attrib:
        x, y, w, h = map(float, re.split(r"[\s,]+", root.get("viewBox").strip()))
        if len(given) == 2 and min(w, h) > 0 and root.get("preserveAspectRatio") is None:
            scale = min(given[0] / w, given[1] / h)
            wider, higher = given[0] / scale - w, given[1] / scale - h
            x, y, w, h = x - wider / 2, y - higher / 2, w + wider, h + higher
    elif len(given) == 2:
        (x, y), (w, h) = (0.0, 0.0), given
    else:
        return None
    return np.array([(x, -y - h), (x + w, -y - h), (x + w, -y), (x, -y)]) if min(w, h) > 0 else None


def _framed(areas: list[Area], frame: np.ndarray | None) -> list[Area]:
    """What is in the frame: areas beside it go, and those that reach beyond are clipped."""
    if frame is None:
        return areas
    low, high = frame.min(axis=0), frame.max(axis=0)
    slack = 1e-3 * (high - low).max()
    kept = []
    for area in areas:
        points = np.concatenate(area.rings)
        least, most = points.min(axis=0), points.max(axis=0)
        if (most <= low).any() or (least >= high).any():
            continue
        beyond = (least < low - slack).any() or (most > high + slack).any()
        clip = ([Area([frame], ["the frame"], "nonzero")],) if beyond else ()
        kept.append(area._replace(clips=area.clips + clip))
    if not kept:
        raise InputError("all of it is outside of its frame (viewBox); move it, or make the frame larger.")
    return kept


# --- curves ---------------------------------------------------------------------------------------


def _polygon(pieces: list, matrix: np.ndarray, chord: float) -> np.ndarray:
    """Vertices along the segments, transformed, y upward, no farther than `chord` from the curve."""
    counts = [int(_count(s, _share(matrix, chord))) for s in pieces]
    z = [
        s.point(t) for s, n in zip(pieces, counts, strict=True) for t in np.linspace(0, 1, n, endpoint=False)
    ]
    z = np.array(z if _closed(pieces) else [*z, pieces[-1].end])
    x, y = matrix[:2, :2] @ [z.real, z.imag] + matrix[:2, 2:]
    return np.stack([x, -y], axis=1)


def _share(matrix: np.ndarray, chord: float) -> float:
    """How far a chord may leave a curve before the transform."""
    scale = float(np.linalg.norm(matrix[:2, :2], 2))
    return chord / scale if scale else np.inf


def _count(segment, chord: float) -> float:
    """How many vertices a segment needs.

    A chord over a step h leaves a curve by at most h²/8 times the curve's largest second derivative.
    """
    if hasattr(segment, "radius"):
        sweep = np.radians(segment.delta)
        bend = sweep**2 * max(segment.radius.real, segment.radius.imag)
    else:
        control = np.array(segment.bpoints())
        degree = len(control) - 1
        bend = degree * (degree - 1) * np.abs(np.diff(control, 2)).max(initial=0.0)
        if degree == 1:
            return 1
    return max(4, np.ceil(np.sqrt(bend / 8 / chord)))
