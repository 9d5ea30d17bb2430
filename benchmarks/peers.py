"""Other skeleton packages on the same shapes: seconds, and whether the number of loops is right.

    python -m venv peers && peers/bin/pip install -r benchmarks/peers.txt
    python benchmarks/peers.py --python peers/bin/python      # writes peers.csv
    python benchmarks/peers.py                                # this library only; the peers' rows stay

The shapes are made here, by this interpreter; each peer runs on each shape in a process of its own under
the other interpreter (`peer_runner.py`), so that the peers never enter the project's environment. This
library has a process of its own as well. ``seconds`` is the first call in that process, ``second`` the next.
"""

from __future__ import annotations

import argparse
import csv
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from tables import write_table

import polyskel_lite as psl
from polyskel_lite import implicit

HERE = Path(__file__).resolve().parent
OUTLINES = ("horse", "gear", "lake")
FIELDS = {"torus": implicit.torus, "double torus": implicit.double_torus, "tetrapod": implicit.tetrapod}
COLUMNS = ("shape", "loops", "package", "method", "seconds", "second", "found", "pieces", "note", "date")
PIXELS, VOXELS, SAMPLES, LIMIT = 600, 96, 2000, 300
PEERS = {
    2: (
        "trimesh medial_axis",
        "centerline Centerline",
        "pygeoops centerline",
        "scikit-image medial_axis",
        "scikit-image skeletonize",
    ),
    3: (
        "skeletor by_wavefront",
        "skeletor by_teasar",
        "skeletor by_vertex_clusters",
        "skeletor by_tangent_ball",
        "kimimaro skeletonize",
        "scikit-image skeletonize",
    ),
}


def grid(shape_or_field, low, high, cells: int) -> tuple[np.ndarray, float]:
    """Which centres of pixels or voxels are inside, and the side of one; one cell of margin all around."""
    side = float((high - low).max() / cells)
    axes = [np.arange(a - 1.5 * side, b + 2 * side, side) for a, b in zip(low, high, strict=True)]
    centers = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    flat = centers.reshape(-1, len(axes))
    inside = (
        shape_or_field.contains(flat) if isinstance(shape_or_field, psl.Shape) else shape_or_field(flat) < 0
    )
    return inside.reshape(centers.shape[:-1]), side


def region(name: str, pixels: int = PIXELS) -> tuple[psl.Shape, int, dict]:
    """An outline, its number of loops, and what the peers get: vertices, rings, pixels."""
    shape = psl.datasets.load(name)
    mask, side = grid(shape, shape.points.min(axis=0), shape.points.max(axis=0), pixels)
    rings = shape.rings()
    sizes = np.array([len(r) for r in rings])
    return (
        shape,
        shape.betti()[1],
        {
            "points": shape.points[np.concatenate(rings)],
            "sizes": sizes,
            "mask": mask,
            "side": side,
        },
    )


def solid(name: str, samples: int = SAMPLES, voxels: int = VOXELS) -> tuple[psl.Shape, int, dict]:
    """An implicit solid, its number of loops, and what the peers get: mesh, voxels."""
    field = FIELDS[name]()
    shape = implicit.solid(field, samples)
    mask, side = grid(field, shape.points.min(axis=0), shape.points.max(axis=0), voxels)
    return (
        shape,
        shape.betti()[1],
        {"points": shape.points, "faces": shape.facets, "mask": mask, "side": side},
    )


def skeleton_of(points: np.ndarray, facets: np.ndarray, strategy: str) -> psl.Skeleton:
    """From the boundary to its simplified skeleton with this library."""
    shape = psl.Shape(points, facets)
    try:
        P = psl.delaunay_shape(shape)
    except psl.ContourContainmentError:
        P = psl.delaunay_shape(psl.conform(shape))
    return psl.hierarchy(P, strategy).skeleton(np.pi / 3 if strategy == "surface" else 2 * np.pi)


