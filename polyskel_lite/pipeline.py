"""The whole chain in one call: read, densify, refine, remove what a threshold says (sections 2 to 4)."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from typing import NamedTuple

import numpy as np

from .containment import conform, delaunay_shape
from .errors import CoarseSamplingWarning, InputError
from .shapes import FLOOR, Shape
from .simplification import STRATEGIES, Hierarchy, hierarchy
from .skeletons import Branch, Skeleton, branch_rows

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

    @cached_property
    def skeleton(self) -> Skeleton:
        """The simplified skeleton."""
        return self.hierarchy.skeleton(self.threshold)

    @cached_property
    def branches(self) -> list[Branch]:
        """Its branches, the longest first, with lengths and radii (needs the extra ``graph``)."""
        return branch_rows(self.skeleton)

    @cached_property
    def quality(self) -> Quality:
        """How far its balls can be believed."""
        radii = self.skeleton.radii
        least = 2 * FLOOR[self.given.dimension] * radii.max(initial=0.0) if self.densified else 0.0
        true = self.given.boundary_distance(self.skeleton.vertices[radii > least])
        ratio = float((radii[radii > least] / np.maximum(true, 5e-324)).max(initial=1.0))
        return Quality(ratio, len(self.refined.points) - len(self.given.points))


def skeleton(
    source: Shape | str | PathLike | Sequence,
    threshold: float | None = None,
    strategy: str | None = None,
    densify: bool = True,
    **options,
) -> Bones:
    """Go the whole way from a shape or a file to its simplified skeleton (sections 2 to 4).

    Parameters
    ----------
    source : Shape, path, or list of rings
    threshold : float, optional
        In radians; by default 3 for "branch", π/3 for "surface", 2π for "wireframe".
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
    if isinstance(source, Shape):
        given = source
    elif isinstance(source, str | PathLike):
        given = Shape.from_file(source, **options)
    else:
        given = Shape.from_rings(source)
    if strategy is None:
        strategy = STRATEGIES[given.dimension][0]
    if strategy not in THRESHOLDS:
        raise InputError(f"unknown strategy {strategy!r}; choose one of {', '.join(THRESHOLDS)}.")
    threshold = THRESHOLDS[strategy] if threshold is None else threshold
    bones = None
    for denser in (False, True) if densify and given.dimension == 3 else (densify,):
        if bones is None or bones.quality.ratio > COARSE:
            refined = conform(given.densify() if denser else given)
            bones = Bones(given, refined, hierarchy(delaunay_shape(refined), strategy), threshold, denser)
    if bones.quality.ratio > WORST:
        advice = "remesh it more finely" if densify else "let it be densified, or resample it"
        warnings.warn(
            f"the samples are too coarse: a ball of this skeleton is {bones.quality.ratio:.2f} times as "
            f"large as the room around its centre; {advice}, or raise the threshold.",
            CoarseSamplingWarning,
            stacklevel=2,
        )
    return bones
