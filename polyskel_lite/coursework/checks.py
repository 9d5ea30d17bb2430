"""What check cells of the assignments call: sentences in place of tracebacks, and fair comparisons.

A check is written as ``need(condition, sentence)``. Before it, `numbers`, `pairs` and `truth` accept an
answer in whatever form it is right: lists or arrays, any integer or real type, any order. `guarded` calls a
student's function by its name, with copies, a time limit and one sentence for whatever goes wrong. Hidden
checks draw their inputs from `secret_rng`, which the teacher's secret seeds.

Nothing here is a fence: an answer runs in the same Python as its checks.
"""

from __future__ import annotations

import contextlib
import copy
import hashlib
import importlib
import inspect
import io
import os
import signal
import sys
import textwrap
import threading
import time
from collections.abc import Callable, Iterator
from types import CodeType, FrameType, ModuleType
from typing import Any

import numpy as np

import polyskel_lite as psl

#: Answers may be off by this much of the input's size: single precision passes, a wrong formula does not.
TOLERANCE = 1e-6
SECRET = "POLYSKEL_COURSE_SECRET"
#: A number by which all time limits are multiplied, for slow machines (and for tests, which do not wait).
PATIENCE = "POLYSKEL_COURSE_PATIENCE"


class Wrong(AssertionError):
    """An answer that is not right yet; a notebook shows the sentence alone, and no traceback."""

    def _render_traceback_(self) -> list[str]:
        return textwrap.wrap(f"Not yet: {self}", 100)  # feedback pages do not break lines


class _Short(io.StringIO):
    """Keeps the first characters of what is printed, and drops the rest: loops that never end print a lot."""

    def write(self, text: str) -> int:
        super().write(text[: max(0, 5000 - self.tell())])
        return len(text)


class _TooLong(BaseException):
    """Raised in a function whose time is over; no Exception, so that `except Exception` does not catch it."""


def checks_fresh() -> ModuleType:
    """This module as it was written, whatever a notebook has assigned to its names.

    >>> from polyskel_lite.coursework import checks_fresh
    >>> checks = checks_fresh()
    >>> checks.need = print
    >>> checks_fresh().need.__name__
    'need'
    """
    return importlib.reload(importlib.import_module(__name__))


def need(ok: Any, message: str) -> None:
    """Stop with the sentence `message` unless `ok`.

    >>> need(1 < 2, "One is smaller than two.")
    """
    if not ok:
        raise Wrong(message)


def _there(value: Any, name: str) -> None:
    need(value is not None, f"{name} is None. Is there a `return` at the end?")


def numbers(value: Any, shape: tuple[int | None, ...], name: str) -> np.ndarray:
    """Finite real numbers of the given shape as an array of floats; None in `shape` is any length.

    Lists, tuples and arrays of any integer or real type are accepted.

    >>> numbers([1, np.float32(2)], (2,), "the centre")
    array([1., 2.])
    >>> numbers([1, 2, 3], (2,), "the centre")
    Traceback (most recent call last):
    polyskel_lite.coursework.checks.Wrong: the centre should have the shape (2,); yours has the shape (3,).
    """
    _there(value, name)
    try:
        array = np.asarray(value)
        array = array if array.dtype.kind in "biuf" else np.array(value, dtype=object).astype(float)
        ok = not isinstance(value, str) and not any(isinstance(x, str) for x in np.ravel(value))
    except (TypeError, ValueError):
        ok = False
    need(ok, f"{name} should be numbers of the shape {_written(shape)}, and is {_short(value)}.")
    if array.size == 0 and None in shape:  # no rows have no columns
        array = array.reshape([n or 0 for n in shape])
    fits = len(shape) == array.ndim and all(n in (None, m) for n, m in zip(shape, array.shape, strict=True))
    need(fits, f"{name} should have the shape {_written(shape)}; yours has the shape {array.shape}.")
    need(np.isfinite(array).all(), f"{name} has a value that is not finite. Did you divide by zero?")
    return array.astype(float)


def _written(shape: tuple[int | None, ...]) -> str:
    return str(shape).replace("None", "any")


def _short(value: Any) -> str:
    text = repr(value)
    return f"{text[:80]} ..." if len(text) > 84 else text


def near(value: Any, wanted: Any, size: float = 1.0) -> bool:
    """Whether numbers agree up to a millionth of `size`, the size of what was put in.

    >>> near(np.float32(0.1), 0.1), near(0.1, 0.1001)
    (True, False)
    """
    return bool(np.all(np.abs(np.asarray(value, float) - np.asarray(wanted, float)) <= TOLERANCE * size))


def truth(value: Any, name: str) -> bool:
    """True or False, also as NumPy's or as 1 and 0.

    >>> truth(np.bool_(True), "is_gabriel"), truth(0, "is_gabriel")
    (True, False)
    """
    _there(value, name)
    array = np.asarray(value)
    ok = array.ndim == 0 and array.dtype.kind in "biuf" and array.item() in (0, 1)
    need(ok, f"{name} should be True or False, and is {_short(value)}.")
    return bool(array)


