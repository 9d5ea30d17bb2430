"""Lines through a skeleton: the main axis, and the width at stations along a line."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from ..checks import as_number
from ..errors import InputError
from ..exact import components, occurrences
from .branches import smooth_chains, smooth_lengths
from .complexes import BallComplex

_SOURCES = 64  # of shortest paths that are looked for at once
_MOST_STATIONS = 1_000_000


class Stations(NamedTuple):
    """Widths along an axis: what `Axis.stations` returns.

    Attributes
    ----------
    along : (s,) float array
        Length from the beginning of the axis, without its zigzag.
    points : (s, N) float array
    widths : (s,) float array
        Diameters of the balls there.
    """

    along: NDArray[np.float64]
    points: NDArray[np.float64]
    widths: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Axis:
    """A line through a skeleton, from vertex to vertex: its main axis or a branch.

    Attributes
    ----------
    vertices : (k,) int array
        Numbers of the skeleton's vertices in order; a closed line ends where it begins.
    points : (k, N) float array
    radii : (k,) float array

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> bar = psl.skeleton([[(0, 0), (20, 0), (20, 4), (0, 4)]])
    >>> axis = bar.skeleton.main_axis()
    >>> axis, axis.stations(4).widths.round(1).tolist()
    (Axis(106 vertices, length 15.99), [4.0, 4.0, 4.0, 4.0, 4.0])
    """

    vertices: NDArray[np.int64]
    points: NDArray[np.float64]
    radii: NDArray[np.float64]

    def __repr__(self) -> str:
        return f"Axis({len(self.vertices):,} vertices, length {self.length:.4g})"

    @property
    def length(self) -> float:
        """Of its edges, with their zigzag between the samples."""
        return float(np.hypot.reduce(np.diff(self.points, axis=0), axis=1).sum())

    @property
    def smooth_length(self) -> float:
        """Without the zigzag; see `smooth_lengths`."""
        points, radii, exponent = self._ordinary()
        sizes = [len(points)] if len(points) > 1 else []
        return float(np.ldexp(smooth_lengths(points, radii, sizes).sum(), exponent))

    def stations(self, spacing: float | None = None) -> Stations:
        """Places at equal distances along the axis, from end to end, and how wide the shape is there.

        The width is the diameter of the ball: twice the distance to the nearest samples. Twice
        ``shape.boundary_distance(stations.points)`` is that to the boundary itself.

        Parameters
        ----------
        spacing : float, optional
            The largest distance between neighbouring stations; by default the mean radius.

        Returns
        -------
        Stations

        Raises
        ------
        InputError
            If the spacing is no positive length, or asks for more than a million stations.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> wedge = psl.skeleton([[(0, 4), (30, 6), (30, 14), (0, 16)]]).skeleton.main_axis()
        >>> wedge.stations(5).widths.round(1).tolist()
        [11.2, 10.7, 10.2, 9.7, 9.1, 8.6]
        """
        if len(self.points) == 1:
            return Stations(np.zeros(1), self.points.copy(), 2 * self.radii)
        points, radii, exponent = self._ordinary()
        places, r = smooth_chains(points, radii, [len(points)])
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(places, axis=0), axis=1))])
        least = float(np.ldexp(along[-1], exponent)) / _MOST_STATIONS
        if spacing is None:
            step = max(float(r.mean()), along[-1] / _MOST_STATIONS)
        else:
            what = f"a positive length, {least:.1g} or more"
            step = np.ldexp(as_number(spacing, "spacing", what, least, above=True), -exponent)
        at = np.linspace(0, along[-1], int(np.ceil(along[-1] / step * (1 - 1e-12))) + 1)
        points = np.stack([np.interp(at, along, x) for x in places.T], axis=1)
        numbers = at, points + np.ldexp(self.points[0], -exponent), 2 * np.interp(at, along, r)
        return Stations(*(np.ldexp(array, exponent) for array in numbers))

    def _ordinary(self) -> tuple[np.ndarray, np.ndarray, int]:
        """Points and radii in a unit in which squares are ordinary floats, and its exponent of two."""
        exponent = int(np.frexp(max(np.abs(self.points).max(), self.radii.max()))[1])
        return np.ldexp(self.points, -exponent), np.ldexp(self.radii, -exponent), exponent


def axis_of(skeleton: BallComplex, vertices: ArrayLike) -> Axis:
    """The axis through some vertices of a skeleton, in order.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> axis_of(psl.voronoi([(0, 0), (4, 0), (0, 2), (4, 3)]), [0, 1])
    Axis(2 vertices, length 0.559)
    """
    vertices = np.asarray(vertices, dtype=np.int64)
    return Axis(vertices, skeleton.vertices[vertices], skeleton.radii[vertices])


def longest_path(skeleton: BallComplex) -> list[int]:
    """The vertices of the longest of all shortest paths; see `Skeleton.main_axis`.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> longest_path(psl.voronoi([(0, 0), (4, 0), (0, 2), (4, 3)]))
    [0, 1]
    """
    finite = np.asarray(np.isfinite(skeleton.vertices).all(axis=1))
    if not finite.any():
        raise InputError("the skeleton has no vertex, and so no axis; take another threshold or method.")
    edges = np.unique(np.sort(skeleton.edges[finite[skeleton.edges].all(axis=1)], axis=1), axis=0)
    exponent = int(np.frexp(np.abs(skeleton.vertices[finite]).max())[1])
    d = np.ldexp(skeleton.vertices[edges[:, 1]] - skeleton.vertices[edges[:, 0]], -exponent)
    # Cocircular samples have vertices at one place: a path through them is no longer, but it is one.
    lengths = np.maximum(np.linalg.norm(d, axis=1), 1e-300)
    count, label = components(len(finite), edges)
    label = label[edges[:, 0]]
    total = np.bincount(label, lengths, minlength=count)
    best = 0.0, [int(np.where(finite, skeleton.radii, -1).argmax())]
    for c in np.argsort(-total, kind="stable"):
        if total[c] <= best[0]:  # no path is longer than all edges together
            break
        members, local = np.unique(edges[label == c], return_inverse=True)
        length, path = _longest(local.reshape(-1, 2), lengths[label == c])
        if length > best[0]:
            best = length, members[path].tolist()
    return best[1]


def _longest(edges: np.ndarray, lengths: np.ndarray) -> tuple[float, list[int]]:
    """The longest shortest path of a connected graph, or the whole of a closed line."""
    n = int(edges.max()) + 1
    if (occurrences(edges, n) == 2).all():
        length, path = _path(_graph(n, edges[1:], lengths[1:]), *edges[0])
        return length + lengths[0], [*path, path[0]]
    graph = _graph(n, edges, lengths)
    a = int(dijkstra(graph, indices=0).argmax())
    ways = dijkstra(graph, indices=a)
    length, path = _path(graph, a, int(ways.argmax()))
    if len(edges) == n - 1:  # in a tree that is it
        return length, path
    # One end of a longer path is farther from any vertex than half of it: those far from a middle are tried.
    away = dijkstra(graph, indices=path[np.abs(ways[path] - length / 2).argmin()])
    order = np.argsort(-away, kind="stable")
    for sources in np.split(order, range(_SOURCES, n, _SOURCES)):
        if 2 * away[sources[0]] <= length:
            break
        ways = dijkstra(graph, indices=sources)
        source, end = np.unravel_index(ways.argmax(), ways.shape)
        if ways[source, end] > length * (1 + 1e-12):
            length, path = _path(graph, int(sources[source]), int(end))
    return length, path


def _graph(n: int, edges: np.ndarray, lengths: np.ndarray) -> csr_array:
    ends = np.concatenate([edges, edges[:, ::-1]])
    return csr_array((np.tile(lengths, 2), tuple(ends.T)), shape=(n, n))


def _path(graph: csr_array, start: int, end: int) -> tuple[float, list[int]]:
    lengths, before = dijkstra(graph, indices=start, return_predecessors=True)
    path = [int(end)]
    while path[-1] != start:
        path.append(int(before[path[-1]]))
    return float(lengths[end]), path
