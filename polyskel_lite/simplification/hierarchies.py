"""Simplifying shape and skeleton without changing the topology, at every threshold at once (section 4)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from numbers import Real
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..checks import as_array, as_choice, as_indices, as_instance, shown
from ..containment import DelaunayShape, delaunay_shape
from ..errors import InputError
from ..graphs import ordinary
from ..shapes import Shape
from ..skeletons import Skeleton, branch_graph, dual_complex
from ..tables import Described, bounds_and_betti
from . import collapse
from .criteria import face_angles, facet_measures

if TYPE_CHECKING:
    import networkx

#: The strategies there are, by dimension; the first one is the default.
STRATEGIES = {2: ("branch",), 3: ("surface", "wireframe")}
_CRITERIA = ("corrected", "transcript")


@dataclass(frozen=True, eq=False, repr=False)
class Hierarchy(Described):
    """All simplified skeletons of a shape, nested: made by `hierarchy`.

    Attributes
    ----------
    P : DelaunayShape
    strategy : str
        "branch", "surface" or "wireframe".
    criterion : str
        "corrected" or "transcript".
    level : (k,) float array
        For each inner simplex (in the order of ``np.flatnonzero(P.inner)``, which is that of the
        vertices of ``sk0(P)``) the threshold at which it goes: -inf if it goes systematically before
        any threshold, inf if it never goes.
    kind : (k,) int8 array
        How it goes: 1 as a hat, 2 as a salient, 0 never.
    order : (r,) int array
        Positions in ``level`` of the simplices that go, in the order in which they went.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> leaf = psl.hierarchy(psl.datasets.load("leaf"), strategy="branch")
    >>> sizes = [len(leaf.skeleton(threshold).vertices) for threshold in (0, np.pi, 2 * np.pi)]
    >>> sizes[0] == len(psl.sk0(leaf.P).vertices), sizes[0] > sizes[1] > sizes[2]
    (True, True)
    """

    P: DelaunayShape
    strategy: str
    criterion: str
    level: NDArray[np.float64]
    kind: NDArray[np.int8]
    order: NDArray[np.int64]

    @property
    def dimension(self) -> int:
        """N, the dimension of the space."""
        return self.P.dimension

    def _facts(self) -> Iterator[tuple[str, object]]:
        yield "strategy", repr(self.strategy)
        yield "simplices", len(self.level)
        yield from bounds_and_betti(self.P.used_points(), self.P.betti)

    def __post_init__(self):
        as_instance(self.P, DelaunayShape, "P", "a DelaunayShape, and get a Hierarchy from hierarchy(P)")
        as_choice(self.strategy, "strategy", sum(STRATEGIES.values(), ()))
        as_choice(self.criterion, "criterion", _CRITERIA)
        level, kind = as_array(self.level, "level"), as_indices(self.kind, "kind", 3)
        k = np.count_nonzero(self.P.inner)
        as_indices(self.order, "order", k)
        if level.shape != (k,) or kind.shape != (k,) or np.isnan(level).any():
            raise InputError(
                f"level and kind must be (k,) arrays of numbers for the k = {k} inner simplices."
            )

    @cached_property
    def simplices(self) -> NDArray[np.intp]:
        """The inner simplices, (k,): rows of ``P.tessellation.simplices``."""
        return np.flatnonzero(self.P.inner)

    @cached_property
    def rank(self) -> NDArray[np.intp]:
        """The position of each inner simplex in `order`, (k,) int array; k for those that never go.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> h = psl.hierarchy(psl.Shape.from_rings([[(0, 0), (4, 0), (4, 1), (2, 1.2), (0, 1)]]))
        >>> sorted(h.rank.tolist())
        [0, 1, 3]
        """
        rank = np.full(len(self.level), len(self.level))
        rank[self.order] = np.arange(len(self.order))
        return rank

    def kept(self, threshold: float) -> NDArray[np.bool_]:
        """Which simplices of the tessellation stay at a threshold (level >= threshold), (t,) bool array.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> h = psl.hierarchy(psl.Shape.from_rings([[(0, 0), (4, 0), (4, 1), (2, 1.2), (0, 1)]]))
        >>> h.kept(float("-inf")).tolist() == h.P.inner.tolist()
        True
        """
        if not isinstance(threshold, Real) or not (abs(threshold) <= 1e308 or abs(threshold) == np.inf):
            raise InputError(
                f"threshold is {shown(threshold)}, not a number; pass an angle in radians, such as pi / 3."
            )
        keep = np.zeros_like(self.P.inner)
        keep[self.simplices] = self.level >= threshold
        return keep

    def shape(self, threshold: float) -> DelaunayShape:
        """The simplified shape at a threshold (section 4.1).

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> h = psl.hierarchy(psl.datasets.load("lake"))
        >>> h.shape(np.pi).betti()
        (1, 2)
        """
        return DelaunayShape(self.P.tessellation, self.kept(threshold))

    def skeleton(self, threshold: float) -> Skeleton:
        """The simplified skeleton at a threshold: the dual of the simplified shape (section 4.1).

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> h = psl.hierarchy(psl.datasets.load("lake"))
        >>> h.skeleton(np.pi).betti()
        (1, 2)
        """
        return dual_complex(self.P.tessellation, self.kept(threshold))

    def branches(self, threshold: float) -> networkx.MultiGraph:
        """Branches of the simplified skeleton; see `polyskel_lite.skeletons.branch_graph`.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> psl.hierarchy(psl.datasets.load("hawaii")).branches(2 * np.pi).number_of_nodes() > 0
        True
        """
        return branch_graph(self.skeleton(threshold))


def hierarchy(
    P: DelaunayShape | Shape, strategy: str | None = None, criterion: str = "corrected"
) -> Hierarchy:
    """Remove hats and salients, and note for each simplex the threshold at which it goes (sections 4.1-4.3).

    Parameters
    ----------
    P : DelaunayShape or Shape
    strategy : "branch" (2D), "surface" or "wireframe" (3D)
        "branch": a hat triangle goes when p/r, boundary length over ball radius, is below the threshold.
        "surface": hats go systematically, a salient tetrahedron goes when the angle between the outward
        normals of its two boundary faces is below the threshold. "wireframe": salients go
        systematically, a hat goes when p/r², boundary area over squared radius, is below the threshold.
    criterion : "corrected" or "transcript"
        "transcript" takes the words of our transcript of the paper at their narrowest: the dihedral angle,
        p/r in 3D and, in 2D, the whole perimeter of A(v); see section 4.3 of the book for what that does.

    Returns
    -------
    Hierarchy

    Raises
    ------
    InputError
        If the strategy does not fit the dimension, or a name is unknown.
    ContourContainmentError
        If ``P`` is a shape whose boundary is not in Del(E).

    Notes
    -----
    The smallest criterion goes first; the running maximum of the criteria popped so far is exactly the
    threshold from which on a simplex is removed when the paper's process is run to its end. Ties, such as
    those of the systematic removals, are broken by ball radius, so the names of the points do not matter;
    where radii are equal too, as in symmetric meshes, the simplex of the lower number goes first, and levels
    can differ after the vertices are numbered anew.

    References
    ----------
    Attali and Montanvert 1997, section 4; Ogniewicz, Discrete Voronoi Skeletons, 1993.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> h = psl.hierarchy(psl.Shape.from_rings([[(0, 0), (4, 0), (4, 1), (2, 1.2), (0, 1)]]))
    >>> h.strategy, len(h.level), int(np.isinf(h.level).sum())
    ('branch', 3, 1)
    """
    if not isinstance(P, DelaunayShape):
        P = delaunay_shape(P)
    fitting, known = STRATEGIES[P.dimension], sum(STRATEGIES.values(), ())
    strategy = fitting[0] if strategy is None else strategy
    as_choice(strategy, "strategy", known)
    as_choice(criterion, "criterion", _CRITERIA)
    if strategy not in fitting:
        raise InputError(
            f"strategy {strategy!r} is not for {P.dimension}D shapes; choose {' or '.join(fitting)}."
        )
    t, printed, inner = P.tessellation, criterion == "transcript", np.flatnonzero(P.inner)
    # The outer simplices take no part: only the inner ones are numbered, measured and removed.
    number = np.append(np.where(P.inner, np.cumsum(P.inner) - 1, -1), -1)
    scaled, _ = ordinary(t)  # criteria are angles, whatever the unit
    if strategy == "surface":
        values = face_angles(scaled, inner, dihedral=printed)
    else:
        values = facet_measures(scaled, inner)
    arrays = t.simplices[inner], number[t.neighbors[inner]], values, scaled.circumradii[inner]
    level, kind, order, _ = collapse.run(strategy, printed, *arrays)
    return Hierarchy(P, strategy, criterion, level, kind, order)
