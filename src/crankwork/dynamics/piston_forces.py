"""Forces from the piston to the crankshaft.

Positive: along the axis towards the crankshaft; on the cylinder wall opposite to the crankpin at 90 degrees;
along the crank arm towards the crankshaft; across it with the rotation.
"""

from __future__ import annotations

from typing import NamedTuple

from crankwork.formula.expression import Value, formula
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.slider_crank import RodSwing


@formula("piston_velocity", "kolchin_demidov_2008, ch. 6")
def piston_velocity(x_1: Value, w: Value) -> Value:
    """Piston velocity."""
    return x_1 * w


@formula("piston_acceleration", "artobolevsky_1988, ch. 5")
def piston_acceleration(x_2: Value, w: Value, x_1: Value, eps: Value) -> Value:
    """Piston acceleration, positive towards the crankshaft."""
    return x_2 * w**2 + x_1 * eps


@formula("speed", "kolchin_demidov_2008, ch. 6")
def angular_speed(pi: Value, n: Value) -> Value:
    """Angular speed from revolutions per minute."""
    return pi * n / 30


@formula("inertia_force", "kolchin_demidov_2008, ch. 7")
def inertia_force(m_rec: Value, a: Value) -> Value:
    """Inertia force of the reciprocating mass."""
    return -m_rec * a


@formula("weight_force", "khurmi_gupta_2005, ch. 15")
def weight_force(m_rec: Value, g: Value, cos_theta: Value) -> Value:
    """Weight of the reciprocating mass along the cylinder axis."""
    return m_rec * g * cos_theta


@formula("transverse_weight", "khurmi_gupta_2005, ch. 15")
def transverse_weight(m_rec: Value, g: Value, sin_theta: Value) -> Value:
    """Weight of the reciprocating mass across the cylinder axis."""
    return m_rec * g * sin_theta


@formula("piston_force", "kolchin_demidov_2008, ch. 7")
def piston_force(F_g: Value, F_j: Value, F_w: Value) -> Value:
    """Force on the piston pin along the cylinder axis, positive towards the crankshaft."""
    return F_g + F_j + F_w


@formula("side_force", "kolchin_demidov_2008, ch. 7")
def side_force(P: Value, sin_beta: Value, cos_beta: Value, dN: Value, F_wn: Value) -> Value:
    """Force of the piston on the cylinder wall, positive on the side opposite to the crankpin at 90 degrees."""
    return P * sin_beta / cos_beta + dN - F_wn


@formula("rod_force", "kolchin_demidov_2008, ch. 7")
def rod_force(P: Value, cos_beta: Value, dN: Value, sin_beta: Value) -> Value:
    """Force along the rod, positive in compression."""
    return P / cos_beta + dN * sin_beta


@formula("radial_force", "kolchin_demidov_2008, ch. 7")
def radial_force(P: Value, cos_phi_beta: Value, cos_beta: Value, dN: Value, sin_phi: Value) -> Value:
    """Force on the crankpin along the crank arm, positive towards the crankshaft."""
    return P * cos_phi_beta / cos_beta - dN * sin_phi


@formula("tangential_force", "kolchin_demidov_2008, ch. 7")
def tangential_force(P: Value, sin_phi_beta: Value, cos_beta: Value, dN: Value, cos_phi: Value) -> Value:
    """Force on the crankpin across the crank arm, positive with the rotation."""
    return P * sin_phi_beta / cos_beta + dN * cos_phi


@formula("crank_torque", "kolchin_demidov_2008, ch. 7")
def crank_torque(T: Value, r: Value, M_w: Value) -> Value:
    """Torque of one cylinder on the crankshaft, with that of its rotating mass, positive with the rotation."""
    return T * r + M_w


@formula("rotating_inertia_force", "kolchin_demidov_2008, ch. 7")
def rotating_inertia_force(m_rot: Value, r: Value, w: Value) -> Value:
    """Inertia force of the rotating mass."""
    return -m_rot * r * w**2


@formula("rotating_torque", "artobolevsky_1988, ch. 15")
def rotating_torque(  # noqa: PLR0913 - one argument per symbol
    m_rot: Value, r: Value, g: Value, sin_phi: Value, cos_theta: Value, cos_phi: Value, sin_theta: Value, eps: Value
) -> Value:
    """Torque of the weight of the rotating mass, less what its angular acceleration takes."""
    return m_rot * r * (g * (sin_phi * cos_theta + cos_phi * sin_theta) - r * eps)


@formula("overturning_moment", "kolchin_demidov_2008, ch. 7")
def overturning_moment(N: Value, h: Value, P: Value, e: Value) -> Value:
    """Moment of the piston's forces on the frame about the crankshaft."""
    return -(N * h + P * e)


@formula("correction_couple", "khurmi_gupta_2005, ch. 15")
def correction_couple(dJ: Value, eps_r: Value) -> Value:
    """Couple by which the two-mass rod differs from the rigid rod."""
    return -dJ * eps_r


@formula("side_force", "khurmi_gupta_2005, ch. 15")
def side_force_of_couple(M_c: Value, l: Value, cos_beta: Value) -> Value:  # noqa: E741
    """Side force that holds the correction couple."""
    return M_c / (l * cos_beta)


@formula("rod_transverse_force", "khurmi_gupta_2005, ch. 15")
def rod_transverse_force(M_c: Value, l: Value) -> Value:  # noqa: E741
    """Force across the rod that holds the correction couple."""
    return M_c / l


class RodForces(NamedTuple):
    """Forces that the rod passes from piston pin to crankpin, arrays of shape (n,). [N]"""

    side: Value
    along: Value
    radial: Value
    tangential: Value


def rod_forces(P: Value, grid: CrankGrid, swing: RodSwing, *, dN: Value = 0.0, F_wn: Value = 0.0) -> RodForces:
    """Return the forces of a rod of two masses, with the effect of the correction couple of a rigid rod. [N]

    `P`: force on the piston pin along the cylinder axis [N]; `F_wn`: weight across the axis, which the wall carries
    directly [N]. Source: kolchin_demidov_2008, ch. 7; khurmi_gupta_2005, ch. 15, for the couple.
    """
    return RodForces(
        side_force(P, swing.sin, swing.cos, dN, F_wn),
        rod_force(P, swing.cos, dN, swing.sin),
        radial_force(P, swing.cos_sum, swing.cos, dN, grid.sin),
        tangential_force(P, swing.sin_sum, swing.cos, dN, grid.cos),
    )
