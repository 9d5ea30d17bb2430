"""The skeleton viewer: shape, samples and skeleton to turn and to filter, in Lab and on plain pages."""

from __future__ import annotations

import html
import json
from base64 import b64encode
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import anywidget
import numpy as np
import traitlets

from ...containment import DelaunayShape, delaunay_shape
from ...drawing import KINDS, RAMP, VIEW
from ...errors import InputError
from ...polyballs import Polyball
from ...shapes import Shape
from ...simplification import Hierarchy, hierarchy
from ...skeletons import Skeleton
from . import pack, strip

_MODULE = Path(__file__).with_suffix(".js").read_text(encoding="utf-8")
_COLORS = ("radius", "level", "none")
_STATE = ("threshold", "strategy", "variant", "opacity", "simplified", "color")
_SHOWN = ("samples", "vertices", "edges", "polygons")


@dataclass(frozen=True, eq=False)
class State:
    """One thing to show: a shape (or none), its whole skeleton, its hierarchies (or none)."""

    label: str
    P: DelaunayShape | Polyball | None
    skeleton: Skeleton
    hierarchies: tuple[Hierarchy, ...]
    names: tuple[str, ...]


def viewer(
    source,
    strategies: Sequence[str] | None = None,
    color: str = "radius",
    threshold: float | None = None,
    alt: str | None = None,
    height: int = 420,
    *,
    look: str = "",
    variant: str = "variant",
    shape=None,
    view: Mapping[str, Any] | tuple[float, float] | None = None,
    **state,
) -> SkeletonViewer:
    """Show a skeleton so that it can be turned, zoomed and simplified, with or without a kernel.

    Parameters
    ----------
    source : Hierarchy, list of Hierarchy, Shape, DelaunayShape, Polyball, Skeleton, or dict of these
        Several hierarchies of one shape give a switch between strategies; a dict gives a slider that
        switches between its entries, named by its keys. Hierarchies of shapes are made here.
    strategies : list of str, optional
        For shapes: by default "branch" in 2D, "surface" and "wireframe" in 3D.
    color : "radius", "level" or "none"
        What the colours of the skeleton stand for.
    threshold : float, optional
        In radians, at the beginning; 0 by default; -inf shows the whole skeleton.
    alt : str, optional
        What the picture shows, for those who do not see it.
    height : int
        Of the picture, in pixels.
    look : str
        A sentence over the picture: what to look for.
    variant : str
        What the keys of a dict are, such as "number of samples".
    shape : Shape, DelaunayShape or Polyball, or dict of these, optional
        To be shown around a `Skeleton`; a dict has one for each key of `source`.
    view : (elevation, azimuth) in degrees, or dict, optional
        Where the camera stands in 3D, as for ``ax.view_init`` (``elev``, ``azim``, ``vertical_axis``).
    **state
        Other traits of `SkeletonViewer`: ``opacity``, ``simplified``, ``samples``, ``vertices`` ...

    Returns
    -------
    SkeletonViewer

    Raises
    ------
    InputError
        If the source or a name is not one of these.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import explore
    >>> leaf = psl.hierarchy(psl.datasets.load("leaf"))
    >>> picture = explore.viewer(leaf, threshold=np.pi, alt="A leaf and its branches.")
    >>> picture.counts()["branches"] == leaf.branches(np.pi).graph["branches"]
    True
    """
    states = _states(source, strategies, shape)
    dimension = states[0].skeleton.dimension
    if color not in _COLORS:
        raise InputError(f"unknown color {color!r}; choose one of {', '.join(_COLORS)}.")
    place, up = _camera(view)
    scene, block = _scene(states, variant, place, up)
    about = alt or _description(states)
    scene |= {"alt": about, "look": look, "height": int(height), "name": "Skeleton viewer"}
    start = {
        "threshold": 0.0 if threshold is None else float(threshold),
        "strategy": scene["variants"][0]["hierarchies"][0]["label"],
        "variant": states[0].label,
        "opacity": 1.0 if dimension == 2 else 0.35,
        "color": color,
    }
    unknown = state.keys() - {*_STATE, *_SHOWN}
    if unknown:
        raise InputError(
            f"unknown option {min(unknown)!r}; choose one of {', '.join((*_STATE[3:5], *_SHOWN))}."
        )
    return SkeletonViewer(states, scene=scene, blob=block, **start | state)


