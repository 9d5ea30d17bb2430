"""Every public function and method, called with one argument or two that it was not made for."""

from __future__ import annotations

import tempfile
from collections import OrderedDict
from collections.abc import Iterator
from decimal import Decimal
from fractions import Fraction
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import numpy as np

import polyskel_lite as psl

POINTS = [(0, 0), (4, 0), (4, 3), (0, 3), (1.5, 1)]
RINGS = [[(0, 0), (4, 0), (4, 3), (0, 3)]]
V, F = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 6)], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


@cache
def _things():
    """What methods are called on, made once."""
    plane, space = psl.Shape.from_rings(RINGS), psl.Shape.from_mesh(V, F)
    P = psl.delaunay_shape(psl.conform(plane))
    return {
        "plane": plane,
        "space": space,
        "P": P,
        "k": psl.sk0(P),
        "discs": psl.Polyball([(0, 0), (1, 0)], [1, 1]),
        "balls": psl.Polyball([(0, 0, 0), (1, 0, 0)], [1, 1]),
        "h": psl.hierarchy(P),
        "P3": psl.delaunay_shape(space),
    }


@cache
def calls() -> dict[str, tuple]:
    """Name: function and good arguments; each of these is replaced in turn."""
    t = _things()
    plane, space, P, k, discs, balls, h, _ = t.values()
    E, image = plane.points, np.pad(np.ones((4, 4)), 2)
    folder = Path(tempfile.mkdtemp(prefix="fuzz-"))
    k.save(folder / "k.npz")
    im = psl.implicit
    table = {
        "delaunay": (psl.delaunay, {"points": POINTS, "facets": [(0, 1)]}),
        "gabriel": (psl.gabriel, {"points_or_tessellation": POINTS, "closed": True}),
        "voronoi": (psl.voronoi, {"points_or_tessellation": POINTS}),
        "reconstruct_curve": (psl.reconstruct_curve, {"points": RINGS[0]}),
        "Shape": (psl.Shape, {"points": RINGS[0], "facets": [(0, 1), (1, 2), (2, 3), (3, 0)]}),
        "Shape.from_rings": (psl.Shape.from_rings, {"rings": RINGS, "mend": True}),
        "Shape.from_rings of one": (lambda ring: psl.Shape.from_rings([ring]), {"ring": RINGS[0]}),
        "Shape.from_mesh": (psl.Shape.from_mesh, {"V": V, "F": F, "turn": True, "mend": True}),
        "mend": (
            psl.mend,
            {"boundary": RINGS, "tolerance": 1e-6, "width": 1e-4, "largest": True, "least": 0.0},
        ),
        "mend a mesh": (
            lambda V, F, tolerance, least: psl.mend((V, F), tolerance=tolerance, least=least),
            {"V": V, "F": F, "tolerance": 1e-6, "least": 0.0},
        ),
        "Shape.from_mask": (psl.Shape.from_mask, {"image": image, "level": 0.5, "smooth": 0.0}),
        "Shape.from_file": (
            psl.Shape.from_file,
            {"path": folder / "k.npz", "tolerance": 1e-3, "level": 0.5, "smooth": 0.0, "invert": False}
            | {"stroke": False, "turn": False, "mend": False},
        ),
        "Shape.from_shapely": (psl.Shape.from_shapely, {"geometry": plane.__geo_interface__}),
        "Shape.from_trimesh": (psl.Shape.from_trimesh, {"mesh": SimpleNamespace(vertices=V, faces=F)}),
        "Shape.to_file": (space.to_file, {"path": folder / "a.stl"}),
        "Shape.contains": (plane.contains, {"queries": POINTS}),
        "Shape.locate": (space.locate, {"queries": V}),
        "Shape.boundary_distance": (plane.boundary_distance, {"queries": POINTS}),
        "Shape.covering_radius": (plane.covering_radius, {"E": E}),
        "Shape.sampling_density": (space.sampling_density, {"E": V}),
        "Shape.sample": (plane.sample, {"n": 12, "start": 0.5}),
        "Shape.resample": (plane.resample, {"n": 12, "start": 0.0}),
        "conform": (psl.conform, {"shape": plane, "to": "gabriel", "limit": 100}),
        "conform 3D": (psl.conform, {"shape": space, "to": "delaunay", "limit": 100}),
        "missing_facets": (
            psl.missing_facets,
            {"shape": plane, "of": "delaunay", "tessellation": psl.delaunay(E)},
        ),
        "delaunay_shape": (psl.delaunay_shape, {"shape": plane}),
        "delaunay_balls": (psl.delaunay_balls, {"shape": plane, "E": E}),
        "sk0": (psl.sk0, {"P": P, "side": "inner"}),
        "sk1": (psl.sk1, {"shape": plane, "E": E, "side": "inner"}),
        "sk2": (psl.sk2, {"shape": plane, "E": E, "side": "outer"}),
        "sk3": (psl.sk3, {"shape": plane, "E": E, "side": "inner"}),
        "sk2_conditions": (psl.sk2_conditions, {"shape": plane, "E": E}),
        "branch_graph": (psl.branch_graph, {"skeleton": k}),
        "hausdorff": (psl.hausdorff, {"A": plane, "B": k, "step": 0.1}),
        "directed_hausdorff": (psl.directed_hausdorff, {"A": POINTS, "B": RINGS[0], "step": 0.1}),
        "hierarchy": (psl.hierarchy, {"P": P, "strategy": "branch", "criterion": "corrected"}),
        "hierarchy 3D": (psl.hierarchy, {"P": t["P3"], "strategy": "surface", "criterion": "corrected"}),
        "Hierarchy.kept": (h.kept, {"threshold": 1.0}),
        "Hierarchy.shape": (h.shape, {"threshold": 1.0}),
        "Hierarchy.skeleton": (h.skeleton, {"threshold": 1.0}),
        "Hierarchy.branches": (h.branches, {"threshold": 1.0}),
        "Hierarchy": (
            psl.Hierarchy,
            {"P": P, "strategy": "branch", "criterion": "corrected"}
            | {"level": h.level, "kind": h.kind, "order": h.order},
        ),
        "DelaunayShape": (psl.DelaunayShape, {"tessellation": P.tessellation, "inner": P.inner}),
        "DelaunayShape.is_gabriel": (P.is_gabriel, {"closed": True}),
        "Tessellation": (
            psl.Tessellation,
            {name: getattr(P.tessellation, name) for name in ("points", "simplices", "neighbors")},
        ),
        "Skeleton": (
            psl.Skeleton,
            {
                name: getattr(k, name)
                for name in ("vertices", "radii", "simplices", "edges", "polygons", "rays", "ray_vertices")
            }
            | {"tessellation": k.tessellation},
        ),
        "Skeleton.main_axis": (k.main_axis().stations, {"spacing": 0.5}),
        "Skeleton.branch_table": (k.branch_table().to_csv, {"path": folder / "k.csv"}),
        "Skeleton.contacts": (k.contacts, {"vertex": 0}),
        "Skeleton.load": (psl.Skeleton.load, {"path": folder / "k.npz"}),
        "Skeleton.save": (k.save, {"path": folder / "k2.npz"}),
        "Skeleton.to_file": (k.to_file, {"path": folder / "k.ply"}),
        "Polyball": (psl.Polyball, {"centers": POINTS, "radii": [1, 2, 3, 4, 5]}),
        "Polyball.contains": (discs.contains, {"queries": POINTS}),
        "Polyball.boundary_distance": (balls.boundary_distance, {"queries": V}),
        "Polyball.patches": (balls.patches, {"fineness": 0.3}),
        "Polyball.skeleton": (discs.skeleton, {"statement": "corrected"}),
        "datasets.names": (psl.datasets.names, {"dimension": 2}),
        "datasets.load": (psl.datasets.load, {"name": "gear", "n": 200}),
        "datasets.info": (psl.datasets.info, {"name": "gear"}),
        "implicit.Field": (_at_once(im.Field), {"value": _cone, "box": [(-2,) * 3, (2,) * 3]}),
        "implicit.Field()": (im.ball(), {"points": V}),
        "implicit.ball": (_at_once(im.ball), {"center": (0, 0, 0), "radius": 1.0}),
        "implicit.torus": (_at_once(im.torus), {"major": 1.0, "minor": 0.4, "center": (0, 0, 0)}),
        "implicit.double_torus": (_at_once(im.double_torus), {"major": 1.0, "minor": 0.4}),
        "implicit.hollow_ball": (_at_once(im.hollow_ball), {"outer": 1.0, "inner": 0.5}),
        "implicit.capsule": (_at_once(im.capsule), {"length": 2.0, "radius": 0.5}),
        "implicit.trefoil": (_at_once(im.trefoil), {"radius": 0.45}),
        "implicit.tetrapod": (_at_once(im.tetrapod), {"length": 1.0, "root": 0.3, "tip": 0.18}),
        "implicit.arm": (_at_once(im.arm), {"control": V, "root": 0.5, "tip": 0.2, "pieces": 8}),
        "implicit.tube": (_at_once(im.tube), {"points": V, "radius": 0.5, "closed": False}),
        "implicit.union": (
            _at_once(lambda first, second, blend: im.union(first, second, blend=blend)),
            {"first": im.ball(), "second": im.torus(), "blend": 0.1},
        ),
        "implicit.difference": (_at_once(im.difference), {"first": im.ball(), "second": im.torus()}),
        "implicit.solid": (
            im.solid,
            {"field": im.ball(), "n": 30, "box": [(-1.5,) * 3, (1.5,) * 3], "seed": 0},
        ),
    }
    return table


