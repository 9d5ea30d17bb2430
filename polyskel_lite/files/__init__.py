"""Files to arrays and arrays to files, through well-kept readers; no shape and no skeleton is made here.

In the room: outlines from GeoJSON, SVG and pictures (`read_file`, `Area`, `trace`), meshes from STL, PLY,
OBJ and OFF, arrays (`read_arrays`), open files (`on_disk`); surfaces, cell complexes and outlines for other
programs.
"""

from .areas import Area
from .arrays import read_arrays
from .geometries import write_geometry
from .meshes import GEOMETRY_SUFFIXES, read_mesh, write_complex, write_surface, writing
from .pictures import trace
from .readers import read_file
from .streams import on_disk
