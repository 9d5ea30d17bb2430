"""Arrays from NumPy's ``.npz`` files: what a file says of itself is checked before anything is allocated."""

from __future__ import annotations

import math
import zipfile
from pathlib import Path

import numpy as np

from ..errors import InputError

#: Bytes in all arrays of a file together: more than the tessellation of two million points takes.
MOST_BYTES = 2**30
_HEADERS = {
    (1, 0): np.lib.format.read_array_header_1_0,
    (2, 0): np.lib.format.read_array_header_2_0,
}


def read_arrays(path: Path) -> dict[str, np.ndarray]:
    """Read all arrays of a ``.npz`` file; all of them have to be numbers.

    Parameters
    ----------
    path : path

    Returns
    -------
    dict of str to array

    Raises
    ------
    InputError
        If the file is no such file, or damaged, or says that it holds more than it does, or more than
        `MOST_BYTES`.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "a.npz"
    ...     np.savez(file, points=np.eye(2))
    ...     read_arrays(file)["points"].tolist()
    [[1.0, 0.0], [0.0, 1.0]]
    """
    try:
        with zipfile.ZipFile(path) as archive:
            members = archive.infolist()
            _check(sum(member.file_size for member in members) <= MOST_BYTES, f"over {MOST_BYTES:,} bytes")
            return {member.filename.removesuffix(".npy"): _read(archive, member) for member in members}
    except Exception as error:  # zipfile and numpy raise whatever a broken file makes them stumble over
        what = error.strerror if isinstance(error, OSError) and error.strerror else error  # without the path
        raise InputError(f"not a file of arrays of numbers ({what}); save it with numpy.savez.") from error


def _read(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> np.ndarray:
    name = member.filename.removesuffix(".npy")
    with archive.open(member) as stream:
        shape, _, kind = _HEADERS[np.lib.format.read_magic(stream)](stream)
        left = member.file_size - stream.tell()
    _check(kind.kind in "biuf", f"{name} is an array of {kind}")
    claimed = math.prod(shape) * kind.itemsize
    _check(claimed == left, f"{name} says that it has {claimed:,} bytes, and it has {left:,}")
    with archive.open(member) as stream:
        array = np.lib.format.read_array(stream, allow_pickle=False)
        stream.read()  # the end, where the checksum is compared
    return array


def _check(good: bool, wrong: str) -> None:
    if not good:
        raise ValueError(wrong)
