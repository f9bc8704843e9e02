"""What is refused of valves that open by themselves, at its place and with its fix."""

from __future__ import annotations

import pytest

import crankwork
from crankwork import CrankworkError
from crankwork.description.shorthand import expanded
from each import for_each

GEAR = """
[crank]
radius = "40 mm"
speed = "960 rpm"
[rod]
length = "180 mm"
[cylinder]
bore = "100 mm"
clearance_volume = "{clearance} cm3"
[gas]
cycle = "{cycle} deg"
pressures = "{pressures}"
[gas.valves]
suction = "0.1 MPa"
discharge = "{discharge} MPa"
{valves}
"""
GAS = "compression_exponent = 1.3"


def refused(clearance=32, cycle=360, pressures="absolute", discharge=0.6, valves=GAS, more="") -> str:
    text = GEAR.format(clearance=clearance, cycle=cycle, pressures=pressures, discharge=discharge, valves=valves)
    with pytest.raises(CrankworkError) as error:
        crankwork.analyse(crankwork.read_machine(text + more))
    return str(error.value)


@for_each(
    ("how", "place", "fix"),
    [
        ({"discharge": 0.1}, "gas.valves.discharge", "write the larger one as discharge"),
        ({"clearance": 500}, "gas.valves.discharge", "write a smaller pressure, or a smaller clearance"),
        ({"cycle": 720}, "gas.valves", '"360 deg"'),
        ({"pressures": "gauge"}, "gas.valves", '"absolute"'),
        ({"valves": "expansion_exponent = 1.2"}, "gas.valves.expansion_exponent", "add compression_exponent = 1.3"),
        ({"valves": 'temperature = "300 K"\ndischarge_temperature = "2000 K"'}, "gas.valves.discharge_temperature",
         "write one between 300 and 1800 K"),
        ({"valves": f'{GAS}\nfree_pressure = "1 bar"'}, "gas.valves.free_pressure", "temperature"),
        ({"more": '[gas.points]\na = { angle = "0 deg", pressure = "0.1 MPa" }'}, "gas.points", "valves"),
    ],
)  # fmt: skip
def test_what_valves_cannot_do(how, place, fix):
    told = refused(**how)
    assert place in told or place.rpartition(".")[0] in told
    assert fix in told


PUMP = """
[fixed_points]
O = ["0 mm", "0 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "100 mm"
speed = "60 rpm"
points = {{ H = ["0 mm", "60 mm"] }}
[geared.fast]
pivot = "O"
ratio = 3
points = {{ G = ["50 mm", "0 mm"] }}
[guides]
bore = {{ through = "O" }}
slot = {{ link = "plunger", angle = "90 deg" }}
[sliders]
plunger = {{ guide = "bore" }}
block = {{ pin = "{pin}", guide = "slot" }}
[chambers.water]
slider = "plunger"
bore = "50 mm"
pressures = "absolute"
[chambers.water.valves]
suction = "0.1 MPa"
discharge = "0.2 MPa"
"""


def test_a_volume_that_turns_back_four_times_has_no_valves():
    with pytest.raises(
        CrankworkError, match=r"chambers\.water\.valves: .* turns back 6 times; state points and pieces"
    ):
        crankwork.analyse(crankwork.read_machine(PUMP.format(pin="G")))


def test_a_pressure_factor_of_zero_leaves_nothing_to_compare():
    text = GEAR.format(clearance=32, cycle=360, pressures="absolute", discharge=0.6, valves=GAS)
    text += '[engine]\nlayout = "inline"\ncylinders = 2\nstrokes = 2\npressure_factors = [0.0, 1.0]\n'
    assert not crankwork.analyse(crankwork.read_machine(text)).unmet


def test_valves_of_a_crank_gear_written_out_are_those_of_a_chamber(tmp_path):
    path = tmp_path / "gear.toml"
    path.write_text(GEAR.format(clearance=32, cycle=360, pressures="absolute", discharge=0.6, valves=GAS))
    alone, written = crankwork.analyse(crankwork.load(path)), crankwork.analyse(crankwork.read_machine(expanded(path)))
    for key in ("clearance_volumetric_efficiency", "inlet_flow", "indicated_power", "isothermal_efficiency"):
        assert written[f"{key}.cylinder"] == pytest.approx(alone[key], rel=1e-12)


@for_each(
    ("valves", "told"),
    [
        ('suction_pipe = { length = "5 m", diameter = "50 mm" }', "suction_pipe: says nothing without density; add"),
        ('density = "1000 kg/m3"\ncompression_exponent = 1.3', "compression_exponent"),
        ('density = "1000 kg/m3"\nsuction_pipe = { length = "5 m" }', "suction_pipe.diameter"),
    ],
)
def test_pipes_carry_a_liquid(valves, told):
    with pytest.raises(CrankworkError) as error:
        crankwork.read_machine(PUMP.format(pin="A") + valves)
    assert told in str(error.value)
