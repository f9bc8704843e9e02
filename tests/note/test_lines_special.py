"""Worked steps of machines that are special: measured pressure, a linkage that cannot turn fully."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from crankwork import analyse, read_machine, template
from crankwork.formula.lines import ValueLine
from crankwork.loads.measured import MeasuredPressure


def test_a_measured_pressure_is_given_and_not_calculated(groups_of):
    machine = read_machine(template("engine"))
    degrees = np.arange(721.0)
    pressure = 1e5 + 3e6 * np.exp(-(((degrees - 372) / 25) ** 2))
    measured = MeasuredPressure(degrees, pressure, range(2, 723))
    results = analyse(replace(machine, gas=replace(machine.gas, points={}, pieces=(), measured=measured)))
    groups = {group.name: group for group in groups_of(results)}
    read = next(step for step in groups["forces"].lines if step.key == "diagram_pressure")
    assert isinstance(read, ValueLine)
    assert read.value == pytest.approx(pressure[390], rel=1e-12)
    assert {step.key for step in groups["gas"].lines} == {
        "piston_area", "swept_volume", "clearance_volume", "compression_ratio",
    }  # fmt: skip
    row = int(np.argmin(np.abs(results.grid.degrees - 390.0)))
    for step in groups["forces"].lines:
        if step.key in results.columns:
            assert step.value == pytest.approx(results.columns[step.key][row], rel=1e-12), step.key
    for step in groups["power"].lines:
        assert step.value == pytest.approx(results.summary[step.key], rel=1e-12), step.key


@pytest.mark.parametrize(("wanted", "shown"), [(30.0, 30.0), (300.0, 100.0), (0.0, 20.0)])
def test_a_linkage_that_cannot_turn_fully_is_shown_where_it_is(wanted, shown, groups_of):
    results = analyse(read_machine(template("four-bar").replace('"62.5 mm"', '"150 mm"')))
    assert [notice.code for notice in results.notices] == ["partial", "unbounded", "transmission", "transmission"]
    groups = groups_of(results, wanted)
    angles = [one.degrees for one in groups if one.degrees is not None]
    assert angles == pytest.approx([shown] * 7)
    row = int(np.argmin(np.abs(results.grid.degrees - shown)))
    compared = 0
    for group in groups:
        for step in group.lines:
            if step.key in results.columns:
                assert step.value == pytest.approx(results.columns[step.key][row], rel=1e-12, abs=1e-300), step.key
                compared += 1
    assert compared > 10
