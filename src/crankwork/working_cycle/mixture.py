"""Fresh charge and combustion products, per 1 kg of fuel."""

from __future__ import annotations

from crankwork.formula.expression import Value, formula
from crankwork.formula.worked import Worked
from crankwork.locale import Refusal
from crankwork.working_cycle.fuels import CycleError


@formula("fresh_charge_amount", "kolchin_demidov_2008, ch. 1")
def fresh_charge_amount(alpha_air: Value, L_air: Value, m_T: Value) -> Value:
    """Fresh charge of air and fuel vapour."""
    return alpha_air * L_air + 1 / m_T


@formula("product_co", "kolchin_demidov_2008, ch. 1")
def carbon_monoxide(alpha_air: Value, K_H: Value, L_air: Value) -> Value:
    """Carbon monoxide of a rich mixture."""
    return 2 * (1 - alpha_air) / (1 + K_H) * 0.208 * L_air


@formula("product_h2", "kolchin_demidov_2008, ch. 1")
def hydrogen_left(K_H: Value, M_CO: Value) -> Value:
    """Hydrogen of a rich mixture."""
    return K_H * M_CO


@formula("product_co2", "kolchin_demidov_2008, ch. 1", constants="molar masses in kg/kmol")
def carbon_dioxide(C_f: Value, M_CO: Value) -> Value:
    """Carbon dioxide, of the carbon that does not burn halfway."""
    return C_f / 12 - M_CO


@formula("product_h2o", "kolchin_demidov_2008, ch. 1", constants="molar masses in kg/kmol")
def water(H_f: Value, M_H2: Value) -> Value:
    """Water vapour, of the hydrogen that does burn."""
    return H_f / 2 - M_H2


@formula("product_o2", "kolchin_demidov_2008, ch. 1")
def oxygen_left(alpha_air: Value, L_air: Value) -> Value:
    """Oxygen that a lean mixture does not use."""
    return 0.208 * (alpha_air - 1) * L_air


@formula("product_n2", "kolchin_demidov_2008, ch. 1")
def nitrogen(alpha_air: Value, L_air: Value) -> Value:
    """Nitrogen of the air."""
    return 0.792 * alpha_air * L_air


@formula("product_amount", "kolchin_demidov_2008, ch. 1")
def products(M_CO2: Value, M_CO: Value, M_H2O: Value, M_H2: Value, M_O2: Value, M_N2: Value) -> Value:
    """All products."""
    return M_CO2 + M_CO + M_H2O + M_H2 + M_O2 + M_N2


@formula("molar_change_ideal", "kolchin_demidov_2008, ch. 1")
def molar_change_ideal(M_prod: Value, M_fresh: Value) -> Value:
    """Molar change of the fresh charge by burning."""
    return M_prod / M_fresh


@formula("heat_lost_incomplete", "kolchin_demidov_2008, ch. 1", constants="heat of CO and H2 in J/kmol")
def heat_lost_incomplete(alpha_air: Value, L_air: Value) -> Value:
    """Heat that a rich mixture does not give."""
    return 119.95e6 * (1 - alpha_air) * L_air


def mixture(worked: Worked) -> None:
    """Calculate charge and products of 1 kg of fuel.

    `worked`: has the fuel, the air that it needs, the excess air and the share of hydrogen in the products of a rich
    mixture; takes the results.
    """
    worked(fresh_charge_amount)
    excess_air = worked["excess_air"].value
    is_rich = excess_air < 1
    if is_rich:
        worked(carbon_monoxide)
        worked(hydrogen_left)
    else:
        for key in ("product_co", "product_h2"):
            worked.absent(key)
    if min(worked(carbon_dioxide).value, worked(water).value) < 0:
        raise CycleError(Refusal("mixture_rich", value=excess_air))
    if is_rich:
        worked.absent("product_o2")
    else:
        worked(oxygen_left)
    worked(nitrogen)
    worked(products)
    worked(molar_change_ideal)
    if is_rich:
        worked(heat_lost_incomplete)
    else:
        worked.absent("heat_lost_incomplete")
