"""What the viewer sends to the browser: arrays made small, and a header that says where each one is.

Positions are whole numbers on a grid of 65,536 steps a side (far less than a pixel), except the few vertices
that are far from the shape. Levels stay in double precision, because they decide what is shown.
"""

from __future__ import annotations

import zlib
from typing import Any

import numpy as np

from ...polyballs import Polyball
from ...simplification import Hierarchy
from ...skeletons import Skeleton

GRID = 65535
CORNERS = 72  # of the polygon that stands for a circle


class Packer:
    """Collects arrays into one compressed block.

    Examples
    --------
    >>> packer = Packer()
    >>> ref = packer.add(np.array([5, 5, 900]))
    >>> ref["type"], read(unpack(packer.block()), ref).tolist()
    ('u2', [5, 5, 900])
    """

    def __init__(self):
        self._parts: list[bytes] = []
        self._size = 0

    def add(self, array: np.ndarray, delta: int = 0) -> dict[str, Any]:
        """Append an array; whole numbers take as few bytes as they need; `delta` stores differences."""
        array = np.ravel(array)
        if array.dtype.kind in "iub":
            largest = int(array.max(initial=0))
            array = array.astype("<u1" if largest < 2**8 else "<u2" if largest < 2**16 else "<u4")
        else:
            array = array.astype(array.dtype.newbyteorder("<"), copy=False)
        ref = {"type": array.dtype.str[1:], "at": self._size, "size": array.size}
        if delta:
            # Differences wrap around, as they do in the browser's arrays of the same type.
            first, rest = array[:delta], array[delta:] - array[:-delta]
            array, ref["delta"] = np.concatenate([first, rest]), delta
        data = array.tobytes()
        data += bytes(-len(data) % 8)  # typed arrays begin at a multiple of their size
        self._parts.append(data)
        self._size += len(data)
        return ref

    def places(self, points: np.ndarray, low: np.ndarray, high: np.ndarray) -> dict[str, Any]:
        """Append positions on a grid from `low` to `high`; those outside of it as they are."""
        inside = ((points >= low) & (points <= high)).all(axis=1)
        size = np.where(high > low, high - low, 1.0)
        grid = np.round((points - low) / size * GRID)
        grid[~inside] = 0
        ref = {"grid": self.add(grid.astype(np.uint16)), "low": low.tolist(), "high": high.tolist()}
        far = np.flatnonzero(~inside)
        if len(far):
            ref |= {"far": self.add(far), "far_places": self.add(points[far].astype(np.float32))}
        return ref

    def block(self) -> bytes:
        """Everything so far, compressed (zlib)."""
        return zlib.compress(b"".join(self._parts), 9)


def unpack(block: bytes) -> bytes:
    """The arrays of `Packer.block`, one after the other.

    Examples
    --------
    >>> packer = Packer()
    >>> ref = packer.add(np.array([1.5]))
    >>> len(unpack(packer.block()))
    8
    """
    return zlib.decompress(block)


def read(data: bytes, ref: dict[str, Any]) -> np.ndarray:
    """One array of a block, as the browser reads it.

    Examples
    --------
    >>> packer = Packer()
    >>> ref = packer.add(np.array([7, 9, 8, 12]), delta=2)
    >>> read(unpack(packer.block()), ref).tolist()
    [7, 9, 8, 12]
    """
    array = np.frombuffer(data, dtype=f"<{ref['type']}", count=ref["size"], offset=ref["at"]).copy()
    if step := ref.get("delta"):
        for first in range(step):
            array[first::step] = np.cumsum(array[first::step], dtype=array.dtype)
    return array


def read_places(data: bytes, ref: dict[str, Any]) -> np.ndarray:
    """Positions of a block, (n, N).

    Examples
    --------
    >>> packer = Packer()
    >>> ref = packer.places(np.array([(0.0, 0.5), (9.0, 9.0)]), np.zeros(2), np.ones(2))
    >>> read_places(unpack(packer.block()), ref).round(4).tolist()
    [[0.0, 0.5], [9.0, 9.0]]
    """
    low, high = np.array(ref["low"]), np.array(ref["high"])
    points = low + (high - low) * (read(data, ref["grid"]).reshape(-1, len(low)) / GRID)
    if "far" in ref:
        points[read(data, ref["far"])] = read(data, ref["far_places"]).reshape(-1, len(low))
    return points


