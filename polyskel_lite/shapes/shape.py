"""Shapes by their boundary, and samplings of it (the paper's section 2.1)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from typing import IO, TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..checks import as_flag, as_indices, as_number, as_path, as_points, check_distinct
from ..errors import InputError, ShapeError, TessellationError
from ..exact import locate
from ..files import on_disk, trace
from ..graphs import Tessellation, compiled_wanted, delaunay, facet_rows
from ..tables import bounds_and_betti
from .boundary import only_in
from .density import densified
from .exchange import Exchange
from .meshes import check_mesh, turned
from .reading import mended, read_shape, telling_of_mend
from .rings import check_closed, check_meetings, check_turns, oriented, ring_facets
from .sampling import sample_rings


def check_shape(shape: Any) -> None:
    """Raise `InputError` if ``shape`` is no `Shape`.

    Examples
    --------
    >>> check_shape([(0, 0), (1, 0), (0, 1)])
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: shape is a list; pass a Shape, for example Shape.from_rings([points]).
    """
    if not isinstance(shape, Shape):
        raise InputError(
            f"shape is a {type(shape).__name__}; pass a Shape, for example Shape.from_rings([points])."
        )


@dataclass(frozen=True, eq=False, repr=False)
class Shape(Exchange):
    """A closed region of the plane or of space, given by its oriented boundary (the P of section 2.1).

    Parameters
    ----------
    points : (n, N) array-like, N = 2 or 3
        Boundary vertices, any unit of length, all different.
    facets : (m, N) array-like of int
        N = 2: segments from vertex to vertex with the interior on the left, so that outer rings run
        counter-clockwise and holes clockwise; every vertex begins one segment and ends one.
        N = 3: triangles, counter-clockwise seen from outside the solid (so from inside a cavity); every
        edge is in two of them, in opposite directions, and around every vertex they make one fan.

    Attributes
    ----------
    points : (n, N) float array
    facets : (m, N) int array
    dimension : int
        N.

    Raises
    ------
    InputError
        If an array has a wrong shape, or a number that is not finite.
    DuplicatePointError
        If two vertices coincide.
    ShapeError
        If the boundary is open, not manifold, crosses or touches itself, or has its interior on the wrong
        side; the message names the vertices and the facets.

    Notes
    -----
    All of this is checked with exact arithmetic: 20,000 triangles take about two seconds.

    See Also
    --------
    Shape.from_rings : the same from lists of vertices in any orientation.
    Shape.from_mesh : the same from a triangle mesh, which it can turn outward.

    References
    ----------
    Attali and Montanvert, Computing and simplifying 2D and 3D continuous skeletons, 1997, section 2.1.

    Examples
    --------
    >>> triangle = Shape([(0, 0), (4, 0), (0, 3)], [(0, 1), (1, 2), (2, 0)])
    >>> triangle.area(), triangle.length(), triangle.betti()
    (6.0, 12.0, (1, 0))
    >>> corner = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    >>> tip = Shape([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 6)], corner)
    >>> tip.volume(), tip.betti()
    (1.0, (1, 0, 0))
    """

    points: NDArray[np.float64]
    facets: NDArray[np.int64]

    if TYPE_CHECKING:  # what is given may be any array-like, what is kept is an array

        def __init__(self, points: ArrayLike, facets: ArrayLike) -> None: ...

    def _facts(self) -> Iterator[tuple[str, object]]:
        yield "points", len(self.points)
        yield "segments" if self.dimension == 2 else "triangles", len(self.facets)
        yield from bounds_and_betti(self.points, self.betti)

    def __post_init__(self):
        points = as_points(self.points, dimensions=(2, 3))
        self._set(points, as_indices(self.facets, "facets", len(points), points.shape[1]))

    def _set(self, points: np.ndarray, facets: np.ndarray, place=None) -> None:
        """Check the boundary and keep it; ``place`` says where vertices are, when they come from rings."""
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "facets", facets)
        if self.dimension == 3:
            check_distinct(points)
            check_mesh(points, facets, self._doubtful)
        else:
            check_closed(len(points), facets)
            check_distinct(points, place)
            check_meetings(points, facets, place, self._doubtful())
            if place is None:  # else the rings were turned as they have to be
                check_turns(points, facets)
        points.setflags(write=False)
        facets.setflags(write=False)

    def _doubtful(self) -> np.ndarray | None:
        """Facets that can meet others: Delaunay facets do not. None for all where it is quicker to look."""
        if "tessellation" not in self.__dict__ and not compiled_wanted(len(self.points), self.dimension):
            return None
        try:
            return np.flatnonzero(facet_rows(self.tessellation, self.facets) < 0)
        except TessellationError:
            return None

    @cached_property
    def tessellation(self) -> Tessellation:
        """The Delaunay tessellation of the vertices, with boundary facets where ties leave a choice.

        Examples
        --------
        >>> Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).tessellation.simplices.tolist()
        [[0, 1, 2], [0, 2, 3]]
        """
        return delaunay(self.points, self.facets)

    @classmethod
    def refined(cls, facets: np.ndarray, tessellation: Tessellation) -> Shape:
        """A shape whose tessellation is there already, as after `conform`.

        Examples
        --------
        >>> triangle = Shape.from_rings([[(0, 0), (2, 0), (0, 2)]])
        >>> Shape.refined(triangle.facets, triangle.tessellation).area()
        2.0
        """
        shape = object.__new__(cls)
        shape.__dict__["tessellation"] = tessellation
        shape._set(tessellation.points, facets)
        return shape

    @classmethod
    def from_rings(cls, rings: Sequence, names: Sequence[str] | None = None, mend: bool = False) -> Shape:
        """Make a shape from closed rings of any orientation; rings inside rings are holes (even-odd).

        Parameters
        ----------
        rings : list of (k, 2) array-like
            Vertices in order. The last one may repeat the first.
        names : list of str, optional
            What messages call the rings; by default "ring 0", "ring 1" and so on.
        mend : bool
            Unite rings that cross or touch, see `polyskel_lite.mend`, which also says what was done.

        Returns
        -------
        Shape
            Outer rings turned counter-clockwise, holes clockwise; the order of the rings is kept.

        Raises
        ------
        InputError, DuplicatePointError, ShapeError
            As `Shape`; the message names the rings, and vertices by their number in the ring as given.

        Examples
        --------
        >>> square = np.array([(0, 0), (3, 0), (3, 3), (0, 3)])
        >>> frame = Shape.from_rings([square, square / 3 + 1])
        >>> frame.betti(), round(frame.area(), 12)
        ((1, 1), 8.0)
        """
        if as_flag(mend, "mend"):
            rings, names = mended("rings", (rings, names))[1]
        rings, place = oriented(rings, names)
        shape = object.__new__(cls)
        with telling_of_mend("shapely", tried=mend):
            shape._set(np.concatenate(rings), ring_facets([len(ring) for ring in rings]), place)
        return shape

    @classmethod
    def from_mesh(cls, V: ArrayLike, F: ArrayLike, turn: bool = False, mend: bool = False) -> Shape:
        """Make a solid from a closed triangle mesh.

        Parameters
        ----------
        V : (n, 3) array-like
            Vertices; those in no face are dropped.
        F : (m, 3) array-like of int
            Triangles.
        turn : bool
            Turn surfaces that are inside out: outer ones outward, cavities inward.
        mend : bool
            Weld, wind, close and unite the faces, see `polyskel_lite.mend`, which also says what was done.

        Returns
        -------
        Shape

        Raises
        ------
        InputError, DuplicatePointError, ShapeError
            As `Shape`. Nothing is repaired but what is said here.

        Examples
        --------
        >>> V = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 6), (9, 9, 9)]
        >>> inside_out = [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]
        >>> Shape.from_mesh(V, inside_out, turn=True).volume()
        1.0
        """
        V = as_points(V, name="V", dimensions=(3,))
        F = as_indices(F, "facets", len(V), 3)
        if as_flag(mend, "mend"):
            V, F = mended("mesh", (V, F))[1]
        used, faces = np.unique(F, return_inverse=True)
        V, F = V[used], faces.reshape(-1, 3)
        with telling_of_mend("pymeshfix", "manifold3d", tried=mend):
            return cls(V, turned(V, F) if as_flag(turn, "turn") else F)

    @classmethod
    def from_mask(cls, image: ArrayLike, level: float | None = None, **options: Any) -> Shape:
        """Make a shape from a picture by marching squares; see `polyskel_lite.files.trace`.

        Examples
        --------
        >>> Shape.from_mask(np.ones((4, 4))).betti()
        (1, 0)
        """
        return cls.from_rings(trace(image, level, **options))

    @classmethod
    def from_file(
        cls, path: str | PathLike | IO, *, turn: bool = False, mend: bool = False, **options: Any
    ) -> Shape:
        """Read a shape from GeoJSON, SVG, PNG, STL, PLY, OBJ or OFF; see `polyskel_lite.files.read_file`.

        Parameters
        ----------
        path : str or path or open file
            An open file, of bytes or text, is read as its name says, or ``name="drawing.svg"``.
        turn : bool
            Meshes only: as for `Shape.from_mesh`.
        mend : bool
            Make a boundary of what crosses or touches itself, or has gaps: see `polyskel_lite.mend`.
        **options
            Of `polyskel_lite.files.read_file`.

        Examples
        --------
        >>> Shape.from_file("outline.xyz")  # doctest: +ELLIPSIS
        Traceback (most recent call last):
        polyskel_lite.errors.InputError: ...
        """
        if hasattr(path, "read"):  # an open file: its name says what is in it
            with on_disk(path, options.pop("name", None)) as copy:
                return read_shape(cls, copy, turn, mend, options)
        return read_shape(cls, as_path(path), turn, mend, options)

    def contains(self, queries: ArrayLike) -> NDArray[np.bool_]:
        """Whether each query point is in the closed region; exact, boundary points are inside.

        Parameters
        ----------
        queries : (k, N) array-like

        Returns
        -------
        (k,) bool array

        Examples
        --------
        >>> square = Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]])
        >>> square.contains([(1, 1), (2, 1), (3, 1)])
        array([ True,  True, False])
        """
        return self.locate(queries) >= 0

    def locate(self, queries: ArrayLike) -> NDArray[np.int8]:
        """+1 for queries in the interior, 0 on the boundary, -1 outside; exact.

        Examples
        --------
        >>> square = Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]])
        >>> square.locate([(1, 1), (2, 1), (3, 1)])
        array([ 1,  0, -1], dtype=int8)
        """
        queries = as_points(queries, name="queries", dimensions=(self.dimension,))
        return locate(self.segments, queries)

    def sample(self, n: int, start: float = 0.0) -> NDArray[np.float64]:
        """Points E on the boundary, uniform by arc length on every ring (section 2.1, sampling; 2D only).

        Parameters
        ----------
        n : int
            Number of points in all, at least three a ring; shared among rings by length.
        start : float
            Where the first point stands, as a share of one step; 0 puts it on the ring's first vertex.

        Returns
        -------
        (n, 2) float array

        Raises
        ------
        InputError
            If ``n`` is less than three times the number of rings.

        Examples
        --------
        >>> Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).sample(4, start=0.5).tolist()
        [[1.0, 0.0], [2.0, 1.0], [1.0, 2.0], [0.0, 1.0]]
        """
        return np.concatenate(self._samples(n, start))

    def resample(self, n: int, start: float = 0.0) -> Shape:
        """The polygon P_w through `sample` (n, start); 2D only, see `polyskel_lite.implicit` for solids.

        Raises
        ------
        ShapeError
            If so few samples make a polygon that crosses itself; ask for more.

        Examples
        --------
        >>> Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).resample(8).area()
        4.0
        """
        rings = self._samples(n, start)
        try:
            return self.from_rings(rings)
        except ShapeError as error:
            raise ShapeError(f"{n} samples are too few for this shape: {error}") from None

    def densify(self, spacing: float | None = None, floor: float | None = None) -> Shape:
        """The same shape with more vertices on its boundary: every vertex stays, nothing moves.

        Parameters
        ----------
        spacing : float, optional
            Largest distance between neighbouring vertices, a length. By default it follows the local width: a
            quarter of the radius of the largest ball inside that touches there.
        floor : float, optional
            Without a spacing: the smallest radius that is followed into corners, where the width goes to
            zero; by default a two-hundredth of the largest one in 2D, a quarter of it in 3D. The default is
            raised where it would take some 60,000 samples (in 3D 30,000): needles keep balls that are too
            large, which `polyskel_lite.skeleton` tells.

        Returns
        -------
        Shape
            The vertices given come first, with their numbers. Balls of the samples that are larger than the
            floor then have the radius of the true ball, to 2 %.

        Raises
        ------
        InputError
            If spacing or floor is not a positive length, or asks for too many vertices.

        Examples
        --------
        >>> plan = Shape.from_rings([[(0, 0), (20, 0), (20, 4), (0, 4)]])
        >>> len(plan.densify(1.0).points), plan.densify().area()
        (48, 80.0)
        """
        spacing, floor = (
            None if value is None else as_number(value, name, "a positive length", 0, above=True)
            for name, value in (("spacing", spacing), ("floor", floor))
        )
        points, facets, tessellation = densified(self.points, self.facets, spacing, floor)
        return Shape(points, facets) if tessellation is None else Shape.refined(facets, tessellation)

    def _samples(self, n: int, start: float) -> list[np.ndarray]:
        only_in(2, self, "sample", "the vertices, or polyskel_lite.implicit.solid for a uniform mesh")
        return sample_rings([self.points[ring] for ring in self.rings()], n, start)
