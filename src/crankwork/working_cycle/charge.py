"""From the air before the intake to the end of compression."""

from __future__ import annotations

import numpy as np

from crankwork.formula.expression import Value, formula


@formula("compressor_temperature", "kolchin_demidov_2008, ch. 3")
def compressor_temperature(T_amb: Value, p_k: Value, p_0: Value, n_k: Value) -> Value:
    """Temperature behind the compressor."""
    return T_amb * np.power(p_k / p_0, (n_k - 1) / n_k)


@formula("charge_temperature", "kolchin_demidov_2008, ch. 3")
def cooled_charge_temperature(T_comp: Value, dT_cool: Value) -> Value:
    """Temperature behind the cooler."""
    return T_comp - dT_cool


@formula("charge_density", "kolchin_demidov_2008, ch. 3")
def charge_density(p_k: Value, R_gas: Value, T_k: Value) -> Value:
    """Density before the intake."""
    return p_k / (R_gas * T_k)


@formula("intake_pressure_loss", "kolchin_demidov_2008, ch. 3")
def intake_pressure_loss(xi_in: Value, w_in: Value, rho_k: Value) -> Value:
    """Pressure loss of the intake."""
    return xi_in * w_in**2 / 2 * rho_k


@formula("intake_pressure", "kolchin_demidov_2008, ch. 3")
def intake_pressure(p_k: Value, dp_a: Value) -> Value:
    """Pressure at the end of intake."""
    return p_k - dp_a


@formula("residual_fraction", "kolchin_demidov_2008, ch. 3")
def residual_fraction(  # noqa: PLR0913 - one argument per symbol
    T_k: Value, dT_heat: Value, T_r: Value, phi_sc: Value, p_r: Value, r_c: Value, phi_ch: Value, p_a: Value
) -> Value:
    """Residual gas over fresh charge."""
    return (T_k + dT_heat) / T_r * (phi_sc * p_r) / (r_c * phi_ch * p_a - phi_sc * p_r)


@formula("intake_temperature", "kolchin_demidov_2008, ch. 3")
def intake_temperature(T_k: Value, dT_heat: Value, gamma_r: Value, T_r: Value) -> Value:
    """Temperature at the end of intake."""
    return (T_k + dT_heat + gamma_r * T_r) / (1 + gamma_r)


@formula("volumetric_efficiency", "kolchin_demidov_2008, ch. 3")
def volumetric_efficiency(  # noqa: PLR0913 - one argument per symbol
    T_k: Value, dT_heat: Value, r_c: Value, p_k: Value, phi_ch: Value, p_a: Value, phi_sc: Value, p_r: Value
) -> Value:
    """Volumetric efficiency."""
    return T_k / (T_k + dT_heat) / ((r_c - 1) * p_k) * (phi_ch * r_c * p_a - phi_sc * p_r)


@formula("residual_fraction", "nguyen_tat_tien_2000")
def residual_fraction_vietnamese(  # noqa: PLR0913 - one argument per symbol
    phi_sc: Value,
    T_k: Value,
    dT_heat: Value,
    T_r: Value,
    p_r: Value,
    p_a: Value,
    r_c: Value,
    phi_ch: Value,
    lam_t: Value,
    m_exh: Value,
) -> Value:
    """Residual gas over fresh charge, the residual gas expanding to the pressure of the intake."""
    expanded = lam_t * phi_sc * np.power(p_r / p_a, 1 / m_exh)
    return phi_sc * (T_k + dT_heat) / T_r * (p_r / p_a) / (r_c * phi_ch - expanded)


@formula("intake_temperature", "nguyen_tat_tien_2000")
def intake_temperature_vietnamese(  # noqa: PLR0913 - one argument per symbol
    T_k: Value, dT_heat: Value, lam_t: Value, gamma_r: Value, T_r: Value, p_a: Value, p_r: Value, m_exh: Value
) -> Value:
    """Temperature at the end of intake, the residual gas expanding to the pressure of the intake."""
    return (T_k + dT_heat + lam_t * gamma_r * T_r * np.power(p_a / p_r, (m_exh - 1) / m_exh)) / (1 + gamma_r)


@formula("volumetric_efficiency", "nguyen_tat_tien_2000")
def volumetric_efficiency_vietnamese(  # noqa: PLR0913 - one argument per symbol
    r_c: Value,
    T_k: Value,
    dT_heat: Value,
    p_a: Value,
    p_k: Value,
    phi_ch: Value,
    lam_t: Value,
    phi_sc: Value,
    p_r: Value,
    m_exh: Value,
) -> Value:
    """Volumetric efficiency, the residual gas expanding to the pressure of the intake."""
    expanded = lam_t * phi_sc * np.power(p_r / p_a, 1 / m_exh)
    return 1 / (r_c - 1) * T_k / (T_k + dT_heat) * p_a / p_k * (r_c * phi_ch - expanded)


@formula("geometric_compression_ratio", "kolchin_demidov_2008, ch. 3")
def geometric_compression_ratio(r_c: Value, psi_lost: Value) -> Value:
    """Compression ratio of the whole stroke, from the one that begins with shut ports."""
    return (r_c - psi_lost) / (1 - psi_lost)


@formula("compression_pressure", "kolchin_demidov_2008, ch. 3")
def compression_pressure(p_a: Value, r_c: Value, n_1: Value) -> Value:
    """Pressure at the end of compression."""
    return p_a * np.power(r_c, n_1)


@formula("compression_temperature", "kolchin_demidov_2008, ch. 3")
def compression_temperature(T_a: Value, r_c: Value, n_1: Value) -> Value:
    """Temperature at the end of compression."""
    return T_a * np.power(r_c, n_1 - 1)


@formula("compression_celsius", "kolchin_demidov_2008, ch. 3", unit="degC")
def compression_celsius(T_c: Value, T_zero: Value) -> Value:
    """Temperature in degrees Celsius, at the end of compression or of another gas."""
    return T_c - T_zero
