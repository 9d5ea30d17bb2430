"""The role ``state``: words in the text that bring the explorer above them to a state.

In a chapter ``{state}`n = 100 <n=100, noise=0.2>` `` is the words n = 100; on a page with JavaScript they are a
button that sets these controls. The book is built by Sphinx alone: nothing of the library is used here.
"""

import json
import re
from html import escape

from docutils import nodes
from sphinx.util.docutils import SphinxRole


class State(SphinxRole):
    """Words, and in angle brackets names of controls with their values in JSON."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        words, values = re.fullmatch(r"(.*?)\s*<([^>]*)>", self.text, re.S).groups()
        pairs = [pair.split("=") for pair in values.split(",")]
        state = json.dumps({name.strip(): json.loads(value) for name, value in pairs})
        html = f'<span class="psl-set" data-set="{escape(state)}">{escape(words)}</span>'
        return [nodes.raw("", html, format="html")], []


def setup(app) -> dict[str, bool]:
    app.add_role("state", State())
    return {"parallel_read_safe": True}
