"""The ring of tetrahedra around each edge of a triangulation, whatever their orientation."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from ._rows import unique_rows

_PAIRS = list(combinations(range(4), 2))
_OTHERS = [[c for c in range(4) if c not in pair] for pair in _PAIRS]


def edge_rings(simplices, neighbors, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Walk around every edge between two of the first `count` points.

    Parameters
    ----------
    simplices, neighbors : (t, 4) int arrays
        A triangulation in which no such edge is on the outside. Flat and wrongly oriented tetrahedra are
        welcome: only neighbourhood counts.
    count : int

    Returns
    -------
    edges : (e, 2) int array
        Sorted.
    edge, owner, position : (r,) int arrays
        Tetrahedron `owner` is at `position` (from 0) in the ring around `edge`; sorted by edge and owner.

    Examples
    --------
    >>> from polyskel_lite.power import power_triangulation
    >>> t = power_triangulation(np.array([(0.0, 0, 0), (1, 0, 0)]), np.ones(2))
    >>> edges, edge, owner, position = edge_rings(t.simplices, t.neighbors, t.count)
    >>> edges.tolist(), sorted(position.tolist()) == list(range(len(owner)))
    ([[0, 1]], True)
    """
    pairs = np.sort(simplices[:, _PAIRS], axis=2).reshape(-1, 2)
    real = np.flatnonzero(pairs[:, 1] < count)
    edges, edge = unique_rows(pairs[real], count)
    owner = real // len(_PAIRS)
    order = np.lexsort((owner, edge))
    edge, owner = edge[order], owner[order]
    beside = neighbors[:, _OTHERS].reshape(-1, 2)[real][order]
    # The record of the same edge in each of the two neighbours that share it.
    key = edge * len(simplices) + owner
    links = np.searchsorted(key, edge[:, None] * len(simplices) + beside)
    at = np.flatnonzero(np.diff(edge, prepend=-1))
    start, before, position = at, links[at, 1], np.zeros(len(edge), dtype=np.int64)
    for step in range(len(simplices)):
        position[at] = step
        after = np.where(links[at, 0] == before, links[at, 1], links[at, 0])
        # In a ring of two both links are the same.
        going = after != start
        at, before, start = after[going], at[going], start[going]
        if not len(at):
            break
    return edges, edge, owner, position
