"""What is wrong with the torques on a shaft, or with its flywheel, is told at its line, with what to write instead."""

import re

import pytest

import crankwork
from crankwork.locale import LANGUAGES, in_language
from each import for_each

ENGINE = """
[crank]
speed = "100 rpm"
[torque]
period = "360 deg"
at = ["0 deg", "80 deg", "180 deg", "270 deg", "360 deg"]
torque = ["0 N*m", "2000 N*m", "0 N*m", "1500 N*m", "0 N*m"]
[flywheel]
fluctuation = 0.015
radius_of_gyration = "1.75 m"
"""
LOOPS = """
[crank]
speed = "600 rpm"
[torque]
period = "360 deg"
areas = ["52 mm2", "-124 mm2", "92 mm2", "-140 mm2", "85 mm2", "-72 mm2", "107 mm2"]
scale = { torque = "600 N*m/mm", angle = "3 deg/mm" }
"""
PRESS = """
[crank]
speed = "240 rpm"
[load]
period = "10 s"
[[load.strokes]]
shear_energy = "7 J/mm2"
hole_diameter = "38 mm"
thickness = "32 mm"
punch_stroke = "100 mm"
[flywheel]
mass = "500 kg"
radius_of_gyration = "0.6 m"
"""

MISTAKES = [
    (ENGINE, 'period = "360 deg"', "", "torque.period", "is missing"),
    (ENGINE, '"80 deg", "180 deg"', '"180 deg", "80 deg"', "torque.at[3]", "must not descend"),
    (ENGINE, '"360 deg"]', '"400 deg"]', "torque.at[5]", "write an angle from 0 to 360 deg"),
    (ENGINE, '"80 deg", "180 deg", "270 deg"', '"80 deg", "80 deg", "80 deg"', "torque.at[4]", "three times"),
    (ENGINE, '"80 deg", ', "", "torque.at", "4 values"),
    (ENGINE, ', "0 N*m"]', ', "9 N*m"]', None, None),
    (ENGINE, '"270 deg", "360 deg"]', '"200 deg", "240 deg"]', None, None),
    (ENGINE.replace(', "0 N*m"]', ', "9 N*m"]'), '"270 deg", "360 deg"]', '"200 deg", "240 deg"]', "torque.at",
     "goes from 0 to 240 deg, and a period has 360 deg"),
    (ENGINE, 'speed = "100 rpm"', "", "crank.speed", "is missing"),
    (ENGINE, "fluctuation = 0.015", "fluctuation = 0", "flywheel.fluctuation", "out of range"),
    (ENGINE, "fluctuation = 0.015", "fluctuation = -0.01", "flywheel.fluctuation", "out of range"),
    (ENGINE, "fluctuation = 0.015", "fluctuation = 0.01\npercent = 2", "flywheel.percent", "says the same"),
    (ENGINE, "fluctuation = 0.015", 'speeds = ["99 rpm", "101 rpm"]', "flywheel.speeds", "the largest speed, then"),
    (ENGINE, "fluctuation = 0.015", 'speeds = ["110 rpm", "108 rpm"]', "flywheel.speeds", "mean of 109 rpm"),
    (ENGINE, "[flywheel]", '[load]\nconstant = "900 N*m"\n[flywheel]', "load", "which leaves -157.1 J"),
    (ENGINE, "[flywheel]", '[load]\nperiod = "100 deg"\nconstant = "875 N*m"\n[flywheel]', None, None),
    (ENGINE, "[flywheel]", '[load]\nperiod = "101 deg"\nconstant = "875 N*m"\n[flywheel]', "load.period", "common one"),
    (ENGINE, "[flywheel]", '[load]\nareas = ["1 J", "-1 J"]\n[flywheel]', "load", "gives energies only"),
    (ENGINE, "[flywheel]", "[load]\n[flywheel]", "load", "says nothing of a torque"),
    (ENGINE, "[flywheel]", '[method]\nkinematics = "textbook"\n[flywheel]', "method.kinematics", "leave it out"),
    (LOOPS, '"107 mm2"', '"100 mm2"', "torque.areas", "leave -219.9 J"),
    (LOOPS, "scale", "# scale", "torque.areas[1]", "add torque.scale"),
    (LOOPS, ', angle = "3 deg/mm"', "", "torque.scale.angle", "is missing"),
    (LOOPS, "areas", 'at = ["0 deg", "9 deg"]\ntorque = ["1 N*m", "2 N*m"]\nareas', "torque.areas", "says the same"),
    (LOOPS, "areas", "energy_fluctuation = 0.1\n# areas", "torque.energy_fluctuation", "the work of a cycle"),
    (LOOPS, "areas", "cylinders = 3\nareas", "torque.cylinders", "says the same"),
    (LOOPS, "[crank]", "[rotor]\nmasses = ['']\n[crank]", "rotor.masses[1]", "must be a table"),
    (PRESS, 'thickness = "32 mm"', "", "load.strokes[1].punch_stroke", "says nothing without thickness"),
    (PRESS, 'hole_diameter = "38 mm"', "", "load.strokes[1].shear_energy", "needs what is sheared"),
    (PRESS, 'shear_energy = "7 J/mm2"', 'shear_strength = "300 MPa"', "load.strokes[1].penetration", "missing"),
    (PRESS, 'shear_energy = "7 J/mm2"', 'shear_energy = "7 J/mm2"\npunch_slope = "1 mm"', "load.strokes[1].punch_slope",
     "says nothing without shear_strength"),
    (PRESS, 'hole_diameter = "38 mm"', 'shear_strength = "300 MPa"', "load.strokes[1].shear_strength", "shear_energy"),
    (PRESS, 'punch_stroke = "100 mm"', 'over = "12 s"', "load.strokes[1].over", "more than the period"),
    (PRESS, 'radius_of_gyration = "0.6 m"', "", "flywheel.mass", "where the mass is"),
    (PRESS, 'speed = "240 rpm"', 'largest_speed = "40 rpm"', "crank.largest_speed", "the shaft stops"),
    (ENGINE.partition("[flywheel]")[0], 'speed = "100 rpm"', 'largest_speed = "100 rpm"', "crank.largest_speed",
     "without the flywheel"),
    (PRESS, "[[load.strokes]]", "[[load.harmonics]]\norder = 1.5\n[load.x]", "load.x", "unknown table"),
]  # fmt: skip


@for_each(("text", "old", "new", "key", "message"), MISTAKES, ids=[f"{one[3]}: {one[2][:30]}" for one in MISTAKES])
def test_a_mistake_is_told_at_its_line(text, old, new, key, message):
    changed = text.replace(old, new)
    assert changed != text
    if key is None:
        crankwork.read_machine(changed)
        return
    with pytest.raises(crankwork.InputError) as refused:
        crankwork.read_machine(changed, "shaft.toml")
    problems = {one.key: one.message for one in refused.value.problems}
    assert key in problems
    assert message in problems[key]
    for line in str(refused.value).splitlines():
        assert re.match(r"shaft\.toml:\d+: ", line)
    assert all(in_language(one, language) for one in problems.values() for language in LANGUAGES)


def test_an_order_that_does_not_close_names_a_period():
    text = """
        crank.speed = "100 rpm"
        [torque]
        period = "360 deg"
        constant = "10 N*m"
        harmonics = [{ order = 0.5, sin = "3 N*m" }]
        """
    with pytest.raises(crankwork.InputError, match="720 deg"):
        crankwork.read_machine(text)
    assert crankwork.read_machine(text.replace("360", "720")).cycle == 720
