"""Coordinates and their derivatives by the crank angle."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from crankwork.formula.expression import Value, formula


class Transfer(NamedTuple):
    """A coordinate and its first and second derivative by the crank angle, arrays of shape (n,) or traced values."""

    position: Value
    position_1: Value
    position_2: Value


class PointMotion(NamedTuple):
    """The two coordinates of a point. [m]"""

    x: Transfer
    y: Transfer


@formula("link_angular_velocity", "artobolevsky_1988, ch. 5")
def link_angular_velocity(theta_1: Value, w: Value) -> Value:
    """Angular velocity of a link."""
    return theta_1 * w


@formula("slider_velocity", "artobolevsky_1988, ch. 5")
def slider_velocity(s_1: Value, w: Value) -> Value:
    """Velocity of a sliding piece along its guide."""
    return s_1 * w


@formula("slider_acceleration", "artobolevsky_1988, ch. 5")
def slider_acceleration(s_2: Value, w: Value, s_1: Value, eps: Value) -> Value:
    """Acceleration of a sliding piece along its guide when the crank speed changes."""
    return s_2 * w**2 + s_1 * eps


@formula("point_velocity_x", "artobolevsky_1988, ch. 5")
def point_velocity_x(x_P1: Value, w: Value) -> Value:
    """Velocity of a point along x."""
    return x_P1 * w


@formula("point_velocity_y", "artobolevsky_1988, ch. 5")
def point_velocity_y(y_P1: Value, w: Value) -> Value:
    """Velocity of a point along y."""
    return y_P1 * w


@formula("point_velocity", "artobolevsky_1988, ch. 5")
def point_velocity(v_Px: Value, v_Py: Value) -> Value:
    """Magnitude of the velocity of a point."""
    return np.sqrt(v_Px**2 + v_Py**2)


@formula("point_acceleration_x", "artobolevsky_1988, ch. 5")
def point_acceleration_x(x_P2: Value, w: Value, x_P1: Value, eps: Value) -> Value:
    """Acceleration of a point along x when the crank speed changes."""
    return x_P2 * w**2 + x_P1 * eps


@formula("point_acceleration_y", "artobolevsky_1988, ch. 5")
def point_acceleration_y(y_P2: Value, w: Value, y_P1: Value, eps: Value) -> Value:
    """Acceleration of a point along y when the crank speed changes."""
    return y_P2 * w**2 + y_P1 * eps


@formula("point_acceleration", "artobolevsky_1988, ch. 5")
def point_acceleration(a_Px: Value, a_Py: Value) -> Value:
    """Magnitude of the acceleration of a point."""
    return np.sqrt(a_Px**2 + a_Py**2)


@formula("coriolis_acceleration", "khurmi_gupta_2005, ch. 8")
def coriolis_acceleration(w_i: Value, v_s: Value) -> Value:
    """Coriolis acceleration of a piece that slides along a guide that turns."""
    return 2 * w_i * v_s
