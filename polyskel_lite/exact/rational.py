"""Fractions: circumcenters and pieces of segments inside, the last word where floats are in doubt.

Points are arrays of fractions (see `fractions`), in the plane and in space alike.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np

from .predicates import fractions
from .regions import locate
from .triangles import in_facet


def normals_of(facets: np.ndarray) -> np.ndarray:
    """Normals of segments, to their left, or of triangles, (k, N), not of length one; of floats or fractions.

    Examples
    --------
    >>> normals_of(np.array([[(0, 0), (2, 0)]])).tolist()
    [[0, 2]]
    >>> normals_of(np.array([[(0, 0, 0), (1, 0, 0), (0, 1, 0)]])).tolist()
    [[0, 0, 1]]
    """
    legs = facets[:, 1:] - facets[:, :1]
    if facets.shape[1] == 2:
        return np.stack([-legs[:, 0, 1], legs[:, 0, 0]], axis=1)
    return np.cross(legs[:, 0], legs[:, 1])


def circumcenter_terms(d: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Twice the determinant of sides d (t, N, N) of simplices, and that times the way to the circumcenter.

    Polynomials, so that floats, Python's whole numbers and fractions can all be put in.

    Examples
    --------
    >>> circumcenter_terms(np.array([[[2, 0], [0, 4]]]))
    (array([16]), array([[16, 32]]))
    """
    lift = (d * d).sum(axis=2)
    if d.shape[2] == 2:
        (ax, ay), (bx, by) = d[:, 0].T, d[:, 1].T
        numerator = [by * lift[:, 0] - ay * lift[:, 1], ax * lift[:, 1] - bx * lift[:, 0]]
        return 2 * (ax * by - ay * bx), np.stack(numerator, axis=1)
    a, b, c = d[:, 0], d[:, 1], d[:, 2]
    bc, ca, ab = np.cross(b, c), np.cross(c, a), np.cross(a, b)
    return 2 * (a * bc).sum(axis=1), lift[:, :1] * bc + lift[:, 1:2] * ca + lift[:, 2:] * ab


def rational_circumcenter(simplex: np.ndarray) -> np.ndarray:
    """Circumcenter of a triangle (3, 2) or tetrahedron (4, 3) that is not flat, in fractions.

    Examples
    --------
    >>> rational_circumcenter(np.array([(0, 0), (1, 0), (0, 3)])).tolist()
    [Fraction(1, 2), Fraction(3, 2)]
    >>> rational_circumcenter(np.array([(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 3)])).tolist()
    [Fraction(1, 1), Fraction(1, 1), Fraction(3, 2)]
    """
    corners = fractions(simplex)
    (twice,), (way,) = circumcenter_terms((corners[1:] - corners[:1])[None])
    return corners[0] + way / twice


def clip_rational(boundary: np.ndarray, near, start: np.ndarray, end: np.ndarray, side: int) -> list[tuple]:
    """The parameter intervals of the segment start-end that lie in the closed region.

    Parameters
    ----------
    boundary : (m, N, N) float array
        All of it, as for `locate`.
    near : (k,) int array or slice
        The facets that can meet the segment.
    start, end : (N,) arrays of fractions
    side : +1 or -1
        The closed region inside, or the closure of its complement.

    Returns
    -------
    list of (t0, t1)
        Increasing, 0 <= t0 < t1 <= 1; ``[(0, 1)]`` when all of it is contained. A segment without
        length gives ``[(0, 1)]`` or ``[]``. Isolated touching points are left out.

    Examples
    --------
    >>> triangle = np.array([[[0, 0], [3, 0]], [[3, 0], [0, 3]], [[0, 3], [0, 0]]], dtype=float)
    >>> clip_rational(triangle, slice(None), fractions((-1, 1)), fractions((5, 1)), side=1)
    [(Fraction(1, 6), Fraction(1, 2))]
    """
    way = end - start
    cuts = {Fraction(0), Fraction(1)}
    if way.any():
        cuts.update(t for t in _meetings(start, way, fractions(boundary[near])) if 0 < t < 1)
    spans = list(pairwise(sorted(cuts)))
    middles = np.array([start + (t0 + t1) / 2 * way for t0, t1 in spans])
    pieces: list[tuple] = []
    for (t0, t1), where in zip(spans, side * locate(boundary, middles), strict=True):
        if where >= 0 and pieces and pieces[-1][1] == t0:
            pieces[-1] = (pieces[-1][0], t1)
        elif where >= 0:
            pieces.append((t0, t1))
    return pieces


def _meetings(start, way, facets) -> list[Fraction]:
    """Parameters at which a line meets facets; if it lies in the plane of one, at the planes of its sides."""
    normals = normals_of(facets)
    slope, height = normals @ way, ((facets[:, 0] - start) * normals).sum(axis=1)
    across = slope != 0
    t = height[across] / slope[across]
    found = t[in_facet(facets[across], start + t[:, None] * way)].tolist()
    flat = ~across & (height == 0)
    facets, sides = facets[flat], (np.roll(facets, -1, axis=1) - facets)[flat]
    inward = sides if facets.shape[1] == 2 else np.cross(normals[flat, None], sides)
    slope, height = inward @ way, ((facets - start) * inward).sum(axis=2)
    return found + (height[slope != 0] / slope[slope != 0]).tolist()
