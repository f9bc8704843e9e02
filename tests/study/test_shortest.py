"""Values at an angle are those of the whole analysis, however little of it they take."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis import analyse, columns_only, value_only

MACHINES = {
    path.stem: path
    for folder in (
        Path(crankwork.__file__).parent / "description" / "templates",
        Path(__file__).parents[1] / "machines",
    )
    for path in sorted(folder.glob("*.toml"))
}
# the others take longer
FEW = {"engine", "v-two", "press", "elbow", "turning-moment"}


def apart(machine):
    """Return keys whose values are not those of the whole analysis."""
    whole, short = analyse(machine), columns_only(machine)
    angle = float(whole.grid.degrees[len(whole.grid) // 3])
    keys = [key for key, known in short.trace.items() if known.varies and key in whole.trace]
    one, other = whole.columns_at([angle], keys), short.columns_at([angle], keys)
    unlike = {key for key in keys if not np.allclose(one[key], other[key], rtol=1e-9, atol=1e-11, equal_nan=True)}
    found = {}
    for name in {key.partition(".")[2] for key in whole.summary}:
        of_one = value_only(machine, f".{name}").summary
        found |= {key: one for key, one in of_one.items() if key.partition(".")[2] == name}
    for key, one in found.items():
        # where an extreme stands is found to less
        near = 1e-7 if key.partition(".")[0].endswith(("_angle", "_time")) else 1e-9
        if one != pytest.approx(whole.summary[key], rel=near, abs=near):
            unlike.add(key)
    # what was measured on a test bed has no columns
    return unlike if (keys or not whole.columns) and len(found) > len(whole.summary) / 3 else {"too few values"}


@pytest.mark.parametrize("names", [FEW, pytest.param(set(MACHINES) - FEW, marks=pytest.mark.slow)], ids=["few", "rest"])
def test_columns_and_single_values_alone_are_those_of_the_whole_analysis(names):
    wrong = {name: found for name in sorted(names) if (found := apart(crankwork.read(MACHINES[name])))}
    assert wrong == {}
