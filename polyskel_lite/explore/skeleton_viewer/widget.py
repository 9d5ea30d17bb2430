"""The skeleton viewer: shape, samples and skeleton to turn and to filter, in Lab and on plain pages."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import anywidget
import numpy as np
import traitlets

from ...errors import InputError
from ..bundle import one_module, whole_page
from . import pack
from .scene import State, as_states, description, pack_scene, paper_thresholds
from .strip import still_pictures

_MODULE = one_module()
_COLORS = ("radius", "level", "none")
_STATE = ("thresholds", "strategy", "variant", "opacity", "simplified", "color")
_SHOWN = ("samples", "vertices", "edges", "polygons")


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
        In radians, at the beginning, of the strategy that is shown first; -inf shows the whole skeleton. Each
        strategy has a threshold of its own; those not given start where the paper cuts: π/3 for "surface",
        2 π for "wireframe" and "branch".
    alt : str, optional
        What the picture shows, for those who do not see it.
    height : int
        Of the picture, in pixels.
    look : str
        A sentence under the picture: what to look for.
    variant : str
        What the keys of a dict are, such as "number of samples".
    shape : Shape, DelaunayShape or Polyball, or dict of these, optional
        To be shown around a `Skeleton`, or, in the plane, as an outline over a `Polyball`; a dict has one for
        each key of `source`.
    view : (elevation, azimuth) in degrees, or dict, optional
        Where the camera stands in 3D, as for ``ax.view_init`` (``elev``, ``azim``, ``vertical_axis``); by
        default where parts of the skeleton hide each other least.
    **state
        Other traits of `SkeletonViewer`: ``strategy``, ``opacity``, ``simplified``, ``samples`` ...

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
    states = as_states(source, strategies, shape)
    if color not in _COLORS:
        raise InputError(f"unknown color {color!r}; choose one of {', '.join(_COLORS)}.")
    scene, block = pack_scene(states, variant, view)
    about = alt or description(states)
    scene |= {"alt": about, "look": look, "height": int(height), "name": "Skeleton viewer"}
    thresholds = paper_thresholds(states[0])
    first = state.get("strategy", next(iter(thresholds)))
    if threshold is not None and first in thresholds:
        thresholds[first] = float(threshold)
    start = {
        "thresholds": thresholds,
        "strategy": first,
        "variant": states[0].label,
        "opacity": 1.0 if scene["dimension"] == 2 else 0.35,
        "color": color,
    }
    unknown = state.keys() - {*_STATE, *_SHOWN}
    if unknown:
        raise InputError(
            f"unknown option {min(unknown)!r}; choose one of {', '.join((_STATE[1], *_STATE[3:5], *_SHOWN))}."
        )
    return SkeletonViewer(states, scene=scene, blob=block, **start | state)


class SkeletonViewer(anywidget.AnyWidget):
    """A widget made by `viewer`; its traits follow the reader's hand, and the picture follows the traits.

    Attributes
    ----------
    threshold : float
        Of the strategy shown, in radians; -inf: nothing removed.
    thresholds : dict
        Of every strategy; ``threshold`` is its entry for ``strategy``.
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

    Each strategy keeps its threshold:

    >>> picture = explore.viewer(psl.datasets.load("fourbranch"), threshold=1.0)
    >>> picture.strategy = "wireframe"
    >>> picture.threshold == 2 * np.pi
    True
    >>> picture.strategy = "surface"
    >>> picture.threshold
    1.0
    """

    _esm = _MODULE
    scene = traitlets.Dict().tag(sync=True)
    blob = traitlets.Bytes().tag(sync=True)
    strip = traitlets.Unicode().tag(sync=True)
    threshold = traitlets.Float()  # not sent: the browser has the entry of thresholds
    # JSON has no infinity, so it travels as null.
    thresholds = traitlets.Dict().tag(
        sync=True,
        to_json=lambda value, _: {name: t if np.isfinite(t) else None for name, t in value.items()},
        from_json=lambda value, _: {name: -np.inf if t is None else t for name, t in value.items()},
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
        return _angle(proposal["value"])

    @traitlets.validate("thresholds")
    def _check_thresholds(self, proposal):
        """Those that are not given stay."""
        given = {self._known("strategy", name): _angle(t) for name, t in proposal["value"].items()}
        return self.thresholds | given

    @traitlets.validate("strategy", "variant")
    def _check_name(self, proposal):
        return self._known(proposal["trait"].name, proposal["value"])

    @traitlets.observe("strategy", "thresholds")
    def _take_threshold(self, _):
        self.threshold = self.thresholds[self.strategy]

    @traitlets.observe("threshold")
    def _keep_threshold(self, _):
        self.thresholds = {self.strategy: self.threshold}

    def _known(self, kind: str, name: str) -> str:
        known = self._names() if kind == "strategy" else [state.label for state in self._states]
        if name not in known:
            raise InputError(f"unknown {kind} {name!r}; choose one of {', '.join(map(repr, known))}.")
        return name

    def _names(self) -> list[str]:
        return [h["label"] for h in self.scene["variants"][0]["hierarchies"]]

    def counts(self, threshold: float | None = None) -> dict[str, int]:
        """Numbers of vertices, edges, polygons and branches shown, at this threshold or another one.

        Branches are counted by their free ends, as the paper does: the number is
        ``branch_graph(skeleton).graph["branches"]``.

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

        A page needs the viewer's JavaScript (`one_module`) once besides; `save` writes a whole page, and the
        book adds it to its pages by itself.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> from polyskel_lite import explore
        >>> page = explore.viewer(psl.datasets.load("lake"), alt="A lake.").to_html()
        >>> page.startswith('<div class="psl-viewer"'), page.count("<img ")
        (True, 3)
        """
        if not self.strip:
            self.strip = still_pictures(self._states, self.scene, self.get_state_of_picture())
        state = self.get_state((*_STATE, *_SHOWN))  # as it travels to a browser, so that -inf is null
        data = {"scene": self.scene, "blob": b64encode(self.blob).decode()} | state
        # No sequence of characters in the data may end the script element.
        text = json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")
        return f'<div class="psl-viewer"><script type="application/json">{text}</script>\n{self.strip}</div>'

    def get_state_of_picture(self) -> dict[str, Any]:
        """The traits that say what is shown."""
        return {name: getattr(self, name) for name in ("threshold", *_STATE, *_SHOWN)}

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
        style = (
            "body { font-family: system-ui, sans-serif; max-width: 52rem; margin: 1rem auto; "
            "padding: 0 1rem; }"
        )
        page = whole_page(title, self.to_html(), _MODULE, style)
        Path(path).write_text(page, encoding="utf-8")

    def _repr_mimebundle_(self, **options):
        page = self.to_html()  # first, so that the widget has its still pictures too
        bundle = super()._repr_mimebundle_(**options)
        data, metadata = bundle if isinstance(bundle, tuple) else (bundle, {})
        return data | {"text/plain": "SkeletonViewer", "text/html": page}, metadata


def _angle(threshold) -> float:
    value = float(threshold)
    if np.isnan(value) or value == np.inf:
        raise InputError(f"threshold is {value}; pass an angle in radians, or -inf for nothing removed.")
    return value
