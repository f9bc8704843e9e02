"""Compressors in stages with coolers, each from the table of its stages.

R. K. Rajput: A textbook of internal combustion engines. Laxmi Publications, New Delhi. Chapter 20, Air compressors.
P. K. Nag: Basic and applied thermodynamics. Tata McGraw-Hill, New Delhi. Chapter 19. The printed values were read from
the public notebooks of the books' examples, github.com/FOSSEE/Python-Textbook-Companions, and are secondary to them.
Values with more digits than are printed were recalculated from the same numbers. Where a notebook rounds a temperature
to whole kelvins on the way, its value is met to that.
"""

import math
from typing import NamedTuple

import numpy as np
import pytest

from crankwork.analysis import Results
from each import for_each
from machine_texts import analysed

MINUTE, BAR = 60.0, 1e5
# sizes that a pressure was taken for pi in
OTHER_PI = (math.sqrt(55) / math.pi) ** (1 / 3)


class Case(NamedTuple):
    """The tables of a machine file, and what is printed of it: value and tolerance by key, in SI."""

    text: str
    printed: dict[str, tuple[float, float]]


CASES = {
    # p. 751; one kilogram in a second
    "rajput 20.3": Case('stages = { suction = "1 bar", discharge = "10 bar", exponent = 1.2, temperature = "293 K",'
                        ' gas_constant = "287 J/(kg*K)", mass_flow = "1 kg/s" }',
        {"discharge_temperature.1": (430.07, 5e-3), "stage_power": (236.03e3, 5.0)}),
    # p. 752; what the mass and the size give: the clearance too
    "rajput 20.4": Case('crank.speed = "1200 rpm"\n[stages]\nsuction = "1 bar"\ndischarge = "6 bar"\n'
                        'temperature = "293 K"\ndischarge_temperature = "453 K"\ngas_constant = "287 J/(kg*K)"\n'
                        'mass_flow = "1.7 kg/min"\nbore = "140 mm"\nstroke = "100 mm"\nshaft_power = "6.25 kW"',
        {"compression_exponent.1": (1.32132, 5e-6), "clearance_volumetric_efficiency.1": (0.7738758, 5e-8),
         "stage_power": (5350.23, 5e-3), "isothermal_efficiency": (0.7979114, 5e-8),
         "mechanical_efficiency": (0.8560364, 5e-8), "overall_isothermal_efficiency": (0.6830412, 5e-8)}),
    # p. 754; the notebook prints the volumetric efficiency of another example
    "rajput 20.7": Case('stages = { suction = "0.95 bar", discharge = "7 bar", exponent = 1.3, temperature = "305 K",'
                        ' free_pressure = "1.013 bar", free_temperature = "288 K", free_flow = "14 m3/min",'
                        ' clearance = 0.05 }',
        {"stage_power": (63508.913769, 1e-6), "free_volumetric_efficiency": (0.724041280704, 1e-12),
         "clearance_volumetric_efficiency.1": (0.817629438205, 1e-12),
         "discharge_temperature.1": (483.574253918, 1e-9)}),
    # p. 757; four double-acting cylinders, whose suction is warmer than the free air
    "rajput 20.11": Case('crank.speed = "320 rpm"\nstages = { suction = "1 bar", discharge = "16 bar", exponent = 1.32,'
                         ' temperature = "312 K", free_pressure = "1 bar", free_temperature = "300 K",'
                         ' free_flow = "30 m3/min", clearance = 0.04, sides = 8, stroke_bore_ratio = 1.2 }',
        {"bore.1": (0.26271, 5e-6), "stroke": (0.31525, 5e-6)}),
    # p. 758
    "rajput 20.12": Case('crank.speed = "2000 rpm"\nstages = { suction = "1 bar", discharge = "7 bar", exponent = 1.3,'
                         ' temperature = "288 K", gas_constant = "287 J/(kg*K)", mass_flow = "16 kg/min",'
                         ' clearance = 0.04, sides = 2, stroke_bore_ratio = 1.2 }',
        {"bore.1": (0.15970, 5e-6), "stroke": (0.19164, 5e-6)}),
    # p. 759; compression and expansion differ
    "rajput 20.13": Case('crank.speed = "310 rpm"\nefficiency.chain = [0.85]\nstages = { suction = "1 bar",'
                         ' discharge = "7.5 bar", exponent = 1.25, expansion_exponent = 1.3, temperature = "298 K",'
                         ' free_pressure = "1.03 bar", free_temperature = "293 K", free_flow = "2.2 m3/min",'
                         ' clearance = 0.05, sides = 2, stroke_bore_ratio = 1 }',
        {"clearance_volumetric_efficiency.1": (0.814444063901, 1e-12), "bore.1": (0.17978573864, 1e-11),
         "stroke": (0.17978573864, 1e-11), "stage_power": (9438.14820093, 1e-7), "motor_power": (11103.7037658, 1e-6)}),
    # p. 760
    "rajput 20.14": Case('crank.speed = "310 rpm"\nstages = { suction = "1 bar", discharge = "7 bar", exponent = 1.35,'
                         ' flow = "14 m3/min", clearance = 0.05, stroke_bore_ratio = 1.5 }',
        {"bore.1": (0.3575, 5e-5), "stroke": (0.5363, 5e-5)}),
    # p. 762; adiabatic, and warmer behind the cooler
    "rajput 20.16": Case('stages = { count = 2, suction = "1.03 bar", between = "7 bar", discharge = "40 bar",'
                         ' exponent = 1.4, temperature = "300 K", temperatures = "310 K", flow = "30 m3/h" }',
        {"stage_power": (4.19e3, 5.0)}),
    # p. 762; the notebook takes 6 m3/min as 1 m3/min at 6 bar, and strokes as the bore of the first stage
    "rajput 20.17": Case('crank.speed = "400 rpm"\nefficiency.chain = [0.8]\nstages = { count = 2, suction = "1 bar",'
                         ' between = "6 bar", discharge = "40 bar", exponent = 1.3, flow = "6 m3/min",'
                         ' stroke_bore_ratio = 1 }',
        {"bore.1": (0.26730, 5e-6), "bore.2": (0.10913, 5e-6), "motor_power": (57.49e3, 5.0)}),
    # p. 763
    "rajput 20.18": Case('crank.speed = "600 rpm"\nstages = { count = 2, suction = "1 bar", discharge = "7 bar",'
                         ' exponent = 1.25, temperature = "289 K", flow = "0.2 m3/s", gas_constant = "287 J/(kg*K)",'
                         ' heat_capacity = "1.005 kJ/(kg*K)" }',
        {"discharge_pressure.1": (math.sqrt(7) * BAR, 1e-6), "swept_volume.1": (0.02, 1e-12),
         "swept_volume.2": (0.02 / math.sqrt(7), 1e-12), "stage_power": (42.96e3, 5.0),
         "cooler_heat.1": (15.04e3, 5.0)}),
    # p. 765; a second stage draws in a ninth
    "rajput 20.20": Case('stages = { count = 2, suction = "1 bar", between = "7.4 bar", discharge = "42.6 bar",'
                         ' exponent = 1.3, temperature = "288 K",'
                         ' gas_constant = "287 J/(kg*K)", mass_flow = "1 kg/s" }',
        {"specific_work": (388.53e3, 5.0)}),
    # p. 765; of piston speed and volumetric efficiency
    "rajput 20.21": Case('crank.speed = "250 rpm"\nefficiency.chain = [0.75]\nstages = { count = 2,'
                         ' suction = "1.016 bar", discharge = "78.65 bar", exponent = 1.25, temperature = "288 K",'
                         ' flow = "4 m3/min", piston_speed = "3 m/s", volumetric_efficiency = 0.8 }',
        {"stroke": (0.36, 1e-12), "bore.1": (0.27, 5e-3), "motor_power": (49.20e3, 5.0)}),
    # p. 766; temperature and work of a minute are rounded on the way
    "rajput 20.22": Case('crank.speed = "300 rpm"\nstages = { count = 2, suction = "1.013 bar",'
                         ' discharge = "9.117 bar", exponent = 1.3, temperature = "288 K",'
                         ' gas_constant = "287 J/(kg*K)", mass_flow = "4.5 kg/min", clearance = 0.05 }',
        {"stage_power": (15.48e3, 80.0), "swept_volume.1": (0.0131, 5e-5), "swept_volume.2": (0.0044, 5e-5)}),
    # p. 767; the notebook calls the pressure between the stages pi, which its bores are made with
    "rajput 20.23": Case('crank.speed = "210 rpm"\nstages = { count = 2, suction = "1 bar", discharge = "55 bar",'
                         ' exponent = 1.3, temperature = "298 K", flow = "2.2 m3/min", clearance = 0.05,'
                         ' stroke_bore_ratio = 1 }',
        {"stage_power": (18.68e3, 5.0),
         "bore.1": (0.1906 * OTHER_PI, 7e-5), "stroke": (0.1906 * OTHER_PI, 7e-5),
         "bore.2": (0.0700 * OTHER_PI, 7e-5),
         "stage_pressure_ratio.1": (7.4162, 5e-5)}),
    # p. 768; the cooler takes 0.2 bar; the notebook rounds 413.1 to 413 K
    "rajput 20.24": Case('crank.speed = "220 rpm"\nstages = { count = 2, suction = "1 bar", between = "4 bar",'
                         ' losses = "0.2 bar", discharge = "15.2 bar", exponent = 1.3, temperature = "300 K",'
                         ' clearance = 0.04, bore = "360 mm", stroke = "400 mm", sides = 2,'
                         ' gas_constant = "287 J/(kg*K)", heat_capacity = "1.0035 kJ/(kg*K)" }',
        {"cooler_heat.1": (2181.60503695e3 / MINUTE, 1e-6), "bore.2": (0.184676103375, 1e-12),
         "stage_power.2": (45062.1070303, 1e-7), "discharge_temperature.1": (413.102835358, 1e-9),
         "gas_mass_flow": (19.221410709 / MINUTE, 1e-11)}),
    # p. 769; single-acting, and the same mistake
    "rajput 20.25": Case('crank.speed = "200 rpm"\nstages = { count = 2, suction = "1 bar", between = "4.2 bar",'
                         ' losses = "0.2 bar", discharge = "18 bar", exponent = 1.25, temperature = "298 K",'
                         ' clearance = 0.05, bore = "400 mm", stroke = "500 mm", gas_constant = "287 J/(kg*K)",'
                         ' heat_capacity = "1.004 kJ/(kg*K)" }',
        {"stage_power": (85.38e3 * math.pi / 4.2, 5.0),
         # the temperature behind the first stage is rounded to 397 K
         "cooler_heat.1": (1742.36e3 / MINUTE * math.pi / 4.2, 60.0)}),
    # p. 771; clearances that differ
    "rajput 20.26": Case('crank.speed = "440 rpm"\nstages = { count = 2, suction = "1 bar", discharge = "16 bar",'
                         ' exponent = 1.3, temperature = "300 K", clearance = [0.04, 0.06], mass_flow = "10.5 kg/min",'
                         ' gas_constant = "287 J/(kg*K)", heat_capacity = "1.005 kJ/(kg*K)",'
                         ' free_pressure = "1 bar", free_temperature = "300 K" }',
        {"stage_power": (49.23e3, 5.0), "isothermal_power": (41.78e3, 5.0), "isothermal_efficiency": (0.8486, 5e-5),
         "free_air_delivery": (9.04 / MINUTE, 5e-3 / MINUTE), "cooler_heat.1": (19.89e3, 5.0),
         "swept_volume.1": (8.90e-4 / 0.04, 5e-7 / 0.04), "swept_volume.2": (3.48e-4 / 0.06, 5e-7 / 0.06)}),
    # p. 771; works of a minute
    "rajput 20.27": Case('stages = { count = 3, suction = "1.05 bar", discharge = "40 bar", exponent = 1.25,'
                         ' flow = "3 m3/min" }',
        {"stage_power": (1297727.2017 / MINUTE, 1e-6), "isothermal_power": (1146628.12633 / MINUTE, 1e-7),
         "isothermal_efficiency": (0.883566380382, 1e-12), "single_stage_power": (1686780.23364 / MINUTE, 1e-7),
         "stage_saving": (0.230648322867, 1e-12), "discharge_pressure.1": (3.53302081805 * BAR, 1e-6),
         "discharge_pressure.2": (11.8878439055 * BAR, 1e-5)}),
    # p. 819
    "nag 19.3": Case('crank.speed = "800 rpm"\nefficiency.chain = [0.85]\nstages = { suction = "101.3 kPa",'
                     ' discharge = "810.4 kPa", exponent = 1.25, temperature = "288 K", gas_constant = "287 J/(kg*K)",'
                     f' clearance = 0.05, stroke_bore_ratio = 1, bore = "{(8e-3 / math.pi) ** (1 / 3)!r} m" }}',
        {"stage_power": (5475.65638255, 1e-7), "clearance_volumetric_efficiency.1": (0.786098417845, 1e-12),
         "gas_mass_flow": (1.54145895718 / MINUTE, 1e-13), "stage_flow.1": (1.25775746855 / MINUTE, 1e-13),
         "isothermal_efficiency": (0.806428056306, 1e-12), "motor_power": (6441.94868535, 1e-7)}),
}  # fmt: skip

