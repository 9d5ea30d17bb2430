"""Continuous skeletons from the Voronoi graph of boundary samples (Attali & Montanvert, CVIU 1997)."""

from . import datasets, implicit
from .branches import branch_graph
from .complexes import Skeleton
from .conforming import conform, missing_facets
from .delaunay_balls import Sk2Conditions, delaunay_balls, sk2_conditions
from .delaunay_shapes import DelaunayShape, delaunay_shape
from .distances import directed_hausdorff, hausdorff
from .errors import (
    ContourContainmentError,
    DuplicatePointError,
    InputError,
    PolyskelError,
    ReconstructionError,
    ShapeError,
    TangentBallsError,
    TessellationError,
)
from .graphs import Tessellation, delaunay, gabriel, voronoi
from .polyballs import Polyball
from .reconstruction import reconstruct_curve
from .shapes import Shape
from .simplification import Hierarchy, hierarchy
from .skeletons import sk0, sk1, sk2, sk3

__all__ = [
    "ContourContainmentError",
    "DelaunayShape",
    "DuplicatePointError",
    "Hierarchy",
    "InputError",
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
    "missing_facets",
    "reconstruct_curve",
    "sk0",
    "sk1",
    "sk2",
    "sk2_conditions",
    "sk3",
    "voronoi",
]
