"""Combustion and expansion: from point c to z and b, and the check of the residual gas."""

from __future__ import annotations

import numpy as np

from crankwork.expressions import Value, formula


@formula("molar_change", "kolchin_demidov_2008, ch. 3")
def molar_change(mu_0: Value, gamma_r: Value) -> Value:
    """Molar change of the working mixture.

    Parameters
    ----------
    mu_0, gamma_r : float
        Molar change of the fresh charge, residual gas fraction. [-]

    Returns
    -------
    float
        Ratio. [-]
    """
    return (mu_0 + gamma_r) / (1 + gamma_r)


@formula("working_mixture_heat", "kolchin_demidov_2008, ch. 3")
def working_mixture_heat(H_fuel: Value, dH_u: Value, M_fresh: Value, gamma_r: Value) -> Value:
    """Heat that 1 kmol of working mixture gives; the 1000 makes kJ of J.

    Parameters
    ----------
    H_fuel, dH_u, M_fresh, gamma_r : float
        Heating value, heat lost to incomplete burning, fresh charge, residual gas fraction.
        [J/kg], [J/kg], [kmol/kg], [-]

    Returns
    -------
    float
        Heat. [kJ/kmol]
    """
    return (H_fuel - dH_u) / (1000 * M_fresh * (1 + gamma_r))


@formula("combustion_energy", "kolchin_demidov_2008, ch. 3")
def isochoric_energy(xi_z: Value, H_mix: Value, mc_mix: Value, t_c: Value) -> Value:
    """Energy at z after burning at constant volume, from 0 degrees Celsius.

    Parameters
    ----------
    xi_z, H_mix, mc_mix, t_c : float
        Heat use, heat and mean molar heat of the mixture, temperature at c. [-], [kJ/kmol], [kJ/(kmol K)], [degC]

    Returns
    -------
    float
        Energy of 1 kmol of mixture. [kJ/kmol]
    """
    return xi_z * H_mix + mc_mix * t_c


@formula("combustion_energy", "kolchin_demidov_2008, ch. 3")
def dual_energy(  # noqa: PLR0913 - one argument per symbol
    xi_z: Value, H_mix: Value, mc_mix: Value, R_m: Value, lam_p: Value, t_c: Value, mu: Value
) -> Value:
    """Enthalpy at z after burning at constant volume, then pressure, from 0 degrees Celsius.

    Parameters
    ----------
    xi_z, H_mix, mc_mix, R_m, lam_p, t_c, mu : float
        Heat use, heat and mean molar heat of the mixture, gas constant, pressure ratio, temperature at c, molar
        change. [-], [kJ/kmol], [kJ/(kmol K)], [kJ/(kmol K)], [-], [degC], [-]

    Returns
    -------
    float
        Enthalpy of 1 kmol of mixture. [kJ/kmol]
    """
    return xi_z * H_mix + (mc_mix + R_m * lam_p) * t_c + 273.15 * R_m * (lam_p - mu)


@formula("combustion_energy", "nguyen_tat_tien_2000")
def isochoric_energy_kelvin(xi_z: Value, H_mix: Value, mc_mix: Value, T_c: Value) -> Value:
    """Energy at z after burning at constant volume, from 0 K.

    Parameters
    ----------
    xi_z, H_mix, mc_mix, T_c : float
        Heat use, heat and mean molar heat of the mixture, temperature at c. [-], [kJ/kmol], [kJ/(kmol K)], [K]

    Returns
    -------
    float
        Energy of 1 kmol of mixture. [kJ/kmol]
    """
    return xi_z * H_mix + mc_mix * T_c


@formula("combustion_energy", "nguyen_tat_tien_2000")
def dual_energy_kelvin(xi_z: Value, H_mix: Value, mc_mix: Value, R_m: Value, lam_p: Value, T_c: Value) -> Value:
    """Enthalpy at z after burning at constant volume, then pressure, from 0 K.

    Parameters
    ----------
    xi_z, H_mix, mc_mix, R_m, lam_p, T_c : float
        Heat use, heat and mean molar heat of the mixture, gas constant, pressure ratio, temperature at c.
        [-], [kJ/kmol], [kJ/(kmol K)], [kJ/(kmol K)], [-], [K]

    Returns
    -------
    float
        Enthalpy of 1 kmol of mixture. [kJ/kmol]
    """
    return xi_z * H_mix + (mc_mix + R_m * lam_p) * T_c


