"""Values at an angle are those of the whole analysis, however little of it they take."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis import analyse, columns_only

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
