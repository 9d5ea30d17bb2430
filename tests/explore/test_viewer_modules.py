"""The viewer's JavaScript modules: they fit together; those without a page in them are tried under node."""

import base64
import json
import re
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import polyskel_lite as psl

pytest.importorskip("anywidget", reason="the viewer needs the extra lab")

from polyskel_lite import explore
from polyskel_lite.explore.bundle import one_module
from polyskel_lite.explore.skeleton_viewer.pack import Packer

ROOM = Path(__file__).resolve().parents[2] / "polyskel_lite" / "explore" / "skeleton_viewer"
MODULES = {file.name: file.read_text(encoding="utf-8") for file in sorted(ROOM.glob("*.js"))}
DEFINED = r"(?:async )?(?:const|let|var|class|function\*?) +(\w+)"
IMPORTED = r'^import \{ (.*) \} from "\./(.*)";$'


def imports(name: str) -> dict[str, list[str]]:
    """The names that a module takes from each other one."""
    return {file: names.split(", ") for names, file in re.findall(IMPORTED, MODULES[name], re.M)}


# --- the modules and their bundle -------------------------------------------------------------------


def test_no_two_modules_define_one_name():
    names = {file: re.findall(rf"^(?:export )?{DEFINED}", text, re.M) for file, text in MODULES.items()}
    assert all(names.values())
    times = Counter(name for own in names.values() for name in own)
    assert [name for name, count in times.items() if count > 1] == []


def test_modules_export_what_others_import_and_nothing_else():
    exports = {name: set(re.findall(rf"^export {DEFINED}", text, re.M)) for name, text in MODULES.items()}
    taken = {name: set() for name in MODULES}
    for name, text in MODULES.items():
        lines = re.findall(r"^\s*import\b.*", text, re.M)
        assert len(lines) == len(imports(name)), f"{name} imports in another form than bundle.py knows"
        for file, names in imports(name).items():
            taken[file] |= set(names)
            unused = [word for word in names if len(re.findall(rf"\b{word}\b", text)) < 2]
            assert not unused, f"{name} does not use {unused}"
    assert taken == exports
    assert [name for name, text in MODULES.items() if "\nexport default " in text] == ["page.js"]


def test_bundle_holds_every_module_after_those_that_it_imports():
    bundle = explore.SkeletonViewer._esm
    lines = bundle.splitlines()
    outward = [line for line in lines if re.match(r"\s*(import|export)\b", line)]
    assert outward == ["export default { render };"]
    start = {name: lines.index(text.splitlines()[0]) for name, text in MODULES.items()}
    for name, text in MODULES.items():
        assert all(start[other] < start[name] for other in imports(name)), name
        own = [re.sub("^export (?!default)", "", line) for line in text.splitlines()]
        code = "\n".join(line for line in own if not line.startswith("import "))
        assert re.sub(r"\n+", "\n", code) in re.sub(r"\n+", "\n", bundle), name


def test_bundle_needs_nothing_but_the_standard_library():
    code = f"import runpy; print(runpy.run_path({str(ROOM.parent / 'bundle.py')!r})['one_module'](), end='')"
    command = [sys.executable, "-X", "utf8", "-I", "-S", "-c", code]  # -S: without site-packages
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE)
    assert done.stdout.decode("utf-8").splitlines() == explore.SkeletonViewer._esm.splitlines()


def test_modules_in_a_circle_are_refused(tmp_path):
    for name, other in ("ab", "ba"):
        (tmp_path / f"{name}.js").write_text(f'import {{ {other} }} from "./{other}.js";\n')
    with pytest.raises(ValueError, match="cycle"):
        one_module(tmp_path / "a.js")


