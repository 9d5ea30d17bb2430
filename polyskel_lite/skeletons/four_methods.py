"""The four approximate skeletons Sk0, Sk1, Sk2 and Sk3 (the paper's section 3)."""

from __future__ import annotations

from numpy.typing import ArrayLike

from ..checks import as_choice
from ..containment import DelaunayShape, delaunay_shape
from ..graphs import Tessellation
from ..shapes import Shape, check_shape
from .inside import VoronoiInside
from .skeleton import Skeleton
from .voronoi_graph import dual_complex

_SIDES = {"inner": 1, "outer": -1}


def sk0(P: DelaunayShape | Shape, side: str = "inner") -> Skeleton:
    """Sk0, the dual of the inner Delaunay simplices (section 3.4).

    Parameters
    ----------
    P : DelaunayShape or Shape
        A shape is first passed through `delaunay_shape`.
    side : "inner" or "outer"
        "outer" gives Sk0 of the complement; its unbounded simplices have rays.

    Returns
    -------
    Skeleton
        Abstract: one vertex per simplex, drawn at its circumcenter, an edge per facet that two of
        the simplices share, in 3D a polygon per Delaunay edge they surround.

    Raises
    ------
    ContourContainmentError
        If ``P`` is a shape whose boundary is not in Del(E).

    References
    ----------
    Attali and Montanvert 1997, section 3.4; Boissonnat, Geometric structures for three-dimensional
    shape representation, 1984.

    Examples
    --------
    >>> from polyskel_lite import Shape, conform
    >>> frame = Shape.from_rings([[(0, 0), (6, 0), (6, 6), (0, 6)], [(2, 2), (4, 2), (4, 4), (2, 4)]])
    >>> sk0(conform(frame)).betti() == frame.betti()
    True
    """
    _side(side)
    if not isinstance(P, DelaunayShape):
        P = delaunay_shape(P)
    keep = P.inner if side == "inner" else ~P.inner
    # Only rays can lead through the boundary without leaving the kept simplices.
    cut = P.boundary_rows() if side == "outer" else None
    return dual_complex(P.tessellation, keep, cut=cut, rays=side == "outer")


def sk1(shape: Shape, E: ArrayLike | Tessellation | None = None, side: str = "inner") -> Skeleton:
    """Sk1, the Voronoi vertices in the shape (section 3.1).

    Parameters
    ----------
    shape : Shape
        X, of which E samples the boundary.
    E : (n, N) array-like or Tessellation, optional
        The samples; by default the vertices of the shape.
    side : "inner" or "outer"
        "outer": those in the (closed) complement.

    Returns
    -------
    Skeleton
        Vertices only. Cocircular (cospherical) samples give several at one place.

    References
    ----------
    Attali and Montanvert 1997, section 3.1; Schmitt, Some examples of algorithms analysis in
    computational geometry by means of mathematical morphological techniques, 1989.

    Examples
    --------
    >>> from polyskel_lite import Shape
    >>> sk1(Shape.from_rings([[(0, 0), (4, 0), (4, 2), (0, 2)]])).vertices.tolist()
    [[2.0, 1.0], [2.0, 1.0]]
    """
    return _voronoi(shape, E, side).vertices()


def sk2(shape: Shape, E: ArrayLike | Tessellation | None = None, side: str = "inner") -> Skeleton:
    """Sk2, the Voronoi elements that are wholly in the shape (section 3.2).

    Parameters
    ----------
    shape : Shape
        X, of which E samples the boundary.
    E : (n, N) array-like or Tessellation, optional
        The samples; by default the vertices of the shape.
    side : "inner" or "outer"
        "outer": the elements, rays too, in the closed complement.

    Returns
    -------
    Skeleton
        Which elements are in is decided exactly, by rationals where floats are in doubt. In 3D a polygon
        is in if all its sides are, and no edge of the boundary goes through it.

    References
    ----------
    Attali and Montanvert 1997, section 3.2; Brandt and Algazi, Continuous skeleton computation by
    Voronoi diagram, 1992.

    Examples
    --------
    >>> from polyskel_lite import Shape
    >>> rectangle = Shape.from_rings([[(0, 0), (6, 0), (6, 2), (0, 2)]])
    >>> skeleton = sk2(rectangle, rectangle.sample(8))
    >>> skeleton.betti()
    (1, 0)
    """
    return _voronoi(shape, E, side).elements()


def sk3(shape: Shape, E: ArrayLike | Tessellation | None = None, side: str = "inner") -> Skeleton:
    """Sk3, the part of the Voronoi graph that is in the shape (section 3.3).

    Parameters
    ----------
    shape : Shape
        X, of which E samples the boundary.
    E : (n, N) array-like or Tessellation, optional
        The samples; by default the vertices of the shape.
    side : "inner" or "outer"

    Returns
    -------
    Skeleton
        As Sk2, with the pieces of the edges that cross the boundary. Where the boundary cuts an edge
        a vertex is added whose ``simplices`` entry is -1. Points where an edge only touches the
        shape are left out. In 3D only the edges are cut: the polygons are those of Sk2, and the pieces of
        polygons that cross the boundary are left out.

    References
    ----------
    Attali and Montanvert 1997, section 3.3; Ogniewicz, Discrete Voronoi Skeletons, 1993.

    Examples
    --------
    >>> from polyskel_lite import Shape
    >>> rectangle = Shape.from_rings([[(0, 0), (6, 0), (6, 2), (0, 2)]])
    >>> E = rectangle.sample(8)
    >>> len(sk3(rectangle, E).edges) - len(sk2(rectangle, E).edges)
    8
    """
    return _voronoi(shape, E, side).intersection()


def _voronoi(shape: Shape, E, side: str) -> VoronoiInside:
    check_shape(shape)
    return VoronoiInside(shape, E, _side(side))


def _side(side: str) -> int:
    return _SIDES[as_choice(side, "side", _SIDES)]
