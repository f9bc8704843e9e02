"""Forces from the piston to the crankshaft.

Positive: along the axis towards the crankshaft; on the cylinder wall opposite to the crankpin at 90 degrees;
along the crank arm towards the crankshaft; across it with the rotation.
"""

from __future__ import annotations

from typing import NamedTuple

from crankwork.expressions import Value, formula
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.slider_crank import RodSwing


@formula("piston_velocity", "kolchin_demidov_2008, ch. 6")
def piston_velocity(x_1: Value, w: Value) -> Value:
    """Piston velocity.

    Parameters
    ----------
    x_1, w : array
        dx/dphi, angular speed. [m], [rad/s]

    Returns
    -------
    array
        Velocity, positive towards the crankshaft. [m/s]
    """
    return x_1 * w


@formula("piston_acceleration", "kolchin_demidov_2008, ch. 6")
def piston_acceleration(x_2: Value, w: Value) -> Value:
    """Piston acceleration at constant speed.

    Parameters
    ----------
    x_2, w : array
        d2x/dphi2, angular speed. [m], [rad/s]

    Returns
    -------
    array
        Acceleration, positive towards the crankshaft. [m/s2]
    """
    return x_2 * w**2


@formula("piston_acceleration", "artobolevsky_1988, ch. 5")
def piston_acceleration_unsteady(x_2: Value, w: Value, x_1: Value, eps: Value) -> Value:
    """Piston acceleration when the crank speed changes.

    Parameters
    ----------
    x_2, w, x_1, eps : array
        d2x/dphi2, angular speed, dx/dphi, angular acceleration. [m], [rad/s], [m], [rad/s2]

    Returns
    -------
    array
        Acceleration, positive towards the crankshaft. [m/s2]
    """
    return x_2 * w**2 + x_1 * eps


@formula("speed", "kolchin_demidov_2008, ch. 6")
def angular_speed(pi: Value, n: Value) -> Value:
    """Angular speed from revolutions per minute.

    Parameters
    ----------
    pi, n : float
        The constant the calculation uses, revolutions per minute. [-], [rpm]

    Returns
    -------
    float
        Angular speed. [rad/s]
    """
    return pi * n / 30


@formula("inertia_force", "kolchin_demidov_2008, ch. 7")
def inertia_force(m_rec: Value, a: Value) -> Value:
    """Inertia force of the reciprocating mass.

    Parameters
    ----------
    m_rec, a : array
        Reciprocating mass, piston acceleration. [kg], [m/s2]

    Returns
    -------
    array
        Force, positive towards the crankshaft. [N]
    """
    return -m_rec * a


@formula("weight_force", "khurmi_gupta_2005, ch. 15")
def weight_force(m_rec: Value, g: Value, cos_theta: Value) -> Value:
    """Weight of the reciprocating mass along the cylinder axis.

    Parameters
    ----------
    m_rec, g, cos_theta : float
        Reciprocating mass, gravity, cosine of the inclination of the axis. [kg], [m/s2], [-]

    Returns
    -------
    float
        Force, positive towards the crankshaft. [N]
    """
    return m_rec * g * cos_theta


@formula("transverse_weight", "khurmi_gupta_2005, ch. 15")
def transverse_weight(m_rec: Value, g: Value, sin_theta: Value) -> Value:
    """Weight of the reciprocating mass across the cylinder axis.

    Parameters
    ----------
    m_rec, g, sin_theta : float
        Reciprocating mass, gravity, sine of the inclination of the axis. [kg], [m/s2], [-]

    Returns
    -------
    float
        Force, positive towards the crankpin side at 90 degrees. [N]
    """
    return m_rec * g * sin_theta


@formula("piston_force", "kolchin_demidov_2008, ch. 7")
def piston_force(F_g: Value, F_j: Value) -> Value:
    """Force on the piston pin along the cylinder axis.

    Parameters
    ----------
    F_g, F_j : array
        Gas force, inertia force. [N], [N]

    Returns
    -------
    array
        Force, positive towards the crankshaft. [N]
    """
    return F_g + F_j


