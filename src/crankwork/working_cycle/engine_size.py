"""Mean pressures, efficiencies and fuel of a cycle; from them bore, stroke and power, and where the heat goes."""

from __future__ import annotations

from typing import Any

import numpy as np

from crankwork.formula.expression import Value, formula
from crankwork.loads.gas import piston_area


@formula("displacement", "kolchin_demidov_2008, ch. 3")
def displacement_of_power(tau_s: Value, N_e: Value, p_e: Value, n: Value) -> Value:
    """Swept volume of all cylinders that gives a power."""
    return 30 * tau_s * N_e / (p_e * n)


@formula("swept_volume", "kolchin_demidov_2008, ch. 3")
def swept_volume_of_one(V_engine: Value, i_cyl: Value) -> Value:
    """Swept volume of one cylinder."""
    return V_engine / i_cyl


@formula("bore", "kolchin_demidov_2008, ch. 3")
def bore_of_volume(V_d: Value, pi: Value, k_SD: Value) -> Value:
    """Bore of a swept volume."""
    return np.power(4 * V_d / (pi * k_SD), 1 / 3)


@formula("bore", "kolchin_demidov_2008, ch. 3")
def bore_of_stroke(V_d: Value, pi: Value, stroke: Value) -> Value:
    """Bore of a swept volume with a stroke."""
    return np.sqrt(4 * V_d / (pi * stroke))


@formula("stroke", "kolchin_demidov_2008, ch. 3")
def stroke_of_bore(k_SD: Value, D: Value) -> Value:
    """Stroke of a bore."""
    return k_SD * D


def bore_and_stroke(pi: float, volume: Any, ratio: Any, bore: Any, stroke: Any) -> tuple[Any, Any]:  # noqa: ANN401 - numbers give numbers, traced give traced
    """Return bore and stroke from two of the swept volume of a cylinder, stroke over bore, bore, and stroke. [m]"""
    if bore is None and stroke is None:
        bore = bore_of_volume(volume, pi, ratio)
    elif bore is None:
        bore = stroke / ratio if volume is None else bore_of_stroke(volume, pi, stroke)
    if stroke is None:
        stroke = volume / piston_area(pi, bore) if ratio is None else stroke_of_bore(ratio, bore)
    return bore, stroke


@formula("displacement", "kolchin_demidov_2008, ch. 3")
def displacement(V_d: Value, i_cyl: Value) -> Value:
    """Swept volume of all cylinders."""
    return V_d * i_cyl


@formula("effective_power", "kolchin_demidov_2008, ch. 3")
def effective_power(p_e: Value, V_engine: Value, n: Value, tau_s: Value) -> Value:
    """Effective power."""
    return p_e * V_engine * n / (30 * tau_s)


@formula("effective_torque", "kolchin_demidov_2008, ch. 3")
def effective_torque(N_e: Value, pi: Value, n: Value) -> Value:
    """Mean torque at the end of the crankshaft."""
    return 30 * N_e / (pi * n)


@formula("fuel_rate", "kolchin_demidov_2008, ch. 3")
def fuel_rate(N_e: Value, g_e: Value) -> Value:
    """Fuel that the engine burns."""
    return N_e * g_e


@formula("power_per_litre", "kolchin_demidov_2008, ch. 3")
def power_per_litre(N_e: Value, V_engine: Value) -> Value:
    """Effective power over swept volume."""
    return N_e / V_engine


@formula("heat_supplied", "kolchin_demidov_2008, ch. 4")
def heat_supplied(H_fuel: Value, G_f: Value) -> Value:
    """Heat of the fuel."""
    return H_fuel * G_f


@formula(
    "heat_to_coolant",
    "kolchin_demidov_2008, ch. 4",
    constants="the bore in cm, the speed in rpm",
    valid={"c_cool": (0.45, 0.53), "m_cool": (0.6, 0.7)},
)
def heat_to_coolant(  # noqa: PLR0913 - one argument per symbol
    c_cool: Value, i_cyl: Value, D: Value, m_cool: Value, n: Value, dH_u: Value, H_fuel: Value, alpha_air: Value
) -> Value:
    """Heat to the coolant; the 100 makes centimetres of metres."""
    return c_cool * i_cyl * np.power(100 * D, 1 + 2 * m_cool) * np.power(n, m_cool) * (1 - dH_u / H_fuel) / alpha_air


@formula("molar_enthalpy", "kolchin_demidov_2008, ch. 4")
def molar_enthalpy(mc_gas: Value, R_m: Value, th_gas: Value) -> Value:
    """Enthalpy from the zero of the law of heats."""
    return (mc_gas + R_m) * th_gas


