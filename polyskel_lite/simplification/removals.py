"""Elementary removals one at a time: hats, salients, and the state before and after (section 4.2)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..containment import DelaunayShape
from ..errors import InputError
from ..skeletons import sk0
from .criteria import facet_measures
from .hierarchies import Hierarchy


class Removal(NamedTuple):
    """What happens when one triangle goes; made by `try_removal`.

    Attributes
    ----------
    triangle : int
        Row of the tessellation's simplices.
    shared : int
        Sides shared with other triangles of the shape: 1 makes it a hat.
    length, radius : float
        p, the boundary length it stands for, and r, the radius of its ball.
    before, after : (b0, b1)
        Betti numbers of the skeleton with the triangle and without it.
    """

    triangle: int
    shared: int
    length: float
    radius: float
    before: tuple[int, ...]
    after: tuple[int, ...]

    @property
    def value(self) -> float:
        """The criterion p/r of section 4.3: an angle in radians."""
        return self.length / self.radius


def state_at(h: Hierarchy, step: int) -> tuple[DelaunayShape, np.ndarray]:
    """The shape after the first removals of a hierarchy, and the boundary length each triangle stands for.

    Parameters
    ----------
    h : Hierarchy
        In 2D, with the corrected criterion.
    step : int
        How many triangles are gone.

    Returns
    -------
    P : DelaunayShape
    p : (k,) float array
        In the order of ``h.level``; a triangle that has gone has handed its length on to its neighbour.

    Raises
    ------
    InputError
        If the hierarchy is in space, or `step` is out of range.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> h = psl.hierarchy(psl.datasets.load("gear", n=40))
    >>> P, p = state_at(h, 3)
    >>> int(h.P.inner.sum() - P.inner.sum()), f"{p[P.inner[h.simplices]].sum() / h.P.to_shape().length():.9f}"
    (3, '1.000000000')
    """
    t = h.P.tessellation
    if t.dimension != 2:
        raise InputError("removals are shown one at a time for shapes in the plane; use explore.thresholds.")
    if not 0 <= step <= len(h.order):
        raise InputError(f"step is {step}; this hierarchy removes {len(h.order)} triangles.")
    number = np.append(np.where(h.P.inner, np.cumsum(h.P.inner) - 1, -1), -1)
    near = number[t.neighbors[h.simplices]]
    p = np.where(near < 0, facet_measures(t, h.simplices), 0.0).sum(axis=1)
    alive = np.append(np.ones(len(h.simplices), dtype=bool), False)
    for v in h.order[:step].tolist():
        alive[v] = False
        heir = near[v][alive[near[v]]]  # a hat has one neighbour left
        p[heir] += p[v]
    inner = np.zeros_like(h.P.inner)
    inner[h.simplices[alive[:-1]]] = True
    return DelaunayShape(t, inner), p


def try_removal(h: Hierarchy, step: int, triangle: int | None = None) -> Removal | None:
    """What the removal of a triangle does to a shape from which the first ones have gone.

    Parameters
    ----------
    h : Hierarchy
        In 2D.
    step : int
        How many triangles are gone.
    triangle : int, optional
        Row of the tessellation; by default the one that goes next, with the smallest criterion of all hats.

    Returns
    -------
    Removal, or None
        None after the last step, or if the triangle is not in the shape any more.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> h = psl.hierarchy(psl.datasets.load("gear", n=40))
    >>> hat = try_removal(h, 0)
    >>> hat.shared, hat.before == hat.after, bool(hat.value - h.level[h.order[0]] < 1e-12)
    (1, True, True)
    """
    P, p = state_at(h, step)
    if triangle is None:
        if step == len(h.order):
            return None
        triangle = int(h.simplices[h.order[step]])
    if not (0 <= triangle < len(P.inner) and P.inner[triangle]):
        return None
    t = P.tessellation
    shared = int(np.append(P.inner, False)[t.neighbors[triangle]].sum())
    without = P.inner.copy()
    without[triangle] = False
    length = float(p[np.searchsorted(h.simplices, triangle)])
    before, after = sk0(P).betti(), sk0(DelaunayShape(t, without)).betti()
    return Removal(triangle, shared, length, float(t.circumradii[triangle]), before, after)


def simplices_by_type(P: DelaunayShape) -> np.ndarray:
    """How many facets of each simplex are shared with the region, -1 for simplices outside, (t,) int array.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> strip = psl.delaunay_shape(psl.Shape.from_rings([[(0, 0), (4, 0), (4, 1), (2, 1.2), (0, 1)]]))
    >>> sorted(simplices_by_type(strip)[strip.inner].tolist())
    [1, 1, 2]
    """
    shared = np.append(P.inner, False)[P.tessellation.neighbors].sum(axis=1)
    return np.where(P.inner, shared, -1)
