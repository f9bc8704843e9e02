"""Closed-form motion of the dyads with two sliding joints or a sliding joint in the middle: RPR, PRP, RPP."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.dyads import Closure, LinkMotion, point_on_guide, seen_from, turned
from crankwork.kinematics.transfer import PointMotion, Transfer
from crankwork.mechanism.dyads import RPP, RPR, Guide


class RPRMotion(NamedTuple):
    """The distance of the block along the slot, and the frames of lever and block."""

    slide: Transfer
    link: LinkMotion
    block: LinkMotion
    closure: Closure


def rpr_motion(dyad: RPR, joint: PointMotion, pivot: PointMotion) -> RPRMotion:
    """Return the motion of a slotted lever and its block.

    Parameters
    ----------
    dyad : RPR
        Lever and block.
    joint, pivot : PointMotion, arrays of shape (n,)
        Motion of the pin of the block and of the pivot of the lever. [m]

    Returns
    -------
    RPRMotion
        Distance along the slot [m], frames, closure; NaN where the pin is nearer to the pivot than the slot.

    Notes
    -----
    With d from pivot to pin, t along the slot and n across, e the distance of the slot from the pivot:
    d = s t + e n, hence s = branch sqrt(d^2 - e^2), theta' = d' n / s, s' = d' t + e theta', and once more
    theta'' = (d'' n - 2 s' theta' + e theta'^2) / s with the Coriolis term, s'' = d'' t + s theta'^2 + e theta''.

    References
    ----------
    artobolevsky_1988, ch. 4.
    """
    along, e = _in_slot_axes(dyad.slot)
    (dx, dx_1, dx_2), (dy, dy_1, dy_2) = (
        tuple(one - other for one, other in zip(mine, base, strict=True))
        for mine, base in zip(joint, pivot, strict=True)
    )
    square = dx * dx + dy * dy
    reach = square - e * e
    s = dyad.branch * np.sqrt(reach)
    cos, sin = (s * dx + e * dy) / square, (s * dy - e * dx) / square
    rate = (dy_1 * cos - dx_1 * sin) / s
    s_1 = dx_1 * cos + dy_1 * sin + e * rate
    rate_1 = (dy_2 * cos - dx_2 * sin - (2 * s_1 - e * rate) * rate) / s
    s_2 = dx_2 * cos + dy_2 * sin + s * rate * rate + e * rate_1
    block = LinkMotion(joint, cos, sin, rate, rate_1)
    link = turned(block._replace(origin=pivot), -dyad.slot.angle)
    closure = Closure(reach, float(np.nanmax(square.real)), square)
    return RPRMotion(Transfer(s - along, s_1, s_2), link, block, closure)


def _in_slot_axes(slot: Guide) -> tuple[float, float]:
    """Return the coordinates of the point of a slot along and across the slot, seen from the origin of the link."""
    (x, y), cos, sin = slot.point, math.cos(slot.angle), math.sin(slot.angle)
    return x * cos + y * sin, y * cos - x * sin


class PRPMotion(NamedTuple):
    """The pin of two blocks, their distances along the guides, and their frames."""

    point: PointMotion
    slide_a: Transfer
    slide_b: Transfer
    block_a: LinkMotion
    block_b: LinkMotion
    closure: Closure


def prp_motion(a: LinkMotion, b: LinkMotion) -> PRPMotion:
    """Return the motion of two blocks on one pin where two guides cross.

    Parameters
    ----------
    a, b : LinkMotion
        The guides.

    Returns
    -------
    PRPMotion
        Pin, distances along the guides [m], frames, closure: the square of the sine of the angle between the guides.

    Notes
    -----
    s_a t_a - s_b t_b = q_b - q_a, and its derivatives with what the turning guides add.

    References
    ----------
    artobolevsky_1988, ch. 4.
    """
    zero = np.zeros_like(a.cos * b.cos)
    sine = zero + (a.cos * b.sin - a.sin * b.cos)

    def solved(start: tuple[Array, Array], end: tuple[Array, Array]) -> tuple[Array, Array]:
        x, y = end[0] - start[0], end[1] - start[1]
        return (x * b.sin - y * b.cos) / sine, (x * a.sin - y * a.cos) / sine

    s_a, s_b = solved(*(_column(guide.origin, 0) for guide in (a, b)))
    carried = [point_on_guide(guide, Transfer(s, zero, zero)) for guide, s in ((a, s_a), (b, s_b))]
    s_a_1, s_b_1 = solved(*(_column(one, 1) for one in carried))
    carried = [point_on_guide(guide, Transfer(s, s_1, zero)) for guide, s, s_1 in ((a, s_a, s_a_1), (b, s_b, s_b_1))]
    s_a_2, s_b_2 = solved(*(_column(one, 2) for one in carried))
    slide_a, slide_b = Transfer(s_a, s_a_1, s_a_2), Transfer(s_b, s_b_1, s_b_2)
    point = point_on_guide(a, slide_a)
    blocks = a._replace(origin=point), b._replace(origin=point)
    return PRPMotion(point, slide_a, slide_b, *blocks, Closure(sine * sine, 1.0, sine))


def _column(point: PointMotion, order: int) -> tuple[Array, Array]:
    """Return both coordinates of a point, or of one of its derivatives."""
    return point.x[order], point.y[order]


class RPPMotion(NamedTuple):
    """The distances of yoke and block along guide and slot, and their frames."""

    slide: Transfer
    block_slide: Transfer
    link: LinkMotion
    block: LinkMotion
    closure: Closure


def rpp_motion(dyad: RPP, joint: PointMotion, guide: LinkMotion) -> RPPMotion:
    """Return the motion of a yoke along its guide and of the block in its slot.

    Parameters
    ----------
    dyad : RPP
        Yoke and block.
    joint : PointMotion, arrays of shape (n,)
        Motion of the pin of the block. [m]
    guide : LinkMotion
        What the yoke slides on.

    Returns
    -------
    RPPMotion
        Distances along guide and slot [m], frames, closure: the square of the sine of the angle between guide and slot.

    Notes
    -----
    Seen from the guide, the pin is s + p_t + p cos(gamma) along and p_n + p sin(gamma) across, with the point
    (p_t, p_n) and the angle gamma of the slot in the yoke. Both are linear in s and p.

    References
    ----------
    artobolevsky_1988, ch. 4.
    """
    (x, y), gamma = dyad.slot.point, dyad.slot.angle
    cos, sin = math.cos(gamma), math.sin(gamma)
    along, across = seen_from(guide, joint)
    block_slide = Transfer((across[0] - y) / sin, across[1] / sin, across[2] / sin)
    slide = Transfer(
        along[0] - x - cos * block_slide[0], along[1] - cos * block_slide[1], along[2] - cos * block_slide[2]
    )
    link = guide._replace(origin=point_on_guide(guide, slide))
    block = turned(guide, gamma)._replace(origin=joint)
    closure = Closure(np.full_like(slide[0], sin * sin), 1.0, slide[0])
    return RPPMotion(slide, block_slide, link, block, closure)
