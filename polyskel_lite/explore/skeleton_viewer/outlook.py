"""From where a solid is seen at first: from the side on which the least of its skeleton hides."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...drawing import VIEW

_RASTERS = {
    10: 4,
    20: 2,
    40: 1,
}  # cells along the diagonal of the box, and the weight of each that is covered
_MOST = 4000  # points looked at


def camera(view, points: np.ndarray) -> tuple[dict[str, float], int]:
    """Elevation and azimuth in degrees, and which axis points up; what `view` leaves open is chosen here.

    Parameters
    ----------
    view : (elevation, azimuth), dict or None
        As for `polyskel_lite.explore.viewer`.
    points : (n, N) array
        Of the skeleton as it is shown first.

    Examples
    --------
    >>> camera((30, 60), np.zeros((1, 3)))
    ({'elev': 30.0, 'azim': 60.0}, 2)
    >>> camera({"vertical_axis": "x", "azim": 7}, np.zeros((1, 2)))
    ({'elev': 22.0, 'azim': 7.0}, 0)
    """
    if not isinstance(view, Mapping):
        view = {} if view is None else dict(zip(VIEW, view, strict=True))
    up = "xyz".index(view.get("vertical_axis", "z"))
    given = {name: float(view[name]) for name in VIEW if name in view}
    if len(given) < len(VIEW):
        open_view = clear_view(np.roll(points, 2 - up, axis=1)) if points.shape[1] == 3 else VIEW
        given = open_view | given
    return given, up


def clear_view(points: np.ndarray) -> dict[str, float]:
    """The elevation and azimuth, of some hundred, from which the points cover most of three rasters.

    Where one part of a skeleton stands before another, or points at the reader, it covers less. Of several
    such places it is the one nearest to the usual camera.

    Examples
    --------
    >>> ring = np.array([(np.cos(t), np.sin(t), 0) for t in np.linspace(0, 6.28, 200)])
    >>> clear_view(ring)["elev"] >= 50  # from above
    True
    """
    if not len(points):
        return dict(VIEW)
    points = points[:: len(points) // _MOST + 1] - points.mean(axis=0)
    size = np.linalg.norm(np.ptp(points, axis=0)) or 1.0
    best = None
    for elevation in range(10, 71, 10):
        for azimuth in range(-180, 180, 10):
            a, e = np.radians([azimuth, elevation])
            right = -np.sin(a), np.cos(a), 0
            up = -np.sin(e) * np.cos(a), -np.sin(e) * np.sin(a), np.cos(e)
            # Rounding keeps the last digit of a coordinate from deciding about a cell.
            seen = np.round(points @ np.transpose([right, up]) / size, 9)
            covered = sum(
                weight * len(np.unique(np.floor(seen * cells).astype(int) @ (1, 1000)))
                for cells, weight in _RASTERS.items()
            )
            apart = (azimuth - VIEW["azim"] + 180) % 360 - 180
            found = (covered, -np.hypot(elevation - VIEW["elev"], apart), elevation, azimuth)
            best = found if best is None else max(best, found)
    assert best is not None
    return {"elev": float(best[2]), "azim": float(best[3])}
