"""Parts of the reduced inertia of bodies that have only mass or only a moment of inertia, as notes write them."""

from __future__ import annotations

from crankwork.expressions import Value, formula


@formula("reduced_inertia", "artobolevsky_1988, ch. 15")
def reduced_inertia_of_mass(m_i: Value, x_S1: Value, y_S1: Value) -> Value:
    """Part of one mass in the reduced moment of inertia.

    Parameters
    ----------
    m_i, x_S1, y_S1 : array
        Mass, first transfer functions of its centre. [kg], [m], [m]

    Returns
    -------
    array
        Moment of inertia. [kg m2]
    """
    return m_i * (x_S1**2 + y_S1**2)


@formula("reduced_inertia", "artobolevsky_1988, ch. 15")
def reduced_inertia_of_turning(J_S: Value, theta_1: Value) -> Value:
    """Part of the turning of one body in the reduced moment of inertia.

    Parameters
    ----------
    J_S, theta_1 : array
        Moment of inertia, first transfer function of its rotation. [kg m2], [-]

    Returns
    -------
    array
        Moment of inertia. [kg m2]
    """
    return J_S * theta_1**2


@formula("reduced_inertia_1", "artobolevsky_1988, ch. 15")
def reduced_inertia_1_of_mass(m_i: Value, x_S1: Value, x_S2: Value, y_S1: Value, y_S2: Value) -> Value:
    """Part of one mass in the derivative of the reduced moment of inertia by the crank angle.

    Parameters
    ----------
    m_i, x_S1, x_S2, y_S1, y_S2 : array
        Mass, transfer functions of its centre. [kg], [m], [m], [m], [m]

    Returns
    -------
    array
        Derivative. [kg m2]
    """
    return 2 * (m_i * (x_S1 * x_S2 + y_S1 * y_S2))


@formula("reduced_inertia_1", "artobolevsky_1988, ch. 15")
def reduced_inertia_1_of_turning(J_S: Value, theta_1: Value, theta_2: Value) -> Value:
    """Part of the turning of one body in the derivative of the reduced moment of inertia by the crank angle.

    Parameters
    ----------
    J_S, theta_1, theta_2 : array
        Moment of inertia, transfer functions of its rotation. [kg m2], [-], [-]

    Returns
    -------
    array
        Derivative. [kg m2]
    """
    return 2 * (J_S * theta_1 * theta_2)


@formula("reduced_inertia", "artobolevsky_1988, ch. 15")
def reduced_inertia_of_velocity_ratio(m_i: Value, v_w: Value) -> Value:
    """Part of one mass in the reduced moment of inertia, from its speed over that of the crank.

    Parameters
    ----------
    m_i, v_w : array
        Mass, speed ratio of its centre. [kg], [m]

    Returns
    -------
    array
        Moment of inertia. [kg m2]
    """
    return m_i * v_w**2


@formula("reduced_inertia", "artobolevsky_1988, ch. 15")
def reduced_inertia_of_rotation_ratio(J_S: Value, w_w: Value) -> Value:
    """Part of the turning of one body in the reduced moment of inertia, from its speed over that of the crank.

    Parameters
    ----------
    J_S, w_w : array
        Moment of inertia, ratio of its angular speed. [kg m2], [-]

    Returns
    -------
    array
        Moment of inertia. [kg m2]
    """
    return J_S * w_w**2
