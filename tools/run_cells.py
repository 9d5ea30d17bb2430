"""Run the cells of one notebook in a process of its own, and say after each what it came to.

THIS RUNS STRANGERS' CODE AND IS NO SANDBOX: use a container or a throw-away account.
"""

import contextlib
import io
import os
import tempfile
from multiprocessing.connection import Connection

from IPython.core.interactiveshell import ExecutionResult, InteractiveShell
from traitlets.config import Config

MEMORY = 6 * 2**30


def limit_memory() -> None:
    """For this process and all that it starts, where the system can."""
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def run_cells(sources: list[str], environment: dict[str, str], report: Connection) -> None:
    """Send that it has begun, then ``(points, message)`` for each cell; None is all points the cell has."""
    report.send("begun")
    limit_memory()
    for stream in (1, 2):  # what does not go through sys.stdout
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream)
    for name in [name for name in os.environ if name.startswith("POLYSKEL")]:
        del os.environ[name]  # of the process that this one was forked from, which may be of an earlier hour
    os.environ.update(environment)
    settings = Config()
    settings.HistoryManager.enabled = False
    settings.InteractiveShell.colors = "NoColor"
    shell = InteractiveShell.instance(config=settings)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        os.chdir(folder)
        for source in sources:
            out, err = io.StringIO(), io.StringIO()
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                result = shell.run_cell(source, store_history=False)
            points, message = _points(result, out.getvalue(), err.getvalue())
            report.send((points, message[:2000]))
        os.chdir(os.sep)


def _points(result: ExecutionResult, printed: str, complaints: str) -> tuple[float | None, str]:
    """nbgrader's rule: nothing for an error or words on stderr, else the number shown, else all (None)."""
    if error := result.error_before_exec or result.error_in_exec:
        return 0, f"{type(error).__name__}: {error}"
    if complaints:
        return 0, f"on stderr: {complaints}"
    try:
        return (None if result.result is None else float(repr(result.result))), printed
    except ValueError:
        return None, printed
