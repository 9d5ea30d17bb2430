"""Open files, and files in an archive or in memory: put on disk for as long as they are read."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..checks import shown
from ..errors import InputError


@contextmanager
def on_disk(stream, name: str | None = None) -> Iterator[Path]:
    """The path of a copy of an open file.

    Parameters
    ----------
    stream : object with ``read()``
        Of bytes or text.
    name : str, optional
        What it is called, with the suffix that says what is in it; by default ``stream.name``.

    Examples
    --------
    >>> import io
    >>> with on_disk(io.BytesIO(b"OFF"), "part.off") as path:
    ...     path.name, path.read_text()
    ('part.off', 'OFF')
    """
    called = getattr(stream, "name", None) if name is None else name
    if not isinstance(called, str) or not (called := Path(called).name) or len(called) > 200:
        raise InputError(f'the open file is called {shown(called)}; pass its name, such as name="a.svg".')
    try:
        content = stream.read()
    except Exception as error:  # closed, or open for writing only
        raise InputError(f"{called[:60]} cannot be read ({error}); open it for reading.") from None
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / called
        path.write_bytes(
            content.encode("utf-8", "surrogatepass") if isinstance(content, str) else bytes(content)
        )
        yield path