@formula("piston_force", "khurmi_gupta_2005, ch. 15")
def piston_force_with_weight(F_g: Value, F_j: Value, F_w: Value) -> Value:
    """Force on the piston pin along the cylinder axis, weight included.

    Parameters
    ----------
    F_g, F_j, F_w : array
        Gas force, inertia force, weight along the axis. [N], [N], [N]

    Returns
    -------
    array
        Force, positive towards the crankshaft. [N]
    """
    return F_g + F_j + F_w


@formula("side_force", "kolchin_demidov_2008, ch. 7")
def side_force(P: Value, sin_beta: Value, cos_beta: Value) -> Value:
    """Force of the piston on the cylinder wall, P tan beta.

    Parameters
    ----------
    P, sin_beta, cos_beta : array
        Force on the piston pin, functions of the rod angle. [N], [-], [-]

    Returns
    -------
    array
        Force, positive on the side opposite to the crankpin at 90 degrees. [N]
    """
    return P * sin_beta / cos_beta


@formula("rod_force", "kolchin_demidov_2008, ch. 7")
def rod_force(P: Value, cos_beta: Value) -> Value:
    """Force along the rod.

    Parameters
    ----------
    P, cos_beta : array
        Force on the piston pin, cosine of the rod angle. [N], [-]

    Returns
    -------
    array
        Force, positive in compression. [N]
    """
    return P / cos_beta


@formula("radial_force", "kolchin_demidov_2008, ch. 7")
def radial_force(P: Value, cos_phi_beta: Value, cos_beta: Value) -> Value:
    """Force on the crankpin along the crank arm.

    Parameters
    ----------
    P, cos_phi_beta, cos_beta : array
        Force on the piston pin, cos(phi + beta), cos beta. [N], [-], [-]

    Returns
    -------
    array
        Force, positive towards the crankshaft. [N]
    """
    return P * cos_phi_beta / cos_beta


@formula("tangential_force", "kolchin_demidov_2008, ch. 7")
def tangential_force(P: Value, sin_phi_beta: Value, cos_beta: Value) -> Value:
    """Force on the crankpin across the crank arm.

    Parameters
    ----------
    P, sin_phi_beta, cos_beta : array
        Force on the piston pin, sin(phi + beta), cos beta. [N], [-], [-]

    Returns
    -------
    array
        Force, positive with the rotation. [N]
    """
    return P * sin_phi_beta / cos_beta


@formula("crank_torque", "kolchin_demidov_2008, ch. 7")
def crank_torque(T: Value, r: Value) -> Value:
    """Torque of one cylinder on the crankshaft.

    Parameters
    ----------
    T, r : array
        Tangential force, crank radius. [N], [m]

    Returns
    -------
    array
        Torque, positive with the rotation. [N m]
    """
    return T * r


@formula("rotating_inertia_force", "kolchin_demidov_2008, ch. 7")
def rotating_inertia_force(m_rot: Value, r: Value, w: Value) -> Value:
    """Inertia force of the rotating mass.

    Parameters
    ----------
    m_rot, r, w : array
        Rotating mass, crank radius, angular speed. [kg], [m], [rad/s]

    Returns
    -------
    array
        Force along the crank arm, positive towards the crankshaft, so never positive. [N]
    """
    return -m_rot * r * w**2


@formula("rotating_torque", "artobolevsky_1988, ch. 15")
def rotating_torque(  # noqa: PLR0913 - one argument per symbol
    m_rot: Value, r: Value, g: Value, sin_phi: Value, cos_theta: Value, cos_phi: Value, sin_theta: Value, eps: Value
) -> Value:
    """Torque of the weight of the rotating mass, less what its angular acceleration takes.

    Parameters
    ----------
    m_rot, r, g, sin_phi, cos_theta, cos_phi, sin_theta, eps : array
        Rotating mass, crank radius, gravity (zero if left out), functions of the crank angle and of the
        inclination, angular acceleration. [kg], [m], [m/s2], [-], [-], [-], [-], [rad/s2]

    Returns
    -------
    array
        Torque on the crankshaft, positive with the rotation. [N m]
    """
    return m_rot * r * (g * (sin_phi * cos_theta + cos_phi * sin_theta) - r * eps)


