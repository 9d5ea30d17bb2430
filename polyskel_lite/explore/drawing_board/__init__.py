"""The drawing board of the explorers: layers of lines, points, discs and polygons, and handles to drag.

In the room: `Board`, a widget that is also a still picture (SVG) for pages without a kernel, and how each
kind of object is drawn, with the colours and patterns of `polyskel_lite.drawing`.
"""

from .board import Board, box_around
