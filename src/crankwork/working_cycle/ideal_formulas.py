"""Formulas of ideal cycles of 1 kg of a gas with constant heats.

Points: 1 begins the compression, 2 ends it. Otto: heat up to 3, expansion to 4. Diesel: heat at constant pressure up
to 3, expansion to 4. Dual: heat at constant volume up to 3, at constant pressure up to 4, expansion to 5.
"""

from __future__ import annotations

from crankwork.expressions import Value, formula


@formula("isochoric_heat", "cengel_boles_2015, ch. 4")
def isochoric_heat(R_gas: Value, kappa: Value) -> Value:
    """Specific heat at constant volume of an ideal gas.

    Parameters
    ----------
    R_gas, kappa : float
        Gas constant, ratio of specific heats. [J/(kg K)], [-]

    Returns
    -------
    float
        Specific heat. [J/(kg K)]
    """
    return R_gas / (kappa - 1)


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def compressed_temperature(T_st1: Value, r_c: Value, kappa: Value) -> Value:
    """Temperature after isentropic compression.

    Parameters
    ----------
    T_st1, r_c, kappa : float
        Temperature at 1, compression ratio, ratio of specific heats. [K], [-], [-]

    Returns
    -------
    float
        Temperature at 2. [K]
    """
    return T_st1 * r_c ** (kappa - 1)


@formula("state_pressure", "cengel_boles_2015, ch. 9")
def compressed_pressure(p_st1: Value, r_c: Value, kappa: Value) -> Value:
    """Pressure after isentropic compression.

    Parameters
    ----------
    p_st1, r_c, kappa : float
        Pressure at 1, compression ratio, ratio of specific heats. [Pa], [-], [-]

    Returns
    -------
    float
        Pressure at 2. [Pa]
    """
    return p_st1 * r_c**kappa


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def isochorically_heated(T_st2: Value, q_add: Value, c_v: Value) -> Value:
    """Temperature after heat at constant volume.

    Parameters
    ----------
    T_st2, q_add, c_v : float
        Temperature at 2, heat added, specific heat. [K], [J/kg], [J/(kg K)]

    Returns
    -------
    float
        Temperature at 3. [K]
    """
    return T_st2 + q_add / c_v


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def isobarically_heated(T_st2: Value, q_add: Value, kappa: Value, c_v: Value) -> Value:
    """Temperature after heat at constant pressure.

    Parameters
    ----------
    T_st2, q_add, kappa, c_v : float
        Temperature at 2, heat added, ratio of specific heats, that at constant volume.
        [K], [J/kg], [-], [J/(kg K)]

    Returns
    -------
    float
        Temperature at 3. [K]
    """
    return T_st2 + q_add / (kappa * c_v)


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def dually_heated(T_st3: Value, q_add: Value, c_v: Value, T_st2: Value, kappa: Value) -> Value:
    """Temperature after the rest of the heat at constant pressure.

    Parameters
    ----------
    T_st3, q_add, c_v, T_st2, kappa : float
        Temperature at 3, heat added in all, specific heat, temperature at 2, ratio of specific heats.
        [K], [J/kg], [J/(kg K)], [K], [-]

    Returns
    -------
    float
        Temperature at 4. [K]
    """
    return T_st3 + (q_add - c_v * (T_st3 - T_st2)) / (kappa * c_v)


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def raised_temperature(lam_p: Value, T_st2: Value) -> Value:
    """Temperature after a pressure rise at constant volume.

    Parameters
    ----------
    lam_p, T_st2 : float
        Pressure ratio, temperature at 2. [-], [K]

    Returns
    -------
    float
        Temperature at 3. [K]
    """
    return lam_p * T_st2


@formula("state_pressure", "cengel_boles_2015, ch. 9")
def raised_pressure(lam_p: Value, p_st2: Value) -> Value:
    """Pressure after a pressure rise at constant volume.

    Parameters
    ----------
    lam_p, p_st2 : float
        Pressure ratio, pressure at 2. [-], [Pa]

    Returns
    -------
    float
        Pressure at 3. [Pa]
    """
    return lam_p * p_st2


