"""What a cycle gives: mean pressures, efficiencies, fuel."""

from __future__ import annotations

import numpy as np

from crankwork.expressions import Value, formula

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
def isochoric_mean_pressure(p_c: Value, r_c: Value, lam_p: Value, n_2: Value, n_1: Value) -> Value:
    """Mean pressure of the theoretical diagram with burning at constant volume.

    Parameters
    ----------
    p_c, r_c, lam_p, n_2, n_1 : float
        Pressure at c, compression ratio, pressure ratio, exponents of expansion and compression.
        [Pa], [-], [-], [-], [-]

    Returns
    -------
    float
        Pressure. [Pa]
    """
    return (
        p_c
        / (r_c - 1)
        * (lam_p / (n_2 - 1) * (1 - np.power(r_c, 1 - n_2)) - 1 / (n_1 - 1) * (1 - np.power(r_c, 1 - n_1)))
    )


@formula("theoretical_mean_pressure", "kolchin_demidov_2008, ch. 3")
def dual_mean_pressure(  # noqa: PLR0913 - one argument per symbol
    p_c: Value, r_c: Value, lam_p: Value, rho_cut: Value, n_2: Value, delta_post: Value, n_1: Value
) -> Value:
    """Mean pressure of the theoretical diagram with burning at constant volume, then pressure.

    Parameters
    ----------
    p_c, r_c, lam_p, rho_cut, n_2, delta_post, n_1 : float
        Pressure at c, compression ratio, pressure ratio, cut-off ratio, exponent of expansion, expansion ratio,
        exponent of compression. [Pa], [-], [-], [-], [-], [-], [-]

    Returns
    -------
    float
        Pressure. [Pa]
    """
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
def filled_mean_pressure(phi_fill: Value, p_it: Value) -> Value:
    """Mean pressure of the rounded diagram.

    Parameters
    ----------
    phi_fill, p_it : float
        Roundness factor, mean pressure of the theoretical diagram. [-], [Pa]

    Returns
    -------
    float
        Pressure. [Pa]
    """
    return phi_fill * p_it


@formula("indicated_mean_pressure", "kolchin_demidov_2008, ch. 3")
def ported_mean_pressure(phi_fill: Value, p_it: Value, psi_lost: Value) -> Value:
    """Mean pressure of the rounded diagram of a two-stroke engine, over the whole stroke.

    Parameters
    ----------
    phi_fill, p_it, psi_lost : float
        Roundness factor, mean pressure of the theoretical diagram, share of the stroke lost to the ports.
        [-], [Pa], [-]

    Returns
    -------
    float
        Pressure. [Pa]
    """
    return phi_fill * p_it * (1 - psi_lost)


@formula("volumetric_efficiency", "kolchin_demidov_2008, ch. 3")
def ported_volumetric_efficiency(eta_v: Value, psi_lost: Value) -> Value:
    """Volumetric efficiency of a two-stroke engine, over the whole stroke.

    Parameters
    ----------
    eta_v, psi_lost : float
        Volumetric efficiency with shut ports, share of the stroke lost to them. [-]

    Returns
    -------
    float
        Charge over that of the swept volume. [-]
    """
    return eta_v * (1 - psi_lost)


@formula("indicated_efficiency", "kolchin_demidov_2008, ch. 3")
def indicated_efficiency(
    p_ind: Value, l_air: Value, alpha_air: Value, H_fuel: Value, rho_k: Value, eta_v: Value
) -> Value:
    """Indicated work over the heat of the fuel.

    Parameters
    ----------
    p_ind, l_air, alpha_air, H_fuel, rho_k, eta_v : float
        Indicated mean pressure, air needed by mass, excess air, heating value, density before the intake,
        volumetric efficiency. [Pa], [-], [-], [J/kg], [kg/m3], [-]

    Returns
    -------
    float
        Efficiency. [-]
    """
    return p_ind * l_air * alpha_air / (H_fuel * rho_k * eta_v)


@formula("indicated_fuel_consumption", "kolchin_demidov_2008, ch. 3")
def indicated_fuel_consumption(H_fuel: Value, eta_ind: Value) -> Value:
    """Fuel per indicated work.

    Parameters
    ----------
    H_fuel, eta_ind : float
        Heating value, indicated efficiency. [J/kg], [-]

    Returns
    -------
    float
        Fuel. [kg/J]
    """
    return 1 / (H_fuel * eta_ind)


@formula("mechanical_loss_pressure", "kolchin_demidov_2008, ch. 3")
def mechanical_loss_pressure(a_loss: Value, b_loss: Value, S_pm: Value) -> Value:
    """Mean pressure of mechanical losses.

    Parameters
    ----------
    a_loss, b_loss, S_pm : float
        Coefficients of the kind of engine, mean piston speed. [Pa], [Pa s/m], [m/s]

    Returns
    -------
    float
        Pressure. [Pa]
    """
    return a_loss + b_loss * S_pm


@formula("effective_mean_pressure", "kolchin_demidov_2008, ch. 3")
def effective_mean_pressure(p_ind: Value, p_loss: Value) -> Value:
    """Effective mean pressure.

    Parameters
    ----------
    p_ind, p_loss : float
        Indicated mean pressure, that of mechanical losses. [Pa]

    Returns
    -------
    float
        Pressure. [Pa]
    """
    return p_ind - p_loss


@formula("mechanical_efficiency", "kolchin_demidov_2008, ch. 3")
def mechanical_efficiency(p_e: Value, p_ind: Value) -> Value:
    """Effective over indicated work.

    Parameters
    ----------
    p_e, p_ind : float
        Effective and indicated mean pressure. [Pa]

    Returns
    -------
    float
        Efficiency. [-]
    """
    return p_e / p_ind


@formula("effective_efficiency", "kolchin_demidov_2008, ch. 3")
def effective_efficiency(eta_ind: Value, eta_m: Value) -> Value:
    """Effective work over the heat of the fuel.

    Parameters
    ----------
    eta_ind, eta_m : float
        Indicated and mechanical efficiency. [-]

    Returns
    -------
    float
        Efficiency. [-]
    """
    return eta_ind * eta_m


@formula("effective_fuel_consumption", "kolchin_demidov_2008, ch. 3")
def effective_fuel_consumption(H_fuel: Value, eta_e: Value) -> Value:
    """Fuel per effective work.

    Parameters
    ----------
    H_fuel, eta_e : float
        Heating value, effective efficiency. [J/kg], [-]

    Returns
    -------
    float
        Fuel. [kg/J]
    """
    return 1 / (H_fuel * eta_e)
