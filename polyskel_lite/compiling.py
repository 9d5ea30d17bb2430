"""Plain Python loops that numba compiles together, if it is there and when they are wanted."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import CodeType, FunctionType, SimpleNamespace
from zlib import crc32

_OPTIONS = {"cache": True, "error_model": "numpy", "no_cfunc_wrapper": True}


class Loops:
    """Functions that run as they are, on lists, or compiled, on arrays: one source, the same results.

    Decorate them in the order in which they call each other. Nothing is compiled, and numba is not imported,
    before `made` is asked for it; what is compiled stays in numba's cache.

    Parameters
    ----------
    base : Loops, optional
        Functions of another module that these call.

    Examples
    --------
    >>> loops = Loops()
    >>> @loops("int64(int64)")
    ... def scaled(a):
    ...     return FACTOR * a
    >>> loops.made(False, FACTOR=2).scaled(4)
    8
    """

    def __init__(self, base: Loops | None = None):
        self._base = base
        self._sources: list[tuple[Callable, str, str | None]] = []
        self._made: dict[tuple, SimpleNamespace] = {}

    def __call__(self, signature: str, stands_for: str | None = None) -> Callable:
        """Note a function; ``stands_for`` names the one that it replaces where all are compiled.

        The signature makes it one specialization, whatever kind of whole numbers the callers have.
        """

        def note(function):
            self._sources.append((function, signature, stands_for))
            return function

        return note

    def extended(self) -> Loops:
        """Loops that call these."""
        return Loops(self)

    def made(self, compiled: bool, **constants) -> SimpleNamespace:
        """The functions by name, with these values for globals of their modules; compiled, it needs numba."""
        key = compiled, *constants.items()
        if key not in self._made:
            made = vars(self._base.made(compiled)).copy() if self._base else {}
            for name, function, signature in self._copies(compiled, constants):
                function.__globals__.update(made)
                made[name] = _compiled(function, signature) if compiled else function
            self._made[key] = SimpleNamespace(**made)
        return self._made[key]

    @staticmethod
    def can_compile() -> bool:
        """Whether numba is there, works, and is not told to leave everything as it is."""
        try:
            from numba import config
        except Exception:  # a numba that does not go with NumPy raises all kinds of errors
            return False
        return not getattr(config, "DISABLE_JIT")  # noqa: B009 # numba sets it when it is imported

    def is_cached(self, **constants) -> bool:
        """Whether the compiled functions are in numba's cache; needs numba."""
        _, last, _ = self._copies(True, constants)[-1]
        path = _compiled(last).stats.cache_path
        return path is not None and any(Path(path).glob(f"*{last.__qualname__}*.nbi"))

    def _copies(self, compiled, constants) -> list[tuple[str, FunctionType, str]]:
        """Names, functions with globals of their own, and signatures."""
        # numba's cache watches one file only: names that tell the code so far make it watch what is called.
        called = self._base._sources if self._base else []
        stamp = crc32(repr([_written(f.__code__) for f, *_ in called]).encode())
        copies = []
        for function, signature, stands_for in self._sources:
            code = function.__code__
            stamp = crc32(repr((_written(code), constants)).encode(), stamp)
            if compiled or not stands_for:
                copy = FunctionType(code, function.__globals__ | constants)
                name = stands_for or function.__name__
                copy.__qualname__, copy.__module__ = f"{name}_{stamp}", function.__module__
                copies.append((name, copy, signature))
        return copies


def _written(code: CodeType) -> tuple:
    """What a function does, the same in every process: code inside of it has an address when written."""
    return code.co_code, [_written(c) if isinstance(c, CodeType) else c for c in code.co_consts]


def _compiled(function, *signature):
    from numba import njit

    try:
        return njit(*signature, **_OPTIONS)(function)
    except RuntimeError:  # there is no folder that the cache could be written to
        return njit(*signature, **_OPTIONS | {"cache": False})(function)


def main() -> None:
    """Compile everything once, so that nobody waits for it later; it needs numba."""
    import numpy as np

    import polyskel_lite

    for dimension in (2, 3):
        points = np.random.default_rng(0).random((2_000, dimension))
        tessellation = polyskel_lite.delaunay(points)
        inner = np.ones(len(tessellation.simplices), dtype=bool)
        polyskel_lite.hierarchy(polyskel_lite.DelaunayShape(tessellation, inner))