@formula("overturning_moment", "kolchin_demidov_2008, ch. 7")
def overturning_moment(N: Value, h: Value, P: Value, e: Value) -> Value:
    """Moment of the piston's forces on the frame about the crankshaft.

    Parameters
    ----------
    N, h, P, e : array
        Side force, distance of the piston pin from the crankshaft along the cylinder axis, force on the
        piston pin, offset. [N], [m], [N], [m]

    Returns
    -------
    array
        Moment, positive with the rotation; minus the torque of tangential force times crank radius. [N m]
    """
    return -(N * h + P * e)


@formula("correction_couple", "khurmi_gupta_2005, ch. 15")
def correction_couple(dJ: Value, eps_r: Value) -> Value:
    """Couple by which the two-mass rod differs from the rigid rod.

    Parameters
    ----------
    dJ, eps_r : array
        Inertia excess of the rod, its angular acceleration. [kg m2], [rad/s2]

    Returns
    -------
    array
        Couple on the rod, positive as the rod angle. [N m]
    """
    return -dJ * eps_r


@formula("side_force", "artobolevsky_1988, ch. 13")
def side_force_less_weight(N: Value, F_wn: Value) -> Value:
    """Side force of a leaning cylinder, whose wall also carries weight.

    Parameters
    ----------
    N, F_wn : array
        Side force of the rod, weight across the axis. [N], [N]

    Returns
    -------
    array
        Force of the piston on the wall, positive on the side opposite to the crankpin at 90 degrees. [N]
    """
    return N - F_wn


@formula("side_force", "khurmi_gupta_2005, ch. 15")
def side_force_of_couple(M_c: Value, l: Value, cos_beta: Value) -> Value:  # noqa: E741
    """Side force that holds the correction couple.

    Parameters
    ----------
    M_c, l, cos_beta : array
        Correction couple, rod length, cosine of the rod angle. [N m], [m], [-]

    Returns
    -------
    array
        Addition to the side force. [N]
    """
    return M_c / (l * cos_beta)


@formula("rod_transverse_force", "khurmi_gupta_2005, ch. 15")
def rod_transverse_force(M_c: Value, l: Value) -> Value:  # noqa: E741
    """Force across the rod that holds the correction couple.

    Parameters
    ----------
    M_c, l : array
        Correction couple, rod length. [N m], [m]

    Returns
    -------
    array
        Force on the rod at the piston pin, across the rod towards the crankpin side at 90 degrees. [N]
    """
    return M_c / l


class RodForces(NamedTuple):
    """Forces that the rod passes from piston pin to crankpin, arrays of shape (n,). [N]"""

    side: Array
    along: Array
    radial: Array
    tangential: Array


def rod_forces(P: Array, swing: RodSwing) -> RodForces:
    """Return the forces of a rod without correction couple.

    Parameters
    ----------
    P : array, shape (n,)
        Force on the piston pin along the cylinder axis. [N]
    swing : RodSwing
        Functions of the rod angle. [-]

    Returns
    -------
    RodForces of array, shape (n,)
        Side, along the rod, radial, tangential. [N]

    References
    ----------
    kolchin_demidov_2008, ch. 7.
    """
    return RodForces(
        side_force(P, swing.sin, swing.cos),
        rod_force(P, swing.cos),
        radial_force(P, swing.cos_sum, swing.cos),
        tangential_force(P, swing.sin_sum, swing.cos),
    )


def add_couple(forces: RodForces, couple: Array, rod_length: float, grid: CrankGrid, swing: RodSwing) -> RodForces:
    """Return the forces of the rod with the correction couple, which makes them those of the rigid rod.

    Parameters
    ----------
    forces : RodForces of array, shape (n,)
        Forces without the couple. [N]
    couple : array, shape (n,)
        Correction couple. [N m]
    rod_length : float
        Distance between the pins. [m]
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]
    swing : RodSwing
        Functions of the rod angle. [-]

    Returns
    -------
    RodForces of array, shape (n,)
        Side, along the rod, radial, tangential. [N]

    References
    ----------
    khurmi_gupta_2005, ch. 15; components of the side force at the crankpin.
    """
    side = side_force_of_couple(couple, rod_length, swing.cos)
    return RodForces(
        forces.side + side,
        forces.along + side * swing.sin,
        forces.radial - side * grid.sin,
        forces.tangential + side * grid.cos,
    )
