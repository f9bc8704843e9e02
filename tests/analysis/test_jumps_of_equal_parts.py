"""Extremes before jumps of parts whose angles a file states by rounded coordinates."""

from pathlib import Path

import pytest

import crankwork
from each import for_each

PUMP = Path(__file__).parents[2].joinpath("examples", "triplex-pump.toml").read_text("utf-8")


@for_each("rod", ["rod_1", "rod_2", "rod_3"])
def test_the_largest_force_before_any_of_three_jumps_is_found(rod: str) -> None:
    # the pins stand at 120 degrees to nine digits; the force falls there from 5.0 to 2.0 kN
    stated = crankwork.Description(PUMP)
    stated.replace({f"links.{rod}.length": "290 mm"})
    results = crankwork.analyse(stated.machine())
    before_jumps = [results.value("joint_force.O", degrees - 1e-7) for degrees in (120.0, 240.0, 360.0)]
    assert results["joint_force_max.O"] == pytest.approx(max(before_jumps), rel=1e-8)
