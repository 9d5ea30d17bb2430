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
from ..exact import unique_rows
from .pairs import lengths


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
    count: int
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
        return (self.simplices < self.count).all(axis=1)

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
        corners = self.simplices.shape[1]
        columns = list(combinations(range(corners), size))
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
    ghosts = _GHOSTS[n] * size
    points = np.concatenate([points, ghosts])
    weights = np.append(weights, np.zeros(n + 1))
    height = (points**2).sum(axis=1) - weights
    hull = _hull(np.column_stack([points / size, height / size**2]), hide)
    down = hull.equations[:, n]
    lower = down < -1e-12
    number = np.append(np.where(lower, np.cumsum(lower) - 1, -1), -1)
    slope = hull.equations[lower, :n] / (-2 * down[lower, None])
    return PowerTriangulation(
        points=points,
        simplices=hull.simplices[lower],
        neighbors=number[hull.neighbors[lower]],
        orthocenters=slope * size,
        count=len(points) - n - 1,
    )


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


def _simplex_around_the_unit_ball(n: int) -> np.ndarray:
    """Corners of a simplex with a ball of radius 5 inside it, turned so that no data is in line with it."""
    corners = np.eye(n + 1) - 1 / (n + 1)
    basis = np.linalg.svd(corners)[2][:n]
    corners = corners @ basis.T
    corners *= 5 * n / lengths(corners)[:, None]
    turn, _ = np.linalg.qr(np.cos(np.arange(1.0, n * n + 1).reshape(n, n)))
    return corners @ turn.T


_GHOSTS = {n: _simplex_around_the_unit_ball(n) for n in (2, 3)}
