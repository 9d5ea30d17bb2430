"""What the viewer shows: the things that it was given, and the header and arrays that the browser gets."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from ...containment import DelaunayShape, delaunay_shape
from ...drawing import KINDS
from ...errors import InputError
from ...polyballs import Polyball
from ...shapes import Shape
from ...simplification import Hierarchy, hierarchy
from ...skeletons import Skeleton
from .outlook import camera
from .pack import Packer, as_segments, pack_hierarchy, pack_polyball, pack_shape, pack_skeleton, scale

# Stands for a hierarchy where there is none.
_NOTHING = {"largest": np.pi, "knee": np.pi, "power": 1, "systematic": False}
# Where the paper cuts: a length over a radius (wireframes: an area over its square), or an angle.
_PAPER = {"branch": 2 * np.pi, "wireframe": 2 * np.pi, "surface": np.pi / 3}


@dataclass(frozen=True, eq=False)
class State:
    """One thing to show: a shape (or none), its whole skeleton, its hierarchies (or none) and their names.

    Under a union of discs there may be the shape that they approximate: its outline is drawn over them.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> voronoi = psl.voronoi([(0, 0), (4, 0), (0, 2), (4, 3)])
    >>> State("four points", None, voronoi, (), ()).skeleton.dimension
    2
    """

    label: str
    P: DelaunayShape | Polyball | None
    skeleton: Skeleton
    hierarchies: tuple[Hierarchy, ...]
    names: tuple[str, ...]
    beneath: Shape | None = None


def as_states(source, strategies: Sequence[str] | None, shape) -> list[State]:
    """What `viewer` was given as a list of states: one, or one for each entry of a dict.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> lake = psl.datasets.load("lake")
    >>> [(state.label, state.names) for state in as_states({400: lake}, None, None)]
    [('400', ('branch',))]
    """
    if not isinstance(source, Mapping):
        return [_state("", source, strategies, shape)]
    if not source:
        raise InputError("the dict of variants is empty; pass at least one entry, such as a Hierarchy.")
    around = shape if isinstance(shape, Mapping) else dict.fromkeys(source, shape)
    if missing := [label for label in source if label not in around]:
        raise InputError(f"the dict of shapes has no entry {missing[0]!r}; pass one for each variant.")
    states = [_state(str(label), thing, strategies, around[label]) for label, thing in source.items()]
    first = states[0]
    for state in states:
        if state.names != first.names or state.skeleton.dimension != first.skeleton.dimension:
            raise InputError(
                f"variant {state.label!r} has another dimension or other strategies than {first.label!r}; "
                "all entries of a dict must be of one kind."
            )
    if len({state.label for state in states}) < len(states):
        raise InputError("two variants have the same name; use keys that differ when written.")
    return states


def paper_thresholds(state: State) -> dict[str, float]:
    """Where each strategy of a state starts if nobody says where.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> (state,) = as_states(psl.datasets.load("fourbranch"), None, None)
    >>> {name: round(threshold / np.pi, 3) for name, threshold in paper_thresholds(state).items()}
    {'surface': 0.333, 'wireframe': 2.0}
    """
    known = {name: _PAPER[h.strategy] for name, h in zip(state.names, state.hierarchies, strict=True)}
    return known or {"": 0.0}


def _state(label: str, source, strategies, shape) -> State:
    if isinstance(source, Skeleton):
        return State(label, None if shape is None else _delaunay(shape), source, (), ())
    if isinstance(source, Polyball):
        if shape is not None and not (isinstance(shape, Shape) and shape.dimension == source.dimension == 2):
            raise InputError("beneath a Polyball goes a Shape, and both in the plane; leave out shape=.")
        return State(label, source, source.skeleton(), (), (), beneath=shape)
    if isinstance(source, (Shape, DelaunayShape)):
        P = _delaunay(source)
        if strategies is None:
            strategies = ("branch",) if P.dimension == 2 else ("surface", "wireframe")
        source = [hierarchy(P, strategy) for strategy in strategies]
    if isinstance(source, Hierarchy):
        source = [source]
    if not isinstance(source, Sequence) or not source or not all(isinstance(h, Hierarchy) for h in source):
        raise InputError(
            f"cannot show {type(source).__name__}; pass a Hierarchy, a list of them, a Shape, "
            "a DelaunayShape, a Polyball, a Skeleton, or a dict of these."
        )
    P = source[0].P
    if any(h.P is not P and not _same(h.P, P) for h in source):
        raise InputError("the hierarchies are of different shapes; pass a dict to switch between shapes.")
    names = [h.strategy for h in source]
    if len(set(names)) < len(names):
        names = [f"{h.strategy}, {h.criterion}" for h in source]
    if len(set(names)) < len(names):
        raise InputError("two hierarchies have the same strategy and criterion; pass each once.")
    return State(label, P, source[0].skeleton(-np.inf), tuple(source), tuple(names))


def _delaunay(shape) -> DelaunayShape | Polyball:
    return shape if isinstance(shape, (DelaunayShape, Polyball)) else delaunay_shape(shape)


def _same(P: DelaunayShape, Q: DelaunayShape) -> bool:
    simplices = (P.tessellation.simplices, Q.tessellation.simplices)
    return np.array_equal(P.inner, Q.inner) and np.array_equal(*simplices)


def pack_scene(states: Sequence[State], variant: str, view) -> tuple[dict[str, Any], bytes]:
    """The header and the block of arrays that the browser gets.

    Parameters
    ----------
    states : sequence of State
    variant : str
        What the labels of the states are.
    view : (elevation, azimuth), dict or None
        As for `viewer`.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> header, block = pack_scene(as_states(psl.datasets.load("lake"), None, None), "size", None)
    >>> header["variant"], header["filters"], len(block) > 1000
    ('Size', True, True)
    """
    dimension = states[0].skeleton.dimension
    boxes = [_box(state) for state in states]
    low, high = np.min([b[0] for b in boxes], axis=0), np.max([b[1] for b in boxes], axis=0)
    view, up = camera(view, _first_seen(states[0], low, high))
    # The browser's third axis points up; a cyclic change of axes keeps the orientation.
    turn = partial(np.roll, shift=2 - up if dimension == 3 else 0, axis=-1)
    margin = 0.15 * np.linalg.norm(high - low)
    radius = max(_largest_radius(state.skeleton, low - margin, high + margin) for state in states) or 1.0
    packer = Packer()
    grid = turn(low - margin), turn(high + margin)
    # One scale for all variants, so that the slider does not jump.
    alike = zip(*(state.hierarchies for state in states), strict=True)
    scales = [
        scale(np.concatenate([h.level for h in some]), angles=some[0].strategy == "surface") for some in alike
    ]
    variants = []
    for state in states:
        places = {"vertices": turn(state.skeleton.vertices), "rays": turn(state.skeleton.rays)}
        header: dict[str, Any] = {"label": state.label}
        header |= pack_skeleton(packer, replace(state.skeleton, **places), radius, *grid)
        if isinstance(state.P, Polyball):
            header |= pack_polyball(packer, state.P, turn, *grid)
            if state.beneath is not None:
                header["beneath"] = packer.add(as_segments(state.beneath.segments))
        elif state.P is not None:
            header |= pack_shape(packer, state.P, turn, *grid)
        betti = _betti(state)
        header["hierarchies"] = [
            {"label": name, "betti": betti} | pack_hierarchy(packer, h) | about
            for h, name, about in zip(state.hierarchies, state.names, scales, strict=True)
        ] or [{"label": "", "betti": betti} | _NOTHING]
        variants.append(header)
    balls = any(isinstance(state.P, Polyball) for state in states)
    look = KINDS["balls" if balls else "shape"]
    colors = {
        "shape": look.color,
        "fill": look.fill,
        "glass": "#8A7F2E" if balls else "#6E7B85",
        "ghost": "#9AA5AD",
        "removed": "#F6F6F6",
        "samples": KINDS["samples"].color,
        "skeleton": KINDS["sk0"].color,
        "vertices": "#1A1A1A",
    }
    header = {
        "dimension": dimension,
        "low": turn(low).tolist(),
        "high": turn(high).tolist(),
        "view": view,
        "up": "xyz"[up],
        "radius": radius,
        "colors": colors,
        "variant": variant[:1].upper() + variant[1:],
        "strategy": "Strategy",
        "filters": bool(states[0].names),
        "shape": any(state.P is not None for state in states),
        "samples": any(isinstance(state.P, DelaunayShape) for state in states),
        "variants": variants,
    }
    return header, packer.block()


def _box(state: State) -> tuple[np.ndarray, np.ndarray]:
    """The box of what must be seen: the shape, or the skeleton if there is none."""
    if isinstance(state.P, Polyball):
        reach = state.P.radii[:, None]
        points = np.concatenate([state.P.centers - reach, state.P.centers + reach])
        if state.beneath is not None:
            points = np.concatenate([points, state.beneath.points])
    elif state.P is not None:
        points = state.P.tessellation.points[np.unique(state.P.boundary())]
    elif state.skeleton.tessellation is not None:
        points = state.skeleton.tessellation.points
    else:
        points = state.skeleton.vertices
    return points.min(axis=0), points.max(axis=0)


def _first_seen(state: State, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Vertices and middles of edges of the skeleton as the paper cuts it, in a box."""
    skeleton = state.skeleton
    if state.hierarchies:
        skeleton = state.hierarchies[0].skeleton(paper_thresholds(state)[state.names[0]])
    points = np.concatenate([skeleton.vertices, skeleton.vertices[skeleton.edges].mean(axis=1)])
    return points[((points >= low) & (points <= high)).all(axis=1)]


def _largest_radius(skeleton: Skeleton, low: np.ndarray, high: np.ndarray) -> float:
    """Of the vertices in a box; the colours are for these."""
    inside = ((skeleton.vertices >= low) & (skeleton.vertices <= high)).all(axis=1)
    return float(skeleton.radii[inside].max(initial=0.0))


def _betti(state: State) -> list[int] | None:
    """Betti numbers; removals keep them, so the smallest skeleton tells them fastest."""
    if state.hierarchies:
        return list(state.hierarchies[0].skeleton(np.inf).betti())
    if state.skeleton.dimension == 3 and len(state.skeleton.rays):
        return None
    return list(state.skeleton.betti())


def description(states: Sequence[State]) -> str:
    """What is shown, in words, when the author gave none.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> description(as_states(psl.Polyball([(0, 0), (1, 0)], [1, 1]), None, None))
    'A skeleton of 2 vertices inside its flat shape, to be moved and simplified.'
    """
    state = states[0]
    kind = "flat" if state.skeleton.dimension == 2 else "solid"
    around = f" inside its {kind} shape" if state.P is not None else ""
    return f"A skeleton of {len(state.skeleton.vertices):,} vertices{around}, to be moved and simplified."
