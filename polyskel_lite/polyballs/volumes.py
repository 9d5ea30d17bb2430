"""Exact area and volume of a union of balls in space.

Two methods are in the literature. Inclusion-exclusion adds up the intersections of the pairs, triples and
quadruples in the dual complex (Edelsbrunner 1995, Attali and Edelsbrunner 2007); the other one measures the
patches of the spheres that are left on the boundary (Connolly 1983). Here the patches are measured, for two
reasons. Inclusion-exclusion needs a dual complex without a single wrong simplex, and the formula for four
balls is at its worst for flat quadruples, which cospherical points make in numbers. And the usual formula for
a patch, Gauss-Bonnet, needs the Euler number of the patch, so that one lost arc makes an error of a whole
turn. Green's theorem on the sphere needs none of this: it is a sum over arcs, right up to whole spheres.

The arcs are found sphere by sphere from its own caps, not taken from the boundary that two spheres share:
with balls that nearly coincide nobody can say where their common circle is, and an arc on one sphere only
would ruin the sum. Sphere by sphere, what one of the two balls wrongly loses is what the other one gains.

With A the area of a patch, n its normals, and c, r its ball, the divergence theorem gives the volume of the
union as the sum of (r A + c · ∫n) / 3 over all patches, and Stokes' theorem gives ∫n = ½ ∮ p × dp from the
arcs as well.

References
----------
Edelsbrunner, The union of balls and its dual shape, Discrete Comput. Geom. 13, 1995, 415-440. Attali and
Edelsbrunner, Inclusion-exclusion formulas from independent complexes, Discrete Comput. Geom. 37, 2007, 59-77.
Connolly, Analytical molecular surface calculation, J. Appl. Cryst. 16, 1983, 548-558. Van Oosterom and
Strackee, The solid angle of a plane triangle, IEEE Trans. Biomed. Eng. 30, 1983, 125-126.
"""

from __future__ import annotations

import numpy as np

from ..exact import spread_out
from .discs import Arcs, Covers, uncovered
from .pairs import frames
from .union import BallUnion, Caps

_WHOLE = 4 * np.pi
_TOUCH = 1e-12  # circles this near to each other, on the unit sphere, touch or are the same
_PIECES = 4  # so that no piece of an arc turns by more than a right angle
_CLOSE = 0.1  # patches and covered parts up to this share of the sphere are told apart by looking at points
# Directions all around, from which each sphere takes one that is far from the ends of its arcs.
_HEIGHT = 1 - (2 * np.arange(32) + 1) / 32
_POLES = np.sqrt(1 - _HEIGHT**2) * np.array([np.cos(2.4 * np.arange(32)), np.sin(2.4 * np.arange(32))])
_POLES = np.column_stack([_POLES.T, _HEIGHT])


def surface_area(union: BallUnion) -> float:
    """Compute the area of the boundary of a union of balls, walls of cavities included.

    Returns
    -------
    float

    Notes
    -----
    Exact to rounding, about 1e-15 r² for each ball in general position. Circles closer than 1e-12 r to
    touching or to each other count as doing so, which may cost 1e-12 r²; of two balls at a distance d
    so small that the plane between them is known only to rounding / d, the sum is exact, not the share
    of each.

    Examples
    --------
    Two unit balls with centres 1 apart show three quarters of their spheres:

    >>> two = BallUnion(np.array([(0.0, 0, 0), (1, 0, 0)]), np.ones(2))
    >>> round(surface_area(two) / np.pi, 12)
    6.0
    """
    return float(patch_areas(union)[0].sum())


def volume(union: BallUnion) -> float:
    """Compute the volume of a union of balls.

    Returns
    -------
    float

    Notes
    -----
    As exact as `surface_area`, with the error of each patch multiplied by its distance from the middle of the
    balls.

    Examples
    --------
    Two unit balls with centres 1 apart, whose caps of height 1/2 are cut off, 5π/24 each:

    >>> two = BallUnion(np.array([(0.0, 0, 0), (1, 0, 0)]), np.ones(2))
    >>> round(volume(two) / np.pi, 12), 2 * (4 / 3 - 5 / 24)
    (2.25, 2.25)
    """
    areas, normals = patch_areas(union)
    places = union.centers - (union.centers.min(axis=0) + union.centers.max(axis=0)) / 2
    return float((union.radii * areas + (places * normals).sum(axis=1)).sum() / 3)