PRINTED = [(name, key, *one) for name, case in CASES.items() for key, one in case.printed.items()]


@pytest.fixture(scope="module")
def results() -> dict[str, Results]:
    return {name: analysed(case.text) for name, case in CASES.items()}


@for_each(("name", "key", "value", "tolerance"), PRINTED, ids=[f"{one[0]}: {one[1]}" for one in PRINTED])
def test_a_printed_value(results: dict[str, Results], name: str, key: str, value: float, tolerance: float) -> None:
    assert results[name][key] == pytest.approx(value, abs=tolerance)


@for_each("name", CASES)
def test_powers_are_the_area_of_the_diagram(results: dict[str, Results], name: str) -> None:
    assert max(results[name].checks.values()) < 1e-12


def test_rajput_20_10() -> None:
    """Page 756: a distance piece of 5.5 mm gives clearance to a stroke of 88 cm, and takes delivery and power alike."""
    text = ('crank.speed = "100 rpm"\nstages = {{ suction = "1.025 bar", discharge = "8.2 bar", exponent = 1.3,'
            ' bore = "500 mm", stroke = "880 mm", clearance = {!r} }}')  # fmt: skip
    one, other = (analysed(text.format(clearance)) for clearance in (0.02, 0.02 + 0.55 / 88))
    assert one["clearance_volumetric_efficiency.1"] == pytest.approx(0.920981897176, rel=1e-11)
    assert other["clearance_volumetric_efficiency.1"] == pytest.approx(0.896288740043, rel=1e-11)
    for key in ("stage_flow.1", "stage_power"):
        assert 1 - other[key] / one[key] == pytest.approx(0.0268117725314, rel=1e-10)


