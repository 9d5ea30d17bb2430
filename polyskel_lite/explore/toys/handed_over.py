"""What an explorer hands over to a page without a kernel."""

from __future__ import annotations

import json

import ipywidgets

from ..drawing_board.marks import fragment, pens, swatch


def as_script(explorer: ipywidgets.VBox) -> str:
    """An `Explorer` as it is now: a script element with all that a page needs to go on from here.

    Examples
    --------
    >>> from polyskel_lite.explore import graphs
    >>> as_script(graphs())[:48]
    '<script type="application/json">{"toy":"Graphs",'
    """
    board, live = explorer.board, explorer.live
    traits = ["_view", "_layers", "handles", "handle_labels", "step", "alt", "text", "_legend"]
    state = board.get_state(traits)
    still = {name: layer for name, layer in board.layers.items() if name not in live}
    told = {
        "toy": type(explorer).__name__,
        "look": explorer.look_for,
        "board": state,
        "controls": [_control(*entry) for entry in explorer.controls.items()],
        "pens": {name: pens(board.layers[name]) for name in live},
        "still": {name: fragment(layer, board.view) for name, layer in still.items()},
        "hidden": [name for name in board.layers if not board.visible(name)],
        "swatches": {
            name: swatch(layer, live.get(name, "")) if layer.label else ""
            for name, layer in board.layers.items()
        },
        "words": dict(explorer.words),
        "given": explorer.given(),
    }
    # No sequence of characters in the data may end the script element.
    text = json.dumps(told, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return f'<script type="application/json">{text.replace("<", chr(92) + "u003c")}</script>'


def _control(name: str, widget: ipywidgets.Widget) -> dict[str, object]:
    """One control, in words that HTML has as well."""
    about: dict[str, object] = {"name": name, "label": widget.description}
    if isinstance(widget, ipywidgets.Button):
        return about | {"kind": "button"}
    about["value"] = widget.value
    if isinstance(widget, ipywidgets.Checkbox):
        return about | {"kind": "check"}
    if isinstance(widget, ipywidgets.Dropdown):
        pairs = [option if isinstance(option, tuple) else (option, option) for option in widget.options]
        return about | {"kind": "choice", "options": [list(pair) for pair in pairs]}
    return about | {"kind": "slider", "min": widget.min, "max": widget.max, "step": widget.step}