def patch_areas(union: BallUnion) -> tuple[np.ndarray, np.ndarray]:
    """Measure what is left of each sphere on the boundary of the union.

    Returns
    -------
    areas : (k,) float array
    normals : (k, 3) float array
        The integral of the outward normal.

    Examples
    --------
    >>> two = BallUnion(np.array([(0.0, 0, 0), (1, 0, 0)]), np.ones(2))
    >>> areas, normals = patch_areas(two)
    >>> (areas / np.pi).round(12).tolist(), (normals[:, 0] / np.pi).round(12).tolist()
    ([3.0, 3.0], [-0.75, 0.75])
    """
    count = len(union.radii)
    covered = union.caps
    row, start, end = _arcs(covered)
    ball = covered.ball[row].astype(np.intp)  # what bincount takes in a browser
    x, y, axis = frames(covered.axes)[row].swapaxes(0, 1)
    h = covered.heights[row]
    s = np.sqrt(np.maximum(1 - h**2, 0))
    swing = (np.sin(end) - np.sin(start))[:, None] * x - (np.cos(end) - np.cos(start))[:, None] * y
    # Arcs run around caps; the patch is on their right.
    normal = (h * s)[:, None] * swing - (s**2 * (end - start))[:, None] * axis
    normals = np.stack([np.bincount(ball, column, count) for column in normal.T], axis=1)

    angle = start + np.linspace(0, 1, _PIECES + 1)[:, None] * (end - start)
    places = np.cos(angle)[..., None] * x + np.sin(angle)[..., None] * y
    places = h[:, None] * axis + s[:, None] * places
    pole = _far_poles(ball, places, count)
    a, b = places[:-1], places[1:]
    near = np.where(h < 0, -1.0, 1.0)
    # Between an arc and its chords, then between its chords and the pole; both up to whole spheres.
    sectors = near * (end - start) * s**2 / (1 + np.abs(h))
    slices = sectors - _triangles(near[:, None] * axis, a, b).sum(axis=0)
    turned = slices + _triangles(_POLES[pole[ball]], a, b).sum(axis=0)
    share = -np.bincount(ball, turned, count) % _WHOLE
    # Rounding may turn almost nothing into almost all: look at some points.
    free = _free_share(covered)
    share[(free < 0.5) & (share > (1 - _CLOSE) * _WHOLE)] -= _WHOLE
    share[(free > 0.5) & (share < _CLOSE * _WHOLE)] += _WHOLE
    share = np.clip(share, 0, _WHOLE)
    share[(np.diff(covered.first) == 0) & ~union.exposed] = 0
    return share * union.radii**2, normals * (union.radii**2 / 2)[:, None]


def _arcs(covered: Caps) -> Arcs:
    """The arcs of the edge of each cap that no other cap of its sphere covers.

    Every sphere decides for itself, from its own caps. So the arcs around a patch follow each other, and
    neither spheres that nearly coincide nor many that pass through one point tear them apart.
    """
    ball = covered.ball
    row, other = spread_out(np.diff(covered.first)[ball])
    other += covered.first[ball[row]]
    row, other = row[row != other], other[row != other]
    x, y, axis = frames(covered.axes).swapaxes(0, 1)
    s = np.sqrt(np.maximum(1 - covered.heights**2, 0))
    to = covered.axes[other]
    u, v, c = ((frame[row] * to).sum(axis=1) for frame in (x, y, axis))
    h, k = covered.heights[row], covered.heights[other]
    across, excess = s[row] * np.hypot(u, v), k - h * c
    # Circles that touch within rounding must touch as seen from both, hence the size of the other one.
    touch = _TOUCH * s[other]
    outside, inside = excess >= across - touch, excess <= touch - across
    side = np.where(c < 0, -1.0, 1.0)
    same = (np.abs(to - side[:, None] * axis[row]).max(axis=1) <= _TOUCH) & (np.abs(k - side * h) <= _TOUCH)
    # Of equal caps the first one has the edge; caps that share an edge from both sides leave nothing.
    outside = np.where(same, (side < 0) | (row < other), outside & ~inside)
    inside = np.where(same, ~outside, inside)
    hidden = np.isin(np.arange(len(ball)), row[inside])
    some = ~(inside | outside) & ~hidden[row]
    row, across, excess, u, v = row[some], across[some], excess[some], u[some], v[some]
    covers = Covers.about(row, u, v, across - excess, across + excess, np.zeros(len(row)))
    return uncovered(covers, np.flatnonzero(~hidden))[0]


def _free_share(covered: Caps) -> np.ndarray:
    """The share of the poles of each sphere that is in no cap, (k,)."""
    inside = covered.axes @ _POLES.T > covered.heights[:, None]
    degree = np.diff(covered.first)
    hidden = np.zeros((len(degree), len(_POLES)), dtype=bool)
    hidden[degree > 0] = np.logical_or.reduceat(inside, covered.first[:-1][degree > 0])
    return 1 - hidden.mean(axis=1)


def _far_poles(ball, places, count) -> np.ndarray:
    """For each ball the pole whose opposite point is farthest from all ends of arcs."""
    chosen = np.zeros(count, dtype=np.int64)
    first = np.flatnonzero(np.diff(ball, prepend=-1))
    away = np.min([(1 + ends @ _POLES.T) for ends in places], axis=0)
    chosen[ball[first]] = np.minimum.reduceat(away, first).argmax(axis=1)
    return chosen


def _triangles(pole, a, b) -> np.ndarray:
    """Signed areas of the triangles (pole, a, b) of the unit sphere, (pieces, m)."""
    volume = (pole * np.cross(a, b)).sum(axis=-1)
    return 2 * np.arctan2(volume, 1 + (pole * (a + b)).sum(axis=-1) + (a * b).sum(axis=-1))
