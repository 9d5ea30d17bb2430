"""Write the paper's figures to a folder: ``python -m polyskel_lite.figures FOLDER [NAME ...]``."""

from __future__ import annotations

import argparse
import logging
import time

import matplotlib


def main(arguments: list[str] | None = None) -> None:
    """Write figures as PDF, SVG and PNG in two widths, with a line of progress for each.

    Parameters
    ----------
    arguments : list of str, optional
        The command line, by default that of the process.

    Examples
    --------
    >>> import tempfile
    >>> from polyskel_lite.figures.__main__ import main
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     main([folder, "figure_2"])   # doctest: +ELLIPSIS
    [1/1] figure_2 ... s
    1 figures (PDF, SVG, PNG, two widths), captions.txt and manifest.json written to ...
    """
    matplotlib.use("Agg")  # files only: no window, no display needed
    logging.getLogger("fontTools").setLevel(logging.ERROR)  # it remarks on the date inside DejaVu's font file
    from . import FIGURES, write_figures

    parser = argparse.ArgumentParser(
        prog="python -m polyskel_lite.figures", description=__doc__.split(":")[0]
    )
    parser.add_argument("folder", help="where to write; made if it is not there")
    parser.add_argument("names", nargs="*", help=f"which figures (default: all): {', '.join(FIGURES)}")
    options = parser.parse_args(arguments)
    names = options.names or list(FIGURES)
    clock = time.perf_counter()
    for count, name in enumerate(write_figures(options.folder, names), start=1):
        print(f"[{count}/{len(names)}] {name}  {time.perf_counter() - clock:.1f} s", flush=True)
        clock = time.perf_counter()
    print(
        f"{len(names)} figures (PDF, SVG, PNG, two widths), captions.txt and manifest.json "
        f"written to {options.folder}"
    )


if __name__ == "__main__":
    main()
