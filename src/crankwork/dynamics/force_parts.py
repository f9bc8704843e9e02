"""Parts of sums of forces and torques: what the correction couple adds, torques on the crank, differences."""

from __future__ import annotations

from crankwork.expressions import Value, formula


@formula("rod_force", "khurmi_gupta_2005, ch. 15")
def rod_force_of_couple(dN: Value, sin_beta: Value) -> Value:
    """Addition to the force along the rod from the side force that holds the correction couple.

    Parameters
    ----------
    dN, sin_beta : array
        Side force of the couple, sine of the rod angle. [N], [-]

    Returns
    -------
    array
        Force. [N]
    """
    return dN * sin_beta


@formula("radial_force", "khurmi_gupta_2005, ch. 15")
def radial_force_of_couple(dN: Value, sin_phi: Value) -> Value:
    """Addition to the radial force from the side force that holds the correction couple.

    Parameters
    ----------
    dN, sin_phi : array
        Side force of the couple, sine of the crank angle. [N], [-]

    Returns
    -------
    array
        Force, positive towards the crankshaft. [N]
    """
    return -(dN * sin_phi)


@formula("tangential_force", "khurmi_gupta_2005, ch. 15")
def tangential_force_of_couple(dN: Value, cos_phi: Value) -> Value:
    """Addition to the tangential force from the side force that holds the correction couple.

    Parameters
    ----------
    dN, cos_phi : array
        Side force of the couple, cosine of the crank angle. [N], [-]

    Returns
    -------
    array
        Force, positive with the rotation. [N]
    """
    return dN * cos_phi


@formula("overturning_moment", "kolchin_demidov_2008, ch. 7")
def overturning_moment_central(N: Value, h: Value) -> Value:
    """Moment of the side force on the frame of a central slider-crank about the crankshaft.

    Parameters
    ----------
    N, h : array
        Side force, distance of the piston pin from the crankshaft along the cylinder axis. [N], [m]

    Returns
    -------
    array
        Moment, positive with the rotation. [N m]
    """
    return -(N * h)


@formula("balancing_torque", "artobolevsky_1988, ch. 16")
def balancing_torque_of_parts(M_st: Value, M_dyn: Value) -> Value:
    """Torque on the crank that balances the loads and moves the masses.

    Parameters
    ----------
    M_st, M_dyn : array
        Static and dynamic torque. [N m]

    Returns
    -------
    array
        Torque, positive with the rotation. [N m]
    """
    return M_st + M_dyn


@formula("static_torque", "artobolevsky_1988, ch. 16")
def static_torque_of_balancing(M_b: Value, M_dyn: Value) -> Value:
    """Static torque that a known balancing torque leaves.

    Parameters
    ----------
    M_b, M_dyn : array
        Balancing and dynamic torque. [N m]

    Returns
    -------
    array
        Torque, positive with the rotation. [N m]
    """
    return M_b - M_dyn


@formula("reduced_inertia_1", "artobolevsky_1988, ch. 16")
def forward_difference(J_next: Value, J: Value, dphi: Value) -> Value:
    """Derivative of the reduced inertia by the difference to the next position.

    Parameters
    ----------
    J_next, J, dphi : array
        Reduced inertia at the next position and here, angle between them. [kg m2], [kg m2], [rad]

    Returns
    -------
    array
        Derivative. [kg m2]
    """
    return (J_next - J) / dphi


@formula("reduced_inertia_1", "artobolevsky_1988, ch. 16")
def central_difference(J_next: Value, J_prev: Value, dphi: Value) -> Value:
    """Derivative of the reduced inertia by the difference of the positions on both sides.

    Parameters
    ----------
    J_next, J_prev, dphi : array
        Reduced inertia at the next and the last position, angle between those. [kg m2], [kg m2], [rad]

    Returns
    -------
    array
        Derivative. [kg m2]
    """
    return (J_next - J_prev) / dphi


@formula("efficiency", "artobolevsky_1988, ch. 14")
def efficiency_share(k_i: Value, eta_i: Value) -> Value:
    """Part of one of several parallel chains in their efficiency.

    Parameters
    ----------
    k_i, eta_i : float
        Share of the power through the chain, efficiency of the chain. [-]

    Returns
    -------
    float
        Part. [-]
    """
    return k_i * eta_i
