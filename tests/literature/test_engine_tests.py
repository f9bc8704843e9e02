"""Tests of engines on a brake: power, mean pressures, efficiencies, fuel, air and heat, from a machine file alone.

H. N. Gupta: Fundamental of internal combustion engines. PHI Learning, New Delhi. Chapter 16. P. K. Nag: Basic and
applied thermodynamics. Tata McGraw-Hill, New Delhi. Chapter 3, page 56. R. K. Rajput: A textbook of internal combustion
engines. Laxmi Publications, New Delhi. Chapter 17, pages 570 to 602. The printed values were read from the public
notebooks of the books' examples, github.com/FOSSEE/Python-Textbook-Companions at commit
d34b2ae7e5e6051f7c87531ebc73b154b082d05b, files Fundamental_of_internal_combustion_engines_by_H_N_Gupta/chap16.ipynb,
Basic_And_Applied_Thermodynamics_by_P._K._Nag/Chapter03.ipynb and
A_textbook_of_Internal_Combustion_Engines_by_R._K._Rajput/CHAPTER17_3.ipynb, so they are secondary to the books. Values
with many digits are the same numbers computed again by hand. What is wrong in a notebook is left out and told.
"""

from __future__ import annotations

import math
from typing import Any

import pytest

import crankwork
from each import for_each

_KW, _BAR, _PER_HOUR = 1e3, 1e5, 3.6e9


class Case:
    """A machine file of a test, and what is printed of it, in the units of the book, with the places that are right."""

    def __init__(self, name: str, sizes: tuple[float, float, float], test: str, **printed: tuple[float, float]) -> None:
        bore, stroke, speed = sizes
        self.name, self.printed = name, printed
        lines = [f'crank = {{ stroke = "{stroke} m", speed = "{speed} rpm" }}'] if stroke else []
        lines += [f'crank.speed = "{speed} rpm"'] if speed and not stroke else []
        lines += [f'cylinder.bore = "{bore} m"'] if bore else []
        self.text = "\n".join([*lines, "[test]", *(line.strip() for line in test.split(";"))])