def test_the_best_pressures_behind_coolers_of_any_temperature() -> None:
    """What a search over both pressures finds, by numbers that share no formula with it."""
    scipy = pytest.importorskip("scipy.optimize")
    text = ('stages = { count = 3, suction = "1 bar", discharge = "60 bar", exponent = 1.3, temperature = "290 K",'
            ' temperatures = ["310 K", "325 K"], flow = "1 m3/s" }')  # fmt: skip
    found = analysed(text)
    temperatures = 290.0, 310.0, 325.0

    def work(logarithms: np.ndarray) -> float:
        pressures = [1.0, *np.exp(logarithms), 60.0]
        return sum(T * ((high / low) ** (0.3 / 1.3) - 1)
                   for T, low, high in zip(temperatures, pressures, pressures[1:], strict=False))  # fmt: skip

    best = scipy.minimize(work, np.log([4.0, 16.0]), tol=1e-14)
    for number, logarithm in enumerate(best.x, start=1):
        assert found[f"discharge_pressure.{number}"] / BAR == pytest.approx(math.exp(logarithm), rel=1e-6)
    works = [found[f"stage_power.{number}"] / (found[f"suction_temperature.{number}"]) for number in (1, 2, 3)]
    heats = [found[f"discharge_temperature.{number}"] for number in (1, 2, 3)]
    assert heats == pytest.approx([heats[0]] * 3, rel=1e-12)
    assert works[0] > works[1] > works[2]


