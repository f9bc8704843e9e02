"""Indicator cards: power from the area of a card, and a compression ratio from two points of its line.

P. K. Nag: Basic and applied thermodynamics. Tata McGraw-Hill, New Delhi. Chapter 3, page 56. H. N. Gupta: Fundamental
of internal combustion engines. PHI Learning, New Delhi. Chapter 16, page 523. M. L. Mathur, R. P. Sharma: Internal
combustion engine. Dhanpat Rai, New Delhi. Chapter 2, page 83. The printed values were read from the public notebooks of
the books' examples, github.com/FOSSEE/Python-Textbook-Companions at commit d34b2ae7e5e6051f7c87531ebc73b154b082d05b,
files Basic_And_Applied_Thermodynamics_by_P._K._Nag/Chapter03.ipynb,
Fundamental_of_internal_combustion_engines_by_H_N_Gupta/chap16.ipynb and
Internal_Combustion_Engine_by_M._l._Mathur_and_R._P._Sharma/ch2_2.ipynb, so they are secondary to the books.

A card is told by its area; one of constant pressure over the stroke that works has the same.
"""

import math

import pytest

import crankwork
from machine_texts import analysed

ENGINE = """
crank = {{ stroke = "{stroke} m", speed = "{speed} rpm" }}
rod.ratio = 0.25
cylinder.bore = "{bore} m"
engine = {{ layout = "inline", cylinders = {cylinders}, strokes = {strokes}{order} }}
gas.cycle = "{cycle} deg"
gas.points.a = {{ angle = "0 deg", pressure = "{mean!r} bar" }}
gas.points.b = {{ angle = "180 deg" }}
gas.points.c = {{ angle = "180 deg", pressure = "0 bar" }}
gas.points.d = {{ angle = "{cycle} deg", pressure = "{mean!r} bar" }}
gas.pieces = [{{ law = "constant", points = ["a", "b"] }}, {{ law = "constant", points = ["c", "d"] }}]
"""


def test_nag_3_4() -> None:
    """Twelve cylinders of two strokes: 5.5 cm2 over 6 cm with a spring of 147 MPa/m."""
    mean = 5.5e-4 / 0.06 * 147 * 10
    order = f", firing_order = {list(range(1, 13))}"
    text = ENGINE.format(stroke=1.2, speed=150, bore=0.8, cylinders=12, strokes=2, cycle=360, mean=mean, order=order)
    found = analysed(text)
    assert found["indicated_mean_pressure"] == pytest.approx(1.3475e6, rel=1e-12)
    assert found.summary["indicated_power"] == pytest.approx(24383785.5401, rel=1e-11)


def test_gupta_16_5() -> None:
    """The loop of the gas exchange, 25 mm2, taken off that of the work, 475 mm2, over 50 mm and 0.8333 bar/mm."""
    mean = (475 - 25) / 50 * 0.8333
    text = ENGINE.format(stroke=0.16, speed=500, bore=0.15, cylinders=1, strokes=4, cycle=720, mean=mean, order="")
    found = analysed(text)
    assert found["indicated_mean_pressure"] == pytest.approx(7.4997e5, rel=1e-12)
    assert found["indicated_power"] == pytest.approx(8835.37590905, rel=1e-11)


def test_mathur_2_10() -> None:
    """The pressure doubles from 30 to 70 per cent of the compression stroke on a polytrope of 1.33."""
    at = 360 - math.degrees(math.acos(1 - 2 * 0.3))
    description = crankwork.Description("""
        fixed_points.O = ["0 mm", "0 mm"]
        crank = { pivot = "O", pin = "C", radius = "50 mm", speed = "600 rpm" }
        guides = { bore = { through = "O" }, slot = { link = "piston", angle = "90 deg" } }
        sliders = { piston = { guide = "bore" }, block = { pin = "C", guide = "slot" } }
        chambers.gas.slider = "piston"
        chambers.gas.bore = "80 mm"
        chambers.gas.sense = -1
        chambers.gas.compression_ratio = 8.0
        chambers.gas.pressures = "absolute"
        chambers.gas.ambient = "1 bar"
        chambers.gas.points.expanded = { angle = "0 deg" }
        chambers.gas.points.started = { angle = "180 deg" }
        chambers.gas.points.a = { stroke = 0.7, pressure = "1.33 bar" }
        chambers.gas.points.compressed = { angle = "360 deg" }
        chambers.gas.pieces = [
            { law = "polytropic", exponent = 1.33, reference = "a", points = ["expanded", "started"] },
            { law = "polytropic", exponent = 1.33, reference = "a", points = ["started", "compressed"] },
        ]
    """)
    wanted = f"diagram_pressure.gas@{at!r}deg = 2.66 bar"
    found = crankwork.solve(description, wanted, "chambers.gas.compression_ratio", limits=("2", "20"), steps=10)
    (root,) = found.roots
    # printed 4.51
    assert root.at == pytest.approx(4.51114058603, rel=1e-10)