# --- under node -------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def answer(tmp_path_factory):
    """answer(code, **given): what the function `answer` of this code, put beside the modules, returns."""
    if (program := shutil.which("node")) is None:
        pytest.skip("node is not installed, so the viewer's JavaScript was not tried outside of a browser.")
    folder = tmp_path_factory.mktemp("modules")
    for name, text in MODULES.items():
        (folder / name).write_text(text, encoding="utf-8")
    (folder / "package.json").write_text('{"type": "module"}')  # without it older nodes take no `import`
    script = folder / "script.mjs"

    def run(code: str, **given):
        end = 'console.log(JSON.stringify(await answer(JSON.parse(readFileSync(0, "utf8")))));'
        script.write_text(f'import {{ readFileSync }} from "node:fs";\n{code}\n{end}', encoding="utf-8")
        told = json.dumps(given, allow_nan=False)
        done = subprocess.run([program, script], input=told, capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    return run


def sent(block: bytes) -> str:
    return base64.b64encode(block).decode()


def test_every_module_loads_by_itself(answer):
    code = """
    async function answer({ names }) {
      for (const name of names) await import(`./${name}`);
      return "loaded";
    }"""
    assert answer(code, names=list(MODULES)) == "loaded"


def test_arrays_come_out_as_they_went_in(answer):
    rng, packer = np.random.default_rng(2), Packer()
    arrays = {
        "small": rng.integers(0, 200, 31),
        "middle": rng.integers(0, 60_000, 32),
        "large": rng.integers(0, 2**32, 33),
        "pairs": rng.integers(0, 300, 40),
        "none": np.zeros(0, dtype=int),
        "levels": rng.random(7),
    }
    refs = {name: packer.add(array, delta=2 * (name == "pairs")) for name, array in arrays.items()}
    code = """
    import { bytesOf, read, unpacked } from "./data.js";
    async function answer({ block, refs }) {
      const buffer = await unpacked(bytesOf(block));
      const arrays = Object.entries(refs).map(([name, ref]) => [name, [...read(buffer, ref)]]);
      return { ...Object.fromEntries(arrays), nothing: read(buffer, undefined) };
    }"""
    expected = {name: array.tolist() for name, array in arrays.items()}
    assert answer(code, block=sent(packer.block()), refs=refs) == expected | {"nothing": None}


@pytest.mark.parametrize("dimension", [2, 3])
def test_positions_have_three_numbers_and_far_ones_are_exact(answer, dimension):
    packer, points = Packer(), np.random.default_rng(3).random((9, dimension))
    points[4] = 1e6
    ref = packer.places(points, np.zeros(dimension), np.ones(dimension))
    code = """
    import { bytesOf, positions, unpacked } from "./data.js";
    const answer = async ({ block, ref, dimension }) =>
      [...positions(await unpacked(bytesOf(block)), ref, dimension)];"""
    found = answer(code, block=sent(packer.block()), ref=ref, dimension=dimension)
    full = np.pad(points, [(0, 0), (0, 3 - dimension)])
    np.testing.assert_allclose(np.reshape(found, (9, 3)), full, atol=1e-5)
    assert found[12 : 12 + dimension] == [1e6] * dimension


SCENES = """
import { bytesOf, unpacked } from "./data.js";
import { Scene } from "./scene.js";
async function scenes({ block, header }) {
  const buffer = await unpacked(bytesOf(block));
  return header.variants.map((variant) => new Scene(buffer, variant, header.dimension));
}
"""


def test_filter_of_a_triangle_with_a_tail(answer):
    # Vertex 4 goes first, then 3; 0 next, and the triangle with it; 1 and 2 never go. Vertex 5 has no edge.
    packer = Packer()
    points = np.array([(0, 0), (1, 0), (0, 1), (0, 2), (0, 3), (3, 3)], dtype=float)
    variant = {
        "label": "",
        "vertices": packer.places(points, points.min(axis=0), points.max(axis=0)),
        "radius": packer.add(np.zeros(6, dtype=int)),
        "edges": packer.add(np.array([(0, 1), (0, 2), (1, 2), (2, 3), (3, 4)]), delta=2),
        "sizes": packer.add(np.array([3])),
        "corners": packer.add(np.array([0, 1, 2])),
    }
    rank, level = packer.add(np.array([2, 3, 3, 1, 0, 3])), packer.add(np.array([0.5, 1.0, 2.0]))
    variant["hierarchies"] = [{"label": "", "rank": rank, "level": level}]
    code = """
    async function answer(given) {
      const [{ hierarchies: [filter] }] = await scenes(given);
      return given.thresholds.map((threshold) => {
        const cut = filter.cut(threshold);
        const counts = filter.counts(cut);
        const kept = [...filter.keptVertices(cut)], alone = [...filter.lone(cut)];
        const wires = filter.wires(cut).sort(), corners = filter.triangles().upTo[counts.polygons];
        return { cut, ...counts, kept, alone, wires, corners };
      });
    }"""
    header = {"dimension": 2, "variants": [variant]}
    thresholds = [0, 0.5, 0.75, 1.5, 9]
    found = answer(SCENES + code, block=sent(packer.block()), header=header, thresholds=thresholds)
    assert [row["cut"] for row in found] == [0, 0, 1, 2, 3]
    assert [row["vertices"] for row in found] == [6, 6, 5, 4, 3]
    assert [row["edges"] for row in found] == [5, 5, 4, 3, 1]
    assert [row["polygons"] for row in found] == [1, 1, 1, 1, 0]
    assert [row["corners"] for row in found] == [3, 3, 3, 3, 0]
    assert [row["branches"] for row in found] == [1, 1, 1, 0, 2]
    assert [row["wires"] for row in found] == [[3, 4], [3, 4], [3], [], [2]]
    assert all(row["alone"] == [5] and row["lone"] == 1 for row in found)
    assert found[-1]["kept"] == [1, 2, 5]


@pytest.mark.parametrize(
    ("name", "strategies"), [("leaf", ["branch"]), ("fourbranch", ["surface", "wireframe"])]
)
def test_filter_keeps_what_the_hierarchy_keeps(answer, name, strategies):
    P = psl.delaunay_shape(psl.datasets.load(name))
    hierarchies = [psl.hierarchy(P, strategy) for strategy in strategies]
    picture = explore.viewer(hierarchies)
    levels = np.sort(np.concatenate([h.level[np.isfinite(h.level)] for h in hierarchies]))
    some = levels[np.linspace(0, len(levels) - 1, 6).astype(int)]
    thresholds = [-1.0, 0.0, np.pi, *some, *np.nextafter(some[2], [0.0, 9.0]), levels[-1] + 1]
    code = """
    async function answer(given) {
      const [scene] = await scenes(given);
      return scene.hierarchies.map((filter) => given.thresholds.map((threshold) => {
        const cut = filter.cut(threshold), { vertices, edges, polygons, branches } = filter.counts(cut);
        const region = [...filter.region(cut)], boundary = [...filter.boundary(cut)];
        return { counts: { vertices, edges, polygons, branches }, region, boundary };
      }));
    }"""
    given = {"block": sent(picture.blob), "header": picture.scene, "thresholds": thresholds}
    points, N = P.tessellation.points, P.dimension
    for h, rows in zip(hierarchies, answer(SCENES + code, **given), strict=True):
        for threshold, row in zip(thresholds, rows, strict=True):
            skeleton, shape = h.skeleton(threshold), h.shape(threshold)
            assert row["counts"] == {
                "vertices": len(skeleton.vertices),
                "edges": len(skeleton.edges),
                "polygons": len(skeleton.polygons),
                "branches": h.branches(threshold).graph["branches"],
            }
            if N == 2:  # in space the viewer draws the boundary only
                assert row["region"] == P.tessellation.simplices[shape.inner].ravel().tolist()
            facets = np.reshape(row["boundary"], (-1, N)).astype(int)
            assert {*map(frozenset, facets.tolist())} == {*map(frozenset, shape.boundary().tolist())}
            # Cones over the facets fill the shape exactly if all facets are turned outward.
            corners = points[P.tessellation.simplices[shape.inner]]
            filled = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])).sum()
            assert np.linalg.det(points[facets] - points.mean(axis=0)).sum() == pytest.approx(filled)


