"""Cylinders whose axes pass the crankshaft on both sides, each against an engine of its own."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis.cylinders import multi_cylinder_engine

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
    assert results.trace["firing_interval"].value == pytest.approx(np.radians(120.0), rel=1e-15)
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


DIAGRAM = """
[gas]
cycle = "720 deg"
pressures = "absolute"
ambient = "0.1 MPa"
pieces = [
    { law = "constant", points = ["r", "a"] },
    { law = "polytropic", points = ["a", "c"], exponent = 1.35 },
    { law = "rounded", points = ["c", "z", "m"] },
    { law = "polytropic", points = ["m", "b"], exponent = 1.25 },
    { law = "constant", points = ["s", "t"] },
]
[gas.points]
r = { angle = "0 deg", pressure = "0.09 MPa" }
a = { angle = "180 deg", pressure = "0.09 MPa" }
c = { angle = "350 deg" }
z = { angle = "370 deg", pressure = "5 MPa" }
m = { angle = "385 deg", pressure = "4.5 MPa" }
b = { angle = "540 deg" }
s = { angle = "540 deg", pressure = "0.11 MPa" }
t = { angle = "720 deg", pressure = "0.11 MPa" }
"""
MEASURED = """
[gas]
cycle = "720 deg"
pressures = "absolute"
ambient = "0.1 MPa"
[gas.measured]
file = "pressure.csv"
"""


def with_gas(gas: str) -> str:
    """Return the narrow V with a gas in the place of the calculated cycle."""
    text = (ROOT / "examples/narrow-v6.toml").read_text("utf-8")
    first, last = text.index("[cycle]"), text.index("[bearings]")
    return text[:first] + gas + text[last:]


def test_stated_pressures_stand_at_the_dead_centre_of_each_cylinder(tmp_path):
    """The greatest pressure comes 10 degrees after the piston has turned back: as often as the engine fires."""
    degrees = np.arange(0.0, 720.0, 1.0)
    rows = "\n".join(f"{at:g},{0.1 + 4.9 * np.exp(-(((at - 370) / 40) ** 2)):.9f}" for at in degrees)
    (tmp_path / "pressure.csv").write_text(f"angle,pressure\n{rows}\n", "utf-8")
    (tmp_path / "measured.toml").write_text(with_gas(MEASURED + 'pressure_unit = "MPa"\n'), "utf-8")
    for machine in (crankwork.read_machine(with_gas(DIAGRAM)), crankwork.read(tmp_path / "measured.toml")):
        found = crankwork.analyse(machine)
        whole, fine = multi_cylinder_engine(found.solved), np.arange(0.0, 720.0, 0.01)
        peaks = fine[whole.each("gas_pressure", fine).argmax(axis=1)]
        order = [number - 1 for number in machine.engine.layout.firing_order]
        tops = np.degrees(found.listings["firing"].columns["top_dead_centre_angle"])
        assert (peaks - tops) % 360 == pytest.approx(10.0, abs=0.011)
        between = np.diff([*peaks[order], peaks[0] + 720]) % 720
        intervals = np.degrees(found.listings["firing"].columns["firing_interval"])
        assert between == pytest.approx(intervals[order], abs=0.021)
        assert found.unmet == ()


def test_one_offset_for_all_moves_no_diagram():
    """Crank angles count from the axis of the cylinder, and so does its diagram."""
    text = with_gas(DIAGRAM).replace('["-12.5 mm", "12.5 mm", "-12.5 mm", "12.5 mm", "-12.5 mm", "12.5 mm"]', "[]")
    machine = crankwork.read_machine(
        text.replace("offsets = []", "").replace('bore = "81 mm"', 'bore = "81 mm"\noffset = "9 mm"')
    )
    whole, fine = multi_cylinder_engine(crankwork.analyse(machine).solved), np.arange(0.0, 720.0, 0.05)
    assert fine[whole.each("gas_pressure", fine)[0].argmax()] == pytest.approx(370.0, abs=0.051)


def test_designs_have_their_diagrams_at_their_own_dead_centres():
    description = crankwork.Description(with_gas(DIAGRAM))
    lengths, keys = [0.150, 0.164, 0.180], ["gas_pressure_max_angle", "indicated_work", "crank_torque_max"]
    found = crankwork.sweep(description, {"rod.length": lengths}, keys)
    assert found.reason == ""
    for at, length in enumerate(lengths):
        alone = crankwork.analyse(crankwork.read_machine(with_gas(DIAGRAM), overrides=[f"rod.length={length} m"]))
        for key in keys:
            assert found.values[key][at] == pytest.approx(alone.summary[key], rel=1e-9), key
