"""How long an explorer needs in Python to follow one movement, for every explorer and outline of the book.

    python benchmarks/explorers.py            # every explorer on every outline of the book
    python benchmarks/explorers.py sampling   # those whose name begins so

A movement is one new place of a handle or value of a slider; the time is that of everything the kernel does:
the mathematics, the strings of the layers that changed, the messages (to nobody). A movement is followed when
this and the way through the browser take less than 100 ms together. The time on the clock is longer than the
time of the processor when the machine has other work: both are given, with the load.
"""

from __future__ import annotations

import csv
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import polyskel_lite as psl
from polyskel_lite import explore

MOVES = 30
#: Name, what makes the explorer for the name of an outline, what changes it for the k-th time. One line an
#: explorer and movement; a factory that does not care for outlines takes the name all the same.
CASES: list[tuple[str, Callable, Callable]] = []


def case(name: str, factory: Callable):
    """Add a movement of an explorer to the table."""

    def add(action: Callable) -> Callable:
        CASES.append((name, factory, action))
        return action

    return add


def outline(name: str) -> psl.Shape:
    """The outline with its stored samples."""
    return psl.datasets.load(name)


def on(**values) -> Callable:
    """Turns a maker of explorers into one that sets these controls at once."""

    def wrap(maker: Callable) -> Callable:
        def made(name: str):
            explorer = maker(name)
            with explorer.together():
                for key, value in values.items():
                    explorer.controls[key].value = value
            return explorer

        return made

    return wrap


def inner_place(explorer, k: int) -> np.ndarray:
    """To another place that is inside the shape: between a sample and the centre of a ball that it is on."""
    skeleton = psl.sk1(explorer.shape)
    j = 7 * k % len(skeleton.vertices)
    corner = skeleton.tessellation.simplices[skeleton.simplices[j], 0]
    return 0.6 * skeleton.vertices[j] + 0.4 * skeleton.tessellation.points[corner]


@case("maximal_ball, drag", on(trace=True, skeleton=True)(lambda name: explore.maximal_ball(outline(name))))
def _(explorer, k):
    explorer.board.handles = [inner_place(explorer, k)]


@case("sampling, n", lambda name: explore.sampling(outline(name)))
def _(explorer, k):
    explorer.controls["n"].value = 100 + 10 * k


@case(
    "sampling, noise with the polyball",
    on(n=400, polyball=True)(lambda name: explore.sampling(outline(name))),
)
def _(explorer, k):
    explorer.controls["noise"].value = 0.05 * (1 + k % 10)


@case("graphs, drag", lambda name: explore.graphs(outline(name).sample(30)))
def _(explorer, k):
    places = np.array(explorer.board.handles)
    places[0] = np.mean(places, axis=0) + 0.1 * np.array([np.cos(k), np.sin(k)])
    explorer.board.handles = places


@case("four_methods, n", lambda name: explore.four_methods(outline(name)))
def _(explorer, k):
    explorer.controls["n"].value = 100 + 10 * k


@case("refinement, step", lambda name: explore.refinement(outline(name).resample(100)))
def _(explorer, k):
    explorer.controls["step"].value = k % (explorer.controls["step"].max + 1)
    explorer.controls["balls"].value = k % 2 > 0  # some outlines need no step at all


@case("removals, step", lambda name: explore.removals(outline(name).resample(100)))
def _(explorer, k):
    explorer.controls["step"].value = 1 + k


@case(
    "thresholds, with the ways of the ends",
    on(ends="the way they have come")(lambda name: explore.thresholds(outline(name))),
)
def _(explorer, k):
    explorer.controls["threshold"].value = 0.1 * (1 + k)


@case("balls, drag (the same for all)", lambda name: explore.balls())
def _(explorer, k):
    places = np.array(explorer.board.handles)
    places[2] += 0.05 * np.array([np.cos(k), np.sin(k)])
    explorer.board.handles = places


@case("explore, table of branches", lambda name: explore.explore(outline(name)))
def _(explorer, k):
    explorer.picture.threshold = 0.3 * (1 + k)


def milliseconds(explorer, action: Callable) -> np.ndarray:
    """Clock and processor times of `MOVES` movements, (2, MOVES); only `Explorer.update` counts."""
    times, within = [], []
    update = explorer.update

    def timed():
        if within:  # a handle that the explorer itself moved while it draws
            return
        within.append(True)
        start = np.array([time.perf_counter(), time.process_time()])
        update()
        times.append(1e3 * (np.array([time.perf_counter(), time.process_time()]) - start))
        within.clear()

    explorer.update = timed
    for k in range(MOVES):
        action(explorer, k)
    return np.transpose(times)


def main(prefix: str = "") -> None:
    """Print the table: medians on the clock and, in brackets, of the processor."""
    names = psl.datasets.names()
    rows = [["explorer", *names, "slowest"]]
    print(f"{'ms, clock (processor)':36}" + "".join(f"{name:>12}" for name in names))
    slowest = np.zeros(2)
    for title, factory, action in CASES:
        if not title.startswith(prefix):
            continue
        cells, row, longest = [], [title], 0.0
        for name in names:
            times = milliseconds(factory(name), action)
            slowest = np.maximum(slowest, times.max(axis=1))
            cells.append("{:.0f} ({:.0f})".format(*np.median(times, axis=1)))
            row.append(f"{np.median(times[0]):.1f}")
            longest = max(longest, times[0].max())
        rows.append([*row, f"{longest:.0f}"])
        print(f"{title:36}" + "".join(f"{cell:>12}" for cell in cells), flush=True)
    load = f"; load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores" if hasattr(os, "getloadavg") else ""
    print("slowest movement: {:.0f} ms on the clock, {:.0f} ms of the processor{}".format(*slowest, load))
    if not prefix:
        path = Path(__file__).resolve().parent / "explorers.csv"
        with open(path, "w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main(*sys.argv[1:2])
