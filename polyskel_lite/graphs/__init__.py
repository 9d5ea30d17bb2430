"""Delaunay tessellation and Gabriel graph of samples (section 2.2 of the paper).

In the room: `Tessellation`; the loops that insert points into one, exact and with one answer where there are
ties; the Gabriel graph. The Voronoi graph is the dual, and stands with the skeletons.
"""

from .cocircular import preferring
from .delaunay_graph import as_tessellation, delaunay, grown_from
from .gabriel_graph import gabriel, gabriel_mask
from .growing import Change, compiled_wanted
from .tessellation import OPPOSITE, Tessellation, corners_of, facet_rows, in_blocks, moved_back, ordinary
