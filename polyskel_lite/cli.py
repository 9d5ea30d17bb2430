"""The command line: ``polyskel-lite skeleton FILE``, ``info``, ``explore`` and ``figures``."""

from __future__ import annotations

import argparse
import json
import sys
import warnings
import webbrowser
from pathlib import Path
from typing import Any

from .errors import PolyskelError
from .pipeline import THRESHOLDS, Bones, skeleton
from .shapes import Shape

_EXAMPLES = """examples:
  polyskel-lite info bunny.ply
  polyskel-lite skeleton leaf.svg --threshold 3 --out leaf.geojson --out leaf.csv
  polyskel-lite skeleton scan.stl --mend --strategy wireframe --json
  polyskel-lite explore lake.geojson --out lake.html

exit codes: 0 done, 1 the file is refused (one sentence on stderr says why), 2 wrong usage"""


def main(arguments: list[str] | None = None) -> int:
    """Run a command.

    Parameters
    ----------
    arguments : list of str, optional
        The command line, by default that of the process.

    Returns
    -------
    int
        0, or 1 with one sentence on stderr if the file is refused. Wrong usage exits with 2.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from polyskel_lite import Shape
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = str(pathlib.Path(folder) / "bar.geojson")
    ...     Shape.from_rings([[(0, 0), (20, 0), (20, 4), (0, 4)]]).to_file(file)
    ...     main(["info", file])
    bar.geojson: Shape(2D, 4 points, 4 segments, (0, 0) to (20, 4), Betti (1, 0))
    area 80, boundary 48
    greatest disc: radius 2 at (10, 2)
    0
    """
    options = _parser().parse_args(arguments)
    try:
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always", UserWarning)
            options.run(options)
    except (PolyskelError, ImportError) as error:  # of explore, where ipywidgets is missing
        print(f"polyskel-lite: {error}", file=sys.stderr)
        return 1
    for warning in told:
        print(f"polyskel-lite: {warning.message}", file=sys.stderr)
    return 0


def _parser() -> argparse.ArgumentParser:
    raw: dict[str, Any] = {"formatter_class": argparse.RawDescriptionHelpFormatter, "epilog": _EXAMPLES}
    parser = argparse.ArgumentParser("polyskel-lite", description="Continuous skeletons of shapes.", **raw)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    def command(run, name: str, about: str) -> argparse.ArgumentParser:
        new = commands.add_parser(name, help=about, description=about, **raw)
        new.set_defaults(run=run)
        return new

    of_file = "GeoJSON, SVG, a picture, STL, PLY, OBJ, OFF"
    info = command(_info, "info", "Say what is in a file.")
    bones = command(_skeleton, "skeleton", "Compute a simplified skeleton and its branches.")
    explore = command(_explore, "explore", "Write a page with the skeleton to turn and filter, and open it.")
    for each in (info, bones, explore):
        each.add_argument("file", help=of_file)
        each.add_argument("--mend", action="store_true", help="mend what would be refused")
    for each in (bones, explore):
        each.add_argument("--strategy", choices=THRESHOLDS, help="branch in 2D; surface or wireframe in 3D")
        each.add_argument("--threshold", type=float, help="an angle in radians; more removes more")
        each.add_argument("--spacing", type=float, help="put samples no farther apart than this length")
    for each in (info, bones):
        each.add_argument("--json", action="store_true", help="print JSON")
    bones.add_argument(
        "--out",
        action="append",
        default=[],
        help="write the skeleton (.geojson, .wkt, .svg, .ply, .obj, .glb, .vtk, .vtu, .npz) or its branches "
        "(.csv); may be repeated",
    )
    explore.add_argument("--out", help="the page, by default FILE.html in the present folder")
    explore.add_argument("--no-open", action="store_true", help="do not open it")
    figures = command(_figures, "figures", "Write the paper's figures.")
    figures.add_argument("folder", help="where to; made if it is not there")
    figures.add_argument("names", nargs="*", help="which ones, such as figure_8 (default: all)")
    return parser


def _read(options) -> Shape:
    _say(f"reading {options.file}")
    return Shape.from_file(options.file, mend=options.mend)


def _bones(options) -> Bones:
    shape = _read(options)
    _say("computing the skeleton")
    dense = shape if options.spacing is None else shape.densify(options.spacing)
    return skeleton(dense, options.threshold, options.strategy, densify=options.spacing is None)


def _say(step: str) -> None:
    if sys.stderr.isatty():
        print(f"{step} ...", file=sys.stderr, flush=True)


def _info(options) -> None:
    shape = _read(options)
    measure, round_one = ("area", "disc") if shape.dimension == 2 else ("volume", "ball")
    ball = shape.largest_ball()
    if options.json:
        facts = {
            "dimension": shape.dimension,
            "points": len(shape.points),
            "facets": len(shape.facets),
            "bounds": [shape.points.min(axis=0).tolist(), shape.points.max(axis=0).tolist()],
            "betti": list(shape.betti()),
            measure: shape.measure(),
            "boundary": shape.boundary_measure(),
            f"greatest_{round_one}": {"center": ball.center.tolist(), "radius": ball.radius},
        }
        print(json.dumps(facts))
        return
    center = ", ".join(f"{x:.6g}" for x in ball.center)
    print(f"{Path(options.file).name}: {shape}")
    print(f"{measure} {shape.measure():.6g}, boundary {shape.boundary_measure():.6g}")
    print(f"greatest {round_one}: radius {ball.radius:.6g} at ({center})")


def _skeleton(options) -> None:
    bones = _bones(options)
    found, rows = bones.skeleton, bones.branches
    for path in options.out:
        write: Any = {".csv": rows.to_csv, ".npz": found.save}.get(Path(path).suffix.lower(), found.to_file)
        write(path)
    axis = found.main_axis()
    if not options.json:
        print(found, f"main axis: {axis.smooth_length:.4g}", rows, sep="\n")
        return
    facts = {
        "strategy": bones.hierarchy.strategy,
        "threshold": bones.threshold,
        "vertices": len(found.vertices),
        "edges": len(found.edges),
        "polygons": len(found.polygons),
        "betti": list(found.betti()),
        "ratio": bones.quality.ratio,
        "main_axis": {"length": axis.smooth_length, "points": axis.points.tolist()},
        "branches": rows.records(),
        "written": options.out,
    }
    print(json.dumps(facts))


def _explore(options) -> None:
    from .explore import viewer

    page = Path(options.out or f"{Path(options.file).stem}.html")
    bones = _bones(options)
    viewer(bones.hierarchy, threshold=bones.threshold).save(page, title=Path(options.file).name)
    print(page)
    if not options.no_open:
        webbrowser.open(page.resolve().as_uri())


def _figures(options) -> None:
    from .figures.__main__ import main as write

    write([options.folder, *options.names])
