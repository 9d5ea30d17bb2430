"""The four skeletons Sk0 to Sk3 (section 3 of the paper), and what is read off any skeleton.

In the room: `Skeleton`, an abstract cell complex with balls around its vertices; the Voronoi graph and the
dual of any Delaunay simplices; what of it is inside a shape, exactly; branches as a graph and as a table, the
main axis, widths along it;
Hausdorff distances. Apart from samples: the maximal balls of a polygon itself.
"""

from .axes import Axis, Stations
from .branch_tables import Branch, Branches, branch_rows
from .branches import branch_graph, free_edges, smooth_lengths
from .distances import directed_hausdorff, hausdorff
from .four_methods import sk0, sk1, sk2, sk3
from .maximal_balls import contact_points, grown_ball
from .skeleton import Skeleton
from .voronoi_graph import dual_complex, voronoi
