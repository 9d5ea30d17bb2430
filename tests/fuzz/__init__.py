"""Hostile input, made by the thousand: files, arrays and shapes, each case from a seed and a number.

`arrays` calls every public function with an argument it was not made for, `files` damages files of every
kind, `shapes` and `solids` hold what comes out against the rational truth of `tests/truth`, `plane` and
`space` hold tessellations of hard point sets against their definition. `running` counts what became
of the cases, in processes that may be killed. All of it is own work, under the licence of the project.
"""

from . import arrays, files, shapes, solids, tessellations

FAMILIES = {
    "arrays": arrays.run,
    "files": files.run,
    "shapes": shapes.run,
    "solids": solids.run,
    "plane": tessellations.plane,
    "space": tessellations.space,
}
#: Where more cases than `--count` are run: the quick ones.
TIMES = {"plane": 10}
