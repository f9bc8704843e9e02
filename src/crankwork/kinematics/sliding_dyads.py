"""Closed-form motion of the dyads with two sliding joints or a sliding joint in the middle: RPR, PRP, RPP."""

from __future__ import annotations

import numpy as np

from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import absent, is_traced, named
from crankwork.kinematics import plane_motion as plane
from crankwork.kinematics.dyads import (
    Closure,
    GroupMotion,
    LinkMotion,
    Through,
    in_link_frame,
    is_zero,
    joint_distance_square,
    named_coordinates,
    named_point,
    named_slide,
    point_on_guide,
    rotated_frame,
    unchanged,
)
from crankwork.kinematics.kinematic_coefficients import PointMotion, Transfer
from crankwork.mechanism.dyads import PRP, RPP, RPR, Guide

_DYADS = "artobolevsky_1988, ch. 4"


@formula("guide_reach", _DYADS)
def rpr_reach(s_b: Value, d_sq: Value, e_s: Value) -> Value:
    """How far along its slot the pin of an RPR dyad lies from the foot of the pivot."""
    return s_b * np.sqrt(d_sq - e_s * e_s)


@formula("link_cos", _DYADS)
def rpr_cosine(h_g: Value, dx: Value, e_s: Value, dy: Value, d_sq: Value) -> Value:
    """Cosine of the direction of the slot of an RPR dyad."""
    return (h_g * dx + e_s * dy) / d_sq


@formula("link_sin", _DYADS)
def rpr_sine(h_g: Value, dy: Value, e_s: Value, dx: Value, d_sq: Value) -> Value:
    """Sine of the direction of the slot of an RPR dyad."""
    return (h_g * dy - e_s * dx) / d_sq


@formula("link_angle_1", _DYADS)
def rpr_rate(dy_1: Value, cos_th: Value, dx_1: Value, sin_th: Value, h_g: Value) -> Value:
    """Transfer function of the turning of the lever of an RPR dyad."""
    return (dy_1 * cos_th - dx_1 * sin_th) / h_g


@formula("link_angle_2", _DYADS)
def rpr_rate_1(  # noqa: PLR0913 - an acceleration with its Coriolis part
    dy_2: Value, cos_th: Value, dx_2: Value, sin_th: Value, s_1: Value, e_s: Value, theta_1: Value, h_g: Value
) -> Value:
    """Second transfer function of the turning of the lever of an RPR dyad."""
    return (dy_2 * cos_th - dx_2 * sin_th - (2 * s_1 - e_s * theta_1) * theta_1) / h_g


@formula("slider_displacement_1", _DYADS)
def rpr_slide_1(dx_1: Value, cos_th: Value, dy_1: Value, sin_th: Value, e_s: Value, theta_1: Value) -> Value:
    """First transfer function of the block of an RPR dyad along its slot."""
    return dx_1 * cos_th + dy_1 * sin_th + e_s * theta_1


@formula("slider_displacement_2", _DYADS)
def rpr_slide_2(  # noqa: PLR0913 - an acceleration with its guiding parts
    dx_2: Value, cos_th: Value, dy_2: Value, sin_th: Value, h_g: Value, theta_1: Value, e_s: Value, theta_2: Value
) -> Value:
    """Second transfer function of the block of an RPR dyad along its slot."""
    return dx_2 * cos_th + dy_2 * sin_th + h_g * theta_1 * theta_1 + e_s * theta_2


@formula("guide_sine", _DYADS)
def sine_between(cos_th: Value, sin_al: Value, sin_th: Value, cos_al: Value) -> Value:
    """Sine of the angle from one guide to another."""
    return cos_th * sin_al - sin_th * cos_al


@formula("slider_displacement", _DYADS)
def crossing(dx: Value, sin_th: Value, dy: Value, cos_th: Value, sin_gg: Value) -> Value:
    """Distance along one guide to where it crosses another, with the direction of the other; or its derivative."""
    return (dx * sin_th - dy * cos_th) / sin_gg