def indices(value: Any, name: str) -> set[int]:
    """Numbers of things, each once: a set, a list or an array of integers in any order.

    >>> indices(np.array([3, 1]), "ends") == {1, 3}
    True
    """
    return {k for (k,) in _rows(value, 1, name)}


def pairs(value: Any, name: str) -> set[tuple[int, int]]:
    """Unordered pairs, each once: a set, a list or an array of pairs of integers in any order.

    >>> sorted(pairs([(1, 0), (1, 2)], "edges"))
    [(0, 1), (1, 2)]
    """
    return {(a, b) for a, b in _rows(value, 2, name)}


def _rows(value: Any, length: int, name: str) -> set[tuple[int, ...]]:
    _there(value, name)
    thing = {1: "numbers", 2: "pairs of numbers"}[length]
    try:
        rows = [tuple(row) if np.ndim(row) or isinstance(row, (set, frozenset)) else (row,) for row in value]
        whole = [tuple(sorted(int(k) for k in row)) for row in rows]
        ok = all(int(k) == k for row in rows for k in row)
    except (TypeError, ValueError, OverflowError):
        ok = False
    need(ok, f"{name} should be {thing}, each of them whole, and is {_short(value)}.")
    mask = bool(rows) and all(isinstance(k, (bool, np.bool_)) for row in rows for k in row)
    need(not mask, f"{name} should be {thing}, and is True or False for each. Which numbers are they?")
    odd = next((row for row in whole if len(row) != length), None)
    need(odd is None, f"{name} should be {thing}; {odd} is in it.")
    twice = (
        next((row for row in whole if whole.count(row) > 1), None) if len(set(whole)) < len(whole) else None
    )
    same = " ((i, j) and (j, i) are the same)" if length == 2 else ""
    shown = twice if length == 2 or twice is None else twice[0]
    need(twice is None, f"{name} has {shown} more than once{same}.")
    return set(whole)


def same_polygon(value: Any, wanted: Any, size: float = 1.0) -> bool:
    """Whether two rings of corners, (n, 2), are one polygon: any first corner, either way round.

    >>> same_polygon([(1, 1), (1, 0), (0, 0)], [(0, 0), (1, 0), (1, 1)])
    True
    """
    a, b = np.asarray(value, dtype=float), np.asarray(wanted, dtype=float)
    turns = (np.roll(ring, k, axis=0) for ring in (b, b[::-1]) for k in range(len(b)))
    return a.shape == b.shape and any(near(a, turned, size) for turned in turns)


def halved(ring: Any, most: int) -> tuple[int | None, np.ndarray]:
    """Halve sides that are not strictly Gabriel, all of a round at once: after how many rounds there is none.

    The number is None if `most` rounds, or 400 samples, are not enough. `guarded` calls cannot get here.

    >>> halved([(0, 0), (8, 0), (6, 3), (2, 3)], 9)[0], halved([(0, 0), (2, 0), (1, 1)], 9)[0]
    (1, None)
    """
    at = np.array(ring, dtype=float)
    for done in range(most + 1):
        following, own = np.roll(at, -1, axis=0), np.arange(len(at))
        under = ((at[:, None] - at) * (following[:, None] - at)).sum(axis=2)
        under[own, own] = under[own, (own + 1) % len(at)] = np.inf
        bad = np.flatnonzero(under.min(axis=1) <= 0)
        if len(bad) == 0:
            return done, at
        if len(at) > 400:
            break
        at = np.insert(at, bad + 1, (at[bad] + following[bad]) / 2, axis=0)
    return None, at


def secret_rng(assignment: str, default: int) -> np.random.Generator:
    """Random numbers for hidden checks, from the teacher's secret; without one from `default`.

    >>> int(secret_rng("a2", default=3).integers(100)) == int(secret_rng("a2", default=3).integers(100))
    True
    """
    secret = os.environ.get(SECRET)
    digest = hashlib.sha256(f"{secret} {assignment}".encode()).digest()
    return np.random.default_rng(int.from_bytes(digest, "big") if secret else default)


def answer(name: str) -> Any:
    """A copy of the notebook's variable of this name, or the sentence that there is none.

    >>> polygon = [(0, 0), (1, 0), (0, 1)]
    >>> answer("polygon")
    [(0, 0), (1, 0), (0, 1)]
    """
    names = sys._getframe(1).f_globals
    need(name in names, f"there is no variable `{name}`. Is its cell written and run?")
    return copy.deepcopy(names[name])