def pack_skeleton(packer: Packer, skeleton: Skeleton, radius: float, low, high) -> dict[str, Any]:
    """Pack vertices, radii (in shares of `radius`), edges and polygons of a skeleton.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> packer = Packer()
    >>> lake = psl.sk0(psl.datasets.load("lake"))
    >>> header = pack_skeleton(packer, lake, lake.radii.max(), np.zeros(2), np.ones(2))
    >>> read(unpack(packer.block()), header["edges"]).size == 2 * len(lake.edges)
    True
    """
    edges = np.sort(skeleton.edges, axis=1)
    edges = edges[np.lexsort(edges.T[::-1])]
    header = {
        "vertices": packer.places(skeleton.vertices, low, high),
        "radius": packer.add(np.round(np.clip(skeleton.radii / radius, 0, 1) * GRID).astype(np.uint16)),
        "edges": packer.add(edges, delta=2),
    }
    if len(skeleton.polygons):
        header["sizes"] = packer.add(skeleton.polygons.sizes)
        header["corners"] = packer.add(skeleton.polygons.corners)
    if len(skeleton.rays):
        header["rays"] = packer.add(_rays(skeleton, low, high))
    return header


def _rays(skeleton: Skeleton, low, high) -> np.ndarray:
    """Rays as segments that leave the picture."""
    begin = skeleton.vertices[skeleton.ray_vertices]
    return as_segments(np.stack([begin, begin + 4 * np.linalg.norm(high - low) * skeleton.rays], axis=1))


def as_segments(ends: np.ndarray) -> np.ndarray:
    """Segments as the browser draws them: place, 0, place, 0.

    Examples
    --------
    >>> as_segments(np.array([[(1, 2), (3, 4)]])).tolist()
    [[[1.0, 2.0, 0.0, 0.0], [3.0, 4.0, 0.0, 0.0]]]
    """
    out = np.zeros((len(ends), 2, 4), dtype=np.float32)
    out[..., : ends.shape[-1]] = ends
    return out


def pack_shape(packer: Packer, P, turn, low, high) -> dict[str, Any]:
    """Pack the samples (their axes changed by `turn`) and the inner simplices of a `DelaunayShape`.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> packer = Packer()
    >>> P = psl.delaunay_shape(psl.Shape.from_rings([[(0, 0), (1, 0), (0, 1)]]))
    >>> header = pack_shape(packer, P, np.asarray, np.zeros(2), np.ones(2))
    >>> read(unpack(packer.block()), header["simplices"]).tolist()
    [0, 1, 2]
    """
    return {
        "points": packer.places(turn(P.tessellation.points), low, high),
        "simplices": packer.add(P.tessellation.simplices[P.inner]),
        "samples": packer.add(np.arange(len(P.tessellation.points)), delta=1),
    }


def pack_polyball(packer: Packer, Y: Polyball, turn, low, high) -> dict[str, Any]:
    """Pack the boundary of a `Polyball` and, in the plane, triangles that fill its discs.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> packer = Packer()
    >>> Y = psl.Polyball([(0, 0), (1, 0)], [1, 1])
    >>> header = pack_polyball(packer, Y, np.asarray, np.full(2, -2), np.full(2, 2))
    >>> read(unpack(packer.block()), header["fill"]).size == 2 * 3 * CORNERS
    True
    """
    if Y.dimension == 3:
        points, facets, _ = Y.patches()
        return {"points": packer.places(turn(points), low, high), "surface": packer.add(facets)}
    whole = np.arange(CORNERS) * (2 * np.pi / CORNERS)
    discs = Y.centers[:, None] + Y.radii[:, None, None] * _directions(whole)
    first = np.arange(len(Y))[:, None] * CORNERS + np.arange(CORNERS)
    middle = np.full(first.shape, len(Y) * CORNERS) + np.arange(len(Y))[:, None]
    points, lines, count = [discs.reshape(-1, 2), Y.centers], [], len(Y) * (CORNERS + 1)
    for ball, start, end in zip(*Y.arcs(), strict=True):
        steps = max(int(np.ceil((end - start) / (2 * np.pi) * CORNERS)), 1)
        points.append(Y.centers[ball] + Y.radii[ball] * _directions(np.linspace(start, end, steps + 1)))
        lines.append(count + np.arange(steps)[:, None] + [0, 1])
        count += steps + 1
    return {
        "points": packer.places(np.concatenate(points), low, high),
        "fill": packer.add(np.stack([middle, first, np.roll(first, -1, axis=1)], axis=2)),
        "surface": packer.add(np.concatenate(lines)),
    }


