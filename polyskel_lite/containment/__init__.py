"""When a boundary is in the Delaunay or Gabriel graph of its samples (sections 3.4 and 3.5 of the paper).

In the room: the shape P_w as a set of Delaunay simplices; `conform`, which refines a boundary until it is
in the graph, by midpoints in the plane, by flips and midpoints in space; a curve found again from its
samples alone.
"""

from .conforming import Stage, conform, conform_stages, diametral_balls, missing_facets
from .delaunay_shapes import DelaunayShape, delaunay_shape
from .reconstruction import reconstruct_curve
