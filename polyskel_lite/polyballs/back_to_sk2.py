"""Sk2 read as the skeleton of a polyball (section 3.2), and the five conditions under which that is true."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from ..graphs import Tessellation
from ..shapes import Shape
from ..skeletons import sk1, sk2
from .polyball import Polyball

# Two places are one when they are nearer than this share of the smallest ball there. Crossings of spheres
# that nearly coincide, as around almost cocircular samples, are known to about 1e-8 of the radius.
_OFF = 1e-6


class Sk2Conditions(NamedTuple):
    """What `sk2_conditions` returns: for each condition its counterexamples.

    Attributes
    ----------
    swallowed : (a,) int array
        Samples of kept balls inside Y_w, which breaks condition (a).
    extra : (b, N) float array
        Singular points of Y_w that are no samples, which breaks (b).
    crossing : (c, 2) int array
        Pairs of neighbouring Delaunay simplices with centres in the shape whose Voronoi edge leaves it (c).
    contained : (d,) int array
        Delaunay simplices with their centre outside the shape and their ball in Y_w (d).
    touching : (e, 2) int array
        Pairs of Delaunay simplices whose kept balls touch from outside in a point of the boundary of Y_w (e).

    Examples
    --------
    >>> import numpy as np
    >>> none = np.zeros((0, 2), int)
    >>> Sk2Conditions(np.array([3]), np.zeros((0, 2)), none, np.zeros(0, int), none).hold
    {'a': False, 'b': True, 'c': True, 'd': True, 'e': True}
    """

    swallowed: np.ndarray
    extra: np.ndarray
    crossing: np.ndarray
    contained: np.ndarray
    touching: np.ndarray

    @property
    def hold(self) -> dict[str, bool]:
        """Which of the conditions "a" to "e" hold."""
        return {name: not len(found) for name, found in zip("abcde", self, strict=True)}


def delaunay_balls(shape: Shape, E: ArrayLike | Tessellation | None = None) -> Polyball:
    """Y_w, the union of the Delaunay balls whose centres are in the shape (section 3.2).

    Parameters
    ----------
    shape : Shape
    E : (n, N) array-like or Tessellation, optional
        The samples; by default the vertices of the shape.

    Returns
    -------
    Polyball
        Ball i is around vertex i of ``sk1(shape, E)``.

    Raises
    ------
    InputError
        If no centre is in the shape.

    References
    ----------
    Attali and Montanvert 1997, section 3.2.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> len(delaunay_balls(psl.Shape.from_rings([[(0, 0), (4, 0), (4, 3), (0, 3)]])))
    2
    """
    return sk1(shape, E).balls()


def sk2_conditions(shape: Shape, E: ArrayLike | Tessellation | None = None) -> Sk2Conditions:
    """Check, one by one, five conditions under which Sk2(X, E) is the skeleton of Y_w (section 3.2).

    The paper states the equality without any. In the plane it holds if (a) all samples of kept balls are on
    the boundary of Y_w, (b) all singular points of Y_w are samples, (c) Voronoi edges between centres in the
    shape stay in it, (d) no ball around a centre outside the shape lies in Y_w, and (e) no two kept balls
    touch from outside in a point of the boundary of Y_w: there its skeleton is cut, and Sk2 need not be.

    Parameters
    ----------
    shape : Shape
    E : (n, N) array-like or Tessellation, optional
        The samples; by default the vertices of the shape.

    Returns
    -------
    Sk2Conditions
        The counterexamples to each condition; ``.hold`` says which conditions hold.

    Notes
    -----
    Decided to 1e-6 of the radii, because centres and radii of the balls are rounded.

    References
    ----------
    Attali and Montanvert 1997, section 3.2; the conditions are derived in the book's chapter on them.

    Examples
    --------
    The reflex corner is swallowed by the balls, although the boundary is strictly Gabriel:

    >>> import polyskel_lite as psl
    >>> corners = [(0, 0), (0, 3), (-3, 1), (-2, -2), (1, -2), (3, 0)]
    >>> found = sk2_conditions(psl.Shape.from_rings([corners]))
    >>> found.swallowed.tolist(), found.extra.round(9).tolist()
    ([0], [[0.6, 0.8]])
    """
    skeleton = sk1(shape, E)
    t, Y = skeleton.tessellation, skeleton.balls()
    assert t is not None
    samples = np.unique(t.simplices[skeleton.simplices])
    size = np.full(len(t.points), np.inf)
    np.minimum.at(size, t.simplices[skeleton.simplices], Y.radii[:, None])
    swallowed = samples[Y.boundary_distance(t.points[samples]) > _OFF * size[samples]]
    corners = Y.singular_points()
    away, nearest = cKDTree(t.points[samples]).query(corners)
    extra = corners[away > _OFF * size[samples[nearest]]]
    leaving, contained = _leaving(shape, t, skeleton), _contained(t, skeleton, Y)
    return Sk2Conditions(swallowed, extra, leaving, contained, skeleton.simplices[Y.touching()])


def _leaving(shape, t, skeleton) -> np.ndarray:
    sides = t.facet_table[1]
    both = np.sort(sides[np.isin(sides, skeleton.simplices).all(axis=1)], axis=1)
    whole = sk2(shape, t)
    stay = np.sort(whole.simplices[whole.edges], axis=1)
    n = len(t.simplices)
    return both[~np.isin(both @ [n, 1], stay @ [n, 1])]


def _contained(t, skeleton, Y: Polyball) -> np.ndarray:
    rejected = np.setdiff1d(np.arange(len(t.simplices)), skeleton.simplices)
    rejected = rejected[Y.contains(t.circumcenters[rejected])]
    radii = t.circumradii[rejected]
    return rejected[Y.boundary_distance(t.circumcenters[rejected]) >= radii * (1 - _OFF)]
