"""Pictures to take hold of: the skeleton viewer, and one explorer per question of the book.

The viewer also works on the pages of the book, where no kernel runs. Everything here needs
``pip install ipywidgets anywidget``. Nothing here computes what the rest of the library does not.

Examples
--------
>>> import polyskel_lite as psl
>>> from polyskel_lite import explore
>>> picture = explore.viewer(psl.datasets.load("lake"), alt="A lake and its skeleton.")
>>> picture.counts(0)["branches"] > picture.counts(6.28)["branches"]
True
"""

from importlib import import_module

_EXPLORERS = "Explorer balls explore four_methods graphs maximal_ball refinement removals sampling thresholds"
# A room is imported when the first of its names is asked for.
_ROOMS = {"drawing_board": "Board", "explorers": _EXPLORERS, "skeleton_viewer": "SkeletonViewer viewer"}
_ROOM_OF = {name: room for room, names in _ROOMS.items() for name in names.split()}
_NEEDED = ("anywidget", "ipywidgets", "traitlets")

__all__ = sorted(_ROOM_OF)


def __getattr__(name):
    if name not in _ROOM_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        return getattr(import_module(f".{_ROOM_OF[name]}", __name__), name)
    except ModuleNotFoundError as error:
        if error.name not in _NEEDED:
            raise
        raise ImportError(
            f"polyskel_lite.explore needs {error.name}, which is not installed; "
            "run: pip install ipywidgets anywidget"
        ) from None


def __dir__():
    return sorted({*globals(), *__all__})
