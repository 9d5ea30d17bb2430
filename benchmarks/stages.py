"""Time and memory of every stage, as a ratio to `scipy.spatial.Delaunay` in the same run.

    python benchmarks/stages.py                 # all sizes, writes results.csv and machine.json
    python benchmarks/stages.py --largest 5000 --out somewhere

Every input and size runs in a process of its own, once with numba and once with numba hidden; with numba
once more for the memory, because an allocator that gives memory back at once is slower. Seconds and ratios
are medians of five runs after a first one, which is not counted; `targets.py` tells first calls too.
"""

from __future__ import annotations

import argparse
import gc
import json
import os
import subprocess
import sys
import time
from functools import partial
from pathlib import Path
from unittest.mock import patch

import numpy as np
from tables import write_table

HERE = Path(__file__).resolve().parent
SIZES = {
    "curve": (2_000, 5_000, 10_000, 20_000, 50_000, 100_000, 200_000),
    "curve at random": (2_000, 5_000, 10_000, 20_000, 50_000, 100_000, 200_000),
    "outline": (2_000, 5_000, 10_000, 20_000, 50_000, 100_000, 200_000),
    "bumpy sphere": (2_000, 5_000, 10_000, 20_000, 50_000, 100_000),
}
PAPER = ("fourbranch", "chromosome", "vertebra")  # the solids of the paper's Fig. 10
COLUMNS = ("input", "n", "numba", "stage", "seconds", "ratio", "peak_mb", "repeats", "load")
REPEATS = 5
LARGE = 100_000  # from here on plain Python runs once: it takes long, and what disturbs it counts less


class Stages:
    """Collects seconds and peak memory of named stages."""

    def __init__(self):
        self.seconds: dict[str, float] = {}
        self.peak: dict[str, float] = {}

    def run(self, name, function):
        """Call the function, note its time and its peak memory under the name, return its result."""
        gc.collect()
        before = _memory(reset=True)
        start = time.perf_counter()
        result = function()
        self.seconds[name] = time.perf_counter() - start
        self.peak[name] = max(0.0, _memory() - before)
        return result

    def add(self, name, *parts):
        """A stage that is the sum of others; its peak is the largest of theirs."""
        self.seconds[name] = sum(self.seconds[part] for part in parts)
        self.peak[name] = max(self.peak[part] for part in parts)


def _memory(reset: bool = False) -> float:
    """Resident memory in MB: now when ``reset``, else the peak since then. Linux only, elsewhere nan."""
    try:
        if reset:
            Path("/proc/self/clear_refs").write_text("5")
        name = "VmRSS:" if reset else "VmHWM:"
        for line in Path("/proc/self/status").read_text().splitlines():
            if line.startswith(name):
                return int(line.split()[1]) / 1024
    except OSError:
        pass
    return float("nan")


def measure_solid(points: np.ndarray) -> Stages:
    """The stages in 3D: samples of the bumpy sphere."""
    from inputs import bumpy_inside
    from scipy.spatial import Delaunay

    import polyskel_lite as psl

    stages = Stages()
    stages.run("scipy", lambda: Delaunay(points))
    t = stages.run("delaunay", lambda: psl.delaunay(points))
    stages.run("balls", lambda: t.circumcenters)
    P = psl.DelaunayShape(t, bumpy_inside(t))
    stages.run("facets", lambda: t.facet_table)
    stages.run("sk0", lambda: psl.sk0(P))
    surface = stages.run("surface", lambda: psl.hierarchy(P, "surface"))
    wireframe = stages.run("wireframe", lambda: psl.hierarchy(P, "wireframe"))
    stages.run("surface skeleton", lambda: surface.skeleton(np.pi / 3))
    stages.run("wireframe skeleton", lambda: wireframe.skeleton(2 * np.pi))
    stages.run("branches", lambda: wireframe.branches(2 * np.pi))
    stages.add("whole", "delaunay", "balls", "facets", "surface", "wireframe")
    return stages


def measure_region(points: np.ndarray, facets: np.ndarray, conform: bool = False) -> Stages:
    """The stages in 2D: a closed curve, whose samples may need more between them."""
    from scipy.spatial import Delaunay

    import polyskel_lite as psl
    from polyskel_lite.shapes import shape as shapes

    stages = Stages()
    stages.run("scipy", lambda: Delaunay(points))
    t = stages.run("delaunay", lambda: psl.delaunay(points, facets))
    with patch.object(shapes, "delaunay", lambda *_: t):  # what is left: that nothing crosses
        shape = stages.run("shape", lambda: psl.Shape(points, facets))
        given = shape.tessellation
    if conform:
        shape = stages.run("conform", lambda: psl.conform(shape))
        t = shape.tessellation
    else:
        assert given is t
    P = stages.run("facets", lambda: psl.delaunay_shape(shape))  # and labels
    stages.run("balls", lambda: t.circumcenters)
    stages.run("sk0", lambda: psl.sk0(P))
    h = stages.run("branch", lambda: psl.hierarchy(P, "branch"))
    stages.run("branch skeleton", lambda: h.skeleton(2 * np.pi))
    stages.run("branches", lambda: h.branches(2 * np.pi))
    parts = ("delaunay", "shape", *(["conform"] if conform else []), "facets", "balls", "branch")
    stages.add("whole", *parts)
    return stages


