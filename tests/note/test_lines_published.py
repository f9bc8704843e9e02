"""Worked steps against the worked lines of course notes, every printed digit."""

from __future__ import annotations

import pytest

from crankwork.formula.calculation_lines import FormulaLine, SumLine
from crankwork.formula.expression import text
from note.built import broken, lines

# Расчет привода и поршневого двигателя автомобиля, course note at www.transporank.ru, worked lines above its table 2:
# crank angle [deg]: S [mm], v [mm/s], a [mm/s2]
MOTION = {
    30: (12.392, 11936.97, 5089121.91),
    60: (44.531, 19120.22, 1925703.125),
    120: (119.531, 14871.28, -3209505.2),
    180: (150.0, 0.0, -3851406.25),
}
LAST_DIGIT = (0.0005, 0.005, 0.05)

# Курсовой проект по динамике машин, рычажный механизм пресса, formulas 9 to 12 and table 4:
# crank angle [deg]: terms of rocker and punch and the whole reduced inertia [kg m2], dynamic torque, the sum of static
# and dynamic torque, the same with losses [N m]
PRESS = {
    30: (0.03, 0.064, 0.491, 53.656, 115.2, 169.41),
    60: (0.109, 0.197, 1.037, 105.38, 138.8, 204.12),
    150: (0.026, 0.059, 0.457, -91.215, -151, -102.68),
    330: (0.04, 0.074, 0.579, -90.142, -14.6, -9.93),
}


def wrong_motion(angle):
    steps = lines("slider-crank", "motion", angle)
    keys = ("piston_displacement", "piston_velocity", "piston_acceleration")
    for key, printed, digit in zip(keys, MOTION[angle], LAST_DIGIT, strict=True):
        assert steps[key].value * 1e3 == pytest.approx(printed, abs=digit * 1.01), key


def test_motion_of_a_russian_note():
    assert broken(wrong_motion, MOTION) == {}


def wrong_press(angle):
    rocker, punch, whole, dynamic, balancing, driving = PRESS[angle]
    inertia = lines("press", "reduction", angle)["reduced_inertia"]
    assert isinstance(inertia, SumLine)
    terms = {step.key: step.value for step in inertia.terms}
    assert terms["reduced_inertia.rocker"] == pytest.approx(rocker, abs=0.0006)
    assert terms["reduced_inertia.punch"] == pytest.approx(punch, abs=0.0006)
    # the document adds four terms, each rounded to three decimals
    assert inertia.value == pytest.approx(whole, abs=4 * 0.0005)
    torques = {key: step.value for key, step in lines("press", "torques", angle).items()}
    assert torques["dynamic_torque"] == pytest.approx(dynamic, abs=0.002)
    assert torques["balancing_torque"] == pytest.approx(balancing, abs=1e-9)
    assert torques["driving_torque"] == pytest.approx(driving, abs=0.0055)


def test_rows_of_a_russian_press():
    assert broken(wrong_press, PRESS) == {}


def test_a_motor_that_brakes_is_shown_by_the_formula_of_a_brake():
    for angle, name in ((30, "driving_torque_as_motor"), (150, "driving_torque_as_brake")):
        *_, last = lines("press", "torques", angle).values()
        assert last.formula.name == name


def test_a_step_prints_as_the_note_writes_it():
    """R (1 - cos phi + lambda/4 (1 - cos 2 phi)), with the numbers in."""
    step = lines("slider-crank", "motion")["piston_displacement"]
    assert isinstance(step, FormulaLine)
    assert text(step.expression, language="ru") == "R·(1 − cos φ + λ/4·(1 − cos 2φ))"
    numbers = {name: f"{value:.4g}" for name, value in step.values.items()}
    assert text(step.expression, numbers) == "0.075·(1 − 0.866 + 0.25/4·(1 − 0.5))"