@formula("product_heat_constant_pressure", "kolchin_demidov_2008, ch. 3")
def isobaric_heat_constant(a_prod: Value, R_m: Value) -> Value:
    """Constant of the heat of the products at constant pressure.

    Parameters
    ----------
    a_prod, R_m : float
        Constant at constant volume, gas constant. [kJ/(kmol K)]

    Returns
    -------
    float
        Constant. [kJ/(kmol K)]
    """
    return a_prod + R_m


@formula("combustion_celsius", "kolchin_demidov_2008, ch. 3")
def isochoric_celsius(a_prod: Value, b_prod: Value, E_z: Value, mu: Value) -> Value:
    """Positive root of mu (a + b t) t = E.

    Parameters
    ----------
    a_prod, b_prod, E_z, mu : float
        Constant and slope of the heat of the products, energy, molar change.
        [kJ/(kmol K)], [kJ/(kmol K2)], [kJ/kmol], [-]

    Returns
    -------
    float
        Temperature at z. [degC]
    """
    return (np.sqrt(a_prod**2 + 4 * b_prod * E_z / mu) - a_prod) / (2 * b_prod)


@formula("combustion_celsius", "kolchin_demidov_2008, ch. 3")
def dual_celsius(a_prod_p: Value, b_prod: Value, E_z: Value, mu: Value) -> Value:
    """Positive root of mu (a_p + b t) t = E.

    Parameters
    ----------
    a_prod_p, b_prod, E_z, mu : float
        Constant and slope of the heat of the products at constant pressure, enthalpy, molar change.
        [kJ/(kmol K)], [kJ/(kmol K2)], [kJ/kmol], [-]

    Returns
    -------
    float
        Temperature at z. [degC]
    """
    return (np.sqrt(a_prod_p**2 + 4 * b_prod * E_z / mu) - a_prod_p) / (2 * b_prod)


@formula("combustion_temperature", "kolchin_demidov_2008, ch. 3")
def combustion_kelvin(t_z: Value) -> Value:
    """Absolute temperature at z.

    Parameters
    ----------
    t_z : float
        Temperature. [degC]

    Returns
    -------
    float
        Temperature. [K]
    """
    return t_z + 273.15


@formula("combustion_temperature", "nguyen_tat_tien_2000")
def isochoric_temperature(a_prod: Value, b_prod: Value, E_z: Value, mu: Value) -> Value:
    """Positive root of mu (a + b T) T = E.

    Parameters
    ----------
    a_prod, b_prod, E_z, mu : float
        Constant and slope of the heat of the products, energy, molar change.
        [kJ/(kmol K)], [kJ/(kmol K2)], [kJ/kmol], [-]

    Returns
    -------
    float
        Temperature at z. [K]
    """
    return (np.sqrt(a_prod**2 + 4 * b_prod * E_z / mu) - a_prod) / (2 * b_prod)


@formula("combustion_temperature", "nguyen_tat_tien_2000")
def dual_temperature(a_prod_p: Value, b_prod: Value, E_z: Value, mu: Value) -> Value:
    """Positive root of mu (a_p + b T) T = E.

    Parameters
    ----------
    a_prod_p, b_prod, E_z, mu : float
        Constant and slope of the heat of the products at constant pressure, enthalpy, molar change.
        [kJ/(kmol K)], [kJ/(kmol K2)], [kJ/kmol], [-]

    Returns
    -------
    float
        Temperature at z. [K]
    """
    return (np.sqrt(a_prod_p**2 + 4 * b_prod * E_z / mu) - a_prod_p) / (2 * b_prod)


@formula("combustion_pressure", "kolchin_demidov_2008, ch. 3")
def isochoric_pressure(p_c: Value, mu: Value, T_z: Value, T_c: Value) -> Value:
    """Pressure at z after burning at constant volume.

    Parameters
    ----------
    p_c, mu, T_z, T_c : float
        Pressure at c, molar change, temperatures at z and c. [Pa], [-], [K], [K]

    Returns
    -------
    float
        Pressure. [Pa]
    """
    return p_c * mu * T_z / T_c


@formula("combustion_pressure", "kolchin_demidov_2008, ch. 3")
def dual_pressure(p_c: Value, lam_p: Value) -> Value:
    """Pressure at z where the pressure ratio is chosen.

    Parameters
    ----------
    p_c, lam_p : float
        Pressure at c, pressure ratio. [Pa], [-]

    Returns
    -------
    float
        Pressure. [Pa]
    """
    return p_c * lam_p