def _cone(x):
    return np.abs(x).sum(axis=1) - 1


def _at_once(make):
    """Make a field and ask it something, so that nothing hostile is left for later."""
    return lambda **given: make(**given)(np.zeros((1, 3)))


def _deep(levels: int):
    nest: list = []
    for _ in range(levels):
        nest = [nest]
    return nest


class Silent:
    """An object whose repr is an error of its own."""

    def __repr__(self):
        raise RuntimeError("no repr")


def hostile(rng: np.random.Generator, good):
    """A value that does not belong there: of another kind, or the good one made bad in one place."""
    if isinstance(good, (list, np.ndarray)) and rng.random() < 0.6:
        return _spoiled(rng, np.array(good))
    if isinstance(good, (int, float)) and not isinstance(good, bool) and rng.random() < 0.5:
        return _NUMBERS[rng.integers(len(_NUMBERS))]
    return _OTHERS[rng.integers(len(_OTHERS))]()


_NUMBERS = [
    *(np.nan, np.inf, -np.inf, -1, 0, 1e-15, 1e-300, 1e9, 1e300, 10**400, -(10**400), 10**5000, 10**9, 2.5),
    *(True, 1j, Decimal("0.5"), Fraction(1, 3), np.float32(1), "1"),
]

_OTHERS = [
    lambda: None, lambda: [], lambda: (), lambda: {}, lambda: "", lambda: "words", lambda: b"bytes", object,
    Silent, lambda: np.nan, lambda: np.inf, lambda: -1, lambda: 0, lambda: 10**400, lambda: 10**5000,
    lambda: 1j, lambda: True, lambda: {1, 2}, lambda: frozenset(), lambda: OrderedDict(a=1),
    lambda: iter(POINTS), lambda: (p for p in POINTS), lambda: map(list, POINTS), lambda: range(3),
    lambda: zip(*POINTS, strict=True), lambda: _deep(20), lambda: _deep(100), lambda: _deep(5000),
    lambda: [["1", "2"], ["3", "4"], ["5", "7"]], lambda: [[1, 2], [3]], lambda: [None, None],
    lambda: np.zeros(()), lambda: np.zeros(0), lambda: np.zeros((0, 2)), lambda: np.zeros((3, 0)),
    lambda: np.zeros((2, 2, 2)), lambda: np.zeros((3, 5)), lambda: np.zeros((4, 4)),
    lambda: np.broadcast_to(0.0, (10**9, 2)), lambda: np.broadcast_to(0.0, (10**7, 10**7)),
    lambda: np.broadcast_to(np.int64(0), (10**9, 3)), lambda: np.broadcast_to(True, (10**6, 10**6)),
    lambda: np.array([object(), None]), lambda: np.array(["a", "b"]), lambda: np.array([b"a"]),
    lambda: np.array(["2020-01-01"], dtype="M8[D]"), lambda: np.zeros(3, dtype=[("x", float)]),
    lambda: psl, lambda: len, lambda: len, lambda: Path("/nowhere/x.npz"), lambda: "/nowhere/x.stl",
    lambda: "a\0b.svg", lambda: "x" * 5000 + ".png", lambda: "\ud800.geojson", lambda: slice(None),
    lambda: np.ma.masked, lambda: memoryview(b"123"), lambda: NotImplemented, lambda: Ellipsis,
    lambda: _things()["plane"], lambda: _things()["space"], lambda: _things()["k"],
    lambda: _things()["balls"], lambda: _things()["P"].tessellation, lambda: _things()["P3"],
]  # fmt: skip


