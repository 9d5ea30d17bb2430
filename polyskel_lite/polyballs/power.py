"""The power diagram of balls through its dual, the weighted Delaunay triangulation.

A union of k balls is decided by few pairs and triples of them: those whose power cells meet. Everything about
polyballs (appendix A) that would otherwise look at all triples is read off this triangulation.
"""

from __future__ import annotations

from itertools import combinations
from typing import NamedTuple

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from ..errors import TessellationError
from ..exact import components, unique_rows
from .pairs import lengths

# Balls that share a point, as Delaunay balls do, have it in common to rounding only: whether they do is asked
# of powers larger and smaller by this share of the squared radius.
_SHARED = 1e-9
# A ball is in conflict with another one, in power, by more than this share of its squared radius.
_TIE = 1e-12
# A simplex with a smaller sine than the root of this has no orthogonal ball that rounding could tell.
_FLAT = 1e-12


class PowerTriangulation(NamedTuple):
    """Weighted Delaunay triangulation of balls and of N + 1 far ghost points that enclose them.

    The ghosts have no ball. No power cell of theirs meets the union of the balls, so they change nothing in
    it; but with them every ball has a bounded cell, whatever the number and the position of the balls.

    Attributes
    ----------
    points : (k + N + 1, N) float array
        Centres, then ghosts.
    simplices : (t, N+1) int array
        Without the hidden balls, whose power cell is empty. Not oriented.
    neighbors : (t, N+1) int array
        The simplex opposite each corner, -1 outside the ghosts.
    orthocenters : (t, N) float array
        The points of equal power to all corners: vertices of the power diagram.
    count : int
        k: indices from k on are ghosts.
    found : tuple of (p, 2) and (q, 3) int arrays
        Sorted pairs and triples to look at besides, because Qhull, which merges what is flat within rounding,
        may have lost them; see `polyskel_lite.polyballs.spheres.verified_boundary`.
    """

    points: np.ndarray
    simplices: np.ndarray
    neighbors: np.ndarray
    orthocenters: np.ndarray
    count: int  # type: ignore[assignment] # and not the method of tuples
    found: tuple = (np.zeros((0, 2), dtype=np.int64), np.zeros((0, 3), dtype=np.int64))

    def real(self) -> np.ndarray:
        """Which simplices have no ghost, (t,) bool array.

        Examples
        --------
        >>> import numpy as np
        >>> balls = power_triangulation(np.array([(0.0, 0), (1, 0), (0, 1)]), np.ones(3))
        >>> int(balls.real().sum())
        1
        """
        return np.asarray((self.simplices < self.count).all(axis=1))

    def faces(self, size: int) -> np.ndarray:
        """All pairs (size 2) or triples (size 3) of balls whose power cells meet, sorted, (m, size).

        Size 1: all balls that are not hidden.

        Examples
        --------
        >>> import numpy as np
        >>> balls = power_triangulation(np.array([(0.0, 0), (1, 0), (0, 1)]), np.ones(3))
        >>> balls.faces(2).tolist(), balls.faces(3).tolist()
        ([[0, 1], [0, 2], [1, 2]], [[0, 1, 2]])
        """
        columns = list(combinations(range(self.simplices.shape[1]), size))
        rows = np.sort(self.simplices[:, columns].reshape(-1, size), axis=1)
        rows = rows[rows[:, -1] < self.count]
        more = {1: self.found[0].reshape(-1, 1), 2: self.found[0], 3: self.found[1]}
        return unique_rows(np.concatenate([rows, more[size]]), self.count)[0]


def power_triangulation(centers: np.ndarray, radii: np.ndarray) -> PowerTriangulation:
    """Triangulate balls so that no ball's centre is nearer, in power, to an orthocentre than its own corners.

    Parameters
    ----------
    centers : (k, N) float array
        Around 0, so that nothing is lost by squaring.
    radii : (k,) float array

    References
    ----------
    Aurenhammer, Power diagrams: properties, algorithms and applications, 1987; Edelsbrunner, The union of
    balls and its dual shape, 1995.

    Examples
    --------
    The small ball inside the large one is hidden:

    >>> import numpy as np
    >>> balls = power_triangulation(np.array([(0.0, 0), (0.1, 0), (3, 0)]), np.array([2, 0.5, 2]))
    >>> balls.faces(2).tolist()
    [[0, 2]]
    """
    size = float((lengths(centers) + radii).max())
    return regular_triangulation(centers, radii**2, size)


