"""Points that are drawn at random for property tests."""

import numpy as np
from hypothesis import strategies as st


def distinct(n, least, most):
    """Different points of a lattice in n dimensions: cocircular and cospherical sets are the rule."""
    return st.lists(st.tuples(*[st.integers(0, 4)] * n), min_size=least, max_size=most, unique=True).map(
        lambda points: np.array(points, dtype=float)
    )
