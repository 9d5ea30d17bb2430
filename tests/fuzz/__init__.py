"""Hostile input, made by the thousand: files, arrays and shapes, each case from a seed and a number.

`arrays` calls every public function with an argument it was not made for, `files` damages files of every
kind, `shapes` holds what comes out against the rational truth of `tests/truth`. `running` counts what became
of the cases, in processes that may be killed. All of it is own work, under the licence of the project.
"""

from . import arrays, files, shapes

FAMILIES = {"arrays": arrays.run, "files": files.run, "shapes": shapes.run}
