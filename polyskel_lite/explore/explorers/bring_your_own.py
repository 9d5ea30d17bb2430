"""Bring your own shape: from a file to its skeleton, a table of its branches, and files to take away."""

from __future__ import annotations

import html
import tempfile
from base64 import b64encode
from collections.abc import Callable
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import ipywidgets
import numpy as np

from ...errors import InputError, PolyskelError
from ...pipeline import Bones, refined_bones
from ...shapes import Shape
from ...simplification import STRATEGIES, Hierarchy
from ...skeletons import branch_rows
from ..skeleton_viewer import SkeletonViewer, viewer
from .explorer import NEEDS_KERNEL, WithStandIn
from .results import branch_table, result_files

#: What the file button offers; a path may have any suffix that `Shape.from_file` reads.
SUFFIXES = (".png", ".jpg", ".jpeg", ".svg", ".geojson", ".json", ".stl", ".ply", ".obj", ".off", ".npz")
#: Notebook servers cut the connection at messages of 10 megabytes; files by path have no such limit.
MOST_BYTES = 8_000_000
#: Vertices, in the plane and in space: more take more than seconds, and are for a script.
MOST_VERTICES = {2: 20_000, 3: 20_000}
#: Shapes of more vertices take some seconds: it is said before.
MANY_VERTICES = {2: 4_000, 3: 1_000}
#: Where the slider stands at first, in radians: noise is gone, what a reader would call a branch is there.
FIRST_THRESHOLD = {2: np.pi, 3: np.pi / 3}

LOOK_FOR = (
    "Choose a file, then move the threshold until only the branches are left that you would draw by hand. "
    "Look at the Betti numbers: one component, no hole? What is not in the file cannot be in the skeleton."
)
_LIMITS = (
    f"Files of up to {MOST_BYTES // 1_000_000} megabytes: a silhouette (PNG, JPEG), an outline (SVG, "
    "GeoJSON) or a closed triangle mesh (STL, PLY, OBJ, OFF). Larger files can be opened by their path: "
    f'explore("shape.stl"). Shapes may have up to {MOST_VERTICES[2]:,} vertices.'
)


@dataclass(frozen=True, eq=False)
class Chain:
    """A shape on its way to its skeleton; made by `chain`.

    Attributes
    ----------
    name : str
    given, refined : Shape
        As it came, and with samples where it is narrow, its boundary in the Gabriel graph (3D: in Del(E)).
    hierarchies : tuple of Hierarchy
        One in the plane; in space those of the strategies "surface" and "wireframe".
    bones : list of Bones
        What `polyskel_lite.skeleton` finds, by the same strategies.
    """

    name: str
    bones: list[Bones]

    @property
    def given(self) -> Shape:
        return self.bones[0].given

    @property
    def refined(self) -> Shape:
        return self.bones[0].refined

    @property
    def hierarchies(self) -> tuple[Hierarchy, ...]:
        return tuple(bones.hierarchy for bones in self.bones)


def chain(source: Shape | str | PathLike, say: Callable[[str], None] | None = None, **options) -> Chain:
    """Go the whole way: load, densify, refine, Delaunay shape, hierarchy (sections 3.4, 3.5 and 4).

    Parameters
    ----------
    source : Shape or path
    say : callable, optional
        Told of a shape that takes some seconds, in a sentence.
    **options
        For files: those of `polyskel_lite.files.read_file`, such as ``smooth`` or ``invert``.

    Returns
    -------
    Chain

    Raises
    ------
    PolyskelError
        The sentence of the step that refuses: a file that cannot be read, a boundary that crosses itself, ...
    InputError
        If the shape has too many vertices for an interactive picture.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> way = chain(psl.datasets.load("gear"))
    >>> len(way.given.points), len(way.refined.points), way.hierarchies[0].strategy
    (500, 2267, 'branch')
    """
    if isinstance(source, Shape):
        shape, name = source, "shape"
    elif isinstance(source, str | PathLike):
        shape, name = Shape.from_file(source, **options), Path(source).stem
    else:
        raise InputError(f"cannot explore {type(source).__name__}; pass a Shape, or the path of a file.")
    count, most = len(shape.points), MOST_VERTICES[shape.dimension]
    if count > most:
        advice = "Take resample(n) of it" if shape.dimension == 2 else "Make the mesh coarser"
        raise InputError(
            f"{name} has {count:,} vertices; up to {most:,} are quick enough to explore. {advice}, or use "
            "polyskel_lite.hierarchy in a script, which has no limit."
        )
    if say is not None and count > MANY_VERTICES[shape.dimension]:
        say(f"{name}: {count:,} vertices. Samples are added where it is narrow; this takes some seconds.")
    return Chain(name, refined_bones(shape, STRATEGIES[shape.dimension]))


