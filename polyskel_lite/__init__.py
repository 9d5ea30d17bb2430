"""Continuous skeletons from the Voronoi graph of boundary samples (Attali & Montanvert, CVIU 1997)."""

from . import datasets, implicit
from .containment import (
    DelaunayShape,
    conform,
    delaunay_shape,
    missing_facets,
    reconstruct_curve,
)
from .errors import (
    CoarseSamplingWarning,
    ContourContainmentError,
    DuplicatePointError,
    InputError,
    LeftOutWarning,
    PolyskelError,
    ReconstructionError,
    ShapeError,
    TangentBallsError,
    TessellationError,
)
from .graphs import Tessellation, delaunay, gabriel
from .pipeline import Bones, BranchCounts, branch_counts, skeleton
from .polyballs import Polyball, Sk2Conditions, delaunay_balls, sk2_conditions
from .shapes import Shape, mend
from .simplification import Hierarchy, hierarchy
from .skeletons import Skeleton, branch_graph, directed_hausdorff, hausdorff, sk0, sk1, sk2, sk3, voronoi
from .tables import table

__all__ = [
    "Bones",
    "BranchCounts",
    "CoarseSamplingWarning",
    "ContourContainmentError",
    "DelaunayShape",
    "DuplicatePointError",
    "Hierarchy",
    "InputError",
    "LeftOutWarning",
    "Polyball",
    "PolyskelError",
    "ReconstructionError",
    "Shape",
    "ShapeError",
    "Sk2Conditions",
    "Skeleton",
    "TangentBallsError",
    "Tessellation",
    "TessellationError",
    "branch_counts",
    "branch_graph",
    "conform",
    "datasets",
    "delaunay",
    "delaunay_balls",
    "delaunay_shape",
    "directed_hausdorff",
    "gabriel",
    "hausdorff",
    "hierarchy",
    "implicit",
    "mend",
    "missing_facets",
    "reconstruct_curve",
    "sk0",
    "sk1",
    "sk2",
    "sk2_conditions",
    "sk3",
    "skeleton",
    "table",
    "voronoi",
]
