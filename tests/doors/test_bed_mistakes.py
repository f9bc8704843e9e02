"""Measurements of a test bed that are not enough, too many, or of the wrong kind."""

from __future__ import annotations

import re

import pytest

import crankwork
from each import for_each

ALONE = """
crank = { stroke = "400 mm", speed = "300 rpm" }
cylinder.bore = "250 mm"
[test]
"""
BRAKE = f'{ALONE}cylinders = 2\nbrake_load = "100 N"\nbrake_arm = "1 m"\n'
STAGES = """
crank.speed = "300 rpm"
[stages]
count = 1
suction = "1 bar"
discharge = "3 bar"
exponent = 1.3
bore = "200 mm"
stroke = "200 mm"
"""
ORIFICE = (
    'orifice_diameter = "30 mm"; orifice_drop = "1 kPa"; discharge_coefficient = 0.6; '
    'air_pressure = "1 bar"; air_temperature = "300 K"'
)
HEAT = (
    'effective_power = "5 kW"; fuel_rate = "2 kg/h"; fuel_heating_value = "42 MJ/kg"; '
    'coolant_rate = "3000 kg/h"; coolant_rise = "60 K"'
)
ENGINE = """
crank = { stroke = "90 mm", speed = "3000 rpm" }
rod.ratio = 0.27
cylinder = { bore = "85 mm", compression_ratio = 10.0 }
cycle = { kind = "wiebe", cycle_heat = "900 J" }
[test]
brake_load = "100 N"
brake_arm = "0.1 m"
"""


def of_file(text: str) -> crankwork.Results:
    return crankwork.analyse(crankwork.Description(text))


@for_each(
    ["base", "lines", "refused"],
    [
        # two ways to the same quantity
        (ALONE, 'brake_load = "1500 N"; brake_arm = "1 m"; effective_power = "5 kW"',
         "test.effective_power: says the same as test.brake_load and test.brake_arm; keep"),
        (ALONE, 'brake_load = "1500 N"; brake_arm = "1 m"; brake_drum_diameter = "1 m"',
         "test.brake_arm: says the same as test.brake_drum_diameter; keep"),
        (ALONE, 'brake_load = "1500 N"; brake_circumference = "4 m"; brake_drum_diameter = "1 m"',
         "says the same as test.brake_"),
        (ALONE, 'indicated_power = "8 kW"; effective_power = "5 kW"; mechanical_efficiency = 0.8',
         "test.mechanical_efficiency: says the same as test.indicated_power and test.effective_power; keep"),
        (ALONE, 'effective_power = "5 kW"; fuel_rate = "2 kg/h"; effective_fuel_consumption = "500 g/(kW*h)"',
         "test.fuel_rate: says the same as test.effective_power and test.effective_fuel_consumption; keep"),
        (ALONE, f'air_rate = "2 kg/h"; {ORIFICE}', "test.air_rate: says the same as test.orifice_diameter"),
        (ALONE, 'indicated_mean_pressure = "5 bar"; working_cycle_rate = "500 rpm"',
         "test.working_cycle_rate: says the same as crank.speed; keep"),
        # words and units of another key
        (ALONE, 'brake_power = "5 kW"', "test.brake_power: unknown key; did you mean effective_power?"),
        (ALONE, 'torque = "5 N*m"', "test.torque: unknown key; did you mean effective_torque?"),
        (ALONE, 'calorific_value = "42 MJ/kg"', "test.calorific_value: unknown key; did you mean fuel_heating_value?"),
        (ALONE, 'power = "5 kW"', "test.power: unknown key; known here: effective_power, indicated_power"),
        (ALONE, 'fuel_flow = "2 kg/h"', 'test.fuel_flow: unit "kg/h" measures mass rate: write it as fuel_rate; here'),
        (ALONE, 'card_area = "5 mm"', 'test.card_area: unit "mm" measures length: write it as card_length; here'),
        # what nothing follows from
        (ALONE, "", "test: nothing follows from what is stated"),
        (ALONE, 'brake_load = "1500 N"', "test.brake_load: says nothing without test.brake_arm; add"),
        (ALONE, 'effective_power = "5 kW"; air_temperature = "300 K"',
         "test.air_temperature: says nothing without test.air_pressure; add"),
        (ALONE, 'effective_power = "5 kW"; mechanical_efficiency = 0',
         "test.mechanical_efficiency: 0 is out of range; write a number above 0"),
        # cylinders cut out
        (ALONE, 'cylinders = 4; effective_power = "5 kW"; one_cut = ["3 kW", "3 kW", "3 kW"]',
         "test.one_cut: has 3 entries; write 4 of them"),
        (ALONE, 'effective_power = "5 kW"; one_cut = ["3 kW", "3 kW"]',
         "test.cylinders: is missing; write cylinders = 2"),
        (ALONE, 'cylinders = 2; effective_power = "5 kW"; one_cut = ["2 kW", "70 N"]',
         "test.one_cut[2]: says nothing without test.brake_arm; add"),
        (ALONE, 'cylinders = 2; one_cut = ["2 kW", "2 kW"]',
         "test.one_cut: says nothing without test.effective_power; add"),
        # what an engine has of its own
        (ENGINE, "cylinders = 4", "test.cylinders: the engine of the file already gives it"),
        (ENGINE, "strokes = 2", "test.strokes: the engine of the file already gives it"),
        (ENGINE, 'indicated_mean_pressure = "20 bar"', "test.indicated_mean_pressure: the engine of the file already"),
        (ENGINE, 'peak_pressure = "20 bar"', "test.peak_pressure: the engine of the file already gives it"),
        (ENGINE, 'card_area = "400 mm2"; card_length = "50 mm"; card_spring = "1 bar/mm"',
         "test.card_area: the engine of the file already gives it"),
        (ENGINE, "mechanical_efficiency = 0.8", "test.mechanical_efficiency: says the same as test.brake_load"),
    ],
)  # fmt: skip
def test_a_mistake_of_a_test_bed_is_told(base: str, lines: str, refused: str) -> None:
    with pytest.raises(crankwork.errors.InputError, match=re.escape(refused)):
        of_file(base + lines.replace("; ", "\n"))


