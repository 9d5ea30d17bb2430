"""The boundary of a union of balls in space: circles where spheres meet, their exposed arcs, singular points.

Only pairs and triples of balls whose power cells meet can show on the boundary, so these are all that is
looked at. On each circle the covered parts are intervals of angles, put together in `discs`.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..exact import occurrences, unique_rows
from .discs import Arcs, Boundary, Circles, Covers, ends_of, uncovered
from .incidence import contacts, merged
from .pairs import PRECISION, balls_near, found_at, in_any, lengths, meeting_graph, relations, rounding
from .power import PowerTriangulation

# However badly known a circle, no point of it is off by more than this angle.
_WORST = 1e-4
# A place on a sphere is under another ball if it is in it by more than this share: some thousand roundings.
_INSIDE = 1e-9
_POLE = np.array([0.48, 0.6, 0.64])
# An arc deeper in a ball than this share of its radius is not on the boundary; less may be a badly known end.
_DEEP = 1e-4
_ROUNDS = 6
_TRIPLES = 4_000_000  # rows of the table of triples: above, memory and patience end


def sphere_boundary(centers: np.ndarray, radii: np.ndarray, power: PowerTriangulation) -> Boundary:
    """Find the circles, arcs and singular points of the boundary of a union of balls in space.

    Parameters
    ----------
    centers : (k, 3) float array
    radii : (k,) float array
        No two balls equal.
    power : PowerTriangulation
        Of the same balls.

    Examples
    --------
    >>> import numpy as np
    >>> from polyskel_lite.polyballs.power import power_triangulation
    >>> centers, radii = np.array([(0.0, 0, 0), (1, 0, 0), (0.5, 1, 0)]), np.ones(3)
    >>> found = sphere_boundary(centers, radii, power_triangulation(centers, radii))
    >>> len(found.arcs.ball), len(found.corners)
    (3, 2)
    """
    gone, crossing, touching = relations(centers, radii, *power.faces(2).T)
    circles = Circles.between(centers, radii, crossing)
    covers, covered = _covers(centers, radii, power, circles)
    arcs, errors = uncovered(covers, np.flatnonzero(~covered))
    corners = merged(*ends_of(arcs, errors, circles))
    keep, row = np.unique(arcs.ball, return_inverse=True)
    crossed, exposed = (np.isin(np.arange(len(radii)), pairs) for pairs in (crossing, crossing[keep]))
    # A sphere that crosses no other one is exposed as a whole, or not at all.
    whole = ~crossed & ~gone
    poles = centers[whole] + radii[whole, None] * _POLE
    whole[whole] = ~in_any(poles, centers, radii * (1 - _INSIDE))
    circles = Circles(*(values[keep] for values in circles))
    touching, _ = contacts(centers, radii, touching)
    return Boundary(exposed | whole, circles, Arcs(row, arcs.start, arcs.end), corners, touching)


def _covers(centers, radii, power, circles: Circles) -> tuple[Covers, np.ndarray]:
    """The part of each circle in each ball in a triple with the pair; which circles are all covered."""
    triples, count = power.faces(3), len(radii)
    # Each triple with each of its pairs: the row of the circle, if there is one, and the third ball.
    sides = np.concatenate([triples[:, (0, 1)], triples[:, (0, 2)], triples[:, (1, 2)]])
    row = found_at(circles.pairs @ (count, 1), sides @ (count, 1))
    row, k = row[row >= 0], triples.T[::-1].ravel()[row >= 0]
    i, j = circles.pairs[row].T
    to = centers[k] - circles.centers[row]
    x, y, z = (np.einsum("mi,mi->m", to, circles.frames[row, c]) for c in range(3))
    h, across = circles.radii[row], np.hypot(x, y)
    # On the circle, |p - c_k|² - r_k² = 2 h (excess - across cos(angle from the direction of c_k)).
    excess = ((across**2 + z**2 - radii[k] ** 2) / h + h) / 2
    believed = PRECISION * (radii[i] + radii[j] + radii[k]) + rounding(centers, radii, i, j)
    believed += rounding(centers, radii, k, k)
    d = lengths(centers[j] - centers[i])
    axis = circles.frames[row, 2]
    along = np.minimum(*(np.abs(np.einsum("mi,mi->m", centers[k] - centers[e], axis)) for e in (i, j)))
    # Where the two spheres nearly coincide, rounding moves their circle: along its axis by (error) r / d, and
    # it tilts the axis by (error) / d.
    error = along * (radii[i] + radii[j]) + (across + h + np.abs(z)) * (radii[i] + radii[j])
    error = believed * (error / d + radii[k] + across + h + np.abs(z)) / h
    all_in, none_in = excess + across <= error, excess - across >= -error
    # A ball through the whole circle, within the error, covers nothing of it.
    none_in |= np.abs(excess) + across <= error
    all_in &= ~none_in
    covered = np.isin(np.arange(len(circles.pairs)), row[all_in])
    some = ~(all_in | none_in) & ~covered[row]
    row, across, excess, error, x, y = (v[some] for v in (row, across, excess, error, x, y))
    above, below = np.maximum(across - excess, 0), np.maximum(across + excess, 0)
    sine = np.sqrt(above * below)
    shift = np.minimum(np.divide(error, sine, out=np.full_like(sine, np.inf), where=sine > 0), _WORST)
    return Covers.about(row, x, y, above, below, shift), covered


def verified_boundary(centers, radii, power: PowerTriangulation) -> tuple[PowerTriangulation, Boundary]:
    """The same as `sphere_boundary` after a check of every arc, and the triangulation that it took.

    Where many balls pass through one point and nearly coincide, Qhull can lose some of them; then arcs are
    found inside a ball. For these balls all pairs and triples that meet are looked at, not only those of the
    power diagram, until no arc is inside a ball.

    Parameters
    ----------
    centers, radii, power
        As for `sphere_boundary`.

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


def _closes(found: Boundary, starts, ends) -> bool:
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
    found = (np.sort(np.concatenate(rows), axis=1) for rows in (pairs, triples))
    pairs, triples = (unique_rows(rows, graph.shape[0])[0] for rows in found)
    return pairs, triples


def _deepest(places, centers, radii) -> tuple[np.ndarray, np.ndarray]:
    """The places that are inside a ball, beyond rounding, and the ball in which each is deepest."""
    point, near, away = balls_near(places, centers, radii)
    inside = 1 - away / radii[near]
    # Of several the last one stays, which is the deepest.
    order = np.argsort(inside)
    order = order[inside[order] > 0]
    depth, ball = np.zeros(len(places)), np.full(len(places), -1)
    depth[point[order]], ball[point[order]] = inside[order], near[order]
    deep = np.flatnonzero(depth > _DEEP)
    return deep, ball[deep]
