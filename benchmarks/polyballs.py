"""Skeletons of polyballs: seconds, as a ratio to `scipy.spatial.Delaunay` on the centres, and truth.

    python benchmarks/polyballs.py                  # writes polyballs.csv and polyball_checks.csv
    python benchmarks/polyballs.py --largest 1000 --out somewhere

Times are medians of three runs, Delaunay and skeleton in turn. The checks are those of
`tests/polyballs/test_polyball_skeletons.py` with their numbers (`tests/truth/cases.py`): maximal balls grown
by brute force in the random polyballs of `tests/truth/polyballs.py`, and points sampled on the skeletons.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np
from scipy.spatial import Delaunay
from tables import write_table

import polyskel_lite as psl

HERE = Path(__file__).resolve().parent
SIZES = (100, 1_000, 10_000)
REPEATS = 3
TIMES = ("balls", "dimension", "n", "delaunay_seconds", "skeleton_seconds", "ratio", "vertices", "polygons")
CHECKS = (
    "dimension",
    "polyballs",
    "medial_points",
    "missed",
    "missed_by_lenses",
    "polyballs_wrong_by_lenses",
    "skeleton_points",
    "not_medial",
    "left_out",
    "largest_gap",
    "betti_compared",
    "betti_wrong",
)


def scattered(n: int, N: int) -> tuple[np.ndarray, np.ndarray]:
    """Balls anywhere in a box, each meeting some others."""
    rng = np.random.default_rng([n, N])
    return rng.random((n, N)), rng.uniform(0.4, 0.8, n) * n ** (-1 / N)


def chain(n: int, N: int) -> tuple[np.ndarray, np.ndarray]:
    """Balls along a random walk that keeps its direction for a while, as in a long molecule."""
    rng = np.random.default_rng([n, N])
    steps = rng.standard_normal((n, N))
    for i in range(1, n):
        steps[i] = 0.9 * steps[i - 1] / np.linalg.norm(steps[i - 1]) + 0.4 * steps[i]
    steps /= np.linalg.norm(steps, axis=1)[:, None]
    return np.cumsum(steps, axis=0), rng.uniform(0.8, 1.2, n)


INPUTS = {"scattered": scattered, "chain": chain}


def seconds(function) -> tuple[float, object]:
    start = time.perf_counter()
    result = function()
    return time.perf_counter() - start, result


def timed(name: str, n: int, N: int) -> dict:
    """One row of times."""
    centers, radii = INPUTS[name](n, N)
    rows = []
    for _ in range(REPEATS):
        floor, _ = seconds(lambda: Delaunay(centers))
        cost, skeleton = seconds(lambda: psl.Polyball(centers, radii).skeleton())
        rows.append((floor, cost, cost / floor))
    floor, cost, ratio = np.median(rows, axis=0)
    values = (name, N, n, f"{floor:.4f}", f"{cost:.4f}", f"{ratio:.1f}")
    return dict(zip(TIMES, (*values, len(skeleton.vertices), len(skeleton.polygons)), strict=True))


def checked(N: int, polyballs: int) -> dict:
    """One row of checks: random polyballs against the brute-force truth."""
    sys.path.insert(0, str(HERE.parent / "tests"))
    from truth.cases import BLUNT, TOLERANCE, away, case, samples_of

    counts = dict.fromkeys(CHECKS, 0) | {"dimension": N, "polyballs": polyballs}
    for number in range(polyballs):
        x = case(number, N)
        m, _, error = x.truth.medial_points(np.random.default_rng(number))
        sharp, allowed = error <= BLUNT * x.size, TOLERANCE * x.size + 10 * error
        gap = away(m, x.skeleton)
        lenses = sharp & (away(m, x.Y.skeleton(statement="transcript")) > 1e-6 * x.size)
        counts["medial_points"] += int(sharp.sum())
        counts["missed"] += int((sharp & (gap > allowed)).sum())
        clear = error <= 1e-10 * x.size  # what is left is the library's own error
        counts["largest_gap"] = max(counts["largest_gap"], gap[clear].max(initial=0) / x.size)
        counts["missed_by_lenses"] += int(lenses.sum())
        counts["polyballs_wrong_by_lenses"] += bool(lenses.any())
        growth, blur = x.truth.growth(samples_of(x.skeleton, x.rng))
        clear = blur <= BLUNT * x.size
        counts["skeleton_points"] += int(clear.sum())
        counts["not_medial"] += int((clear & (growth > TOLERANCE * x.size + 10 * blur)).sum())
        counts["left_out"] += int((~sharp).sum() + (~clear).sum())
        betti = x.truth.robust_betti()
        counts["betti_compared"] += betti is not None
        counts["betti_wrong"] += betti is not None and betti != x.skeleton.betti()
    return counts | {"largest_gap": f"{counts['largest_gap']:.1e}"}


def main(arguments=None) -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--largest", type=int, default=SIZES[-1], help="leave out larger sizes")
    parser.add_argument("--polyballs", type=int, default=440, help="polyballs checked in each dimension")
    parser.add_argument("--out", type=Path, default=HERE, help="folder of the two tables")
    options = parser.parse_args(arguments)
    options.out.mkdir(parents=True, exist_ok=True)
    sizes = [n for n in SIZES if n <= options.largest]
    rows = []
    for name in INPUTS:
        for N in (2, 3):
            for n in sizes:
                rows.append(timed(name, n, N))
                print(*rows[-1].values(), flush=True)
    write_table(options.out / "polyballs.csv", rows, TIMES)
    checks = [checked(N, options.polyballs) for N in (2, 3)] if options.polyballs else []
    for row in checks:
        print(row)
    write_table(options.out / "polyball_checks.csv", checks, CHECKS)


if __name__ == "__main__":
    main()
