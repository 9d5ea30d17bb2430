"""The search for balls that Qhull has lost: no arc of the boundary of a union may be inside a ball."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..exact import occurrences, unique_rows
from .pairs import meeting_graph, octaves
from .power import PowerTriangulation
from .spheres import SphereBoundary, sphere_boundary

# An arc deeper in a ball than this share of its radius is not on the boundary; less may be a badly known end.
_DEEP = 1e-4
_ROUNDS = 6
_TRIPLES = 20_000_000  # rows of the table of triples: above, memory and patience end


def verified_boundary(centers, radii, power: PowerTriangulation) -> tuple[PowerTriangulation, SphereBoundary]:
    """The same as `sphere_boundary` after a check of every arc, and the triangulation that it took.

    Where many balls pass through one point and nearly coincide, Qhull can lose some of them; then arcs are
    found inside a ball. For these balls all pairs and triples that meet are looked at, not only those of the
    power diagram, until no arc is inside a ball.

    Parameters
    ----------
    centers, radii, power
        As for `polyskel_lite.polyballs.spheres.sphere_boundary`.

    Examples
    --------
    >>> from polyskel_lite.polyballs.power import power_triangulation
    >>> centers, radii = np.array([(0.0, 0, 0), (1, 0, 0), (0.5, 1, 0)]), np.ones(3)
    >>> power, found = verified_boundary(centers, radii, power_triangulation(centers, radii))
    >>> len(power.found[0]), len(found.corners)
    (0, 2)
    """
    doubtful = np.zeros(0, dtype=np.int64)
    for _ in range(_ROUNDS):
        found = sphere_boundary(centers, radii, power)
        circle, start, end = found.arcs
        # Both ends and two places between, not symmetric ones.
        parts = [found.circles.points(circle, start + share * (end - start)) for share in (0, 0.3, 0.7, 1)]
        place, ball = _deepest(np.concatenate(parts), centers, radii)
        if not len(place):
            return power, found._replace(sound=_closes(found, parts[0], parts[-1]))
        pairs = found.circles.pairs[circle[place % len(circle)]]
        doubtful = np.unique(np.concatenate([doubtful, pairs.ravel(), ball]))
        more = _all_around(doubtful, meeting_graph(centers, radii))
        if more is None:
            break
        power = power._replace(found=more)
    return power, found._replace(sound=False)


def _closes(found: SphereBoundary, starts, ends) -> bool:
    """Whether every end of an arc is at a singular point where another one ends."""
    part = ~found.arcs.whole
    ends = np.concatenate([starts[part], ends[part]])
    if not len(ends):
        return True
    away, corner = cKDTree(found.corners).query(ends)
    size = np.tile(found.circles.radii[found.arcs.ball[part]], 2)
    return bool((away <= _DEEP * size).all() and occurrences(corner, len(found.corners)).min() > 1)


def _all_around(balls, graph) -> tuple[np.ndarray, np.ndarray] | None:
    """All pairs and triples of balls that meet, one of `balls` in each, or None if these are too many."""
    rows = [graph.indices[graph.indptr[k] : graph.indptr[k + 1]] for k in balls]
    if sum(len(row) ** 2 for row in rows) > _TRIPLES:
        return None
    pairs, triples = [], []
    for k, row in zip(balls.tolist(), rows, strict=True):
        pairs.append(np.column_stack([np.full(len(row), k), row]))
        x, y = graph[row][:, row].nonzero()
        triples.append(np.column_stack([np.full(len(x), k), row[x], row[y]])[x < y])
    pairs, triples = (np.sort(np.concatenate(rows), axis=1) for rows in (pairs, triples))
    return tuple(unique_rows(rows, graph.shape[0])[0] for rows in (pairs, triples))


def _deepest(places, centers, radii) -> tuple[np.ndarray, np.ndarray]:
    """The places that are inside a ball, beyond rounding, and the ball in which each is deepest."""
    depth, ball = np.zeros(len(places)), np.full(len(places), -1)
    tree = cKDTree(places)
    for group in octaves(radii):
        near = cKDTree(centers[group]).sparse_distance_matrix(tree, radii[group].max(), output_type="ndarray")
        inside = 1 - near["v"] / radii[group[near["i"]]]
        order = np.argsort(inside)
        at, inside, candidate = near["j"][order], inside[order], group[near["i"]][order]
        better = inside > depth[at]
        # Of several the last one stays, which is the deepest.
        depth[at[better]], ball[at[better]] = inside[better], candidate[better]
    deep = np.flatnonzero(depth > _DEEP)
    return deep, ball[deep]
