"""Unions of balls and their exact skeletons (Appendix A of the paper).

In the room: `Polyball`, with its singular points, generating balls, measures and skeleton; the pieces of its
boundary in the plane and in space, from a power triangulation; and the way back to Sk2 (section 3.2).
"""

from .back_to_sk2 import Sk2Conditions, delaunay_balls, sk2_conditions
from .polyball import Polyball
