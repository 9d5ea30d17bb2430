"""Boundary curves from samples alone, when they come from an r-regular shape (section 3.4)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..checks import near
from ..errors import InputError, ReconstructionError
from ..exact import occurrences, spread_out
from ..graphs import Tessellation, as_tessellation, gabriel
from ..shapes import Shape


def reconstruct_curve(points: ArrayLike | Tessellation) -> Shape:
    """Find the polygon P_w through samples of an r-regular shape with w⁻¹ < r; no polygon is given.

    Parameters
    ----------
    points : (n, 2) array-like or Tessellation
        Samples of the boundary, at least three on each component, in any order.

    Returns
    -------
    Shape
        Its vertices are the samples, its boundary is in the strict Gabriel graph.

    Raises
    ------
    ReconstructionError
        If the samples cannot come from an r-regular shape with w⁻¹ < r: no set of short Gabriel
        edges gives every sample two neighbours, or a Delaunay disk is smaller than half a chosen
        edge. The message names a sample where it fails.

    Notes
    -----
    On an r-regular boundary no circle through three of its points is smaller than r, while two
    neighbours are at most 2 w⁻¹ < 2 r apart and make a Gabriel edge. So for any length between the
    two, the Gabriel edges up to it are exactly the boundary. The length need not be known: the
    edges are taken by increasing length until every sample has two.

    References
    ----------
    Brandt and Algazi, Continuous skeleton computation by Voronoi diagram, 1992. Bernardini and Bajaj,
    Sampling and reconstructing manifolds using alpha-shapes, 1997. Gonzalez and Maddocks, Global
    curvature, thickness, and the ideal shapes of knots, 1999 (circles through three points).

    Examples
    --------
    >>> angle = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    >>> shuffled = np.random.default_rng(0).permutation(np.column_stack([np.cos(angle), np.sin(angle)]))
    >>> reconstruct_curve(shuffled).betti()
    (1, 0)
    """
    tessellation = as_tessellation(points)
    if tessellation.dimension != 2:
        raise InputError("points are in 3D; curves are reconstructed in the plane only.")
    points = tessellation.points
    edges = gabriel(tessellation, closed=True)
    lengths = np.linalg.norm(points[edges[:, 1]] - points[edges[:, 0]], axis=1)
    order = np.argsort(lengths, kind="stable")
    edges, lengths = edges[order], lengths[order]
    # The length at which each sample gets its second edge; the longest of these is needed for all.
    ends = edges.ravel()
    rows = np.argsort(ends, kind="stable")  # of one sample, shorter edges stay before longer ones
    rank = spread_out(occurrences(ends, len(points)))[1]
    second = np.full(len(points), np.inf)
    second[ends[rows[rank == 1]]] = lengths[rows[rank == 1] // 2]
    needed = second.max()
    if not np.isfinite(needed):
        _refuse(points, int(np.argmax(second)), "has fewer than two Gabriel neighbours")
    chosen = edges[lengths <= needed]
    degree = occurrences(chosen, len(points))
    if degree.max() > 2:
        _refuse(
            points, int(np.argmax(degree)), f"has {degree.max()} Gabriel neighbours nearer than {needed:g}"
        )
    smallest = int(np.argmin(tessellation.circumradii))
    if tessellation.circumradii[smallest] <= needed / 2:
        _refuse(
            points,
            int(tessellation.simplices[smallest, 0]),
            f"is on a Delaunay disk of radius {tessellation.circumradii[smallest]:.4g}, not above half "
            f"of the longest boundary edge ({needed / 2:.4g})",
        )
    # from_rings turns the curves; going back to the given indices keeps E and the vertices the same.
    oriented = Shape.from_rings([points[cycle] for cycle in _cycles(chosen, len(points))])
    index = {tuple(point): k for k, point in enumerate(points.tolist())}
    number = np.array([index[tuple(point)] for point in oriented.points.tolist()])
    return Shape(points, number[oriented.facets])


def _refuse(points, vertex: int, reason: str):
    raise ReconstructionError(
        f"sample {vertex} at {near(points[[vertex]])} {reason}: these are not samples of an r-regular shape "
        "with a largest gap w⁻¹ < r. Sample more densely there, round sharp corners, or give the polygon "
        "(Shape.from_rings)."
    )


def _cycles(edges: np.ndarray, n: int) -> list[list[int]]:
    neighbours: list[list[int]] = [[] for _ in range(n)]
    for a, b in edges.tolist():
        neighbours[a].append(b)
        neighbours[b].append(a)
    seen, cycles = [False] * n, []
    for start in range(n):
        if seen[start]:
            continue
        cycle, previous, current = [], -1, start
        while not seen[current]:
            seen[current] = True
            cycle.append(current)
            a, b = neighbours[current]
            previous, current = current, b if a == previous else a
        cycles.append(cycle)
    return cycles
