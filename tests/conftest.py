"""Settings of the whole suite: property tests try the same examples on every machine."""

import matplotlib
from hypothesis import settings

matplotlib.use("Agg")
settings.register_profile("suite", derandomize=True, deadline=None, max_examples=60, database=None)
settings.load_profile("suite")
