"""Fresh charge and products of burning, per 1 kg of fuel."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.expressions import Value, formula
from crankwork.steps import Worked
from crankwork.working_cycle.fuels import CycleError, Fuel


@formula("fresh_charge_amount", "kolchin_demidov_2008, ch. 1")
def fresh_charge_with_vapour(alpha_air: Value, L_air: Value, m_T: Value) -> Value:
    """Fresh charge of air and fuel vapour.

    Parameters
    ----------
    alpha_air, L_air, m_T : float
        Excess air, air needed, molar mass of the fuel. [-], [kmol/kg], [kg/kmol]

    Returns
    -------
    float
        Amount per mass of fuel. [kmol/kg]
    """
    return alpha_air * L_air + 1 / m_T


@formula("fresh_charge_amount", "kolchin_demidov_2008, ch. 1")
def fresh_charge_of_air(alpha_air: Value, L_air: Value) -> Value:
    """Fresh charge of air alone.

    Parameters
    ----------
    alpha_air, L_air : float
        Excess air, air needed. [-], [kmol/kg]

    Returns
    -------
    float
        Amount per mass of fuel. [kmol/kg]
    """
    return alpha_air * L_air


@formula("product_co", "kolchin_demidov_2008, ch. 1")
def carbon_monoxide(alpha_air: Value, K_H: Value, L_air: Value) -> Value:
    """Carbon monoxide of a rich mixture.

    Parameters
    ----------
    alpha_air, K_H, L_air : float
        Excess air below 1, hydrogen over carbon monoxide, air needed. [-], [-], [kmol/kg]

    Returns
    -------
    float
        Amount per mass of fuel. [kmol/kg]
    """
    return 2 * (1 - alpha_air) / (1 + K_H) * 0.208 * L_air


@formula("product_h2", "kolchin_demidov_2008, ch. 1")
def hydrogen_left(K_H: Value, M_CO: Value) -> Value:
    """Hydrogen of a rich mixture.

    Parameters
    ----------
    K_H, M_CO : float
        Hydrogen over carbon monoxide, carbon monoxide. [-], [kmol/kg]

    Returns
    -------
    float
        Amount per mass of fuel. [kmol/kg]
    """
    return K_H * M_CO


@formula("product_co2", "kolchin_demidov_2008, ch. 1")
def carbon_dioxide_of_rich(C_f: Value, M_CO: Value) -> Value:
    """Carbon dioxide of a rich mixture.

    Parameters
    ----------
    C_f, M_CO : float
        Carbon in the fuel, carbon monoxide. [-], [kmol/kg]

    Returns
    -------
    float
        Amount per mass of fuel. [kmol/kg]
    """
    return C_f / 12 - M_CO


@formula("product_h2o", "kolchin_demidov_2008, ch. 1")
def water_of_rich(H_f: Value, M_H2: Value) -> Value:
    """Water vapour of a rich mixture.

    Parameters
    ----------
    H_f, M_H2 : float
        Hydrogen in the fuel, hydrogen left. [-], [kmol/kg]

    Returns
    -------
    float
        Amount per mass of fuel. [kmol/kg]
    """
    return H_f / 2 - M_H2


@formula("product_co2", "kolchin_demidov_2008, ch. 1")
def carbon_dioxide(C_f: Value) -> Value:
    """Carbon dioxide where there is air enough.

    Parameters
    ----------
    C_f : float
        Carbon in the fuel. [-]

    Returns
    -------
    float
        Amount per mass of fuel. [kmol/kg]
    """
    return C_f / 12


@formula("product_h2o", "kolchin_demidov_2008, ch. 1")
def water(H_f: Value) -> Value:
    """Water vapour where there is air enough.

    Parameters
    ----------
    H_f : float
        Hydrogen in the fuel. [-]

    Returns
    -------
    float
        Amount per mass of fuel. [kmol/kg]
    """
    return H_f / 2


@formula("product_o2", "kolchin_demidov_2008, ch. 1")
def oxygen_left(alpha_air: Value, L_air: Value) -> Value:
    """Oxygen that a lean mixture does not use.

    Parameters
    ----------
    alpha_air, L_air : float
        Excess air from 1, air needed. [-], [kmol/kg]

    Returns
    -------
    float
        Amount per mass of fuel. [kmol/kg]
    """
    return 0.208 * (alpha_air - 1) * L_air


@formula("product_n2", "kolchin_demidov_2008, ch. 1")
def nitrogen(alpha_air: Value, L_air: Value) -> Value:
    """Nitrogen of the air.

    Parameters
    ----------
    alpha_air, L_air : float
        Excess air, air needed. [-], [kmol/kg]

    Returns
    -------
    float
        Amount per mass of fuel. [kmol/kg]
    """
    return 0.792 * alpha_air * L_air


@formula("product_amount", "kolchin_demidov_2008, ch. 1")
def products_of_rich(M_CO2: Value, M_CO: Value, M_H2O: Value, M_H2: Value, M_N2: Value) -> Value:
    """All products of a rich mixture.

    Parameters
    ----------
    M_CO2, M_CO, M_H2O, M_H2, M_N2 : float
        Its parts. [kmol/kg]

    Returns
    -------
    float
        Amount per mass of fuel. [kmol/kg]
    """
    return M_CO2 + M_CO + M_H2O + M_H2 + M_N2


@formula("product_amount", "kolchin_demidov_2008, ch. 1")
def products_of_lean(M_CO2: Value, M_H2O: Value, M_O2: Value, M_N2: Value) -> Value:
    """All products of a mixture with air enough.

    Parameters
    ----------
    M_CO2, M_H2O, M_O2, M_N2 : float
        Its parts. [kmol/kg]

    Returns
    -------
    float
        Amount per mass of fuel. [kmol/kg]
    """
    return M_CO2 + M_H2O + M_O2 + M_N2


@formula("molar_change_ideal", "kolchin_demidov_2008, ch. 1")
def molar_change_ideal(M_prod: Value, M_fresh: Value) -> Value:
    """Molar change of the fresh charge by burning.

    Parameters
    ----------
    M_prod, M_fresh : float
        Products, fresh charge. [kmol/kg]

    Returns
    -------
    float
        Ratio. [-]
    """
    return M_prod / M_fresh


@formula("heat_lost_incomplete", "kolchin_demidov_2008, ch. 1")
def heat_lost_incomplete(alpha_air: Value, L_air: Value) -> Value:
    """Heat that a rich mixture does not give.

    Parameters
    ----------
    alpha_air, L_air : float
        Excess air below 1, air needed. [-], [kmol/kg]

    Returns
    -------
    float
        Heat per mass of fuel. [J/kg]
    """
    return 119.95e6 * (1 - alpha_air) * L_air


class Mixture(NamedTuple):
    """Charge and products of 1 kg of fuel [kmol/kg], their ratio [-], heat lost for want of air [J/kg].

    `parts` are the products in the order CO2, CO, H2O, H2, N2 of a rich mixture, else CO2, H2O, O2, N2.
    """

    excess_air: float
    fresh: float
    parts: tuple[float, ...]
    products: float
    ratio: float
    heat_lost: float

    @property
    def is_rich(self) -> bool:
        """Whether air is wanting."""
        return self.excess_air < 1


def mixture(worked: Worked, fuel: Fuel, air: float, excess_air: float, hydrogen_share: float | None) -> Mixture:
    """Return charge and products, worked step by step.

    Parameters
    ----------
    worked : Worked
        Where the steps are kept.
    fuel : Fuel
        The fuel; with a molar mass its vapour is part of the charge.
    air : float
        Air that 1 kg of fuel needs. [kmol/kg]
    excess_air : float
        Air over air needed. [-]
    hydrogen_share : float or None
        Hydrogen over carbon monoxide in the products of a rich mixture. [-]

    Returns
    -------
    Mixture
        Charge and products.

    Raises
    ------
    CycleError
        If air is wanting and the share of hydrogen is not given, or so little air is there that more carbon would
        burn halfway than the fuel has.
    """
    if fuel.molar_mass is None:
        fresh = worked(fresh_charge_of_air, excess_air, air)
    else:
        fresh = worked(fresh_charge_with_vapour, excess_air, air, fuel.molar_mass)
    rich = excess_air < 1
    parts = _rich(worked, fuel, air, excess_air, hydrogen_share) if rich else _lean(worked, fuel, air, excess_air)
    products = worked(products_of_rich if rich else products_of_lean, *parts)
    ratio = worked(molar_change_ideal, products, fresh)
    lost = worked(heat_lost_incomplete, excess_air, air) if rich else 0.0
    return Mixture(excess_air, fresh, parts, products, ratio, lost)


def _rich(worked: Worked, fuel: Fuel, air: float, excess_air: float, hydrogen_share: float | None) -> tuple[float, ...]:
    if hydrogen_share is None:
        raise CycleError("a rich mixture needs the ratio of hydrogen to carbon monoxide, 0.45 to 0.5 as a rule")
    monoxide = worked(carbon_monoxide, excess_air, hydrogen_share, air)
    hydrogen = worked(hydrogen_left, hydrogen_share, monoxide)
    dioxide = worked(carbon_dioxide_of_rich, fuel.carbon, monoxide)
    vapour = worked(water_of_rich, fuel.hydrogen, hydrogen)
    if min(dioxide, vapour) < 0:
        raise CycleError(f"with an excess air of {excess_air:g} the fuel cannot burn even to CO and H2; give more air")
    return dioxide, monoxide, vapour, hydrogen, worked(nitrogen, excess_air, air)


def _lean(worked: Worked, fuel: Fuel, air: float, excess_air: float) -> tuple[float, ...]:
    return (
        worked(carbon_dioxide, fuel.carbon),
        worked(water, fuel.hydrogen),
        worked(oxygen_left, excess_air, air),
        worked(nitrogen, excess_air, air),
    )