@formula("pressure_rise_ratio", "cengel_boles_2015, ch. 9")
def pressure_ratio_of_heat(T_st3: Value, T_st2: Value) -> Value:
    """Pressure ratio of heat at constant volume.

    Parameters
    ----------
    T_st3, T_st2 : float
        Temperatures at 3 and 2. [K]

    Returns
    -------
    float
        Ratio. [-]
    """
    return T_st3 / T_st2


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def cut_off_temperature(rho_cut: Value, T_st2: Value) -> Value:
    """Temperature at the cut-off of a Diesel cycle.

    Parameters
    ----------
    rho_cut, T_st2 : float
        Cut-off ratio, temperature at 2. [-], [K]

    Returns
    -------
    float
        Temperature at 3. [K]
    """
    return rho_cut * T_st2


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def dual_cut_off_temperature(rho_cut: Value, T_st3: Value) -> Value:
    """Temperature at the cut-off of a dual cycle.

    Parameters
    ----------
    rho_cut, T_st3 : float
        Cut-off ratio, temperature at 3. [-], [K]

    Returns
    -------
    float
        Temperature at 4. [K]
    """
    return rho_cut * T_st3


@formula("cut_off", "cengel_boles_2015, ch. 9")
def diesel_cut_off(T_st3: Value, T_st2: Value) -> Value:
    """Cut-off ratio of a Diesel cycle.

    Parameters
    ----------
    T_st3, T_st2 : float
        Temperatures at 3 and 2. [K]

    Returns
    -------
    float
        Ratio. [-]
    """
    return T_st3 / T_st2


@formula("cut_off", "cengel_boles_2015, ch. 9")
def dual_cut_off(T_st4: Value, T_st3: Value) -> Value:
    """Cut-off ratio of a dual cycle.

    Parameters
    ----------
    T_st4, T_st3 : float
        Temperatures at 4 and 3. [K]

    Returns
    -------
    float
        Ratio. [-]
    """
    return T_st4 / T_st3


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def expanded_temperature(T_st3: Value, rho_cut: Value, r_c: Value, kappa: Value) -> Value:
    """Temperature after isentropic expansion of an Otto or Diesel cycle.

    Parameters
    ----------
    T_st3, rho_cut, r_c, kappa : float
        Temperature at 3, cut-off and compression ratio, ratio of specific heats. [K], [-], [-], [-]

    Returns
    -------
    float
        Temperature at 4. [K]
    """
    return T_st3 * (rho_cut / r_c) ** (kappa - 1)


@formula("state_pressure", "cengel_boles_2015, ch. 9")
def expanded_pressure(p_st3: Value, rho_cut: Value, r_c: Value, kappa: Value) -> Value:
    """Pressure after isentropic expansion of an Otto or Diesel cycle.

    Parameters
    ----------
    p_st3, rho_cut, r_c, kappa : float
        Pressure at 3, cut-off and compression ratio, ratio of specific heats. [Pa], [-], [-], [-]

    Returns
    -------
    float
        Pressure at 4. [Pa]
    """
    return p_st3 * (rho_cut / r_c) ** kappa


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def dual_expanded_temperature(T_st4: Value, rho_cut: Value, r_c: Value, kappa: Value) -> Value:
    """Temperature after isentropic expansion of a dual cycle.

    Parameters
    ----------
    T_st4, rho_cut, r_c, kappa : float
        Temperature at 4, cut-off and compression ratio, ratio of specific heats. [K], [-], [-], [-]

    Returns
    -------
    float
        Temperature at 5. [K]
    """
    return T_st4 * (rho_cut / r_c) ** (kappa - 1)


@formula("heat_added", "cengel_boles_2015, ch. 9")
def isochoric_heat_added(c_v: Value, T_st3: Value, T_st2: Value) -> Value:
    """Heat added at constant volume.

    Parameters
    ----------
    c_v, T_st3, T_st2 : float
        Specific heat, temperatures at 3 and 2. [J/(kg K)], [K], [K]

    Returns
    -------
    float
        Heat. [J/kg]
    """
    return c_v * (T_st3 - T_st2)


@formula("heat_added", "cengel_boles_2015, ch. 9")
def isobaric_heat_added(kappa: Value, c_v: Value, T_st3: Value, T_st2: Value) -> Value:
    """Heat added at constant pressure.

    Parameters
    ----------
    kappa, c_v, T_st3, T_st2 : float
        Ratio of specific heats, that at constant volume, temperatures at 3 and 2. [-], [J/(kg K)], [K], [K]

    Returns
    -------
    float
        Heat. [J/kg]
    """
    return kappa * c_v * (T_st3 - T_st2)


