"""Results of a cycle: mean pressures, efficiencies, fuel."""

from __future__ import annotations

import numpy as np

from crankwork.formula.expression import Value, formula

# a [Pa] and b [Pa s/m] of p_m = a + b v_p by kind of engine; kolchin_demidov_2008, ch. 3
MECHANICAL_LOSSES = {
    "petrol_long_stroke": (0.049e6, 0.0152e6),
    "petrol_eight_cylinders": (0.039e6, 0.0132e6),
    "petrol": (0.034e6, 0.0113e6),
    "petrol_injection": (0.024e6, 0.0053e6),
    "diesel": (0.089e6, 0.0118e6),
    "diesel_prechamber": (0.103e6, 0.0153e6),
    "diesel_swirl_chamber": (0.089e6, 0.0135e6),
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
