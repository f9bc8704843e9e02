"""From mean pressure to bore, stroke, power and fuel, and where the heat goes."""

from __future__ import annotations

import numpy as np

from crankwork.expressions import Value, formula


@formula("displacement", "kolchin_demidov_2008, ch. 3")
def displacement_of_power(tau_s: Value, N_e: Value, p_e: Value, n: Value) -> Value:
    """Swept volume of all cylinders that gives a power.

    Parameters
    ----------
    tau_s, N_e, p_e, n : float
        Strokes per cycle, effective power, effective mean pressure, revolutions per minute. [-], [W], [Pa], [rpm]

    Returns
    -------
    float
        Volume. [m3]
    """
    return 30 * tau_s * N_e / (p_e * n)


@formula("swept_volume", "kolchin_demidov_2008, ch. 3")
def swept_volume_of_one(V_engine: Value, i_cyl: Value) -> Value:
    """Swept volume of one cylinder.

    Parameters
    ----------
    V_engine, i_cyl : float
        Swept volume of all, their number. [m3], [-]

    Returns
    -------
    float
        Volume. [m3]
    """
    return V_engine / i_cyl


@formula("bore", "kolchin_demidov_2008, ch. 3")
def bore_of_volume(V_d: Value, pi: Value, k_SD: Value) -> Value:
    """Bore of a swept volume.

    Parameters
    ----------
    V_d, pi, k_SD : float
        Swept volume, the constant the calculation uses, stroke over bore. [m3], [-], [-]

    Returns
    -------
    float
        Bore. [m]
    """
    return np.power(4 * V_d / (pi * k_SD), 1 / 3)


@formula("stroke", "kolchin_demidov_2008, ch. 3")
def stroke_of_bore(k_SD: Value, D: Value) -> Value:
    """Stroke of a bore.

    Parameters
    ----------
    k_SD, D : float
        Stroke over bore, bore. [-], [m]

    Returns
    -------
    float
        Stroke. [m]
    """
    return k_SD * D


@formula("displacement", "kolchin_demidov_2008, ch. 3")
def displacement(V_d: Value, i_cyl: Value) -> Value:
    """Swept volume of all cylinders.

    Parameters
    ----------
    V_d, i_cyl : float
        Swept volume of one, their number. [m3], [-]

    Returns
    -------
    float
        Volume. [m3]
    """
    return V_d * i_cyl


@formula("effective_power", "kolchin_demidov_2008, ch. 3")
def effective_power(p_e: Value, V_engine: Value, n: Value, tau_s: Value) -> Value:
    """Effective power.

    Parameters
    ----------
    p_e, V_engine, n, tau_s : float
        Effective mean pressure, swept volume of all cylinders, revolutions per minute, strokes per cycle.
        [Pa], [m3], [rpm], [-]

    Returns
    -------
    float
        Power. [W]
    """
    return p_e * V_engine * n / (30 * tau_s)


@formula("effective_torque", "kolchin_demidov_2008, ch. 3")
def effective_torque(N_e: Value, pi: Value, n: Value) -> Value:
    """Mean torque at the end of the crankshaft.

    Parameters
    ----------
    N_e, pi, n : float
        Effective power, the constant the calculation uses, revolutions per minute. [W], [-], [rpm]

    Returns
    -------
    float
        Torque. [N m]
    """
    return 30 * N_e / (pi * n)


@formula("fuel_rate", "kolchin_demidov_2008, ch. 3")
def fuel_rate(N_e: Value, g_e: Value) -> Value:
    """Fuel that the engine burns.

    Parameters
    ----------
    N_e, g_e : float
        Effective power, fuel per effective work. [W], [kg/J]

    Returns
    -------
    float
        Mass per time. [kg/s]
    """
    return N_e * g_e


@formula("power_per_litre", "kolchin_demidov_2008, ch. 3")
def power_per_litre(N_e: Value, V_engine: Value) -> Value:
    """Effective power over swept volume.

    Parameters
    ----------
    N_e, V_engine : float
        Effective power, swept volume of all cylinders. [W], [m3]

    Returns
    -------
    float
        Power per volume. [W/m3]
    """
    return N_e / V_engine


@formula("heat_supplied", "kolchin_demidov_2008, ch. 4")
def heat_supplied(H_fuel: Value, G_f: Value) -> Value:
    """Heat of the fuel.

    Parameters
    ----------
    H_fuel, G_f : float
        Heating value, fuel burnt. [J/kg], [kg/s]

    Returns
    -------
    float
        Heat per time. [W]
    """
    return H_fuel * G_f


