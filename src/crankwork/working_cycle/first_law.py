"""The gas in a closed cylinder as one zone: ideal gas, first law, ratio of specific heats linear in temperature."""

from __future__ import annotations

import numpy as np

from crankwork.formula.expression import Value, formula


@formula("gas_mass", "heywood_1988, ch. 3")
def gas_mass(p_shut: Value, V_1: Value, R_gas: Value, T_shut: Value) -> Value:
    """Mass of the gas enclosed at intake closing."""
    return p_shut * V_1 / (R_gas * T_shut)


@formula("cylinder_temperature", "heywood_1988, ch. 3")
def gas_temperature(p_cyl: Value, V: Value, m_gas: Value, R_gas: Value) -> Value:
    """Mean temperature of the enclosed gas."""
    return p_cyl * V / (m_gas * R_gas)


@formula("gas_heat_ratio", "heywood_1988, ch. 9")
def gas_heat_ratio(gamma_cyl_0: Value, gamma_cyl_T: Value, T_cyl: Value) -> Value:
    """Ratio of specific heats, linear in temperature."""
    return gamma_cyl_0 + gamma_cyl_T * T_cyl


@formula("pressure_rise", "heywood_1988, ch. 9")
def pressure_rise(  # noqa: PLR0913 - one argument per symbol
    gamma_cyl: Value, V: Value, Q_fuel: Value, x_burn_1: Value, Q_wall_1: Value, p_cyl: Value, V_phi: Value
) -> Value:
    """Pressure rise of the enclosed gas by the first law."""
    return (gamma_cyl - 1) / V * (Q_fuel * x_burn_1 - Q_wall_1) - gamma_cyl * p_cyl / V * V_phi


def internal_energy_change(heat_constant: float, ratio: float, ratio_slope: float, start: float, end: float) -> float:
    """Return the change of internal energy between two temperatures, of m R / (gamma - 1) (heywood_1988, ch. 9). [J]"""
    first = ratio + ratio_slope * start - 1
    growth = ratio_slope * (end - start) / first
    # ln(1 + g) / g keeps its digits as the slope goes to zero
    mean = np.log1p(growth) / growth if growth else 1.0
    return float(heat_constant * (end - start) / first * mean)