def _spoiled(rng, array):
    """The good array with one thing wrong; the name of the thing comes with those that must be refused."""
    kind = rng.choice(
        [
            *("nan", "inf", "huge", "tiny", "negative", "masked", "complex", "big", "object", "float32"),
            *("text", "ragged", "turned", "flat", "short", "double", "list", "bool", "generator", "rows"),
        ]
    )
    place = tuple(rng.integers(0, s) for s in array.shape) if array.size else ()
    if not array.size or not array.ndim:
        return array.astype(complex)
    flat = np.array(array, dtype=float)
    if kind == "masked":
        return np.ma.array(array, mask=np.arange(array.size).reshape(array.shape) == rng.integers(array.size))
    if kind == "complex":
        spoiled = array.astype(complex)
        spoiled[place] += 1j
        return spoiled
    if kind == "big":
        spoiled = np.array(array, dtype=object)
        spoiled[place] = 2**53 + 1 + int(rng.integers(0, 1000)) * 2
        whole = array.astype(np.int64)
        whole[place] = 2**53 + 1
        return [spoiled, spoiled.tolist(), whole][rng.integers(3)]
    if kind in ("nan", "inf", "huge", "tiny", "negative"):
        flat[place] = {"nan": np.nan, "inf": np.inf, "huge": 1e308, "tiny": 5e-324, "negative": -7}[kind]
        return flat
    if kind == "object":
        spoiled = array.astype(object)
        spoiled[place] = [None, "1", 10**400, Fraction(1, 3), Decimal("NaN"), [], 1j][rng.integers(7)]
        return spoiled
    if kind == "ragged":
        return [*array.tolist()[:-1], array.tolist()[-1:]]
    if kind == "generator":
        return (row for row in array.tolist())
    if kind == "rows":
        return [iter(row) if isinstance(row, list) else row for row in array.tolist()]
    return {
        "float32": lambda: array.astype(np.float32),
        "text": lambda: array.astype(str),
        "turned": lambda: array.T,
        "flat": lambda: array.ravel(),
        "short": lambda: array[:-1],
        "double": lambda: np.concatenate([array, array[:1]]),
        "list": array.tolist,
        "bool": lambda: array.astype(bool),
    }[kind]()


