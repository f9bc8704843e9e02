"""No step of a table changes a single value."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from crankwork import analyse, read, read_machine, template, template_names
from crankwork.kinematics.crank_grid import CrankGrid

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))
MACHINES = {
    **{path.stem: read(path) for path in EXAMPLES},
    **{f"template-{name}": read_machine(template(name)) for name in template_names()},
}


@pytest.mark.parametrize("name", [name for name, one in MACHINES.items() if one.transfer is None])
def test_single_values_are_the_same_from_tables_of_1_7_and_30_degrees(name):
    machine = MACHINES[name]
    first, *others = (analyse(machine, CrankGrid.steps(step, machine.cycle)).summary for step in (1.0, 7.0, 30.0))
    for other in others:
        assert other.keys() == first.keys()
        for key, value in first.items():
            assert other[key] == pytest.approx(value, rel=1e-9, abs=1e-12, nan_ok=True), key


def test_a_table_that_misses_the_peak_does_not_lower_it():
    results = analyse(MACHINES["spark-engine"], CrankGrid.from_degrees([0.0, 700.0]))
    assert results.summary["crank_torque_max"] > 4 * np.max(results.columns["crank_torque"])
