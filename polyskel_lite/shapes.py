"""Shapes by their boundary, and samplings of it (the paper's section 2.1)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Integral
from os import PathLike

import numpy as np
from scipy.spatial import cKDTree

from ._rings import as_facets, check_closed, near, nesting, ring_facets, rings_of, turn_of
from .errors import DuplicatePointError, InputError, ShapeError
from .meshes import check_mesh, mesh_betti, mesh_covering_radius, signed_volume, turned
from .predicates import as_points
from .segments import distance_to_segments, first_meeting, locate
from .triangles import distance_to_triangles, locate_in_mesh


def check_distinct(points: np.ndarray, name: str = "points") -> None:
    """Raise `DuplicatePointError` naming the first two equal rows.

    Examples
    --------
    >>> check_distinct(np.array([[0.0, 1.0], [1.0, 0.0]]))
    """
    if not len(points):
        return
    order = np.lexsort(points.T[::-1])
    same = (points[order[1:]] == points[order[:-1]]).all(axis=1)
    if same.any():
        # lexsort is stable, so the first index of an equal pair is the smaller one.
        pairs = np.sort(np.stack([order[:-1][same], order[1:][same]], axis=1), axis=1)
        i, j = pairs[np.lexsort(pairs.T[::-1])[0]]
        where = ", ".join(f"{x:g}" for x in points[i])
        raise DuplicatePointError(f"{name} {i} and {j} are both at ({where}); keep one of them.")


def check_shape(shape) -> None:
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


@dataclass(frozen=True, eq=False)
class Shape:
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

    points: np.ndarray
    facets: np.ndarray

    def __post_init__(self):
        points = as_points(self.points, dimensions=(2, 3))
        facets = as_facets(self.facets, len(points), points.shape[1])
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "facets", facets)
        if self.dimension == 3:
            check_distinct(points)
            check_mesh(points, facets)
        else:
            check_closed(len(points), facets)
            check_distinct(points)
            self._check_meetings()
            self._check_orientation()
        points.setflags(write=False)
        facets.setflags(write=False)

    @classmethod
    def from_rings(cls, rings: Sequence) -> Shape:
        """Make a shape from closed rings of any orientation; rings inside rings are holes (even-odd).

        Parameters
        ----------
        rings : list of (k, 2) array-like
            Vertices in order. The last one may repeat the first.

        Returns
        -------
        Shape
            Outer rings turned counter-clockwise, holes clockwise; the order of the rings is kept.

        Raises
        ------
        InputError, DuplicatePointError, ShapeError
            As `Shape`; a ring with fewer than three vertices is named by its index.

        Examples
        --------
        >>> square = np.array([(0, 0), (3, 0), (3, 3), (0, 3)])
        >>> frame = Shape.from_rings([square, square / 3 + 1])
        >>> frame.betti(), round(frame.area(), 12)
        ((1, 1), 8.0)
        """
        if not np.iterable(rings) or not len(rings):
            raise InputError("rings is empty or no list; pass at least one ring of three vertices.")
        cleaned = []
        for k, ring in enumerate(rings):
            ring = as_points(ring, name=f"ring {k}", dimensions=(2,))
            if len(ring) > 1 and (ring[0] == ring[-1]).all():
                ring = ring[:-1]
            if len(ring) < 3:
                raise InputError(f"ring {k} has {len(ring)} different vertices; a ring needs at least three.")
            cleaned.append(ring)
        depth, turn = nesting(cleaned)
        rings = [
            ring if (turn[k] > 0) == (depth[k] % 2 == 0) else np.roll(ring[::-1], 1, axis=0)
            for k, ring in enumerate(cleaned)
        ]
        return cls(np.concatenate(rings), ring_facets([len(r) for r in rings]))

    @classmethod
    def from_mesh(cls, V, F, turn: bool = False) -> Shape:
        """Make a solid from a closed triangle mesh.

        Parameters
        ----------
        V : (n, 3) array-like
            Vertices; those in no face are dropped.
        F : (m, 3) array-like of int
            Triangles.
        turn : bool
            Turn surfaces that are inside out: outer ones outward, cavities inward.

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
        F = as_facets(F, len(V), 3)
        used, faces = np.unique(F, return_inverse=True)
        V, F = V[used], faces.reshape(-1, 3)
        return cls(V, turned(V, F) if turn else F)

    @classmethod
    def from_mask(cls, image, level: float = 0.5, **options) -> Shape:
        """Make a shape from a picture by marching squares; see `polyskel_lite.readers.from_mask`.

        Examples
        --------
        >>> Shape.from_mask(np.ones((4, 4))).betti()
        (1, 0)
        """
        from .readers import from_mask

        return from_mask(image, level, **options)

    @classmethod
    def from_file(cls, path: str | PathLike, **options) -> Shape:
        """Read a shape from GeoJSON, SVG, PNG, STL, PLY, OBJ or OFF; see `polyskel_lite.readers.from_file`.

        Examples
        --------
        >>> Shape.from_file("outline.xyz")  # doctest: +ELLIPSIS
        Traceback (most recent call last):
        polyskel_lite.errors.InputError: ...
        """
        from .readers import from_file

        return from_file(path, **options)

    def to_file(self, path: str | PathLike) -> None:
        """Write the boundary as PLY, OBJ, glTF (.glb) or VTK (.vtk, .vtu), in 3D also as STL or OFF.

        Needs the extra ``meshes``. PLY, OBJ, OFF and VTK keep the coordinates to the last bit; STL and
        glTF round them to single precision. See `polyskel_lite.mesh_files.write_shape`.

        Examples
        --------
        >>> Shape.from_rings([[(0, 0), (2, 0), (0, 2)]]).to_file("triangle.stl")  # doctest: +ELLIPSIS
        Traceback (most recent call last):
        polyskel_lite.errors.InputError: triangle.stl: a shape in the plane cannot be written as '.stl'; ...
        """
        from .mesh_files import write_shape

        write_shape(self, path)

    @property
    def dimension(self) -> int:
        """N, the dimension of the space."""
        return self.points.shape[1]

    @property
    def segments(self) -> np.ndarray:
        """The corners of every facet, (m, N, N): the ends of segments in 2D, of triangles in 3D."""
        return self.points[self.facets]

    def _require(self, dimension: int, name: str, instead: str) -> None:
        if self.dimension != dimension:
            where = "the plane" if dimension == 2 else "space"
            raise InputError(
                f"{name}() is for shapes in {where}; this one is in {self.dimension}D: use {instead}."
            )

    def rings(self) -> list[np.ndarray]:
        """The vertex indices of every closed curve in order, starting at its smallest index (2D only).

        Examples
        --------
        >>> Shape([(0, 0), (1, 0), (0, 1)], [(1, 2), (0, 1), (2, 0)]).rings()
        [array([0, 1, 2])]
        """
        self._require(2, "rings", "facets")
        return rings_of(self.facets)

    def contains(self, queries) -> np.ndarray:
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

    def locate(self, queries) -> np.ndarray:
        """+1 for queries in the interior, 0 on the boundary, -1 outside; exact.

        Examples
        --------
        >>> square = Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]])
        >>> square.locate([(1, 1), (2, 1), (3, 1)])
        array([ 1,  0, -1], dtype=int8)
        """
        queries = as_points(queries, name="queries", dimensions=(self.dimension,))
        return (locate if self.dimension == 2 else locate_in_mesh)(self.segments, queries)

    def boundary_distance(self, queries) -> np.ndarray:
        """Distance (a length, never negative) from each query to the boundary.

        Examples
        --------
        >>> square = Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]])
        >>> square.boundary_distance([(1, 1), (5, 6)])
        array([1., 5.])
        """
        queries = as_points(queries, name="queries", dimensions=(self.dimension,))
        distance = distance_to_segments if self.dimension == 2 else distance_to_triangles
        return distance(self.segments, queries)

    def sample(self, n: int, start: float = 0.0) -> np.ndarray:
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
        return np.concatenate(self._sample_rings(n, start))

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
        rings = self._sample_rings(n, start)
        try:
            return Shape(np.concatenate(rings), ring_facets([len(r) for r in rings]))
        except ShapeError as error:
            raise ShapeError(f"{n} samples are too few for this shape: {error}") from None

    def _sample_rings(self, n: int, start: float) -> list[np.ndarray]:
        self._require(2, "sample", "the vertices, or polyskel_lite.implicit.solid for a uniform mesh")
        closed = [self.points[np.append(ring, ring[0])] for ring in self.rings()]
        along = [np.concatenate([[0], np.cumsum(np.hypot(*np.diff(c, axis=0).T))]) for c in closed]
        if not isinstance(n, Integral):
            raise InputError(f"n is {n!r}; pass a whole number of samples.")
        if not np.isfinite(start):
            raise InputError(f"start is {start!r}; pass a share of one step, such as 0.5.")
        if n < 3 * len(closed):
            raise InputError(f"n = {n} samples for {len(closed)} rings; every ring needs at least three.")
        lengths = np.array([s[-1] for s in along])
        # Largest remainders: the shares are fair and sum to n.
        ideal = n * lengths / lengths.sum()
        share = np.maximum(3, np.floor(ideal)).astype(int)
        while share.sum() != n:
            step = 1 if share.sum() < n else -1
            gain = np.where((step < 0) & (share <= 3), -np.inf, step * (ideal - share))
            share[np.argmax(gain)] += step
        out = []
        for c, s, k in zip(closed, along, share, strict=True):
            at = (np.arange(k) + start) * s[-1] / k % s[-1]
            out.append(np.stack([np.interp(at, s, c[:, 0]), np.interp(at, s, c[:, 1])], axis=1))
        return out

    def covering_radius(self, E=None) -> float:
        """w⁻¹, the largest distance from a boundary point to the samples (section 2.1); a length.

        Parameters
        ----------
        E : (n, N) array-like, optional
            The samples; by default the vertices of the shape.

        Returns
        -------
        float
            Right to about 1e-9 of itself (1e-6 in 3D): facets are cut as long as a piece could hold the
            maximum.

        Examples
        --------
        >>> square = Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]])
        >>> round(square.covering_radius(), 6)
        1.0
        """
        E = self.points if E is None else as_points(E, name="E", dimensions=(self.dimension,))
        if not len(E):
            raise InputError("E is empty; pass at least one sample.")
        tree = cKDTree(E)
        best = float(max(tree.query(self.points)[0].max(), 0.0))
        if self.dimension == 3:
            return mesh_covering_radius(self.segments, tree, best)
        a, b = self.segments[:, 0], self.segments[:, 1]
        # Far from the origin floats are too coarse to say more.
        coarse = 16 * np.finfo(float).eps * np.abs(self.points).max()
        while len(a):
            middle, half = (a + b) / 2, np.hypot(*(b - a).T) / 2
            distance = tree.query(middle)[0]
            best = max(best, float(distance.max()))
            # The distance to E changes by at most the way walked, so other segments cannot beat `best`.
            keep = distance + half > best * (1 + 1e-9) + coarse
            a, b, middle = a[keep], b[keep], middle[keep]
            a, b = np.concatenate([a, middle]), np.concatenate([middle, b])
        return best

    def sampling_density(self, E=None) -> float:
        """The paper's w (section 2.1): one over the largest distance from the boundary to the samples.

        Parameters
        ----------
        E : (n, N) array-like, optional
            The samples; by default the vertices of the shape.

        Returns
        -------
        float
            One over a length; infinite if E covers the boundary, which no finite set does.

        See Also
        --------
        covering_radius : w⁻¹ itself.

        Examples
        --------
        >>> square = Shape.from_rings([[(0, 0), (4, 0), (4, 4), (0, 4)]])
        >>> round(square.sampling_density(), 6)
        0.5
        """
        return 1 / self.covering_radius(E)

    def area(self) -> float:
        """Area of the region (2D only; in space there are `volume` and `surface`).

        Examples
        --------
        >>> Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).area()
        4.0
        """
        self._require(2, "area", "volume() or surface()")
        a, b = (self.segments - self.points.mean(axis=0)).transpose(1, 0, 2)
        return float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2)

    def length(self) -> float:
        """Length of the boundary, holes included (2D only).

        Examples
        --------
        >>> Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).length()
        8.0
        """
        self._require(2, "length", "surface()")
        return float(np.hypot(*(self.segments[:, 1] - self.segments[:, 0]).T).sum())

    def volume(self) -> float:
        """Volume of the solid, without its cavities (3D only).

        Examples
        --------
        >>> corner = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        >>> Shape([(0, 0, 0), (3, 0, 0), (0, 3, 0), (0, 0, 4)], corner).volume()
        6.0
        """
        self._require(3, "volume", "area()")
        return signed_volume(self.segments)

    def surface(self) -> float:
        """Area of the boundary, cavities included (3D only).

        Examples
        --------
        >>> corner = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        >>> round(Shape([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], corner).surface(), 6)
        2.366025
        """
        self._require(3, "surface", "length()")
        a, b, c = self.segments.transpose(1, 0, 2)
        return float(np.sqrt((np.cross(b - a, c - a) ** 2).sum(axis=1)).sum() / 2)

    def measure(self) -> float:
        """Area in 2D, volume in 3D.

        Examples
        --------
        >>> Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).measure()
        4.0
        """
        return self.area() if self.dimension == 2 else self.volume()

    def boundary_measure(self) -> float:
        """Length of the boundary in 2D, its area in 3D.

        Examples
        --------
        >>> Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).boundary_measure()
        8.0
        """
        return self.length() if self.dimension == 2 else self.surface()

    def betti(self) -> tuple[int, ...]:
        """Betti numbers of the region: (components, holes) in 2D, (components, handles, cavities) in 3D.

        Examples
        --------
        >>> Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).betti()
        (1, 0)
        """
        if self.dimension == 3:
            return mesh_betti(self.points, self.facets)
        turns = [turn_of(self.points[ring]) for ring in self.rings()]
        return turns.count(1), turns.count(-1)

    def _check_meetings(self) -> None:
        meeting = first_meeting(self.points, self.facets)
        if meeting:
            i, j = meeting
            (a, b), (c, d) = self.facets[i], self.facets[j]
            raise ShapeError(
                f"segment {i} (vertices {a}-{b}) meets segment {j} (vertices {c}-{d}) near "
                f"{near(self.points[self.facets[i]])}; a boundary may not cross or touch itself: move a "
                "vertex."
            )

    def _check_orientation(self) -> None:
        rings = self.rings()
        depth, turn = nesting([self.points[ring] for ring in rings])
        for k, ring in enumerate(rings):
            if (turn[k] > 0) != (depth[k] % 2 == 0):
                kind = (
                    "an outer ring runs clockwise" if depth[k] % 2 == 0 else "a hole runs counter-clockwise"
                )
                raise ShapeError(
                    f"{kind}: the ring through vertex {ring[0]} at {near(self.points[ring[:1]])} has its "
                    "interior on the right; reverse its segments, or use Shape.from_rings."
                )
