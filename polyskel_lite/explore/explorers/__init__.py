"""One explorer for each question of the book: controls, a drawing board, what to look for, and the numbers.

In the room: `Explorer`, what all have in common; one module for each of the nine; the files that an
explorer hands on. They compute with the library's public functions only.
"""

from .bring_your_own import explore
from .explorer import Explorer
from .growing_ball import maximal_ball
from .methods_compared import four_methods
from .moving_balls import balls
from .moving_samples import graphs
from .refining import refinement
from .removing import removals
from .resampling import sampling
from .simplifying import thresholds