@formula("heat_to_coolant", "kolchin_demidov_2008, ch. 4")
def petrol_heat_to_coolant(  # noqa: PLR0913 - one argument per symbol
    c_cool: Value, i_cyl: Value, D: Value, m_cool: Value, n: Value, H_fuel: Value, dH_u: Value, alpha_air: Value
) -> Value:
    """Heat to the coolant of a petrol engine; the 100 makes centimetres of metres.

    Parameters
    ----------
    c_cool, i_cyl, D, m_cool, n, H_fuel, dH_u, alpha_air : float
        Factor, number of cylinders, bore, exponent, revolutions per minute, heating value, heat lost to incomplete
        burning, excess air. [-], [-], [m], [-], [rpm], [J/kg], [J/kg], [-]

    Returns
    -------
    float
        Heat per time. [W]
    """
    return (
        c_cool
        * i_cyl
        * np.power(100 * D, 1 + 2 * m_cool)
        * np.power(n, m_cool)
        * (H_fuel - dH_u)
        / (alpha_air * H_fuel)
    )


@formula("heat_to_coolant", "kolchin_demidov_2008, ch. 4")
def diesel_heat_to_coolant(c_cool: Value, i_cyl: Value, D: Value, m_cool: Value, n: Value, alpha_air: Value) -> Value:
    """Heat to the coolant of a diesel engine; the 100 makes centimetres of metres.

    Parameters
    ----------
    c_cool, i_cyl, D, m_cool, n, alpha_air : float
        Factor, number of cylinders, bore, exponent, revolutions per minute, excess air.
        [-], [-], [m], [-], [rpm], [-]

    Returns
    -------
    float
        Heat per time. [W]
    """
    return c_cool * i_cyl * np.power(100 * D, 1 + 2 * m_cool) * np.power(n, m_cool) / alpha_air


@formula("molar_enthalpy", "kolchin_demidov_2008, ch. 4")
def molar_enthalpy(mc_gas: Value, R_m: Value, th_gas: Value) -> Value:
    """Enthalpy from the zero of the law of heats.

    Parameters
    ----------
    mc_gas, R_m, th_gas : float
        Mean molar heat at constant volume, gas constant, temperature from that zero.
        [kJ/(kmol K)], [kJ/(kmol K)], [K]

    Returns
    -------
    float
        Enthalpy. [kJ/kmol]
    """
    return (mc_gas + R_m) * th_gas


@formula("heat_to_exhaust", "kolchin_demidov_2008, ch. 4")
def heat_to_exhaust(G_f: Value, M_prod: Value, h_prod: Value, M_fresh: Value, h_fresh: Value) -> Value:
    """Heat of the exhaust gas; the 1000 makes J of kJ.

    Parameters
    ----------
    G_f, M_prod, h_prod, M_fresh, h_fresh : float
        Fuel burnt, products and their enthalpy, fresh charge and its enthalpy.
        [kg/s], [kmol/kg], [kJ/kmol], [kmol/kg], [kJ/kmol]

    Returns
    -------
    float
        Heat per time. [W]
    """
    return 1000 * G_f * (M_prod * h_prod - M_fresh * h_fresh)


@formula("heat_unburnt", "kolchin_demidov_2008, ch. 4")
def heat_unburnt(dH_u: Value, G_f: Value) -> Value:
    """Heat lost to incomplete burning.

    Parameters
    ----------
    dH_u, G_f : float
        Heat lost per mass of fuel, fuel burnt. [J/kg], [kg/s]

    Returns
    -------
    float
        Heat per time. [W]
    """
    return dH_u * G_f


@formula("heat_rest", "kolchin_demidov_2008, ch. 4")
def heat_rest(Q_0: Value, N_e: Value, Q_cool: Value, Q_exh: Value, Q_unb: Value) -> Value:
    """Heat that none of the counted parts takes.

    Parameters
    ----------
    Q_0, N_e, Q_cool, Q_exh, Q_unb : float
        Heat of the fuel, effective power, heat to the coolant, of the exhaust gas, lost to incomplete burning. [W]

    Returns
    -------
    float
        Heat per time; negative where the counted parts are estimated too large. [W]
    """
    return Q_0 - (N_e + Q_cool + Q_exh + Q_unb)


@formula("heat_share", "kolchin_demidov_2008, ch. 4")
def heat_share(Q_part: Value, Q_0: Value) -> Value:
    """Share of one part of the heat balance.

    Parameters
    ----------
    Q_part, Q_0 : float
        The part, heat of the fuel. [W]

    Returns
    -------
    float
        Share. [-]
    """
    return Q_part / Q_0
