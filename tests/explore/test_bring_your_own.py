"""A reader's own shape: every kind of file goes the whole way, and bad ones get a sentence."""

import contextlib
import io
import json
import random
from datetime import UTC, datetime
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image
from truth.meshes import capsule, cube

import polyskel_lite as psl
from polyskel_lite import explore, implicit
from polyskel_lite.explore.explorers import bring_your_own


def picture_bytes(kind):
    rows, columns = np.mgrid[:60, :80]
    inside = (rows - 30) ** 2 / 400 + (columns - 40) ** 2 / 900 < 1
    stream = io.BytesIO()
    Image.fromarray(np.where(inside, 0, 255).astype(np.uint8)).save(stream, kind)
    return stream.getvalue()


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    """One small file of each kind."""
    folder = tmp_path_factory.mktemp("good")
    solid = implicit.solid(implicit.ball(), n=60)
    for suffix in ("stl", "ply", "obj", "off"):
        solid.to_file(folder / f"solid.{suffix}")
    stream = io.BytesIO()
    np.savez(stream, points=[[0, 0], [4, 0], [0, 3.0]], facets=[[0, 1], [1, 2], [2, 0]])
    ring = [[0, 0], [4, 0], [4, 1], [0, 1], [0, 0]]
    return {
        "blob.png": picture_bytes("PNG"),
        "blob.jpg": picture_bytes("JPEG"),
        "drawing.svg": b'<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H9V4H0Z"/></svg>',
        "field.geojson": json.dumps({"type": "Polygon", "coordinates": [ring]}).encode(),
        "arrays.npz": stream.getvalue(),
    } | {path.name: path.read_bytes() for path in folder.iterdir()}


def test_added_samples_are_told():
    plan = psl.Shape.from_rings([[(0, 0), (20, 0), (20, 4), (0, 4)]])
    own = explore.explore(plan)
    added = len(own.chain.refined.points) - len(plan.points)
    assert added > 50
    sentence = (
        f"4 vertices, Betti numbers (1, 0). {added} more make it dense enough and put its boundary into"
    )
    assert sentence in own._status.value
    assert sentence in own.stand_in()
    assert "No ball is more than 1.003 times" in own._status.value
    fine = explore.explore(psl.Shape.from_mesh(*capsule(16.0, 24, 60, 8)))
    assert (
        "vertices, Betti numbers (1, 0, 0). Other edges put its boundary into the Delaunay tessellation."
        in (fine._status.value)
    )


def test_a_shape_is_refined_as_in_one_call():
    """Outlines of any number of vertices, and solids: a box by its corners has its axis."""
    outline = psl.datasets.load("gear")
    assert (bring_your_own.chain(outline).refined.points == psl.skeleton(outline).refined.points).all()
    box = psl.Shape.from_mesh(*cube())
    own = explore.explore(box)
    assert [bones.quality.ratio < 1.05 for bones in own.chain.bones] == [True, True]
    assert own.hierarchy.skeleton(np.pi / 3).radii.max() == pytest.approx(0.5, rel=0.02)
    assert (own.chain.refined.points == psl.skeleton(box).refined.points).all()


def test_what_takes_long_or_stays_wrong_is_told(monkeypatch):
    told = []
    monkeypatch.setitem(bring_your_own.MANY_VERTICES, 2, 100)
    bring_your_own.chain(psl.datasets.load("gear"), told.append)
    assert told == ["shape: 500 vertices. Samples are added where it is narrow; this takes some seconds."]
    thin = explore.explore(psl.Shape.from_rings([[(0, 0), (1, 0), (1, 1e-9), (0, 1e-9)]]))
    assert "But the samples are too coarse" in thin._status.value
    assert "1e-09 wide there, too thin for its size: widen it" in thin._status.value


WHEN = datetime(1997, 9, 1, tzinfo=UTC)


def uploaded(own, name, content):
    own.upload.value = (
        {
            "name": name,
            "type": "",
            "size": len(content),
            "last_modified": WHEN,
            "content": memoryview(content),
        },
    )


KINDS = [
    *("blob.png", "blob.jpg", "drawing.svg", "field.geojson", "arrays.npz"),
    *("solid.stl", "solid.ply", "solid.obj", "solid.off"),
]


