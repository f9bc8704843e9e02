"""Worked steps against the worked lines of course notes, every printed digit."""

from __future__ import annotations

from pathlib import Path

import pytest

import crankwork
from crankwork.formula.expression import text
from crankwork.formula.lines import FormulaLine, SumLine

EXAMPLES = Path(__file__).parents[2] / "examples"

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


@pytest.mark.parametrize("angle", MOTION)
def test_motion_of_a_russian_note(angle, groups_of):
    results = crankwork.analyse(crankwork.read(EXAMPLES / "slider-crank.toml"))
    motion = next(group for group in groups_of(results, angle) if group.name == "motion")
    found = {step.key: step.value * 1e3 for step in motion.lines}
    keys = ("piston_displacement", "piston_velocity", "piston_acceleration")
    for key, printed, digit in zip(keys, MOTION[angle], LAST_DIGIT, strict=True):
        assert found[key] == pytest.approx(printed, abs=digit * 1.01)


@pytest.mark.parametrize("angle", PRESS)
def test_rows_of_a_russian_press(angle, groups_of):
    results = crankwork.analyse(crankwork.read(EXAMPLES / "press.toml"))
    groups = {group.name: group for group in groups_of(results, angle)}
    rocker, punch, whole, dynamic, balancing, driving = PRESS[angle]
    inertia = next(step for step in groups["reduction"].lines if step.key == "reduced_inertia")
    assert isinstance(inertia, SumLine)
    terms = {step.key: step.value for step in inertia.terms}
    assert terms["reduced_inertia.rocker"] == pytest.approx(rocker, abs=0.0006)
    assert terms["reduced_inertia.punch"] == pytest.approx(punch, abs=0.0006)
    # the document adds four terms, each rounded to three decimals
    assert inertia.value == pytest.approx(whole, abs=4 * 0.0005)
    torques = {step.key: step.value for step in groups["torques"].lines}
    assert torques["dynamic_torque"] == pytest.approx(dynamic, abs=0.002)
    assert torques["balancing_torque"] == pytest.approx(balancing, abs=1e-9)
    assert torques["driving_torque"] == pytest.approx(driving, abs=0.0055)


def test_a_motor_that_brakes_is_shown_by_the_formula_of_a_brake(groups_of):
    results = crankwork.analyse(crankwork.read(EXAMPLES / "press.toml"))
    for angle, name in ((30, "driving_torque_as_motor"), (150, "driving_torque_as_brake")):
        torques = next(one for one in groups_of(results, angle) if one.name == "torques")
        assert torques.lines[-1].formula.name == name


def test_a_step_prints_as_the_note_writes_it(groups_of):
    """R (1 - cos phi + lambda/4 (1 - cos 2 phi)), with the numbers in."""
    results = crankwork.analyse(crankwork.read(EXAMPLES / "slider-crank.toml"))
    motion = next(group for group in groups_of(results) if group.name == "motion")
    step = next(one for one in motion.lines if one.key == "piston_displacement")
    assert isinstance(step, FormulaLine)
    tree = step.expression
    assert text(tree, language="ru") == "R·(1 − cos φ + λ/4·(1 − cos 2φ))"
    numbers = {name: f"{value:.4g}" for name, value in step.values.items()}
    assert text(tree, numbers) == "0.075·(1 − 0.866 + 0.25/4·(1 − 0.5))"
