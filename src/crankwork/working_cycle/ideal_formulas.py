"""Formulas of ideal cycles of 1 kg of a gas with constant heat capacities.

Points: 1 begins the compression, 2 ends it. Otto: heat up to 3, expansion to 4. Diesel: heat at constant pressure up
to 3, expansion to 4. Dual: heat at constant volume up to 3, at constant pressure up to 4, expansion to 5.
"""

from __future__ import annotations

from crankwork.formula.expression import Value, formula


@formula("isochoric_heat", "cengel_boles_2015, ch. 4")
def isochoric_heat(R_gas: Value, kappa: Value) -> Value:
    """Specific heat at constant volume of an ideal gas."""
    return R_gas / (kappa - 1)


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def compressed_temperature(T_st1: Value, r_c: Value, kappa: Value) -> Value:
    """Temperature after isentropic compression."""
    return T_st1 * r_c ** (kappa - 1)


@formula("state_pressure", "cengel_boles_2015, ch. 9")
def compressed_pressure(p_st1: Value, r_c: Value, kappa: Value) -> Value:
    """Pressure after isentropic compression."""
    return p_st1 * r_c**kappa


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def isochorically_heated(T_st2: Value, q_add: Value, c_v: Value) -> Value:
    """Temperature after heat at constant volume."""
    return T_st2 + q_add / c_v


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def isobarically_heated(T_st2: Value, q_add: Value, kappa: Value, c_v: Value) -> Value:
    """Temperature after heat at constant pressure."""
    return T_st2 + q_add / (kappa * c_v)


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def dually_heated(T_st3: Value, q_add: Value, c_v: Value, T_st2: Value, kappa: Value) -> Value:
    """Temperature after the rest of the heat at constant pressure."""
    return T_st3 + (q_add - c_v * (T_st3 - T_st2)) / (kappa * c_v)


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def raised_temperature(lam_p: Value, T_st2: Value) -> Value:
    """Temperature after a rise of pressure at constant volume, or of volume at constant pressure."""
    return lam_p * T_st2


@formula("state_pressure", "cengel_boles_2015, ch. 9")
def raised_pressure(lam_p: Value, p_st2: Value) -> Value:
    """Pressure after a pressure rise at constant volume."""
    return lam_p * p_st2


@formula("pressure_rise_ratio", "cengel_boles_2015, ch. 9")
def temperature_ratio(T_st3: Value, T_st2: Value) -> Value:
    """Ratio of temperatures: of the pressures at constant volume, of the volumes at constant pressure."""
    return T_st3 / T_st2


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def expanded_temperature(T_st3: Value, rho_cut: Value, r_c: Value, kappa: Value) -> Value:
    """Temperature after isentropic expansion from the highest one."""
    return T_st3 * (rho_cut / r_c) ** (kappa - 1)


@formula("state_pressure", "cengel_boles_2015, ch. 9")
def expanded_pressure(p_st3: Value, rho_cut: Value, r_c: Value, kappa: Value) -> Value:
    """Pressure after isentropic expansion of an Otto or Diesel cycle."""
    return p_st3 * (rho_cut / r_c) ** kappa


@formula("heat_added", "cengel_boles_2015, ch. 9")
def heat_at_constant_volume(c_v: Value, T_st3: Value, T_st2: Value) -> Value:
    """Heat between two temperatures at constant volume."""
    return c_v * (T_st3 - T_st2)


@formula("heat_added", "cengel_boles_2015, ch. 9")
def isobaric_heat_added(kappa: Value, c_v: Value, T_st3: Value, T_st2: Value) -> Value:
    """Heat added at constant pressure."""
    return kappa * c_v * (T_st3 - T_st2)


@formula("heat_added", "cengel_boles_2015, ch. 9")
def dual_heat_added(c_v: Value, T_st3: Value, T_st2: Value, kappa: Value, T_st4: Value) -> Value:
    """Heat added at constant volume, then pressure."""
    return c_v * (T_st3 - T_st2) + kappa * c_v * (T_st4 - T_st3)


@formula("ideal_work", "cengel_boles_2015, ch. 9")
def ideal_work(q_add: Value, q_rej: Value) -> Value:
    """Work of a cycle."""
    return q_add - q_rej


@formula("thermal_efficiency", "cengel_boles_2015, ch. 9")
def thermal_efficiency(w_t: Value, q_add: Value) -> Value:
    """Work over heat added."""
    return w_t / q_add


@formula("thermal_efficiency", "cengel_boles_2015, ch. 9")
def otto_efficiency(r_c: Value, kappa: Value) -> Value:
    """Efficiency of the Otto cycle in closed form."""
    return 1 - 1 / r_c ** (kappa - 1)


@formula("thermal_efficiency", "cengel_boles_2015, ch. 9")
def dual_efficiency(r_c: Value, kappa: Value, lam_p: Value, rho_cut: Value) -> Value:
    """Efficiency of the dual cycle in closed form; of the Diesel cycle with a pressure ratio of 1."""
    return 1 - (lam_p * rho_cut**kappa - 1) / (r_c ** (kappa - 1) * (lam_p - 1 + kappa * lam_p * (rho_cut - 1)))


@formula("ideal_mean_pressure", "cengel_boles_2015, ch. 9")
def ideal_mean_pressure(w_t: Value, p_st1: Value, r_c: Value, R_gas: Value, T_st1: Value) -> Value:
    """Work over the change of volume."""
    return w_t * p_st1 * r_c / (R_gas * T_st1 * (r_c - 1))