@pytest.mark.parametrize("name", KINDS)
def test_upload_goes_the_whole_way(good, name):
    own = explore.explore()
    assert own.chain is None
    assert not own._place.children
    uploaded(own, name, good[name])
    assert own.error is None
    assert own.chain.name == name.split(".")[0]
    assert own.chain.given.betti()[:2] == (1, 0)
    assert own.picture in own._place.children
    assert own.chain.name in own._status.value
    files = own.files()
    assert own.hierarchy.skeleton(own.picture.threshold).vertices.shape[1] == own.chain.given.dimension
    assert len(files) == (3 if own.chain.given.dimension == 2 else 4)
    assert all(len(content) for content in files.values())


BAD = {
    "empty.png": b"",
    "text.png": b"no picture at all",
    "white.png": None,
    "broken.svg": b"<svg><path d='M0 0",
    "open.svg": b'<svg xmlns="http://www.w3.org/2000/svg"><path fill="none" d="M0 0H9V4"/></svg>',
    "bow.geojson": b'{"type":"Polygon","coordinates":[[[0,0],[2,2],[2,0],[0,2],[0,0]]]}',
    "line.geojson": b'{"type":"LineString","coordinates":[[0,0],[2,2]]}',
    "broken.json": b"{",
    "broken.npz": b"PK\x03\x04 and nothing more",
    "broken.stl": b"solid but no",
    "open.off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    "far.ply": b"ply\nformat ascii 1.0\n"
    b"element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    b"element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n",
    "points.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\n",
    "letter.docx": b"PK",
}


@pytest.mark.parametrize("name", BAD)
def test_bad_files_get_the_sentence_of_the_library(name, tmp_path):
    content = BAD[name]
    if content is None:
        stream = io.BytesIO()
        Image.new("L", (9, 9), 255).save(stream, "PNG")
        content = stream.getvalue()
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(psl.PolyskelError) as refusal:
        psl.Shape.from_file(path)
    own = explore.explore(psl.datasets.load("gear"))
    uploaded(own, name, content)
    assert type(own.error) is refusal.type
    sentence = ElementTree.fromstring(own._status.value)
    assert sentence.text == str(refusal.value)
    assert sentence.get("role") == "alert"
    assert name in sentence.text
    assert own.chain is None
    assert not own._place.children
    with pytest.raises(psl.InputError, match="no shape yet"):
        own.files()
    own.load(psl.datasets.load("gear"))  # and on it goes
    assert own.error is None


@pytest.mark.parametrize("name", KINDS)
def test_files_with_errors_in_them_are_never_a_traceback(good, name, tmp_path):
    rng, path = random.Random(name), tmp_path / name
    for round in range(45):
        content = bytearray(good[name])
        at = rng.randrange(len(content))
        if round % 3 == 0:
            content = content[:at]
        elif round % 3 == 1:
            content[at] = rng.randrange(256)
        else:
            content[at:at] = rng.randbytes(5)
        path.write_bytes(content)
        with contextlib.suppress(psl.PolyskelError):  # and nothing else
            psl.Shape.from_file(path)


def test_numbers_of_corners_that_are_no_vertices_are_named(tmp_path):
    (tmp_path / "far.ply").write_bytes(BAD["far.ply"])
    with pytest.raises(psl.InputError, match=r"face 0 has the corners \[0, 1, 9\], and there are 3 vertices"):
        psl.Shape.from_file(tmp_path / "far.ply")


def test_names_of_files_are_text_and_stay_in_their_folder(good):
    own = explore.explore()
    uploaded(own, "../<b>bold.geojson", good["field.geojson"])
    assert own.error is None
    assert "<b>" not in own._status.value
    own.make.click()
    assert "<b>" not in own._links.value
    uploaded(own, "<img src=x>.docx", b"x")
    assert "<img" not in own._status.value


def test_large_files_and_large_shapes_are_refused(monkeypatch):
    own = explore.explore()
    uploaded(own, "large.png", bytes(bring_your_own.MOST_BYTES + 1))
    assert "megabytes" in own._status.value
    assert own.chain is None
    monkeypatch.setitem(bring_your_own.MOST_VERTICES, 2, 100)
    own.load(psl.datasets.load("gear"))
    assert str(own.error).startswith("shape has 500 vertices; up to 100 are quick enough")
    own.load(42)
    assert "cannot explore int" in str(own.error)


def test_options_read_the_uploaded_file_again(good):
    own = explore.explore()
    own.smooth.value = 0
    uploaded(own, "blob.png", good["blob.png"])
    first = own.chain.given
    own.smooth.value = 2
    assert len(own.chain.given.points) != len(first.points) or own.chain.given.area() != first.area()
    own.invert.value = True
    assert own.chain.given.betti() == (1, 1)
