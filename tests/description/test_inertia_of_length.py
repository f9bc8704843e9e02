"""Masses and moments of inertia as sheets state them: per length, a share of m l^2, or of a bar about its end."""

from pathlib import Path

import pytest

import crankwork
from each import for_each

# the press of a course project, whose note prints 7.653 and 0.56264 kg m2 for rod and rocker
PRESS = Path(__file__).parents[2].joinpath("examples", "press-geometry.toml").read_text("utf-8")
ROD, ROCKER = '"7.653 kg*m2"', '"0.56264 kg*m2"'
CRANK = """
fixed_points.O = ["0 mm", "0 mm"]
crank = { pivot = "O", pin = "A", radius = "60 mm", speed = "60 rpm", mass = "5 kg", CENTRE, inertia = "m l^2 / 3" }
links.rod = { joins = ["A", "B"], length = "200 mm" }
guides.bed = { angle = "0 deg" }
sliders.ram = { guide = "bed", pin = "B" }
positions.B = ["260 mm", "0 mm"]
"""
MIDDLE = 'centre = ["30 mm", "0 mm"]'


def _inertia(text: str, name: str) -> float:
    linkage = crankwork.read_machine(text).linkage
    return next(member.inertia for member in linkage.members if member.name == name)


@pytest.mark.elsewhere
@for_each("spelling", ["m l^2 / 12", "m l²/12", "m*l^2/12", "ml²/12", "1/12 m l^2", "m·l^2 / 12", "m l**2 / 12"])
def test_a_bar_about_its_centre_has_the_printed_value(spelling: str) -> None:
    assert _inertia(PRESS.replace(ROD, f'"{spelling}"'), "rod") == pytest.approx(7.653, rel=1e-9)


@pytest.mark.elsewhere
def test_a_bar_about_its_end_is_recalculated_to_its_centre() -> None:
    assert _inertia(PRESS.replace(ROCKER, '"m l^2 / 3"'), "rocker") == pytest.approx(0.56264, abs=5e-6)


@pytest.mark.elsewhere
def test_other_shares_are_about_the_centre_of_mass() -> None:
    # 0.17 m l^2 with 255.1 kg and 0.6 m
    assert _inertia(PRESS.replace(ROD, '"0.17 m l^2"'), "rod") == pytest.approx(0.17 * 255.1 * 0.36, rel=1e-12)


@pytest.mark.elsewhere
def test_a_crank_turns_with_a_third_of_its_mass_times_its_square() -> None:
    results = crankwork.analyse(crankwork.read_machine(CRANK.replace("CENTRE", MIDDLE)))
    assert results["reduced_inertia"] == pytest.approx(5 * 0.06**2 / 3, rel=1e-12)


def test_it_follows_mass_and_length_and_is_explained() -> None:
    text = PRESS.replace(ROD, '"m l^2 / 12"').replace(ROCKER, '"m l^2 / 3"')
    designs = crankwork.sweep(
        crankwork.Description(text), {"links.rod.mass": ["200 kg", "300 kg"]}, ["reduced_inertia_max"]
    )
    plain = [
        crankwork.analyse(crankwork.read_machine(
            PRESS.replace(ROD, f'"{mass * 0.36 / 12!r} kg*m2"').replace("255.1 kg", f"{mass} kg")
            .replace(ROCKER, f'"{153.1 * 0.21**2 / 12!r} kg*m2"')
        ))["reduced_inertia_max"]
        for mass in (200, 300)
    ]  # fmt: skip
    assert designs.values["reduced_inertia_max"] == pytest.approx(plain, rel=1e-9)
    assert designs.reason == ""
    explained = crankwork.analyse(crankwork.read_machine(text)).explain("reduced_inertia", 30)
    assert "J_S,rod = k_J,rod·m_rod·l_rod²" in explained
    assert "J_S,rocker = J_e,rocker − m_rocker·l_rocker²/4" in explained


@for_each("stated", ["425.1666666667 kg/m", "425.1666666667 кг/м", "4169.46069416711 N/m"])
def test_a_mass_per_length_is_that_of_the_whole_link(stated: str) -> None:
    # 255.1 kg over 0.6 m, and its weight with the standard gravity
    machine = crankwork.read_machine(PRESS.replace("255.1 kg", stated))
    assert next(member.mass for member in machine.linkage.members if member.name == "rod") == pytest.approx(255.1)
    crank = CRANK.replace("5 kg", "80 kg/m").replace("CENTRE", "centre = 0.5")
    assert crankwork.analyse(crankwork.read_machine(crank))["reduced_inertia"] == pytest.approx(4.8 * 0.06**2 / 3)


def test_a_mass_per_length_follows_the_length_and_is_explained() -> None:
    text = PRESS.replace("255.1 kg", "400 kg/m").replace(ROD, '"m l^2 / 12"')
    lengths, keys = (0.58, 0.62), ["reduced_inertia_max", "joint_force_max.A"]
    designs = crankwork.sweep(crankwork.Description(text), {"links.rod.length": lengths}, keys)
    assert designs.reason == ""
    for number, length in enumerate(lengths):
        mass = 400 * length
        plain = crankwork.analyse(crankwork.read_machine(
            PRESS.replace(ROD, f'"{mass * length**2 / 12!r} kg*m2"').replace("255.1 kg", f"{mass!r} kg")
            .replace('"600 mm"', f'"{length * 1e3} mm"')
        ))  # fmt: skip
        for key in keys:
            assert designs.values[key][number] == pytest.approx(plain[key], rel=1e-9, abs=1e-12), key
    assert "m_rod = m_l,rod·l_rod" in crankwork.analyse(crankwork.read_machine(text)).explain("reduced_inertia", 30)


MISTAKES = {
    PRESS.replace("81.6 kg", "81.6 kg/m"): "unit \"kg/m\" measures mass per length",
    PRESS.replace(ROD, '"m l^2 / 2"'): "links.rod.inertia: \"m l^2 / 2\" is not the moment of inertia of a link",
    PRESS.replace(ROD, '"m l"'): "links.rod.inertia: \"m l\" is not a number with a unit",
    PRESS.replace(ROD, '"m l^2 / 0"'): "links.rod.inertia: \"m l^2 / 0\" is not the moment",
    PRESS.replace(ROD, '"m l^2 / 3"').replace('S2 = ["300 mm"', 'S2 = ["200 mm"'):
        "links.rod.inertia: \"m l^2 / 3\" is that",
    PRESS.replace(', mass = "255.1 kg"', "").replace(ROD, '"m l^2 / 12"'):
        "links.rod.inertia: says nothing without mass",
    CRANK.replace('mass = "5 kg", CENTRE, ', ""): "crank.inertia: says nothing without mass",
    CRANK.replace("CENTRE", 'centre = "A"'): "crank.inertia: \"m l^2 / 3\" is that of a bar about its end",
}  # fmt: skip


@for_each("text", MISTAKES)
def test_mistakes_are_told(text: str) -> None:
    with pytest.raises(crankwork.InputError) as refused:
        crankwork.read_machine(text)
    assert MISTAKES[text] in str(refused.value)
