"""The memory of one cylinder: replayed key by key it is the columns of the analysis."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.formula.replay import replay

EXAMPLES = Path(__file__).parents[2] / "examples"
MACHINES = {path.stem: crankwork.read(path) for path in sorted(EXAMPLES.glob("*.toml"))}
ENGINES = {name: one for name, one in MACHINES.items() if one.lengths}


@pytest.mark.parametrize("method", ["exact", "textbook", "series:6"])
@pytest.mark.parametrize("name", ENGINES)
def test_every_column_is_the_replay_of_its_memory(name: str, method: str) -> None:
    results = crankwork.analyse(crankwork.with_method(ENGINES[name], method))
    compared = [key for key in results.columns if key in results.memory]
    assert {"crank_angle", "piston_displacement", "piston_acceleration", "rod_angle"} <= set(compared)
    for key in compared:
        column, again = results.columns[key], replay(results.memory[key], results.grid)
        assert np.all(np.abs(again - column) <= 2 * np.spacing(np.abs(column))), key


@pytest.mark.parametrize("name", ENGINES)
def test_what_does_not_vary_is_what_the_summary_says(name: str) -> None:
    results = crankwork.analyse(ENGINES[name])
    for key, known in results.memory.items():
        if not known.varies and key in results.summary:
            assert known.value == pytest.approx(results.summary[key], rel=1e-12), key
