"""Mean molar heats at constant volume.

Three laws. `kolchin` sums the gases, starts from 0 degrees Celsius and has two sets of coefficients, to 1500 degrees
and above; `vietnamese` and `linear` give the whole mixture by its excess air and start from 0 K. A heat in
kJ/(kmol K) is the same number in J/(mol K).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Literal, NamedTuple

from crankwork.formula.calculation import Calculation
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import TracedValue
from crankwork.working_cycle.charge import compression_celsius

HeatLaw = Literal["kolchin", "vietnamese", "linear"]

ZERO_CELSIUS = 273.15
# upper ends of both sets of coefficients of `kolchin` [degC]
LOW_LIMIT = 1500.0
HIGH_LIMIT = 2800.0

_FROM_CELSIUS = "heats in kJ/(kmol*K) over degC"
_FROM_KELVIN = "heats in kJ/(kmol*K) over K"
_RICH = {"alpha_air": (0.0, 1.0)}
_LEAN = {"alpha_air": (1.0, math.inf)}


@formula("fresh_charge_heat", "kolchin_demidov_2008, ch. 1", constants=_FROM_CELSIUS, valid={"t_c": (0.0, LOW_LIMIT)})
def air_heat(t_c: Value) -> Value:
    """Heat of air from 0 to 1500 degrees Celsius."""
    return 20.6 + 0.002638 * t_c


@formula("fresh_charge_heat", "nguyen_tat_tien_2000", constants=_FROM_KELVIN)
def air_heat_vietnamese(T_c: Value) -> Value:
    """Heat of the fresh charge."""
    return 19.806 + 0.00209 * T_c


@formula("fresh_charge_heat", "nikolaenko_1992", constants=_FROM_KELVIN)
def air_heat_linear(T_c: Value) -> Value:
    """Heat of the charge, residual gas included."""
    return 20.16 + 0.00174 * T_c


@formula("product_heat", "kolchin_demidov_2008, ch. 1", constants=_FROM_CELSIUS, valid={"t_gas": (0.0, LOW_LIMIT)})
def heat_of_gases(  # noqa: PLR0913 - one argument per symbol
    M_CO2: Value, M_CO: Value, M_H2O: Value, M_H2: Value, M_O2: Value, M_N2: Value, M_prod: Value, t_gas: Value
) -> Value:
    """Heat of the products from 0 to 1500 degrees Celsius."""
    return (
        M_CO2 * (27.941 + 0.019 * t_gas - 5.487 * (t_gas / 1000) ** 2)
        + M_CO * (20.597 + 0.00267 * t_gas)
        + M_H2O * (24.953 + 0.005359 * t_gas)
        + M_H2 * (20.684 + 0.000206 * t_gas + 0.588 * (t_gas / 1000) ** 2)
        + M_O2 * (20.93 + 0.004641 * t_gas - 0.84 * (t_gas / 1000) ** 2)
        + M_N2 * (20.398 + 0.0025 * t_gas)
    ) / M_prod


@formula("product_heat_constant", "kolchin_demidov_2008, ch. 1", constants=_FROM_CELSIUS)
def heat_constant_of_gases(  # noqa: PLR0913 - one argument per symbol
    M_CO2: Value, M_CO: Value, M_H2O: Value, M_H2: Value, M_O2: Value, M_N2: Value, M_prod: Value
) -> Value:
    """Constant of the heat of the products from 1501 to 2800 degrees Celsius."""
    return (39.123 * M_CO2 + 22.49 * M_CO + 26.67 * M_H2O + 19.678 * M_H2 + 23.723 * M_O2 + 21.951 * M_N2) / M_prod


@formula("product_heat_slope", "kolchin_demidov_2008, ch. 1", unit="kJ/(kmol*K2)", constants=_FROM_CELSIUS)
def heat_slope_of_gases(  # noqa: PLR0913 - one argument per symbol
    M_CO2: Value, M_CO: Value, M_H2O: Value, M_H2: Value, M_O2: Value, M_N2: Value, M_prod: Value
) -> Value:
    """Slope of the heat of the products from 1501 to 2800 degrees Celsius."""
    return (
        0.003349 * M_CO2 + 0.00143 * M_CO + 0.004438 * M_H2O + 0.001758 * M_H2 + 0.00155 * M_O2 + 0.001457 * M_N2
    ) / M_prod


@formula("product_heat_constant", "nguyen_tat_tien_2000", constants=_FROM_KELVIN, valid=_RICH)
def rich_heat_constant_vietnamese(alpha_air: Value) -> Value:
    """Constant of the heat of rich products."""
    return 17.997 + 3.504 * alpha_air


@formula("product_heat_slope", "nguyen_tat_tien_2000", unit="kJ/(kmol*K2)", constants=_FROM_KELVIN, valid=_RICH)
def rich_heat_slope_vietnamese(alpha_air: Value) -> Value:
    """Slope of the heat of rich products."""
    return (360.34 + 252.4 * alpha_air) / 200000


@formula("product_heat_constant", "nguyen_tat_tien_2000", constants=_FROM_KELVIN, valid=_LEAN)
def lean_heat_constant_vietnamese(alpha_air: Value) -> Value:
    """Constant of the heat of lean products."""
    return 19.876 + 1.634 / alpha_air


@formula("product_heat_slope", "nguyen_tat_tien_2000", unit="kJ/(kmol*K2)", constants=_FROM_KELVIN, valid=_LEAN)
def lean_heat_slope_vietnamese(alpha_air: Value) -> Value:
    """Slope of the heat of lean products."""
    return (427.86 + 184.36 / alpha_air) / 200000


@formula("product_heat_constant", "nikolaenko_1992", constants=_FROM_KELVIN, valid=_RICH)
def rich_heat_constant_linear(alpha_air: Value) -> Value:
    """Constant of the heat of rich products."""
    return 18.4 + 2.6 * alpha_air


@formula("product_heat_slope", "nikolaenko_1992", unit="kJ/(kmol*K2)", constants=_FROM_KELVIN, valid=_RICH)
def rich_heat_slope_linear(alpha_air: Value) -> Value:
    """Slope of the heat of rich products."""
    return (15.5 + 13.8 * alpha_air) / 10000


@formula("product_heat_constant", "nikolaenko_1992", constants=_FROM_KELVIN, valid=_LEAN)
def lean_heat_constant_linear(alpha_air: Value) -> Value:
    """Constant of the heat of lean products."""
    return 20.2 + 0.92 / alpha_air


@formula("product_heat_slope", "nikolaenko_1992", unit="kJ/(kmol*K2)", constants=_FROM_KELVIN, valid=_LEAN)
def lean_heat_slope_linear(alpha_air: Value) -> Value:
    """Slope of the heat of lean products."""
    return (15.5 + 13.8 / alpha_air) / 10000


@formula("product_heat", "nguyen_tat_tien_2000")
def product_heat(a_prod: Value, b_prod: Value, th_gas: Value) -> Value:
    """Heat of the products at a temperature, by a linear law."""
    return a_prod + b_prod * th_gas


@formula("mixture_heat", "kolchin_demidov_2008, ch. 3")
def mixture_heat(mc_fresh: Value, gamma_r: Value, mc_prod: Value) -> Value:
    """Heat of fresh charge and residual gas."""
    return (mc_fresh + gamma_r * mc_prod) / (1 + gamma_r)


class _Law(NamedTuple):
    """Formulas of one law: fresh charge; constant and slope of products, rich and lean; its zero [K]."""

    fresh: Callable[..., Any]
    rich: tuple[Callable[..., Any], Callable[..., Any]]
    lean: tuple[Callable[..., Any], Callable[..., Any]]
    zero: float = 0.0


_LAWS: dict[HeatLaw, _Law] = {
    "kolchin": _Law(
        air_heat,
        (heat_constant_of_gases, heat_slope_of_gases),
        (heat_constant_of_gases, heat_slope_of_gases),
        ZERO_CELSIUS,
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
    """Return the absolute temperature at which the scale of a law begins. [K]"""
    return _LAWS[law].zero


def as_counted(worked: Calculation, law: HeatLaw, temperature: TracedValue, name: str) -> TracedValue:
    """Return a temperature of the gas on the scale of a law.

    `worked`: has the zero of the law.
    """
    if not _LAWS[law].zero:
        return temperature
    counted: TracedValue = compression_celsius(temperature, worked["T_zero"])
    return counted.named(f"gas_celsius.{name}")


def product_coefficients(worked: Calculation, law: HeatLaw) -> None:
    """Calculate constant and slope of the heat of the products at the end of combustion.

    `worked`: has the products, or the excess air; takes the results.
    """
    for function in _LAWS[law].rich if worked["excess_air"].value < 1 else _LAWS[law].lean:
        worked(function)


def fresh_heat(worked: Calculation, law: HeatLaw, temperature: TracedValue, key: str = "") -> TracedValue:
    """Return the heat of the fresh charge. [kJ/(kmol K)]"""
    return worked(_LAWS[law].fresh, key, **{"t_c" if law == "kolchin" else "T_c": temperature})


def residual_heat(worked: Calculation, law: HeatLaw, temperature: TracedValue, key: str = "") -> TracedValue:
    """Return the heat of the products below combustion temperatures. [kJ/(kmol K)]

    `worked`: has the products, or the coefficients of a law that is the same at all temperatures; takes the results.
    """
    if law == "kolchin":
        return worked(heat_of_gases, key, t_gas=temperature)
    return worked(product_heat, key, th_gas=temperature)
