"""Stroke, mean speed, ratios and dead centres of a slider-crank, and the extremes of its motion, as formulas."""

from __future__ import annotations

import numpy as np

from crankwork.expressions import Value, formula


@formula("mean_piston_speed", "kolchin_demidov_2008, ch. 6")
def mean_piston_speed(stroke: Value, n: Value) -> Value:
    """Mean piston speed.

    Parameters
    ----------
    stroke, n : float
        Stroke, revolutions per minute. [m], [rpm]

    Returns
    -------
    float
        Speed. [m/s]
    """
    return stroke * n / 30


@formula("rod_ratio", "kolchin_demidov_2008, ch. 6")
def rod_ratio(r: Value, l: Value) -> Value:  # noqa: E741
    """Crank-to-rod ratio.

    Parameters
    ----------
    r, l : float
        Crank radius, rod length. [m]

    Returns
    -------
    float
        Ratio. [-]
    """
    return r / l


@formula("relative_offset", "kolchin_demidov_2008, ch. 6")
def relative_offset(e: Value, r: Value) -> Value:
    """Cylinder offset over crank radius.

    Parameters
    ----------
    e, r : float
        Offset, crank radius. [m]

    Returns
    -------
    float
        Relative offset. [-]
    """
    return e / r


@formula("stroke", "kolchin_demidov_2008, ch. 6")
def stroke_central(r: Value) -> Value:
    """Stroke of a central slider-crank.

    Parameters
    ----------
    r : float
        Crank radius. [m]

    Returns
    -------
    float
        Stroke. [m]
    """
    return 2 * r


@formula("stroke", "kolchin_demidov_2008, ch. 6")
def stroke_offset(l: Value, r: Value, e: Value) -> Value:  # noqa: E741
    """Stroke of an offset slider-crank.

    Parameters
    ----------
    l, r, e : float
        Rod length, crank radius, offset. [m]

    Returns
    -------
    float
        Stroke. [m]
    """
    return np.sqrt((l + r) ** 2 - e**2) - np.sqrt((l - r) ** 2 - e**2)


@formula("top_dead_centre_angle", "kolchin_demidov_2008, ch. 6")
def top_dead_centre_angle(e: Value, l: Value, r: Value) -> Value:  # noqa: E741
    """Crank angle of top dead centre, rod and crank stretched.

    Parameters
    ----------
    e, l, r : float
        Offset that is not negative, rod length, crank radius. [m]

    Returns
    -------
    float
        Crank angle. [rad]
    """
    return np.arcsin(e / (l + r))


@formula("top_dead_centre_angle", "kolchin_demidov_2008, ch. 6")
def top_dead_centre_angle_before(pi: Value, e: Value, l: Value, r: Value) -> Value:  # noqa: E741
    """Crank angle of top dead centre with a negative offset, where it comes before a whole turn.

    Parameters
    ----------
    pi, e, l, r : float
        The constant, offset, rod length, crank radius. [-], [m], [m], [m]

    Returns
    -------
    float
        Crank angle. [rad]
    """
    return 2 * pi + np.arcsin(e / (l + r))


@formula("bottom_dead_centre_angle", "kolchin_demidov_2008, ch. 6")
def bottom_dead_centre_angle(pi: Value, e: Value, l: Value, r: Value) -> Value:  # noqa: E741
    """Crank angle of bottom dead centre, rod over crank.

    Parameters
    ----------
    pi, e, l, r : float
        The constant, offset, rod length, crank radius. [-], [m], [m], [m]

    Returns
    -------
    float
        Crank angle. [rad]
    """
    return pi + np.arcsin(e / (l - r))


@formula("crank_angle", "kolchin_demidov_2008, ch. 6")
def textbook_velocity_max_angle(lam: Value) -> Value:
    """Crank angle of the greatest piston velocity in two terms, central.

    Parameters
    ----------
    lam : float
        Crank-to-rod ratio. [-]

    Returns
    -------
    float
        Crank angle. [rad]
    """
    return np.arccos((np.sqrt(1 + 8 * lam**2) - 1) / (4 * lam))


@formula("piston_acceleration", "kolchin_demidov_2008, ch. 6")
def acceleration_at_top(r: Value, w: Value, lam: Value) -> Value:
    """Piston acceleration at top dead centre of a central slider-crank, exact and in two terms.

    Parameters
    ----------
    r, w, lam : float
        Crank radius, angular speed, crank-to-rod ratio. [m], [rad/s], [-]

    Returns
    -------
    float
        Acceleration, the greatest of the revolution. [m/s2]
    """
    return r * w**2 * (1 + lam)


@formula("piston_acceleration", "kolchin_demidov_2008, ch. 6")
def acceleration_at_bottom(r: Value, w: Value, lam: Value) -> Value:
    """Piston acceleration at bottom dead centre of a central slider-crank, exact and in two terms.

    Parameters
    ----------
    r, w, lam : float
        Crank radius, angular speed, crank-to-rod ratio. [m], [rad/s], [-]

    Returns
    -------
    float
        Acceleration; in two terms the least of the revolution up to a ratio of 1/4. [m/s2]
    """
    return -(r * w**2 * (1 - lam))


@formula("piston_acceleration", "kolchin_demidov_2008, ch. 6")
def textbook_acceleration_least(r: Value, w: Value, lam: Value) -> Value:
    """Least piston acceleration in two terms, central, for a crank-to-rod ratio above 1/4.

    Parameters
    ----------
    r, w, lam : float
        Crank radius, angular speed, crank-to-rod ratio. [m], [rad/s], [-]

    Returns
    -------
    float
        Acceleration before and after bottom dead centre. [m/s2]
    """
    return -(r * w**2 * (lam + 1 / (8 * lam)))
