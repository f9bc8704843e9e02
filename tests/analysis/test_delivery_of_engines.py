"""What pumps and compressors of several cylinders deliver: without an owner it is the whole machine's."""

from __future__ import annotations

import math

import pytest

import crankwork
from crankwork.description.shorthand import expanded
from crankwork.report.summary import description_text
from expansions import of_linkage

# per cylinder: piston area times stroke, 300 times a minute [m3/s]
ONE = math.pi / 4 * 0.0635**2 * 0.127 * 300 / 60
TRIPLEX = """
format = 2
[crank]
stroke = "127 mm"
speed = "300 rpm"
[rod]
length = "400 mm"
mass = "25 kg"
small_end_share = 0.35
[piston]
mass = "30 kg"
[cylinder]
bore = "63.5 mm"
clearance_volume = "400 cm3"
[engine]
layout = "inline"
cylinders = 3
spacing = "200 mm"
[gas]
cycle = "360 deg"
pressures = "absolute"
ambient = "1.013 bar"
[gas.valves]
suction = "3 bar"
discharge = "350 bar"
"""
LOW, HIGH, EXPONENT, CLEARANCE = 1e5, 6e5, 1.3, 32e-6
COMPRESSOR = """
format = 2
[crank]
radius = "40 mm"
speed = "960 rpm"
[rod]
length = "180 mm"
[cylinder]
bore = "100 mm"
clearance_volume = "32 cm3"
[engine]
layout = "inline"
cylinders = 2
strokes = 2
[gas]
cycle = "360 deg"
pressures = "absolute"
[gas.valves]
suction = "1 bar"
discharge = "6 bar"
compression_exponent = 1.3
temperature = "300 K"
gas_constant = "287 J/(kg*K)"
free_pressure = "101.325 kPa"
free_temperature = "288 K"
delivered = "0.9 m3/min"
"""


def analysed(text: str, *settings: str) -> crankwork.Results:
    return crankwork.analyse(crankwork.read_machine(text, overrides=settings))


@pytest.mark.elsewhere
def test_flow_of_a_triplex_pump_is_that_of_its_three_plungers():
    results = analysed(TRIPLEX)
    assert results.summary["inlet_flow"] == pytest.approx(3 * ONE, rel=1e-12)
    assert results.summary["inlet_flow"] * 60 == pytest.approx(0.36198, abs=5e-6)
    assert results.summary["inlet_flow.of_cylinder"] == pytest.approx(ONE, rel=1e-12)
    assert results.trace["inlet_flow"].value == results.summary["inlet_flow"]


def test_flow_of_one_cylinder_needs_no_owner():
    results = analysed(TRIPLEX, "engine.cylinders=1")
    assert results.summary["inlet_flow"] == pytest.approx(ONE, rel=1e-12)
    assert [key for key in results.summary if key.startswith("inlet_flow.")] == []


@pytest.mark.elsewhere
def test_unlike_cylinders_add_up():
    results = analysed(
        TRIPLEX, 'engine.offsets=["0 mm", "30 mm", "-60 mm"]', "engine.uneven=true",
        'engine.throws=["0 deg", "120 deg", "240 deg"]',
    )  # fmt: skip
    radius, length = 0.0635, 0.4
    each = [
        math.sqrt((length + radius) ** 2 - offset**2) - math.sqrt((length - radius) ** 2 - offset**2)
        for offset in (0.0, 0.03, 0.06)
    ]
    area = math.pi / 4 * 0.0635**2
    for number, stroke in enumerate(each, start=1):
        assert results.summary[f"inlet_flow.{number}"] == pytest.approx(area * stroke * 5, rel=1e-9)
    assert results.summary["inlet_flow"] == pytest.approx(area * sum(each) * 5, rel=1e-9)


@pytest.mark.elsewhere
def test_mass_power_and_slip_are_those_of_both_cylinders():
    found = analysed(COMPRESSOR).summary
    swept = math.pi / 4 * 0.1**2 * 0.08
    drawn = swept + CLEARANCE - CLEARANCE * (HIGH / LOW) ** (1 / EXPONENT)
    flow = 2 * drawn * 960 / 60
    least = LOW * flow * math.log(HIGH / LOW)
    power = EXPONENT / (EXPONENT - 1) * LOW * flow * ((HIGH / LOW) ** (1 - 1 / EXPONENT) - 1)
    wanted = {
        "inlet_flow": flow,
        "gas_mass_flow": LOW * flow / (287 * 300),
        "free_air_delivery": flow * LOW / 101325 * 288 / 300,
        "isothermal_power": least,
        "isothermal_efficiency": least / power,
        "indicated_power": -power,
        "discharge_coefficient": 0.9 / 60 / flow,
        "pump_slip": 1 - 0.9 / 60 / flow,
        "induced_volume": drawn,
    }
    assert {key: found[key] for key in wanted} == pytest.approx(wanted, rel=1e-12)


def test_it_is_that_of_the_linkage_with_a_chamber_for_each_cylinder(tmp_path):
    (tmp_path / "gear.toml").write_text(TRIPLEX, "utf-8")
    linkage = of_linkage(crankwork.read_machine(expanded(tmp_path / "gear.toml")))
    engine = analysed(TRIPLEX).summary
    assert linkage.summary["inlet_flow"] == pytest.approx(engine["inlet_flow"], rel=1e-12)
    assert linkage.summary["inlet_flow.cylinder_2"] == pytest.approx(engine["inlet_flow.of_cylinder"], rel=1e-12)


@pytest.mark.parametrize(
    ("language", "of_all", "of_one"),
    [
        ("en", "inlet volume flow, all cylinders", "inlet volume flow, of one cylinder"),
        ("ru", "объёмный расход по условиям всасывания, все цилиндры",
         "объёмный расход по условиям всасывания, одного цилиндра"),
        ("vi", "lưu lượng thể tích hút, tất cả các xi lanh", "lưu lượng thể tích hút, của một xi lanh"),
    ],
)  # fmt: skip
def test_it_is_said_whose_flow_it_is(language, of_all, of_one):
    told = description_text(analysed(TRIPLEX), language)
    assert of_all in told
    assert of_one in told
    assert "all" not in description_text(analysed(TRIPLEX, "engine.cylinders=1"), "en").partition("inlet")[2][:30]


def test_cylinders_that_stay_open_deliver_nothing():
    one = analysed(COMPRESSOR).summary["inlet_flow.of_cylinder"]
    results = analysed(COMPRESSOR, "engine.misfire=[2]", "gas.motored=ambient")
    assert results.summary["inlet_flow"] == pytest.approx(one, rel=1e-12)
