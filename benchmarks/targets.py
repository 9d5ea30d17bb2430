"""What was asked of this version: each work before and now, the first call and the later ones.

    python benchmarks/targets.py                       # writes targets.csv
    python benchmarks/targets.py --old ../old          # the state before as well, from a checkout of it
    python benchmarks/targets.py --only primitives conform

Every work runs in a process of its own. Its first call counts what a user waits for at first: loading, and
compiled code from numba's cache. Its second call is the median of five later ones (25 where they take less
than a twentieth of a second). A ratio is divided by `scipy.spatial.Delaunay` of the same points, in the same
process, a moment before. Without ``--old`` the numbers of the state before stay as the file has them.
"""

from __future__ import annotations

import argparse
import csv
import gc
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

HERE = Path(__file__).resolve().parent
# Later calls; five times as many below so many seconds; no further call after so many seconds in all.
REPEATS, QUICK, PATIENCE = 5, 0.05, 100
LIMIT = 900  # seconds for one work, then it is stopped
TRIES = ("first", "second")
COMPILE = -1  # in place of a work's number
COLUMNS = (
    *("key", "work", "input", "n", "unit", "before", "reach", "aim"),
    *(f"old_{name}" for name in (*TRIES, "load", "commit", "date")),
    *(*TRIES, "points", "simplices", "peak_mb", "repeats", "load", "commit", "date"),
)
PRIMITIVES = ("icosphere", "uv sphere", "torus", "box", "cylinder", "capsule")


class Target(NamedTuple):
    """A row of the table; ``before`` is what was measured when the targets were set."""

    key: str
    work: str
    input: str
    n: int
    unit: str
    before: str
    reach: float | None
    aim: float | None
    limit: float = LIMIT


def _targets() -> list[Target]:
    delaunay = "Delaunay with neighbours, exact"
    plane, space = "all of it", "all of it, both strategies"
    curves = ("curve", "outline")
    return [
        *(
            Target("delaunay", delaunay, name, n, "ratio", "1.2-1.6", 0.27, 0.18)
            for name, n in (
                ("curve", 200_000),
                ("curve at random", 200_000),
                ("square", 200_000),
                ("bumpy sphere", 100_000),
                ("cube", 100_000),
            )
        ),
        *(Target("whole 2D", plane, name, 200_000, "ratio", "1.55", 0.45, 0.35) for name in curves),
        Target("conform", f"{plane} with conform", "curve at random", 200_000, "ratio", "43", 0.6, 0.45),
        *(
            Target("whole 3D", space, "bumpy sphere", n, "ratio", "2.7-3.0", 0.95, 0.6)
            for n in (20_000, 100_000)
        ),
        *(Target("small", plane, name, 2_000, "ratio", "4.4-5.8", 2, 1) for name in curves),
        *(
            Target("primitives", "file to wireframe", name, 0, "seconds", "> 30", 1, None, 60)
            for name in PRIMITIVES
        ),
        Target("coast", "file to hierarchy", "coast", 50_000, "seconds", "34", 8, 4),
        Target("million", "all thresholds", "bumpy sphere", 1_000_000, "seconds", "not run", 60, 30),
        Target("plain", f"{space}, plain Python", "bumpy sphere", 2_000, "ratio", "", None, None),
    ]


TARGETS = _targets()


def material(name: str, n: int, folder: Path):
    """Points and facets (or none) of an input, or the path of its file."""
    import inputs

    random = np.random.default_rng(0)
    if name in PRIMITIVES:
        path = folder / f"{name}.off"
        inputs.write_off(path, *inputs.primitives()[name])
        return path, None
    if name == "coast":
        inputs.write_geojson(folder / "coast.geojson", inputs.coast(n))
        return folder / "coast.geojson", None
    if name in ("square", "cube"):
        return random.random((n, 2 if name == "square" else 3)), None
    if name == "bumpy sphere":
        return inputs.bumpy_samples(n), None
    if name == "curve at random":
        return inputs.random_curve(n)
    # A shape keeps what it knows: here are copies of its arrays only.
    shape = (inputs.lobed_curve if name == "curve" else inputs.outline)(n)
    return shape.points.copy(), shape.facets.copy()


def work(target: Target, data, facets) -> tuple[float, int, int]:
    """Do the work once: its seconds, the points and simplices in the end."""
    import polyskel_lite as psl

    start, pause = time.perf_counter(), 0.0
    if target.key == "delaunay":
        t = psl.delaunay(data)
    elif facets is not None:
        shape = psl.Shape(data, facets)
        P = psl.delaunay_shape(psl.conform(shape) if target.key == "conform" else shape)
        psl.hierarchy(P)
        t = P.tessellation
    elif isinstance(data, Path):
        P = psl.delaunay_shape(psl.conform(psl.Shape.from_file(data)))
        h = psl.hierarchy(P, "wireframe" if P.dimension == 3 else "branch")
        if P.dimension == 3:
            h.skeleton(2 * np.pi)
        t = P.tessellation
    else:
        t = psl.delaunay(data)
        centers = t.circumcenters
        begin = time.perf_counter()
        P = psl.DelaunayShape(t, _inside(centers))
        pause = time.perf_counter() - begin  # the labels come from the field: not part of the work
        for strategy in ("surface", "wireframe"):
            psl.hierarchy(P, strategy)
    return time.perf_counter() - start - pause, len(t.points), len(t.simplices)


