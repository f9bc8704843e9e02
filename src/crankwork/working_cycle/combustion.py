"""Combustion and expansion: from point c to z and b, and the check of the residual gas."""

from __future__ import annotations

import numpy as np

from crankwork.formula.expression import Value, formula


@formula("molar_change", "kolchin_demidov_2008, ch. 3")
def molar_change(mu_0: Value, gamma_r: Value) -> Value:
    """Molar change of the working mixture."""
    return (mu_0 + gamma_r) / (1 + gamma_r)


@formula("working_mixture_heat", "kolchin_demidov_2008, ch. 3")
def working_mixture_heat(H_fuel: Value, dH_u: Value, M_fresh: Value, gamma_r: Value) -> Value:
    """Heat that 1 kmol of working mixture gives; the 1000 makes kJ of J."""
    return (H_fuel - dH_u) / (1000 * M_fresh * (1 + gamma_r))


@formula("combustion_energy", "kolchin_demidov_2008, ch. 3")
def isochoric_energy(xi_z: Value, H_mix: Value, mc_mix: Value, th_gas: Value) -> Value:
    """Energy at z after burning at constant volume, from the zero of the law of heats."""
    return xi_z * H_mix + mc_mix * th_gas


@formula("combustion_energy", "kolchin_demidov_2008, ch. 3")
def dual_energy(  # noqa: PLR0913 - one argument per symbol
    xi_z: Value, H_mix: Value, mc_mix: Value, R_m: Value, lam_p: Value, th_gas: Value, T_zero: Value, mu: Value
) -> Value:
    """Enthalpy at z after burning at constant volume, then pressure, from the zero of the law of heats."""
    return xi_z * H_mix + (mc_mix + R_m * lam_p) * th_gas + T_zero * R_m * (lam_p - mu)


@formula("product_heat_constant_pressure", "kolchin_demidov_2008, ch. 3")
def isobaric_heat_constant(a_prod: Value, R_m: Value) -> Value:
    """Constant of the heat of the products at constant pressure."""
    return a_prod + R_m


@formula("combustion_celsius", "kolchin_demidov_2008, ch. 3", unit="degC")
def burnt_celsius(a_prod: Value, b_prod: Value, E_z: Value, mu: Value) -> Value:
    """Temperature at z, the positive root of mu (a + b t) t = E with heats at constant volume or pressure."""
    return (np.sqrt(a_prod**2 + 4 * b_prod * E_z / mu) - a_prod) / (2 * b_prod)


@formula("combustion_temperature", "kolchin_demidov_2008, ch. 3")
def combustion_kelvin(t_z: Value, T_zero: Value) -> Value:
    """Absolute temperature at z."""
    return t_z + T_zero


@formula("combustion_temperature", "nguyen_tat_tien_2000")
def burnt_temperature(a_prod: Value, b_prod: Value, E_z: Value, mu: Value) -> Value:
    """Absolute temperature at z, the positive root of mu (a + b T) T = E, as for degrees Celsius."""
    return (np.sqrt(a_prod**2 + 4 * b_prod * E_z / mu) - a_prod) / (2 * b_prod)


@formula("combustion_pressure", "kolchin_demidov_2008, ch. 3")
def isochoric_pressure(p_c: Value, mu: Value, T_z: Value, T_c: Value) -> Value:
    """Pressure at z after burning at constant volume."""
    return p_c * mu * T_z / T_c


@formula("combustion_pressure", "kolchin_demidov_2008, ch. 3")
def dual_pressure(p_c: Value, lam_p: Value) -> Value:
    """Pressure at z where the pressure ratio is chosen."""
    return p_c * lam_p


@formula("pressure_rise_ratio", "kolchin_demidov_2008, ch. 3")
def pressure_rise_ratio(p_z: Value, p_c: Value) -> Value:
    """Pressure ratio of burning."""
    return p_z / p_c


@formula("combustion_pressure_real", "kolchin_demidov_2008, ch. 3")
def real_combustion_pressure(p_z: Value) -> Value:
    """Largest pressure of a real petrol engine."""
    return 0.85 * p_z


@formula("cut_off", "kolchin_demidov_2008, ch. 3")
def cut_off(mu: Value, T_z: Value, lam_p: Value, T_c: Value) -> Value:
    """Cut-off ratio."""
    return mu * T_z / (lam_p * T_c)


@formula("afterexpansion", "kolchin_demidov_2008, ch. 3")
def afterexpansion(r_c: Value, rho_cut: Value) -> Value:
    """Expansion ratio after z."""
    return r_c / rho_cut


@formula("expansion_pressure", "kolchin_demidov_2008, ch. 3")
def expansion_pressure(p_z: Value, delta_post: Value, n_2: Value) -> Value:
    """Pressure at the end of expansion."""
    return p_z / np.power(delta_post, n_2)


@formula("expansion_temperature", "kolchin_demidov_2008, ch. 3")
def expansion_temperature(T_z: Value, delta_post: Value, n_2: Value) -> Value:
    """Temperature at the end of expansion."""
    return T_z / np.power(delta_post, n_2 - 1)


@formula("residual_temperature_found", "kolchin_demidov_2008, ch. 3")
def residual_temperature_found(T_exp: Value, p_exp: Value, p_r: Value, m_exh: Value) -> Value:
    """Temperature of the residual gas from the end of expansion."""
    return T_exp / np.power(p_exp / p_r, (m_exh - 1) / m_exh)


@formula("residual_temperature_deviation", "kolchin_demidov_2008, ch. 3")
def residual_temperature_deviation(T_r_found: Value, T_r: Value) -> Value:
    """Deviation of the temperature of the residual gas from the one assumed."""
    return (T_r_found - T_r) / T_r
