"""The whole chain in one call: read, densify, refine, remove what a threshold says (sections 2 to 4)."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from typing import IO, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .checks import MOST_POINTS, as_choice, as_floats, as_number
from .containment import conform, delaunay_shape
from .errors import CoarseSamplingWarning, InputError, PolyskelError
from .progress import Progress
from .shapes import FLOOR, SHARE, Shape
from .simplification import STRATEGIES, Hierarchy, hierarchy
from .skeletons import Branches, Skeleton, branch_graph, branch_rows

#: Where noise is gone and what a reader would call a branch is there, in radians.
THRESHOLDS = {"branch": 3.0, "surface": np.pi / 3, "wireframe": 2 * np.pi}
#: Radii that are farther from the truth than this are told.
WORST = 1.05
#: In space, where samples are dear, a mesh gets more of them only if a ball is farther off than this. A fine
#: mesh of a round solid is nearer; with more samples it would only show the edges between its faces.
COARSE = 1.25


class Quality(NamedTuple):
    """How far the balls of a skeleton can be believed.

    Attributes
    ----------
    ratio : float
        The largest radius over the true distance from its centre to the boundary; 1 is right. Where samples
        were added, balls below twice the floor of `Shape.densify` do not count: next to a corner or edge no
        density of samples makes them right.
    added : int
        Samples that were added to the vertices given.
    """

    ratio: float
    added: int


@dataclass(frozen=True, eq=False)
class Bones:
    """What `skeleton` returns.

    Attributes
    ----------
    given, refined : Shape
        As it came, and with the samples it took.
    hierarchy : Hierarchy
        Of the refined shape: the skeletons at every threshold.
    threshold : float
        In radians.
    densified : bool
        Whether samples were added where the shape is narrow.
    """

    given: Shape
    refined: Shape
    hierarchy: Hierarchy
    threshold: float
    densified: bool

    def __repr__(self):
        return f"Bones({self.skeleton!r} at {self.threshold:.4g}, {self.hierarchy.strategy!r})"

    @cached_property
    def skeleton(self) -> Skeleton:
        """The simplified skeleton."""
        return self.hierarchy.skeleton(self.threshold)

    @cached_property
    def branches(self) -> Branches:
        """Its branches, the longest first, with lengths and radii (needs the extra ``graph``)."""
        return branch_rows(self.skeleton)

    @cached_property
    def quality(self) -> Quality:
        """How far its balls can be believed."""
        return Quality(self._worst[0], len(self.refined.points) - len(self.given.points))

    @cached_property
    def _worst(self) -> tuple[float, float]:
        """The largest ratio of a radius to the true one, and that one."""
        radii = self.skeleton.radii
        least = 2 * FLOOR[self.given.dimension] * radii.max(initial=0.0) if self.densified else 0.0
        true = self.given.boundary_distance(self.skeleton.vertices[radii > least])
        with np.errstate(over="ignore"):
            ratio = radii[radii > least] / np.maximum(true, 5e-324)
        if ratio.max(initial=1.0) <= 1:
            return 1.0, np.inf
        return float(ratio.max()), float(true[ratio.argmax()])

    def warning(self) -> str:
        """What is wrong with its balls, and what to do; an empty string if nothing is.

        Examples
        --------
        >>> skeleton([[(0, 0), (20, 0), (20, 4), (0, 4)]]).warning()
        ''
        """
        ratio, room = self._worst
        if ratio <= WORST:
            return ""
        advice = "let it be densified, or resample it"
        if self.densified:
            closer = SHARE * room
            count = self.given.boundary_measure() / closer
            advice = f"densify({closer:.1g}) adds the {count:,.0f} samples that its width asks for"
            if not count < MOST_POINTS or self.given.dimension == 3:
                advice = f"it is {2 * room:.1g} wide there, too thin for its size: widen it"
        elif self.given.dimension == 3:
            advice = "densify() it, or remesh it more finely"
        return (
            f"the samples are too coarse: a ball of this skeleton is {ratio:.2f} times as large as the room "
            f"around its centre; {advice}, or raise the threshold."
        )


def skeleton(
    source: Shape | str | PathLike | IO | Sequence,
    threshold: float | None = None,
    strategy: str | None = None,
    densify: bool = True,
    **options: Any,
) -> Bones:
    """Go the whole way from a shape or a file to its simplified skeleton (sections 2 to 4).

    Parameters
    ----------
    source : Shape, path, open file, or list of rings
    threshold : float, optional
        In radians; by default 3 for "branch", π/3 for "surface", 2π for "wireframe": a round end, half a
        sphere, is worth that, so the wires of round limbs end where their ends begin. Edges stick out
        farther: the wires toward those of a box, a prism or a plan in space go at 4π to 6π, which would cost
        every round limb one to two radii at each end.
    strategy : "branch" (2D), "surface" or "wireframe" (3D), optional
        See `hierarchy`.
    densify : bool
        Add samples where the shape is narrow (`Shape.densify`): without them, balls between the corners of a
        few-sided shape are far too large. In space only if a ball is more than a quarter too large.
    **options
        For files: those of `polyskel_lite.files.read_file`.

    Returns
    -------
    Bones
        With ``.skeleton``, ``.hierarchy``, ``.branches`` and ``.quality``.

    Raises
    ------
    PolyskelError
        The sentence of the step that refuses.

    Warns
    -----
    CoarseSamplingWarning
        If a ball of the skeleton is more than 5 % too large.

    Examples
    --------
    >>> bones = skeleton(Shape.from_rings([[(0, 0), (20, 0), (20, 4), (0, 4)]]))
    >>> (axis,) = bones.branches
    >>> round(axis.smooth_length, 1), round(axis.mean_radius, 2)
    (16.0, 2.01)
    """
    given = _given(source, options)
    strategy = (
        STRATEGIES[given.dimension][0] if strategy is None else as_choice(strategy, "strategy", THRESHOLDS)
    )
    (bones,) = refined_bones(given, (strategy,), threshold, densify)
    if sentence := bones.warning():
        warnings.warn(sentence, CoarseSamplingWarning, stacklevel=2)
    return bones


def _given(source, options: dict) -> Shape:
    """The shape of a path, of rings, or itself."""
    if isinstance(source, str | PathLike) or hasattr(source, "read"):
        return Shape.from_file(source, **options)
    if options:
        raise InputError(
            f"unknown option {min(options)!r}; options beyond those of skeleton() are for files."
        )
    return source if isinstance(source, Shape) else Shape.from_rings(source)


def refined_bones(
    given: Shape, strategies: Sequence[str], threshold: float | None = None, densify: bool = True
) -> list[Bones]:
    """Refine a shape, and find its hierarchy by each strategy; see `skeleton`.

    Parameters
    ----------
    given : Shape
    strategies : sequence of str
        All for the dimension of the shape. In space samples are added if one of their skeletons asks for it.
    threshold : float, optional
        In radians; by default that of `THRESHOLDS`.
    densify : bool

    Returns
    -------
    list of Bones
        One for each strategy, all of the same refined shape.

    Examples
    --------
    >>> plan = Shape.from_rings([[(0, 0), (20, 0), (20, 4), (0, 4)]])
    >>> [bones.densified for bones in refined_bones(plan, ["branch"])]
    [True]
    """
    found: list[Bones] = []
    thresholds = {s: THRESHOLDS[s] if threshold is None else threshold for s in strategies}
    for denser in (False, True) if densify and given.dimension == 3 else (densify,):
        if not found or max(bones.quality.ratio for bones in found) > COARSE:
            refined = conform(given.densify() if denser else given)
            P = delaunay_shape(refined)
            found = [Bones(given, refined, hierarchy(P, s), t, denser) for s, t in thresholds.items()]
    return found


class BranchCounts(NamedTuple):
    """How firmly a shape has a number of branches: what `branch_counts` returns.

    Attributes
    ----------
    thresholds : (t,) float array
        In radians.
    counts : (c + 1, t) int array
        Branches at each threshold: in row 0 of the shape, in the others of its shaken copies.
    """

    thresholds: NDArray[np.float64]
    counts: NDArray[np.int64]


def branch_counts(
    source: Shape | str | PathLike | IO | Sequence,
    strategy: str | None = None,
    thresholds: ArrayLike | None = None,
    copies: int = 8,
    shake: float = 0.1,
    seed: int = 0,
) -> BranchCounts:
    """Count branches over thresholds, for a shape and for copies whose samples are shaken (section 4.3).

    The paper gives one number for each of its solids (4, 4 and 13). A number is firm if neighbouring
    thresholds and slightly other samples give the same one.

    Parameters
    ----------
    source : Shape, path, or list of rings
        Dense enough as it is: nothing is added but what contour containment asks for.
    strategy : "branch" (2D), "surface" or "wireframe" (3D), optional
        By default "branch" or "wireframe".
    thresholds : (t,) array-like of radians, optional
        By default 24 steps up to twice that of `skeleton`.
    copies : int
        How many are shaken.
    shake : float
        Each coordinate of a vertex moves by about this share of the mean length of its edges. A copy that
        would cross itself is shaken half as much.
    seed : int
        Of the random numbers.

    Returns
    -------
    BranchCounts

    Raises
    ------
    InputError
        If a name is unknown or a number is out of its range.
    PolyskelError
        If the shape itself is refused.

    Examples
    --------
    >>> from polyskel_lite import datasets
    >>> found = branch_counts(datasets.load("hawaii", n=300), thresholds=[3, 6], copies=2)
    >>> found.counts.shape
    (3, 2)
    """
    shape = _given(source, {})
    strategy = {2: "branch", 3: "wireframe"}[shape.dimension] if strategy is None else strategy
    as_choice(strategy, f"strategy in {shape.dimension}D", STRATEGIES[shape.dimension])
    copies = as_number(copies, "copies", "a number of copies", 0, 10_000, whole=True)
    shake = as_number(shake, "shake", "a share of the length of an edge", 0, 1)
    seed = as_number(seed, "seed", "a whole number", 0, 2**63, whole=True)
    if thresholds is None:
        thresholds = THRESHOLDS[strategy] * np.arange(1, 25) / 12
    thresholds = np.atleast_1d(as_floats(thresholds, "thresholds", "a list of angles in radians"))
    if thresholds.ndim != 1 or not len(thresholds):
        raise InputError(f"thresholds has shape {thresholds.shape}; pass a list of angles in radians.")
    rng = np.random.default_rng(seed)
    counts = np.zeros((copies + 1, len(thresholds)), dtype=int)
    with Progress("counting branches", copies + 1) as progress:
        for k, row in enumerate(counts):
            progress.at(k)
            copy = conform(shape) if k == 0 else _shaken(shape, shake, rng)
            levels = hierarchy(delaunay_shape(copy), strategy)
            row[:] = [branch_graph(levels.skeleton(t)).graph["branches"] for t in thresholds]
    return BranchCounts(thresholds, counts)


def _shaken(shape: Shape, share: float, rng: np.random.Generator) -> Shape:
    """A copy whose vertices have moved, ready for `delaunay_shape`."""
    exponent = int(np.frexp(np.abs(shape.points).max())[1])
    points = np.ldexp(shape.points, -exponent)  # a unit in which squares of lengths are ordinary floats
    ends = np.concatenate([shape.facets[:, [k, k - 1]] for k in range(shape.dimension)])
    lengths = np.linalg.norm(np.diff(points[ends], axis=1)[:, 0], axis=1)
    sums = np.bincount(ends.ravel(), np.repeat(lengths, 2), len(points))
    mean = sums / np.maximum(np.bincount(ends.ravel(), minlength=len(points)), 1)
    step = rng.normal(size=points.shape) * mean[:, None]
    for _ in range(60):  # then the steps are below the rounding of the coordinates, and the copy is the shape
        try:
            return conform(Shape(np.ldexp(points + share * step, exponent), shape.facets))
        except PolyskelError:
            share /= 2
    return conform(shape)
