"""Cylinders whose axes pass the crankshaft on both sides, each against an engine of its own."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import crankwork

ROOT = Path(__file__).parents[2]
MACHINE = crankwork.read(ROOT / "examples/narrow-v6.toml")
DEGREES = np.arange(0.0, 720.0, 7.5)
# rod and crank in line: sine of the angle from the axis is the offset over both
OWN = np.degrees(np.arcsin(12.5 / (90.3 / 2 + 164)))


@pytest.fixture(scope="module")
def results():
    return crankwork.analyse(MACHINE, crankwork.CrankGrid.from_degrees(DEGREES))


def test_pistons_come_to_dead_centre_evenly_though_the_axes_do_not_meet_the_shaft(results):
    tops = np.sort(np.degrees(results.listings["firing"].columns["top_dead_centre_angle"]))
    assert np.diff(tops) == pytest.approx(120.0, abs=0.15)
    assert tops[0] == pytest.approx(120 - OWN, abs=1e-9)


def test_cylinders_fire_at_their_own_dead_centres(results):
    order, found = MACHINE.engine.layout.firing_order, results.listings["firing"].columns["firing_interval"]
    # the throws of the banks stand 22 degrees apart, their axes 15, and an offset moves a dead centre on each side
    apart = 15 + 2 * OWN - 22
    wanted = {1: 120.0, 5: 120.0, 3: 120.0 + apart, 6: 120.0, 2: 120.0, 4: 120.0 - apart}
    assert np.degrees(found) == pytest.approx([wanted[number] for number in sorted(order)], abs=1e-9)


def test_throws_of_even_firing_stand_as_dead_centres_do():
    text = (ROOT / "examples/narrow-v6.toml").read_text("utf-8")
    machine = crankwork.read_machine(
        "\n".join(line for line in text.splitlines() if line[:6] not in ("throws", "uneven"))
    )
    results = crankwork.analyse(machine)
    pins = [place.pin_angle for place in machine.engine.layout.places]
    assert pins == pytest.approx([0, 240 + 15 + 2 * OWN, 120, 120 + 15 + 2 * OWN, 240, 15 + 2 * OWN], abs=1e-9)
    assert results.memory["firing_interval"].value == pytest.approx(np.radians(120.0), rel=1e-15)
    tops = np.sort(np.degrees(results.listings["firing"].columns["top_dead_centre_angle"]))
    assert np.diff(tops) == pytest.approx(120.0, abs=1e-9)


def test_the_engine_needs_one_offset_for_each_cylinder():
    text = (ROOT / "examples/narrow-v6.toml").read_text("utf-8")
    with pytest.raises(crankwork.InputError, match=r"engine\.offsets: has 5 entries; write one for each of the 6"):
        crankwork.read_machine(text.replace('offsets = ["-12.5 mm", ', "offsets = ["))
    with pytest.raises(crankwork.InputError, match=r"engine.offsets\[2\]"):
        crankwork.read_machine(text.replace('["-12.5 mm", "12.5 mm"', '["-12.5 mm", "125 mm"'))
    with pytest.raises(crankwork.InputError, match=r"cylinder\.offset"):
        crankwork.read_machine(text.replace('bore = "81 mm"', 'bore = "81 mm"\noffset = "1 mm"'))
