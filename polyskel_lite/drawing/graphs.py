"""Pictures in the plane: the three neighbourhood graphs (section 2.2) and skeletons (section 3)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection

from ..errors import InputError
from .lines import box_of, chains, clip_segments, in_box, points_of, ray_segments
from .planar import draw_lines, draw_samples
from .style import kind_of


def draw_delaunay(ax: Axes, tessellation, inner=None, edges: bool = True, **style) -> Axes:
    """Draw a Delaunay triangulation, its inner triangles tinted.

    Parameters
    ----------
    ax : Axes
    tessellation : Tessellation or DelaunayShape
        A `DelaunayShape` brings its own `inner`.
    inner : (t,) bool array, optional
        Which triangles to tint.
    edges : bool
        Draw the edges of all triangles; with False only those of the tinted ones.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes()
    >>> ax = drawing.draw_delaunay(ax, psl.delaunay([(0, 0), (3, 0), (0, 2), (4, 5)]), inner=[True, False])
    >>> [len(collection.get_paths()) for collection in ax.collections]
    [1, 5]
    >>> plt.close(fig)
    """
    if inner is None:
        inner = getattr(tessellation, "inner", None)
    tessellation = getattr(tessellation, "tessellation", tessellation)
    look = kind_of("delaunay")
    corners = np.asarray(tessellation.points)[tessellation.simplices]
    drawn = np.asarray(tessellation.simplices)
    if inner is not None:
        inner = np.asarray(inner, dtype=bool)
        ax.add_collection(PolyCollection(corners[inner], facecolors=look.fill, edgecolors="none", zorder=1.4))
        drawn = drawn if edges else drawn[inner]
    pairs = np.sort(np.concatenate([drawn[:, [0, 1]], drawn[:, [1, 2]], drawn[:, [2, 0]]]), axis=1)
    pairs = np.unique(pairs, axis=0)
    return draw_lines(ax, np.asarray(tessellation.points)[pairs], "delaunay", **style)


def draw_voronoi(ax: Axes, voronoi, box=None, **style) -> Axes:
    """Draw a Voronoi graph, rays included, cut to a box around the samples.

    Parameters
    ----------
    ax : Axes
    voronoi : Skeleton
        As `polyskel_lite.voronoi` returns it.
    box : (2, 2) array, optional
        The part of the plane shown; by default the samples' bounding box and 8 % more on each side.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes()
    >>> ax = drawing.draw_voronoi(ax, psl.voronoi([(0, 0), (3, 0), (0, 2), (4, 5)]))
    >>> sum(len(path) - 1 for path in ax.collections[0].get_segments())   # one edge and four rays
    5
    >>> plt.close(fig)
    """
    box = box_of(voronoi.tessellation) if box is None else np.asarray(box, dtype=float)
    ax.update_datalim(box)
    return draw_skeleton(ax, voronoi, kind="voronoi", box=box, **style)


def draw_gabriel(ax: Axes, points, edges=None, **style) -> Axes:
    """Draw the Gabriel graph of points in the plane.

    Parameters
    ----------
    ax : Axes
    points : (n, 2) array, or Tessellation
    edges : (m, 2) int array, optional
        As `polyskel_lite.gabriel` returns them; computed by the strict rule when not given.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from polyskel_lite import drawing
    >>> fig, ax = drawing.axes()
    >>> ax = drawing.draw_gabriel(ax, [(0, 0), (3, 0), (0, 2), (4, 5)])
    >>> sum(len(path) - 1 for path in ax.collections[0].get_segments())
    4
    >>> plt.close(fig)
    """
    if edges is None:
        from ..graphs import gabriel

        edges = gabriel(points)
    points = np.asarray(points_of(points), dtype=float)
    return draw_lines(ax, [points[chain] for chain in chains(edges)], "gabriel", **style)


def draw_skeleton(
    ax: Axes, skeleton, kind: str = "sk0", box=None, vertices: bool | None = None, **style
) -> Axes:
    """Draw a skeleton in the plane: edges chained into long lines, rays cut to a box, vertices if wanted.

    Parameters
    ----------
    ax : Axes
    skeleton : Skeleton
    kind : str
        ``"sk0"``, ``"sk1"``, ``"sk2"``, ``"sk3"`` or another key of `KINDS`.
    box : (2, 2) array, optional
        Everything is cut to it. Without it edges are drawn whole, and a skeleton with rays is cut as in
        `draw_voronoi`.
    vertices : bool, optional
        Draw the vertices as dots; by default only where the skeleton has no edge (as the first method's has
        none).

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import drawing
    >>> rectangle = psl.Shape.from_rings([[(0, 0), (3, 0), (3, 1), (0, 1)]]).resample(16)
    >>> fig, ax = drawing.axes()
    >>> ax = drawing.draw_skeleton(drawing.draw_shape(ax, rectangle), psl.sk2(rectangle), kind="sk2")
    >>> ax.collections[0].get_segments() != []
    True
    >>> plt.close(fig)
    """
    look = kind_of(kind)
    nodes = np.asarray(skeleton.vertices, dtype=float)
    if nodes.ndim == 2 and nodes.shape[1] != 2 and len(nodes):
        raise InputError(
            f"draw_skeleton draws in the plane, but the vertices have {nodes.shape[1]} coordinates."
        )
    edges = np.asarray(skeleton.edges, dtype=int).reshape(-1, 2)
    if box is None and len(skeleton.rays):
        box = box_of(skeleton.tessellation)
    lines = [nodes[chain] for chain in chains(edges)]
    if box is not None:
        lines = _cut(lines, box) + list(ray_segments(skeleton, box))
    if vertices is None:
        vertices = len(edges) == 0
    dots = nodes if vertices else np.empty((0, 2))
    if box is not None and len(dots):
        dots = dots[in_box(dots, box)]
    if len(dots):
        dot = {"marker": look.marker or "o", "markersize": look.markersize or 1.8 * look.linewidth}
        draw_samples(ax, dots, kind=kind, **dot | {k: v for k, v in style.items() if k != "linewidth"})
    return draw_lines(ax, lines, kind, **{k: v for k, v in style.items() if not k.startswith("marker")})


def _cut(lines: list[np.ndarray], box) -> list[np.ndarray]:
    """Cut paths to a box; a path that lies inside stays one path."""
    pieces = []
    for line in lines:
        if in_box(line, box).all():
            pieces.append(line)
        else:
            pieces += list(clip_segments(np.stack([line[:-1], line[1:]], axis=1), box))
    return pieces
