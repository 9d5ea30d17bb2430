"""Settings of the whole suite: property tests try the same examples on every machine."""

import matplotlib
import pytest
from hypothesis import settings

matplotlib.use("Agg")
settings.register_profile("suite", derandomize=True, deadline=None, max_examples=60, database=None)
settings.load_profile("suite")
pytest.register_assert_rewrite("truth")  # asserts shared by tests say as much as those in tests
