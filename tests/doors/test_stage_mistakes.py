"""Mistakes in tables of stages, of crossheads and of vessels: each is told once, with what to write instead."""

from pathlib import Path

import pytest

import crankwork
from each import for_each

EXAMPLES = Path(__file__).parents[2] / "examples"
STAGES = 'crank.speed = "300 rpm"\n[stages]\nsuction = "1 bar"\ndischarge = "9 bar"\nexponent = 1.3\n'
TWO = f'{STAGES}count = 2\nflow = "3 m3/min"\n'


def mistakes(text: str) -> dict[str, str]:
    """Return what is told about a text, by key."""
    with pytest.raises(crankwork.InputError) as told:
        crankwork.read_machine(text)
    return {problem.key: str(problem.message) for problem in told.value.problems}


def changed(name: str, old: str, new: str) -> str:
    """Return an example in which one text stands instead of another."""
    text = (EXAMPLES / f"{name}.toml").read_text("utf-8")
    assert old in text
    return text.replace(old, new, 1)


@for_each(
    ("text", "key", "words"),
    [
        (STAGES, "stages", 'flow = "10 m3/min"'),
        (f'{STAGES}bore = "200 mm"', "stages", "stroke"),
        (TWO.replace('crank.speed = "300 rpm"\n', "") + 'stroke = "200 mm"', "crank.speed", "300 rpm"),
        (f'{TWO}between = ["3 bar", "6 bar"]', "stages.between", "1"),
        (f"{TWO}clearance = [0.04, 0.05, 0.06]", "stages.clearance", "2"),
        (f'{TWO}between = "12 bar"', "stages.between", "stage 2"),
        (f'{TWO}between = "3 bar"\nlosses = "3 bar"', "stages.losses", "write a smaller loss"),
        (f'{TWO}losses = "9 bar"', "stages.losses", "before stage 2"),
        (TWO.replace("9 bar", "0.9 bar"), "stages.discharge", "stages.suction is 0.1 MPa"),
        (f'{TWO}temperature = "300 K"\ntemperatures = ["10 K"]', "stages.temperatures", "stages.between"),
        (TWO.replace("flow =", "free_flow ="), "stages.free_flow", 'free_pressure = "0.1 MPa"'),
        (f"{TWO}expansion_exponent = 1".replace("exponent = 1.3", "exponent = 1.2"), "stages.exponent", "1.0001"),
        (TWO.replace("exponent = 1.3", "exponent = [1.3, 1.25]"), "stages.exponent", "between"),
        (f'{TWO}bore = "200 mm"\nstroke = "200 mm"\nclearance = 0.05', "stages.clearance", "leave one"),
        (f'{TWO}shaft_power = "20 kW"\n[efficiency]\nchain = [0.9]', "stages.shaft_power", "efficiency"),
        (f'{TWO}bore = "50 mm"\nstroke = "50 mm"', "stages", "between 0 and 1"),
        (f"{TWO}clearance = 0.9", "stages", ""),
        (f'{TWO}heat_capacity = "1005 J/(kg*K)"', "stages.heat_capacity", "gas_constant"),
        (f'{TWO}water_rise = "20 K"', "stages.water_rise", "heat_capacity"),
        (f"{TWO}ratio_limit = 4", "stages.ratio_limit", "count"),
        (TWO.replace("exponent = 1.3", 'temperature = "300 K"\ndischarge_temperature = "290 K"'),
         "stages.discharge_temperature", ""),
        (changed("two-stage-compressor", '"low_crank"]', '"low_end"]'), "stages.chambers[1][2]", "low_crank"),
        (changed("two-stage-compressor", '"low_crank"]', '"low_head"]'), "stages.chambers[1][1]", "low_head"),
        (changed("two-stage-compressor", "rod_diameter", 'pressure = "2 bar"\nrod_diameter'),
         "chambers.low_crank.pressure", "stage"),
        (changed("two-stage-compressor", 'crosshead_mass = "18 kg"', 'crosshead_mass = "80 kg"'),
         "sliders.low.crosshead_mass", "includes"),
        (changed("triplex-pump", 'mass = "12 kg"', 'mass = "12 kg", crosshead_mass = "1 kg"').replace(
            'slider = "plunger_1"', 'slider = "plunger_2"'), "sliders.plunger_1.crosshead_mass", "plunger_1"),
        (changed("triplex-pump", '"three"]', '"four"]'), "vessels.air.chambers[3]", "three"),
        (changed("triplex-pump", 'length = "160 m"\n', ""), "vessels.air.diameter", "length"),
        (changed("triplex-pump", 'suction_height = "2.5 m"', 'suction_height = "25 m"'),
         "chambers.one.valves.suction_height", "lower"),
    ],
)  # fmt: skip
def test_a_mistake_is_told(text: str, key: str, words: str) -> None:
    told = mistakes(text)
    assert key in told
    assert words in told[key]


def test_a_vessel_of_gas_is_refused() -> None:
    text = changed("double-acting-steam", "[flywheel]", '[vessels.air]\nchambers = ["head"]\n\n[flywheel]')
    assert "density" in mistakes(text)["vessels.air.chambers[1]"]


@for_each(
    ("text", "key", "others"),
    [
        (f'{STAGES}flow = "3 m3/min"\n[cylinder]\nbore = "80 mm"', "stages", "[cylinder]"),
        ('torque.constant = "5 N*m"\n[crank]\nspeed = "20 rpm"\n[rod]\nlength = "1 m"', "rod", "[torque]"),
    ],
)
def test_a_table_of_another_kind_of_file_is_told_with_those_that_exclude_it(text: str, key: str, others: str) -> None:
    """And no table counts as missing."""
    told = mistakes(text)
    assert told.pop(key) == f"belongs to another kind of file than {others}; keep one of them"
    assert told.keys() <= {"crank.radius"}
