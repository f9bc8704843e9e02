"""Worked steps of machines that are special: measured pressure, a linkage that cannot turn fully."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from crankwork import analyse, read_machine, template
from crankwork.analysis.steps import worked_steps
from crankwork.formula.steps import Given, all_steps
from crankwork.loads.measured import MeasuredPressure


def test_a_measured_pressure_is_given_and_not_calculated():
    machine = read_machine(template("engine"))
    degrees = np.arange(721.0)
    pressure = 1e5 + 3e6 * np.exp(-(((degrees - 372) / 25) ** 2))
    measured = MeasuredPressure(degrees, pressure, range(2, 723))
    results = analyse(replace(machine, gas=replace(machine.gas, points={}, pieces=(), measured=measured)))
    groups = {group.name: group for group in worked_steps(results)}
    read = next(step for step in groups["forces"].steps if step.key == "diagram_pressure")
    assert isinstance(read, Given)
    assert read.value == pytest.approx(pressure[390], rel=1e-12)
    assert {step.key for step in groups["gas"].steps} == {
        "piston_area", "swept_volume", "clearance_volume", "compression_ratio",
    }  # fmt: skip
    row = int(np.argmin(np.abs(results.grid.degrees - 390.0)))
    for step in groups["forces"].steps:
        if step.key in results.columns:
            assert step.value == pytest.approx(results.columns[step.key][row], rel=1e-12), step.key
    for step in groups["power"].steps:
        assert step.value == pytest.approx(results.summary[step.key], rel=1e-12), step.key


@pytest.mark.parametrize(("wanted", "shown"), [(30.0, 30.0), (300.0, 100.0), (0.0, 20.0)])
def test_a_linkage_that_cannot_turn_fully_is_shown_where_it_is(wanted, shown):
    results = analyse(read_machine(template("four-bar").replace('"62.5 mm"', '"150 mm"')))
    assert [notice.code for notice in results.notices] == ["partial"]
    groups = worked_steps(results, crank_angle=wanted)
    angles = [math.degrees(one.crank_angle) for one in groups if one.crank_angle is not None]
    assert angles == pytest.approx([shown] * 5)
    row = int(np.argmin(np.abs(results.grid.degrees - shown)))
    compared = 0
    for group in groups:
        for step in all_steps(group.steps):
            if step.key in results.columns:
                assert step.value == pytest.approx(results.columns[step.key][row], rel=1e-12, abs=1e-300), step.key
                compared += 1
    assert compared > 10
