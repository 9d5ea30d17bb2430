"""Loops that are compiled: what numba's cache knows them by."""

import os
import subprocess
import sys

NAMES = """
from polyskel_lite.graphs.insertion import loops as insertion
from polyskel_lite.simplification.collapse import loops as removal
for loops, constants in ((insertion, {"N": 3, "M": 4}), (removal, {})):
    print(*(copy.__qualname__ for _, copy, _ in loops._copies(True, constants)))
"""


def test_a_loop_has_the_same_name_in_every_process():
    """Else each process would compile it anew; a comprehension inside is written with its address."""
    found = {
        subprocess.run(
            [sys.executable, "-c", NAMES],
            check=True,
            capture_output=True,
            text=True,
            env=os.environ | {"PYTHONHASHSEED": seed},
        ).stdout
        for seed in "123"
    }
    assert len(found) == 1
    assert found.pop().count("\n") == 2
