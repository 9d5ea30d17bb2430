"""The part of each sphere that other balls cover: one cap for each ball whose sphere crosses it.

A point of a sphere is on the boundary of the union iff it is in no cap. Only power neighbours have to be
asked, because what is left of a sphere is the part in its own power cell.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .pairs import circle_offset, lengths, relations
from .union import BallUnion


class Caps(NamedTuple):
    """Caps of all spheres, sphere by sphere, the largest one first.

    Attributes
    ----------
    first : (k + 1,) int array
        Rows ``first[i]`` to ``first[i + 1]`` are the caps of sphere i.
    axes : (m, 3) float array
        Unit vectors to the middles of the caps.
    heights : (m,) float array
        p is in the cap if (p - c) · axis > height · radius.
    """

    first: np.ndarray
    axes: np.ndarray
    heights: np.ndarray


def caps(union: BallUnion) -> Caps:
    """List the caps of all spheres of balls in space.

    Balls that touch, and balls that stick out of another one by nothing but rounding, make no cap; the arcs
    of `polyskel_lite.polyballs.spheres` ignore them in the same way.

    Examples
    --------
    >>> found = caps(BallUnion(np.array([(0.0, 0, 0), (1, 0, 0)]), np.ones(2)))
    >>> found.first.tolist(), found.heights.tolist()
    ([0, 1, 2], [0.5, 0.5])
    """
    centers, radii = union.centers, union.radii
    crossing = relations(centers, radii, *union.power.faces(2).T)[1]
    i, j = np.concatenate([crossing, crossing[:, ::-1]]).T
    across = centers[j] - centers[i]
    d = lengths(across)
    heights = circle_offset(d, radii[i], radii[j]) / radii[i]
    order = np.lexsort((heights, i))
    first = np.searchsorted(i[order], np.arange(len(radii) + 1))
    return Caps(first, (across / d[:, None])[order], heights[order])
