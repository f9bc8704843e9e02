"""Closed-form positions and transfer functions of the crank, of points on links and of the dyads of two links.

Everything is arrays with the crank angle on the last axis; what stands still is an array of no axes.
The kernels hold for floats, arrays of designs and complex steps alike; whether a group closes is told by
`closure`, which is positive where it does.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.transfer import PointMotion, Transfer
from crankwork.mechanism.dyads import RRP, RRR, Guide, Point
from crankwork.mechanism.mechanism import Crank

_ZERO = np.array(0.0)


class LinkMotion(NamedTuple):
    """The frame of a link: its origin [m], its direction [-], the rate and the second rate of turning [-].

    A guide is one as well: a point of the line, and the direction of the line.
    """

    origin: PointMotion
    cos: Array
    sin: Array
    angle_1: Array
    angle_2: Array

    @property
    def turns(self) -> bool:
        """Whether it turns at all; a fixed guide does not."""
        return self.angle_1.ndim > 0

    @property
    def stands(self) -> bool:
        """Whether it neither turns nor moves."""
        return self.angle_1.ndim == self.origin.x.position_1.ndim == 0


class Closure(NamedTuple):
    """How well a group closes.

    `value` is zero where the group is singular and negative or NaN where it does not close, arrays of shape
    (n,); `scale` is what it is to be compared with; `excess` is the length that is missing, or spare where it
    is negative. [m2], [m2], [m]
    """

    value: Array
    scale: float
    excess: Array


def fixed_point(point: Point) -> PointMotion:
    """Return the motion of a point that stands still."""
    return PointMotion(Transfer(np.array(point[0]), _ZERO, _ZERO), Transfer(np.array(point[1]), _ZERO, _ZERO))


def fixed_guide(guide: Guide) -> LinkMotion:
    """Return the motion of a guide that stands still."""
    cos, sin = np.array(math.cos(guide.angle)), np.array(math.sin(guide.angle))
    return LinkMotion(fixed_point(guide.point), cos, sin, _ZERO, _ZERO)


def crank_motion(crank: Crank, grid: CrankGrid) -> LinkMotion:
    """Return the motion of the crank, its frame at the pivot.

    Parameters
    ----------
    crank : Crank
        The driving link.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]
    """
    cos_start, sin_start = math.cos(crank.start), math.sin(crank.start)
    sin = grid.sin if crank.direction == 1 else -grid.sin
    cos, sin = cos_start * grid.cos - sin_start * sin, sin_start * grid.cos + cos_start * sin
    rate = np.full_like(cos, crank.direction)
    return LinkMotion(fixed_point(crank.pivot), cos, sin, rate, np.zeros_like(cos))


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
    link = crank_motion(crank, grid)
    return pin_on_crank(crank, link), Transfer(crank.start + crank.direction * grid.angle, link.angle_1, link.angle_2)


def pin_on_crank(crank: Crank, link: LinkMotion) -> PointMotion:
    """Return the motion of the crank pin, given that of the crank. [m]"""
    (x, y), d = crank.pivot, crank.direction
    arm_x, arm_y = crank.radius * link.cos, crank.radius * link.sin
    return PointMotion(Transfer(x + arm_x, -d * arm_y, -arm_x), Transfer(y + arm_y, d * arm_x, -arm_y))


def point_on_link(link: LinkMotion, along: float, across: float) -> PointMotion:
    """Return the motion of a point that moves with a link.

    Parameters
    ----------
    link : LinkMotion of (n,)
        The frame of the link.
    along, across : float
        Coordinates in that frame. [m]

    Returns
    -------
    PointMotion, arrays of shape (n,)
        r = o + d, r' = o' + J d theta', r'' = o'' + J d theta'' - d theta'^2. [m]
    """
    (x, x_1, x_2), (y, y_1, y_2) = link.origin
    dx, dy = along * link.cos, along * link.sin
    if across:
        dx, dy = dx - across * link.sin, dy + across * link.cos
    if not link.turns:
        return PointMotion(Transfer(x + dx, x_1, x_2), Transfer(y + dy, y_1, y_2))
    square = link.angle_1 * link.angle_1
    return PointMotion(
        Transfer(x + dx, x_1 - link.angle_1 * dy, x_2 - link.angle_2 * dy - square * dx),
        Transfer(y + dy, y_1 + link.angle_1 * dx, y_2 + link.angle_2 * dx - square * dy),
    )


def turned(link: LinkMotion, angle: float) -> LinkMotion:
    """Return a frame with the same origin, its x axis at an angle to that of the link. [rad]"""
    if not angle:
        return link
    cos, sin = math.cos(angle), math.sin(angle)
    return link._replace(cos=cos * link.cos - sin * link.sin, sin=sin * link.cos + cos * link.sin)


def guide_on_link(link: LinkMotion, guide: Guide) -> LinkMotion:
    """Return the motion of a guide that a link carries."""
    return turned(link, guide.angle)._replace(origin=point_on_link(link, *guide.point))


def seen_from(link: LinkMotion, point: PointMotion) -> PointMotion:
    """Return the motion of a point as seen from a link: its coordinates in the frame of the link.

    Parameters
    ----------
    link : LinkMotion
        The frame.
    point : PointMotion, arrays of shape (n,)
        The point. [m]

    Returns
    -------
    PointMotion, arrays of shape (n,)
        Along and across, with their own derivatives: what is left of the acceleration after guiding and
        Coriolis parts are taken off. [m]
    """
    cos, sin = link.cos, link.sin
    (x, x_1, x_2), (y, y_1, y_2) = point
    base_x, base_y = link.origin
    x, y = x - base_x.position, y - base_y.position
    if not link.stands:
        x_1, y_1 = x_1 - base_x.position_1, y_1 - base_y.position_1
        x_2, y_2 = x_2 - base_x.position_2, y_2 - base_y.position_2
    along, across = x * cos + y * sin, y * cos - x * sin
    along_1, across_1 = x_1 * cos + y_1 * sin, y_1 * cos - x_1 * sin
    along_2, across_2 = x_2 * cos + y_2 * sin, y_2 * cos - x_2 * sin
    if link.turns:
        rate, rate_1, square = link.angle_1, link.angle_2, link.angle_1 * link.angle_1
        along_1, across_1 = along_1 + rate * across, across_1 - rate * along
        along_2 = along_2 + 2 * rate * across_1 + rate_1 * across + square * along
        across_2 = across_2 - 2 * rate * along_1 - rate_1 * along + square * across
    return PointMotion(Transfer(along, along_1, along_2), Transfer(across, across_1, across_2))


def point_on_guide(guide: LinkMotion, slide: Transfer) -> PointMotion:
    """Return the motion of a point that slides along a guide, with its Coriolis part where the guide turns.

    Parameters
    ----------
    guide : LinkMotion
        The line.
    slide : Transfer, arrays of shape (n,)
        Distance along it. [m]
    """
    s, s_1, s_2 = slide
    cos, sin = guide.cos, guide.sin
    (x, x_1, x_2), (y, y_1, y_2) = guide.origin
    if guide.stands:
        return PointMotion(
            Transfer(x + cos * s, cos * s_1, cos * s_2),
            Transfer(y + sin * s, sin * s_1, sin * s_2),
        )
    if not guide.turns:
        return PointMotion(
            Transfer(x + cos * s, x_1 + cos * s_1, x_2 + cos * s_2),
            Transfer(y + sin * s, y_1 + sin * s_1, y_2 + sin * s_2),
        )
    across_1 = s * guide.angle_1
    along_2 = s_2 - across_1 * guide.angle_1
    across_2 = 2 * s_1 * guide.angle_1 + s * guide.angle_2
    return PointMotion(
        Transfer(x + cos * s, x_1 + cos * s_1 - sin * across_1, x_2 + cos * along_2 - sin * across_2),
        Transfer(y + sin * s, y_1 + sin * s_1 + cos * across_1, y_2 + sin * along_2 + cos * across_2),
    )


class RRRMotion(NamedTuple):
    """Where the two links of an RRR dyad meet, and their frames."""

    point: PointMotion
    link_a: LinkMotion
    link_b: LinkMotion
    closure: Closure


def rrr_motion(dyad: RRR, a: PointMotion, b: PointMotion) -> RRRMotion:
    """Return the motion of the joint and the links of an RRR dyad.

    Parameters
    ----------
    dyad : RRR
        The two links.
    a, b : PointMotion, arrays of shape (n,)
        Motion of the known points. [m]

    Returns
    -------
    RRRMotion
        Joint [m], frames of the links, closure; NaN where the links do not meet.

    Notes
    -----
    With d from a to b, u and v from a and b to the joint, and c = (p^2 - q^2 + d^2) / 2:
    h = u x v = branch sqrt(((p + q)^2 - d^2)(d^2 - (p - q)^2)) / 2, twice the area of the triangle, and
    u = (c d + h J d) / d^2. The loop a' + theta_a' J u = b' + theta_b' J v gives theta_a' = (b' - a') v / h and
    theta_b' = (b' - a') u / h, its derivative the same with b'' - a'' + theta_a'^2 u - theta_b'^2 v.

    References
    ----------
    artobolevsky_1988, ch. 4.
    """
    p, q = dyad.length_a, dyad.length_b
    (ax, ax_1, ax_2), (ay, ay_1, ay_2) = a
    (bx, bx_1, bx_2), (by, by_1, by_2) = b
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    area = ((p + q) ** 2 - square) * (square - (p - q) ** 2)
    h = (0.5 * dyad.branch) * np.sqrt(area)
    c, k = (0.5 * (p * p - q * q)) / square + 0.5, h / square
    ux, uy = c * dx - k * dy, c * dy + k * dx
    vx, vy = ux - dx, uy - dy

    inverse = 1 / h
    ex, ey = bx_1 - ax_1, by_1 - ay_1
    rate_a, rate_b = (ex * vx + ey * vy) * inverse, (ex * ux + ey * uy) * inverse
    square_a, square_b = rate_a * rate_a, rate_b * rate_b
    inward_x, inward_y = square_a * ux, square_a * uy
    ex, ey = bx_2 - ax_2 + inward_x - square_b * vx, by_2 - ay_2 + inward_y - square_b * vy
    rate_a_1, rate_b_1 = (ex * vx + ey * vy) * inverse, (ex * ux + ey * uy) * inverse

    point = PointMotion(
        Transfer(ax + ux, ax_1 - rate_a * uy, ax_2 - rate_a_1 * uy - inward_x),
        Transfer(ay + uy, ay_1 + rate_a * ux, ay_2 + rate_a_1 * ux - inward_y),
    )
    link_a = LinkMotion(a, (1 / p) * ux, (1 / p) * uy, rate_a, rate_a_1)
    link_b = LinkMotion(b, (1 / q) * vx, (1 / q) * vy, rate_b, rate_b_1)
    return RRRMotion(point, link_a, link_b, Closure(area, (2 * p * q) ** 2, square))


class RRPMotion(NamedTuple):
    """The slider point of an RRP dyad, its distance along the guide, and the frames of link and sliding piece."""

    point: PointMotion
    slide: Transfer
    link: LinkMotion
    piece: LinkMotion
    closure: Closure


def rrp_motion(dyad: RRP, joint: PointMotion, guide: LinkMotion) -> RRPMotion:
    """Return the motion of the slider and the link of an RRP dyad.

    Parameters
    ----------
    dyad : RRP
        The link.
    joint : PointMotion, arrays of shape (n,)
        Motion of the point the link hangs on. [m]
    guide : LinkMotion
        The line the slider runs on.

    Returns
    -------
    RRPMotion
        Slider point, distance along the guide [m], frames, closure; NaN where the link does not reach the guide.

    Notes
    -----
    Seen from the guide the joint has the coordinates s_joint and u; the link gives u^2 + h^2 = l^2 and
    s = s_joint + h with the sign of h the branch. Its angle to the guide has the derivative g' = -u' / h, so that
    h' = g' u. Coriolis enters through u' and u'', which are those seen from the guide.

    References
    ----------
    artobolevsky_1988, ch. 4.
    """
    length = dyad.length
    (along, along_1, along_2), (u, u_1, u_2) = seen_from(guide, joint)
    square = (length - u) * (length + u)
    h = dyad.branch * np.sqrt(square)
    inverse = -1 / h
    rate = u_1 * inverse
    h_1 = rate * u
    rate_1 = (u_2 + rate * h_1) * inverse
    slide = Transfer(along + h, along_1 + h_1, along_2 + rate_1 * u + rate * u_1)
    cos, sin = (1 / length) * guide.cos, (1 / length) * guide.sin
    if guide.turns:
        rate, rate_1 = rate + guide.angle_1, rate_1 + guide.angle_2
    point = point_on_guide(guide, slide)
    link = LinkMotion(joint, cos * h + sin * u, sin * h - cos * u, rate, rate_1)
    return RRPMotion(point, slide, link, guide._replace(origin=point), Closure(square, length**2, u))