@for_each(("limit", "count", "needed"), [
    ("ratio_limit = 4", 3, math.log(60) / math.log(4)),
    ('temperature_limit = "420 K"', 3, math.log(60) / (math.log(420 / 290) * 1.3 / 0.3)),
    # the ratio of four equal stages is no fifth one
    (f"ratio_limit = {60 ** 0.25!r}", 4, 4.0),
], ids=["ratio", "temperature", "exactly"])  # fmt: skip
def test_the_number_of_stages(limit: str, count: int, needed: float) -> None:
    text = ('stages = {{ {}, suction = "1 bar", discharge = "60 bar", exponent = 1.3, temperature = "290 K",'
            ' flow = "1 m3/s" }}')  # fmt: skip
    found = analysed(text.format(limit))
    assert found["stage_count"] == count
    assert found["needed_stages"] == pytest.approx(needed, rel=1e-12)
    assert found[f"discharge_pressure.{count}"] == pytest.approx(60 * BAR, rel=1e-12)


def test_heats_and_cooling_water() -> None:
    """All power leaves as heat where the gas leaves as warm as it came; water by its own balance."""
    text = ('stages = {{ count = 2, suction = "1 bar", discharge = "16 bar", exponent = 1.3, temperature = "300 K",'
            ' final_temperature = "300 K", flow = "10 m3/min", gas_constant = "287 J/(kg*K)",'
            ' heat_capacity = "1005 J/(kg*K)", {} }}')  # fmt: skip
    found = analysed(text.format('water_rise = "20 K"'))
    assert found["heat_removed"] == pytest.approx(found["stage_power"], rel=1e-12)
    mass = 1e5 * 10 / 60 / (287 * 300)
    heat = 2 * mass * 1005 * 300 * (4 ** (0.3 / 1.3) - 1)
    assert found["cooler_heat"] == pytest.approx(heat, rel=1e-12)
    assert found["specific_cooler_heat.1"] == pytest.approx(heat / 2 / mass, rel=1e-12)
    assert found["water_flow"] == pytest.approx(heat / (4186.8 * 20), rel=1e-12)
    flow = f'water_flow = "{heat / (4186.8 * 20) * 3600!r} kg/h"'
    assert analysed(text.format(flow))["water_rise"] == pytest.approx(20.0, rel=1e-12)


