"""Pictures to take hold of: the skeleton viewer, and one explorer per question of the book.

The viewer also works on the pages of the book, where no kernel runs. Everything here needs the extra ``lab``:
``pip install polyskel-lite[lab]``. Nothing here computes what the rest of the library does not.

Examples
--------
>>> import polyskel_lite as psl
>>> from polyskel_lite import explore
>>> picture = explore.viewer(psl.datasets.load("lake"), alt="A lake and its skeleton.")
>>> picture.counts()["branches"] > picture.counts(6.28)["branches"]
True
"""

import sys
from importlib import import_module
from types import ModuleType

__all__ = [
    "Board",
    "Explorer",
    "SkeletonViewer",
    "balls",
    "explore",
    "four_methods",
    "graphs",
    "maximal_ball",
    "refinement",
    "removals",
    "sampling",
    "thresholds",
    "viewer",
]
# Where each name lives; a module is imported when its first name is asked for.
_HOMES = {name: name for name in __all__} | {
    "Board": "board",
    "Explorer": "explorer",
    "SkeletonViewer": "skeleton_viewer",
    "explore": "bring_your_own",
    "viewer": "skeleton_viewer",
}
_NEEDED = ("anywidget", "ipywidgets", "traitlets")


def __getattr__(name):
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        return getattr(import_module(f".{_HOMES[name]}", __name__), name)
    except ModuleNotFoundError as error:
        if error.name not in _NEEDED:
            raise
        raise ImportError(
            f"polyskel_lite.explore needs {error.name}, which is not installed; "
            "run: pip install polyskel-lite[lab]"
        ) from None


def __dir__():
    return sorted({*globals(), *__all__})


class _Package(ModuleType):
    """Modules of explorers are named after their function; the name in the package means the function."""

    def __setattr__(self, name, value):
        if isinstance(value, ModuleType) and name in _HOMES:
            value = getattr(value, name, value)
        super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
