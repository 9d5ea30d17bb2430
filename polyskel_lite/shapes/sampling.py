"""How densely samples cover a boundary, and samples at equal distances along it (section 2.1)."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..checks import as_number, check_squares

#: Samples of one shape: their tessellation takes a minute.
MOST_SAMPLES = 1_000_000


def sample_rings(rings: list[np.ndarray], n: int, start: float) -> list[np.ndarray]:
    """Points at equal distances along every ring (k, 2), shared among the rings by length.

    Examples
    --------
    >>> square = np.array([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> sample_rings([square], 4, 0.5)[0].tolist()
    [[1.0, 0.0], [2.0, 1.0], [1.0, 2.0], [0.0, 1.0]]
    """
    closed = [np.concatenate([ring, ring[:1]]) for ring in rings]
    along = [np.concatenate([[0], np.cumsum(np.hypot(*np.diff(c, axis=0).T))]) for c in closed]
    least = 3 * len(closed)
    what = f"a whole number of samples for {len(closed)} rings, {least} to {MOST_SAMPLES:,}"
    n = as_number(n, "n", what, least, MOST_SAMPLES, whole=True)
    start = as_number(start, "start", "a share of one step, such as 0.5")
    lengths = np.array([s[-1] for s in along])
    # Largest remainders: the shares are fair and sum to n.
    ideal = n * lengths / lengths.sum()
    share = np.maximum(3, np.floor(ideal)).astype(int)
    while share.sum() != n:
        step = 1 if share.sum() < n else -1
        gain = np.where((step < 0) & (share <= 3), -np.inf, step * (ideal - share))
        share[np.argmax(gain)] += step
    out = []
    for c, s, k in zip(closed, along, share, strict=True):
        at = (np.arange(k) + start) * s[-1] / k % s[-1]
        out.append(np.stack([np.interp(at, s, c[:, 0]), np.interp(at, s, c[:, 1])], axis=1))
    return out


def covering_radius(facets: np.ndarray, vertices: np.ndarray, E: np.ndarray) -> float:
    """Largest distance from facets (m, N, N), with these vertices, to the samples.

    Right to 1e-9 of itself (1e-6 in 3D): facets are cut as long as a piece could hold the maximum.

    Examples
    --------
    >>> triangle = np.array([[0, 0, 0], [3, 0, 0], [0, 4, 0]], dtype=float)
    >>> round(covering_radius(triangle[None], triangle, triangle), 5)
    2.5
    """
    check_squares(vertices, E)
    tree = cKDTree(E)
    best = float(max(tree.query(vertices)[0].max(), 0.0))
    # Far from the origin floats are too coarse to say more.
    coarse = 16 * np.finfo(float).eps * np.abs(vertices).max()
    share = 1e-9 if facets.shape[1] == 2 else 1e-6
    while len(facets):
        middle = (facets.min(axis=1) + facets.max(axis=1)) / 2
        reach = np.linalg.norm(facets - middle[:, None], axis=2).max(axis=1)
        distance = tree.query(middle)[0]
        inner = distance if facets.shape[1] == 2 else tree.query(facets.mean(axis=1))[0]
        best = max(best, float(inner.max()))
        # The distance to the samples changes by at most the way walked, so other facets cannot beat `best`.
        facets = halved(facets[distance + reach > best * (1 + share) + coarse])
    return best


def halved(facets: np.ndarray) -> np.ndarray:
    """Two pieces of every segment, four of every triangle, each half as long.

    Examples
    --------
    >>> halved(np.array([[[0, 0], [4, 0]]])).tolist()
    [[[0.0, 0.0], [2.0, 0.0]], [[2.0, 0.0], [4.0, 0.0]]]
    """
    if facets.shape[1] == 2:
        a, b = facets.transpose(1, 0, 2)
        pieces = ((a, (a + b) / 2), ((a + b) / 2, b))
    else:
        a, b, c = facets.transpose(1, 0, 2)
        d, e, f = (a + b) / 2, (b + c) / 2, (c + a) / 2
        pieces = ((a, d, f), (d, b, e), (f, e, c), (d, e, f))
    return np.concatenate([np.stack(piece, axis=1) for piece in pieces])
