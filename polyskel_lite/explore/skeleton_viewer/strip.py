"""Three still pictures of a viewer, for pages where no script runs: made by the drawing package."""

from __future__ import annotations

import html
from base64 import b64encode
from collections.abc import Sequence
from io import BytesIO
from types import SimpleNamespace
from typing import Any

import numpy as np

from ... import drawing
from ...errors import ShapeError
from ...polyballs import Polyball

_WIDTH, _DPI = 2.6, 100  # of one picture: inches, and dots an inch


def still_pictures(states: Sequence, scene: dict[str, Any], now: dict[str, Any]) -> str:
    """HTML with up to three pictures, side by side: three thresholds, or three variants.

    Parameters
    ----------
    states : sequence of State
    scene : dict
        The header that the browser gets.
    now : dict
        The traits of the viewer.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import explore
    >>> picture = explore.viewer({"a": psl.datasets.load("lake"), "b": psl.datasets.load("hawaii")})
    >>> picture.to_html().count("<figcaption")
    2
    """
    figures = []
    for state, k, threshold in _settings(states, scene, now):
        skeleton = state.hierarchies[k].skeleton(threshold) if state.hierarchies else state.skeleton
        shape = state.P
        if state.hierarchies and now["simplified"] >= 1:
            shape = state.hierarchies[k].shape(threshold)
        words = _words(state, k, threshold, scene, skeleton)
        data = b64encode(_picture(shape, skeleton, scene, state.beneath)).decode()
        figures.append(
            '<figure style="margin:0;flex:1 1 9rem;min-width:0">'
            f'<img style="width:100%;height:auto;background:#fff" src="data:image/png;base64,{data}" '
            f'alt="{html.escape(scene["alt"] + " " + words, quote=True)}">'
            f"<figcaption>{html.escape(words)}</figcaption></figure>"
        )
    look = f"<p>{html.escape(scene['look'])}</p>" if scene["look"] else ""
    row = '<div style="display:flex;flex-wrap:wrap;gap:0.8rem">'
    return f'<div class="psl-strip">{row}{"".join(figures)}</div>{look}</div>'


def _settings(states: Sequence, scene: dict[str, Any], now: dict[str, Any]):
    """The states, strategies (by number) and thresholds that the strip shows."""
    names = list(states[0].names)
    k = names.index(now["strategy"]) if now["strategy"] in names else 0
    if len(states) > 1:
        chosen = sorted({0, len(states) // 2, len(states) - 1})
        return [(states[i], k, now["threshold"]) for i in chosen]
    (state,) = states
    if not state.hierarchies:
        return [(state, 0, -np.inf)]
    about = scene["variants"][0]["hierarchies"][k]
    middle, far = (about["largest"] * share ** about["power"] for share in (0.4, 0.7))
    if now["threshold"] > 0:
        middle = now["threshold"]
        far = max(far, 2 * middle)
    return [(state, k, threshold) for threshold in (0.0, middle, min(far, about["largest"]))]


def _words(state, k: int, threshold: float, scene, skeleton) -> str:
    parts = []
    if state.label:
        parts.append(f"{scene['variant']}: {state.label}.")
    if state.hierarchies:
        name = f"Strategy {state.names[k]}, t" if len(state.names) > 1 else "T"
        at = "Nothing removed" if np.isneginf(threshold) else f"{name}hreshold {threshold / np.pi:.3g} π"
        parts.append(f"{at}: {len(skeleton.vertices):,} of {len(state.skeleton.vertices):,} vertices.")
    else:
        parts.append(f"{len(skeleton.vertices):,} vertices.")
    return " ".join(parts)


def _picture(shape, skeleton, scene: dict[str, Any], beneath=None) -> bytes:
    """One still picture as PNG.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import explore
    >>> square = psl.delaunay_shape(psl.Shape.from_rings([[(0, 0), (1, 0), (1, 1), (0, 1)]]))
    >>> scene = explore.viewer(square).scene
    >>> _picture(square, psl.sk0(square), scene)[1:4]
    b'PNG'
    """
    import matplotlib.pyplot as plt

    with plt.rc_context(drawing.RC):
        flat = scene["dimension"] == 2
        fig = _flat(shape, skeleton, scene, beneath) if flat else _solid(shape, skeleton, scene)
        file = BytesIO()
        fig.savefig(file, format="png", dpi=2 * _DPI, metadata={"Software": None})
        plt.close(fig)
    return _smaller(file)


def _smaller(file: BytesIO) -> bytes:
    """The same picture at half the size, which smooths the seams between triangles, with 32 colours."""
    from PIL import Image  # a requirement of matplotlib

    out, image = BytesIO(), Image.open(file).convert("RGB").reduce(2)
    image.quantize(32, dither=Image.Dither.NONE).save(out, "PNG", optimize=True)
    return out.getvalue()


def _flat(shape, skeleton, scene, beneath):
    fig, ax = drawing.axes(width=_WIDTH, height=0.8 * _WIDTH)
    if isinstance(shape, Polyball):
        drawing.draw_balls(ax, shape)
        if beneath is not None:
            drawing.draw_shape(ax, beneath, fill=False, linewidth=0.4, zorder=3)
    elif shape is not None:
        try:
            drawing.draw_shape(ax, shape.to_shape(), linewidth=0.6)
        except ShapeError:  # a region that touches itself
            drawing.draw_lines(ax, shape.tessellation.points[shape.boundary()], "shape", linewidth=0.6)
    drawing.draw_skeleton(ax, skeleton, kind="sk0", linewidth=0.9, vertices=False)
    drawing.focus(ax, np.array([scene["low"], scene["high"]]), margin=0.02)
    return fig


def _solid(shape, skeleton, scene):
    _, ax = drawing.axes_3d(width=_WIDTH, height=0.9 * _WIDTH)
    ax.view_init(**scene["view"], vertical_axis=scene["up"])
    if isinstance(shape, Polyball):
        points, facets, _ = shape.patches()
        drawing.draw_glass(ax, SimpleNamespace(points=points, facets=facets))
    elif shape is not None:
        drawing.draw_glass(ax, shape)
    drawing.draw_skeleton_3d(ax, skeleton, values=skeleton.radii, limits=(0.0, scene["radius"]))
    up = "xyz".index(scene["up"])
    box = np.roll([scene["low"], scene["high"]], up - 2, axis=1)
    return drawing.focus_3d(ax, box, zoom=1.3).figure
