"""Draw the picture of the README: a horse and what is left of its skeleton at three thresholds."""

from pathlib import Path

import numpy as np

import polyskel_lite as psl
from polyskel_lite import drawing

PLACE = Path(__file__).resolve().parent.parent / "notebooks" / "_static" / "horse.png"


def main() -> None:
    drawing.setup()
    h = psl.hierarchy(psl.conform(psl.datasets.load("horse", n=400)))
    fig, axs = drawing.axes(3, width=8, height=2.4)
    for ax, turns in zip(axs, (0, 1, 3), strict=True):
        drawing.draw_shape(ax, psl.datasets.load("horse"))
        drawing.draw_skeleton(ax, h.skeleton(turns * np.pi), "sk0")
        drawing.focus(ax, psl.datasets.load("horse"))
    fig.savefig(PLACE, dpi=110, facecolor="white", metadata={"Software": None})


if __name__ == "__main__":
    main()
