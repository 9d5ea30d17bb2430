"""The list of checks, and how two yes-or-no answers make a verdict."""

from __future__ import annotations

from collections.abc import Callable

#: The closed vocabulary of verdicts, each with what it says.
VERDICTS = {
    "holds": "true, read in the most charitable way that makes sense; the reading is named",
    "holds under": "true once the condition named beside it is added; without it there is a counterexample",
    "does not hold": "there is a counterexample that meets every condition the paper names",
    "transcript": "our transcript has words that make no sense; one other reading does",
    "definition": "says what a word means; the library computes the same thing",
    "seen on our own data": "what the paper reports of its own data or machine; seen again with data of ours",
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


def verdict(stands: bool, repaired: bool | None = None) -> str:
    """The verdict of an assertion: is it true as it stands, and if not, is it true under the condition?"""
    if stands:
        return "holds"
    return "holds under" if repaired else "does not hold"


def transcript(stands: bool, other: bool) -> str:
    """The verdict of words that a transcript may have lost: they do not stand, the other reading does."""
    return "transcript" if other and not stands else verdict(stands, other)


def definition(agrees: bool) -> str:
    """The verdict of a definition: the library's function computes what the words say."""
    if not agrees:
        raise AssertionError("the library computes something else")
    return "definition"


def seen(again: bool) -> str:
    """The verdict of what the paper reports of its own data: seen again with ours, or not."""
    if not again:
        raise AssertionError("not seen on our data")
    return "seen on our own data"
