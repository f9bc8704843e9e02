"""Every machine file meets the checks of its analysis, by every method that it can have."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import crankwork

ROOT = Path(__file__).parents[2]
MACHINES = (
    ROOT / "examples",
    ROOT / "src/crankwork/description/templates",
    ROOT / "tests/machines",
    ROOT / "tests/literature/assignments",
)
FILES = sorted(path.relative_to(ROOT).as_posix() for folder in MACHINES for path in folder.glob("*.toml"))


@pytest.mark.checks
@pytest.mark.parametrize("file", FILES)
def test_checks_hold(file: str) -> None:
    machine = crankwork.read(ROOT / file)
    # whole engines and linkages have the method of their file alone
    methods = ("exact", "textbook", "series:4") if machine.lengths and machine.engine is None else (None,)
    wrong = {}
    for method in methods:
        results = crankwork.analyse(machine if method is None else crankwork.with_method(machine, method))
        # a residual that is no number is not below any bound either
        if results.unmet or not all(np.isfinite(one) for one in results.checks.values()):
            wrong[method] = results.unmet
    assert wrong == {}