_UNITS = {
    "indicated_power": _KW, "effective_power": _KW, "indicated_mean_pressure": _BAR, "effective_mean_pressure": _BAR,
    "mechanical_efficiency": 0.01, "effective_efficiency": 0.01, "indicated_efficiency": 0.01,
    "volumetric_efficiency": 0.01, "effective_fuel_consumption": 1 / 3.6e6, "fuel_rate": 1 / 3600,
    "heat_share.to_coolant": 0.01,
}  # fmt: skip
CASES = (
    Case("Gupta 16.2, powers", (0.175, 0.32, 510), 'indicated_mean_pressure = "6.1 bar"; effective_power = "17.32 kW"',
         mechanical_efficiency=(86.79, 0.05)),
    Case("Gupta 16.3", (0.09, 0.1, 1000), 'cylinders = 4; effective_torque = "120 N*m"',
         effective_mean_pressure=(5.93, 0.005)),
    Case("Gupta 16.4, test of Morse", (0.06, 0.085, 3000),
         'cylinders = 4; brake_load = "160 N"; brake_arm = "0.35 m"; one_cut = ["114 N", "110 N", "112 N", "116 N"]; '
         'fuel_flow = "0.0066 m3/h"; fuel_density = "780 kg/m3"; fuel_heating_value = "44 MJ/kg"',
         effective_power=(17.5929188601, 1e-9), effective_mean_pressure=(7.32026143791, 1e-9),
         effective_efficiency=(27.9607737764, 1e-9), effective_fuel_consumption=(0.292617731085, 1e-10),
         indicated_power=(20.6716796606, 1e-9), mechanical_efficiency=(85.1063829787, 1e-9),
         indicated_mean_pressure=(8.60130718954, 1e-9)),
    Case("Gupta 16.5, loop of gas exchange", (0.15, 0.16, 500),
         'brake_load = "400 N"; brake_circumference = "2.2 m"; card_area = "475 mm2"; card_loop_area = "25 mm2"; '
         'card_length = "50 mm"; card_spring = "0.8333 bar/mm"; fuel_rate = "0.0475 kg/min"; '
         'fuel_heating_value = "42 MJ/kg"',
         effective_power=(7.33333333333, 1e-9), indicated_power=(8.83537590905, 1e-9),
         mechanical_efficiency=(82.9996754957, 1e-9), effective_efficiency=(22.0551378446, 1e-9),
         indicated_efficiency=(26.572559125, 1e-9), effective_fuel_consumption=(0.388636363636, 1e-10)),
    # the fuel of the notebook takes the specific gravity for the exponent of the gas, 1.4 / 2
    Case("Gupta 16.6", (0.08, 0.1, 4500),
         'cylinders = 8; brake_load = "392.4 N"; brake_arm = "0.55 m"; fuel_rate = "26.5263157894737 kg/h"; '
         'fuel_heating_value = "44 MJ/kg"; air_rate = "6 kg/min"; air_pressure = "1 bar"; air_temperature = "300 K"',
         effective_power=(101.7, 0.05), effective_mean_pressure=(6.744, 0.0005), air_fuel_ratio=(13.57, 0.005),
         effective_fuel_consumption=(0.261, 0.0005), effective_efficiency=(31.369, 0.0005),
         volumetric_efficiency=(57.1, 0.05)),
    Case("Nag 3.4, two strokes", (0.8, 1.2, 150),
         'cylinders = 12; strokes = 2; card_area = "550 mm2"; card_length = "60 mm"; card_spring = "147 MPa/m"',
         indicated_power=(24383.7855401, 1e-6), indicated_mean_pressure=(13.475, 1e-9)),
    Case("Rajput 17.1", (0.11, 0.14, 1000), 'strokes = 2; indicated_mean_pressure = "6 bar"',
         indicated_power=(13.30, 0.005)),
    Case("Rajput 17.3, rope", (0, 0, 450),
         'brake_load = "200 N"; brake_spring_load = "30 N"; brake_drum_diameter = "0.6 m"; '
         'brake_rope_diameter = "26 mm"', effective_power=(2.51, 0.005)),
    Case("Rajput 17.9", (0.3, 0.45, 300),
         'indicated_mean_pressure = "6 bar"; brake_load = "1.5 kN"; brake_drum_diameter = "1.8 m"; '
         'brake_rope_diameter = "20 mm"',
         indicated_power=(47.71, 0.005), effective_power=(42.88, 0.005), mechanical_efficiency=(89.88, 0.005)),
    Case("Rajput 17.15, consumption", (0, 0, 1000),
         'indicated_power = "30 kW"; effective_power = "26 kW"; effective_fuel_consumption = "350 g/(kW*h)"; '
         'fuel_heating_value = "43.9 MJ/kg"',
         indicated_efficiency=(27.03, 0.005), effective_efficiency=(23.43, 0.005),
         mechanical_efficiency=(86.67, 0.005)),
    Case("Rajput 17.22", (0.25, 0.4, 250),
         'indicated_mean_pressure = "6.5 bar"; brake_load = "1080 N"; brake_drum_diameter = "1.5 m"; '
         'fuel_rate = "10 kg/h"; fuel_heating_value = "44.3 MJ/kg"',
         indicated_power=(26.59, 0.005), effective_power=(21.21, 0.005), mechanical_efficiency=(79.75, 0.005),
         indicated_efficiency=(21.61, 0.005)),
    Case("Rajput 17.33", (0.16, 0.2, 400),
         'brake_load = "370 N"; brake_spring_load = "50 N"; brake_drum_diameter = "1.2 m"; card_area = "300 mm2"; '
         'card_length = "40 mm"; card_spring = "1 bar/mm"; fuel_rate = "2.8 kg/h"; fuel_heating_value = "41.8 MJ/kg"',
         indicated_mean_pressure=(7.50, 0.005), effective_power=(8.04, 0.005), effective_mean_pressure=(6.00, 0.005),
         effective_fuel_consumption=(0.35, 0.005), effective_efficiency=(24.74, 0.005),
         indicated_efficiency=(30.92, 0.005)),
    Case("Rajput 17.35, gas engine with missed cycles", (0.2, 0.4, 235),
         'working_cycle_rate = "105 1/min"; brake_load = "540 N"; brake_drum_diameter = "1.6 m"; '
         'brake_rope_diameter = "20 mm"; card_area = "550 mm2"; card_length = "72 mm"; card_spring = "0.8 bar/mm"; '
         'fuel_flow = "0.2125 m3/min"; fuel_density = "1 kg/m3"; fuel_heating_value = "15.9 MJ/kg"',
         indicated_power=(13.44, 0.005), effective_power=(10.76, 0.005), indicated_efficiency=(23.87, 0.005),
         effective_efficiency=(19.11, 0.005)),
    Case("Rajput 17.37, heat balance", (0.3, 0.45, 200),
         'indicated_mean_pressure = "5.8 bar"; brake_load = "1860 N"; brake_drum_diameter = "1.22 m"; '
         'fuel_rate = "8.8 kg/h"; fuel_heating_value = "41.8 MJ/kg"; coolant_rate = "650 kg/h"; coolant_rise = "22 K"; '
         'coolant_heat = "4180 J/(kg*K)"',
         **{"mechanical_efficiency": (77.28, 0.005), "effective_efficiency": (23.26, 0.005),
            "heat_share.to_coolant": (16.25, 0.005)}),
    # the constant of the dynamometer, N W / 17000 in kilowatts, is an arm of 30000 / (17000 pi) metres
    Case("Rajput 17.40, orifice", (0.1, 0.14, 2500),
         f'cylinders = 6; brake_load = "480 N"; brake_arm = "{30 / 17 / math.pi!r} m"; fuel_rate = "0.32 kg/min"; '
         'orifice_diameter = "33 mm"; discharge_coefficient = 0.62; orifice_drop = "18678.24 Pa"; '
         'air_pressure = "101396.16 Pa"; air_temperature = "298 K"',
         effective_mean_pressure=(5.14, 0.005), effective_torque=(269.63, 0.005),
         effective_fuel_consumption=(0.27, 0.005), volumetric_efficiency=(68.49, 0.05)),
    Case("Rajput 17.45, test of Morse by powers", (0, 0, 1000),
         'cylinders = 4; effective_power = "15.6 kW"; one_cut = ["11.1 kW", "11.03 kW", "10.88 kW", "10.66 kW"]; '
         'fuel_rate = "6 kg/h"; fuel_heating_value = "83.6 MJ/kg"',
         mechanical_efficiency=(83.29, 0.005), indicated_efficiency=(13.44, 0.005)),
)  # fmt: skip


