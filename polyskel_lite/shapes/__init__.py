"""Shapes by their boundary, and samplings of it (section 2.1 of the paper).

In the room: `Shape`, a closed region of the plane or of space with a checked boundary; what rings and
meshes must be, and what `mend` makes of those that are not; samples at equal distances and how densely they
cover a boundary.
"""

from .boundary import only_in
from .density import FLOOR, SHARE, local_width
from .mending import mend
from .sampling import halved
from .shape import Shape, check_shape
from .splitting import edge_keys, independent, quads, split_edges
