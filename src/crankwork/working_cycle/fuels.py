"""Fuels: elements, heating value and the air needed."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.errors import CrankworkError
from crankwork.formula.calculation import Calculation
from crankwork.formula.expression import Value, formula
from crankwork.locale import ErrorMessage


class CycleError(CrankworkError):
    """Data from which no working cycle follows."""


class Fuel(NamedTuple):
    """Elements of 1 kg of liquid fuel, by mass."""

    # Masses in 1 kg of fuel; together 1 [-]
    carbon: float
    hydrogen: float
    oxygen: float = 0.0
    molar_mass: float | None = None  # Of the vapour, if the fuel evaporates before the cylinder [kg/kmol]
    heating_value: float | None = None  # Lower heating value; by default from the elements [J/kg]


FUELS = {"petrol": Fuel(0.855, 0.145, 0.0, 115.0), "diesel": Fuel(0.870, 0.126, 0.004, 190.0)}


@formula("fuel_heating_value", "kolchin_demidov_2008, ch. 1", constants="heat of each element in J/kg")
def lower_heating_value(C_f: Value, H_f: Value, O_f: Value) -> Value:
    """Lower heating value of a liquid fuel, by Mendeleev."""
    return 33.91e6 * C_f + 125.6e6 * H_f - 10.89e6 * O_f - 2.51e6 * 9 * H_f


@formula("air_mass_needed", "kolchin_demidov_2008, ch. 1")
def air_mass_needed(C_f: Value, H_f: Value, O_f: Value) -> Value:
    """Mass of air that burns 1 kg of fuel, 0.23 of it oxygen."""
    return (8 * C_f / 3 + 8 * H_f - O_f) / 0.23


@formula("air_amount_needed", "kolchin_demidov_2008, ch. 1", constants="molar masses in kg/kmol")
def air_amount_needed(C_f: Value, H_f: Value, O_f: Value) -> Value:
    """Amount of air that burns 1 kg of fuel, 0.208 of it oxygen."""
    return (C_f / 12 + H_f / 4 - O_f / 32) / 0.208


def burning(worked: Calculation, fuel: Fuel) -> None:
    """Calculate the heat of 1 kg of fuel and the air that it needs.

    `fuel`: its heating value is calculated unless it is given.
    """
    elements = fuel[:3]
    if min(elements) < 0 or abs(sum(elements) - 1) > 0.02 or fuel.carbon + fuel.hydrogen <= 0:
        raise CycleError(ErrorMessage("fuel_shares", carbon=fuel.carbon, hydrogen=fuel.hydrogen, oxygen=fuel.oxygen))
    if fuel.heating_value is None:
        worked(lower_heating_value)
    worked(air_mass_needed)
    worked(air_amount_needed)