def chain_text(way: Chain) -> str:
    """What was read and how it was refined, as a sentence.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> text = chain_text(chain(psl.Shape.from_rings([[(0, 0), (4, 0), (4, 2), (0, 2)]])))
    >>> print(text.replace(". ", ".\\n"))
    shape: 4 vertices, Betti numbers (1, 0).
    300 more make it dense enough and put its boundary into the Gabriel graph.
    No ball is more than 1.008 times as large as the room around its centre.
    """
    given, added = way.given, len(way.refined.points) - len(way.given.points)
    graph = "Gabriel graph" if given.dimension == 2 else "Delaunay tessellation"
    if added:
        why = "make it dense enough and put" if way.bones[0].densified else "put"
        refined = f"{added} more {why} its boundary into the {graph}."
    elif way.refined is given:
        refined = f"Its boundary is in the {graph} as it is."
    else:
        refined = f"Other edges put its boundary into the {graph}."
    worst = max(way.bones, key=lambda bones: bones.quality.ratio)
    told = worst.warning()
    told = (
        f"But {told}"
        if told
        else (f"No ball is more than {worst.quality.ratio:.3f} times as large as the room around its centre.")
    )
    return f"{way.name}: {len(given.points)} vertices, Betti numbers {given.betti()}. {refined} {told}"