@for_each("one_cut", ['["70 N", "60 N"]', '["70 N*m", "60 N"]', '["70 N", "600 W"]', '["7.1380 kgf*m", "60 N*m"]'])
def test_every_brake_load_with_a_cylinder_cut_out_is_taken_in_its_unit(one_cut: str) -> None:
    w = 31.41592653589793
    second = 600.0 if "W" in one_cut else 60 * w
    results = of_file(f"{BRAKE}one_cut = {one_cut}")
    assert results["power_with_one_cut"] == pytest.approx(70 * w + second, rel=1e-5)
    assert results["indicated_power"] == pytest.approx(2 * 100 * w - 70 * w - second, rel=1e-5)


@for_each(
    ["base", "lines", "told"],
    [
        (BRAKE, 'one_cut = ["2 kW", "2 kW"]', "mechanical_efficiency"),
        (BRAKE, 'one_cut = ["170 N", "170 N"]', "indicated_power"),
        (ALONE, 'brake_load = "100 N"; brake_spring_load = "200 N"; brake_arm = "1 m"', "effective_torque"),
        (ALONE, HEAT, "heat_rest"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_told_once_with_its_keys(base: str, lines: str, told: str) -> None:
    notices = [item.values for item in of_file(base + lines.replace("; ", "\n")).notices if item.code == "impossible"]
    assert [item["quantity"] for item in notices] == [told]
    assert "test." in str(notices[0]["keys"])


def test_an_isothermal_efficiency_above_1_is_told() -> None:
    """Air cooled far below that of the surroundings takes less than the isothermal work."""
    stages = (
        STAGES.replace("count = 1", "count = 2").replace("1.3", "1.05").replace("3 bar", "30 bar")
        + 'between = ["6 bar"]\ntemperature = "300 K"\ntemperatures = ["COLD K"]\n'
    )
    codes = [[item.code for item in of_file(stages.replace("COLD", kelvin)).notices] for kelvin in ("240", "300")]
    assert codes == [["impossible"], []]


def test_stages_without_clearance_say_so() -> None:
    assumed = [[item.code for item in of_file(text).assumptions] for text in (STAGES, f"{STAGES}clearance = 0.05")]
    assert ["no_clearance" in codes for codes in assumed] == [True, False]


def test_two_ways_that_agree_are_taken() -> None:
    assert of_file(f'{BRAKE}brake_drum_diameter = "2 m"')["effective_torque"] == pytest.approx(100)
