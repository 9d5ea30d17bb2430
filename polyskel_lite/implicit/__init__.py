"""Solids given by a formula: fields that are negative inside, and uniform closed meshes of them.

The shapes here are own work, free of all rights (CC0). Their sizes are easy to change and their Betti
numbers are known, so chapters and tests use them where a handle or a cavity is needed.
"""

from .fields import (
    Field,
    arm,
    ball,
    capsule,
    difference,
    double_torus,
    hollow_ball,
    tetrapod,
    torus,
    trefoil,
    tube,
    union,
)
from .meshing import solid