CAMERA = """
import { Camera, clamp } from "./camera.js";
/** Where a point stands on the stage, from -1 to 1. */
function place(camera, aspect, points, free, p) {
  const m = camera.matrices(aspect, points, free).toClip;
  const row = (k) => m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
  return [row(0) / row(3), row(1) / row(3)];
}
function all(camera, aspect, points, free = 1) {
  const places = Array.from({ length: points.length / 3 }, (_, i) => points.slice(3 * i, 3 * i + 3));
  return places.map((p) => place(camera, aspect, points, free, p));
}
"""


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("aspect", [0.6, 2.0])
def test_camera_fills_the_stage_above_the_scale_of_colours(answer, dimension, aspect):
    points = np.pad(np.random.default_rng(4).random((40, dimension)) * 7 + 5, [(0, 0), (0, 3 - dimension)])
    code = """
    const answer = ({ low, high, points, aspect }) =>
      all(new Camera(low.length, low, high, { azim: 30, elev: 20 }), aspect, points, 0.9);"""
    box = {"low": [5] * dimension, "high": [12] * dimension}
    found = np.array(answer(CAMERA + code, **box, points=points.ravel().tolist(), aspect=aspect))
    low, high = found.min(axis=0), found.max(axis=0)
    assert max((high - low) / [2, 1.8]) == pytest.approx(0.95, abs=1e-4)
    np.testing.assert_allclose((low + high) / 2, [0, 0.1], atol=1e-4)  # the scale stands below


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("free", [1, 0.9])
def test_zoom_keeps_the_place_under_the_pointer(answer, dimension, free):
    code = """
    function answer({ low, high, points, free }) {
      const camera = new Camera(low.length, low, high, { azim: 30, elev: 20 });
      const start = all(camera, 1.5, points, free), [px, py] = start[0];
      camera.scale(1.7, px, py);
      const near = all(camera, 1.5, points, free);
      camera.reset();
      camera.scale(1.7);
      const middle = all(camera, 1.5, points, free);
      camera.scale(1e9);
      const closest = camera.zoom;
      camera.scale(1e-9);
      const farthest = camera.zoom;
      camera.turn(500, 500);
      const elevation = camera.elevation;
      camera.reset();
      return { start, near, middle, closest, farthest, elevation, back: all(camera, 1.5, points, free) };
    }"""
    points = np.pad(np.random.default_rng(5).random((5, dimension)), [(0, 0), (0, 3 - dimension)])
    box = {"low": [0] * dimension, "high": [1] * dimension}
    found = answer(CAMERA + code, **box, points=points.ravel().tolist(), free=free)
    start, near, middle = (np.array(found[name]) for name in ("start", "near", "middle"))
    np.testing.assert_allclose(near[0], start[0], atol=1e-5)
    np.testing.assert_allclose(near - near[0], 1.7 * (start - start[0]), atol=1e-5)
    still = np.array([0, 1 - free])  # for the buttons: the middle of what is not under the scale of colours
    np.testing.assert_allclose(middle - still, 1.7 * (start - still), atol=1e-5)
    assert (found["closest"], found["farthest"], found["elevation"]) == (60, 0.3, 89.9)
    assert found["back"] == found["start"]