def regular_triangulation(points, weights, size: float, hide: bool = True) -> PowerTriangulation:
    """Triangulate weighted points within distance `size` of 0, with ghosts around them.

    Parameters
    ----------
    points : (k, N) float array
    weights : (k,) float array
    size : float
    hide : bool
        Whether points may be hidden; if not, every point must come out as a vertex.

    Raises
    ------
    TessellationError
        If Qhull gives up, or loses points that may not be hidden.

    Examples
    --------
    >>> import numpy as np
    >>> t = regular_triangulation(np.array([(0.0, 0), (1, 0)]), np.zeros(2), 1.0)
    >>> t.faces(2).tolist()
    [[0, 1]]
    """
    n = points.shape[1]
    points = np.concatenate([points, _GHOSTS[n] * size])
    height = (points**2).sum(axis=1) - np.append(weights, np.zeros(n + 1))
    hull = _hull(np.column_stack([points / size, height / size**2]), hide)
    down = hull.equations[:, n]
    lower = down < -1e-12
    number = np.append(np.where(lower, np.cumsum(lower) - 1, -1), -1)
    slope = hull.equations[lower, :n] / (-2 * down[lower, None])
    neighbors, count = number[hull.neighbors[lower]], len(points) - n - 1
    return PowerTriangulation(points, hull.simplices[lower], neighbors, slope * size, count)


def _hull(points, hide: bool) -> ConvexHull:
    # Q12: go on where facets are merged widely, as around samples that dozens of balls nearly share. Where
    # even that fails, QJ moves the points by some 1e-11 of their size, so that nothing needs to be merged.
    for options in ("Qt Q12", "QJ Q12"):
        try:
            hull = ConvexHull(points, qhull_options=options)
        except QhullError as error:
            reason = str(error).splitlines()[0]
        else:
            lost = len(points) - len(hull.vertices)
            if hide or not lost:
                return hull
            reason = f"{lost} of {len(points)} places are too close together to be told apart"
    raise TessellationError(f"Qhull could not triangulate this: {reason}.")


def homotopy(t: PowerTriangulation, radii: np.ndarray, slack: float = _SHARED) -> list[tuple[int, ...]]:
    """The Betti numbers of the union of the balls by its dual shape, with balls a little smaller and larger.

    A power may be off by `slack` times the squared radius. The dual shape has the simplices whose balls have
    a point of their common power cell in common. That is so if their smallest orthogonal ball has a negative
    power and no further ball is in conflict with it, or if it is so for a simplex above.

    Returns
    -------
    list of two tuples
        (b0, b1) in the plane, (b0, b1, b2) in space.

    References
    ----------
    Edelsbrunner, The union of balls and its dual shape, 1995.

    Examples
    --------
    Three discs around a gap:

    >>> centers, radii = np.array([(1.1, 0), (-0.55, 0.9526), (-0.55, -0.9526)]), np.ones(3)
    >>> homotopy(power_triangulation(centers, radii), radii)
    [(1, 1), (1, 1)]
    """
    n = t.points.shape[1]
    weights = np.append(radii**2, np.zeros(n + 1))
    upper = np.sort(t.simplices[t.real()], axis=1)
    shape, flat, found = np.zeros((2, 0), dtype=bool), np.zeros(0, dtype=bool), {}
    for size in range(n + 1, 0, -1):
        faces, below = _below(t, upper, size)
        middle, power = _orthoballs(t.points, weights, faces)
        opposite = upper.T.ravel()[: len(below)]
        offset = t.points[opposite] - t.points[faces[below, 0]] - middle[below]
        beyond = (offset**2).sum(axis=1) - weights[opposite] - power[below]
        conflict = beyond < -_TIE * weights[opposite]
        if size > n:
            # Qhull gives all parts of a facet, flat ones too, one orthocenter.
            flat = np.isinf(power)
            power = ((t.orthocenters[t.real(), None] - t.points[faces]) ** 2).sum(axis=2)
            power = (power - weights[faces]).mean(axis=1)
        most, least = weights[faces].max(axis=1), weights[faces].min(axis=1)
        own = np.array([power < -slack * most, power < slack * least])
        own[:, below[conflict]] = False
        for row, above in zip(own, np.tile(shape, size + 1), strict=True):
            row[below[above]] = True
        if size == n:  # what is flat encloses nothing, so that it is in as soon as its sides are
            found[n + 1] = upper, shape | (own[:, below].reshape(2, n + 1, -1).all(axis=1) & flat)
        upper, shape = faces, own
        found[size] = faces, own
    shapes = [{size: faces[own[k]] for size, (faces, own) in found.items()} for k in range(2)]
    return [_betti(t, shape, solid) for shape, solid in zip(shapes, found[n + 1][1], strict=True)]


