"""What the criteria of section 4.3 are made of: facets' measures, and the angles between faces."""

from __future__ import annotations

import numpy as np

from ..graphs import OPPOSITE, Tessellation, ordinary


def _facet_normals(tessellation: Tessellation, rows) -> np.ndarray:
    """Twice the area vector of each triangle opposite a corner, pointing outward, (4, 3, t)."""
    corners = tessellation.points.T[:, tessellation.simplices[rows].T]
    normals = np.empty((4, 3, corners.shape[2]))
    for i, (a, b, c) in enumerate(OPPOSITE[4]):
        (ux, uy, uz), (vx, vy, vz) = corners[:, b] - corners[:, a], corners[:, c] - corners[:, a]
        normals[i] = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    return normals


def facet_measures(tessellation: Tessellation, rows=slice(None)) -> np.ndarray:
    """Length (2D) or area (3D) of the facet opposite each corner of each simplex, (t, N+1).

    Parameters
    ----------
    tessellation : Tessellation
    rows : (t,) int array, optional
        Only these simplices.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> facet_measures(psl.delaunay([(0, 0), (4, 0), (0, 3)])).tolist()
    [[5.0, 3.0, 4.0]]
    """
    scaled, exponent = ordinary(tessellation)
    if tessellation.dimension == 3:
        return np.ldexp(np.sqrt((_facet_normals(scaled, rows) ** 2).sum(axis=1)).T / 2, 2 * exponent)
    ends = scaled.points[scaled.simplices[rows][:, OPPOSITE[3]]]
    return np.ldexp(np.sqrt(((ends[:, :, 1] - ends[:, :, 0]) ** 2).sum(axis=2)), exponent)


def face_angles(tessellation: Tessellation, rows=slice(None), dihedral: bool = False) -> np.ndarray:
    """Angles in radians between the outward normals of the six pairs of faces of each tetrahedron, (t, 6).

    Parameters
    ----------
    tessellation : Tessellation
        In 3D.
    rows : (t,) int array, optional
        Only these simplices.
    dihedral : bool
        Return the angle between the faces themselves instead, which is pi minus the other.

    Returns
    -------
    (t, 6) float array
        Faces opposite corners (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3).

    Examples
    --------
    A corner of a cube: three faces at right angles.

    >>> import polyskel_lite as psl
    >>> corner = psl.delaunay([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    >>> (face_angles(corner)[0] / np.pi).round(3).tolist()
    [0.696, 0.696, 0.696, 0.5, 0.5, 0.5]
    """
    normals = _facet_normals(ordinary(tessellation)[0], rows)
    normals /= np.sqrt((normals**2).sum(axis=1, keepdims=True))
    pairs = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
    cosine = np.stack([(normals[i] * normals[j]).sum(axis=0) for i, j in pairs], axis=1)
    angles = np.arccos(np.clip(cosine, -1, 1))
    return np.pi - angles if dihedral else angles