def rpr_motion(dyad: RPR, joint: PointMotion, pivot: PointMotion, through: Through = unchanged) -> GroupMotion:
    """Return the motion of a slotted lever and its block (artobolevsky_1988, ch. 4).

    Distance along the slot [m], frames, closure; NaN where the pin is nearer to the pivot than the slot. `joint` and
    `pivot`: motion of the pin of the block and of the pivot of the lever [m].

    With d from pivot to pin, t along the slot and n across, e the distance of the slot from the pivot:
    d = s t + e n, hence s = branch sqrt(d^2 - e^2), theta' = d' n / s, s' = d' t + e theta', and once more
    theta'' = (d'' n - 2 s' theta' + e theta'^2) / s with the Coriolis term, s'' = d'' t + s theta'^2 + e theta''.
    """
    along, e = _in_slot_axes(dyad.slot)
    name, block_ = dyad.link, dyad.block
    (dx, dx_1, dx_2), (dy, dy_1, dy_2) = (
        tuple(
            named(end - start, f"distance_{axis}{order}.{name}")
            for end, start, order in zip(mine, base, ("", "_1", "_2"), strict=True)
        )
        for axis, mine, base in zip("xy", joint, pivot, strict=True)
    )
    square = named(joint_distance_square(dx, dy), f"joint_distance_square.{name}")
    s = named(through("reach", rpr_reach(dyad.branch, square, e)), f"guide_reach.{block_}")
    cos = named(through("cos", rpr_cosine(s, dx, e, dy, square)), f"link_cos.{block_}")
    sin = named(through("sin", rpr_sine(s, dy, e, dx, square)), f"link_sin.{block_}")
    rate = named(through("rate", rpr_rate(dy_1, cos, dx_1, sin, s)), f"link_angle_1.{name}")
    s_1 = named(rpr_slide_1(dx_1, cos, dy_1, sin, e, rate), f"slider_displacement_1.{block_}")
    rate_1 = rpr_rate_1(dy_2, cos, dx_2, sin, s_1, e, rate, s)
    rate_1 = named(through("rate_1", rate_1), f"link_angle_2.{name}")
    s_2 = rpr_slide_2(dx_2, cos, dy_2, sin, s, rate, e, rate_1)
    block = LinkMotion(joint, cos, sin, rate, rate_1)
    angle = dyad.slot.angle
    link = rotated_frame(block._replace(origin=pivot), angle if is_zero(angle) else -angle, name)
    closure = (
        None if is_traced(square) else Closure(square - e * e, float(np.fmax.reduce(square.real, initial=0.0)), square)
    )
    place = s if is_zero(along) else s - along
    sliders = {block_: named_slide(Transfer(place, s_1, s_2), block_)}
    return GroupMotion({}, {name: link, block_: block}, sliders, closure)


def _in_slot_axes(slot: Guide) -> tuple[Value, Value]:
    """Return the coordinates of the point of a slot along and across the slot, seen from the origin of the link."""
    x, y = slot.point
    if is_zero(slot.angle):
        return x, y
    cos, sin = plane.cosine_of_direction(slot.angle), plane.sine_of_direction(slot.angle)
    if is_traced(x) and is_zero(x) and is_zero(y):
        return absent("slider_displacement"), absent("slot_offset")
    along, across = plane.along_guide(x, cos, y, sin), plane.across_guide(y, cos, x, sin)
    return named(along, "guide_along.slot"), named(across, "slot_offset")


