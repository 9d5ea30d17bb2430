"""Maximal balls of a polygon itself, not of samples: grown from a contact, and with all their contacts.

The centres of all maximal balls (section 2.1) are the skeleton that Sk0 to Sk3 approximate.
"""

from __future__ import annotations

import numpy as np

from ..errors import InputError
from ..exact import nearest_on_segments
from ..shapes import Shape, check_shape, local_width


def grown_ball(shape: Shape, center) -> tuple[float, np.ndarray, float]:
    """Radius of the ball around a centre, and centre and radius of the maximal ball with its first contact.

    Parameters
    ----------
    shape : Shape
        In 2D.
    center : (x, y)
        Inside the shape, not on its boundary.

    Returns
    -------
    radius : float
    center : (2,) float array
    radius of the maximal ball : float

    Raises
    ------
    InputError
        If the shape is in space.

    References
    ----------
    The shrinking ball of J. Ma, S. W. Bae, S. Choi, 3D medial axis point approximation using nearest
    neighbors and the normal field, 2012.

    Examples
    --------
    >>> radius, center, full = grown_ball(Shape.from_rings([[(0, 0), (6, 0), (6, 2), (0, 2)]]), (3, 0.5))
    >>> radius, center.round(6).tolist(), round(full, 6)
    (0.5, [3.0, 1.0], 1.0)
    """
    center = np.asarray(center, dtype=float)
    feet, distances = _feet(shape, center)
    first = distances.argmin()
    radius = float(distances[first])
    away = (center - feet[first]) / radius
    full = max(radius, float(local_width(shape.segments, feet[[first]], away[None])[0]))
    return radius, feet[first] + full * away, full


def contact_points(shape: Shape, center, radius: float, share: float = 1e-6) -> np.ndarray:
    """The points in which a ball inside a shape touches the boundary, each once.

    Parameters
    ----------
    shape : Shape
        In 2D.
    center : (x, y)
    radius : float
    share : float
        Points farther away than the radius by up to this share of it count.

    Returns
    -------
    (c, 2) float array

    Raises
    ------
    InputError
        If the shape is in space.

    Examples
    --------
    >>> bar = Shape.from_rings([[(0, 0), (6, 0), (6, 2), (0, 2)]])
    >>> contact_points(bar, (3, 1), 1).tolist()
    [[3.0, 0.0], [3.0, 2.0]]
    """
    feet, distances = _feet(shape, np.asarray(center, dtype=float))
    kept: list[np.ndarray] = []
    for point in feet[distances <= radius * (1 + share)]:
        # Two sides share the corner in which they touch the ball.
        if all(np.hypot(*(point - other)) > 1e-3 * radius for other in kept):
            kept.append(point)
    return np.array(kept).reshape(-1, 2)


def _feet(shape: Shape, center: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The point of each side that is nearest to the centre, and its distance."""
    check_shape(shape)
    if shape.dimension != 2:
        raise InputError("maximal balls are grown in shapes of the plane; this one is a solid.")
    feet = nearest_on_segments(center, shape.segments)
    return feet, np.hypot(*(feet - center).T)
