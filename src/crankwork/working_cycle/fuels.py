"""Fuels: what they are made of, the heat they give and the air they need."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.errors import CrankworkError
from crankwork.expressions import Value, formula
from crankwork.steps import Worked


class CycleError(CrankworkError):
    """Data from which no working cycle follows."""


class Fuel(NamedTuple):
    """Elements of 1 kg of liquid fuel, by mass.

    Parameters
    ----------
    carbon, hydrogen, oxygen : float
        Masses in 1 kg of fuel; together 1. [-]
    molar_mass : float or None
        Of the vapour, where the fuel evaporates before the cylinder. [kg/kmol]
    heating_value : float or None
        Lower heating value; by default from the elements. [J/kg]
    """

    carbon: float
    hydrogen: float
    oxygen: float = 0.0
    molar_mass: float | None = None
    heating_value: float | None = None


FUELS = {"petrol": Fuel(0.855, 0.145, 0.0, 115.0), "diesel": Fuel(0.870, 0.126, 0.004, 190.0)}


@formula("fuel_heating_value", "kolchin_demidov_2008, ch. 1")
def lower_heating_value(C_f: Value, H_f: Value, O_f: Value) -> Value:
    """Lower heating value of a liquid fuel, by Mendeleev.

    Parameters
    ----------
    C_f, H_f, O_f : float
        Carbon, hydrogen and oxygen in the fuel. [-]

    Returns
    -------
    float
        Heating value. [J/kg]
    """
    return 33.91e6 * C_f + 125.6e6 * H_f - 10.89e6 * O_f - 2.51e6 * 9 * H_f


@formula("air_mass_needed", "kolchin_demidov_2008, ch. 1")
def air_mass_needed(C_f: Value, H_f: Value, O_f: Value) -> Value:
    """Mass of air that burns 1 kg of fuel, 0.23 of it oxygen.

    Parameters
    ----------
    C_f, H_f, O_f : float
        Carbon, hydrogen and oxygen in the fuel. [-]

    Returns
    -------
    float
        Mass of air over mass of fuel. [-]
    """
    return (8 * C_f / 3 + 8 * H_f - O_f) / 0.23


@formula("air_amount_needed", "kolchin_demidov_2008, ch. 1")
def air_amount_needed(C_f: Value, H_f: Value, O_f: Value) -> Value:
    """Amount of air that burns 1 kg of fuel, 0.208 of it oxygen.

    Parameters
    ----------
    C_f, H_f, O_f : float
        Carbon, hydrogen and oxygen in the fuel. [-]

    Returns
    -------
    float
        Amount of air per mass of fuel. [kmol/kg]
    """
    return (C_f / 12 + H_f / 4 - O_f / 32) / 0.208


class Burning(NamedTuple):
    """What 1 kg of fuel gives and needs: heat [J/kg], air by mass [-] and by amount [kmol/kg]."""

    heating_value: float
    air_mass: float
    air_amount: float


def burning(worked: Worked, fuel: Fuel) -> Burning:
    """Return the heat and the air of a fuel, worked step by step.

    Parameters
    ----------
    worked : Worked
        Where the steps are kept.
    fuel : Fuel
        The fuel; its heating value is calculated unless it is given.

    Returns
    -------
    Burning
        Heat and air.

    Raises
    ------
    CycleError
        If the elements are not those of 1 kg of a fuel.
    """
    elements = fuel[:3]
    if min(elements) < 0 or abs(sum(elements) - 1) > 0.02 or fuel.carbon + fuel.hydrogen <= 0:
        raise CycleError(
            f"carbon {fuel.carbon:g}, hydrogen {fuel.hydrogen:g} and oxygen {fuel.oxygen:g} of 1 kg of fuel are shares "
            "that sum to 1; write for example 0.855, 0.145 and 0"
        )
    heat = worked(lower_heating_value, *elements) if fuel.heating_value is None else fuel.heating_value
    return Burning(heat, worked(air_mass_needed, *elements), worked(air_amount_needed, *elements))
