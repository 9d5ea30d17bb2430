"""Branch counts as a map: thresholds across, copies down."""

from __future__ import annotations

import numpy as np


def draw_branch_counts(ax, found, most: int | None = None):
    """Draw how many branches each copy has at each threshold; the number most often seen is bold.

    Parameters
    ----------
    ax : matplotlib axes
    found : BranchCounts
        From `polyskel_lite.branch_counts`.
    most : int, optional
        Counts above it have one colour; by default twice the number most often seen.

    Returns
    -------
    matplotlib axes

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> import polyskel_lite as psl
    >>> fig, ax = plt.subplots()
    >>> leaf = psl.datasets.load("hawaii", n=300)
    >>> ax = draw_branch_counts(ax, psl.branch_counts(leaf, thresholds=[2, 3, 4], copies=1))
    >>> ax.get_xlabel()
    'threshold / π'
    >>> plt.close(fig)
    """
    order = np.argsort(found.thresholds, kind="stable")
    counts = found.counts[:, order]
    values, times = np.unique(counts, return_counts=True)
    usual = int(values[times.argmax()])
    most = max(1, 2 * usual if most is None else most)
    t = found.thresholds[order] / np.pi
    ends = np.concatenate([[t[0]], (t[1:] + t[:-1]) / 2, [t[-1]]])
    if ends[0] == ends[-1]:  # one threshold, which has a width all the same
        ends = ends + np.linspace(-0.5, 0.5, len(ends))
    rows = np.arange(len(counts) + 1) - 0.5
    cells = np.minimum(counts, most)
    # As pixels: in line art hairlines of the ground would show between the cells.
    ax.pcolormesh(ends, rows, cells, cmap="cividis", vmin=0, vmax=most, rasterized=True)
    for y, row in enumerate(counts):
        # Each run of equal counts is told once, where it is wide enough for its number.
        starts = np.flatnonzero(np.diff(row, prepend=-1))
        for a, b in zip(starts, [*starts[1:], len(row)], strict=True):
            if ends[b] - ends[a] > 0.035 * len(str(row[a])) * (ends[-1] - ends[0]):
                color, weight = (
                    "k" if cells[y, a] > most / 2 else "w",
                    "bold" if row[a] == usual else "normal",
                )
                middle = (ends[a] + ends[b]) / 2
                ax.text(middle, y, row[a], ha="center", va="center", size=8, color=color, weight=weight)
    ax.set(xlabel="threshold / π", ylim=(len(counts) - 0.5, -0.5))
    ax.set_yticks(range(len(counts)), ["as it is", *map(str, range(1, len(counts)))])
    ax.set_ylabel("shaken copy")
    return ax
