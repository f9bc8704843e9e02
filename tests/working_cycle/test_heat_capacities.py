"""The laws of mean molar heats against each other and against measured enthalpies."""

import pytest

from crankwork.formula.calculation import Calculation
from crankwork.formula.traced_value import TracedValue, given
from crankwork.working_cycle.cycle_data import GrinevetskyData, traced_cycle_inputs
from crankwork.working_cycle.fuels import FUELS, burning
from crankwork.working_cycle.grinevetsky import mixture
from crankwork.working_cycle.heat_capacities import (
    LOW_LIMIT,
    ZERO_CELSIUS,
    HeatLaw,
    fresh_heat,
    heat_constant_of_gases,
    heat_of_gases,
    heat_slope_of_gases,
    law_zero,
    product_coefficients,
    residual_heat,
)
from each import for_each

pytestmark = pytest.mark.elsewhere

GASES = ("CO2", "CO", "H2O", "H2", "O2", "N2")
# NIST Chemistry WebBook, Shomate equation, A to E; N2 500-2000 K, CO2 298-1200 K, O2 700-2000 K, H2O 500-1700 K
SHOMATE = {
    "N2": (19.50583, 19.88705, -8.598535, 1.369784, 0.527601),
    "CO2": (24.99735, 55.18696, -33.69137, 7.948387, -0.136638),
    "O2": (30.03235, 8.772972, -3.988133, 0.788313, -0.741599),
    "H2O": (30.09200, 6.832514, 6.793435, -2.534480, 0.082139),
}


def _low(name: str, celsius: float) -> float:
    return heat_of_gases(*(float(one == name) for one in GASES), 1.0, celsius)


def _high(name: str, celsius: float) -> float:
    amounts = [float(one == name) for one in GASES]
    return heat_constant_of_gases(*amounts, 1.0) + heat_slope_of_gases(*amounts, 1.0) * celsius


@for_each("name", GASES)
def test_both_sets_of_coefficients_meet_where_one_ends(name: str):
    assert _high(name, LOW_LIMIT) == pytest.approx(_low(name, LOW_LIMIT), rel=0.011)


def _enthalpy(name: str, kelvin: float) -> float:
    """Molar enthalpy by Shomate, to a constant. [kJ/kmol]"""
    a, b, c, d, e = SHOMATE[name]
    t = kelvin / 1000
    return 1000 * (a * t + b * t**2 / 2 + c * t**3 / 3 + d * t**4 / 4 - e / t)


@for_each("name", sorted(SHOMATE))
def test_heat_between_two_temperatures_is_the_measured_one(name: str):
    low, high = 750.0, 1150.0
    measured = _enthalpy(name, high) - _enthalpy(name, low) - 8.314462618 * (high - low)
    ends = [_low(name, kelvin - ZERO_CELSIUS) * (kelvin - ZERO_CELSIUS) for kelvin in (high, low)]
    assert ends[0] - ends[1] == pytest.approx(measured, rel=0.02)


def _counted(law: HeatLaw, kelvin: float) -> TracedValue:
    return given("gas_celsius", kelvin - law_zero(law))


@for_each("law", ["vietnamese", "linear"])
@for_each("excess_air", [0.85, 0.999, 1.0, 1.4, 2.0])
def test_heat_from_600_to_2400_kelvin_is_that_of_the_gases(law: HeatLaw, excess_air: float):
    """The laws of whole mixtures count from 0 K, the gases from 0 degrees; differences compare."""
    data = GrinevetskyData("petrol", 9.0, 5000.0, fuel=FUELS["petrol"], excess_air=excess_air)

    def energy(one: HeatLaw, kelvin: float) -> float:
        worked = traced_cycle_inputs(data, data)
        burning(worked, FUELS["petrol"])
        mixture(worked)
        product_coefficients(worked, one)
        at = _counted(one, kelvin)
        if kelvin < 1700:
            return residual_heat(worked, one, at).value * at.value
        constant, slope = (worked[key].value for key in ("product_heat_constant", "product_heat_slope"))
        return (constant + slope * at.value) * at.value

    ours, gases = (energy(one, 2400.0) - energy(one, 600.0) for one in (law, "kolchin"))
    assert ours == pytest.approx(gases, rel=0.035)


@for_each("law", ["vietnamese", "linear"])
def test_heat_of_the_charge_from_350_to_800_kelvin_is_that_of_air(law: HeatLaw):
    def energy(one: HeatLaw, kelvin: float) -> float:
        at = _counted(one, kelvin)
        return fresh_heat(Calculation(), one, at).value * at.value

    ours, air = (energy(one, 800.0) - energy(one, 350.0) for one in (law, "kolchin"))
    assert ours == pytest.approx(air, rel=0.02)
