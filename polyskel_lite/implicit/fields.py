"""Solids given by a formula: fields that are negative inside, and uniform closed meshes of them.

The shapes here are own work, free of all rights (CC0). Their sizes are easy to change and their Betti
numbers are known, so chapters and tests use them where a handle or a cavity is needed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from ..checks import as_array, as_flag, as_floats, as_instance, as_number, as_points, shown
from ..errors import InputError

#: Corners of a chain, when it is cut so finely that the nearest corner tells the nearest segment.
MOST_CORNERS = 1_000_000


@dataclass(frozen=True)
class Field:
    """A function of space, negative inside a solid, with a box that holds the solid.

    Attributes
    ----------
    value : callable
        From (k, 3) points to (k,) numbers. Near the surface its gradient must not vanish; it need not
        be a distance.
    box : (2, 3) array-like
        Lowest and highest corner.

    Examples
    --------
    >>> ball = Field(lambda x: (x**2).sum(axis=1) - 1, [(-1.1, -1.1, -1.1), (1.1, 1.1, 1.1)])
    >>> ball(np.array([[0, 0, 0], [2, 0, 0]])).tolist()
    [-1, 3]
    """

    value: Callable[[np.ndarray], np.ndarray]
    box: np.ndarray

    def __post_init__(self):
        if not callable(self.value):
            raise InputError(
                f"value is {shown(self.value)}; pass a function from (k, 3) points to (k,) numbers."
            )
        object.__setattr__(self, "box", as_box(self.box))

    def __call__(self, points) -> np.ndarray:
        points = as_array(points, "points", "a (k, 3) array")
        if points.ndim != 2 or points.shape[1] != 3:
            raise InputError(f"points has shape {points.shape}; pass a (k, 3) array.")
        return self.value(points)


def as_box(box) -> np.ndarray:
    """Return the two corners of a box as a float array (2, 3), or say what is wrong.

    Examples
    --------
    >>> as_box([(0, 0, 0), (1, 1, 0)])
    Traceback (most recent call last):
    polyskel_lite.errors.InputError: box must have two rows, its lowest and its highest corner.
    """
    box = as_points(box, name="box", dimensions=(3,))
    if box.shape != (2, 3) or not (box[0] < box[1]).all():
        raise InputError("box must have two rows, its lowest and its highest corner.")
    return box


def _place(center) -> np.ndarray:
    center = as_floats(center, "center", "three numbers")
    if center.shape != (3,):
        raise InputError(f"center has shape {center.shape}; pass three numbers.")
    return center


def _lengths(**lengths) -> list[float]:
    return [
        as_number(value, name, "a positive length", 0, 1e100, above=True) for name, value in lengths.items()
    ]


def ball(center: ArrayLike = (0.0, 0.0, 0.0), radius: float = 1.0) -> Field:
    """A ball.

    Examples
    --------
    >>> ball(radius=2.0)([[0, 0, 3]]).tolist()
    [1.0]
    """
    center, (radius,) = _place(center), _lengths(radius=radius)
    return Field(lambda x: np.linalg.norm(x - center, axis=1) - radius, _box(center[None], radius))


def torus(major: float = 1.0, minor: float = 0.4, center: ArrayLike = (0.0, 0.0, 0.0)) -> Field:
    """A ring around the z axis: Betti numbers (1, 1, 0).

    Parameters
    ----------
    major, minor : float
        Radius of the circle, and of the tube around it.
    center : triple of float

    Examples
    --------
    >>> torus()([[1, 0, 0]]).round(3).tolist()
    [-0.4]
    """
    center, (major, minor) = _place(center), _lengths(major=major, minor=minor)

    def value(x):
        y = x - center
        return np.hypot(np.hypot(y[:, 0], y[:, 1]) - major, y[:, 2]) - minor

    reach = np.array([major + minor, major + minor, minor])
    return Field(value, np.stack([center - 1.1 * reach, center + 1.1 * reach]))


def double_torus(major: float = 1.0, minor: float = 0.4) -> Field:
    """Two rings side by side, grown together: Betti numbers (1, 2, 0).

    Examples
    --------
    >>> double_torus()([[0, 0, 0], [1.1, 0, 0]]).round(2).tolist()
    [-0.33, 0.6]
    """
    major, minor = _lengths(major=major, minor=minor)
    shift = (major + 0.25 * minor, 0.0, 0.0)
    left = torus(major, minor, center=[-s for s in shift])
    return union(left, torus(major, minor, center=shift), blend=0.1 * minor)


def hollow_ball(outer: float = 1.0, inner: float = 0.5) -> Field:
    """A ball with a cavity in its middle: Betti numbers (1, 0, 1).

    Examples
    --------
    >>> hollow_ball()([[0, 0, 0], [0.75, 0, 0]]).tolist()
    [0.5, -0.25]
    """
    return difference(ball(radius=outer), ball(radius=inner))


def capsule(length: float = 2.0, radius: float = 0.5) -> Field:
    """All points within ``radius`` of a segment along x.

    Examples
    --------
    >>> capsule()([[0.5, 0.75, 0], [1.5, 0, 0]]).tolist()
    [0.25, 0.0]
    """
    length, radius = _lengths(length=length, radius=radius)
    return tube([(-length / 2, 0, 0), (length / 2, 0, 0)], radius)


def trefoil(radius: float = 0.45) -> Field:
    """A tube along the trefoil knot (sin t + 2 sin 2t, cos t - 2 cos 2t, -sin 3t): Betti numbers (1, 1, 0).

    Examples
    --------
    >>> trefoil()([[0, -1, 0]]).round(2).tolist()
    [-0.45]
    """
    t = np.linspace(0, 2 * np.pi, 240, endpoint=False)
    knot = np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], axis=1)
    return tube(knot, radius, closed=True)


def tetrapod(length: float = 1.0, root: float = 0.3, tip: float = 0.18) -> Field:
    """Four bent arms from one centre, thinner toward their tips: a solid with four branches.

    Examples
    --------
    >>> tetrapod()([[0, 0, 0]]) < 0
    array([ True])
    """
    length, root, tip = _lengths(length=length, root=root, tip=tip)
    ends = length * np.array([(1, 0.3, 0.4), (-0.5, 0.9, -0.4), (-0.6, -0.5, 0.8), (0.2, -0.7, -1.0)])
    bends = length * np.array([(0.5, -0.1, 0.4), (-0.4, 0.4, 0.1), (-0.4, -0.4, 0.2), (0.2, -0.5, -0.4)])
    arms = [arm([(0, 0, 0), bend, end], root, tip) for bend, end in zip(bends, ends, strict=True)]
    return union(*arms, blend=0.2 * root)


def arm(control: ArrayLike, root: float, tip: float, pieces: int = 40) -> Field:
    """A ball swept along a Bézier curve, its radius going from ``root`` to ``tip``.

    Parameters
    ----------
    control : (c, 3) array-like
        Control points of the curve, two or more.
    root, tip : float
        Radii at the two ends.
    pieces : int
        Into how many straight pieces the curve is cut.

    Examples
    --------
    >>> arm([(0, 0, 0), (1, 0, 0)], 0.5, 0.25)([[1, 0, 0]]).tolist()
    [-0.25]
    """
    points = as_points(control, name="control", dimensions=(3,))
    if not 2 <= len(points) <= 1000:
        raise InputError(f"control has {len(points)} points; pass 2 to 1000.")
    root, tip = _lengths(root=root, tip=tip)
    pieces = as_number(pieces, "pieces", "a whole number, 1 to 10,000", 1, 10_000, whole=True)
    t = np.linspace(0, 1, pieces + 1)[:, None]
    points = [point[None] for point in points]
    while len(points) > 1:  # de Casteljau, for all t at once
        points = [(1 - t) * a + t * b for a, b in pairwise(points)]
    return tube(points[0], np.linspace(root, tip, pieces + 1))


def tube(points: ArrayLike, radius: ArrayLike, closed: bool = False) -> Field:
    """All points within ``radius`` of a chain of segments.

    Parameters
    ----------
    points : (c, 3) array-like
        Corners of the chain, close together where it bends.
    radius : float or (c,) array-like
        One for all, or one per corner (linear between; it should change slowly).
    closed : bool
        Whether the last corner is joined to the first.

    Examples
    --------
    >>> tube([(0, 0, 0), (1, 0, 0), (1, 1, 0)], 0.25)([[0.5, 0.5, 0]]).tolist()
    [0.25]
    """
    points, radius = as_points(points, dimensions=(3,)), as_floats(radius, "radius")
    closed = as_flag(closed, "closed")
    if len(points) < 2 or radius.shape not in ((), (1,), (len(points),)) or not (radius > 0).all():
        raise InputError(
            f"{len(points)} points and radius of shape {radius.shape}; pass two points or more, and one "
            "positive radius, or one for each point."
        )
    radius = np.broadcast_to(radius, len(points))
    box = _box(points, radius.max())
    points, radius = _finely(points, radius, closed)
    tree, c = cKDTree(points), len(points)

    def value(x):
        # The segments of a fine chain are short, so the nearest one is at the nearest corner.
        nearest = tree.query(x)[1]
        out = np.full(len(x), np.inf)
        for step in (-1, 1):
            other = (nearest + step) % c if closed else np.clip(nearest + step, 0, c - 1)
            a, way = points[nearest], points[other] - points[nearest]
            length2 = np.maximum((way**2).sum(axis=1), 1e-300)
            t = np.clip(((x - a) * way).sum(axis=1) / length2, 0, 1)
            distance = np.linalg.norm(x - a - t[:, None] * way, axis=1)
            out = np.minimum(out, distance - (radius[nearest] + t * (radius[other] - radius[nearest])))
        return out

    return Field(value, box)


def union(*fields: Field, blend: float = 0.0) -> Field:
    """All solids together; a positive ``blend`` (a length) rounds the seams.

    Examples
    --------
    >>> union(ball(), ball(center=(3, 0, 0)))([[3, 0, 0], [1.5, 0, 0]]).tolist()
    [-1.0, 0.5]
    """
    for field in fields:
        as_instance(field, Field, "a part", "fields, such as ball()")
    if not fields:
        raise InputError("there is nothing to unite; pass fields, such as ball().")
    blend = as_number(blend, "blend", "a length", high=1e100)

    def value(x):
        each = np.array([f(x) for f in fields])
        least = each.min(axis=0)
        if blend <= 0:
            return least
        return least - blend * np.log(np.exp((least - each) / blend).sum(axis=0))

    low = np.min([f.box[0] for f in fields], axis=0) - blend
    return Field(value, np.stack([low, np.max([f.box[1] for f in fields], axis=0) + blend]))


def difference(first: Field, second: Field) -> Field:
    """The first solid without the second.

    Examples
    --------
    >>> difference(ball(), ball(radius=0.5))([[0, 0, 0]]).tolist()
    [0.5]
    """
    for field in (first, second):
        as_instance(field, Field, "a part", "fields, such as ball()")
    return Field(lambda x: np.maximum(first(x), -second(x)), first.box)


def _finely(points, radius, closed):
    """The chain with corners at most half the least radius apart."""
    corners = np.column_stack([points, radius])
    corners = np.concatenate([corners, corners[:1]]) if closed else corners
    length = np.linalg.norm(np.diff(corners[:, :3], axis=0), axis=1)
    with np.errstate(over="ignore"):
        pieces = np.maximum(1, np.ceil(2 * length / radius.min()))
    if not pieces.sum() <= MOST_CORNERS:
        raise InputError(
            f"a chain of length {length.sum():g} with radius {radius.min():g} is too thin; pass at least "
            f"{2 * length.sum() / MOST_CORNERS:.2g}."
        )
    pieces = pieces.astype(int)
    fine = [
        np.linspace(a, b, k, endpoint=False)
        for (a, b), k in zip(pairwise(corners), pieces.tolist(), strict=True)
    ]
    fine = np.concatenate(fine if closed else [*fine, corners[-1:]])
    return fine[:, :3], fine[:, 3]


def _box(points, margin):
    return np.stack([points.min(axis=0) - 1.1 * margin, points.max(axis=0) + 1.1 * margin])