def guarded(name: str, seconds: float = 10, library: bool | tuple[str, ...] = True) -> Callable[..., Any]:
    """The notebook's function of this name, called with copies, in limited time, with a sentence for errors.

    With ``library=False`` it may not call `polyskel_lite`, with names only these functions of it and all
    classes, however they were imported. That is a hint to who has misread the task: who wants to can get
    round it. What a call writes on stderr is dropped: a gradebook takes it for an error.

    >>> def double(numbers):
    ...     numbers.extend(numbers)
    ...     return numbers
    >>> given = [1, 2]
    >>> guarded("double")(given), given
    ([1, 2, 1, 2], [1, 2])
    >>> guarded("triple")
    Traceback (most recent call last):
    polyskel_lite.coursework.checks.Wrong: there is no function `triple`. Is its cell run?
    """
    function: Any = sys._getframe(1).f_globals.get(name)
    need(callable(function), f"there is no function `{name}`. Is its cell run?")
    if library is False:
        used = sorted(set(_of_the_library(function)))
        need(not used, f"{name} uses {', '.join(used)} of the library. Write it yourself, with NumPy.")

    seconds *= float(os.environ.get(PATIENCE, 1))

    def call(*args: Any) -> Any:
        copies, printed = copy.deepcopy(args), _Short()
        try:
            with (
                contextlib.redirect_stdout(printed),
                contextlib.redirect_stderr(io.StringIO()),
                _limit(seconds),
                _only(library, args),
            ):
                return function(*copies)
        except _TooLong:
            sentence = f"was not ready after {seconds:g} seconds. Is there a loop that never ends?"
        except NotImplementedError:
            sentence = "is not written yet."
        except Wrong as error:
            sentence = str(error)
        except (Exception, SystemExit) as error:
            sentence = f"stopped with {type(error).__name__}: {error}"
        finally:
            print(printed.getvalue(), end="")
        raise Wrong(f"{name} {sentence}")

    return call


def score(*parts: tuple[float, Callable[[], None]]) -> float:
    """Points of a check in parts: each is a number of points and a function that may raise `Wrong`.

    As the last line of a check cell it gives part of the points; what is wrong is printed.

    >>> def right():
    ...     need(True, "")
    >>> def wrong():
    ...     need(False, "the radius is squared.")
    >>> score((2, right), (1, wrong))
    Not yet (1 point): the radius is squared.
    2
    """
    total: float = 0
    for points, part in parts:
        try:
            part()
            total += points
        except Wrong as error:
            print(f"Not yet ({points} point{'s' if points != 1 else ''}): {error}")
    return total


def _of_the_library(function: Any) -> Iterator[str]:
    """Names of the library that a function's own code reads, also in functions inside it."""
    codes = [getattr(function, "__code__", None)]
    seen = getattr(function, "__globals__", {})
    while codes:
        if (code := codes.pop()) is None:
            continue
        codes += [constant for constant in code.co_consts if isinstance(constant, CodeType)]
        for name in code.co_names:
            value = seen.get(name)
            home = value.__name__ if isinstance(value, ModuleType) else getattr(value, "__module__", None)
            if psl.__name__ in (str(home).split(".")[0], name.split(".")[0]):
                yield name


@contextlib.contextmanager
def _only(library: bool | tuple[str, ...], args: tuple) -> Iterator[None]:
    """Refuse calls into the library but the allowed ones: by what runs, since names can be anything.

    What an allowed function or a function among `args` calls itself is its own affair.
    """
    if library is True:
        yield
        return
    trusted = {sys._getframe().f_code, *(getattr(thing, "__code__", None) for thing in args)}
    trusted |= {inspect.unwrap(getattr(psl, name)).__code__ for name in library or ()}
    refused, within = [], None
    sentence = "calls what it should do of the library: {}. Write it yourself, with NumPy."

    def watch(frame: FrameType, event: str, _: Any) -> None:
        nonlocal within
        if within is not None:
            within = None if event == "return" and frame is within else within
        elif event == "call":
            code, home = frame.f_code, str(frame.f_globals.get("__name__"))
            function = "." not in code.co_qualname  # not a method: methods of classes come with the classes
            foreign = home.split(".")[0] == psl.__name__ and (function or library is False)
            if code in trusted:
                within = frame
            elif foreign and (function or not home.startswith(__package__)):  # this module's timer may run
                refused.append(code.co_name)
                raise Wrong(sentence.format(code.co_name))
            elif home.split(".")[0] == psl.__name__:
                within = frame

    before = sys.getprofile()
    sys.setprofile(watch)
    try:
        yield
    finally:
        sys.setprofile(before)
    need(not refused, sentence.format(*refused[:1] or "-"))  # where the answer caught the exception


@contextlib.contextmanager
def _limit(seconds: float) -> Iterator[None]:
    """Stop what computes for so long inside, or takes three times as long, where there are timers.

    Not on Windows, and not in a browser. What counts is the time of this thread: neither a busy machine nor
    the threads of a matrix product take points.
    """
    if not hasattr(signal, "setitimer") or threading.current_thread() is not threading.main_thread():
        yield
        return
    fired, computed, begun = 0, time.thread_time(), time.monotonic()

    def stop(*_: Any) -> None:
        nonlocal fired
        if time.thread_time() - computed < seconds and time.monotonic() - begun < 3 * seconds:
            return
        fired += 1
        if fired > 3:  # a loop that catches everything: no other way is left to end it
            os._exit(1)
        raise _TooLong

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds, seconds / 10)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
