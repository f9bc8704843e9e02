"""No step of a table changes a single value."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from crankwork import analyse, read, read_machine, template, template_names
from crankwork.kinematics.crank_grid import CrankGrid

EXAMPLES = Path(__file__).parents[2] / "examples"
# of each structure one; the others take longer
FEW = {
    "spark-engine", "petrol-four", "radial-five", "two-stroke", "atkinson", "excavator-boom", "press-geometry",
    "crank-shaper", "four-bar", "turning-moment",
}  # fmt: skip
OTHERS = {path.stem for path in EXAMPLES.glob("*.toml")} | set(template_names())


@pytest.mark.slow
@pytest.mark.parametrize("names", [FEW, pytest.param(OTHERS - FEW, marks=pytest.mark.slow)], ids=["few", "others"])
def test_single_values_are_the_same_from_tables_of_1_7_and_30_degrees(names):
    wrong = {}
    for name in sorted(names):
        path = EXAMPLES / f"{name}.toml"
        machine = read(path) if path.exists() else read_machine(template(name))
        if machine.transfer is not None:
            continue
        first, *others = (analyse(machine, CrankGrid.steps(step, machine.cycle)).summary for step in (1.0, 7.0, 30.0))
        for other in others:
            assert other.keys() == first.keys(), name
            unlike = {
                key for key, one in first.items() if other[key] != pytest.approx(one, rel=1e-9, abs=1e-12, nan_ok=True)
            }
            wrong |= {name: unlike} if unlike else {}
    assert wrong == {}


def test_a_table_that_misses_the_peak_does_not_lower_it():
    results = analyse(read(EXAMPLES / "spark-engine.toml"), CrankGrid.from_degrees([0.0, 700.0]))
    assert results.summary["crank_torque_max"] > 4 * np.max(results.columns["crank_torque"])
