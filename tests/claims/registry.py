"""The list of checks, and how two yes-or-no answers make a verdict."""

from __future__ import annotations

from collections.abc import Callable

#: The closed vocabulary of verdicts, each with what it says.
VERDICTS = {
    "holds": "true as the paper prints it",
    "holds under": "true once the condition named beside it is added; without it there is a counterexample",
    "false as printed": "there is a counterexample that meets every condition the paper names",
    "misprint": "a slip of the pen; only one other reading makes sense",
    "definition": "says what a word means; the library computes the same thing",
    "figure reproduced": "a picture; the library draws its own version, with its own data",
}

#: Claim id -> function without arguments that returns the verdict.
CHECKS: dict[str, Callable[[], str]] = {}


def check(claim: str) -> Callable[[Callable[[], str]], Callable[[], str]]:
    """Register the function below as the check of a claim."""

    def register(function: Callable[[], str]) -> Callable[[], str]:
        assert claim not in CHECKS, f"two checks for {claim}"
        CHECKS[claim] = function
        return function

    return register


def verdict(printed: bool, repaired: bool | None = None) -> str:
    """The verdict of an assertion: is it true as printed, and if not, is it true under the condition?"""
    if printed:
        return "holds"
    return "holds under" if repaired else "false as printed"


def misprint(printed: bool, repaired: bool) -> str:
    """The verdict of a slip: wrong as it stands, right with the other reading."""
    return "misprint" if repaired and not printed else verdict(printed, repaired)


def definition(agrees: bool) -> str:
    """The verdict of a definition: the library's function computes what the words say."""
    if not agrees:
        raise AssertionError("the library computes something else")
    return "definition"


def reproduced(name: str, panels: int) -> str:
    """The verdict of a figure: the library draws it, with all panels, a caption and an alternative text."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    from polyskel_lite.figures import FIGURES

    draw = FIGURES[name]
    figure = draw()
    full = [ax for ax in figure.axes if ax.has_data() or ax.get_legend()]
    plt.close(figure)
    if len(full) < panels or not draw.caption or not draw.alt:
        raise AssertionError(f"{name} has {len(full)} panels of {panels}, or no caption or alternative text")
    return "figure reproduced"
