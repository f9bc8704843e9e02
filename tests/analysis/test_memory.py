"""The memory of one cylinder: replayed key by key it is the columns of the analysis."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.formula.replay import replay

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_every_column_is_the_replay_of_its_memory_and_what_does_not_vary_is_in_the_summary() -> None:
    """Of pressures through points, a petrol and a diesel cycle, ports, offsets of both signs and articulated rods."""
    wrong = {}
    for name, method in (
        ("spark-engine", "textbook"),
        ("petrol-four", "exact"),
        ("v8-diesel", "series:6"),
        ("two-stroke", "exact"),
        ("narrow-v6", "exact"),
        ("radial-five", "textbook"),
    ):
        machine = crankwork.read(EXAMPLES / f"{name}.toml")
        results = crankwork.analyse(crankwork.with_method(machine, method))
        compared = [key for key in results.columns if key in results.trace]
        assert {"crank_angle", "piston_displacement", "piston_acceleration", "rod_angle"} <= set(compared), name
        for key in compared:
            column, again = results.columns[key], replay(results.trace[key], results.grid)
            if not np.all(np.abs(again - column) <= 2 * np.spacing(np.abs(column))):
                wrong[name, key] = column, again
        for key, value in results.summary.items():
            known = results.trace.get(key)
            if known is not None and not known.varies and known.value != pytest.approx(value, rel=1e-12):
                wrong[name, key] = value, known.value
    assert wrong == {}
