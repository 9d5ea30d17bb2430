"""Branches of a skeleton: chains of edges between junctions and ends (section 4.3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..checks import as_instance
from ..errors import InputError
from ..exact import components, occurrences
from .skeleton import Skeleton

if TYPE_CHECKING:
    import networkx


def branch_graph(skeleton: Skeleton) -> networkx.MultiGraph:
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
        ``path`` (vertex numbers), ``length``, ``smooth_length`` (see `smooth_length`), ``radii`` along it.
        ``graph.graph["branches"]`` is the number of ends, which is what the paper counts.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> rectangle = psl.conform(psl.Shape.from_rings([[(0, 0), (6, 0), (6, 2), (0, 2)]]))
    >>> graph = branch_graph(psl.sk0(rectangle))
    >>> sorted(kind for _, kind in graph.nodes(data="kind"))
    ['end', 'end']
    """
    as_instance(skeleton, Skeleton, "skeleton", "a Skeleton, such as sk0(shape)")
    try:
        import networkx
    except ImportError:
        raise InputError("networkx is not installed; run: pip install polyskel-lite[graph]") from None
    node, sheets = _sheet_of(skeleton)
    n, k = len(skeleton.vertices), len(sheets)
    wires = skeleton.edges[free_edges(skeleton)]
    ends = np.where(node[wires] >= 0, n + node[wires], wires)
    degree = occurrences(ends, n + k)
    # Where branches begin: everything but the inside of a chain; a sheet always.
    stop = (degree[:n] != 2) & (node < 0)
    graph = networkx.MultiGraph()
    names = {0: "point", 1: "end"}
    for v in np.flatnonzero(stop).tolist():
        graph.add_node(v, kind=names.get(int(degree[v]), "junction"), **_place(skeleton, v))
    for s, members in enumerate(sheets):
        graph.add_node(n + s, kind="sheet", vertices=members)
    incident: dict[int, list[tuple[int, int]]] = {}
    for e, (a, b) in enumerate(ends.tolist()):
        incident.setdefault(a, []).append((e, b))
        incident.setdefault(b, []).append((e, a))
    used = np.zeros(len(wires), dtype=bool)

    def walk(start, e, towards):
        path, real = [start, towards], [wires[e].tolist()]
        used[e] = True
        while towards < n and not stop[towards] and towards != start:
            e, towards = next((f, b) for f, b in incident[towards] if not used[f])
            used[e] = True
            path.append(towards)
            real.append(wires[e].tolist())
        _add_branch(graph, skeleton, path, real)

    for start in [*np.flatnonzero(stop).tolist(), *range(n, n + k)]:
        for e, towards in incident.get(start, []):
            if not used[e]:
                walk(start, e, towards)
    for e in range(len(wires)):  # what is left are closed chains
        if not used[e]:
            start, towards = ends[e].tolist()
            graph.add_node(start, kind="loop", **_place(skeleton, start))
            walk(start, e, towards)
    graph.graph["branches"] = sum(kind == "end" for _, kind in graph.nodes(data="kind"))
    return graph


def _place(skeleton, v):
    return {"pos": tuple(skeleton.vertices[v].tolist()), "radius": float(skeleton.radii[v])}


def _add_branch(graph, skeleton, path, real):
    """Add the branch along skeleton edges ``real``; ``path`` names its stops, sheets included."""
    vertices = list(real[0])
    if len(real) > 1 and vertices[0] in real[1]:
        vertices.reverse()
    for a, b in real[1:]:
        vertices.append(b if a == vertices[-1] else a)
    if len(real) == 1 and path[0] < len(skeleton.vertices) and vertices[0] != path[0]:
        vertices.reverse()
    points = skeleton.vertices[vertices]
    length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    smooth = smooth_length(points, skeleton.radii[vertices])
    radii = skeleton.radii[vertices].tolist()
    graph.add_edge(path[0], path[-1], path=vertices, length=length, smooth_length=smooth, radii=radii)


def smooth_length(points: np.ndarray, radii: np.ndarray) -> float:
    """Length of a chain of Voronoi vertices without its zigzag between the samples.

    Every point of the chain is replaced by the mean of the piece around it that is as long as its radius,
    half to each side, shorter towards the ends, which stay.

    Parameters
    ----------
    points : (k, N) float array
    radii : (k,) float array

    Examples
    --------
    >>> x = np.arange(0, 16.25, 0.25)
    >>> zigzag = np.column_stack([x, 0.1 * (np.arange(len(x)) % 2)])
    >>> raw = float(np.linalg.norm(np.diff(zigzag, axis=0), axis=1).sum())
    >>> round(raw, 1), round(smooth_length(zigzag, np.full(len(x), 2.0)), 1)
    (17.2, 16.0)
    """
    pieces = np.linalg.norm(np.diff(points, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(pieces)])
    total = along[-1]
    if total == 0:
        return 0.0
    # The integral of the chain up to each vertex; within a piece it is a parabola.
    integral = np.zeros_like(points)
    integral[1:] = np.cumsum(pieces[:, None] * (points[1:] + points[:-1]) / 2, axis=0)

    def up_to(s):
        k = np.clip(np.searchsorted(along, s, side="right") - 1, 0, len(pieces) - 1)
        step = s - along[k]
        share = (step / np.where(pieces[k] > 0, pieces[k], 1))[:, None]
        end = points[k] + share * (points[k + 1] - points[k])
        return integral[k] + step[:, None] * (points[k] + end) / 2

    s = np.linspace(0, total, 4 * len(points) + 1)[1:-1]
    half = np.minimum(np.interp(s, along, radii) / 2, np.minimum(s, total - s))[:, None]
    middle = (up_to(s + half[:, 0]) - up_to(s - half[:, 0])) / (2 * half)
    chain = np.concatenate([points[:1], middle, points[-1:]])
    return float(np.linalg.norm(np.diff(chain, axis=0), axis=1).sum())


def free_edges(skeleton: Skeleton) -> np.ndarray:
    """Rows of ``edges`` that are the side of no polygon: the wires.

    Examples
    --------
    >>> edges = np.array([(0, 1), (1, 2), (2, 0), (2, 3)])
    >>> flag = Skeleton(np.zeros((4, 3)), np.ones(4), np.arange(4), edges, [[0, 1, 2]])
    >>> free_edges(flag).tolist()
    [3]
    """
    if not len(skeleton.polygons):
        return np.arange(len(skeleton.edges))
    n = len(skeleton.vertices)
    sides = skeleton.polygons.sides()
    key = np.sort(skeleton.edges, axis=1) @ np.array([n, 1])
    return np.flatnonzero(~np.isin(key, np.sort(sides, axis=1) @ np.array([n, 1])))


def _sheet_of(skeleton: Skeleton):
    """For each vertex the sheet it is on, or -1, and the vertices of each sheet."""
    n = len(skeleton.vertices)
    node = np.full(n, -1)
    if not len(skeleton.polygons):
        return node, []
    _, label = components(n, skeleton.polygons.sides())
    on = np.unique(skeleton.polygons.corners)
    _, node[on] = np.unique(label[on], return_inverse=True)
    return node, [np.flatnonzero(node == s) for s in range(node.max() + 1)]