def test_stages_of_chambers() -> None:
    """Two pistons with the bores of R. K. Rajput, example 20.24, on one crank take the pressures of their stages."""
    machine = """
    fixed_points.O = ["0 mm", "0 mm"]
    crank = { pivot = "O", pin = "A", radius = "200 mm", speed = "220 rpm", start = "180 deg" }
    links.rod = { joins = ["A", "B"], length = "1 m" }
    links.other = { joins = ["A", "C"], length = "1 m" }
    guides.bed = { through = "O" }
    guides.up = { through = "O", angle = "90 deg" }
    sliders.low = { guide = "bed", pin = "B" }
    sliders.high = { guide = "up", pin = "C" }
    branch = { B = -1, C = -1 }
    stages.suction = "1 bar"
    stages.between = "4 bar"
    stages.losses = "0.2 bar"
    stages.discharge = "15.2 bar"
    stages.exponent = 1.3
    stages.temperature = "300 K"
    stages.gas_constant = "287 J/(kg*K)"
    stages.heat_capacity = "1.0035 kJ/(kg*K)"
    stages.chambers = [["low_head", "low_crank"], ["high_head", "high_crank"]]
    """
    for slider, bore in (("low", "360 mm"), ("high", "{bore} mm")):
        for name, sense in (("head", 1), ("crank", -1)):
            machine += f'\nchambers.{slider}_{name} = {{ slider = "{slider}", bore = "{bore}", sense = {sense},'
            machine += " compression_ratio = 26 }"
    found = analysed(machine.replace("{bore}", "184.676103375"))
    assert found["cooler_heat.1"] == pytest.approx(2181.60503695e3 / MINUTE, rel=1e-10)
    assert found["stage_power.2"] == pytest.approx(45062.1070303, rel=1e-10)
    assert -found["indicated_power"] == pytest.approx(found["stage_power"], rel=1e-10)
    assert found["gas_mass_flow"] == pytest.approx(19.221410709 / MINUTE, rel=1e-10)
    assert found["stage_flow_error.2"] == pytest.approx(0.0, abs=1e-10)
    assert not found.unmet
    assert not [one for one in found.notices if one.code == "stage_flow"]
    larger = analysed(machine.replace("{bore}", "190"))
    assert [one.code for one in larger.notices].count("stage_flow") == 1
    assert larger["stage_flow_error.2"] == pytest.approx((190 / 184.676103375) ** 2 - 1, rel=1e-9)


def test_sizes_beside_a_delivery_give_the_clearance() -> None:
    """Four fifths of what 200 mm over 300 mm sweep 5 times a second; expansion by a square root of 9."""
    swept = math.pi / 4 * 0.2**2 * 0.3 * 5
    results = analysed(f"""
        crank.speed = "300 rpm"
        [stages]
        suction = "1 bar"
        discharge = "9 bar"
        exponent = 1.3
        expansion_exponent = 2
        bore = "200 mm"
        stroke = "300 mm"
        flow = "{0.8 * swept!r} m3/s"
    """)
    # 0.2 = k (sqrt(9) - 1)
    assert results["clearance_ratio.1"] == pytest.approx(0.1, rel=1e-9)
