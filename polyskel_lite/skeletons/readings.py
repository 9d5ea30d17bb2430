"""What users ask a skeleton for: its main axis, its branches as a table, and files for maps and drawings."""

from __future__ import annotations

from os import PathLike
from typing import Any

import numpy as np

from ..checks import as_path
from ..errors import InputError
from ..files import GEOMETRY_SUFFIXES, write_complex, write_geometry
from .axes import Axis, axis_of, longest_path
from .branch_tables import Branches, branch_rows
from .complexes import BallComplex


class Readings(BallComplex):
    """A complex that is asked questions; `Skeleton` is one.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> isinstance(psl.voronoi([(0, 0), (2, 0), (0, 2)]), Readings)
    True
    """

    def main_axis(self) -> Axis:
        """The longest way that one has to go: the longest of the shortest paths between two vertices.

        In 2D and 3D, along all edges, those around polygons too. It goes around a loop on the shorter side;
        of a skeleton that is one closed line it is the whole line. Simplify first: without a threshold the
        axis ends in corners and in noise.

        Returns
        -------
        Axis
            With ``length``, ``smooth_length`` and ``stations``; one vertex, that of the largest ball, where
            there is no edge.

        Raises
        ------
        InputError
            If there is no vertex.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> tee = psl.skeleton([[(0, 0), (30, 0), (30, 4), (17, 4), (17, 9), (13, 9), (13, 4), (0, 4)]])
        >>> axis = tee.skeleton.main_axis()
        >>> round(axis.smooth_length), axis.points[[0, -1]].round().tolist()
        (26, [[2.0, 2.0], [28.0, 2.0]])
        """
        return axis_of(self, longest_path(self))

    def branch_table(self) -> Branches:
        """Its branches, the longest first: lengths, radii, and the line itself (needs the extra ``graph``).

        Returns
        -------
        Branches
            A list of `Branch`, with ``to_csv`` and ``to_dataframe``.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> table = psl.skeleton([[(0, 0), (20, 0), (20, 4), (0, 4)]]).skeleton.branch_table()
        >>> len(table), table[0].axis.stations(8).widths.round(1).tolist()
        (1, [4.0, 4.0, 4.0])
        """
        return branch_rows(self)

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """A GeoJSON FeatureCollection (2D only): a line with numbers for each branch, points without edges.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> lines = psl.skeleton([[(0, 0), (20, 0), (20, 4), (0, 4)]]).skeleton.__geo_interface__["features"]
        >>> lines[0]["geometry"]["type"], round(lines[0]["properties"]["mean_radius"])
        ('LineString', 2)
        """
        if self.dimension != 2 or not np.isfinite(self.vertices).all():
            raise InputError("only a skeleton of the plane, with no vertex at infinity, is a map of lines.")
        rows = self.branch_table()
        lines = [
            {"type": "Feature", "properties": facts}
            | {"geometry": {"type": "LineString", "coordinates": row.axis.points.tolist()}}
            for row, facts in zip(rows, rows.records(), strict=True)
            if row.axis is not None and row.length > 0  # cocircular samples: two junctions at one place
        ]
        alone = np.setdiff1d(np.arange(len(self.vertices)), self.edges)
        points = [
            {"type": "Feature", "properties": {"radius": r}, "geometry": {"type": "Point", "coordinates": p}}
            for p, r in zip(self.vertices[alone].tolist(), self.radii[alone].tolist(), strict=True)
        ]
        return {"type": "FeatureCollection", "features": lines + points}

    def to_file(self, path: str | PathLike) -> None:
        """Write edges and polygons for other programs; the suffix says how.

        In 2D as GeoJSON, with the numbers of each branch, WKT (.wkt) or SVG: a line for each branch (needs
        the extra ``graph``, and for WKT and SVG shapely). In 2D and 3D as PLY, OBJ, glTF (.glb) or VTK (.vtk,
        .vtu), with the extra ``meshes``; PLY and VTK keep the radii, and `Skeleton.save` keeps everything.
        See `polyskel_lite.files.write_complex`.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> psl.voronoi([(0, 0), (2, 0), (0, 2)]).to_file("corner.stl")  # doctest: +ELLIPSIS
        Traceback (most recent call last):
        polyskel_lite.errors.InputError: corner.stl: a skeleton cannot be written as '.stl'; ...
        """
        if self.dimension == 2 and as_path(path).suffix.lower() in GEOMETRY_SUFFIXES:
            write_geometry(as_path(path), self.__geo_interface__)
        else:
            data = {"radius": self.radii, "simplex": self.simplices.astype(np.int32)}
            write_complex(path, self.vertices, self.edges, self.polygons, data)
