"""Roles that tie words of the text to the explorer above them, or to the first one of the page.

``{state}`n = 100 <n=100, noise=0.2>` `` sets these controls, and the others as at first: a button.
``{knob}`50 <n>` `` is the control itself, a number to type or to step.
``{reading}`0.0445 <covering_radius>` `` is a number of the line under the picture, and follows it.
Without JavaScript they are the words alone. The book is built by Sphinx alone: nothing of the library is
used here.
"""

import json
import re
from html import escape

from docutils import nodes
from sphinx.util.docutils import SphinxRole


class Tied(SphinxRole):
    """Words, and in angle brackets what they are tied to."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        found = re.fullmatch(r"(.*?)\s*<([^>]*)>", self.text, re.S)
        if not found:
            wrong = f"{self.name}: {self.text!r} says not in <...> what it is tied to"
            return [], [self.inliner.reporter.error(wrong, line=self.lineno)]
        words, tied = found.groups()
        if self.name == "state":
            pairs = [pair.split("=") for pair in tied.split(",")]
            tied = json.dumps({name.strip(): json.loads(value) for name, value in pairs})
        html = f'<span class="psl-{self.name}" data-to="{escape(tied)}">{escape(words)}</span>'
        return [nodes.raw("", html, format="html")], []


def setup(app) -> dict[str, bool]:
    for name in ("state", "knob", "reading"):
        app.add_role(name, Tied())
    return {"parallel_read_safe": True}
