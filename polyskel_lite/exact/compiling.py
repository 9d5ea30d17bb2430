"""Plain Python loops that numba compiles together, if it is there and when they are wanted."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, cached_property
from pathlib import Path
from types import FunctionType, SimpleNamespace
from zlib import crc32

_OPTIONS = {"cache": True, "error_model": "numpy", "no_cfunc_wrapper": True}


class Loops:
    """Functions that run as they are, on lists, or compiled, on arrays: one source, the same results.

    Decorate them in the order in which they call each other. Nothing is compiled, and numba is not imported,
    before `compiled` is asked for; what is compiled stays in numba's cache.

    Parameters
    ----------
    base : Loops, optional
        Functions of another module that these call.

    Examples
    --------
    >>> loops = Loops()
    >>> @loops("int64(int64)")
    ... def twice(a):
    ...     return 2 * a
    >>> twice(4)
    8
    """

    def __init__(self, base: Loops | None = None):
        self._base = base
        self._sources: list[tuple[str | None, Callable, str]] = []

    def __call__(self, signature: str, stands_for: str | None = None) -> Callable:
        """Note a function; ``stands_for`` names the one that it replaces where all are compiled.

        The signature makes it one specialization, whatever kind of whole numbers the callers have.
        """

        def note(function):
            self._sources.append((stands_for, function, signature))
            return function

        return note

    @staticmethod
    def can_compile() -> bool:
        """Whether numba is there."""
        try:
            return bool(_njit())
        except ImportError:
            return False

    def extended(self) -> Loops:
        """Loops that call these."""
        return Loops(self)

    @cache
    def made(self, compiled: bool, **constants) -> SimpleNamespace:
        """The functions by name, with these values for globals of their modules; compiled, it needs numba."""
        made = vars(self._base.made(compiled)).copy() if self._base else {}
        for name, function in self._copies(compiled, constants):
            function.__globals__.update(made)
            made[name] = function
            if compiled:
                made[name] = _njit()(function.signature, **_OPTIONS)(function)
        return SimpleNamespace(**made)

    def is_cached(self, **constants) -> bool:
        """Whether the compiled functions are in numba's cache; needs numba."""
        *_, (_, last) = self._copies(True, constants)
        path = Path(_njit()(**_OPTIONS)(last).stats.cache_path)
        return any(path.glob(f"*{last.__qualname__}*.nbi"))

    def _copies(self, compiled, constants) -> list[tuple[str, FunctionType]]:
        """New functions, to have other globals; to be compiled, with names that tell all that they call."""
        stamp = crc32(repr(constants).encode(), self._base._stamp if self._base else 0)
        copies = []
        for stands_for, function, signature in self._sources:
            if compiled or not stands_for:
                code = function.__code__
                stamp = crc32(repr((code.co_code, code.co_consts)).encode(), stamp)
                name = stands_for or function.__name__
                copy = FunctionType(code, function.__globals__ | constants, name)
                # numba's cache watches one file only; the stamp makes it watch the functions that are called.
                copy.__qualname__, copy.__module__ = f"{name}_{stamp}", function.__module__
                copy.signature = signature
                copies.append((name, copy))
        return copies

    @cached_property
    def _stamp(self) -> int:
        return int(self._copies(True, {})[-1][1].__qualname__.rsplit("_", 1)[1])


def _njit():
    from numba import njit

    return njit
