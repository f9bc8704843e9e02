"""Formulas of torsional vibration: stiffness of shafts and throws, reduction to one speed, stress, dampers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np

from crankwork.formula.expression import Value, formula


@formula("disc_inertia", "khurmi_gupta_2005, ch. 24")
def inertia_of_disc(m_D: Value, i_D: Value) -> Value:
    """Moment of inertia of a disc of known mass and radius of gyration."""
    return m_D * i_D**2


@formula("polar_moment", "khurmi_gupta_2005, ch. 24")
def polar_moment(pi: Value, d_sh: Value, d_bo: Value) -> Value:
    """Polar second moment of area of a round section."""
    return pi * (d_sh**4 - d_bo**4) / 32


@formula("equivalent_length", "khurmi_gupta_2005, ch. 24")
def equivalent_length(l_sh: Value, I_eq: Value, I_p: Value) -> Value:
    """Length of the reference shaft that twists as much as a part of a shaft."""
    return l_sh * I_eq / I_p


@formula("torsional_stiffness", "khurmi_gupta_2005, ch. 24")
def stiffness_of_length(G_sh: Value, I_eq: Value, l_eq: Value) -> Value:
    """Stiffness of a shaft of known equivalent length."""
    return G_sh * I_eq / l_eq


@formula("shaft_inertia", "friswell_2010, ch. 9")
def inertia_of_shaft(rho_sh: Value, I_p: Value, l_sh: Value) -> Value:
    """Moment of inertia of a part of a shaft about its axis."""
    return rho_sh * I_p * l_sh


@formula("equivalent_inertia", "khurmi_gupta_2005, ch. 24")
def inertia_at_first_speed(J_D: Value, u_D: Value) -> Value:
    """Moment of inertia reduced to the speed of the first disc."""
    return J_D * u_D**2


@formula("equivalent_length", "khurmi_gupta_2005, ch. 24")
def length_at_first_speed(l_eq: Value, u_D: Value) -> Value:
    """Equivalent length of a shaft reduced to the speed of the first disc."""
    return l_eq / u_D**2


@formula("equivalent_length", "ker_wilson_1956, vol. 1, ch. 3")
def throw_by_ker_wilson(  # noqa: PLR0913 - the sizes of a throw
    L_j: Value, D_j: Value, b_j: Value, L_p: Value, D_p: Value, b_p: Value, r: Value, h_w: Value, b_w: Value
) -> Value:
    """Length of a solid shaft of the diameter of the journal that twists as much as a throw, by Ker Wilson."""
    return D_j**4 * (
        (L_j + 0.4 * D_j) / (D_j**4 - b_j**4)
        + (L_p + 0.4 * D_p) / (D_p**4 - b_p**4)
        + (r - 0.2 * (D_j + D_p)) / (h_w * b_w**3)
    )


@formula("equivalent_length", "ker_wilson_1956, vol. 1, ch. 3")
def throw_by_carter(  # noqa: PLR0913 - the sizes of a throw
    L_j: Value, D_j: Value, b_j: Value, L_p: Value, D_p: Value, b_p: Value, r: Value, h_w: Value, b_w: Value
) -> Value:
    """Length of a solid shaft of the diameter of the journal that twists as much as a throw, by Carter."""
    return D_j**4 * ((L_j + 0.8 * h_w) / (D_j**4 - b_j**4) + 0.75 * L_p / (D_p**4 - b_p**4) + 1.5 * r / (h_w * b_w**3))


@formula("equivalent_length", "timoshenko_1937, ch. 5")
def throw_by_timoshenko(  # noqa: PLR0913 - the sizes of a throw
    L_j: Value, D_j: Value, b_j: Value, L_p: Value, D_p: Value, b_p: Value, r: Value, h_w: Value, b_w: Value
) -> Value:
    """Length of a solid shaft of the diameter of the journal that twists as much as a throw, by Timoshenko.

    Of a throw whose bearings hold nothing back.
    """
    return D_j**4 * (
        (L_j + 0.9 * h_w) / (D_j**4 - b_j**4) + (L_p + 0.9 * h_w) / (D_p**4 - b_p**4) + 0.93 * r / (h_w * b_w**3)
    )


THROW_FORMULAS: Mapping[str, Callable[..., Value]] = MappingProxyType(
    {"ker-wilson": throw_by_ker_wilson, "carter": throw_by_carter, "timoshenko": throw_by_timoshenko}
)


@formula("vibration_stress", "khurmi_gupta_2005, ch. 24")
def stress_of_torque(M_v: Value, pi: Value, d_sh: Value, d_bo: Value) -> Value:
    """Largest shear stress in a round section."""
    return 16 * M_v * d_sh / (pi * (d_sh**4 - d_bo**4))


@formula("critical_speed", "den_hartog_1956, ch. 5")
def speed_of_order(w_j: Value, nu_w: Value) -> Value:
    """Speed at which an order has the frequency of a mode."""
    return w_j / nu_w


@formula("damper_inertia_ratio", "den_hartog_1956, ch. 5")
def damper_inertia_ratio(J_ring: Value, J_mode: Value) -> Value:
    """Inertia of the ring of a damper over the effective inertia of the mode."""
    return J_ring / J_mode


@formula("optimum_damping_ratio", "den_hartog_1956, ch. 5")
def untuned_damping(mu_J: Value) -> Value:
    """Damping ratio with the lowest peak, of a damper without a spring."""
    return 1 / np.sqrt(2 * (1 + mu_J) * (2 + mu_J))


@formula("least_magnification", "den_hartog_1956, ch. 5")
def untuned_magnification(mu_J: Value) -> Value:
    """Lowest peak with a damper without a spring."""
    return 1 + 2 / mu_J


@formula("optimum_tuning", "den_hartog_1956, ch. 3")
def tuned_frequency_ratio(mu_J: Value) -> Value:
    """Frequency of the ring of a tuned damper over that of the mode, with equal peaks."""
    return 1 / (1 + mu_J)


@formula("optimum_damping_ratio", "den_hartog_1956, ch. 3")
def tuned_damping(mu_J: Value) -> Value:
    """Damping ratio of a tuned damper at which both peaks are nearly level."""
    return np.sqrt(3 * mu_J / (8 * (1 + mu_J) ** 3))


@formula("least_magnification", "den_hartog_1956, ch. 3")
def tuned_magnification(mu_J: Value) -> Value:
    """Height of the equal peaks with a tuned damper."""
    return np.sqrt(1 + 2 / mu_J)


@formula("optimum_damping", "den_hartog_1956, ch. 3")
def damping_of_ring(z_opt: Value, J_ring: Value, w_j: Value) -> Value:
    """Damping coefficient of a ring from its damping ratio."""
    return 2 * z_opt * J_ring * w_j


@formula("optimum_stiffness", "den_hartog_1956, ch. 3")
def stiffness_of_ring(J_ring: Value, f_opt: Value, w_j: Value) -> Value:
    """Stiffness of the spring of a ring from its tuning."""
    return J_ring * (f_opt * w_j) ** 2
