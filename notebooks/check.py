"""The directive ``check``: a question after a section; each answer opens and says why it is right or wrong.

    :::{check} Which balls of a rectangle are maximal?
    - [M9] the largest ones :: Maximal is not largest: other balls lie in no ball of the rectangle either.
    - [x] those in no other ball :: Two contacts hold them, however small they are.
    :::

A right answer has a cross, a wrong one the id of the misconception behind it (misconceptions.toml). What
follows the two colons is the reason. One answer is open at a time, without JavaScript: the browser sees to
it. tools/working_copies.py makes text of it with the same reader. conf.py loads this file by name: only
Sphinx is needed.
"""

import re

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

CHOICE = re.compile(r"- \[(x|M\d+)\] +(\S.*?) +:: +(\S.*)")


def choices(text: str) -> list[tuple[str, str, str]]:
    """Of each choice its mark (``x``, or what it takes for true), the answer and the reason.

    >>> choices("- [x] yes :: It is.\\n- [M3] no :: It is\\n  all the same.")
    [('x', 'yes', 'It is.'), ('M3', 'no', 'It is all the same.')]
    """
    found = []
    for line in re.sub(r"\n +", " ", text.strip()).splitlines():
        match = CHOICE.fullmatch(line.strip())
        if line.strip() and not match:
            raise ValueError(f"A choice reads '- [x] answer :: reason' or '- [M1] ...', and not {line!r}.")
        found += [match.groups()] if match else []
    if not {"x"} < {mark for mark, _, _ in found}:
        raise ValueError("A question needs a right choice and a wrong one.")
    return found


class Check(SphinxDirective):
    """See the head of this file."""

    required_arguments = 1
    final_argument_whitespace = True
    has_content = True

    def run(self) -> list[nodes.Node]:
        try:
            found = choices("\n".join(self.content))
        except ValueError as mistake:
            raise self.error(str(mistake)) from mistake
        number = self.env.new_serialno("check") + 1  # goals name it by this (tests/book/test_goals.py)
        name = f"check-{number}"
        made: list[nodes.Node] = [
            html(f'<fieldset class="psl-check" id="{name}"><legend>Check {number}</legend>'),
            self.line(self.arguments[0], "psl-question"),
        ]
        for mark, answer, reason in found:
            kind = "right" if mark == "x" else "wrong"
            made += [html(f'<details name="{name}" class="{kind}"><summary>'), self.words(answer)]
            made += [html("</summary>"), self.line(reason, kind, first="Yes. " if mark == "x" else "No. ")]
            made += [html("</details>")]
        return [*made, html("</fieldset>")]

    def words(self, text: str) -> nodes.inline:
        """Markdown within a line."""
        parts, messages = self.state.inline_text(text, self.lineno)
        return nodes.inline(text, "", *parts, *messages)

    def line(self, text: str, kind: str, first: str = "") -> nodes.paragraph:
        """One line of Markdown as a paragraph."""
        verdict = [nodes.strong(first, first)] if first else []
        return nodes.paragraph(text, "", *verdict, self.words(text), classes=[kind])


def html(text: str) -> nodes.raw:
    """What other builders leave out: they print question, answers and reasons one after the other."""
    return nodes.raw("", text, format="html")


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_directive("check", Check)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
