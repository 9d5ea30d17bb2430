"""The paper's figures, each one function: data in, figure out.

Called without data each function takes a shape of `polyskel_lite.datasets`; caption and alt text are its
attributes. ``python -m polyskel_lite.figures FOLDER`` writes them all as PDF, SVG and PNG, as wide as one
column of a journal and as wide as two, with a list of what each was made from.

Examples
--------
>>> import matplotlib.pyplot as plt
>>> from polyskel_lite import figures
>>> figure = figures.figure_2([(0, 0), (2, 0), (0, 1), (3, 3), (1, 2)])
>>> len(figure.axes)
3
>>> plt.close(figure)
>>> list(figures.FIGURES)[:4]
['figure_1', 'figure_2', 'figure_2_3d', 'figure_3']
"""

from .definitions import figure_1, figure_2, figure_2_3d
from .methods import figure_3, figure_4, figure_5, regular_shape, samplings_4
from .polyballs import CENTERS_11, RADII_11, contacts, draw_with_skeleton, examples_12, figure_11, figure_12
from .proof import figure_13
from .registry import FIGURES, WIDTHS, described, write_figures
from .removals import OCTAHEDRON, figure_6, figure_7
from .results import figure_10
from .simplification import figure_8, figure_9
from .solids import draw_apart, draw_solid, helix, lens, moved_apart, orange, paint, simplex_of, star