def prp_motion(dyad: PRP, a: LinkMotion, b: LinkMotion) -> GroupMotion:
    """Return the motion of two blocks on one pin where two guides cross (artobolevsky_1988, ch. 4).

    Pin, distances along the guides [m], frames, closure: the square of the sine of the angle between the guides.

    s_a t_a - s_b t_b = q_b - q_a, and its derivatives with what the turning guides add.
    """
    zero: Value
    if is_traced(a.cos, b.cos):
        zero, sine = absent("slider_displacement_1"), sine_between(a.cos, b.sin, a.sin, b.cos)
        sine = named(sine, f"guide_sine.{dyad.point}")
    else:
        zero = np.zeros_like(a.cos * b.cos)
        sine = zero + sine_between(a.cos, b.sin, a.sin, b.cos)

    def solved(order: str, start: tuple[Value, Value], end: tuple[Value, Value]) -> tuple[Value, ...]:
        x, y = end[0] - start[0], end[1] - start[1]
        s_a, s_b = crossing(x, b.sin, y, b.cos, sine), crossing(x, a.sin, y, a.cos, sine)
        keys = (f"slider_displacement{order}.{piece}" for piece in (dyad.block_a, dyad.block_b))
        return tuple(named(distance, key) for distance, key in zip((s_a, s_b), keys, strict=True))

    s_a, s_b = solved("", *(_column(guide.origin, 0) for guide in (a, b)))
    names = f"{dyad.block_a}.place", f"{dyad.block_b}.place"
    carried = [
        named_point(point_on_guide(guide, Transfer(s, zero, zero)), name)
        for guide, s, name in zip((a, b), (s_a, s_b), names, strict=True)
    ]
    s_a_1, s_b_1 = solved("_1", *(_column(position, 1) for position in carried))
    names = f"{dyad.block_a}.carried", f"{dyad.block_b}.carried"
    carried = [
        named_point(point_on_guide(guide, Transfer(s, s_1, zero)), name)
        for guide, s, s_1, name in zip((a, b), (s_a, s_b), (s_a_1, s_b_1), names, strict=True)
    ]
    s_a_2, s_b_2 = solved("_2", *(_column(position, 2) for position in carried))
    slide_a, slide_b = Transfer(s_a, s_a_1, s_a_2), Transfer(s_b, s_b_1, s_b_2)
    point = point_on_guide(a, slide_a)
    links = {dyad.block_a: a._replace(origin=point), dyad.block_b: b._replace(origin=point)}
    closure = None if is_traced(sine) else Closure(sine * sine, 1.0, sine)
    return GroupMotion({dyad.point: point}, links, {dyad.block_a: slide_a, dyad.block_b: slide_b}, closure)


def _column(point: PointMotion, order: int) -> tuple[Value, Value]:
    """Return both coordinates of a point, or of one of its derivatives."""
    return point.x[order], point.y[order]


def rpp_motion(dyad: RPP, joint: PointMotion, guide: LinkMotion) -> GroupMotion:
    """Return the motion of a yoke along its guide and of the block in its slot (artobolevsky_1988, ch. 4).

    Distances along guide and slot [m], frames, closure: the square of the sine of the angle between guide and slot.

    Seen from the guide, the pin is s + p_t + p cos(gamma) along and p_n + p sin(gamma) across, with the point
    (p_t, p_n) and the angle gamma of the slot in the yoke. Both are linear in s and p.
    """
    (x, y), gamma = dyad.slot.point, dyad.slot.angle
    cos = named(plane.cosine_of_direction(gamma), f"line_cos.{dyad.block}")
    sin = named(plane.sine_of_direction(gamma), f"line_sin.{dyad.block}")
    along, across = named_coordinates(in_link_frame(guide, joint), dyad.joint)
    block_slide = named_slide(Transfer((across[0] - y) / sin, across[1] / sin, across[2] / sin), dyad.block)
    slide = named_slide(
        Transfer(along[0] - x - cos * block_slide[0], along[1] - cos * block_slide[1], along[2] - cos * block_slide[2]),
        dyad.link,
    )
    link = guide._replace(origin=named_point(point_on_guide(guide, slide), dyad.link))
    block = rotated_frame(guide, gamma, dyad.block)._replace(origin=joint)
    closure = None if is_traced(gamma) else Closure(np.full_like(slide[0], sin * sin), 1.0, slide[0])
    sliders = {dyad.link: slide, dyad.block: block_slide}
    return GroupMotion({}, {dyad.link: link, dyad.block: block}, sliders, closure)
