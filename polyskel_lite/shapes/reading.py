"""From what a file holds to the arrays of a shape, mended where that is asked for."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..checks import as_flag
from ..errors import DuplicatePointError, PolyskelError, ShapeError
from ..files import read_file
from .overlaps import mended_rings, shown_rings
from .rings import cleaned
from .welding import mended_mesh

EXTRA = "polyskel-lite[mend]"


def missing(*names: str) -> list[str]:
    """Those of some packages that are not installed.

    Examples
    --------
    >>> missing("scipy", "no_such_package")
    ['no_such_package']
    """
    return [name for name in names if importlib.util.find_spec(name) is None]


@contextmanager
def telling_of_mend(*packages: str, tried: bool = False) -> Iterator[None]:
    """Say in an error about a boundary that it could be mended, and what that takes; or that it was tried.

    Examples
    --------
    >>> with telling_of_mend("scipy"):
    ...     raise ShapeError("the mesh is open.")
    Traceback (most recent call last):
    polyskel_lite.errors.ShapeError: the mesh is open. Or pass mend=True, see polyskel_lite.mend.
    """
    try:
        yield
    except (DuplicatePointError, ShapeError) as error:
        end = f'after pip install "{EXTRA}"' if missing(*packages) else "see polyskel_lite.mend"
        hint = f" Or pass mend=True, {end}."
        text = str(error).removesuffix(hint)
        error.args = (text + (" That is after mending." if tried else hint), *error.args[1:])
        raise


def mended(kind: str, arrays: tuple, tolerance=None, width=None, largest=False, least=0.0):
    """What `read_file` returns, mended: its kind, arrays that make a shape, and what was done.

    Examples
    --------
    >>> kind, arrays, report = mended("rings", ([[(0, 0), (3, 0), (3, 3), (9, 3), (3, 3), (0, 3)]],))
    >>> kind, len(arrays[0][0]), report
    ('rings', 4, {'rings': 1, 'outlines': 1})
    """
    if kind in ("mesh", "facets") and arrays[0].shape[1] == 3:
        points, faces, report = mended_mesh(arrays[0], arrays[1], tolerance, largest, least)
        return "mesh", (points, faces), report
    if kind == "facets":
        return kind, arrays, {}
    areas = [cleaned(*arrays)] if kind == "rings" else arrays[0]
    *arrays, report = mended_rings(areas, tolerance, width, largest, least)
    return "rings", tuple(arrays), report


def read_shape(cls, path: Path, turn: bool, mend: bool, options: dict):
    """A shape of a class from a file; see `Shape.from_file`.

    Examples
    --------
    >>> read_shape(None, Path("nowhere.svg"), False, False, {})
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: nowhere.svg: there is no such file; check the path 'nowhere.svg'.
    """
    try:
        kind, arrays = read_file(path, **options)
        if as_flag(mend, "mend"):
            kind, arrays, _ = mended(kind, arrays)
        if mend:
            return of_mended(cls, kind, arrays)
        if kind == "mesh":
            return cls.from_mesh(*arrays, turn=turn)
        if kind == "facets":
            return cls(*arrays)
        return cls.from_rings(*arrays) if kind == "rings" else _of_areas(cls, kind, *arrays)
    except PolyskelError as error:
        # The same error, but whoever reads the message has to know which file it is about.
        error.args = (f"{path.name[:60]}: {error}", *error.args[1:])
        raise


def of_mended(cls, kind: str, arrays: tuple):
    """A shape of a class from what `mended` returns.

    Examples
    --------
    >>> from polyskel_lite import Shape
    >>> of_mended(Shape, "rings", ([[(0, 0), (3, 0), (3, 3)]],)).area()
    4.5
    """
    with telling_of_mend("shapely", tried=True):
        return (cls.from_rings if kind == "rings" else cls)(*arrays)


def _of_areas(cls, kind: str, areas: list):
    """The union of areas; those of a drawing may overlap, since a renderer draws their union."""
    try:
        if not any(area.clips for area in areas):
            with telling_of_mend("shapely"):
                rings = shown_rings(areas)
            return cls.from_rings(*rings)
    except (DuplicatePointError, ShapeError):
        if kind != "drawing" or missing("shapely"):
            raise
    rings, names, _ = mended_rings(areas)
    return cls.from_rings(rings, names)
