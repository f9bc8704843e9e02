"""Forces over a share of the stroke, between two positions, and tables over the relative stroke."""

import math

import pytest

import crankwork
from each import for_each
from machine_texts import SLIDER_CRANK, analysed


def _with(load: str) -> str:
    return f"{SLIDER_CRANK}loads = [{{ {load} }}]"


def _place(degrees: float) -> float:
    """Return the distance of the pin of the slider from the pivot, by the lengths alone. [m]"""
    phi = math.radians(degrees)
    return 0.05 * math.cos(phi) + math.sqrt(0.2**2 - (0.05 * math.sin(phi)) ** 2)


def _rod(degrees: float) -> float:
    """Return the angle of the rod. [rad]"""
    return -math.asin(0.25 * math.sin(math.radians(degrees)))


RAM = 'kind = "process", slider = "ram", '
# work of a turn: force times distance [J]
WORKS = {
    RAM + 'at = [0.3, 1], force = "1 kN"': 70.0,
    RAM + 'at = ["1/3", 1], force = "1 kN"': 200 / 3,
    RAM + 'at = ["5 %", "95%"], force = "1 kN"': 90.0,
    RAM + 'at = [0.25, 0.75], force = ["1 kN"], stroke = "falling"': 50.0,
    RAM + 'at = [0.25, 0.75], force = "1 kN", acts = "both"': 0.0,
    RAM + 'at = ["30 mm", "80 mm"], force = "1 kN"': 50.0,
    # areas of trapezia: 0.05 m (0 + 100 N) / 2 + 0.05 m (200 + 1000 N) / 2
    RAM + 'at = [0, 0.5, 0.5, 1], force = ["0 N", "100 N", "200 N", "1 kN"]': 32.5,
    RAM + 'at = ["200 deg", "300 deg"], against = "angle", force = "1 kN"': 1e3 * (_place(300) - _place(200)),
    RAM + 'at = ["330 deg", "380 deg"], against = "angle", acts = "both", force = "1 kN"': 1e3
    * (_place(20) - _place(330)),
    'kind = "torque", link = "rod", at = ["350 deg", "380 deg"], torque = "10 N*m"': -10 * (_rod(20) - _rod(-10)),
}


@pytest.mark.elsewhere
@for_each("load", WORKS)
def test_work_is_that_of_the_part_of_the_stroke(load: str) -> None:
    results = analysed(_with(load))
    assert results["mean_torque"] * math.tau == pytest.approx(WORKS[load], rel=1e-12, abs=1e-9)
    assert max(results.checks.values()) < 1e-12
    assert results.without_effect == ()


@pytest.mark.elsewhere
def test_the_share_follows_the_stroke() -> None:
    text = _with(RAM + 'at = [0.3, 1], force = "1 kN"')
    for radius in (40, 60):
        results = analysed(text.replace("50 mm", f"{radius} mm"))
        assert results["mean_torque"] * math.tau == pytest.approx(0.7 * 2 * radius, rel=1e-12)
    designs = crankwork.sweep(crankwork.Description(text), {"crank.radius": ["40 mm", "60 mm"]}, ["mean_torque"])
    assert designs.values["mean_torque"] * math.tau == pytest.approx([56.0, 84.0], rel=1e-9)


def test_the_calculation_tells_the_share_as_it_is_stated() -> None:
    results = analysed(_with(RAM + 'at = [0, 0.5, 0.5, 1], force = ["0 N", "100 N", "200 N", "1 kN"]'))
    explained = results.explain("static_torque", 250.0)
    assert "loads[1].at[2]" in explained
    assert "0.5" in explained


MISTAKES = {
    'at = [0.3, "100 mm"], force = "1 kN"': "loads[1].at: holds shares of the stroke and lengths",
    'at = [0.3, 1.2], force = "1 kN"': "loads[1].at[2]: 1.2 is out of range",
    'at = [0.6, 0.3], force = "1 kN"': "loads[1].at: must rise",
    'at = [0.3, 1], force = "1 kN", start = "10 mm"': "loads[1].start: has no effect",
    'at = [0.3, 1], force = "1 kN", against = "angle"': "loads[1].at: must hold values of one kind, angles",
    'at = [0.3, 0.6, 1], force = "1 kN"': "loads[1].at: has 3 values for 1",
}


@for_each("load", MISTAKES)
def test_mistakes_are_told(load: str) -> None:
    with pytest.raises(crankwork.InputError) as refused:
        crankwork.read_machine(_with(RAM + load))
    assert MISTAKES[load] in str(refused.value)
