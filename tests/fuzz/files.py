"""Files of every kind: random regions written in it, which must be read as they are, and damaged ones."""

from __future__ import annotations

import io
import json
import tempfile
import zipfile
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
from truth.rational import grid_region

import polyskel_lite as psl

CORPUS = Path(__file__).parent / "corpus"


def area_of(rings) -> Fraction:
    """Twice the sum of the signed areas, in fractions: outer rings run one way and holes the other."""
    return sum(
        Fraction(a[0]) * Fraction(b[1]) - Fraction(a[1]) * Fraction(b[0])
        for ring in rings
        for a, b in zip(ring, [*ring[1:], ring[0]], strict=True)
    )


def geojson(rings, rng) -> bytes:
    closed = [[*map(list, ring), list(ring[0])] for ring in rings]
    geometry = {"type": "MultiPolygon", "coordinates": [[ring] for ring in closed]}
    if rng.random() < 0.5:
        geometry = {"type": "GeometryCollection", "geometries": [{"type": "Polygon", "coordinates": closed}]}
    feature = {"type": "Feature", "properties": None, "geometry": geometry}
    return json.dumps({"type": "FeatureCollection", "features": [feature]}).encode()


def svg(rings, rng) -> bytes:
    path = "".join("M" + "L".join(f"{x} {-y} " for x, y in ring) + "Z" for ring in rings)
    return f'<svg xmlns="http://www.w3.org/2000/svg"><g><path id="a" d="{path}"/></g></svg>'.encode()


def npz(rings, rng) -> bytes:
    stream = io.BytesIO()
    save = np.savez_compressed if rng.random() < 0.5 else np.savez
    save(stream, xy=np.concatenate(rings), off=np.cumsum([0, *map(len, rings)]))
    return stream.getvalue()


WRITERS = {".geojson": geojson, ".svg": svg, ".npz": npz}


@cache
def originals() -> dict[str, bytes]:
    """Good files by name: those of the corpus, and one of every kind that the library writes or reads."""
    found = {path.name: path.read_bytes() for path in sorted(CORPUS.glob("*/*.*"))}
    rng = np.random.default_rng(0)
    rings = grid_region(rng, size=3, hole=True)
    found |= {f"region{suffix}": write(rings, rng) for suffix, write in WRITERS.items()}
    solid = psl.Shape.from_mesh(
        [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 6)], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    )
    plane = psl.Shape.from_rings(rings)
    with tempfile.TemporaryDirectory() as folder:
        for suffix in (".stl", ".ply", ".obj", ".off"):
            solid.to_file(Path(folder) / f"solid{suffix}")
        for name, skeleton in (
            ("plane", psl.sk0(psl.conform(plane))),
            ("space", psl.voronoi(np.random.default_rng(1).normal(size=(9, 3)))),
        ):
            skeleton.save(Path(folder) / f"{name}.skeleton")
        from PIL import Image

        picture = Image.fromarray(np.pad(np.zeros((9, 7), dtype=np.uint8), 3, constant_values=255))
        for suffix in (".png", ".jpg", ".bmp", ".gif", ".tif", ".webp", ".pgm"):
            picture.save(Path(folder) / f"picture{suffix}")
        found |= {path.name: path.read_bytes() for path in sorted(Path(folder).iterdir())}
    return found


def flipped(data, rng):
    data = bytearray(data)
    for _ in range(rng.integers(1, 6)):
        data[int(rng.integers(len(data)))] ^= int(rng.integers(1, 256))
    return bytes(data)


def truncated(data, rng):
    return data[: rng.integers(0, len(data))]


def shuffled(data, rng):
    """A piece of the file in another place, twice or not at all."""
    a, b = sorted(rng.integers(0, len(data) + 1, size=2).tolist())
    at = int(rng.integers(0, len(data) + 1))
    return [data[:a] + data[b:], data[:at] + data[a:b] + data[at:], data + data[a:b]][rng.integers(3)]


