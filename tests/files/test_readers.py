"""Arrays, and what every reader of files does."""

import numpy as np
import pytest

from polyskel_lite import InputError, PolyskelError, Shape, datasets


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
