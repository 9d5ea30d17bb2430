"""Delaunay tessellation and Gabriel graph of samples (section 2.2 of the paper).

In the room: `Tessellation`, verified after Qhull and mended or made anew where Qhull fails; the Gabriel
graph. The Voronoi graph is the dual, and stands with the skeletons.
"""

from .delaunay_graph import as_tessellation, delaunay
from .gabriel_graph import gabriel, gabriel_mask
from .tessellation import OPPOSITE, Tessellation, circumballs, corners_of, facet_rows, in_blocks, ordinary
