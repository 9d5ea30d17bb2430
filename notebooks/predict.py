"""The directive ``predict``: a question that a reader answers before she sees the picture.

    :::{predict} How many ends will the skeleton have?
    - [ ] as many as there are samples
    - [x] as many as there are corners

    Each convex corner is the end of a branch. Samples on straight sides add none.
    :::

Options are the lines with a box; the right one has a cross, and where none has one the question is open. What
follows is the verdict. With ``:place: x y tolerance`` the answer is a mark in the next picture instead, at
most so far from the right place. ``:opens: none`` locks nothing; ``next`` locks the next picture that moves,
even past another question. Without either it locks the next one in its section, up to the next question.

The page holds question, options and folded answer as text; ``polyskel_lite/explore/toys/predict.js`` makes
controls of them. conf.py loads this file by name: only Sphinx is needed.
"""

import math
import re

from docutils import nodes
from docutils.parsers.rst import directives
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

OPTION = re.compile(r"- \[([ x])\] +(\S.*)")


def place(text: str) -> tuple[float, float, float]:
    """Three numbers: x, y and how far from there an answer still is near."""
    x, y, tolerance = map(float, text.split())
    if not (math.isfinite(x + y) and 0 < tolerance < math.inf):
        raise ValueError("three numbers are needed: x y tolerance")
    return x, y, tolerance


def opens(text: str) -> str:
    return directives.choice(text, ("next", "none"))


def parted(lines: list[str]) -> tuple[list[str], list[int], int]:
    """The options, which of them are right, and the line where the verdict begins."""
    options, right, at = list[str](), list[int](), 0
    for at, line in enumerate([*lines, ""]):  # noqa: B007
        if found := OPTION.match(line):
            right += [len(options)] if found[1] == "x" else []
            options.append(found[2])
        elif options and line.startswith("  ") and line.strip():
            options[-1] += " " + line.strip()
        elif line.strip():
            break
    return options, right, at


class Predict(SphinxDirective):
    """See the head of this file."""

    required_arguments = 1
    final_argument_whitespace = True
    has_content = True
    option_spec = {"place": place, "opens": opens}  # noqa: RUF012

    def run(self) -> list[nodes.Node]:
        options, right, at = parted(list(self.content))
        verdict = "\n".join(self.content[at:]).strip()
        target = self.options.get("place")
        if target and options:
            raise self.error("A question for a place in the picture has no options.")
        if not target and len(options) < 2:
            raise self.error(
                "A question needs two options or more, lines that begin with '- [ ]' or '- [x]'."
            )
        if right and len(right) == len(options):
            raise self.error("Every option of this question is right: then there is nothing to choose.")
        if OPTION.search(verdict):
            raise self.error("An option stands behind the verdict; options come first.")
        if not verdict:
            raise self.error("A question needs a verdict: why the right answer is right.")

        data = {
            "id": f"predict-{self.env.new_serialno('predict') + 1}",
            "data-right": " ".join(map(str, right)),
        }
        data["data-place"] = " ".join(f"{number:g}" for number in target or ())
        data["data-opens"] = self.options.get("opens", "")
        said = "".join(f' {name}="{value}"' for name, value in data.items() if value)
        choices = nodes.bullet_list("", *(nodes.list_item("", self.line(option)) for option in options))
        told = nodes.Element()
        self.state.nested_parse(StringList(verdict.splitlines(), self.name), self.content_offset + at, told)
        return [
            html(f'<div class="psl-predict"{said}>'),
            self.line(self.arguments[0], "psl-question"),
            *([choices] if options else []),
            html('<details class="psl-answer"><summary>Answer</summary>'),
            *(self.line(options[k], "psl-right") for k in right),
            *told.children,
            html("</details></div>"),
        ]

    def line(self, text: str, *classes: str) -> nodes.paragraph:
        """One line of Markdown as a paragraph."""
        parts, messages = self.state.inline_text(text, self.lineno)
        # Only a page folds the answer; elsewhere it has to be told from an option.
        label = [nodes.raw("Answer: ", "Answer: ", format="latex text")] if "psl-right" in classes else []
        return nodes.paragraph(text, "", *label, *parts, *messages, classes=list(classes))


def html(text: str) -> nodes.raw:
    """What other builders leave out: they print question, options and answer one after the other."""
    return nodes.raw("", text, format="html")


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_directive("predict", Predict)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
