"""Branches of a skeleton: chains of edges between junctions and ends (section 4.3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..checks import as_instance, library
from ..exact import components, occurrences, spread_out
from .complexes import BallComplex

if TYPE_CHECKING:
    import networkx


def branch_graph(skeleton: BallComplex) -> networkx.MultiGraph:
    """The branches of a skeleton as a networkx multigraph (needs the extra ``graph``).

    Polygons stay what they are: only edges that bound no polygon are chained. The sheets, sets of
    polygons connected through their edges, become one node each, so that a branch can end on a sheet.

    Parameters
    ----------
    skeleton : Skeleton

    Returns
    -------
    networkx.MultiGraph
        Nodes: skeleton vertices that are ends or junctions, with ``kind`` ("end", "junction", "sheet",
        "loop", "point"), ``pos`` and ``radius`` (sheets: ``vertices`` instead). Edges: one a branch, with
        ``path`` (vertex numbers), ``length``, ``smooth_length`` (see `smooth_lengths`), ``radii`` along it,
        and ``mean_radius``, the mean of these by length.
        ``graph.graph["branches"]`` is the number of ends, which is what the paper counts.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> rectangle = psl.conform(psl.Shape.from_rings([[(0, 0), (6, 0), (6, 2), (0, 2)]]))
    >>> graph = branch_graph(psl.sk0(rectangle))
    >>> sorted(kind for _, kind in graph.nodes(data="kind"))
    ['end', 'end']
    """
    as_instance(skeleton, BallComplex, "skeleton", "a Skeleton, such as sk0(shape)")
    networkx = library("networkx")
    node, sheets = _sheet_of(skeleton)
    n, k = len(skeleton.vertices), len(sheets)
    wires = skeleton.edges[free_edges(skeleton)]
    ends = np.where(node[wires] >= 0, n + node[wires], wires)
    degree = occurrences(ends, n + k)
    # Where branches begin: everything but the inside of a chain; a sheet always.
    stop = (degree[:n] != 2) & (node < 0)
    begins = np.append(stop, np.ones(k, dtype=bool))
    graph = networkx.MultiGraph()
    for v in np.flatnonzero(stop).tolist():
        kind = {0: "point", 1: "end"}.get(int(degree[v]), "junction")
        graph.add_node(v, kind=kind, **_place(skeleton, v))
    for s, members in enumerate(sheets):
        graph.add_node(n + s, kind="sheet", vertices=members)
    # Inside a chain, the number of the next edge is the sum of its vertex minus the number of the last one.
    total = np.zeros(n + k, dtype=np.int64)
    for column in ends.T:
        np.add.at(total, column, np.arange(len(wires)))
    first = [(e, side) for e in np.flatnonzero(begins[ends].any(axis=1)).tolist() for side in (0, 1)]
    total, begins, ends, wires = total.tolist(), begins.tolist(), ends.T.tolist(), wires.T.tolist()
    used = [False] * len(ends[0])

    def walk(e, side):
        start, path = ends[side][e], [wires[side][e]]
        while True:
            used[e] = True
            path.append(wires[1 - side][e])
            at = ends[1 - side][e]
            if begins[at] or at == start:
                break
            e = total[at] - e
            side = int(ends[1][e] == at)
        if start >= n and len(path) == 2:
            path = [wires[0][e], wires[1][e]]
        graph.add_edge(start, at, path=path)

    for e, side in sorted(first, key=lambda place: ends[place[1]][place[0]]):
        if begins[ends[side][e]] and not used[e]:
            walk(e, side)
    for e, start in enumerate(ends[0]):  # what is left are closed chains
        if not used[e]:
            graph.add_node(start, kind="loop", **_place(skeleton, start))
            walk(e, 0)
    paths = [path for _, _, path in graph.edges(data="path")]
    places = np.concatenate([np.zeros(0, dtype=np.intp), *paths]).astype(np.intp)
    points, radii = skeleton.vertices[places], skeleton.radii[places]
    # Lengths of any unit are ordinary floats in this one; a power of two changes no digit.
    exponent = int(np.frexp(max(np.abs(points).max(initial=0.0), radii.max(initial=0.0)))[1])
    points, radii = np.ldexp(points, -exponent), np.ldexp(radii, -exponent)
    smooth = smooth_lengths(points, radii, [len(path) for path in paths])
    pieces, end = np.linalg.norm(np.diff(points, axis=0), axis=1), 0
    for (_, _, data), length in zip(graph.edges(data=True), smooth, strict=True):
        at, end = end, end + len(data["path"])
        raw, r = pieces[at : end - 1], radii[at:end]
        mean = (raw * (r[1:] + r[:-1]) / 2).sum() / raw.sum() if raw.sum() > 0 else r.mean()
        numbers = np.ldexp([raw.sum(), length, mean], exponent).tolist()
        data |= dict(zip(("length", "smooth_length", "mean_radius"), numbers, strict=True))
        data["radii"] = np.ldexp(r, exponent).tolist()
    graph.graph["branches"] = sum(kind == "end" for _, kind in graph.nodes(data="kind"))
    return graph


def _place(skeleton, v):
    return {"pos": tuple(skeleton.vertices[v].tolist()), "radius": float(skeleton.radii[v])}


def smooth_chains(points: np.ndarray, radii: np.ndarray, sizes) -> tuple[np.ndarray, np.ndarray]:
    """Chains of Voronoi vertices without their zigzag between the samples.

    Every point of a chain is replaced by the mean of the piece around it that is as long as its radius, half
    to each side, shorter towards the ends, which stay.

    Parameters
    ----------
    points : (k, N) float array
        Of all chains, one after the other.
    radii : (k,) float array
    sizes : (m,) int array
        How many points each chain has, two at least.

    Returns
    -------
    points : (s, N) float array
        Seen from the beginning of the chain: four for each vertex, at equal steps, and the end of the chain.
    radii : (s,) float array

    Examples
    --------
    >>> x = np.arange(0, 16.25, 0.25)
    >>> zigzag = np.column_stack([x, 0.1 * (np.arange(len(x)) % 2)])
    >>> places, radii = smooth_chains(zigzag, np.full(len(x), 2.0), [len(x)])
    >>> len(places), places[130].round(2).tolist(), float(radii[130])
    (261, [8.0, 0.05], 2.0)
    """
    sizes = np.asarray(sizes, dtype=np.intp)
    first, last = np.cumsum(sizes) - sizes, np.cumsum(sizes) - 1
    # Seen from their own beginning, chains far from the origin lose no digits in the integral below.
    points = points - np.repeat(points[first], sizes, axis=0)
    pieces = np.linalg.norm(np.diff(points, axis=0), axis=1)
    pieces[last[:-1]] = 0  # from one chain to the next
    along = np.concatenate([[0.0], np.cumsum(pieces)])
    # The integral of the chains up to each vertex; within a piece it is a parabola.
    steps = pieces[:, None] * (points[1:] + points[:-1]) / 2
    integral = np.concatenate([np.zeros_like(points[:1]), np.cumsum(steps, axis=0)])
    count = 4 * sizes + 1
    chain, place = spread_out(count)
    share = place / (count - 1)[chain]
    begin, end = along[first][chain], along[last][chain]
    s = begin + share * (end - begin)

    def vertex_before(s):
        return np.clip(np.searchsorted(along, s, side="right") - 1, first[chain], last[chain] - 1)

    def at(s, k):
        part = ((s - along[k]) / np.where(pieces[k] > 0, pieces[k], 1))[:, None]
        return points[k] + part * (points[k + 1] - points[k])

    def up_to(s):
        k = vertex_before(s)
        return integral[k] + (s - along[k])[:, None] * (points[k] + at(s, k)) / 2

    k = vertex_before(s)
    part = (s - along[k]) / np.where(pieces[k] > 0, pieces[k], 1)
    radii = radii[k] + part * (radii[k + 1] - radii[k])
    half = np.minimum(radii / 2, np.minimum(s - begin, end - s))
    wide = ((half > 0) & (share > 0) & (share < 1))[:, None]  # the ends stay
    mean = (up_to(s + half) - up_to(s - half)) / np.where(wide, 2 * half[:, None], 1)
    return np.where(wide, mean, at(s, k)), radii


def smooth_lengths(points: np.ndarray, radii: np.ndarray, sizes) -> np.ndarray:
    """Lengths of the chains that `smooth_chains` makes, (m,) float array.

    Examples
    --------
    >>> x = np.arange(0, 16.25, 0.25)
    >>> zigzag = np.column_stack([x, 0.1 * (np.arange(len(x)) % 2)])
    >>> raw = float(np.linalg.norm(np.diff(zigzag, axis=0), axis=1).sum())
    >>> round(raw, 1), smooth_lengths(zigzag, np.full(len(x), 2.0), [len(x)]).round(1).tolist()
    (17.2, [16.0])
    """
    if not len(sizes):
        return np.zeros(0)
    count = 4 * np.asarray(sizes, dtype=np.intp) + 1
    ways = np.append(np.linalg.norm(np.diff(smooth_chains(points, radii, sizes)[0], axis=0), axis=1), 0.0)
    ways[np.cumsum(count) - 1] = 0  # from one chain to the next
    return np.add.reduceat(ways, np.cumsum(count) - count)


def free_edges(skeleton: BallComplex) -> np.ndarray:
    """Rows of ``edges`` that are the side of no polygon: the wires.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> edges = np.array([(0, 1), (1, 2), (2, 0), (2, 3)])
    >>> flag = psl.Skeleton(np.zeros((4, 3)), np.ones(4), np.arange(4), edges, [[0, 1, 2]])
    >>> free_edges(flag).tolist()
    [3]
    """
    if not len(skeleton.polygons):
        return np.arange(len(skeleton.edges))
    n = len(skeleton.vertices)
    sides = skeleton.polygons.sides()
    key = np.sort(skeleton.edges, axis=1) @ np.array([n, 1])
    return np.flatnonzero(~np.isin(key, np.sort(sides, axis=1) @ np.array([n, 1])))


def _sheet_of(skeleton: BallComplex):
    """For each vertex the sheet it is on, or -1, and the vertices of each sheet."""
    n = len(skeleton.vertices)
    node = np.full(n, -1)
    if not len(skeleton.polygons):
        return node, []
    _, label = components(n, skeleton.polygons.sides())
    on = np.unique(skeleton.polygons.corners)
    _, node[on] = np.unique(label[on], return_inverse=True)
    return node, [np.flatnonzero(node == s) for s in range(node.max() + 1)]
