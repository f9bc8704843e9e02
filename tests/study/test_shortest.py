"""Values at an angle are those of the whole analysis, however little of it they take."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis import analyse, columns_only, value_only

MACHINES = sorted(
    [*(Path(crankwork.__file__).parent / "description" / "templates").glob("*.toml"),
     *(Path(__file__).parents[1] / "machines").glob("*.toml")]
)  # fmt: skip


@pytest.mark.parametrize("path", MACHINES, ids=lambda path: path.stem)
def test_columns_alone_are_those_of_the_whole_analysis(path):
    machine = crankwork.read(path)
    whole, short = analyse(machine), columns_only(machine)
    angle = float(whole.grid.degrees[len(whole.grid) // 3])
    keys = [key for key, known in short.memory.items() if known.varies and key in whole.memory]
    assert keys
    one, other = whole.columns_at([angle], keys), short.columns_at([angle], keys)
    unlike = {key for key in keys if not np.allclose(one[key], other[key], rtol=1e-9, atol=1e-11, equal_nan=True)}
    assert unlike == set()


@pytest.mark.parametrize("path", MACHINES, ids=lambda path: path.stem)
def test_a_single_value_alone_is_that_of_the_whole_analysis(path):
    machine = crankwork.read(path)
    whole, found = analyse(machine).summary, {}
    for name in {key.partition(".")[2] for key in whole}:
        of_one = value_only(machine, f".{name}").summary
        found |= {key: one for key, one in of_one.items() if key.partition(".")[2] == name}
    assert len(found) > len(whole) / 3
    # where an extreme stands is found to less
    near = {
        key: 1e-7 if "_angle." in key or "_time." in key or key.endswith(("_angle", "_time")) else 1e-9 for key in found
    }
    assert {
        key for key, one in found.items() if one != pytest.approx(whole[key], rel=near[key], abs=near[key])
    } == set()
