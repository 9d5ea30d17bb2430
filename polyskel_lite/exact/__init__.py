"""Signs and counts that never round: where a point lies, what meets what, what is connected.

Floats with an error bound decide nearly everything, whole numbers and fractions the rest. In the room:
predicates (orientation, in-ball and Gabriel tests), segments, triangles, regions, boxes that overlap,
fractions, polygons and rings around edges, Betti numbers, rows of small whole numbers.
"""

from .arrays import spread_out, unique_rows
from .boxes import near_pairs, octave_pairs, octaves, overlapping_pairs
from .nearest import facet_distance, nearest_facets, nearest_on_facets
from .polygons import Polygons, dual_polygons, edge_rings
from .predicates import as_integers, fractions, in_ball, in_gabriel_ball, orientation
from .rational import circumcenter_terms, clip_rational, normals_of, rational_circumcenter
from .regions import locate, odd_around
from .segments import first_meeting, nearest_on_segments
from .signs import flat_turn, in_circle, in_sphere, turn_2d, turn_3d, whole_numbers
from .signs import loops as sign_loops
from .topology import betti_numbers, components, occurrences
from .triangles import meeting_faces, shadow_signs