class SkeletonViewer(anywidget.AnyWidget):
    """A widget made by `viewer`; its traits follow the reader's hand, and the picture follows the traits.

    Attributes
    ----------
    threshold : float
        In radians; -inf: nothing removed.
    strategy, variant : str
        Which hierarchy, and which entry of a dict.
    opacity : float
        Of the shape, 0 to 1.
    simplified : float
        0 shows the shape, 1 the simplified shape at the threshold; between them the removals happen in order.
    color : str
        "radius", "level" or "none".
    samples, vertices, edges, polygons : bool
        What is shown.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import explore
    >>> picture = explore.viewer(psl.datasets.load("hawaii"))
    >>> picture.threshold = 2 * np.pi
    >>> picture.counts()["branches"]
    8
    """

    _esm = _MODULE
    scene = traitlets.Dict().tag(sync=True)
    blob = traitlets.Bytes().tag(sync=True)
    strip = traitlets.Unicode().tag(sync=True)
    # JSON has no infinity, so it travels as null.
    threshold = traitlets.Float().tag(
        sync=True,
        to_json=lambda value, _: value if np.isfinite(value) else None,
        from_json=lambda value, _: -np.inf if value is None else value,
    )
    strategy = traitlets.Unicode().tag(sync=True)
    variant = traitlets.Unicode().tag(sync=True)
    opacity = traitlets.Float(1.0, min=0.0, max=1.0).tag(sync=True)
    simplified = traitlets.Float(0.0, min=0.0, max=1.0).tag(sync=True)
    color = traitlets.Enum(_COLORS, "radius").tag(sync=True)
    samples = traitlets.Bool(False).tag(sync=True)
    vertices = traitlets.Bool(False).tag(sync=True)
    edges = traitlets.Bool(True).tag(sync=True)
    polygons = traitlets.Bool(True).tag(sync=True)

    def __init__(self, states: Sequence[State], **traits):
        self._states = tuple(states)
        super().__init__(**traits)

    @traitlets.validate("threshold")
    def _check_threshold(self, proposal):
        value = float(proposal["value"])
        if np.isnan(value) or value == np.inf:
            raise InputError(f"threshold is {value}; pass an angle in radians, or -inf for nothing removed.")
        return value

    @traitlets.validate("strategy", "variant")
    def _check_name(self, proposal):
        value, kind = proposal["value"], proposal["trait"].name
        known = self._names() if kind == "strategy" else [state.label for state in self._states]
        if value not in known:
            raise InputError(f"unknown {kind} {value!r}; choose one of {', '.join(map(repr, known))}.")
        return value

    def _names(self) -> list[str]:
        return [h["label"] for h in self.scene["variants"][0]["hierarchies"]]

    def counts(self, threshold: float | None = None) -> dict[str, int]:
        """Numbers of vertices, edges, polygons and branches shown, at this threshold or another one.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> from polyskel_lite import explore
        >>> explore.viewer(psl.datasets.load("lake")).counts(6.28)["polygons"]
        0
        """
        threshold = self.threshold if threshold is None else threshold
        variant = [state.label for state in self._states].index(self.variant)
        strategy = self._names().index(self.strategy)
        return pack.counts(self.scene["variants"][variant], pack.unpack(self.blob), threshold, strategy)

    def to_html(self) -> str:
        """The picture as a piece of a page: its data and, where no script runs, three still pictures.

        A page needs the module ``viewer.js`` once besides; `save` writes a whole page, and the book adds
        the module to its pages by itself.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> from polyskel_lite import explore
        >>> page = explore.viewer(psl.datasets.load("lake"), alt="A lake.").to_html()
        >>> page.startswith('<div class="psl-viewer"'), page.count("<img ")
        (True, 3)
        """
        if not self.strip:
            self.strip = strip.strip(self._states, self.scene, self.get_state_of_picture())
        state = self.get_state_of_picture()
        state["threshold"] = None if np.isneginf(self.threshold) else self.threshold
        data = {"scene": self.scene, "blob": b64encode(self.blob).decode()} | state
        # No sequence of characters in the data may end the script element.
        text = json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")
        return f'<div class="psl-viewer"><script type="application/json">{text}</script>\n{self.strip}</div>'

    def get_state_of_picture(self) -> dict[str, Any]:
        """The traits that say what is shown."""
        return {name: getattr(self, name) for name in (*_STATE, *_SHOWN)}

    def save(self, path: str | PathLike, title: str = "Skeleton viewer") -> None:
        """Write a page of its own that works from disk, without a server, a kernel or the network.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> import polyskel_lite as psl
        >>> from polyskel_lite import explore
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "lake.html"
        >>> explore.viewer(psl.datasets.load("lake")).save(path)
        >>> path.stat().st_size < 400_000
        True
        """
        page = (
            '<!DOCTYPE html>\n<html lang="en">\n<head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{html.escape(title)}</title>\n"
            "<style>body { font-family: system-ui, sans-serif; max-width: 52rem; margin: 1rem auto; "
            "padding: 0 1rem; }</style></head>\n"
            f"<body><main>\n<h1>{html.escape(title)}</h1>\n{self.to_html()}\n</main>\n"
            f'<script type="module">\n{_MODULE}\n</script>\n</body>\n</html>\n'
        )
        Path(path).write_text(page, encoding="utf-8")

    def _repr_mimebundle_(self, **options):
        page = self.to_html()  # first, so that the widget has its still pictures too
        bundle = super()._repr_mimebundle_(**options)
        data, metadata = bundle if isinstance(bundle, tuple) else (bundle, {})
        return data | {"text/plain": "SkeletonViewer", "text/html": page}, metadata


def _states(source, strategies, shape) -> list[State]:
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


def _state(label: str, source, strategies, shape) -> State:
    if isinstance(source, Skeleton):
        P = None if shape is None else _delaunay(shape)
        return State(label, P, source, (), ())
    if isinstance(source, Polyball):
        return State(label, source, source.skeleton(), (), ())
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
    return np.array_equal(P.inner, Q.inner) and np.array_equal(
        P.tessellation.simplices, Q.tessellation.simplices
    )


