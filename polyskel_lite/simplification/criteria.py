"""What the criteria of section 4.3 are made of: facets' measures, and the angles between faces."""

from __future__ import annotations

import numpy as np

from ..graphs import OPPOSITE, Tessellation, corners_of, in_blocks, ordinary


def _facet_vectors(tessellation: Tessellation, rows) -> np.ndarray:
    """Of the facet opposite each corner the way (2D) or twice the area vector, outward (3D), (N+1, N, t)."""
    corners = corners_of(tessellation.points, tessellation.simplices[rows]).T
    base, *ends = (corners[:, k] for k in OPPOSITE[corners.shape[1]].T)
    if len(ends) == 1:
        return (ends[0] - base).swapaxes(0, 1)
    (ux, uy, uz), (vx, vy, vz) = ends[0] - base, ends[1] - base
    return np.stack([uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx], axis=1)


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

    def measures(rows):
        return (np.sqrt((_facet_vectors(scaled, rows) ** 2).sum(axis=1)).T,)

    (found,) = in_blocks(measures, np.arange(len(scaled.simplices))[rows])
    return np.ldexp(found, exponent) if tessellation.dimension == 2 else np.ldexp(found / 2, 2 * exponent)


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
    scaled, _ = ordinary(tessellation)

    def angles(rows):
        normals = _facet_vectors(scaled, rows)
        normals /= np.sqrt((normals**2).sum(axis=1, keepdims=True))
        pairs = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
        cosine = np.stack([(normals[i] * normals[j]).sum(axis=0) for i, j in pairs])
        return (np.arccos(np.clip(cosine, -1, 1)).T,)

    (found,) = in_blocks(angles, np.arange(len(scaled.simplices))[rows])
    return np.pi - found if dihedral else found
