"""Drivers other than a single crank: geared cranks, and the third side of the triangle of a motor between two links."""

from __future__ import annotations

import numpy as np

from crankwork.formula.expression import Value, formula
from crankwork.formula.known import absent, is_known, named
from crankwork.kinematics import plane_motion as plane
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.dyads import DrivenAngle, LinkMotion, fixed_point, is_zero
from crankwork.kinematics.transfer import Transfer
from crankwork.mechanism.driver import GearedCrank, LinkMotor
from crankwork.mechanism.dyads import RRR
from crankwork.mechanism.mechanism import Crank

_SOURCE = "artobolevsky_1988, ch. 4"


@formula("link_length", _SOURCE)
def third_side(l_i: Value, l_k: Value, cos_g: Value) -> Value:
    """Third side of a triangle, from two sides and the angle between them."""
    return np.sqrt(l_i**2 + l_k**2 - 2 * l_i * l_k * cos_g)


@formula("link_length_1", _SOURCE)
def third_side_1(l_i: Value, l_k: Value, sin_g: Value, l_s: Value) -> Value:
    """First derivative of the third side of a triangle by the angle between the other two."""
    return l_i * l_k * sin_g / l_s


@formula("link_length_2", _SOURCE)
def third_side_2(l_i: Value, l_k: Value, cos_g: Value, l_1: Value, l_s: Value) -> Value:
    """Second derivative of the third side of a triangle by the angle between the other two."""
    return (l_i * l_k * cos_g - l_1**2) / l_s


@formula("doubled_area", _SOURCE)
def opened_area(l_s: Value, l_1: Value) -> Value:
    """Twice the area of a triangle whose third side grows with the angle across from it."""
    return l_s * l_1


@formula("link_angle_1", _SOURCE)
def opened_rate(theta_1: Value, l_i: Value, l_k: Value, l_s: Value) -> Value:
    """First transfer function of the first of two sides of a triangle, by the angle between them."""
    return theta_1 + ((l_i**2 - l_k**2) / l_s**2 - 1) / 2


@formula("link_angle_2", _SOURCE)
def opened_rate_1(theta_2: Value, l_1: Value, theta_k1: Value, theta_1: Value, l_s: Value) -> Value:
    """Second transfer function of two sides of a triangle, by the angle between them."""
    return theta_2 - l_1 * (1 + 2 * (theta_k1 - theta_1)) / l_s


def opened_pair(motor: LinkMotor, dyad: RRR, line: LinkMotion, length: Transfer) -> DrivenAngle:
    """Return the rates of a dyad formed by the two links of a motor, from the third side of their triangle.

    Valid with the links in line too, where the formulas of a dyad are 0/0. `line`, `length`: of the third side.
    """
    is_first = dyad.link_a == motor.links[0]
    area = opened_area(length.position, length.position_1)
    first = opened_rate(line.angle_1, *motor.sides, length.position)
    rates = (first, first + 1.0) if is_first else (first + 1.0, first)
    rate_1 = opened_rate_1(line.angle_2, length.position_1, first, line.angle_1, length.position)
    return DrivenAngle(area if is_first else -area, *rates, rate_1)


def third_side_motion(motor: LinkMotor, grid: CrankGrid) -> Transfer:
    """Return the length of the third side of the triangle that a motor between two links opens. [m]"""
    (a, b), name = motor.sides, motor.link
    cos, sin = plane.cosine_of_direction(grid.angle + motor.angle), plane.sine_of_direction(grid.angle + motor.angle)
    cos, sin = named(cos, f"line_cos.{name}"), named(sin, f"line_sin.{name}")
    length = named(third_side(a, b, cos), f"link_length.{name}")
    length_1 = named(third_side_1(a, b, sin, length), f"link_length_1.{name}")
    return Transfer(length, length_1, named(third_side_2(a, b, cos, length_1, length), f"link_length_2.{name}"))


def geared_motion(geared: GearedCrank, crank: Crank, grid: CrankGrid) -> LinkMotion:
    """Return the motion of a crank that gears turn with the driving one, its frame at its pivot."""
    rate = geared.ratio * crank.direction
    angle = rate * grid.angle if is_zero(geared.start) else geared.start + rate * grid.angle
    cos, sin = plane.cosine_of_direction(angle), plane.sine_of_direction(angle)
    if is_known(cos):
        return LinkMotion(fixed_point(geared.pivot), cos, sin, rate, absent("link_angle_2"))
    return LinkMotion(fixed_point(geared.pivot), cos, sin, np.full_like(cos, rate), np.zeros_like(cos))
