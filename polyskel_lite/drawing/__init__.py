"""Pictures with matplotlib: every function takes an axes first and the data second, and returns the axes.

Nothing here computes geometry that the rest of the library does not know, and nothing imports widgets. One
colour and one line pattern stand for each kind of object throughout the book (`KINDS`, `legend`).

Examples
--------
>>> import matplotlib.pyplot as plt
>>> import polyskel_lite as psl
>>> from polyskel_lite import drawing
>>> square = psl.Shape.from_rings([[(0, 0), (2, 0), (2, 2), (0, 2)]]).resample(12)
>>> fig, ax = drawing.axes()
>>> ax = drawing.draw_shape(ax, square)
>>> ax = drawing.draw_skeleton(ax, psl.sk0(square), kind="sk0")
>>> ax = drawing.legend(ax, "shape", "sk0")
>>> plt.close(fig)
"""

from .balls import draw_ball, draw_balls
from .counts import draw_branch_counts
from .dispatch import plot
from .graphs import draw_delaunay, draw_gabriel, draw_skeleton, draw_voronoi
from .light import LIGHT, normals_of, shades, view_direction
from .lines import box_of, chains, clip_segments, ray_segments
from .pages import picture
from .planar import draw_lines, draw_samples, draw_shape
from .spatial import draw_facets_3d, draw_lines_3d, draw_mesh, draw_samples_3d
from .spatial_balls import draw_polyball_3d
from .spatial_graphs import OPPOSITE, draw_tessellation_3d, draw_voronoi_3d
from .spatial_skeletons import RAMP, draw_color_bar, draw_glass, draw_skeleton_3d
from .style import (
    CORE,
    KINDS,
    RC,
    TEXT_WIDTH,
    Kind,
    axes,
    handle,
    kind_of,
    legend,
    letter_size,
    page_share,
    page_width,
    say,
    setup,
    thin,
)
from .view import VIEW, axes_3d, fill_panel, focus, focus_3d, inset, panels
