"""Skeletons as abstract cell complexes, with the balls around their vertices."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..checks import as_array, as_indices, as_instance, as_number, as_path, as_points, library
from ..containment import DelaunayShape
from ..errors import InputError
from ..exact import Polygons, betti_numbers
from ..files import read_arrays, writing
from ..graphs import Tessellation
from ..tables import bounds_and_betti
from .readings import Readings

if TYPE_CHECKING:
    import networkx


@dataclass(frozen=True, eq=False, repr=False)
class Skeleton(Readings):
    """Vertices, edges and (in 3D) polygons of a skeleton, with the balls around its vertices.

    The complex is abstract: two vertices can stand at one place (cocircular samples) without being
    one. That is what keeps the homotopy of the shape (sections 3 and 3.4 of the paper).

    Attributes
    ----------
    vertices : (k, N) float array
        Voronoi vertices (and, in Sk3, the points where the boundary cuts Voronoi edges).
    radii : (k,) float array
        Distance from each vertex to its nearest samples, a length: the Delaunay balls.
    simplices : (k,) int array
        The Delaunay simplex whose dual each vertex is; -1 for the cut points of Sk3, and everywhere in the
        skeleton of a polyball.
    edges : (e, 2) int array
        Pairs of vertices.
    polygons : sequence of int arrays
        Vertices in order around their Delaunay edge; empty in 2D.
    rays : (r, N) float array
        Unit directions of unbounded edges.
    ray_vertices : (r,) int array
        The vertex at which each ray begins.
    tessellation : Tessellation or None
        Where ``simplices`` points to.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> rectangle = psl.Shape.from_rings([[(0, 0), (4, 0), (4, 1), (0, 1)]])
    >>> skeleton = psl.sk0(psl.conform(rectangle))
    >>> skeleton.betti()
    (1, 0)
    """

    vertices: NDArray[np.float64]
    radii: NDArray[np.float64]
    simplices: NDArray[np.int64]
    edges: NDArray[np.int64]
    polygons: Polygons = ()  # type: ignore[assignment] # these three as they can be given
    rays: NDArray[np.float64] = None  # type: ignore[assignment]
    ray_vertices: NDArray[np.int64] = None  # type: ignore[assignment]
    tessellation: Tessellation | None = None
    if TYPE_CHECKING:  # what is given may be any array-like, what is kept is an array

        def __init__(
            self,
            vertices: ArrayLike,
            radii: ArrayLike,
            simplices: ArrayLike,
            edges: ArrayLike,
            polygons: Sequence[ArrayLike] | Polygons = (),
            rays: ArrayLike | None = None,
            ray_vertices: ArrayLike | None = None,
            tessellation: Tessellation | None = None,
        ) -> None: ...

    #: `Polyball`, which puts itself here: its skeleton is a Skeleton, so the rooms cannot both import.
    _polyball: ClassVar[Callable[..., Any]]

    def _facts(self) -> Iterator[tuple[str, object]]:
        counts = {name: len(getattr(self, name)) for name in ("vertices", "edges", "polygons", "rays")}
        yield from (fact for fact in counts.items() if fact[1] or fact[0] in ("vertices", "edges"))
        yield from bounds_and_betti(self.vertices, self.betti)

    def __post_init__(self):
        self._check()
        if self.rays is None:
            object.__setattr__(self, "rays", np.zeros((0, np.shape(self.vertices)[1])))
            object.__setattr__(self, "ray_vertices", np.zeros(0, dtype=np.int64))
        # The integer that NumPy counts with: np.bincount(edges.ravel()) works in a browser too (32 bits).
        kinds = {"vertices": float, "radii": float, "simplices": np.int64, "edges": np.intp}
        for name, kind in {**kinds, "rays": float, "ray_vertices": np.int64}.items():
            object.__setattr__(self, name, np.asarray(getattr(self, name), dtype=kind))

    def _check(self) -> None:
        """Raise `InputError` unless the arrays fit together; every number is one of the kind it should be."""
        vertices, radii = as_array(self.vertices, "vertices"), as_array(self.radii, "radii")
        if vertices.ndim != 2 or vertices.shape[1] not in (2, 3) or radii.shape != vertices.shape[:1]:
            raise InputError(
                f"vertices has shape {vertices.shape} and radii {radii.shape}; pass (k, N) and (k,) arrays."
            )
        k, n = vertices.shape
        # The ball of a flat simplex is infinite, and nothing else is.
        bad = np.flatnonzero(np.isnan(vertices).any(axis=1) | ~(radii >= 0))
        bad = bad if len(bad) else np.flatnonzero(np.isinf(vertices).any(axis=1) & np.isfinite(radii))
        if len(bad):
            raise InputError(f"vertex {bad[0]} is {vertices[bad[0]]} with radius {radii[bad[0]]}; remove it.")
        t = self.tessellation
        if t is not None:
            as_instance(t, Tessellation, "tessellation", "a Tessellation, or None")
        most = np.iinfo(np.int64).max if t is None else len(t.simplices)
        simplices = as_indices(self.simplices, "simplices", most, low=-1)
        as_indices(self.edges, "edges", k, 2)
        if len(simplices) != k or (t is not None and t.dimension != n):
            raise InputError(
                f"{k} vertices in {n}D do not fit {len(simplices)} simplices or the tessellation."
            )
        object.__setattr__(self, "polygons", Polygons.of(self.polygons))
        as_indices(self.polygons.corners, "polygons", k)
        if self.rays is not None and len(as_points(self.rays, name="rays", dimensions=(n,))) != len(
            as_indices(self.ray_vertices, "ray_vertices", k)
        ):
            raise InputError(
                f"{len(self.ray_vertices)} ray_vertices for {len(self.rays)} rays; pass one each."
            )

    def contacts(self, vertex: int) -> NDArray[np.float64]:
        """The samples on the ball of a vertex that is dual to a simplex: its corners, (N + 1, N).

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> psl.voronoi([(0, 0), (2, 0), (0, 2)]).contacts(0).tolist()
        [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]]
        """
        k = len(self.vertices)
        vertex = as_number(vertex, "vertex", f"a vertex, 0 to {k - 1}", 0, k - 1, whole=True)
        if self.tessellation is None or self.simplices[vertex] < 0:
            raise InputError(f"vertex {vertex} is dual to no simplex of a tessellation; choose another one.")
        return self.tessellation.points[self.tessellation.simplices[self.simplices[vertex]]]

    def betti(self) -> tuple[int, ...]:
        """Betti numbers (b0, b1) in 2D, (b0, b1, b2) in 3D, of the abstract complex.

        A skeleton with rays is taken with the point at infinity, where its rays meet.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> psl.voronoi([(0, 0), (2, 0), (0, 2)]).betti()
        (1, 2)
        """
        n, edges = len(self.vertices), self.edges
        if len(self.rays):
            edges = np.concatenate([edges, np.stack([self.ray_vertices, np.full(len(self.rays), n)], axis=1)])
            n += 1
            if self.dimension == 3:
                raise InputError(
                    "Betti numbers of unbounded 3D skeletons are not defined here; use the inner side."
                )
        return betti_numbers(n, edges, self.polygons if self.dimension == 3 else None)

    def to_networkx(self) -> networkx.Graph:
        """The vertices and edges as a networkx graph (needs the extra ``graph``).

        Returns
        -------
        networkx.Graph
            Nodes 0 to k-1 with ``pos`` (tuple), ``radius`` and ``simplex``; edges with ``length``.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> graph = psl.voronoi([(0, 0), (4, 0), (0, 2), (4, 3)]).to_networkx()
        >>> graph.number_of_nodes(), round(graph.edges[0, 1]["length"], 3)
        (2, 0.559)
        """
        networkx = library("networkx")
        graph = networkx.Graph()
        rows = zip(self.vertices.tolist(), self.radii.tolist(), self.simplices.tolist(), strict=True)
        graph.add_nodes_from(
            (k, {"pos": tuple(p), "radius": r, "simplex": s}) for k, (p, r, s) in enumerate(rows)
        )
        pairs = zip(self.edges.tolist(), self.lengths().tolist(), strict=True)
        graph.add_edges_from((a, b, {"length": length}) for (a, b), length in pairs)
        return graph

    def balls(self) -> Any:
        """The union of the balls around the vertices: Y_w of section 3.2 when the skeleton is Sk1 or Sk2.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> psl.voronoi([(0, 0), (2, 0), (0, 2)]).balls().radii.round(3).tolist()
        [1.414]
        """
        # Vertices that are dual to no simplex are cuts of Sk3; the skeleton of a polyball has no others.
        keep = (self.simplices >= 0) | (self.tessellation is None)
        return self._polyball(self.vertices[keep], self.radii[keep])

    def reconstruct(self) -> DelaunayShape:
        """The union of the simplices dual to the vertices: for Sk0 the shape itself (reversibility, 3.4).

        Raises
        ------
        InputError
            If the skeleton was loaded or made without its tessellation.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> triangle = psl.Shape.from_rings([[(0, 0), (4, 0), (0, 3)]])
        >>> psl.sk0(triangle).reconstruct().boundary().tolist()
        [[0, 1], [1, 2], [2, 0]]
        """
        if self.tessellation is None:
            raise InputError(
                "this skeleton has no tessellation; compute it from a shape, or load one saved with it."
            )
        inner = np.zeros(len(self.tessellation.simplices), dtype=bool)
        inner[self.simplices[self.simplices >= 0]] = True
        return DelaunayShape(self.tessellation, inner)

    def save(self, path: str | PathLike) -> None:
        """Write the skeleton, with its tessellation, to a NumPy ``.npz`` file.

        Examples
        --------
        >>> import polyskel_lite as psl, tempfile, pathlib
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "skeleton.npz"
        >>> psl.voronoi([(0, 0), (2, 0), (0, 2)]).save(path)
        >>> Skeleton.load(path).vertices.tolist()
        [[1.0, 1.0]]
        """
        data = {name: getattr(self, name) for name in _ARRAYS}
        data |= {"polygon_sizes": self.polygons.sizes, "polygon_corners": self.polygons.corners}
        if self.tessellation is not None:
            data |= {f"tessellation_{name}": getattr(self.tessellation, name) for name in _TESSELLATION}
        with writing(path) as path, path.open("wb") as file:
            np.savez_compressed(file, **data)

    @classmethod
    def load(cls, path: str | PathLike) -> Skeleton:
        """Read a skeleton written by `save`.

        Raises
        ------
        InputError
            If the file is not such a file.

        Examples
        --------
        >>> import tempfile
        >>> with tempfile.NamedTemporaryFile() as file:
        ...     Skeleton.load(file.name)  # doctest: +ELLIPSIS
        Traceback (most recent call last):
        polyskel_lite.errors.InputError: ...
        """
        path = as_path(path)
        try:
            data, tessellation = read_arrays(path), None
            polygons = Polygons(data["polygon_corners"], data["polygon_sizes"])
            if "tessellation_points" in data:
                tessellation = Tessellation(*(data[f"tessellation_{name}"] for name in _TESSELLATION))
            arrays = {name: data[name] for name in _ARRAYS}
            return cls(**arrays, polygons=polygons, tessellation=tessellation)
        except (InputError, KeyError) as error:
            reason = f"there is no array {error.args[0]}." if isinstance(error, KeyError) else error
            raise InputError(
                f"{path.name[:60]} is not a skeleton written by Skeleton.save, or damaged: {reason}"
            ) from None


_ARRAYS = ("vertices", "radii", "simplices", "edges", "rays", "ray_vertices")
_TESSELLATION = ("points", "simplices", "neighbors")