def _camera(view) -> tuple[dict[str, float], int]:
    """Elevation and azimuth, and which axis points up."""
    if view is None:
        view = VIEW
    if not isinstance(view, Mapping):
        view = dict(zip(("elev", "azim"), view, strict=True))
    up = "xyz".index(view.get("vertical_axis", "z"))
    return {"elev": float(view.get("elev", VIEW["elev"])), "azim": float(view.get("azim", VIEW["azim"]))}, up


def _scene(states: Sequence[State], variant: str, view, up: int) -> tuple[dict[str, Any], bytes]:
    """The header and the block of arrays that the browser gets."""
    dimension = states[0].skeleton.dimension
    # The browser's third axis points up; a cyclic change of axes keeps the orientation.
    turn = (lambda x: np.roll(x, 2 - up, axis=-1)) if dimension == 3 else (lambda x: x)
    boxes = [_box(state) for state in states]
    low, high = np.min([b[0] for b in boxes], axis=0), np.max([b[1] for b in boxes], axis=0)
    margin = 0.15 * np.linalg.norm(high - low)
    inside = [_within(state.skeleton, low - margin, high + margin) for state in states]
    radius = max((float(r.max()) for r in inside if len(r)), default=1.0) or 1.0
    packer = pack.Packer()
    grid = turn(low - margin), turn(high + margin)
    variants = []
    for state in states:
        header = {"label": state.label} | pack.pack_skeleton(
            packer, _turned(state.skeleton, turn), radius, *grid
        )
        if isinstance(state.P, Polyball):
            header |= pack.pack_polyball(packer, state.P, turn, *grid)
        elif state.P is not None:
            header |= pack.pack_shape(packer, state.P, turn, *grid)
        betti = _betti(state)
        header["hierarchies"] = []
        for h, name in zip(state.hierarchies, state.names, strict=True):
            rank, levels = pack.ranks(h)
            arrays = {"rank": packer.add(rank), "level": packer.add(levels)}
            header["hierarchies"].append({"label": name, "betti": betti} | arrays)
        if not state.hierarchies:
            nothing = {"largest": np.pi, "power": 1, "systematic": False}
            header["hierarchies"].append({"label": "", "betti": betti} | nothing)
        variants.append(header)
    for k in range(len(states[0].names)):
        # One scale for all variants, so that the slider does not jump.
        about = pack.scale(np.concatenate([state.hierarchies[k].level for state in states]))
        for header in variants:
            header["hierarchies"][k] |= about
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
        "ramp": [_hex(RAMP(x)) for x in np.linspace(0, 1, 17)],
        "colors": colors,
        "variant": variant[:1].upper() + variant[1:],
        "strategy": "Strategy",
        "filters": bool(states[0].names),
        "shape": any(state.P is not None for state in states),
        "samples": any(isinstance(state.P, DelaunayShape) for state in states),
        "variants": variants,
    }
    return header, packer.block()


def _hex(color) -> str:
    return "#" + "".join(f"{round(255 * c):02x}" for c in color[:3])


def _box(state: State) -> tuple[np.ndarray, np.ndarray]:
    """The box of what must be seen: the shape, or the skeleton if there is none."""
    if isinstance(state.P, Polyball):
        reach = state.P.radii[:, None]
        return (state.P.centers - reach).min(axis=0), (state.P.centers + reach).max(axis=0)
    if state.P is not None:
        points = state.P.tessellation.points[np.unique(state.P.boundary())]
    elif state.skeleton.tessellation is not None:
        points = state.skeleton.tessellation.points
    else:
        points = state.skeleton.vertices
    return points.min(axis=0), points.max(axis=0)


def _within(skeleton: Skeleton, low, high) -> np.ndarray:
    """Radii of the vertices in a box; the colours are for these."""
    inside = ((skeleton.vertices >= low) & (skeleton.vertices <= high)).all(axis=1)
    return skeleton.radii[inside]


def _turned(skeleton: Skeleton, turn) -> Skeleton:
    parts = {
        name: getattr(skeleton, name) for name in ("radii", "simplices", "edges", "polygons", "ray_vertices")
    }
    return Skeleton(vertices=turn(skeleton.vertices), rays=turn(skeleton.rays), **parts)


def _betti(state: State) -> list[int] | None:
    """Betti numbers; removals keep them, so the smallest skeleton tells them fastest."""
    if state.hierarchies:
        return list(state.hierarchies[0].skeleton(np.inf).betti())
    if state.skeleton.dimension == 3 and len(state.skeleton.rays):
        return None
    return list(state.skeleton.betti())


def _description(states: Sequence[State]) -> str:
    """What is shown, in words, when the author gave none."""
    state = states[0]
    kind = "flat" if state.skeleton.dimension == 2 else "solid"
    around = f" inside its {kind} shape" if state.P is not None else ""
    return f"A skeleton of {len(state.skeleton.vertices):,} vertices{around}, to be moved and simplified."
