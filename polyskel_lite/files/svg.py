"""Outlines of SVG drawings, parsed by svgpathtools.

The tree is walked and transforms are applied to points here, because svgpathtools' own transform of
elliptic arcs is wrong for turned ellipses and for some reflections.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from os import PathLike
from xml.etree import ElementTree

import numpy as np

from ..checks import as_number
from ..errors import InputError

#: Vertices of all outlines together: a polygon of more is no longer a drawing.
MOST_VERTICES = 1_000_000


def svg_rings(path: str | PathLike, tolerance: float = 1e-3) -> tuple[list[np.ndarray], list[str]]:
    """Read all closed paths and basic shapes of an SVG file as polygons.

    Parameters
    ----------
    path : str or path
    tolerance : float
        How far a polygon may leave a curve, as a share of the diagonal of the drawing.

    Returns
    -------
    rings : list of (k, 2) float arrays
        In user units with transforms applied, y upward; in no particular orientation.
    names : list of str
        What messages call them: the element, its id, and which of its subpaths it is.

    Raises
    ------
    InputError
        If the file is no SVG, has no closed path, or has an open path whose fill is not "none".

    See Also
    --------
    polyskel_lite.readers.from_file : what is read and what is not.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> drawing = '<svg xmlns="http://www.w3.org/2000/svg"><rect width="3" height="2"/></svg>'
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "drawing.svg"
    ...     _ = file.write_text(drawing)
    ...     rings, names = svg_rings(file)
    >>> names, (rings[0] + 0.0).tolist()
    (['<rect>'], [[0.0, 0.0], [3.0, 0.0], [3.0, -2.0], [0.0, -2.0]])
    """
    what = "a share of the size between 0 and 1"
    tolerance = as_number(tolerance, "tolerance", what, 0, np.nextafter(1, 0), above=True)
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, ValueError, LookupError) as error:  # the last two: unknown encodings
        raise InputError(f"this is not XML ({error}); save it again as SVG.") from None
    closed = list(_subpaths(root, np.eye(3), "", _svg_tools()))
    if not closed:
        raise InputError("there is no closed path in it; turn text and strokes into paths and save it again.")
    rough = np.concatenate([_polygon(pieces, matrix, np.inf) for pieces, matrix, _ in closed])
    chord = tolerance * float(np.hypot(*np.ptp(rough, axis=0)))
    if chord == 0:
        raise InputError("all its paths are one point; draw an outline.")
    count = sum(_count(s, _share(matrix, chord)) for pieces, matrix, _ in closed for s in pieces)
    if not count <= MOST_VERTICES:
        raise InputError(
            f"tolerance = {tolerance:g} asks for {count:.3g} vertices, and {MOST_VERTICES:,} are the most; "
            "pass a larger one."
        )
    rings = [(distinct(_polygon(pieces, matrix, chord)), name) for pieces, matrix, name in closed]
    rings = [ring for ring in rings if len(ring[0]) > 2]  # a path there and back encloses nothing
    if not rings:
        raise InputError("no path in it encloses an area; draw an outline.")
    return [ring for ring, _ in rings], [name for _, name in rings]


def _svg_tools():
    try:
        from svgpathtools import document, parse_path, parser
    except ImportError:
        raise InputError("reading SVG needs svgpathtools; run: pip install svgpathtools") from None
    return document.CONVERSIONS, parse_path, parser.parse_transform


def _subpaths(element, matrix: np.ndarray, fill: str, tools) -> Iterator[tuple[list, np.ndarray, str]]:
    """All closed subpaths below an element: their segments, the transform that belongs to them, a name.

    `fill` is the one inherited from the elements around.
    """
    conversions, _, parse_transform = tools
    tag = str(element.tag).rpartition("}")[2]
    style = dict(part.split(":", 1) for part in element.get("style", "").split(";") if ":" in part)
    style = {name.strip(): value.strip() for name, value in style.items()}
    fill = style.get("fill", element.get("fill", fill)).strip()
    if style.get("display", element.get("display", "")).strip() == "none":
        return
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)  # a skipped transform would be a wrong shape
            matrix = matrix @ parse_transform(element.get("transform"))
            pieces = _parsed(element, tag, tools) if tag in conversions and tag != "line" else []
    except Exception as error:  # svgpathtools raises whatever its parts raise
        raise InputError(f"{_called(element, tag)} cannot be read ({error}); simplify it.") from None
    for k, piece in enumerate(pieces):
        begin, end = piece[0].start, piece[-1].end
        if abs(begin - end) > 1e-9 * max(abs(begin), abs(end)):
            if fill == "none":
                continue
            raise InputError(
                f"{_called(element, tag)} is open: it begins at ({begin.real:g}, {begin.imag:g}) and ends at "
                f"({end.real:g}, {end.imag:g}); close it (Z), or give it fill none if it is a stroke."
            )
        yield (
            piece,
            matrix,
            f"subpath {k} of {_called(element, tag)}" if len(pieces) > 1 else _called(element, tag),
        )
    if tag in ("svg", "g", "a", "switch"):
        for child in element:
            yield from _subpaths(child, matrix, fill, tools)


def _called(element, tag: str) -> str:
    name = element.get("id")
    return f"<{tag}> with id {name!r}" if name else f"<{tag}>"


def _parsed(element, tag: str, tools) -> list[list]:
    conversions, parse_path, _ = tools
    parsed = parse_path(conversions[tag](element))
    return [list(part) for part in parsed.continuous_subpaths()] if len(parsed) else []


def _polygon(pieces: list, matrix: np.ndarray, chord: float) -> np.ndarray:
    """Vertices along the segments, transformed, y upward, no farther than `chord` from the curve."""
    z = np.array([s.point(t) for s in pieces for t in _parameters(s, _share(matrix, chord))])
    x, y = matrix[:2, :2] @ [z.real, z.imag] + matrix[:2, 2:]
    return np.stack([x, -y], axis=1)


def _share(matrix: np.ndarray, chord: float) -> float:
    """How far a chord may leave a curve before the transform."""
    scale = float(np.linalg.norm(matrix[:2, :2], 2))
    return chord / scale if scale else np.inf


def _parameters(segment, chord: float) -> np.ndarray:
    """Where to put vertices on a segment, its end left out."""
    return np.linspace(0, 1, int(_count(segment, chord)), endpoint=False)


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


def distinct(ring: np.ndarray) -> np.ndarray:
    """The ring without vertices that repeat the one before."""
    return ring[(ring != np.roll(ring, 1, axis=0)).any(axis=1)]