def measure_paper(name: str) -> Stages:
    """From a stored solid to its wireframe skeleton, with everything that is checked on the way."""
    from scipy.spatial import Delaunay

    import polyskel_lite as psl

    stages = Stages()
    points = psl.datasets.load(name).points
    stages.run("scipy", lambda: Delaunay(points))
    stages.run(
        "load to wireframe",
        lambda: psl.hierarchy(psl.datasets.load(name), "wireframe").skeleton(2 * np.pi),
    )
    return stages


def measure(name: str, n: int, numba: bool, repeats: int = REPEATS) -> list[dict]:
    """Rows of the table for one input and size: the medians over the repeats."""
    import inputs

    if name in PAPER:
        one = partial(measure_paper, name)
    elif name == "bumpy sphere":
        one = partial(measure_solid, inputs.bumpy_samples(n))
    elif name == "curve at random":
        one = partial(measure_region, *inputs.random_curve(n), conform=True)
    else:
        shape = (inputs.lobed_curve if name == "curve" else inputs.outline)(n)
        one = partial(measure_region, shape.points, shape.facets)
    # What is compiled is loaded, and what is imported late is there, before anything is measured.
    _warm(name, numba)
    runs = [one() for _ in range(repeats)]
    rows = []
    for stage in runs[0].seconds:
        seconds = np.median([run.seconds[stage] for run in runs])
        ratio = np.median([run.seconds[stage] / run.seconds["scipy"] for run in runs])
        peak = np.median([run.peak[stage] for run in runs])
        values = (
            name,
            n,
            int(numba),
            stage,
            f"{seconds:.4f}",
            f"{ratio:.4f}",
            f"{peak:.0f}",
            repeats,
            _load(),
        )
        rows.append(dict(zip(COLUMNS, values, strict=True)))
    return rows


def _warm(name: str, numba: bool) -> None:
    """First calls at a small size; with numba so large that the loops are compiled."""
    import inputs

    n = 2_500 if numba else 200
    if name in PAPER:
        measure_paper(name)
    elif name == "bumpy sphere":
        measure_solid(inputs.bumpy_samples(n))
    else:
        measure_region(*inputs.random_curve(n), conform=True)


def _load() -> str:
    return f"{os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""


def in_subprocess(name: str, n: int, numba: bool, repeats: int, **environment: str) -> list[dict]:
    """`measure` in a process of its own, so that one measurement leaves nothing behind for the next."""
    command = [sys.executable, __file__, "--one", name, str(n), str(int(numba)), "--repeats", str(repeats)]
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, env=os.environ | environment)
    return json.loads(done.stdout)


def with_memory(name: str, n: int, numba: bool, repeats: int) -> list[dict]:
    """Times from one process, peaks of memory from another one (with numba only)."""
    rows = in_subprocess(name, n, numba, repeats)
    # Every freed array goes back to the system (glibc), so that each stage's own peak is seen.
    peaks = in_subprocess(name, n, numba, 1, MALLOC_MMAP_THRESHOLD_="65536") if numba else []
    peak = {row["stage"]: row["peak_mb"] for row in peaks}
    return [row | {"peak_mb": peak.get(row["stage"], "")} for row in rows]


def main(arguments=None) -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--largest", type=int, default=200_000, help="leave out larger sizes")
    parser.add_argument("--repeats", type=int, default=REPEATS)
    parser.add_argument("--out", type=Path, default=HERE, help="folder of results.csv and machine.json")
    parser.add_argument("--one", nargs=3, metavar=("INPUT", "N", "NUMBA"), help="one measurement, as JSON")
    options = parser.parse_args(arguments)
    if options.one:
        name, n, numba = options.one[0], int(options.one[1]), options.one[2] == "1"
        if not numba:
            sys.modules["numba"] = None  # importing it fails, as where it is not installed
        print(json.dumps(measure(name, n, numba, options.repeats)))
        return
    from machine import commit, note

    import polyskel_lite as psl

    rows, measured = [], commit(HERE)
    sizes_of = SIZES | {name: (len(psl.datasets.load(name).points),) for name in PAPER}
    options.out.mkdir(parents=True, exist_ok=True)
    for name, sizes in sizes_of.items():
        for n in (size for size in sizes if size <= options.largest):
            for numba in (True, False):
                once = n >= LARGE and not numba
                rows += with_memory(name, n, numba, 1 if once else options.repeats)
                print(f"{name}, n = {n:,}, {'with' if numba else 'without'} numba", flush=True)
        write(options.out / "results.csv", rows)
    note(options.out, "results.csv", measured)


def write(path: Path, rows: list[dict]) -> None:
    """Write what has been measured so far."""
    write_table(path, rows, COLUMNS)


if __name__ == "__main__":
    main()