def _altered(value) -> str:
    """Why an answer to this value would be an answer to something else; '' if it would not."""
    if isinstance(value, np.ma.MaskedArray):
        return "masked" if np.ma.getmaskarray(value).any() else ""
    if isinstance(value, np.ndarray) and value.dtype.kind == "c":
        return "complex" if value.imag.any() else ""
    if isinstance(value, np.ndarray) and value.dtype.kind in "iu" and value.size < 100:
        return "big" if (value > 2**53).any() else ""
    if isinstance(value, (list, np.ndarray)) and np.size(np.array(value, dtype=object)) < 100:
        flat = np.array(value, dtype=object).ravel().tolist()
        return "big" if any(isinstance(x, int) and x > 2**53 for x in flat) else ""
    return ""


def run(rng: np.random.Generator) -> Iterator[str]:
    """One call: yields what it is, in words, and then makes it."""
    table = calls()
    name = list(table)[rng.integers(len(table))]
    function, good = table[name]
    given, told = dict(good), []
    for key in rng.permutation(list(good))[: 1 if rng.random() < 0.8 else 2]:
        given[key] = hostile(rng, good[key])
        told.append(key)
    reason = ""
    for key in told:
        if isinstance(good[key], (list, np.ndarray)):
            try:
                reason = reason or _altered(given[key])
            except Exception:  # ragged
                reason = ""
    words = f"{name}({', '.join(f'{key}={_short(given[key])}' for key in told)})"
    yield words
    function(**given)
    assert not reason, f"{reason} numbers were taken for others"


def _short(value) -> str:
    try:
        text = f"{type(value).__name__} {value!r}"
    except Exception:
        text = f"a {type(value).__name__}"
    return text if len(text) < 120 else text[:117] + "..."
