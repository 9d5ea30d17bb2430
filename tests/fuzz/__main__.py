"""``make fuzz``: many cases of each family, and a report of what became of them."""

import argparse
import csv
import subprocess
import sys
import time
from pathlib import Path

from . import FAMILIES, TIMES
from .running import OUTCOMES, outcome, run_family

COLUMNS = ["family", "count", *OUTCOMES, "seconds", "slowest", "seed", "commit", "date"]
ROOT = Path(__file__).resolve().parents[2]


def main() -> int:
    parser = argparse.ArgumentParser(prog="fuzz", description=__doc__)
    parser.add_argument("families", nargs="*", default=[*FAMILIES], help=f"of {', '.join(FAMILIES)}")
    parser.add_argument("--count", type=int, default=10_000, help="cases of each family")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", type=int, help="run this one case again, here, and say what it is")
    parser.add_argument("--report", type=Path, help="a CSV file; rows of the families run are replaced")
    options = parser.parse_args()
    if options.only is not None:
        for family in options.families:
            print(family, *outcome(family, options.seed, options.only))
        return 0
    rows = []
    for family in options.families:
        count = options.count * TIMES.get(family, 1)
        tally = run_family(family, count, options.seed, progress=True)
        for number, what, words in tally.bad:
            print(f"  {family} {number} {what}: {words}", file=sys.stderr)
        rows.append(
            {"family": family, "count": count}
            | {name: tally.counts[name] for name in OUTCOMES}
            | {"seconds": round(tally.seconds), "slowest": round(tally.slowest, 1), "seed": options.seed}
            | {"commit": _commit(), "date": time.strftime("%Y-%m-%d")}
        )
        print(*(f"{name} {value}" for name, value in rows[-1].items()), sep=", ")
    if options.report:
        write(options.report, rows)
    return int(any(row[name] for row in rows for name in ("raw", "late", "wrong")))


def _commit() -> str:
    done = subprocess.run(
        ["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    return done.stdout.strip() or "unknown"


def write(path: Path, rows: list[dict]) -> None:
    """Put rows into a report, in place of those of the same families."""
    kept = []
    if path.exists():
        with path.open(newline="", encoding="utf-8") as stream:
            kept = [row for row in csv.DictReader(stream) if row["family"] not in {r["family"] for r in rows}]
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted([*kept, *rows], key=lambda row: row["family"]))


if __name__ == "__main__":
    sys.exit(main())
