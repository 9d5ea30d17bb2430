"""Every claim of the register `notebooks/claims.toml`, checked again from data.

``CHECKS[id]()`` computes and returns the verdict of one claim, and
``pytest "tests/claims/test_register.py::test_verdict[id]"`` compares it with the register.
"""

from . import (
    appendix_a,
    comparison,
    complexity,
    criteria,
    further,
    graphs,
    introduction,
    methods,
    polyballs,
    proof,
    removable,
    results,
    simplification,
)
from .registry import CHECKS, VERDICTS

__all__ = [
    "CHECKS",
    "VERDICTS",
    "appendix_a",
    "comparison",
    "complexity",
    "criteria",
    "further",
    "graphs",
    "introduction",
    "methods",
    "polyballs",
    "proof",
    "removable",
    "results",
    "simplification",
]
