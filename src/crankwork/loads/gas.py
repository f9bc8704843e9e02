"""Formulas of the working space: areas, volumes, polytropes and the force of the gas."""

from __future__ import annotations

import numpy as np

from crankwork.expressions import Value, formula


@formula("piston_area", "kolchin_demidov_2008, ch. 5")
def piston_area(pi: Value, D: Value) -> Value:
    """Area of a circle of the bore.

    Parameters
    ----------
    pi, D : float
        The constant the calculation uses, bore. [-], [m]

    Returns
    -------
    float
        Area. [m2]
    """
    return pi * D**2 / 4


@formula("swept_volume", "kolchin_demidov_2008, ch. 5")
def swept_volume(A: Value, stroke: Value) -> Value:
    """Swept volume.

    Parameters
    ----------
    A, stroke : float
        Piston area, stroke. [m2], [m]

    Returns
    -------
    float
        Volume. [m3]
    """
    return A * stroke


@formula("clearance_volume", "kolchin_demidov_2008, ch. 5")
def clearance_volume(V_d: Value, r_c: Value) -> Value:
    """Clearance volume that gives a compression ratio.

    Parameters
    ----------
    V_d, r_c : float
        Swept volume, compression ratio. [m3], [-]

    Returns
    -------
    float
        Volume. [m3]
    """
    return V_d / (r_c - 1)


@formula("compression_ratio", "kolchin_demidov_2008, ch. 5")
def compression_ratio(V_d: Value, V_c: Value) -> Value:
    """Compression ratio.

    Parameters
    ----------
    V_d, V_c : float
        Swept volume, clearance volume. [m3], [m3]

    Returns
    -------
    float
        Ratio. [-]
    """
    return (V_d + V_c) / V_c


@formula("cylinder_volume", "kolchin_demidov_2008, ch. 5")
def cylinder_volume(V_c: Value, A: Value, x: Value) -> Value:
    """Volume above the piston.

    Parameters
    ----------
    V_c, A, x : array
        Clearance volume, piston area, displacement from top dead centre. [m3], [m2], [m]

    Returns
    -------
    array
        Volume. [m3]
    """
    return V_c + A * x


@formula("gas_pressure", "kolchin_demidov_2008, ch. 5")
def polytropic_pressure(p_1: Value, V_1: Value, V: Value, n_p: Value) -> Value:
    """Pressure on a polytrope through a known state.

    Parameters
    ----------
    p_1, V_1, V, n_p : array
        Pressure and volume of the known state, volume, exponent. [Pa], [m3], [m3], [-]

    Returns
    -------
    array
        Pressure, in the reference (absolute or gauge) in which `p_1` is given. [Pa]
    """
    return p_1 * np.power(V_1 / V, n_p)


@formula("gas_force", "kolchin_demidov_2008, ch. 7")
def gas_force(p: Value, A: Value) -> Value:
    """Force of the gas on the piston.

    Parameters
    ----------
    p, A : array
        Pressure above that on the crankcase side, piston area. [Pa], [m2]

    Returns
    -------
    array
        Force, positive towards the crankshaft. [N]
    """
    return p * A


@formula("gas_force", "khurmi_gupta_2005, ch. 15")
def gas_force_double_acting(p: Value, A: Value, p_b: Value, A_r: Value) -> Value:
    """Force of the gas on a piston loaded on both sides.

    Parameters
    ----------
    p, A, p_b, A_r : array
        Pressure on the head side, piston area, pressure on the crank side, area of the piston rod.
        [Pa], [m2], [Pa], [m2]

    Returns
    -------
    array
        Force, positive towards the crankshaft. [N]
    """
    return p * A - p_b * (A - A_r)


@formula("indicated_mean_pressure", "kolchin_demidov_2008, ch. 4")
def indicated_mean_pressure(W: Value, V_d: Value) -> Value:
    """Indicated mean effective pressure.

    Parameters
    ----------
    W, V_d : float
        Indicated work per cycle, swept volume. [J], [m3]

    Returns
    -------
    float
        Pressure. [Pa]
    """
    return W / V_d


@formula("mean_torque", "kolchin_demidov_2008, ch. 7")
def mean_torque(W: Value, phi_c: Value) -> Value:
    """Mean crank torque that does the work of a cycle.

    Parameters
    ----------
    W, phi_c : float
        Work per cycle, crank angle of the cycle. [J], [rad]

    Returns
    -------
    float
        Torque. [N m]
    """
    return W / phi_c


@formula("indicated_power", "kolchin_demidov_2008, ch. 4")
def indicated_power(W: Value, w: Value, phi_c: Value) -> Value:
    """Indicated power of one cylinder.

    Parameters
    ----------
    W, w, phi_c : float
        Indicated work per cycle, angular speed, crank angle of the cycle. [J], [rad/s], [rad]

    Returns
    -------
    float
        Power. [W]
    """
    return W * w / phi_c
