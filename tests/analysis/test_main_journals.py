"""Main journals against Newton's law: they bear what moves throws, rods and pistons, less gas, walls and weights."""

from __future__ import annotations

import math

import numpy as np
import pytest

import crankwork
from crankwork.analysis.cylinders import multi_cylinder_engine

RADIUS, LENGTH, CENTRE, OFFSET, GRAVITY = 0.047, 0.151, 0.043, 0.009, 9.80665
CRANK, ROD, PISTON = 6.0, 1.13, 0.77
SPEED, STEP = 400 * math.pi / 30, 1e-4
MACHINE = """
format = 2
[crank]
radius = "47 mm"
speed = "400 rpm"
mass = "6 kg"
[rod]
length = "151 mm"
mass = "1.13 kg"
centre_of_mass = "43 mm"
inertia = "0.0061 kg*m2"
[piston]
mass = "0.77 kg"
[cylinder]
bore = "92 mm"
compression_ratio = 9
offset = "9 mm"
[cycle]
kind = "otto"
cycle = "360 deg"
heat = "1500 kJ/kg"
"""
INLINE = """
[engine]
layout = "inline"
cylinders = 2
firing_order = [1, 2]
throws = ["0 deg", "100 deg"]
uneven = true
spacing = "110 mm"
"""
SPLIT_V = """
[engine]
layout = "V"
cylinders = 6
bank_angle = "60 deg"
pin_offset = "30 deg"
firing_order = [1, 4, 2, 5, 3, 6]
uneven = true
spacing = "110 mm"
"""
WEIGHTS, FASTER = "method.weights=true", "crank.angular_acceleration=1500 rad/s2"


@pytest.mark.elsewhere
@pytest.mark.parametrize(
    ("engine", "settings", "counterweight"),
    [
        (INLINE, [FASTER], 0.0),
        (INLINE, [FASTER, "balance.rotating_share=0.4"], 0.4 * (CRANK + ROD * (1 - CENTRE / LENGTH)) * RADIUS),
        (INLINE, [WEIGHTS, "cylinder.inclination=35 deg", "bearings.counterweight=0.05 kg*m"], 0.05),
        (SPLIT_V, [WEIGHTS, FASTER, "bearings.counterweight=0.05 kg*m"], 0.05),
    ],
)
def test_they_bear_what_moves_the_whole_engine(engine, settings, counterweight):
    machine = crankwork.read_machine(MACHINE + engine, overrides=settings)
    results = crankwork.analyse(machine)
    degrees = np.arange(1.0, 360.0, 13.0)
    journals = len({place.throw for place in machine.engine.layout.places}) + 1
    keys = [f"bearing_force_{way}.main_journal.{at}" for at in range(1, journals + 1) for way in "xy"]
    found = results.columns_at(degrees, keys)
    on_shaft = sum(found[key] * (1j if "_y." in key else 1.0) for key in keys)
    gains = 1500.0 if FASTER in settings else 0.0
    weight = GRAVITY if WEIGHTS in settings else 0.0
    wanted = momentum_rate(machine, degrees, counterweight, gains) + weight * total_mass(machine, counterweight)
    whole, lean = multi_cylinder_engine(results.solved), machine.inclination
    gas, wall = (whole.each(key, degrees) for key in ("gas_force", "side_force"))
    for place, pressed, pushed in zip(machine.engine.layout.places, gas, wall, strict=True):
        wanted -= (-pressed + 1j * pushed) * np.exp(1j * axis_of(machine, place))
    in_block = on_shaft * np.exp(1j * (np.radians(degrees) + lean))
    assert in_block == pytest.approx(wanted, abs=1e-6 * np.max(np.abs(wanted)))


def axis_of(machine: crankwork.Machine, place) -> float:
    """Return the direction of a cylinder from the upward vertical, with the rotation. [rad]"""
    return machine.inclination + math.radians(place.axis - machine.engine.layout.places[0].axis)


def throws_of(machine: crankwork.Machine) -> list[tuple[float, float]]:
    """Return the crankpins that have counterweights: angle from that of cylinder 1 [rad], and share of a throw."""
    pins = {place.crankpin: place for place in machine.engine.layout.places}
    throws = [place.throw for place in pins.values()]
    return [(math.radians(place.pin_angle), 1 / throws.count(place.throw)) for place in pins.values()]


def total_mass(machine: crankwork.Machine, counterweight: float) -> float:
    """Return the mass of all that moves. [kg]"""
    count = len(machine.engine.layout.places)
    on_pins = sum(CRANK * share + counterweight / RADIUS for _, share in throws_of(machine))
    return count * (ROD + PISTON) + on_pins


def momentum_rate(machine: crankwork.Machine, degrees: np.ndarray, counterweight: float, gains: float) -> np.ndarray:
    """Return the rate of the momentum of all that moves, up and a quarter turn with the rotation from there. [N]"""
    at = [moment(machine, degrees, counterweight, gains, STEP * step) for step in (-2, -1, 0, 1, 2)]
    return (-at[0] + 16 * at[1] - 30 * at[2] + 16 * at[3] - at[4]) / (12 * STEP**2)


def moment(machine, degrees: np.ndarray, counterweight: float, gains: float, time: float) -> np.ndarray:
    """Return masses times places, some time after crank angles. [kg m]"""
    turned = np.radians(degrees) + SPEED * time + gains * time**2 / 2 + machine.inclination
    found = np.zeros_like(degrees, dtype=complex)
    for place in machine.engine.layout.places:
        axis = axis_of(machine, place)
        pin = RADIUS * np.exp(1j * (turned + math.radians(place.pin_angle) - axis))
        piston = pin.real + np.sqrt(LENGTH**2 - (pin.imag - OFFSET) ** 2) + 1j * OFFSET
        found += (PISTON * piston + ROD * (pin + CENTRE / LENGTH * (piston - pin))) * np.exp(1j * axis)
    for angle, share in throws_of(machine):
        found += (CRANK * share * RADIUS - counterweight) * np.exp(1j * (turned + angle))
    return found