def of_file(text: str) -> crankwork.Results:
    return crankwork.analyse(crankwork.Description(text))


@for_each("case", CASES, ids=[case.name for case in CASES])
def test_a_test_of_an_engine_has_the_values_of_the_book(case: Any) -> None:
    results = of_file(case.text)
    for key, (printed, places) in case.printed.items():
        assert results[key] / _UNITS.get(key, 1.0) == pytest.approx(printed, abs=places), key


def test_rajput_17_13_double_acting() -> None:
    """Both sides of a piston with a rod of 20 mm; the notebook prints 63.59 per cent."""
    results = of_file("""
        crank = { stroke = "0.35 m", speed = "420 rpm" }
        cylinder = { bore = "0.2 m", piston_rod_diameter = "20 mm" }
        [test]
        indicated_mean_pressure = "6.5 bar"
        crank_side_pressure = "7 bar"
        brake_load = "1370 N"
        brake_spring_load = "145 N"
        brake_drum_diameter = "1.2 m"
        brake_rope_diameter = "20 mm"
    """)
    assert results["indicated_power"] == pytest.approx(25014.9315042 + 26669.7654345, rel=1e-11)
    assert results["effective_power"] == pytest.approx(32865.7715455, rel=1e-11)
    assert results["mechanical_efficiency"] == pytest.approx(0.635889798958, rel=1e-11)