def _below(t, upper, size: int) -> tuple[np.ndarray, np.ndarray]:
    """All simplices of some size, and which is opposite each corner of the ones above, by corners."""
    if size == t.simplices.shape[1]:
        return upper, np.zeros(0, dtype=np.int64)
    rows = np.concatenate([np.delete(upper, corner, axis=1) for corner in range(size + 1)])
    faces, which = unique_rows(np.concatenate([rows, t.faces(size)]), t.count)
    return faces, which[: len(rows)]


def _orthoballs(points, weights, faces) -> tuple[np.ndarray, np.ndarray]:
    """The smallest balls orthogonal to the corners: middles as seen from the first corner, and powers."""
    legs = points[faces[:, 1:]] - points[faces[:, :1]]
    square = (legs**2).sum(axis=2)
    right = (square - weights[faces[:, 1:]] + weights[faces[:, :1]]) / 2
    gram = np.einsum("mij,mkj->mik", legs, legs)
    flat = ~(np.linalg.det(gram) > _FLAT * square.prod(axis=1))
    gram[flat] = np.eye(legs.shape[1])
    middle = np.einsum("mi,mij->mj", np.linalg.solve(gram, right[..., None])[..., 0], legs)
    return middle, np.where(flat, np.inf, (middle**2).sum(axis=1) - weights[faces[:, 0]])


def _betti(t, shape, solid) -> tuple[int, ...]:
    """Betti numbers of a part of the triangulation: its simplices by size, and which largest ones it has."""
    # A ball that is not in the shape is a piece of its own in this graph.
    pieces = components(t.count, shape[2])[0] - t.count + len(shape[1])
    characteristic = sum((-1) ** (size - 1) * len(faces) for size, faces in shape.items())
    if len(shape) == 3:
        return pieces, pieces - characteristic
    # A cavity is what can be walked through from gap to gap; beyond the last simplex is one more gap.
    outside, walls = len(t.simplices), len(shape[3])
    gap = np.ones(outside + 1, dtype=bool)
    gap[:-1][t.real()] = ~solid
    sides = [np.sort(np.delete(t.simplices, corner, axis=1), axis=1) for corner in range(4)]
    which = unique_rows(np.concatenate([shape[3], *sides]), len(t.points))[1]
    corner, simplex = np.nonzero(~np.isin(which[walls:], which[:walls]).reshape(4, -1))
    beyond = t.neighbors[simplex, corner]
    doors = np.column_stack([simplex, np.where(beyond < 0, outside, beyond)])
    cavities = len(np.unique(components(outside + 1, doors)[1][gap])) - 1
    return pieces, pieces + cavities - characteristic, cavities


def _simplex_around_the_unit_ball(n: int) -> np.ndarray:
    """Corners of a simplex with a ball of radius 5 inside it, turned so that no data is in line with it."""
    corners = np.eye(n + 1) - 1 / (n + 1)
    basis = np.linalg.svd(corners)[2][:n]
    corners = corners @ basis.T
    corners *= 5 * n / lengths(corners)[:, None]
    turn, _ = np.linalg.qr(np.cos(np.arange(1.0, n * n + 1).reshape(n, n)))
    return corners @ turn.T


_GHOSTS = {n: _simplex_around_the_unit_ball(n) for n in (2, 3)}
