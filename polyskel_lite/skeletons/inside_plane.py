"""Where Voronoi edges cross the boundary of a shape in the plane: floats with an error bound."""

from __future__ import annotations

import numpy as np


def crossing(edges, segments, slack):
    """Where edges (k, 2, 2) cross segments: parameter on the edge, whether surely, whether in doubt.

    ``slack`` (k,) bounds the error of the ends.

    Examples
    --------
    >>> edge, segment = np.array([[[0.0, 0], [4, 0]]]), np.array([[[1.0, -1], [1, 1]]])
    >>> [array.tolist() for array in crossing(edge, segment, np.zeros(1))]
    [[0.25], [True], [False]]
    """
    p, d = edges[:, 0], edges[:, 1] - edges[:, 0]
    a, e = segments[:, 0], segments[:, 1] - segments[:, 0]

    def cross(u, v):
        return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]

    # Signed distances of each one's ends to the other one's line; rounding and slack blur them.
    length_d, length_e = np.linalg.norm(d, axis=1), np.linalg.norm(e, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        of_edge = np.stack([cross(e, p - a), cross(e, p + d - a)]) / length_e
        of_segment = np.stack([cross(d, a - p), cross(d, a + e - p)]) / length_d
        span = length_d + length_e + np.linalg.norm(a - p, axis=1)
        blur = 2 * slack + 16 * 2.0**-53 * span
        # Tilting the edge by its error moves its line at most this much where the segment is.
        blur_segment = blur * (1 + 2 * span / length_d)
        t = of_edge[0] / (of_edge[0] - of_edge[1])
    meets = (of_edge[0] * of_edge[1] < 0) & (of_segment[0] * of_segment[1] < 0)
    apart = (np.abs(of_edge) > blur).all(axis=0) & (of_edge[0] * of_edge[1] > 0)
    apart |= (np.abs(of_segment) > blur_segment).all(axis=0) & (of_segment[0] * of_segment[1] > 0)
    sure = (np.abs(of_edge) > blur).all(axis=0) & (np.abs(of_segment) > blur_segment).all(axis=0)
    return t, meets & sure, ~(apart | sure)
