"""Shapes handed to other programs and taken from them: files, shapely, trimesh, ``__geo_interface__``."""

from __future__ import annotations

import io
import json
from os import PathLike
from typing import IO, TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from ..checks import as_path, library
from ..errors import InputError
from ..files import GEOMETRY_SUFFIXES, write_geometry, write_surface
from .boundary import Boundary, only_in

if TYPE_CHECKING:
    from typing import Self

    import shapely
    import trimesh


class Exchange(Boundary):
    """A boundary that other libraries know how to take, and that is made of theirs.

    Examples
    --------
    >>> from polyskel_lite import Shape
    >>> isinstance(Shape.from_rings([[(0, 0), (2, 0), (0, 2)]]), Exchange)
    True
    """

    def to_file(self, path: str | PathLike) -> None:
        """Write the boundary; the suffix says how.

        In 2D as GeoJSON, WKT (.wkt) or SVG, by shapely. In 2D and 3D as PLY, OBJ, glTF (.glb) or VTK (.vtk,
        .vtu), in 3D also as STL or OFF: these need the extra ``meshes``. Coordinates are kept to the last
        bit, except that STL and glTF round them to single precision. See `polyskel_lite.files.write_surface`.

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> Shape.from_rings([[(0, 0), (2, 0), (0, 2)]]).to_file("triangle.stl")  # doctest: +ELLIPSIS
        Traceback (most recent call last):
        polyskel_lite.errors.InputError: triangle.stl: a shape in the plane cannot be written as '.stl'; ...
        """
        if self.dimension == 2 and as_path(path).suffix.lower() in GEOMETRY_SUFFIXES:
            write_geometry(as_path(path), self.__geo_interface__)
        else:
            write_surface(path, self.points, self.facets)

    if TYPE_CHECKING:  # of `Shape`, which is what is made here

        @classmethod
        def from_file(cls, path: str | PathLike | IO, **options: Any) -> Self: ...

        @classmethod
        def from_mesh(cls, V: ArrayLike, F: ArrayLike, turn: bool = False) -> Self: ...

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """A GeoJSON Polygon or MultiPolygon (2D only; needs shapely), as geopandas and others take it.

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> Shape.from_rings([[(0, 0), (2, 0), (0, 2)]]).__geo_interface__["coordinates"]
        (((0.0, 0.0), (2.0, 0.0), (0.0, 2.0), (0.0, 0.0)),)
        """
        return self.to_shapely().__geo_interface__

    def to_shapely(self) -> shapely.Polygon | shapely.MultiPolygon:
        """The same region as a shapely geometry (2D only; needs shapely).

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> Shape.from_rings([[(0, 0), (2, 0), (0, 2)]]).to_shapely().area
        2.0
        """
        only_in(2, self, "to_shapely", "to_trimesh()")
        shapely = library("shapely")
        lines = shapely.multilinestrings([shapely.linearrings(self.points[ring]) for ring in self.rings()])
        return shapely.orient_polygons(shapely.build_area(lines))

    @classmethod
    def from_shapely(cls, geometry: Any, **options: Any) -> Self:
        """Make a shape from a shapely geometry, or whatever else has a ``__geo_interface__``.

        Parameters
        ----------
        geometry : shapely Polygon or MultiPolygon, geopandas GeoDataFrame, GeoJSON as a dict, ...
        **options
            Those of `Shape.from_file`.

        Raises
        ------
        PolyskelError
            As for a GeoJSON file.

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> triangle = Shape.from_rings([[(0, 0), (2, 0), (0, 2)]])
        >>> Shape.from_shapely(triangle.to_shapely()).area()
        2.0
        """
        content = getattr(geometry, "__geo_interface__", geometry)
        try:
            text = json.dumps(content)
        except (TypeError, ValueError, RecursionError) as error:
            raise InputError(f"geometry is no shapely geometry and no GeoJSON ({error}); pass one.") from None
        return cls.from_file(io.StringIO(text), **{"name": "geometry.geojson"} | options)

    def to_trimesh(self) -> trimesh.Trimesh:
        """The same surface as a trimesh mesh (3D only; needs the extra ``meshes``).

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> corner = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        >>> Shape([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 6)], corner).to_trimesh().is_watertight
        True
        """
        only_in(3, self, "to_trimesh", "to_shapely()")
        return library("trimesh").Trimesh(self.points, self.facets, process=False)

    @classmethod
    def from_trimesh(cls, mesh: trimesh.Trimesh, **options: Any) -> Self:
        """Make a solid from a trimesh mesh: `Shape.from_mesh` of its vertices and faces, with its options.

        Examples
        --------
        >>> from polyskel_lite import Shape
        >>> import trimesh
        >>> Shape.from_trimesh(trimesh.creation.box()).volume()
        1.0
        """
        if not hasattr(mesh, "vertices") or not hasattr(mesh, "faces"):
            raise InputError(
                f"mesh is a {type(mesh).__name__}; pass a trimesh.Trimesh (of a scene, .to_mesh())."
            )
        return cls.from_mesh(mesh.vertices, mesh.faces, **options)
