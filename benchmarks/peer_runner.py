"""One peer on one shape: ``peer_runner.py "PACKAGE METHOD" SHAPE.npz`` prints seconds and loops as JSON.

It runs under the interpreter of `peers.txt` and imports nothing of this project. Each method is called with
the defaults of its documentation; where a length must be chosen, it is one that is named in the code.
"""

import json
import sys
import time

import numpy as np


def graph_numbers(vertices: int, edges: np.ndarray) -> tuple[int, int]:
    """Loops and pieces of a graph: E - V + C and C."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    edges = np.unique(np.sort(np.asarray(edges).reshape(-1, 2), axis=1), axis=0)
    edges = edges[edges[:, 0] != edges[:, 1]]
    weights = np.ones(len(edges))
    pieces = connected_components(coo_matrix((weights, edges.T), shape=(vertices, vertices)), directed=False)[
        0
    ]
    return len(edges) - vertices + pieces, pieces


def line_numbers(lines) -> tuple[int, int]:
    """The same of polylines that meet where they share coordinates."""
    ends = np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in lines])
    _, number = np.unique(ends.reshape(-1, 2).round(9), axis=0, return_inverse=True)
    number = number.reshape(-1, 2)
    return graph_numbers(number.max() + 1, number)


def cell_numbers(mask: np.ndarray) -> tuple[int, int]:
    """Loops and pieces of a set of pixels or voxels that touch in corners: C - Euler number (no cavities)."""
    from scipy.ndimage import label
    from skimage.measure import euler_number

    pieces = label(mask, np.ones((3,) * mask.ndim))[1]
    return int(pieces - euler_number(mask, connectivity=mask.ndim)), int(pieces)


def polygon(shape):
    """The outline as a shapely polygon: the longest ring is the outer one."""
    from shapely.geometry import Polygon

    rings = np.split(shape["points"], np.cumsum(shape["sizes"])[:-1])
    rings.sort(key=lambda ring: -np.ptp(ring, axis=0).max())
    return Polygon(rings[0], rings[1:])


def mesh(shape):
    """The solid as a trimesh mesh."""
    import trimesh

    return trimesh.Trimesh(shape["points"], shape["faces"], process=False)


def lines_of(geometry):
    """Coordinates of every line of a shapely geometry."""
    return [np.asarray(line.coords) for line in getattr(geometry, "geoms", [geometry])]


def trimesh_medial_axis(shape):
    from trimesh.path.polygons import medial_axis

    outline = polygon(shape)
    yield
    edges, vertices = medial_axis(outline)
    yield graph_numbers(len(vertices), edges)


def centerline_centerline(shape):
    from centerline.geometry import Centerline

    outline = polygon(shape)
    step = np.ptp(shape["points"], axis=0).max() / 600  # its default, half a unit, depends on the unit
    yield
    line = Centerline(outline, step)
    yield line_numbers(lines_of(line.geometry))


def pygeoops_centerline(shape):
    import pygeoops

    outline = polygon(shape)
    yield
    line = pygeoops.centerline(outline)
    yield line_numbers(lines_of(line))


def skimage_medial_axis(shape):
    from skimage.morphology import medial_axis

    mask = shape["mask"]
    yield
    skeleton = medial_axis(mask, rng=0)  # it breaks ties at random
    yield cell_numbers(skeleton)


def skimage_skeletonize(shape):
    from skimage.morphology import skeletonize

    mask = shape["mask"]
    yield
    skeleton = skeletonize(mask)
    yield cell_numbers(skeleton > 0)


def skeletor_method(shape, method, **options):
    import skeletor

    solid = mesh(shape)
    yield
    result = getattr(skeletor.skeletonize, method)(solid, **options)
    yield graph_numbers(len(result.vertices), result.edges)


def kimimaro_skeletonize(shape):
    import kimimaro

    labels = shape["mask"].astype(np.uint32)
    yield
    # Lengths in voxels, not in nanometres of its defaults, which are those of brain images.
    parameters = {"scale": 1.5, "const": 5, "pdrf_scale": 100000, "pdrf_exponent": 4}
    skeletons = kimimaro.skeletonize(labels, parameters, progress=False, dust_threshold=10)
    yield graph_numbers(len(skeletons[1].vertices), skeletons[1].edges)


def method(name: str, shape):
    """The generator of one method: it stops before and after the computation."""
    size = float(np.ptp(shape["points"], axis=0).max())
    return {
        "trimesh medial_axis": lambda: trimesh_medial_axis(shape),
        "centerline Centerline": lambda: centerline_centerline(shape),
        "pygeoops centerline": lambda: pygeoops_centerline(shape),
        "scikit-image medial_axis": lambda: skimage_medial_axis(shape),
        "scikit-image skeletonize": lambda: skimage_skeletonize(shape),
        "skeletor by_wavefront": lambda: skeletor_method(shape, "by_wavefront", progress=False),
        "skeletor by_teasar": lambda: skeletor_method(shape, "by_teasar", inv_dist=size / 10, progress=False),
        "skeletor by_vertex_clusters": lambda: skeletor_method(
            shape, "by_vertex_clusters", sampling_dist=size / 20, progress=False
        ),
        "skeletor by_tangent_ball": lambda: skeletor_method(shape, "by_tangent_ball"),
        "kimimaro skeletonize": lambda: kimimaro_skeletonize(shape),
    }[name]()


def main() -> None:
    name, path = sys.argv[1:]
    shape = dict(np.load(path))
    times = []
    for _ in range(2):
        steps = method(name, shape)
        next(steps)
        start = time.perf_counter()
        found, pieces = next(steps)
        times.append(time.perf_counter() - start)
    row = {"seconds": times[0], "second": times[1], "found": int(found), "pieces": int(pieces), "note": ""}
    print(json.dumps(row))


if __name__ == "__main__":
    main()