def _directions(angles: np.ndarray) -> np.ndarray:
    return np.stack([np.cos(angles), np.sin(angles)], axis=-1)


def pack_hierarchy(packer: Packer, h: Hierarchy) -> dict[str, Any]:
    """Pack when each simplex goes, 0 the first, those that never go last; and the level of each removal.

    The levels never decrease along the order of removal. So at a threshold exactly those simplices are gone
    whose rank is below the number of levels below the threshold: one bisection, and whole numbers from there.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> packer = Packer()
    >>> h = psl.hierarchy(psl.datasets.load("lake"))
    >>> header = pack_hierarchy(packer, h)
    >>> rank, levels = (read(unpack(packer.block()), header[name]) for name in ("rank", "level"))
    >>> bool(((rank >= np.searchsorted(levels, 3.0)) == (h.level >= 3.0)).all())
    True
    """
    return {"rank": packer.add(np.minimum(h.rank, len(h.order))), "level": packer.add(h.level[h.order])}


def scale(levels: np.ndarray, angles: bool = False) -> dict[str, Any]:
    """How the threshold slider runs, and the colours of levels.

    Up to its knee the slider is even, beyond it runs by factors to the largest level: lengths over radii
    have no bound, but what is read is below 2.5 π; angles end at π, and there the slider is even all the
    way. The colours have the median level in their middle, by a power.

    Parameters
    ----------
    levels : (n,) array
    angles : bool
        Whether levels are angles, as those of surface skeletons are.

    Examples
    --------
    >>> found = scale(np.array([-np.inf, 1.0, 2.0, 9.0]))
    >>> found["systematic"], found["knee"] / np.pi
    (True, 2.5)
    """
    finite = levels[np.isfinite(levels)]
    steps = np.ceil(finite.max(initial=0.0) / np.pi * 100 + 1e-6) / 100
    largest = float(max(steps, 0.01) * np.pi)
    middle = float(np.median(finite)) if len(finite) else largest
    power = float(np.clip(np.log(max(middle, 1e-9) / largest) / np.log(0.5), 1, 4))
    knee = np.pi if angles else 2.5 * np.pi
    systematic = bool(np.isneginf(levels).any())
    return {"largest": largest, "knee": knee, "power": round(power, 3), "systematic": systematic}


def counts(header: dict[str, Any], data: bytes, threshold: float, strategy: int = 0) -> dict[str, int]:
    """What the browser shows at a threshold, computed from the packed arrays in the same way.

    Parameters
    ----------
    header : dict
        Of one variant.
    data : bytes
        Of `unpack`.
    threshold : float
        In radians.
    strategy : int
        Which hierarchy of the variant.

    Returns
    -------
    dict
        Numbers of "vertices", "edges", "polygons" and "branches", which are counted by their free ends.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> from polyskel_lite import explore
    >>> picture = explore.viewer(psl.datasets.load("lake"))
    >>> found = counts(picture.scene["variants"][0], unpack(picture.blob), 3.0)
    >>> found["vertices"] == len(psl.hierarchy(psl.datasets.load("lake")).skeleton(3.0).vertices)
    True
    """
    n = header["vertices"]["grid"]["size"] // len(header["vertices"]["low"])
    edges = read(data, header["edges"]).astype(np.intp).reshape(-1, 2)
    about = header["hierarchies"][strategy]
    rank, cut = np.zeros(n, dtype=np.int64), 0
    if "rank" in about:
        rank = read(data, about["rank"]).astype(np.int64)
        cut = int(np.searchsorted(read(data, about["level"]), threshold))
    keep = rank >= cut
    edges = edges[keep[edges].all(axis=1)]
    covered, polygons = np.zeros(n, dtype=bool), 0
    if "sizes" in header:
        sizes, corners = read(data, header["sizes"]).astype(np.intp), read(data, header["corners"])
        whole = np.logical_and.reduceat(keep[corners], np.cumsum(sizes) - sizes)
        polygons = int(whole.sum())
        covered[corners[np.repeat(whole, sizes)]] = True
    ends = keep & ~covered & (np.bincount(edges.ravel(), minlength=n) == 1)
    return {
        "vertices": int(keep.sum()),
        "edges": len(edges),
        "polygons": polygons,
        "branches": int(ends.sum()),
    }
