"""Graded assignments: what a check cell needs to say whether an answer is right.

The checks travel with the library, so that they are the same on a student's machine, in the browser and
when a submission is graded. `checks_fresh` gives them as they were written, whatever a notebook has done
to them since. Release and grading are no part of the library: they stand in ``tools/``.
"""

from .checks import checks_fresh
