"""How pytest --nbval runs the chapters.

nbval executes cells without history, and IPython looks up the ``;`` that ends a plot cell in the history:
without this file every such cell would gain a line ``<Axes: >``. Jupyter keeps history, so nbval does here.
"""

from nbval.kernel import RunningKernel

collect_ignore_glob = ["course/a[0-9]_*.ipynb"]  # assignments have no outputs; tests/coursework runs them


def execute_with_history(kernel, cell_input, allow_stdin=None):
    """Do what ``RunningKernel.execute_cell_input`` does, with history as in Jupyter."""
    return kernel.kc.execute(cell_input, store_history=True, allow_stdin=allow_stdin, stop_on_error=False)


def pytest_collectstart(collector):
    """Pictures made of lines are no more compared than pictures made of pixels; tests/figures does that."""
    if hasattr(collector, "skip_compare"):
        collector.skip_compare += ("image/svg+xml",)


def pytest_configure(config):
    RunningKernel.execute_cell_input = execute_with_history
