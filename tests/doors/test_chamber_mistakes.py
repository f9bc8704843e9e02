"""Mistakes in the gas of a linkage: each is told on its line, with what to write instead, in every language."""

from __future__ import annotations

import re
from pathlib import Path

from each import for_each

EXAMPLES = Path(__file__).parents[2] / "examples"
STIRLING, STEAM, ATKINSON, OPPOSED = "beta-stirling", "double-acting-steam", "atkinson", "opposed-pistons"
HOT = 'slider = "displacer"\nbore = "70 mm"\nsense = -1'
MEAN = 'mean_pressure = "1 MPa"'
HELIUM = 'chambers = ["hot", "cold"]'
FLYWHEEL = "[flywheel]"

# example, the original text, what a user writes, the key blamed, and words of the advice
MISTAKES = {
    "misspelt": (STEAM, 'bore = "300 mm"\nclear', 'boar = "300 mm"\nclear', "chambers.head.boar", "did you mean bore"),
    "no slider": (STIRLING, 'slider = "displacer"\nbore', "bore", "chambers.hot.slider", 'write slider = "piston"'),
    "slider of nothing": (STIRLING, HOT, HOT.replace("displacer", "valve"), "chambers.hot.slider",
        "there is block, displacer, piston, slide"),
    "slider twice": (STIRLING, '{ slider = "piston", bore', '{ slider = "displacer", bore',
        "chambers.cold.faces[2].slider", "displacer is a wall of this chamber already"),
    "no area": (ATKINSON, 'bore = "70 mm"\n', "", "chambers.cylinder.bore", 'write bore = "80 mm" or area = "50 cm2"'),
    "thick rod": (STEAM, '"50 mm"', '"310 mm"', "chambers.crank.rod_diameter", "write a smaller diameter"),
    "faces and face": (STIRLING, "faces = [", 'slider = "piston"\nfaces = [', "chambers.cold.faces",
        "says the same as"),
    "sense": (ATKINSON, "sense = -1", "sense = 2", "chambers.cylinder.sense", "2 is not possible here; write 1 or -1"),
    "no pressure": (ATKINSON, FLYWHEEL, '[chambers.crankcase]\nslider = "piston"\nbore = "70 mm"\n[flywheel]',
        "chambers.crankcase", 'has no pressure; write pressure = "0.5 MPa"'),
    "two pressures": (ATKINSON, "sense = -1", 'sense = -1\npressure = "1 MPa"', "chambers.cylinder.pressure",
        "says the same as points and pieces"),
    "heat without a clearance": (ATKINSON, FLYWHEEL,
        ('[chambers.other]\nslider = "piston"\nbore = "70 mm"\n[chambers.other.cycle]\nkind = "wiebe"\n'
        'cycle_heat = "1 kJ"\n[flywheel]'), "chambers.other", "gas needs its smallest volume"),
    "heat over an area": (ATKINSON, FLYWHEEL,
        ('[chambers.other]\nslider = "piston"\narea = "30 cm2"\ncompression_ratio = 9\n[chambers.other.cycle]\n'
        'kind = "wiebe"\ncycle_heat = "1 kJ"\n[flywheel]'), "chambers.other.cycle", "needs the bore of its cylinder"),
    "heat and points": (ATKINSON, "sense = -1", 'sense = -1\ncycle = { kind = "wiebe", cycle_heat = "1 kJ" }',
        "chambers.cylinder.cycle", "says the same as"),
    "late constant": (ATKINSON, FLYWHEEL,
        '[chambers.crankcase]\nslider = "piston"\nbore = "70 mm"\npressure = "0 MPa"\ndelay = "9 deg"\n[flywheel]',
        "chambers.crankcase.delay", "comes neither early nor late"),
    "pressure of a sealed chamber": (STIRLING, HOT, f'{HOT}\npressure = "1 MPa"', "chambers.hot.pressure",
        "a charge is sealed in this chamber"),
    "no pieces": (OPPOSED, "points = [", "points = 1 #", "chambers.cylinder.pieces[1].points",
        "must be a list in square brackets"),
    "point of nothing": (OPPOSED, 'points = ["c", "z"]', 'points = ["c", "zz"]',
        "chambers.cylinder.pieces[1].points[2]", 'no point "zz" in [chambers.cylinder.points]; did you mean z'),
    "point nowhere": (OPPOSED, 'b = { angle = "112 deg" }', "b = {}", "chambers.cylinder.pieces[2]",
        "needs an angle or a positive pressure"),
    "two places": (STEAM, "b = { stroke = 0.35 }\nc", 'b = { stroke = 0.35, angle = "60 deg" }\nc',
        "chambers.head.points.b.angle", "says the same as stroke"),
    "share of the stroke": (STEAM, "stroke = 0.95", "stroke = 1.95", "chambers.head.points.c.stroke",
        "write a number from 0 to 1"),
    "volume beyond": (OPPOSED, 'b = { angle = "112 deg" }', 'b = { volume = "9 l" }',
        "chambers.cylinder.points.b.volume", "it is between 161.02 and 2576.32 cm3"),
    "open diagram": (OPPOSED, '"4.25 MPa"', '"2 MPa"', "chambers.cylinder.pieces", "does not close"),
    "gap": (ATKINSON, 'r2 = { angle = "226 deg"', 'r2 = { angle = "236 deg"', "chambers.cylinder.pieces[5]",
        "fill the gap"),
    "empty cylinder": (STEAM, "2200 cm3", "0 cm3", "chambers.head.pieces[5]",
        "where the volume is zero; give a clearance"),
    "vacuum": (ATKINSON, '"0.09 MPa"', '"-0.09 MPa"', "chambers.cylinder.points.r2.pressure", "below vacuum"),
    "ambient of gauge": (ATKINSON, 'pressures = "absolute"\n', "", "chambers.cylinder.ambient",
        'write pressures = "absolute"'),
    "period": (ATKINSON, "sense = -1", 'sense = -1\nperiod = "540 deg"', "chambers.cylinder.period",
        'write "360 deg" or "720 deg"'),
    "chamber of nothing": (STIRLING, HELIUM, 'chambers = ["hot", "warm"]', "charges.helium.chambers[2]",
        "there is cold, hot"),
    "two charges": (STIRLING, FLYWHEEL, f'[charges.air]\n{HELIUM}\n{MEAN}\ngas_constant = "287 J/(kg*K)"\n{FLYWHEEL}',
        "charges.air.chambers[1]", "is in another charge already"),
    "no temperature": (STIRLING, 'temperature = "320 K"\nambient', "ambient", "chambers.cold.temperature",
        'as temperature = "300 K"'),
    "dead volume without": (STIRLING, '"30 cm3", temperature = "560 K"', '"30 cm3"',
        "charges.helium.dead_volumes[2].temperature", "the temperature that the charge keeps here"),
    "no gas": (STIRLING, 'gas_constant = "2077 J/(kg*K)"\n', "", "charges.helium.gas_constant", "of air"),
    "no amount": (STIRLING, MEAN, "", "charges.helium", 'write mean_pressure = "1 MPa", or pressure and angle'),
    "two amounts": (STIRLING, MEAN, f'{MEAN}\nmass = "1 g"', "charges.helium.mass", "says the same as mean_pressure"),
    "angle alone": (STIRLING, MEAN, f'{MEAN}\nangle = "30 deg"', "charges.helium.angle",
        "says nothing without pressure"),
    "polytrope with a constant": (STIRLING, MEAN, f"{MEAN}\nexponent = 1.6", "charges.helium.gas_constant",
        "leave it out, or remove the exponent"),
    "temperature unused": (STIRLING, MEAN, f"{MEAN}\nexponent = 1.6", "chambers.hot.temperature", "leave it out"),
    "cold": (STIRLING, '"320 K"\nambient', '"-320 degC"\nambient', "chambers.cold.temperature", "out of range"),
    "crank that swings": (ATKINSON, 'length = "124.3 mm"', 'length = "85 mm"', "chambers", "does not turn fully"),
}  # fmt: skip


@for_each("mistake", MISTAKES)
def test_a_mistake_is_told_on_its_line_with_what_to_write(crankwork, machine_file, check_mistakes, mistake) -> None:
    name, original, written, key, advice = MISTAKES[mistake]
    text = (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")
    assert original in text
    answer = crankwork("check", machine_file(text=text.replace(original, written, 1)))
    check_mistakes(answer)
    told = [one for one in answer.mistakes if re.search(rf"\b{re.escape(key)}\b|{re.escape(key)}:", one)]
    assert told, answer.err
    assert any(advice in one for one in told), answer.err
