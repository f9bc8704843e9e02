"""Closed-form dyads are worth having: many times faster than solving the loops numerically."""

from __future__ import annotations

import runpy
from pathlib import Path


def test_dyads_are_twenty_times_faster_than_batched_newton() -> None:
    benchmark = runpy.run_path(str(Path(__file__).parents[2] / "benchmarks" / "linkage_motion.py"))
    assert benchmark["ratio"]() >= 20
