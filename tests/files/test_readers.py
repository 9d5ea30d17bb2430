"""Arrays, and what every reader of files does."""

import io
import zipfile

import numpy as np
import pytest

from polyskel_lite import InputError, PolyskelError, Shape, Skeleton, datasets, sk0


def test_npz_of_both_kinds(tmp_path):
    shape = datasets.load("lake")
    np.savez(tmp_path / "a.npz", points=shape.points, facets=shape.facets)
    again = Shape.from_file(tmp_path / "a.npz")
    assert (again.points == shape.points).all()
    assert (again.facets == shape.facets).all()
    off = np.cumsum([0, *map(len, shape.rings())])
    np.savez(tmp_path / "b.npz", xy=shape.points, off=off)
    assert Shape.from_file(tmp_path / "b.npz").betti() == (1, 2)


def test_bad_npz(tmp_path):
    np.savez(tmp_path / "a.npz", V=np.zeros((3, 3)))
    with pytest.raises(InputError, match=r"a\.npz: its arrays are V; it needs points and facets"):
        Shape.from_file(tmp_path / "a.npz")
    np.savez(tmp_path / "b.npz", xy=np.zeros((3, 2)), off="words")
    with pytest.raises(InputError, match="not a file of arrays"):
        Shape.from_file(tmp_path / "b.npz")
    (tmp_path / "c.npz").write_text("words")
    with pytest.raises(InputError, match="not a file of arrays"):
        Shape.from_file(tmp_path / "c.npz")
    with (tmp_path / "d.npz").open("wb") as stream:
        np.save(stream, np.zeros(3))
    with pytest.raises(InputError, match="not a file of arrays"):
        Shape.from_file(tmp_path / "d.npz")


@pytest.mark.parametrize("suffix", [".geojson", ".svg", ".png", ".npz"])
def test_missing_empty_and_folder(tmp_path, suffix):
    path = tmp_path / f"a{suffix}"
    with pytest.raises(InputError, match="no such file"):
        Shape.from_file(path)
    path.touch()
    with pytest.raises(InputError, match="the file is empty"):
        Shape.from_file(str(path))
    path.unlink()
    path.mkdir()
    with pytest.raises(PolyskelError, match="no such file"):
        Shape.from_file(path)


@pytest.mark.parametrize("name", ["outline.xyz", "outline"])
def test_unknown_suffix(tmp_path, name):
    with pytest.raises(InputError, match=r"no reader for .*; it reads \.geojson, \.json, \.svg"):
        Shape.from_file(tmp_path / name)


@pytest.mark.parametrize("read", [Shape.from_file, Skeleton.load])
def test_npz_that_says_more_than_it_has(tmp_path, read):
    """Two lines that claim 16 GB: refused before anything is allocated."""
    header = io.BytesIO()
    claim = {"descr": "<f8", "fortran_order": False, "shape": (10**9, 2)}
    np.lib.format.write_array_header_1_0(header, claim)
    with zipfile.ZipFile(tmp_path / "a.npz", "w") as archive:
        archive.writestr("points.npy", header.getvalue() + b"few")
    with pytest.raises(InputError, match="points says that it has 16,000,000,000 bytes, and it has 3"):
        read(tmp_path / "a.npz")


@pytest.mark.parametrize("off", [[0, 2.5, 4], [1, 4], [0, 5], [0, 4, 4], [], 4])
def test_npz_with_wrong_offsets(tmp_path, off):
    np.savez(tmp_path / "a.npz", xy=np.zeros((4, 2)), off=off)
    with pytest.raises(InputError, match="off must say where each ring begins"):
        Shape.from_file(tmp_path / "a.npz")


@pytest.mark.parametrize("path", [None, 3, True, [], "", b"a.png", "a\0.png", object()])
def test_what_is_no_path(path):
    shape = datasets.load("gear")
    for call in (Shape.from_file, Skeleton.load, shape.to_file, sk0(shape).save, sk0(shape).to_file):
        with pytest.raises(InputError, match=r"path is .*; pass the name of a file"):
            call(path)


def test_folders_that_are_not_there(tmp_path):
    skeleton = sk0(datasets.load("gear"))
    for call, name in ((skeleton.save, "a.npz"), (skeleton.to_file, "a.ply"), (skeleton.to_file, "a.glb")):
        with pytest.raises(InputError, match=f"{name} cannot be written"):
            call(tmp_path / "nowhere" / name)
