"""Small regions in space, made to be looked at: example solids, tetrahedra moved apart, skeletons inside."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from .. import drawing
from ..containment import DelaunayShape
from ..graphs import delaunay
from ..skeletons import sk0

#: Look of the simplex a picture is about, of the facets it shares with the shape, and of the rest.
THIS, SHARED, REST = "#8CCBF0", "#F0B48C", "#E2E2E2"


def region(points, simplices) -> DelaunayShape:
    """The region made of some Delaunay simplices, named by their corners.

    Parameters
    ----------
    points : (n, N) array
    simplices : sequence of tuples of N+1 indices
        Each has to be a simplex of the Delaunay tessellation.

    Returns
    -------
    DelaunayShape

    Raises
    ------
    ValueError
        If a simplex is not Delaunay.

    Examples
    --------
    >>> int(region([(0, 0), (2, 0), (0, 2), (3, 3)], [(0, 1, 2)]).inner.sum())
    1
    """
    tessellation = delaunay(points)
    wanted = {frozenset(simplex) for simplex in simplices}
    inner = np.array([frozenset(s) in wanted for s in tessellation.simplices.tolist()])
    if inner.sum() != len(wanted):
        raise ValueError(f"{len(wanted) - inner.sum()} of {len(wanted)} simplices are not Delaunay.")
    return DelaunayShape(tessellation, inner)


def simplex_of(P: DelaunayShape, corners) -> int:
    """Row of the simplex with these corners.

    Examples
    --------
    >>> simplex_of(orange(5), (0, 1, 2, 3)) in range(5)
    True
    """
    return [set(s) == set(corners) for s in P.tessellation.simplices.tolist()].index(True)


def orange(slices: int, of: int | None = None, height: float = 0.42) -> DelaunayShape:
    """Tetrahedra around one edge, like the slices of an orange; samples 0 and 1 are the ends of that edge.

    Parameters
    ----------
    slices : int
        How many slices there are.
    of : int, optional
        How many make a whole orange, by default all: then the edge 0-1 is an inner one.
    height : float
        Half the length of that edge; the slices are one wide.

    Examples
    --------
    >>> from polyskel_lite import sk0
    >>> sk0(orange(6)).betti(), [len(polygon) for polygon in sk0(orange(6)).polygons]
    ((1, 0, 0), [6])
    >>> len(sk0(orange(3, of=6)).polygons)
    0
    """
    n = slices if of is None else of
    t = 2 * np.pi * (np.arange(n) + 0.25) / n
    ring = np.column_stack([np.cos(t), np.sin(t), np.zeros(n)])
    points = np.concatenate([[(0, 0, -height), (0, 0, height)], ring])
    return region(points, [(0, 1, 2 + k, 2 + (k + 1) % n) for k in range(slices)])


def lens(height: float = 0.45, long: float = 1.4) -> DelaunayShape:
    """Two oranges under one skin: a flat body with the inner edges 0-1 and 0-2, and six more samples.

    Its skeleton is a sheet of two polygons, one around each inner edge, with a common side.

    Parameters
    ----------
    height : float
        Half the height of the body.
    long : float
        Half its length; it is two wide.

    Examples
    --------
    >>> from polyskel_lite import sk0
    >>> sk0(lens()).betti(), [len(polygon) for polygon in sk0(lens()).polygons]
    ((1, 0, 0), [5, 5])
    """
    t = 2 * np.pi * (np.arange(6) + 0.5) / 6
    ring = np.column_stack([long * np.cos(t), np.sin(t), np.zeros(6)])
    ends = [(0, 0, height), (-long / 4, 0, -height), (long / 4, 0, -height)]
    tessellation = delaunay(np.concatenate([ends, ring]))
    return DelaunayShape(tessellation, np.ones(len(tessellation.simplices), dtype=bool))


def helix(tetrahedra: int) -> DelaunayShape:
    """Regular tetrahedra stuck together in a row: the Boerdijk-Coxeter helix. Its skeleton is a path.

    Examples
    --------
    >>> from polyskel_lite import sk0
    >>> sk0(helix(4)).edges.tolist()
    [[0, 1], [1, 2], [2, 3]]
    """
    k = np.arange(tetrahedra + 3)
    turn, radius = np.arccos(-2 / 3), 0.3 * np.sqrt(3)
    points = np.column_stack([k / np.sqrt(10), radius * np.cos(k * turn), radius * np.sin(k * turn)])
    return region(points, [tuple(range(j, j + 4)) for j in range(tetrahedra)])


def star(corners, missing) -> DelaunayShape:
    """The tetrahedra from sample 0, in the middle, to all faces of a convex body but one.

    Parameters
    ----------
    corners : (n, 3) array
        Corners of the body, around the origin; they get the numbers 1 to n.
    missing : tuple of three indices
        The face left out, so that the sample in the middle is on the boundary, as every sample must be.

    Examples
    --------
    >>> from polyskel_lite import sk0
    >>> octahedron = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    >>> sk0(star(octahedron, (2, 4, 6))).betti()
    (1, 0, 0)
    """
    points = np.concatenate([[(0, 0, 0)], np.asarray(corners, dtype=float)])
    tessellation = delaunay(points)
    inner = np.array([0 in s and not set(missing) <= set(s) for s in tessellation.simplices.tolist()])
    return DelaunayShape(tessellation, inner)


def paint(ax: Axes, triangles, colors, alpha=1.0, edgecolor="#4D4D4D", linewidth=0.6, **style) -> Axes:
    """Draw triangles of several colours in one collection, so that they cover each other as they should.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    triangles : (m, 3, 3) array
    colors : m colours
    alpha : float or m floats

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> fig, ax = drawing.axes_3d()
    >>> len(paint(ax, [[(0, 0, 0), (1, 0, 0), (0, 1, 0)]], ["red"]).collections)
    1
    >>> plt.close(fig)
    """
    triangles = np.asarray(triangles, dtype=float)
    shade = drawing.shades(drawing.normals_of(triangles), 0.72)
    rgb = np.array([to_rgb(color) for color in colors]) * shade
    faces = np.column_stack([rgb, np.broadcast_to(alpha, len(rgb))])
    options = {"facecolors": faces, "edgecolors": edgecolor, "linewidths": linewidth} | style
    ax.add_collection3d(Poly3DCollection(triangles, **options))
    return ax


def moved_apart(P: DelaunayShape, spread: float = 0.5, shrink: float = 1.0) -> np.ndarray:
    """Corners of the simplices of a region, (k, N+1, N) float array, each simplex moved away from the middle.

    Parameters
    ----------
    P : DelaunayShape
    spread : float
        How far each is moved, as a share of its distance to the common centre.
    shrink : float
        Each simplex is scaled by it about its own centroid.

    Examples
    --------
    >>> P = orange(6)
    >>> np.allclose(moved_apart(P, spread=0), P.tessellation.points[P.tessellation.simplices])
    True
    """
    corners = P.tessellation.points[P.tessellation.simplices[P.inner]]
    centroids = corners.mean(axis=1, keepdims=True)
    return centroids + shrink * (corners - centroids) + spread * (centroids - centroids.mean(axis=0))


def draw_apart(
    ax: Axes, P: DelaunayShape, this: int = -2, spread: float = 0.5, shrink: float = 1.0, alpha=0.95, **focus
) -> Axes:
    """Draw the tetrahedra of a region moved apart; one of them in blue, the facets it shares in red.

    Where it shares two facets, the edge in which they meet is drawn as a thick black line.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    P : DelaunayShape
    this : int
        Row of the tetrahedron the picture is about.
    spread, shrink : float
        As in `moved_apart`.
    alpha : float or k floats
        Opacity of the tetrahedra.
    **focus
        Handed on to `polyskel_lite.drawing.focus_3d`.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> fig, ax = drawing.axes_3d()
    >>> len(draw_apart(ax, orange(5), this=0).collections[0].get_facecolor())
    20
    >>> plt.close(fig)
    """
    t, rows = P.tessellation, np.flatnonzero(P.inner)
    corners = moved_apart(P, spread, shrink)
    triangles = corners[:, drawing.OPPOSITE]
    beyond = np.where(np.append(P.inner, False)[t.neighbors[rows]], t.neighbors[rows], -1)
    shared = (beyond >= 0) & ((beyond == this) | (rows == this)[:, None])
    colors = np.where(shared, SHARED, np.where(rows == this, THIS, REST)[:, None])
    alphas = np.repeat(np.broadcast_to(alpha, len(rows)), 4)
    paint(ax, triangles.reshape(-1, 3, 3), colors.ravel(), alphas)
    for four in corners[(rows == this) & (shared.sum(axis=1) == 2)]:
        edge = four[~shared[rows == this][0]]  # where the two shared facets meet
        drawing.draw_lines_3d(ax, [edge], "delaunay", colors="#000000", linewidths=2.4, zorder=6)
    return drawing.focus_3d(ax, corners.reshape(-1, 3), **focus)


def draw_solid(ax: Axes, P: DelaunayShape, alpha: float = 0.3, skeleton: bool = True, **focus) -> Axes:
    """Draw a region in space as through glass, and its skeleton Sk0 inside.

    In three layers: faces seen from within, the skeleton, faces seen from outside.

    Parameters
    ----------
    ax : Axes
        Three-dimensional.
    P : DelaunayShape
    alpha : float
        Opacity of the faces in front.
    skeleton : bool
        Whether to draw the skeleton.
    **focus
        Handed on to `polyskel_lite.drawing.focus_3d`.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> fig, ax = drawing.axes_3d()
    >>> ax = draw_solid(ax, orange(6))
    >>> plt.close(fig)
    """
    points = P.tessellation.points
    triangles = points[P.boundary()]
    front = drawing.normals_of(triangles) @ drawing.view_direction(ax) > 0
    color = drawing.KINDS["delaunay"].fill
    for seen, opacity, order in ((~front, 0.75, 1), (front, alpha, 6)):
        if seen.any():
            paint(ax, triangles[seen], [color] * int(seen.sum()), opacity, "#7A93A3", 0.6, zorder=order)
    if skeleton:
        dual = sk0(P)
        line = drawing.KINDS["sk0"].color
        drawing.draw_facets_3d(
            ax, dual.vertices, dual.polygons, kind="sk0", alpha=0.75, edges=False, zorder=4, color="#F2B48C"
        )
        drawing.draw_lines_3d(ax, dual.segments(), "sk0", linewidths=2.2, zorder=4.5)
        drawing.draw_samples_3d(ax, dual.vertices, marker="o", markersize=4, color=line, zorder=5)
    return drawing.focus_3d(ax, points[np.unique(P.boundary())], **focus)