def test_rajput_17_7_by_displacement() -> None:
    """Brake mean pressure of 6 bar and 25 litres at 2000 revolutions: 250.00 kW, 33.07 per cent."""
    results = of_file("""
        crank.speed = "2000 rpm"
        cylinder.displacement = "0.025 m3"
        test = { effective_mean_pressure = "6 bar", fuel_rate = "0.018 kg/s", fuel_heating_value = "42 MJ/kg" }
    """)
    assert results["effective_power"] == pytest.approx(250e3, rel=1e-12)
    assert results["effective_efficiency"] == pytest.approx(0.3307, abs=5e-5)


ENGINE = """
crank = { stroke = "90 mm", speed = "3000 rpm" }
rod.ratio = 0.27
cylinder = { bore = "85 mm", compression_ratio = 10.0 }
cycle = { kind = "wiebe", cycle_heat = "900 J" }
"""


@for_each(
    ["losses", "coefficients"],
    [
        # given; a straight line of A. I. Kolchin and V. P. Demidov, ch. 3; S. K. Chen and P. F. Flynn by hand
        ('mechanical_loss_constant = "0.15 MPa"', (0.15e6, 0, 0, 0)),
        ('mechanical_loss_constant = "0.034 MPa", mechanical_loss_slope = "0.0113 MPa*s/m"', (0.034e6, 0.0113e6, 0, 0)),
        (
            (
                'mechanical_loss_constant = "0.4 bar", mechanical_loss_slope = "9000 Pa*s/m", '
                'mechanical_loss_square = "90 Pa*s2/m2", mechanical_loss_share = 0.005'
            ),
            (0.4e5, 9000, 90, 0.005),
        ),
    ],
)
def test_losses_take_from_what_the_diagram_gives(losses: str, coefficients: tuple[float, ...]) -> None:
    plain = of_file(ENGINE)
    results = of_file(f"{ENGINE}test = {{ {losses} }}")
    speed, peak = 2 * 0.09 * 3000 / 60, plain["gas_pressure_max"] + plain.machine.gas.ambient
    loss = sum(part * size for part, size in zip(coefficients, (1, speed, speed**2, peak), strict=True))
    assert results["mechanical_loss_pressure"] == pytest.approx(loss, rel=1e-9)
    swept = math.pi / 4 * 0.085**2 * 0.09
    assert results["effective_power"] == pytest.approx((plain["indicated_mean_pressure"] - loss) * swept * 25, rel=1e-9)
    assert results["mechanical_efficiency"] == pytest.approx(1 - loss / plain["indicated_mean_pressure"], rel=1e-9)
    assert results["indicated_power"] == plain["indicated_power"]


def test_what_books_do_not_print_by_hand() -> None:
    """20 kW at 1500 rpm with losses of 5 kW, 80 kg/h of exhaust gas 300 K warmer, and 1590 rpm without load."""
    results = of_file("""
        crank.speed = "1500 rpm"
        [test]
        strokes = 4
        effective_power = "20 kW"
        mechanical_efficiency = 0.8
        idle_speed = "1590 rpm"
        fuel_rate = "5 kg/h"
        fuel_heating_value = "42 MJ/kg"
        air_rate = "75 kg/h"
        exhaust_rise = "300 K"
        exhaust_heat = "1005 J/(kg*K)"
    """)
    known = {
        "effective_torque": 400 / math.pi,
        "mechanical_loss_power": 5000,
        "speed_droop": 0.06,
        "heat_to_exhaust": 6700,
    }
    assert {key: results[key] for key in known} == pytest.approx(known, rel=1e-12)


def test_the_relative_efficiency_is_against_the_cycle_of_otto() -> None:
    """Compressed 32 times, 32^0.4 = 4: three quarters of the heat; 0.3 of 40 kW indicated."""
    results = of_file(
        'test = { indicated_power = "12 kW", fuel_rate = "3.6 kg/h", fuel_heating_value = "40 MJ/kg", '
        "compression_ratio = 32 }"
    )
    assert results["thermal_efficiency"] == pytest.approx(0.75, rel=1e-12)
    assert results["relative_efficiency"] == pytest.approx(0.4, rel=1e-12)


def test_nothing_that_follows_is_refused() -> None:
    with pytest.raises(crankwork.errors.InputError, match=r"test\.fuel_density: says nothing without test\.fuel_flow"):
        of_file('test = { fuel_density = "800 kg/m3" }')
