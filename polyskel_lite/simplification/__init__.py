"""Simplifying shape and skeleton without changing the topology (section 4 of the paper).

In the room: `Hierarchy`, the skeletons at every threshold at once; the measures behind the criteria; one
removal at a time with the state before and after it, and A(v); how branches retreat; the one hot loop.
"""

from .criteria import face_angles, facet_measures
from .hierarchies import STRATEGIES, Hierarchy, hierarchy
from .removals import Removal, simplices_by_type, state_at, try_removal
from .retreat import Ways, behind, end_vertices, paths_back, ways
