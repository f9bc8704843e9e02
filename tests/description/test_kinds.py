"""Kinds of values, and what they say when a value is refused."""

from __future__ import annotations

import pytest

from crankwork import units
from crankwork.description.kinds import Measure, Quantity, Reader

LIMITS = [(1e-6, 30000.0), (1 / 3, 200 / 7), (1e-4, 123456.7)]


@pytest.mark.parametrize(("low", "high"), LIMITS)
@pytest.mark.parametrize("dimension", sorted(units.EXAMPLES))
def test_the_limits_that_a_refusal_tells_may_be_written(dimension: str, low: float, high: float) -> None:
    kind = Quantity((dimension,), low, high)
    unit = units.EXAMPLES[dimension].split()[1]
    told = dict(kind._out_of_range(f"1e9 {unit}", dimension).values)
    for limit in (told["low"], told["high"]):
        assert isinstance(kind.read(limit.strip('"'), "key", Reader()), Measure), limit
