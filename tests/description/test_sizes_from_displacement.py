"""Bore and stroke from a displacement and stroke over bore.

H. N. Gupta: Fundamentals of internal combustion engines, chapter 16, p. 519: a square V6 of three litres. The printed
values were read from the public notebooks of the examples, github.com/FOSSEE/Python-Textbook-Companions at commit
d34b2ae7e5e6051f7c87531ebc73b154b082d05b, Fundamental_of_internal_combustion_engines_by_H_N_Gupta/chap16.ipynb.
"""

import math
from pathlib import Path

import pytest

import crankwork
from each import for_each
from machine_texts import analysed

SQUARE_V6 = """
crank.speed = "3000 rpm"
rod.length = "172 mm"
cylinder = { displacement = "3 l", stroke_bore_ratio = 1 }
engine = { layout = "V", bank_angle = "60 deg", pin_offset = "-60 deg", cylinders = 6 }
"""


def _one(crank: str, cylinder: str, more: str = "") -> str:
    return f'crank = {{ {crank}speed = "3000 rpm" }}\nrod.ratio = 0.25\ncylinder = {{ {cylinder} }}\n{more}'


@pytest.mark.elsewhere
def test_square_engine_has_the_printed_bore() -> None:
    results = analysed(SQUARE_V6, 20.0)
    assert results["bore"] == pytest.approx(0.086, abs=5e-5)
    assert results["bore"] == pytest.approx(0.0860254013828, rel=1e-11)
    assert results["stroke"] == pytest.approx(results["bore"], rel=1e-14)
    assert results["mean_piston_speed"] == pytest.approx(8.60254013828, rel=1e-11)
    assert results["piston_displacement"][0] == pytest.approx(0.00322426510192, rel=1e-10)
    assert results["piston_velocity"][0] == pytest.approx(5.71171368663, rel=1e-10)


FOUR = 'engine = { layout = "inline", cylinders = 4 }'
# bore and stroke by hand [m]
SIZES = {
    _one('stroke = "80 mm", ', "stroke_bore_ratio = 1"): (0.08, 0.08),
    _one("", 'bore = "80 mm", stroke_bore_ratio = "9/8"'): (0.08, 0.09),
    _one('radius = "40 mm", ', 'displacement = "1.6 l"', FOUR): (math.sqrt(4 * 0.4e-3 / (math.pi * 0.08)), 0.08),
    _one("", 'bore = "80 mm", displacement = "500 cm3"'): (0.08, 4 * 0.5e-3 / (math.pi * 0.08**2)),
    _one("", 'displacement = "1.6 l", stroke_bore_ratio = 0.9', FOUR): (
        math.cbrt(4 * 0.4e-3 / (0.9 * math.pi)),
        0.9 * math.cbrt(4 * 0.4e-3 / (0.9 * math.pi)),
    ),
    _one("", 'displacement = "500 cm3", stroke_bore_ratio = 1', 'piston.mass = "1 kg"\nmethod.pi = 3.14'): (
        math.cbrt(4 * 0.5e-3 / 3.14),
        math.cbrt(4 * 0.5e-3 / 3.14),
    ),
}


def test_a_stroke_beside_a_wanted_power_stays_as_stated() -> None:
    text = Path(__file__).parents[1].joinpath("machines", "wanted-power.toml").read_text("utf-8")
    results = analysed(text.replace("[crank]", '[crank]\nstroke = "137 mm"'))
    assert results["stroke"] == pytest.approx(0.137)
    assert "cycle_rounded_size" not in {notice.code for notice in results.notices}


@pytest.mark.elsewhere
@for_each("text", SIZES)
def test_two_sizes_give_the_others(text: str) -> None:
    results = analysed(text)
    assert (results["bore"], results["stroke"]) == pytest.approx(SIZES[text], rel=1e-12)
    assert results.without_effect == ()


def test_the_sizes_follow_and_are_explained() -> None:
    description = crankwork.Description(SQUARE_V6)
    designs = crankwork.sweep(description, {"cylinder.displacement": ["3 l", "6 l"]}, ["bore", "mean_piston_speed"])
    assert designs.values["bore"] == pytest.approx([0.0860254013828, 0.0860254013828 * math.cbrt(2)], rel=1e-9)
    explained = analysed(SQUARE_V6).explain("bore")
    assert "V_e/i = 0.003/6" in explained
    assert "cylinder.displacement" in explained


MISTAKES = {
    _one("", 'displacement = "500 cm3"'): "cylinder.displacement: bore and stroke follow from two",
    _one('stroke = "80 mm", ', 'bore = "80 mm", stroke_bore_ratio = 1'): "cylinder.stroke_bore_ratio: bore and stroke",
    _one(
        "", 'displacement = "500 cm3", stroke_bore_ratio = 1, offset = "5 mm"'
    ): "cylinder.displacement: with an offset",
    _one("", 'displacement = "500 cm3", stroke_bore_ratio = 9'): "cylinder.stroke_bore_ratio: 9 is out of range",
}


@for_each("text", MISTAKES)
def test_mistakes_are_told(text: str) -> None:
    with pytest.raises(crankwork.InputError) as refused:
        crankwork.read_machine(text)
    assert MISTAKES[text] in str(refused.value)


@for_each(
    ("cylinder", "stroke", "mistakes"),
    [
        ('displacement = "500 cm3"', "86 mm", ["gas.cycle"]),
        ('displacement = "500 cmm3"', "86 mm", ["cylinder.displacement", "gas.cycle"]),
        ('displacement = "500 cm3"', "86 nm", ["crank.stroke", "gas.cycle"]),
        ('displacement = "500 cm3", stroke_bore_ratio = 1', "86 mm", ["cylinder.displacement", "gas.cycle"]),
        ('displacment = "500 cm3"', "86 mm", ["cylinder.displacment", "gas.cycle"]),
        ('displacment = "500 cm3", stroke_bore_ratio = 1', "86 mm", ["cylinder.displacment", "gas.cycle"]),
        ('displacement = "500 cm3", stroke_bore_ration = 1', "86 mm", ["cylinder.stroke_bore_ration", "gas.cycle"]),
    ],
)
def test_a_mistake_elsewhere_takes_no_bore_away(cylinder: str, stroke: str, mistakes: list[str]) -> None:
    gas = """
points.a = { angle = "0 deg", pressure = "0 MPa" }
points.b = { angle = "720 deg", pressure = "0 MPa" }
pieces = [{ law = "constant", points = ["a", "b"] }]
"""
    text = _one(f'stroke = "{stroke}", ', f"{cylinder}, compression_ratio = 9", f'piston.mass = "1 kg"\n[gas]{gas}')
    with pytest.raises(crankwork.InputError) as refused:
        crankwork.read_machine(text)
    assert sorted(line.split(": ")[1] for line in str(refused.value).splitlines()) == sorted(mistakes)