def test_light_comes_over_the_left_shoulder_of_the_reader(answer):
    code = """
    const answer = () => {
      const { toLight, toEye } = new Camera(3, [0, 0, 0], [2, 2, 2], { azim: 0, elev: 0 }).lights();
      return { toLight, toEye, clamped: [clamp(-1, 0, 1), clamp(0.5, 0, 1), clamp(7, 0, 1)] };
    };"""
    found = answer(CAMERA + code)
    np.testing.assert_allclose(found["toEye"], [1, 0, 0], atol=1e-6)
    toward, left, up = np.multiply(found["toLight"], [1, -1, 1])
    assert np.linalg.norm(found["toLight"]) == pytest.approx(1)
    assert min(toward, left, up) > 0.3
    assert found["clamped"] == [0, 0.5, 1]


SURFACE = {"largest": 1.01 * np.pi, "knee": np.pi, "systematic": True}
LENGTHS = {"largest": 40 * np.pi, "knee": 2.5 * np.pi, "systematic": False}


@pytest.mark.parametrize("header", [SURFACE, LENGTHS, LENGTHS | {"largest": 2.7 * np.pi}])
def test_slider_is_even_up_to_its_knee(answer, header):
    code = """
    import { STEPS, TICKS, Track } from "./threshold.js";
    function answer({ header }) {
      const track = new Track(header), steps = Array.from({ length: STEPS + 1 }, (_, k) => k);
      const at = steps.map((k) => track.at(k)).map((t) => (t === -Infinity ? null : t));
      const back = steps.map((k) => track.step(track.at(k)));
      const ticks = TICKS.map(([, t]) => [t, track.at(track.step(t))]);
      const ends = [track.step(-Infinity), track.step(1e9)];
      return { at, back, ticks, ends, share: [track.share(header.knee), track.share(header.largest)] };
    }"""
    found = answer(code, header=header)
    assert (found["at"][0] is None) == header["systematic"]
    at = np.array(found["at"][header["systematic"] :])
    assert (np.diff(at) >= 0).all()
    assert at[0] == 0
    assert at[-1] == pytest.approx(header["largest"], abs=1e-3 * np.pi)
    bent = header["largest"] == 40 * np.pi
    assert found["share"] == pytest.approx([0.8 if bent else min(header["knee"] / header["largest"], 1), 1])
    even = at[at <= (header["knee"] if bent else header["largest"])]
    # A round angle or a multiple of π / 1000 is less than one step from an even place.
    assert np.abs(even - np.linspace(0, even[-1], len(even))).max() < np.diff(even).mean()
    if bent:
        assert len(even) == 321
        beyond = np.diff(np.log(at[at > header["knee"]]))
        np.testing.assert_allclose(beyond, beyond.mean(), rtol=0.1)
    for tick, reached in found["ticks"]:
        assert reached == tick or tick > header["largest"]  # a round angle is reached exactly
    assert found["ends"] == [0, 400]
    assert np.abs(np.array(found["back"]) - np.arange(401)).max() <= 1


