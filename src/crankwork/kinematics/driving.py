"""What drivers place besides a crank: cranks that gears turn, the third side that a motor between two links opens."""

from __future__ import annotations

import numpy as np

from crankwork.formula.expression import Value, formula
from crankwork.formula.known import absent, is_known, named
from crankwork.kinematics import plane_motion as plane
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.dyads import LinkMotion, fixed_point, is_nothing
from crankwork.kinematics.transfer import Transfer
from crankwork.mechanism.driver import GearedCrank, LinkMotor
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
    angle = rate * grid.angle if is_nothing(geared.start) else geared.start + rate * grid.angle
    cos, sin = plane.cosine_of_direction(angle), plane.sine_of_direction(angle)
    if is_known(cos):
        return LinkMotion(fixed_point(geared.pivot), cos, sin, rate, absent("link_angle_2"))
    return LinkMotion(fixed_point(geared.pivot), cos, sin, np.full_like(cos, rate), np.zeros_like(cos))