class Explore(WithStandIn):
    """The widget that `explore` returns.

    Attributes
    ----------
    chain : Chain or None
        What is shown: shape, refined shape, hierarchies.
    error : PolyskelError or None
        Why the last file was refused; its sentence is shown.
    picture : SkeletonViewer or None
        Its ``threshold`` and ``strategy`` are those of table and files.
    """

    look_for = LOOK_FOR

    def __init__(self, source: Shape | str | PathLike | None = None, **options):
        self.chain: Chain | None = None
        self.error: PolyskelError | None = None
        self.picture: SkeletonViewer | None = None
        wide = {"style": {"description_width": "initial"}}
        self.upload = ipywidgets.FileUpload(
            accept=",".join(SUFFIXES), multiple=False, description="choose a file", layout={"width": "12em"}
        )
        self.smooth = ipywidgets.Dropdown(
            options=[0, 0.5, 1, 2, 3, 5], value=1, description="smoothing of pictures (pixels)", **wide
        )
        self.invert = ipywidgets.Checkbox(
            False, description="the bright part of a picture is the shape", **wide
        )
        self.turn = ipywidgets.Checkbox(False, description="turn meshes that are inside out", **wide)
        self.make = ipywidgets.Button(
            description="make files to download", tooltip="For the threshold chosen", layout={"width": "auto"}
        )
        self.write = ipywidgets.Button(
            description="write files beside the notebook", tooltip="The same files", layout={"width": "auto"}
        )
        self._status, self._table, self._links = (ipywidgets.HTML() for _ in range(3))
        self._place = ipywidgets.VBox()
        self._last: tuple[str, bytes] | None = None
        self.upload.observe(self._uploaded, "value")
        for option in (self.smooth, self.invert, self.turn):
            option.observe(lambda _: self._again(), "value")
        self.make.on_click(lambda _: self._offer())
        self.write.on_click(lambda _: self._write())
        hint = ipywidgets.HTML(f"<p>{html.escape(LOOK_FOR)}</p><p>{html.escape(_LIMITS)}</p>")
        row = {"flex_flow": "row wrap"}
        files = ipywidgets.HBox([self.upload, self.smooth, self.invert, self.turn], layout=row)
        buttons = ipywidgets.HBox([self.make, self.write], layout=row)
        super().__init__([hint, files, self._status, self._place])
        self._results = ipywidgets.VBox([buttons, self._links, self._table])
        if source is not None:
            self.load(source, **options)

    def load(self, source: Shape | str | PathLike, **options) -> None:
        """Show another shape or file; a refusal of the library is shown as its sentence.

        Examples
        --------
        >>> own = explore()
        >>> own.load("nowhere.png")
        >>> print(own.error)
        nowhere.png: there is no such file; check the path 'nowhere.png'.
        """
        self.chain, self.error, self.picture = None, None, None
        self._links.value, self._place.children = "", ()  # no picture of the last shape under the next name
        try:
            way = self.chain = chain(source, self._say, **options)
        except PolyskelError as error:
            self.error = error
            self._say(str(error), alert=True)
            return
        self.picture = viewer(
            list(way.hierarchies),
            threshold=FIRST_THRESHOLD[way.given.dimension],
            alt=f"The shape {way.name} and its skeleton, simplified at a threshold that you choose.",
        )
        self.picture.observe(lambda _: self.update(), ["threshold", "strategy"])
        self.update()
        self._place.children = (self.picture, self._results)
        self._say(chain_text(way))

    @property
    def hierarchy(self) -> Hierarchy | None:
        """That of the strategy chosen in the picture."""
        if self.chain is None:
            return None
        return next(h for h in self.chain.hierarchies if h.strategy == self.picture.strategy)

    def files(self) -> dict[str, bytes]:
        """The files of the results at the threshold chosen, by name.

        Examples
        --------
        >>> import polyskel_lite as psl
        >>> sorted(explore(psl.datasets.load("gear")).files())
        ['shape-branches.csv', 'shape-skeleton.npz', 'shape.svg']
        """
        if self.chain is None:
            raise InputError("there is no shape yet; choose a file, or call load(shape).")
        return result_files(self.hierarchy, self.picture.threshold, self.chain.name)

    def save(self, folder: str | PathLike = ".") -> list[Path]:
        """Write `files` into a folder.

        Returns
        -------
        list of Path
        """
        files = {Path(folder) / name: content for name, content in self.files().items()}
        for path, content in files.items():
            path.write_bytes(content)
        return list(files)

    def stand_in(self) -> str:
        """HTML of the picture, the sentences and the table for a page without a kernel."""
        results = self.picture.to_html() + self._table.value if self.picture else ""
        return f"<p>{html.escape(LOOK_FOR)}</p>{self._status.value}{results}<p><em>{NEEDS_KERNEL}</em></p>"

    def _uploaded(self, change) -> None:
        if change["new"]:
            upload = change["new"][0]
            self._last = upload["name"], bytes(upload["content"])
            self._again()

    def _again(self) -> None:
        """Read the uploaded file, the first time or with other options."""
        if self._last is None:
            return
        name, content = self._last
        if len(content) > MOST_BYTES:
            self._say(f"{name} has {len(content) / 1e6:.1f} megabytes. {_LIMITS}", alert=True)
            return
        options = {"smooth": self.smooth.value, "invert": self.invert.value, "turn": self.turn.value}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / Path(name).name  # no way out of the folder
            path.write_bytes(content)
            self.load(path, **options)

    def update(self) -> None:
        """Write the table for the threshold and the strategy chosen."""
        h, threshold = self.hierarchy, self.picture.threshold
        caption = f"Branches at the threshold {threshold / np.pi:.3g} π, the longest first"
        self._table.value = branch_table(branch_rows(h.skeleton(threshold)), caption)
        self._links.value = ""  # the files were for another threshold

    def _offer(self) -> None:
        links = [
            f'<li><a download="{html.escape(name)}" href="data:application/octet-stream;base64,'
            f'{b64encode(content).decode()}">{html.escape(name)}</a> ({len(content) / 1000:.0f} kB)</li>'
            for name, content in self.files().items()
        ]
        self._links.value = f"<p>Files at the threshold chosen:</p><ul>{''.join(links)}</ul>"

    def _write(self) -> None:
        try:
            names = ", ".join(path.name for path in self.save())
            self._links.value = f'<p role="status">Written: {html.escape(names)}</p>'
        except (OSError, PolyskelError) as error:  # a folder that may not be written to
            self._links.value = f'<p role="alert">Not written: {html.escape(str(error))}</p>'

    def _say(self, sentence: str, alert: bool = False) -> None:
        self._status.value = f'<p role="{"alert" if alert else "status"}">{html.escape(sentence)}</p>'


def explore(shape_or_path: Shape | str | PathLike | None = None, **options) -> Explore:
    """Explore a shape of your own: from a file button, a path or a `Shape` to skeleton, table and files.

    Parameters
    ----------
    shape_or_path : Shape or path, optional
        Without it the widget waits for a file. PNG and other pictures, SVG, GeoJSON, STL, PLY, OBJ, OFF.
    **options
        For a path: those of `polyskel_lite.files.read_file`.

    Returns
    -------
    Explore
        A widget for JupyterLab. ``.chain``, ``.hierarchy`` and ``.files()`` hold the results; ``.error`` is
        why a file was refused, and its sentence is shown instead of a traceback.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> own = explore(psl.datasets.load("hawaii"))
    >>> own.picture.threshold = 2 * np.pi
    >>> len(own.files())
    3
    """
    return Explore(shape_or_path, **options)
