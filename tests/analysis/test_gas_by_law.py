"""Gas on sliding pieces of a linkage whose driver follows a law over time."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import crankwork

TEXT = (Path(__file__).parents[1] / "machines/gas-by-law.toml").read_text("utf-8")
DEGREES = np.arange(0.5, 360.0, 1.0)
AREA = math.pi * 0.04**2 / 4


def without(text, *names):
    """Return the machine without some of its tables."""
    kept, drop = [], False
    for line in text.split("\n"):
        if line.startswith("["):
            drop = any(f"{name}]" in line or f"{name}." in line for name in names)
        kept += [] if drop else [line]
    return "\n".join(kept)


def columns(text):
    results = crankwork.analyse(crankwork.read_machine(text))
    return results, results.columns_at(DEGREES)


@pytest.fixture(scope="module")
def driven():
    return columns(TEXT)


def test_every_route_to_the_force_of_the_driver_agrees(driven):
    results, _ = driven
    assert {"whole_system", "zhukovsky", "virtual_work", "energy", "work"} == set(results.checks)
    assert max(results.checks.values()) < 1e-12


def test_a_sealed_gas_follows_its_polytrope_by_the_place_of_its_piece(driven):
    results, found = driven
    area, way = math.pi * 0.05**2 / 4, found["slider_displacement.plunger"]
    first = results.columns_at([0.0], ["slider_displacement.plunger"])["slider_displacement.plunger"][0]
    least = 80e-6  # clearance and dead volume, where the plunger is highest
    around = 0.5 + np.argmax(way)
    for width in (1.0, 1e-3):
        near = np.linspace(around - width, around + width, 2001)
        fine = results.columns_at(near, ["slider_displacement.plunger"])["slider_displacement.plunger"]
        around, top = near[np.argmax(fine)], np.max(fine)
    volume, start = least + area * (top - way), least + area * (top - first)
    assert found["diagram_pressure.spring"] == pytest.approx(2e6 * (start / volume) ** 1.3, rel=1e-12)
    assert results.summary["indicated_work.spring"] == pytest.approx(0.0, abs=1e-9)


def test_a_diagram_goes_by_the_stroke_and_stands_while_the_driver_dwells(driven):
    results, found = driven
    x, pressure = found["slider_displacement.piston"], found["diagram_pressure.pump"]
    back = DEGREES > 180
    compressed = 0.1e6 * ((5e-6 + AREA * 0.06) / (5e-6 + AREA * (x - 0.17))) ** 1.3
    assert pressure[~back] == pytest.approx(0.1e6)
    assert pressure[back] == pytest.approx(np.minimum(compressed, 1.2e6)[back], rel=1e-12)
    assert results.summary["indicated_power.pump"] == pytest.approx(results.summary["indicated_work.pump"] / 0.8)
    # filled at 0.1 MPa, compressed on the polytrope, pushed out at 1.2 MPa
    full, n = 5e-6 + AREA * 0.06, 1.3
    left = full * (0.1 / 1.2) ** (1 / n)
    work = 0.1e6 * AREA * 0.06 + 0.1e6 * full / (1 - n) * ((left / full) ** (1 - n) - 1) - 1.2e6 * (left - 5e-6)
    assert results.summary["indicated_work.pump"] == pytest.approx(work, rel=1e-12)


def test_what_the_gas_pushes_the_driver_with_is_its_power_over_the_velocity(driven):
    _, found = driven
    # by virtual work: gas on the driving piece pushes as it is, that on the plunger by the ratio of velocities
    still = columns(without(TEXT, "chambers.spring", "charges.nitrogen", "chambers.pump", "chambers.back"))[1]
    moving = np.abs(found["driver_velocity"]) > 1e-3
    ratio = found["slider_velocity.plunger"][moving] / found["driver_velocity"][moving]
    pushed = sum(found[f"gas_force.{name}"][moving] for name in ("pump", "back"))
    pushed = pushed + found["gas_force.spring"][moving] * ratio
    apart = (found["driver_force"] - still["driver_force"])[moving]
    assert apart == pytest.approx(-pushed, abs=1e-10 * np.max(np.abs(apart)))


def test_a_driver_need_not_come_back():
    text = without(TEXT, "chambers.pump").replace('period = "0.8 s"', 'period = "0.8 s"\nstart = "170 mm"')
    text = text.replace('{ kind = "4-5-6-7", to = "170 mm", over = 0.4 }', '{ kind = "dwell", over = 0.4 }')
    results, _ = columns(text)
    back = AREA - math.pi * 0.015**2 / 4
    assert results.summary["indicated_work.back"] == pytest.approx(-0.05e6 * back * 0.06, rel=1e-12)
    assert results.checks["work"] < 1e-12


def test_what_needs_a_turning_angle_is_refused():
    for old, new, told in (
        (
            "b = { stroke = 1,",
            'b = { angle = "90 deg",',
            r"chambers\.pump\.points\.b\.angle: counts by the crank angle",
        ),
        ('bore = "40 mm"\nclear', 'bore = "40 mm"\nperiod = "720 deg"\nclear', r"chambers\.pump\.period: counts by"),
        ('"2 MPa"', '"2 MPa"\nangle = "10 deg"', r"charges\.nitrogen\.angle: .* leave angle out"),
        ('["c", "d"]', '["c", "b"]', r"chambers\.pump\.pieces\[3\]: .*lasts from 0 to 360 deg"),
        ('slider = "plunger"', 'slider = "plonger"', r"chambers\.spring\.slider: .*piston, plunger"),
        ("[charges.nitrogen]", "[efficiency]\nchain = [0.9]\n[charges.nitrogen]", r"efficiency: presumes a crank"),
    ):
        assert old in TEXT
        with pytest.raises(crankwork.InputError, match=told):
            crankwork.read_machine(TEXT.replace(old, new, 1))
