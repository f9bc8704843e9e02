"""Mean molar heats at constant volume.

Three laws. `kolchin` sums the gases, counts from 0 degrees Celsius and has one set of coefficients to 1500 and one
above; `vietnamese` and `linear` give the whole mixture by its excess air and count from 0 K. A heat in kJ/(kmol K) is
the same number in J/(mol K).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, NamedTuple

from crankwork.expressions import Value, formula
from crankwork.steps import Worked
from crankwork.working_cycle.mixture import Mixture

HeatLaw = Literal["kolchin", "vietnamese", "linear"]

ZERO_CELSIUS = 273.15
# where each set of coefficients of `kolchin` ends [degC]
LOW_LIMIT = 1500.0
HIGH_LIMIT = 2800.0


@formula("fresh_charge_heat", "kolchin_demidov_2008, ch. 1")
def air_heat(t_c: Value) -> Value:
    """Heat of air from 0 to 1500 degrees Celsius.

    Parameters
    ----------
    t_c : float
        Temperature. [degC]

    Returns
    -------
    float
        Mean molar heat. [kJ/(kmol K)]
    """
    return 20.6 + 0.002638 * t_c


@formula("fresh_charge_heat", "nguyen_tat_tien_2000")
def air_heat_vietnamese(T_c: Value) -> Value:
    """Heat of the fresh charge.

    Parameters
    ----------
    T_c : float
        Temperature. [K]

    Returns
    -------
    float
        Mean molar heat. [kJ/(kmol K)]
    """
    return 19.806 + 0.00209 * T_c


@formula("fresh_charge_heat", "nikolaenko_1992")
def air_heat_linear(T_c: Value) -> Value:
    """Heat of the charge, residual gas included.

    Parameters
    ----------
    T_c : float
        Temperature. [K]

    Returns
    -------
    float
        Mean molar heat. [kJ/(kmol K)]
    """
    return 20.16 + 0.00174 * T_c


@formula("product_heat", "kolchin_demidov_2008, ch. 1")
def rich_product_heat(  # noqa: PLR0913 - one argument per symbol
    M_CO2: Value, M_CO: Value, M_H2O: Value, M_H2: Value, M_N2: Value, M_prod: Value, th_gas: Value
) -> Value:
    """Heat of the products of a rich mixture from 0 to 1500 degrees Celsius.

    Parameters
    ----------
    M_CO2, M_CO, M_H2O, M_H2, M_N2, M_prod, th_gas : float
        Products and their sum, temperature.
        [kmol/kg], [kmol/kg], [kmol/kg], [kmol/kg], [kmol/kg], [kmol/kg], [degC]

    Returns
    -------
    float
        Mean molar heat. [kJ/(kmol K)]
    """
    return (
        M_CO2 * (27.941 + 0.019 * th_gas - 5.487 * (th_gas / 1000) ** 2)
        + M_CO * (20.597 + 0.00267 * th_gas)
        + M_H2O * (24.953 + 0.005359 * th_gas)
        + M_H2 * (20.684 + 0.000206 * th_gas + 0.588 * (th_gas / 1000) ** 2)
        + M_N2 * (20.398 + 0.0025 * th_gas)
    ) / M_prod


@formula("product_heat", "kolchin_demidov_2008, ch. 1")
def lean_product_heat(M_CO2: Value, M_H2O: Value, M_O2: Value, M_N2: Value, M_prod: Value, th_gas: Value) -> Value:
    """Heat of the products of a lean mixture from 0 to 1500 degrees Celsius.

    Parameters
    ----------
    M_CO2, M_H2O, M_O2, M_N2, M_prod, th_gas : float
        Products and their sum, temperature. [kmol/kg], [kmol/kg], [kmol/kg], [kmol/kg], [kmol/kg], [degC]

    Returns
    -------
    float
        Mean molar heat. [kJ/(kmol K)]
    """
    return (
        M_CO2 * (27.941 + 0.019 * th_gas - 5.487 * (th_gas / 1000) ** 2)
        + M_H2O * (24.953 + 0.005359 * th_gas)
        + M_O2 * (20.93 + 0.004641 * th_gas - 0.84 * (th_gas / 1000) ** 2)
        + M_N2 * (20.398 + 0.0025 * th_gas)
    ) / M_prod


@formula("product_heat_constant", "kolchin_demidov_2008, ch. 1")
def rich_heat_constant(M_CO2: Value, M_CO: Value, M_H2O: Value, M_H2: Value, M_N2: Value, M_prod: Value) -> Value:
    """Constant of the heat of rich products from 1501 to 2800 degrees Celsius.

    Parameters
    ----------
    M_CO2, M_CO, M_H2O, M_H2, M_N2, M_prod : float
        Products and their sum. [kmol/kg]

    Returns
    -------
    float
        Constant. [kJ/(kmol K)]
    """
    return (39.123 * M_CO2 + 22.49 * M_CO + 26.67 * M_H2O + 19.678 * M_H2 + 21.951 * M_N2) / M_prod


@formula("product_heat_slope", "kolchin_demidov_2008, ch. 1")
def rich_heat_slope(M_CO2: Value, M_CO: Value, M_H2O: Value, M_H2: Value, M_N2: Value, M_prod: Value) -> Value:
    """Slope of the heat of rich products from 1501 to 2800 degrees Celsius.

    Parameters
    ----------
    M_CO2, M_CO, M_H2O, M_H2, M_N2, M_prod : float
        Products and their sum. [kmol/kg]

    Returns
    -------
    float
        Slope. [kJ/(kmol K2)]
    """
    return (0.003349 * M_CO2 + 0.00143 * M_CO + 0.004438 * M_H2O + 0.001758 * M_H2 + 0.001457 * M_N2) / M_prod


@formula("product_heat_constant", "kolchin_demidov_2008, ch. 1")
def lean_heat_constant(M_CO2: Value, M_H2O: Value, M_O2: Value, M_N2: Value, M_prod: Value) -> Value:
    """Constant of the heat of lean products from 1501 to 2800 degrees Celsius.

    Parameters
    ----------
    M_CO2, M_H2O, M_O2, M_N2, M_prod : float
        Products and their sum. [kmol/kg]

    Returns
    -------
    float
        Constant. [kJ/(kmol K)]
    """
    return (39.123 * M_CO2 + 26.67 * M_H2O + 23.723 * M_O2 + 21.951 * M_N2) / M_prod


@formula("product_heat_slope", "kolchin_demidov_2008, ch. 1")
def lean_heat_slope(M_CO2: Value, M_H2O: Value, M_O2: Value, M_N2: Value, M_prod: Value) -> Value:
    """Slope of the heat of lean products from 1501 to 2800 degrees Celsius.

    Parameters
    ----------
    M_CO2, M_H2O, M_O2, M_N2, M_prod : float
        Products and their sum. [kmol/kg]

    Returns
    -------
    float
        Slope. [kJ/(kmol K2)]
    """
    return (0.003349 * M_CO2 + 0.004438 * M_H2O + 0.00155 * M_O2 + 0.001457 * M_N2) / M_prod


@formula("product_heat_constant", "nguyen_tat_tien_2000")
def rich_heat_constant_vietnamese(alpha_air: Value) -> Value:
    """Constant of the heat of rich products.

    Parameters
    ----------
    alpha_air : float
        Excess air below 1. [-]

    Returns
    -------
    float
        Constant. [kJ/(kmol K)]
    """
    return 17.997 + 3.504 * alpha_air


@formula("product_heat_slope", "nguyen_tat_tien_2000")
def rich_heat_slope_vietnamese(alpha_air: Value) -> Value:
    """Slope of the heat of rich products.

    Parameters
    ----------
    alpha_air : float
        Excess air below 1. [-]

    Returns
    -------
    float
        Slope. [kJ/(kmol K2)]
    """
    return (360.34 + 252.4 * alpha_air) / 200000


@formula("product_heat_constant", "nguyen_tat_tien_2000")
def lean_heat_constant_vietnamese(alpha_air: Value) -> Value:
    """Constant of the heat of lean products.

    Parameters
    ----------
    alpha_air : float
        Excess air from 1. [-]

    Returns
    -------
    float
        Constant. [kJ/(kmol K)]
    """
    return 19.876 + 1.634 / alpha_air


@formula("product_heat_slope", "nguyen_tat_tien_2000")
def lean_heat_slope_vietnamese(alpha_air: Value) -> Value:
    """Slope of the heat of lean products.

    Parameters
    ----------
    alpha_air : float
        Excess air from 1. [-]

    Returns
    -------
    float
        Slope. [kJ/(kmol K2)]
    """
    return (427.86 + 184.36 / alpha_air) / 200000


@formula("product_heat_constant", "nikolaenko_1992")
def rich_heat_constant_linear(alpha_air: Value) -> Value:
    """Constant of the heat of rich products.

    Parameters
    ----------
    alpha_air : float
        Excess air below 1. [-]

    Returns
    -------
    float
        Constant. [kJ/(kmol K)]
    """
    return 18.4 + 2.6 * alpha_air


@formula("product_heat_slope", "nikolaenko_1992")
def rich_heat_slope_linear(alpha_air: Value) -> Value:
    """Slope of the heat of rich products.

    Parameters
    ----------
    alpha_air : float
        Excess air below 1. [-]

    Returns
    -------
    float
        Slope. [kJ/(kmol K2)]
    """
    return (15.5 + 13.8 * alpha_air) / 10000


@formula("product_heat_constant", "nikolaenko_1992")
def lean_heat_constant_linear(alpha_air: Value) -> Value:
    """Constant of the heat of lean products.

    Parameters
    ----------
    alpha_air : float
        Excess air from 1. [-]

    Returns
    -------
    float
        Constant. [kJ/(kmol K)]
    """
    return 20.2 + 0.92 / alpha_air


@formula("product_heat_slope", "nikolaenko_1992")
def lean_heat_slope_linear(alpha_air: Value) -> Value:
    """Slope of the heat of lean products.

    Parameters
    ----------
    alpha_air : float
        Excess air from 1. [-]

    Returns
    -------
    float
        Slope. [kJ/(kmol K2)]
    """
    return (15.5 + 13.8 / alpha_air) / 10000


@formula("product_heat", "nguyen_tat_tien_2000")
def product_heat(a_prod: Value, b_prod: Value, th_gas: Value) -> Value:
    """Heat of the products at a temperature, by a linear law.

    Parameters
    ----------
    a_prod, b_prod, th_gas : float
        Constant, slope, temperature from the zero of the law. [kJ/(kmol K)], [kJ/(kmol K2)], [K]

    Returns
    -------
    float
        Mean molar heat. [kJ/(kmol K)]
    """
    return a_prod + b_prod * th_gas


@formula("mixture_heat", "kolchin_demidov_2008, ch. 3")
def mixture_heat(mc_fresh: Value, gamma_r: Value, mc_prod: Value) -> Value:
    """Heat of fresh charge and residual gas.

    Parameters
    ----------
    mc_fresh, gamma_r, mc_prod : float
        Heat of the fresh charge, residual gas fraction, heat of the products.
        [kJ/(kmol K)], [-], [kJ/(kmol K)]

    Returns
    -------
    float
        Mean molar heat. [kJ/(kmol K)]
    """
    return (mc_fresh + gamma_r * mc_prod) / (1 + gamma_r)


class _Law(NamedTuple):
    """Formulas of one law: fresh charge; constant and slope of products, rich and lean; its zero [K]."""

    fresh: Callable[..., Any]
    rich: tuple[Callable[..., Any], Callable[..., Any]]
    lean: tuple[Callable[..., Any], Callable[..., Any]]
    zero: float = 0.0


_LAWS: dict[HeatLaw, _Law] = {
    "kolchin": _Law(
        air_heat, (rich_heat_constant, rich_heat_slope), (lean_heat_constant, lean_heat_slope), ZERO_CELSIUS
    ),
    "vietnamese": _Law(
        air_heat_vietnamese,
        (rich_heat_constant_vietnamese, rich_heat_slope_vietnamese),
        (lean_heat_constant_vietnamese, lean_heat_slope_vietnamese),
    ),
    "linear": _Law(
        air_heat_linear,
        (rich_heat_constant_linear, rich_heat_slope_linear),
        (lean_heat_constant_linear, lean_heat_slope_linear),
    ),
}


def law_zero(law: HeatLaw) -> float:
    """Return the absolute temperature from which a law counts. [K]"""
    return _LAWS[law].zero


def product_coefficients(worked: Worked, law: HeatLaw, burnt: Mixture) -> tuple[float, float]:
    """Return constant and slope of the heat of the products at the end of burning, worked step by step.

    Parameters
    ----------
    worked : Worked
        Where the steps are kept.
    law : {"kolchin", "vietnamese", "linear"}
        The law.
    burnt : Mixture
        Products or excess air.

    Returns
    -------
    tuple of float
        Constant and slope of the mean molar heat. [kJ/(kmol K)], [kJ/(kmol K2)]
    """
    constant, slope = _LAWS[law].rich if burnt.is_rich else _LAWS[law].lean
    values = (*burnt.parts, burnt.products) if law == "kolchin" else (burnt.excess_air,)
    return worked(constant, *values), worked(slope, *values)


def fresh_heat(worked: Worked, law: HeatLaw, temperature: float, *, key: str = "") -> float:
    """Return the heat of the fresh charge, worked as a step.

    Parameters
    ----------
    worked : Worked
        Where the step is kept.
    law : {"kolchin", "vietnamese", "linear"}
        The law.
    temperature : float
        Absolute temperature. [K]
    key : str
        Key of the step.

    Returns
    -------
    float
        Mean molar heat. [kJ/(kmol K)]
    """
    return worked(_LAWS[law].fresh, temperature - _LAWS[law].zero, key=key)


def residual_heat(worked: Worked, law: HeatLaw, burnt: Mixture, temperature: float, *, key: str = "") -> float:
    """Return the heat of the products below the heat of burning, worked as a step.

    Parameters
    ----------
    worked : Worked
        Where the step is kept.
    law : {"kolchin", "vietnamese", "linear"}
        The law.
    burnt : Mixture
        Products or excess air.
    temperature : float
        Absolute temperature. [K]
    key : str
        Key of the step.

    Returns
    -------
    float
        Mean molar heat. [kJ/(kmol K)]
    """
    at = temperature - _LAWS[law].zero
    if law == "kolchin":
        low = rich_product_heat if burnt.is_rich else lean_product_heat
        return worked(low, *burnt.parts, burnt.products, at, key=key)
    constant, slope = _LAWS[law].rich if burnt.is_rich else _LAWS[law].lean
    return worked(product_heat, constant(burnt.excess_air), slope(burnt.excess_air), at, key=key)
