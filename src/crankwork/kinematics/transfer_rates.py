"""Velocities and accelerations of points, links and sliders from their transfer functions."""

from __future__ import annotations

import numpy as np

from crankwork.expressions import Value, formula


@formula("link_angular_velocity", "artobolevsky_1988, ch. 5")
def link_angular_velocity(theta_1: Value, w: Value) -> Value:
    """Angular velocity of a link.

    Parameters
    ----------
    theta_1, w : array
        First transfer function of its rotation, angular speed of the crank. [-], [rad/s]

    Returns
    -------
    array
        Angular velocity, positive anticlockwise. [rad/s]
    """
    return theta_1 * w


@formula("link_angular_acceleration", "artobolevsky_1988, ch. 5")
def link_angular_acceleration_steady(theta_2: Value, w: Value) -> Value:
    """Angular acceleration of a link at constant speed of the crank.

    Parameters
    ----------
    theta_2, w : array
        Second transfer function of its rotation, angular speed of the crank. [-], [rad/s]

    Returns
    -------
    array
        Angular acceleration, positive anticlockwise. [rad/s2]
    """
    return theta_2 * w**2


@formula("centre_acceleration", "artobolevsky_1988, ch. 5")
def centre_acceleration_steady(q_2: Value, w: Value) -> Value:
    """Acceleration of a centre of mass along one axis at constant speed of the crank.

    Parameters
    ----------
    q_2, w : array
        Second transfer function of the coordinate, angular speed of the crank. [m], [rad/s]

    Returns
    -------
    array
        Acceleration. [m/s2]
    """
    return q_2 * w**2


@formula("slider_velocity", "artobolevsky_1988, ch. 5")
def slider_velocity(s_1: Value, w: Value) -> Value:
    """Velocity of a sliding piece along its guide.

    Parameters
    ----------
    s_1, w : array
        First transfer function of its distance, angular speed of the crank. [m], [rad/s]

    Returns
    -------
    array
        Velocity, positive as its distance grows. [m/s]
    """
    return s_1 * w


@formula("slider_acceleration", "artobolevsky_1988, ch. 5")
def slider_acceleration_steady(s_2: Value, w: Value) -> Value:
    """Acceleration of a sliding piece along its guide at constant speed of the crank.

    Parameters
    ----------
    s_2, w : array
        Second transfer function of its distance, angular speed of the crank. [m], [rad/s]

    Returns
    -------
    array
        Acceleration. [m/s2]
    """
    return s_2 * w**2


@formula("slider_acceleration", "artobolevsky_1988, ch. 5")
def slider_acceleration(s_2: Value, w: Value, s_1: Value, eps: Value) -> Value:
    """Acceleration of a sliding piece along its guide when the crank speed changes.

    Parameters
    ----------
    s_2, w, s_1, eps : array
        Second transfer function of its distance, angular speed of the crank, first transfer function,
        angular acceleration of the crank. [m], [rad/s], [m], [rad/s2]

    Returns
    -------
    array
        Acceleration. [m/s2]
    """
    return s_2 * w**2 + s_1 * eps


@formula("point_velocity", "artobolevsky_1988, ch. 5")
def point_velocity(x_P1: Value, y_P1: Value, w: Value) -> Value:
    """Magnitude of the velocity of a point.

    Parameters
    ----------
    x_P1, y_P1, w : array
        First transfer functions of its coordinates, angular speed of the crank. [m], [m], [rad/s]

    Returns
    -------
    array
        Velocity. [m/s]
    """
    return np.sqrt(x_P1**2 + y_P1**2) * w


@formula("point_acceleration", "artobolevsky_1988, ch. 5")
def point_acceleration_steady(x_P2: Value, y_P2: Value, w: Value) -> Value:
    """Magnitude of the acceleration of a point at constant speed of the crank.

    Parameters
    ----------
    x_P2, y_P2, w : array
        Second transfer functions of its coordinates, angular speed of the crank. [m], [m], [rad/s]

    Returns
    -------
    array
        Acceleration. [m/s2]
    """
    return np.sqrt(x_P2**2 + y_P2**2) * w**2


@formula("point_acceleration", "artobolevsky_1988, ch. 5")
def point_acceleration(x_P2: Value, w: Value, x_P1: Value, eps: Value, y_P2: Value, y_P1: Value) -> Value:
    """Magnitude of the acceleration of a point when the crank speed changes.

    Parameters
    ----------
    x_P2, w, x_P1, eps, y_P2, y_P1 : array
        Second transfer function of x, angular speed of the crank, first transfer function of x, angular
        acceleration of the crank, transfer functions of y. [m], [rad/s], [m], [rad/s2], [m], [m]

    Returns
    -------
    array
        Acceleration. [m/s2]
    """
    return np.sqrt((x_P2 * w**2 + x_P1 * eps) ** 2 + (y_P2 * w**2 + y_P1 * eps) ** 2)