def _inside(centers: np.ndarray) -> np.ndarray:
    from inputs import bumpy_radius

    centers = np.where(np.isfinite(centers), centers, 1e9)
    distance = np.sqrt((centers**2).sum(axis=1))
    return distance < bumpy_radius(centers / np.maximum(distance, 1e-12)[:, None])


def measure(target: Target, repeats: int = REPEATS) -> dict:
    """First and second call of one work, here."""
    from scipy.spatial import Delaunay

    begin = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        data, facets = material(target.input, target.n, Path(folder))
        times = []
        wanted = 1 + repeats
        while len(times) < wanted and time.perf_counter() - begin < PATIENCE:
            gc.collect()
            unit = 1.0
            if target.unit == "ratio":
                start = time.perf_counter()
                Delaunay(data)
                unit = time.perf_counter() - start
            seconds, points, simplices = work(target, data.copy() if facets is not None else data, facets)
            times.append(seconds / unit)
            if len(times) == 2 and seconds < QUICK:
                wanted = 1 + 5 * repeats
    later = times[1:]
    return {
        "first": f"{times[0]:.3g}",
        "second": f"{np.median(later):.3g}" if later else "",
        "points": points,
        "simplices": simplices,
        "peak_mb": _peak(),
        "repeats": len(later),
        "load": f"{os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "",
    }


def _peak() -> str:
    """Peak memory of this process in MB; Linux only."""
    try:
        lines = Path("/proc/self/status").read_text().splitlines()
    except OSError:
        return ""
    return next((f"{int(line.split()[1]) / 1024:.0f}" for line in lines if line.startswith("VmHWM:")), "")


def in_subprocess(number: int, target: Target, repeats: int, library: Path | None = None) -> dict:
    """`measure` in a process of its own, with this library or with that of another checkout."""
    path = str(library or HERE.parent)
    command = [sys.executable, __file__, "--one", str(number), "--repeats", str(repeats)]
    environment = os.environ | {"PYTHONPATH": path}
    try:
        done = subprocess.run(
            command, check=False, capture_output=True, text=True, timeout=target.limit, env=environment
        )
    except subprocess.TimeoutExpired:
        return dict.fromkeys(TRIES, f"> {target.limit:g}")
    if done.returncode:
        print(done.stderr, file=sys.stderr)
        return dict.fromkeys(TRIES, "failed")
    return json.loads(done.stdout.splitlines()[-1])


def compile_all() -> None:
    """Let numba compile what the works need into its cache: once on a machine, so not at a first call."""
    for target in TARGETS:
        if target.key in ("conform", "whole 3D"):
            measure(target._replace(n=2_500), repeats=1)


def stored(path: Path) -> dict[tuple, dict]:
    """The rows of a file by work, input and size."""
    if not path.exists():
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        return {(row["key"], row["input"], int(row["n"])): row for row in csv.DictReader(file)}


def write(path: Path, rows: dict[tuple, dict]) -> None:
    """Write what is known, in the order of the targets."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n", extrasaction="ignore")
        writer.writeheader()
        for target in TARGETS:
            if row := rows.get((target.key, target.input, target.n)):
                known = target._asdict()
                writer.writerow(
                    row | {name: "" if known[name] is None else known[name] for name in COLUMNS[:8]}
                )


def main(arguments=None) -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--old", type=Path, help="a checkout of the state before; measured side by side")
    parser.add_argument("--only", nargs="*", help="keys of works; the other rows stay as they are")
    parser.add_argument("--largest", type=int, default=1_000_000, help="leave out larger sizes")
    parser.add_argument("--repeats", type=int, default=REPEATS)
    parser.add_argument("--out", type=Path, default=HERE, help="folder of targets.csv and machine.json")
    parser.add_argument("--one", type=int, help="one measurement, as JSON")
    options = parser.parse_args(arguments)
    if options.one == COMPILE:
        compile_all()
        return
    if options.one is not None:
        target = TARGETS[options.one]
        if target.key == "plain":
            sys.modules["numba"] = None  # importing it fails, as where it is not installed
        print(json.dumps(measure(target, options.repeats)))
        return
    from machine import commit, note

    options.out.mkdir(parents=True, exist_ok=True)
    path = options.out / "targets.csv"
    rows = stored(path)
    for library in filter(None, (options.old, HERE.parent)):
        command = [sys.executable, __file__, "--one", str(COMPILE)]
        subprocess.run(command, check=True, env=os.environ | {"PYTHONPATH": str(library)})
    for number, target in enumerate(TARGETS):
        key = (target.key, target.input, target.n)
        if target.n > options.largest or (options.only and target.key not in options.only):
            continue
        row = rows.get(key, {})
        if options.old and target.before != "not run":
            found = in_subprocess(number, target, options.repeats, options.old)
            row |= {f"old_{name}": found.get(name, "") for name in (*TRIES, "load")}
            row |= {"old_commit": commit(options.old), "old_date": time.strftime("%Y-%m-%d")}
        row |= in_subprocess(number, target, options.repeats)
        rows[key] = row | {"commit": commit(HERE), "date": time.strftime("%Y-%m-%d")}
        write(path, rows)
        print(
            *key,
            *(f"{name} {row.get(name, '')}" for name in (*(f"old_{t}" for t in TRIES), *TRIES)),
            flush=True,
        )
    note(options.out, "targets.csv")


if __name__ == "__main__":
    main()