TYPED = {
    "pi/3": np.pi / 3,
    "2pi/3": 2 * np.pi / 3,
    " 2 π / 3 ": 2 * np.pi / 3,
    "π/2": np.pi / 2,
    "PI": np.pi,
    "1.5": 1.5 * np.pi,
    ".5": 0.5 * np.pi,
    "2*pi": 2 * np.pi,
    "1/3": np.pi / 3,
    "0": 0.0,
    "-0": 0.0,
    "": None,
    "none": None,
}


def test_field_reads_numbers_and_shares_of_pi(answer):
    code = """
    import { typed } from "./threshold.js";
    const answer = ({ texts }) => texts.map((text) => {
      const { threshold, problem } = typed(text);
      return { problem, threshold: threshold === -Infinity ? null : threshold };
    });"""
    found = answer(code, texts=list(TYPED))
    assert [row.get("problem") for row in found] == [None] * len(TYPED)
    assert [row["threshold"] for row in found] == list(TYPED.values())
    refused = [
        "-1",
        "−pi/3",
        "abc",
        "1e3",
        "pi3",
        "1..2",
        "/3",
        "pi/0",
        "1,5",
        "Infinity",
        "NaN",
        "--1",
        "9" * 400,
    ]
    found = answer(code, texts=refused)
    assert all("threshold" not in row for row in found)
    assert all("Type " in row["problem"] and "pi/3" in row["problem"] for row in found)
    assert ["never negative" in row["problem"] for row in found] == [True] * 2 + [False] * 11


def luminance(color: str) -> float:
    part = np.array([int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)])
    return float(
        np.where(part <= 0.04045, part / 12.92, ((part + 0.055) / 1.055) ** 2.4) @ (0.2126, 0.7152, 0.0722)
    )


def contrast(*colors: str) -> float:
    low, high = sorted(map(luminance, colors))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("source", ["shape", "balls"])
def test_lines_and_dots_stand_out_from_what_is_behind_them(answer, theme, source):
    code = """
    import { palette } from "./theme.js";
    const answer = ({ dark, light, balls }) =>
      palette({ closest: () => (dark ? {} : null) }, light, balls);"""
    shape = psl.Polyball([(0, 0), (1, 0)], [1, 1]) if source == "balls" else psl.datasets.load("lake")
    light = explore.viewer(shape).scene["colors"]
    found = answer(code, dark=theme == "dark", light=light, balls=source == "balls")
    colors = found["colors"]
    assert colors.keys() == light.keys()
    lines = [*found["ramp"], *(colors[name] for name in ("shape", "samples", "skeleton", "vertices"))]
    for ground in (found["ground"], colors["fill"]):
        assert min(contrast(line, ground) for line in lines) >= 3
    assert contrast(found["ink"], found["ground"]) > 7
    # The scale of colours can be read in grey: it never gets darker again.
    assert (np.diff([luminance(color) for color in found["ramp"]]) > 0).all()
    assert (luminance(found["ground"]) < 0.1) == (theme == "dark")


def test_modules_of_all_rooms_fit_together():
    files = {file.resolve(): file.read_text("utf-8") for file in sorted(ROOM.parent.rglob("*.js"))}
    pattern = r'^import \{ (.*) \} from "(\..*)";$'
    exports = {file: set(re.findall(rf"^export {DEFINED}", text, re.M)) for file, text in files.items()}
    taken = {file: set() for file in files}
    for file, text in files.items():
        found = re.findall(pattern, text, re.M)
        assert len(found) == len(re.findall(r"^\s*import\b", text, re.M)), f"{file} imports in another form"
        for names, other in found:
            target = (file.parent / other).resolve()
            assert set(names.split(", ")) <= exports[target], (file.name, other)
            unused = [name for name in names.split(", ") if len(re.findall(rf"\b{name}\b", text)) < 2]
            assert not unused, f"{file} does not use {unused}"
            taken[target] |= set(names.split(", "))
    explorers = {
        "Balls",
        "FourMethods",
        "Graphs",
        "MaximalBall",
        "Refinement",
        "Removals",
        "Sampling",
        "start",
    }
    tried = set(re.findall(r"\w+", (ROOM.parents[2] / "tests/browser/test_plane.py").read_text("utf-8")))
    for file in files:
        assert exports[file] - taken[file] - explorers - tried == set(), file.name