@formula("heat_to_exhaust", "kolchin_demidov_2008, ch. 4")
def heat_to_exhaust(G_f: Value, M_prod: Value, h_prod: Value, M_fresh: Value, h_fresh: Value) -> Value:
    """Heat of the exhaust gas; the 1000 makes J of kJ."""
    return 1000 * G_f * (M_prod * h_prod - M_fresh * h_fresh)


@formula("heat_unburnt", "kolchin_demidov_2008, ch. 4")
def heat_unburnt(dH_u: Value, G_f: Value) -> Value:
    """Heat lost to incomplete burning."""
    return dH_u * G_f


@formula("heat_rest", "kolchin_demidov_2008, ch. 4")
def heat_rest(Q_0: Value, N_e: Value, Q_cool: Value, Q_exh: Value, Q_unb: Value) -> Value:
    """Heat that none of the counted parts takes."""
    return Q_0 - (N_e + Q_cool + Q_exh + Q_unb)


@formula("heat_share", "kolchin_demidov_2008, ch. 4")
def heat_share(Q_part: Value, Q_0: Value) -> Value:
    """Share of one part of the heat balance."""
    return Q_part / Q_0


# a [Pa] and b [Pa s/m] of p_m = a + b v_p by kind of engine; kolchin_demidov_2008, ch. 3
MECHANICAL_LOSSES = {
    "petrol": (0.034e6, 0.0113e6),
    "diesel": (0.089e6, 0.0118e6),
}


@formula("theoretical_mean_pressure", "kolchin_demidov_2008, ch. 3")
def theoretical_mean_pressure(  # noqa: PLR0913 - one argument per symbol
    p_c: Value, r_c: Value, lam_p: Value, rho_cut: Value, n_2: Value, delta_post: Value, n_1: Value
) -> Value:
    """Mean pressure of the theoretical diagram."""
    return (
        p_c
        / (r_c - 1)
        * (
            lam_p * (rho_cut - 1)
            + lam_p * rho_cut / (n_2 - 1) * (1 - np.power(delta_post, 1 - n_2))
            - 1 / (n_1 - 1) * (1 - np.power(r_c, 1 - n_1))
        )
    )


@formula("indicated_mean_pressure", "kolchin_demidov_2008, ch. 3")
def filled_mean_pressure(phi_fill: Value, p_it: Value, psi_lost: Value) -> Value:
    """Mean pressure of the rounded diagram over the whole stroke."""
    return phi_fill * p_it * (1 - psi_lost)


@formula("volumetric_efficiency", "kolchin_demidov_2008, ch. 3")
def ported_volumetric_efficiency(eta_v: Value, psi_lost: Value) -> Value:
    """Volumetric efficiency of a two-stroke engine, over the whole stroke."""
    return eta_v * (1 - psi_lost)


@formula("indicated_efficiency", "kolchin_demidov_2008, ch. 3")
def indicated_efficiency(
    p_ind: Value, l_air: Value, alpha_air: Value, H_fuel: Value, rho_k: Value, eta_v: Value
) -> Value:
    """Indicated work over the heat of the fuel."""
    return p_ind * l_air * alpha_air / (H_fuel * rho_k * eta_v)


@formula("mechanical_loss_pressure", "kolchin_demidov_2008, ch. 3")
def mechanical_loss_pressure(a_loss: Value, b_loss: Value, S_pm: Value) -> Value:
    """Mean pressure of mechanical losses."""
    return a_loss + b_loss * S_pm


@formula("effective_mean_pressure", "kolchin_demidov_2008, ch. 3")
def effective_mean_pressure(p_ind: Value, p_loss: Value) -> Value:
    """Effective mean pressure."""
    return p_ind - p_loss


@formula("mechanical_efficiency", "kolchin_demidov_2008, ch. 3")
def mechanical_efficiency(p_e: Value, p_ind: Value) -> Value:
    """Effective over indicated work."""
    return p_e / p_ind


@formula("effective_efficiency", "kolchin_demidov_2008, ch. 3")
def effective_efficiency(eta_ind: Value, eta_m: Value) -> Value:
    """Effective work over the heat of the fuel."""
    return eta_ind * eta_m


@formula("effective_fuel_consumption", "kolchin_demidov_2008, ch. 3")
def fuel_consumption(H_fuel: Value, eta_e: Value) -> Value:
    """Fuel per effective work, or per indicated work with the indicated efficiency."""
    return 1 / (H_fuel * eta_e)
