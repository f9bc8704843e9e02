"""Which way the weights of an engine pull: the engine stands upright unless the lean of cylinder 1 is stated."""

from __future__ import annotations

import math

import numpy as np
import pytest

import crankwork
from crankwork.analysis.cylinders import multi_cylinder_engine
from crankwork.description.document import origins_of
from crankwork.locale import LANGUAGES, translate

PISTON, SMALL_END, GRAVITY = 1.3, 0.3 * 1.9, 9.80665
CRANK_GEAR = """
format = 2
[crank]
radius = "60 mm"
speed = "1800 rpm"
mass = "2 kg"
[rod]
length = "230 mm"
mass = "1.9 kg"
small_end_share = 0.3
inertia = "0.016 kg*m2"
[piston]
mass = "1.3 kg"
[cylinder]
bore = "110 mm"
compression_ratio = 9
[cycle]
kind = "otto"
heat = "1500 kJ/kg"
[method]
weights = true
"""
V_SIX = """
[engine]
layout = "V"
cylinders = 6
bank_angle = "60 deg"
spacing = "130 mm"
firing_order = [1, 4, 2, 5, 3, 6]
uneven = true
"""
MASTERS = """
[engine.articulated]
knuckle_radius = "62 mm"
rod_length = "168 mm"
knuckle_angles = ["64 deg", "64 deg", "64 deg"]
mass = "1.2 kg"
small_end_share = 0.4
inertia = "0.005 kg*m2"
"""
W_SIX = """
[engine]
layout = "W"
cylinders = 6
bank_angles = ["-50 deg", "0 deg", "50 deg"]
spacing = "130 mm"
uneven = true
firing_order = [1, 3, 5, 2, 4, 6]
throws = ["0 deg", "180 deg"]
"""
BOXER = """
[engine]
layout = "boxer"
cylinders = 2
"""
RADIAL = """
[engine]
layout = "radial"
cylinders = 5
"""


def leans(results: crankwork.Results) -> list[float]:
    """Return how far the cylinders lean, of their weights along and across the axis. [deg]"""
    whole = multi_cylinder_engine(results.solved)
    weight = (PISTON + SMALL_END) * GRAVITY
    found = []
    for one in whole.cylinders:
        across = one.trace["transverse_weight"].value if "transverse_weight" in one.trace else 0.0
        along = one.trace["weight_force"].value
        assert math.hypot(along, across) == pytest.approx(weight, rel=1e-12)
        found.append(math.degrees(math.atan2(across, along)))
    return found


@pytest.mark.parametrize(
    ("engine", "wanted"),
    [
        (V_SIX, [-30.0] * 3 + [30.0] * 3),
        (W_SIX, [-50.0] * 2 + [0.0] * 2 + [50.0] * 2),
        (BOXER, [-90.0, 90.0]),
        (RADIAL, [0.0, 72.0, 144.0, -144.0, -72.0]),
    ],
)
def test_an_engine_stands_upright(engine, wanted):
    results = crankwork.analyse(crankwork.read_machine(CRANK_GEAR + engine))
    assert leans(results) == pytest.approx(wanted, abs=1e-9)


def test_weight_along_the_axes_of_a_v():
    results = crankwork.analyse(crankwork.read_machine(CRANK_GEAR + V_SIX))
    # 1.87 kg * 9.80665 m/s2 * cos 30 deg
    assert results.trace["weight_force"].value == pytest.approx(15.882, abs=5e-4)


def test_a_lean_that_is_stated_is_that_of_cylinder_1():
    machine = crankwork.read_machine(CRANK_GEAR + V_SIX, overrides=["cylinder.inclination=0 deg"])
    results = crankwork.analyse(machine)
    assert leans(results) == pytest.approx([0.0] * 3 + [60.0] * 3, abs=1e-9)
    assert "upright" not in [one.code for one in results.notices]


def test_weights_of_a_v_without_a_bore_lean_too():
    text = CRANK_GEAR.replace('[cylinder]\nbore = "110 mm"\ncompression_ratio = 9\n', "")
    text = text.replace('[cycle]\nkind = "otto"\nheat = "1500 kJ/kg"\n', "")
    results = crankwork.analyse(crankwork.read_machine(text + V_SIX))
    assert leans(results) == pytest.approx([-30.0] * 3 + [30.0] * 3, abs=1e-9)


def test_it_is_said_how_the_engine_stands_and_where_that_follows_from():
    text = CRANK_GEAR + V_SIX
    results = crankwork.analyse(crankwork.read_machine(text))
    (notice,) = [one for one in results.notices if one.code == "upright"]
    assert notice.values == {"inclination": pytest.approx(-30.0)}
    for language in LANGUAGES:
        assert "-30" in translate("notices.upright", language, inclination=-30)
    origin = origins_of(text)("cylinder.inclination", [math.radians(-30.0)])
    line = next(at for at, one in enumerate(text.splitlines(), 1) if one.startswith("bank_angle"))
    assert (origin.kind, origin.path, origin.line) == ("follows_line", "engine.bank_angle", str(line))


@pytest.mark.parametrize("stated", [[], ["cylinder.inclination=17 deg"], ["crank.angular_acceleration=200 rad/s2"]])
def test_table_and_checks_of_articulated_rods_have_one_direction_of_gravity(stated):
    results = crankwork.analyse(crankwork.read_machine(CRANK_GEAR + V_SIX + MASTERS, overrides=stated))
    assert {"throw_torque", "throw_load", "joint_torque", "joint_side_force"} <= set(results.checks)
    assert {key: one for key, one in results.checks.items() if not one < 1e-9} == {}


def test_torque_of_weights_is_that_of_all_heights():
    """The torque of weights is minus the slope of the potential energy of pistons, rod ends and throw."""
    text = CRANK_GEAR + V_SIX.replace("cylinders = 6", "cylinders = 2").replace("[1, 4, 2, 5, 3, 6]", "[1, 2]")
    degrees, step = np.arange(0.0, 720.0, 15.0), 1e-3
    torques = []
    for counts in ("true", "false"):
        results = crankwork.analyse(crankwork.read_machine(text, overrides=[f"method.weights={counts}"]))
        torques.append(results.columns_at(degrees, ["total_torque"])["total_torque"])
    slope = (energy(degrees + step) - energy(degrees - step)) / (2 * math.radians(step))
    assert np.max(np.abs(slope)) > 1.0
    assert torques[0] - torques[1] == pytest.approx(-slope, abs=1e-6)


def energy(degrees: np.ndarray) -> np.ndarray:
    """Return the potential energy of a V of two whose cylinders lean 30 degrees to each side. [J]"""
    radius, length = 0.06, 0.23
    # crank 1 stands along its axis, 30 degrees before the vertical, where its angle is zero
    pin = np.radians(degrees - 30.0)
    found = (2.0 + 2 * 0.7 * 1.9) * radius * np.cos(pin)
    for lean in np.radians([-30.0, 30.0]):
        along = radius * np.cos(pin - lean) + np.sqrt(length**2 - (radius * np.sin(pin - lean)) ** 2)
        found += (PISTON + SMALL_END) * along * np.cos(lean)
    return GRAVITY * found
