"""Closed-form positions and transfer functions of the crank and of Assur dyads."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from crankwork.errors import GeometryError
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.mechanism.mechanism import RRP, Crank


class Transfer(NamedTuple):
    """A coordinate and its first and second derivative by the crank angle, arrays of shape (n,)."""

    position: Array
    position_1: Array
    position_2: Array


class PointMotion(NamedTuple):
    """The two coordinates of a point. [m]"""

    x: Transfer
    y: Transfer


def crank_pin_motion(crank: Crank, grid: CrankGrid) -> tuple[PointMotion, Transfer]:
    """Return the motion of the crank pin and the direction of the crank arm.

    Parameters
    ----------
    crank : Crank
        The driving link.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]

    Returns
    -------
    tuple of PointMotion and Transfer, arrays of shape (n,)
        Coordinates of the pin [m], direction of the arm [rad].
    """
    cos_start, sin_start = math.cos(crank.start), math.sin(crank.start)
    sin = crank.direction * grid.sin
    cos, sin = cos_start * grid.cos - sin_start * sin, sin_start * grid.cos + cos_start * sin
    (x, y), r, d = crank.pivot, crank.radius, crank.direction
    pin = PointMotion(
        Transfer(x + r * cos, -d * r * sin, -r * cos),
        Transfer(y + r * sin, d * r * cos, -r * sin),
    )
    one = np.ones_like(grid.angle)
    return pin, Transfer(crank.start + d * grid.angle, d * one, 0 * one)


def rrp_motion(dyad: RRP, joint: PointMotion, grid: CrankGrid) -> tuple[PointMotion, Transfer, Transfer]:
    """Return the motion of the slider point, the link and the slider of an RRP dyad.

    Parameters
    ----------
    dyad : RRP
        The link and its guide.
    joint : PointMotion, arrays of shape (n,)
        Motion of the point the link hangs on. [m]
    grid : CrankGrid, shape (n,)
        Crank angles, named in the error. [rad]

    Returns
    -------
    tuple of PointMotion, Transfer, Transfer, arrays of shape (n,)
        Slider point [m], direction of the link from joint to slider [rad], distance along the guide from
        the guide point [m].

    Raises
    ------
    GeometryError
        If the link is too short to reach the guide, with the angle and the length that is missing.

    Notes
    -----
    With u across and s along the guide, the link gives u^2 + h^2 = l^2 and s = s_joint + branch h;
    both derivatives follow from differentiating that.

    References
    ----------
    artobolevsky_1988, ch. 4.
    """
    cos, sin = math.cos(dyad.guide_angle), math.sin(dyad.guide_angle)
    (x, x_1, x_2), (y, y_1, y_2) = joint
    qx, qy = dyad.guide_point
    along = (x - qx) * cos + (y - qy) * sin
    along_1, along_2 = x_1 * cos + y_1 * sin, x_2 * cos + y_2 * sin
    across = (y - qy) * cos - (x - qx) * sin
    across_1, across_2 = y_1 * cos - x_1 * sin, y_2 * cos - x_2 * sin
    square = (dyad.length - across) * (dyad.length + across)
    _check_reach(dyad, across, square, grid)
    height = np.sqrt(square)
    height_1 = -across * across_1 / height
    height_2 = -(across * across_2 + across_1**2 + height_1**2) / height
    b = dyad.branch
    slider = Transfer(along + b * height, along_1 + b * height_1, along_2 + b * height_2)
    point = PointMotion(
        Transfer(qx + slider.position * cos, slider.position_1 * cos, slider.position_2 * cos),
        Transfer(qy + slider.position * sin, slider.position_1 * sin, slider.position_2 * sin),
    )
    # the link points across by -across and along by branch * height
    angle_1 = -b * across_1 / height
    angle_2 = b * (-across_2 + across_1 * height_1 / height) / height
    behind = 0.0 if b > 0 else math.pi
    angle = dyad.guide_angle + behind + np.arctan2(-b * across, height)
    return point, Transfer(angle, angle_1, angle_2), slider


def _check_reach(dyad: RRP, across: Array, square: Array, grid: CrankGrid) -> None:
    if np.all(square > 0):
        return
    worst = int(np.argmin(square))
    missing = abs(float(across[worst])) - dyad.length
    raise GeometryError(
        f"link {dyad.link} does not reach the guide of {dyad.slider} at a crank angle of {grid.degrees[worst]:g} deg: "
        f"it is {missing * 1e3:.4g} mm too short; lengthen it by more than that or move the guide"
    )
