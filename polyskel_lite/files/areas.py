"""What a file of outlines holds: areas, each of some rings that are filled together."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Area(NamedTuple):
    """Rings that are filled by one rule; what a file shows is the union of its areas.

    Attributes
    ----------
    rings : list of (k, 2) float arrays
    names : list of str
        What messages call the rings.
    rule : "nonzero", "evenodd", "first" or "nested"
        SVG's fill rules; the first ring without the others, as in GeoJSON; or a ring inside another one is
        a hole, and rings that cross are united.
    clips : tuple of list of Area
        Only what is in the union of each of these is shown.
    """

    rings: list
    names: list
    rule: str
    clips: tuple = ()


def distinct(ring: np.ndarray) -> np.ndarray:
    """The ring without vertices that repeat the one before.

    Examples
    --------
    >>> distinct(np.array([(0, 0), (1, 0), (1, 0), (0, 1), (0, 0)])).tolist()
    [[1, 0], [0, 1], [0, 0]]
    """
    return ring[(ring != np.roll(ring, 1, axis=0)).any(axis=1)]
