"""What all tests share: random examples that are the same on every run, and pictures drawn without a window."""

import matplotlib
from hypothesis import settings

matplotlib.use("agg")

# The same examples everywhere: a failure on one machine is a failure on all. Exact arithmetic has no fixed pace,
# so no deadline.
settings.register_profile("book", derandomize=True, deadline=None, print_blob=True)
settings.load_profile("book")
