"""The laws of mean molar heats against each other and against measured enthalpies."""

from __future__ import annotations

import pytest

from crankwork.steps import Worked
from crankwork.working_cycle.fuels import FUELS, burning
from crankwork.working_cycle.heat_capacities import (
    LOW_LIMIT,
    ZERO_CELSIUS,
    HeatLaw,
    fresh_heat,
    law_zero,
    lean_heat_constant,
    lean_heat_slope,
    lean_product_heat,
    product_coefficients,
    residual_heat,
    rich_heat_constant,
    rich_heat_slope,
    rich_product_heat,
)
from crankwork.working_cycle.mixture import mixture

RICH = ("CO2", "CO", "H2O", "H2", "N2")
LEAN = ("CO2", "H2O", "O2", "N2")
# NIST Chemistry WebBook, Shomate equation, A to E; N2 500-2000 K, CO2 298-1200 K, O2 700-2000 K, H2O 500-1700 K
SHOMATE = {
    "N2": (19.50583, 19.88705, -8.598535, 1.369784, 0.527601),
    "CO2": (24.99735, 55.18696, -33.69137, 7.948387, -0.136638),
    "O2": (30.03235, 8.772972, -3.988133, 0.788313, -0.741599),
    "H2O": (30.09200, 6.832514, 6.793435, -2.534480, 0.082139),
}


def _low(name: str, celsius: float) -> float:
    names, formula = (LEAN, lean_product_heat) if name in LEAN else (RICH, rich_product_heat)
    return formula(*(float(one == name) for one in names), 1.0, celsius)


def _high(name: str, celsius: float) -> float:
    names = LEAN if name in LEAN else RICH
    amounts = [float(one == name) for one in names]
    constant, slope = (lean_heat_constant, lean_heat_slope) if name in LEAN else (rich_heat_constant, rich_heat_slope)
    return constant(*amounts, 1.0) + slope(*amounts, 1.0) * celsius


@pytest.mark.parametrize("name", sorted({*RICH, *LEAN}))
def test_both_sets_of_coefficients_meet_where_one_ends(name: str):
    assert _high(name, LOW_LIMIT) == pytest.approx(_low(name, LOW_LIMIT), rel=0.011)


@pytest.mark.parametrize("name", sorted({"CO2", "H2O", "N2"}))
def test_rich_and_lean_products_have_the_same_gases(name: str):
    amounts = [float(one == name) for one in RICH]
    assert rich_product_heat(*amounts, 1.0, 700.0) == pytest.approx(_low(name, 700.0), rel=1e-14)
    assert rich_heat_constant(*amounts, 1.0) == lean_heat_constant(*(float(one == name) for one in LEAN), 1.0)
    assert rich_heat_slope(*amounts, 1.0) == lean_heat_slope(*(float(one == name) for one in LEAN), 1.0)


def _enthalpy(name: str, kelvin: float) -> float:
    """Molar enthalpy by Shomate, to a constant. [kJ/kmol]"""
    a, b, c, d, e = SHOMATE[name]
    t = kelvin / 1000
    return 1000 * (a * t + b * t**2 / 2 + c * t**3 / 3 + d * t**4 / 4 - e / t)


@pytest.mark.parametrize("name", sorted(SHOMATE))
def test_heat_between_two_temperatures_is_the_measured_one(name: str):
    low, high = 750.0, 1150.0
    measured = _enthalpy(name, high) - _enthalpy(name, low) - 8.314462618 * (high - low)
    ends = [_low(name, kelvin - ZERO_CELSIUS) * (kelvin - ZERO_CELSIUS) for kelvin in (high, low)]
    assert ends[0] - ends[1] == pytest.approx(measured, rel=0.02)


@pytest.mark.parametrize("law", ["vietnamese", "linear"])
@pytest.mark.parametrize("excess_air", [0.85, 0.999, 1.0, 1.4, 2.0])
def test_heat_from_600_to_2400_kelvin_is_that_of_the_gases(law: HeatLaw, excess_air: float):
    """The laws of whole mixtures count from 0 K, the gases from 0 degrees; differences compare."""
    worked, fuel = Worked(), FUELS["petrol"]
    burnt = mixture(worked, fuel, burning(worked, fuel).air_amount, excess_air, 0.5)

    def energy(one: HeatLaw, kelvin: float) -> float:
        at = kelvin - law_zero(one)
        if kelvin < 1700:
            return residual_heat(worked, one, burnt, kelvin) * at
        constant, slope = product_coefficients(worked, one, burnt)
        return (constant + slope * at) * at

    ours, gases = (energy(one, 2400.0) - energy(one, 600.0) for one in (law, "kolchin"))
    assert ours == pytest.approx(gases, rel=0.035)


@pytest.mark.parametrize("law", ["vietnamese", "linear"])
def test_heat_of_the_charge_from_350_to_800_kelvin_is_that_of_air(law: HeatLaw):
    worked = Worked()
    ends = [
        [fresh_heat(worked, one, kelvin) * (kelvin - law_zero(one)) for kelvin in (800.0, 350.0)]
        for one in (law, "kolchin")
    ]
    assert ends[0][0] - ends[0][1] == pytest.approx(ends[1][0] - ends[1][1], rel=0.02)
