"""Cylinders whose axes pass the crankshaft on both sides, each against an engine of its own."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.mechanism.mechanism import slider_crank

ROOT = Path(__file__).parents[2]
MACHINE = crankwork.read(ROOT / "examples/narrow-v6.toml")
DEGREES = np.arange(0.0, 720.0, 7.5)


@pytest.fixture(scope="module")
def results():
    return crankwork.analyse(MACHINE, crankwork.CrankGrid.from_degrees(DEGREES))


def test_the_torque_is_the_sum_of_engines_of_one_cylinder(results):
    total = np.zeros_like(DEGREES)
    for place, offset in zip(MACHINE.engine.layout.places, MACHINE.engine.offsets, strict=True):
        lengths = MACHINE.mechanism.crank.radius, MACHINE.mechanism.dyads[0].length, offset
        alone = crankwork.analyse(replace(MACHINE, mechanism=slider_crank(*lengths), engine=None))
        total += alone.columns_at((DEGREES - place.firing_angle) % 720, ["crank_torque"])["crank_torque"]
    assert results["total_torque"] == pytest.approx(total, abs=1e-12 * np.max(np.abs(total)))


def test_pistons_come_to_dead_centre_evenly_though_the_axes_do_not_meet_the_shaft(results):
    tops = np.sort(np.degrees(results.listings["firing"].columns["top_dead_centre_angle"]))
    assert np.diff(tops) == pytest.approx(120.0, abs=0.15)
    # rod and crank in line: sin of the angle from the axis is the offset over both
    own = np.degrees(np.arcsin(12.5 / (90.3 / 2 + 164)))
    assert tops[0] == pytest.approx(120 - own, abs=1e-9)


def test_the_engine_needs_one_offset_for_each_cylinder():
    text = (ROOT / "examples/narrow-v6.toml").read_text("utf-8")
    with pytest.raises(crankwork.InputError, match=r"engine\.offsets: has 5 entries; write one for each of the 6"):
        crankwork.read_machine(text.replace('offsets = ["-12.5 mm", ', "offsets = ["))
    with pytest.raises(crankwork.InputError, match=r"engine.offsets\[2\]"):
        crankwork.read_machine(text.replace('["-12.5 mm", "12.5 mm"', '["-12.5 mm", "125 mm"'))
    with pytest.raises(crankwork.InputError, match=r"cylinder\.offset"):
        crankwork.read_machine(text.replace('bore = "81 mm"', 'bore = "81 mm"\noffset = "1 mm"'))
