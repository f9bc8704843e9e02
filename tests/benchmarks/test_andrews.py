"""The motion of Andrews' mechanism, compiled: where the test set says.

Not among the tests that mutants of formulas are tried on: what is compiled is read from the source of a formula.
"""

from __future__ import annotations

import runpy
import types
from pathlib import Path

import numpy as np
import pytest


@pytest.mark.compiled
def test_angles_and_rates_at_the_end(tmp_path, monkeypatch):
    """Compiled polynomials follow columns to 1e-12, those of an analysis to rounding."""
    monkeypatch.setenv("CRANKWORK_CACHE", str(tmp_path))
    andrews = types.SimpleNamespace(**runpy.run_path(str(Path(__file__).parents[2] / "benchmarks" / "andrews.py")))
    moment = andrews.Moment(*andrews.kernel()(andrews.designs(1)).values[:, 0].tolist())
    angles, rates = andrews.coordinates(moment)
    assert angles == pytest.approx(np.array(andrews.ANGLES), rel=1e-13)
    assert rates == pytest.approx(np.array(andrews.RATES), rel=5e-12)