@formula("heat_added", "cengel_boles_2015, ch. 9")
def dual_heat_added(c_v: Value, T_st3: Value, T_st2: Value, kappa: Value, T_st4: Value) -> Value:
    """Heat added at constant volume, then pressure.

    Parameters
    ----------
    c_v, T_st3, T_st2, kappa, T_st4 : float
        Specific heat, temperatures at 3 and 2, ratio of specific heats, temperature at 4.
        [J/(kg K)], [K], [K], [-], [K]

    Returns
    -------
    float
        Heat. [J/kg]
    """
    return c_v * (T_st3 - T_st2) + kappa * c_v * (T_st4 - T_st3)


@formula("heat_rejected", "cengel_boles_2015, ch. 9")
def heat_rejected(c_v: Value, T_st4: Value, T_st1: Value) -> Value:
    """Heat rejected by an Otto or Diesel cycle.

    Parameters
    ----------
    c_v, T_st4, T_st1 : float
        Specific heat, temperatures at 4 and 1. [J/(kg K)], [K], [K]

    Returns
    -------
    float
        Heat. [J/kg]
    """
    return c_v * (T_st4 - T_st1)


@formula("heat_rejected", "cengel_boles_2015, ch. 9")
def dual_heat_rejected(c_v: Value, T_st5: Value, T_st1: Value) -> Value:
    """Heat rejected by a dual cycle.

    Parameters
    ----------
    c_v, T_st5, T_st1 : float
        Specific heat, temperatures at 5 and 1. [J/(kg K)], [K], [K]

    Returns
    -------
    float
        Heat. [J/kg]
    """
    return c_v * (T_st5 - T_st1)


@formula("ideal_work", "cengel_boles_2015, ch. 9")
def ideal_work(q_add: Value, q_rej: Value) -> Value:
    """Work of a cycle.

    Parameters
    ----------
    q_add, q_rej : float
        Heat added and rejected. [J/kg]

    Returns
    -------
    float
        Work. [J/kg]
    """
    return q_add - q_rej


@formula("thermal_efficiency", "cengel_boles_2015, ch. 9")
def thermal_efficiency(w_t: Value, q_add: Value) -> Value:
    """Work over heat added.

    Parameters
    ----------
    w_t, q_add : float
        Work, heat added. [J/kg]

    Returns
    -------
    float
        Efficiency. [-]
    """
    return w_t / q_add


@formula("thermal_efficiency", "cengel_boles_2015, ch. 9")
def otto_efficiency(r_c: Value, kappa: Value) -> Value:
    """Efficiency of the Otto cycle in closed form.

    Parameters
    ----------
    r_c, kappa : float
        Compression ratio, ratio of specific heats. [-]

    Returns
    -------
    float
        Efficiency. [-]
    """
    return 1 - 1 / r_c ** (kappa - 1)


@formula("thermal_efficiency", "cengel_boles_2015, ch. 9")
def dual_efficiency(r_c: Value, kappa: Value, lam_p: Value, rho_cut: Value) -> Value:
    """Efficiency of the dual cycle in closed form; of the Diesel cycle with a pressure ratio of 1.

    Parameters
    ----------
    r_c, kappa, lam_p, rho_cut : float
        Compression ratio, ratio of specific heats, pressure ratio, cut-off ratio. [-]

    Returns
    -------
    float
        Efficiency. [-]
    """
    return 1 - (lam_p * rho_cut**kappa - 1) / (r_c ** (kappa - 1) * (lam_p - 1 + kappa * lam_p * (rho_cut - 1)))


@formula("ideal_mean_pressure", "cengel_boles_2015, ch. 9")
def ideal_mean_pressure(w_t: Value, p_st1: Value, r_c: Value, R_gas: Value, T_st1: Value) -> Value:
    """Work over the change of volume.

    Parameters
    ----------
    w_t, p_st1, r_c, R_gas, T_st1 : float
        Work, pressure at 1, compression ratio, gas constant, temperature at 1.
        [J/kg], [Pa], [-], [J/(kg K)], [K]

    Returns
    -------
    float
        Pressure. [Pa]
    """
    return w_t * p_st1 * r_c / (R_gas * T_st1 * (r_c - 1))
