"""What all tests share: random examples that are the same on every run, pictures drawn without a window."""

import matplotlib
from hypothesis import settings

matplotlib.use("agg")

# The same examples everywhere, so that a failure on one machine is a failure on all; no deadline, because exact
# arithmetic has no fixed pace.
settings.register_profile("book", derandomize=True, deadline=None, print_blob=True)
settings.load_profile("book")
