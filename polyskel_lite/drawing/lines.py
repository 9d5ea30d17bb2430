"""Lines to draw: boxes around things, segments and rays cut at a box, edges joined to chains."""

from __future__ import annotations

import numpy as np

from ..errors import InputError


def box_of(*things, margin: float = 0.08) -> np.ndarray:
    """The smallest axis-parallel box around some points, widened by a share of its longest side.

    Parameters
    ----------
    *things : (n, N) arrays, or objects with ``points``, ``vertices`` or ``centers``
        What the box holds.
    margin : float
        Share of the longest side added on every side.

    Returns
    -------
    (2, N) array
        Lower and upper corner.

    Raises
    ------
    InputError
        If there is no point at all.

    Examples
    --------
    >>> from polyskel_lite import drawing
    >>> drawing.box_of([(0, 0), (4, 2)], margin=0.25)
    array([[-1., -1.],
           [ 5.,  3.]])
    """
    clouds = [np.asarray(points_of(thing), dtype=float) for thing in things]
    clouds = [cloud[np.isfinite(cloud).all(axis=1)] for cloud in clouds if cloud.size]
    if not clouds:
        raise InputError("A box needs at least one point; give some points or pass the box itself.")
    points = np.concatenate(clouds)
    lower, upper = points.min(axis=0), points.max(axis=0)
    width = margin * float((upper - lower).max())
    return np.array([lower - width, upper + width])


def points_of(thing):
    """The points of an object of the library, or the array itself."""
    for name in ("points", "vertices", "centers"):
        if hasattr(thing, name):
            return getattr(thing, name)
    return thing


def in_box(points: np.ndarray, box) -> np.ndarray:
    """Which points lie in a closed box, (n,) bool array.

    Examples
    --------
    >>> in_box(np.array([(0, 0), (3, 1)]), [(0, 0), (2, 2)]).tolist()
    [True, False]
    """
    return ((points >= box[0]) & (points <= box[1])).all(axis=1)


def clip_segments(segments, box) -> np.ndarray:
    """Cut segments to a box (the method of Liang and Barsky); those wholly outside are left out.

    Parameters
    ----------
    segments : (m, 2, N) array
        Both ends of each segment.
    box : (2, N) array
        Lower and upper corner.

    Returns
    -------
    (k, 2, N) array with k <= m, in the given order

    References
    ----------
    Y.-D. Liang, B. A. Barsky, "A new concept and method for line clipping", ACM Transactions on Graphics 3,
    1984.

    Examples
    --------
    >>> from polyskel_lite import drawing
    >>> drawing.clip_segments([[(-1, 0), (1, 0)], [(5, 5), (6, 6)]], [(0, -1), (2, 1)])
    array([[[0., 0.],
            [1., 0.]]])
    """
    segments = np.asarray(segments, dtype=float)
    low, high = np.asarray(box, dtype=float)
    if len(segments) == 0:
        return np.empty((0, 2, low.size))
    # The circumcenter of a triangle flat beyond floating point is infinite: no line can be drawn to it.
    segments = segments[np.isfinite(segments).all(axis=(1, 2))]
    start, step = segments[:, 0], segments[:, 1] - segments[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        at_low, at_high = (low - start) / step, (high - start) / step
    flat = step == 0
    outside = flat & ((start < low) | (start > high))
    enter = np.where(flat, -np.inf, np.minimum(at_low, at_high)).max(axis=1).clip(0, 1)
    leave = np.where(flat, np.inf, np.maximum(at_low, at_high)).min(axis=1).clip(0, 1)
    seen = (enter < leave) & ~outside.any(axis=1)
    ends = np.stack([enter, leave], axis=1)[seen]
    return start[seen, None] + ends[:, :, None] * step[seen, None]


def ray_segments(skeleton, box) -> np.ndarray:
    """The rays of a skeleton or Voronoi graph, each cut to a box.

    Parameters
    ----------
    skeleton : object with ``vertices``, ``rays`` (unit directions) and ``ray_vertices``
    box : (2, N) array

    Returns
    -------
    (k, 2, N) array

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> from polyskel_lite import drawing
    >>> graph = SimpleNamespace(vertices=[(0, 0)], rays=[(1, 0)], ray_vertices=[0])
    >>> drawing.ray_segments(graph, [(-1, -1), (3, 1)])
    array([[[0., 0.],
            [3., 0.]]])
    """
    box = np.asarray(box, dtype=float)
    start = np.asarray(skeleton.vertices, dtype=float)[np.asarray(skeleton.ray_vertices, dtype=int)]
    start = start.reshape(-1, box.shape[1])
    reach = np.abs(start[:, None] - box[None]).max(axis=(1, 2)) * 2
    end = start + reach[:, None] * np.asarray(skeleton.rays, dtype=float).reshape(start.shape)
    return clip_segments(np.stack([start, end], axis=1), box)


def chains(edges) -> list[np.ndarray]:
    """Chain edges into paths, so that a dash pattern runs on where edges are short.

    Each path ends at a vertex that has not exactly two edges, or comes back to where it began.

    Parameters
    ----------
    edges : (m, 2) int array

    Returns
    -------
    list of int arrays
        Vertex indices along each path; a path of k vertices stands for k - 1 edges, and every edge is in one
        path.

    Examples
    --------
    >>> from polyskel_lite import drawing
    >>> [path.tolist() for path in drawing.chains([(0, 1), (2, 1), (2, 3), (2, 4)])]
    [[0, 1, 2], [2, 3], [2, 4]]
    """
    edges = np.asarray(edges, dtype=int).reshape(-1, 2)
    incident: dict[int, list[int]] = {}
    for index, edge in enumerate(edges.tolist()):
        for vertex in edge:
            incident.setdefault(vertex, []).append(index)
    used = np.zeros(len(edges), dtype=bool)
    # Ends and branchings first; what is left after them are closed loops, which may begin anywhere.
    starts = [v for v in sorted(incident) if len(incident[v]) != 2] + sorted(incident)
    paths = []
    for start in starts:
        for first in incident[start]:
            if used[first]:
                continue
            path, edge = [start], first
            while not used[edge]:
                used[edge] = True
                here = int(edges[edge].sum()) - path[-1]
                path.append(here)
                if len(incident[here]) != 2 or here == start:
                    break
                edge = sum(incident[here]) - edge
            paths.append(np.array(path))
    return paths