def measure_ours(path: str, strategy: str) -> dict:
    """First and second call of this library on a stored boundary, here."""
    data, times = np.load(path), []
    for _ in range(2):
        points, facets = data["points"], data["facets"]
        start = time.perf_counter()
        skeleton = skeleton_of(points, facets, strategy)
        times.append(time.perf_counter() - start)
    pieces, found = skeleton.betti()[:2]
    return {"seconds": times[0], "second": times[1], "found": found, "pieces": pieces, "note": ""}


def ours(shape: psl.Shape, strategy: str) -> dict:
    """`measure_ours` in a process of its own, as the peers have one."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "shape.npz"
        np.savez(path, points=shape.points, facets=shape.facets)
        command = [sys.executable, __file__, "--ours", str(path), strategy]
        done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout.splitlines()[-1])


def theirs(python: str, method: str, data: dict, limit: float = LIMIT) -> dict:
    """From the shape to a skeleton with a peer, in its own process; import time is not counted."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "shape.npz"
        np.savez(path, **data)
        command = [python, str(HERE / "peer_runner.py"), method, str(path)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=limit, check=False)
        except subprocess.TimeoutExpired:
            return {
                "seconds": "",
                "second": "",
                "found": "",
                "pieces": "",
                "note": f"stopped after {limit:g} s",
            }
    if done.returncode:
        lines = done.stderr.strip().splitlines()
        return {
            "seconds": "",
            "second": "",
            "found": "",
            "pieces": "",
            "note": (lines[-1] if lines else "failed")[:80],
        }
    return json.loads(done.stdout.splitlines()[-1])


def compare(name: str, shape: psl.Shape, loops: int, data: dict, python: str | None) -> list[dict]:
    """The rows of one shape: this library first, then the peers (none without an interpreter for them)."""
    strategies = ("branch",) if shape.dimension == 2 else ("surface", "wireframe")
    rows = []
    for strategy in strategies:
        rows.append({"package": "polyskel_lite", "method": strategy} | ours(shape, strategy))
    for peer in PEERS[shape.dimension] if python else ():
        package, method = peer.split()
        rows.append({"package": package, "method": method} | theirs(python, peer, data))
    for row in rows:
        row |= {"shape": name, "loops": loops, "date": time.strftime("%Y-%m-%d")}
        for call in ("seconds", "second"):
            if row[call] != "":
                row[call] = f"{row[call]:.3f}"
    return rows


def with_peers(rows: list[dict], path: Path) -> list[dict]:
    """Rows of this library, each shape followed by the rows of the peers that a file has."""
    known = []
    if path.exists():
        with open(path, newline="", encoding="utf-8") as file:
            known = [row for row in csv.DictReader(file) if row["package"] != "polyskel_lite"]
    names = dict.fromkeys(row["shape"] for row in rows)
    return [row for name in names for row in (*rows, *known) if row["shape"] == name]


def main(arguments=None) -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--python", help="interpreter that has the packages of peers.txt")
    parser.add_argument("--out", type=Path, default=HERE, help="folder of peers.csv")
    parser.add_argument("--small", action="store_true", help="a few shapes, few samples: to try the script")
    parser.add_argument("--ours", nargs=2, metavar=("SHAPE", "STRATEGY"), help="one measurement, as JSON")
    options = parser.parse_args(arguments)
    if options.ours:
        print(json.dumps(measure_ours(*options.ours)))
        return
    if not options.python:
        print("no --python: only polyskel_lite is measured", file=sys.stderr)
    rows, path = [], options.out / "peers.csv"
    for name in OUTLINES[:1] if options.small else OUTLINES:
        rows += compare(name, *region(name, 80 if options.small else PIXELS), options.python)
    for name in list(FIELDS)[:1] if options.small else FIELDS:
        small = (300, 24) if options.small else (SAMPLES, VOXELS)
        rows += compare(name, *solid(name, *small), options.python)
        print(name, flush=True)
    options.out.mkdir(parents=True, exist_ok=True)
    if not options.python:
        rows = with_peers(rows, path)
    write_table(path, rows, COLUMNS)


if __name__ == "__main__":
    main()
