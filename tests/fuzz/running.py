"""Runs cases in processes of their own, which have little memory and are killed when they are late."""

from __future__ import annotations

import importlib
import multiprocessing
import os
import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from contextlib import contextmanager
from dataclasses import dataclass, field

import numpy as np

LATE = 10  # seconds for a case
MEMORY = 6 * 2**30  # bytes of address space, of which the libraries take two
OUTCOMES = ("answered", "refused", "raw", "late", "wrong")


class Late(BaseException):
    """Not an Exception, so that nothing in the library catches it."""


def outcome(family: str, seed: int, number: int) -> tuple[str, str]:
    """What became of one case, and a sentence to find it again."""
    from polyskel_lite import PolyskelError

    run = importlib.import_module(__package__).FAMILIES[family]
    case = run(np.random.default_rng([seed, number]))
    words = ""
    try:
        words = next(case)
        for _ in case:
            pass
        return "answered", words
    except PolyskelError as error:
        short = len(str(error)) < 1000 and str(error).rstrip()[-1:] in (".", ")")
        return "refused", f"{words}: {type(error).__name__}: {str(error)[:200]}" + (
            "" if short else " [long]"
        )
    except AssertionError as error:
        return "wrong", f"{words}: {error}"
    except Late:
        return "late", words
    except BaseException as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        return (
            "raw",
            f"{words}: {type(error).__name__}: {str(error)[:200]} ({place.name}, line {place.lineno})",
        )


def _alarm(*_):
    raise Late


@contextmanager
def alarm():
    """Raises `Late` inside, after `LATE` seconds, where there are alarms (not on Windows)."""
    there = hasattr(signal, "SIGALRM")
    if there:
        signal.signal(signal.SIGALRM, _alarm)
        signal.alarm(LATE)
    try:
        yield
    finally:
        if there:
            signal.alarm(0)


def _limit() -> None:
    warnings.simplefilter("ignore")
    try:
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    except (ImportError, ValueError, OSError):  # not on this system
        pass


def _work(family: str, seed: int, numbers: range, pipe) -> None:
    _limit()
    from polyskel_lite import compiling

    if compiling.Loops.can_compile():
        compiling.main()  # once on a machine it takes long; a case shall not pay for it
    os.chdir(tempfile.mkdtemp(prefix="fuzz-"))  # "words" is the name of a file too
    for number in numbers:
        begin = time.perf_counter()
        with alarm():
            result = outcome(family, seed, number)
        pipe.send((number, *result, time.perf_counter() - begin))
    pipe.close()


@dataclass
class Tally:
    """What became of the cases of one family, and the bad ones, to be run again by their numbers."""

    counts: Counter = field(default_factory=Counter)
    bad: list = field(default_factory=list)
    seconds: float = 0.0
    slowest: float = 0.0


def run_family(family: str, count: int, seed: int = 0, *, progress: bool = False) -> Tally:
    """Run the cases 0 to count - 1; a process that dies or hangs costs its case and is begun anew."""
    context = multiprocessing.get_context("spawn")
    tally, begin, done = Tally(), time.perf_counter(), 0
    while done < count:
        here, there = context.Pipe(duplex=False)
        worker = context.Process(target=_work, args=(family, seed, range(done, count), there), daemon=True)
        worker.start()
        there.close()
        while done < count:
            try:
                # The first case of a process waits for its imports and for what is compiled.
                if not here.poll(LATE + 90):
                    raise TimeoutError
                number, what, words, seconds = here.recv()
            except (EOFError, TimeoutError) as error:
                what = "late" if isinstance(error, TimeoutError) else "raw"
                number, words, seconds = done, f"the process {'hung' if what == 'late' else 'died'}", LATE
                _count(tally, number, what, words, seconds)
                done += 1
                worker.kill()
                break
            _count(tally, number, what, words, seconds)
            done = number + 1
            if progress and done % max(1, count // 20) == 0:
                print(f"{family}: {done} of {count}, {dict(tally.counts)}", file=sys.stderr, flush=True)
        worker.join()
    tally.seconds = time.perf_counter() - begin
    return tally


def _count(tally: Tally, number: int, what: str, words: str, seconds: float) -> None:
    tally.counts[what] += 1
    tally.slowest = max(tally.slowest, seconds)
    if what not in ("answered", "refused") or words.endswith("[long]"):
        tally.bad.append((number, what, words))