@formula("pressure_rise_ratio", "kolchin_demidov_2008, ch. 3")
def pressure_rise_ratio(p_z: Value, p_c: Value) -> Value:
    """Pressure ratio of burning.

    Parameters
    ----------
    p_z, p_c : float
        Pressures at z and c. [Pa]

    Returns
    -------
    float
        Ratio. [-]
    """
    return p_z / p_c


@formula("combustion_pressure_real", "kolchin_demidov_2008, ch. 3")
def real_combustion_pressure(p_z: Value) -> Value:
    """Largest pressure of a real petrol engine.

    Parameters
    ----------
    p_z : float
        Pressure at z of the theoretical diagram. [Pa]

    Returns
    -------
    float
        Pressure. [Pa]
    """
    return 0.85 * p_z


@formula("cut_off", "kolchin_demidov_2008, ch. 3")
def cut_off(mu: Value, T_z: Value, lam_p: Value, T_c: Value) -> Value:
    """Cut-off ratio.

    Parameters
    ----------
    mu, T_z, lam_p, T_c : float
        Molar change, temperature at z, pressure ratio, temperature at c. [-], [K], [-], [K]

    Returns
    -------
    float
        Volume at z over clearance volume. [-]
    """
    return mu * T_z / (lam_p * T_c)


@formula("afterexpansion", "kolchin_demidov_2008, ch. 3")
def afterexpansion(r_c: Value, rho_cut: Value) -> Value:
    """Expansion ratio after z.

    Parameters
    ----------
    r_c, rho_cut : float
        Compression ratio, cut-off ratio. [-]

    Returns
    -------
    float
        Ratio. [-]
    """
    return r_c / rho_cut


@formula("expansion_pressure", "kolchin_demidov_2008, ch. 3")
def expansion_pressure(p_z: Value, delta_post: Value, n_2: Value) -> Value:
    """Pressure at the end of expansion.

    Parameters
    ----------
    p_z, delta_post, n_2 : float
        Pressure at z, expansion ratio, exponent. [Pa], [-], [-]

    Returns
    -------
    float
        Pressure. [Pa]
    """
    return p_z / np.power(delta_post, n_2)


@formula("expansion_temperature", "kolchin_demidov_2008, ch. 3")
def expansion_temperature(T_z: Value, delta_post: Value, n_2: Value) -> Value:
    """Temperature at the end of expansion.

    Parameters
    ----------
    T_z, delta_post, n_2 : float
        Temperature at z, expansion ratio, exponent. [K], [-], [-]

    Returns
    -------
    float
        Temperature. [K]
    """
    return T_z / np.power(delta_post, n_2 - 1)


@formula("expansion_pressure", "kolchin_demidov_2008, ch. 3")
def full_expansion_pressure(p_z: Value, r_c: Value, n_2: Value) -> Value:
    """Pressure at the end of an expansion from the clearance volume.

    Parameters
    ----------
    p_z, r_c, n_2 : float
        Pressure at z, compression ratio, exponent. [Pa], [-], [-]

    Returns
    -------
    float
        Pressure. [Pa]
    """
    return p_z / np.power(r_c, n_2)


@formula("expansion_temperature", "kolchin_demidov_2008, ch. 3")
def full_expansion_temperature(T_z: Value, r_c: Value, n_2: Value) -> Value:
    """Temperature at the end of an expansion from the clearance volume.

    Parameters
    ----------
    T_z, r_c, n_2 : float
        Temperature at z, compression ratio, exponent. [K], [-], [-]

    Returns
    -------
    float
        Temperature. [K]
    """
    return T_z / np.power(r_c, n_2 - 1)


@formula("residual_temperature_found", "kolchin_demidov_2008, ch. 3")
def residual_temperature_found(T_exp: Value, p_exp: Value, p_r: Value, m_exh: Value) -> Value:
    """Temperature of the residual gas from the end of expansion.

    Parameters
    ----------
    T_exp, p_exp, p_r, m_exh : float
        Temperature and pressure at b, pressure of the residual gas, exponent of the exhaust. [K], [Pa], [Pa], [-]

    Returns
    -------
    float
        Temperature; with the exponent 1.5 by the cube root of the pressures. [K]
    """
    return T_exp / np.power(p_exp / p_r, (m_exh - 1) / m_exh)


@formula("residual_temperature_deviation", "kolchin_demidov_2008, ch. 3")
def residual_temperature_deviation(T_r_found: Value, T_r: Value) -> Value:
    """Deviation of the temperature of the residual gas from the one assumed.

    Parameters
    ----------
    T_r_found, T_r : float
        Temperature found and assumed. [K]

    Returns
    -------
    float
        Share of the one assumed. [-]
    """
    return (T_r_found - T_r) / T_r