HOSTILE = [
    *(b"1e400", b"-1e308", b"NaN", b"1" * 400, b"1e-400", b"0", b"-1", b"99999999999", b"\xff\xfe", b""),
    *(b"null", b"[]", b"{}", b'"x"', b"true", b"[[[]]]", b"[" * 3000, b'["Polygon"]', b'{"type": []}'),
    *(b"z", b"<g>" * 3000, b'<?xml version="1.0" encoding="no-such"?>', b"\0", b"A 1 1 0 1 1 2 2", b"&x;"),
]


def replaced(data, rng):
    """One number or word of a text replaced by something hostile."""
    words = [b" ", b",", b"\n", b"[", b'"', b":"]
    parts = data.split(words[rng.integers(len(words))], 200)
    parts[rng.integers(len(parts))] = HOSTILE[rng.integers(len(HOSTILE))]
    return words[rng.integers(len(words))].join(parts)


def rewritten(data, rng):
    """An .npz with other arrays, or with a header that claims another shape; other files: as `replaced`."""
    try:
        with np.load(io.BytesIO(data)) as file:
            arrays = dict(file)
    except Exception:  # no .npz, or not any more
        return replaced(data, rng)
    for name in rng.permutation(sorted(arrays))[: rng.integers(1, 3)]:
        array = arrays[name]
        change = int(rng.integers(9))
        arrays[name] = [
            lambda a: a + 0.5, lambda a: a.astype(complex), lambda a: a * np.nan, lambda a: a + 10**6,
            lambda a: a[::-1], lambda a: a[:-1], lambda a: a.astype(str), lambda a: np.zeros(()),
            lambda a: a.astype(np.uint8),
        ][change](array)  # fmt: skip
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in arrays.items():
            member = io.BytesIO()
            np.lib.format.write_array(member, np.asarray(array), allow_pickle=False)
            content = member.getvalue()
            if rng.random() < 0.1:  # says 16 GB and has some bytes
                claim = f"({2 * 10**9},)".encode()
                content = content.replace(str(array.shape).encode(), claim, 1)
            if rng.random() < 0.95:
                archive.writestr(f"{name}.npy", content)
    return stream.getvalue()


DAMAGES = [flipped, truncated, shuffled, replaced, rewritten]


def run(rng: np.random.Generator) -> Iterator[str]:
    """One file, read; yields what it is, in words, first."""
    with tempfile.TemporaryDirectory() as folder:
        if rng.random() < 0.25:
            suffix = list(WRITERS)[rng.integers(len(WRITERS))]
            rings = grid_region(rng, size=int(rng.integers(1, 4)))
            path = Path(folder) / f"region{suffix}"
            yield f"a random region as {suffix}"
            path.write_bytes(WRITERS[suffix](rings, rng))
            _as_it_is(psl.Shape.from_file(path), rings)
            return
        name = list(originals())[rng.integers(len(originals()))]
        data = originals()[name]
        damages = rng.permutation(len(DAMAGES))[: rng.integers(1, 3)].tolist()
        yield f"{name}, {' and '.join(DAMAGES[k].__name__ for k in damages)}"
        for k in damages:
            data = DAMAGES[k](data or b" ", rng)
        path = Path(folder) / name
        path.write_bytes(data)
        if path.suffix == ".skeleton":
            _sound(psl.Skeleton.load(path))
        else:
            psl.Shape.from_file(path).betti()


def _as_it_is(shape, rings) -> None:
    assert Fraction(abs(area_of(rings))) == Fraction(2 * shape.area()).limit_denominator(10**6)
    turns = [area_of([ring]) > 0 for ring in rings]
    assert shape.betti() in ((turns.count(True), turns.count(False)), (turns.count(False), turns.count(True)))
    assert len(shape.points) == sum(map(len, rings))


def _sound(skeleton) -> None:
    """What was loaded can be used: nothing in it points to where nothing is."""
    n = len(skeleton.vertices)
    assert skeleton.edges.size == 0 or (skeleton.edges.min() >= 0 and skeleton.edges.max() < n)
    assert all(len(polygon) > 2 and max(polygon) < n for polygon in skeleton.polygons)
    assert not np.isnan(skeleton.vertices).any()
    assert not np.isnan(skeleton.lengths()[np.isfinite(skeleton.lengths())]).any()
    if skeleton.tessellation is not None:
        t = skeleton.tessellation
        assert t.simplices.max() < len(t.points)
        t.facet_table, t.apexes()
