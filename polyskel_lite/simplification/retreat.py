"""What goes before what: heirs, A(v), and how branches retreat from their ends (section 4.3)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..skeletons import sk0
from .hierarchies import Hierarchy


class Ways(NamedTuple):
    """Where the vertices of a skeleton go when it is simplified; made by `ways`.

    Attributes
    ----------
    heir : (k,) int array
        For each vertex of ``sk0(h.P)`` that goes the neighbour that is left, -1 for those that stay.
    last : (k,) int array
        The last of the neighbours that went before it, -1 if there is none: a branch retreats along it.
    """

    heir: np.ndarray
    last: np.ndarray


def ways(h: Hierarchy) -> Ways:
    """Follow the ends of the branches while they retreat.

    Parameters
    ----------
    h : Hierarchy
        In 2D.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> h = psl.hierarchy(psl.datasets.load("gear", n=60))
    >>> found = ways(h)
    >>> int((found.heir >= 0).sum()) == len(h.order), int((found.last >= 0).sum()) > 0
    (True, True)
    """
    n, rank = len(h.level), h.rank
    a, b = sk0(h.P).edges.T
    first = np.where(rank[a] < rank[b], a, b)
    goes = rank[first] < n
    first, second = first[goes], (a + b)[goes] - first[goes]
    heir, last = np.full(n, -1), np.full(n, -1)
    heir[first] = second
    order = np.argsort(rank[first])
    last[second[order]] = first[order]  # of several the last one is kept
    return Ways(heir, last)


def behind(h: Hierarchy, vertex: int) -> np.ndarray:
    """A(v): the triangles that must go before a vertex of the skeleton can go, and its own (section 4.3).

    Parameters
    ----------
    h : Hierarchy
        In 2D.
    vertex : int
        Position in ``h.level``, or vertex of ``sk0(h.P)``.

    Returns
    -------
    (a,) int array
        Positions, the vertex itself the last one. The boundary length p(v) is that of all of them.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> h = psl.hierarchy(psl.Shape.from_rings([[(0, 0), (4, 0), (4, 1), (2, 1.2), (0, 1)]]))
    >>> [len(behind(h, vertex)) for vertex in h.order]
    [1, 1]
    """
    heir, found = ways(h).heir, {int(vertex)}
    members = [int(vertex)]
    for k in reversed(h.order.tolist()):
        if k not in found and heir[k] in found:
            found.add(k)
            members.append(k)
    return np.array(members[::-1])


def end_vertices(h: Hierarchy, threshold: float) -> np.ndarray:
    """The ends of the simplified skeleton, as vertices of ``sk0(h.P)``, (e,) int array.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> h = psl.hierarchy(psl.datasets.load("gear", n=60))
    >>> len(end_vertices(h, np.pi)) == h.branches(np.pi).graph["branches"]
    True
    """
    return np.flatnonzero(h.level >= threshold)[h.skeleton(threshold).ends()]


def paths_back(h: Hierarchy, threshold: float, found: Ways | None = None) -> list[np.ndarray]:
    """The ways on which the ends have come, from each end back to the boundary, as (s, 2) arrays.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> h = psl.hierarchy(psl.datasets.load("gear", n=60))
    >>> len(paths_back(h, np.pi)) == len(end_vertices(h, np.pi))
    True
    """
    last = (ways(h) if found is None else found).last.tolist()
    places = h.P.tessellation.circumcenters[h.simplices]
    paths = []
    for v in end_vertices(h, threshold).tolist():
        path = [v]
        while last[path[-1]] >= 0:
            path.append(last[path[-1]])
        paths.append(places[path])
    return paths
