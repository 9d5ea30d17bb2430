"""A line on the terminal for what takes longer than two seconds."""

from __future__ import annotations

import os
import sys
import time

_PATIENCE = 2.0


class Progress:
    """Say on stderr how far a task is: only on a terminal, only after two seconds, never in a notebook or CI.

    Parameters
    ----------
    task : str
    total : int

    Examples
    --------
    >>> with Progress("counting", 3) as progress:
    ...     for k in range(3):
    ...         progress.at(k)
    """

    def __init__(self, task: str, total: int):
        self.task, self.total, self._shown = task, total, False
        self._next = time.monotonic() + _PATIENCE
        self._on = sys.stderr is not None and sys.stderr.isatty() and not os.environ.get("CI")

    def __enter__(self) -> Progress:
        return self

    def at(self, done: int) -> None:
        """Note how much of the total is done."""
        now = time.monotonic()
        if self._on and now >= self._next:
            self._shown, self._next = True, now + 0.2
            print(f"\r{self.task}: {done / max(self.total, 1):4.0%}", end="", file=sys.stderr, flush=True)

    def __exit__(self, *_) -> None:
        if self._shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)
