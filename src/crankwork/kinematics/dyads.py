"""Closed-form positions and transfer functions of the crank, of points on links and of the dyads of two links.

Arrays have the crank angle on the last axis; constants are arrays without axes. The same code takes traced values, with
absent values for constants. It holds for floats, arrays of designs and complex steps; `closure` is positive where a
group closes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import Piecewise, Tabulated, TracedValue, absent, given, is_traced, named
from crankwork.kinematics import plane_motion as plane
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.kinematic_coefficients import PointMotion, Transfer
from crankwork.mechanism.dyads import RRP, RRR, ChangePointPassage, Guide, Point
from crankwork.mechanism.mechanism import Crank

_ZERO = np.array(0.0)
_DYADS = "artobolevsky_1988, ch. 4"


@formula("joint_distance_square", _DYADS)
def joint_distance_square(dx: Value, dy: Value) -> Value:
    """Square of the distance of two points."""
    return dx * dx + dy * dy


@formula("doubled_area", _DYADS)
def doubled_area(s_b: Value, l_i: Value, l_k: Value, d_sq: Value) -> Value:
    """Twice the area of the triangle of an RRR dyad, by Heron's formula."""
    return 0.5 * s_b * np.sqrt(((l_i + l_k) ** 2 - d_sq) * (d_sq - (l_i - l_k) ** 2))


@formula("foot_ratio", _DYADS)
def foot_ratio(l_i: Value, l_k: Value, d_sq: Value) -> Value:
    """Where the foot of the inner joint of an RRR dyad lies between its outer joints."""
    return 0.5 * (l_i**2 - l_k**2) / d_sq + 0.5


@formula("arm_x", _DYADS)
def rrr_arm_x(k_d: Value, dx: Value, k_n: Value, dy: Value) -> Value:
    """Way along x from the first outer joint of an RRR dyad to the inner one."""
    return k_d * dx - k_n * dy


@formula("arm_y", _DYADS)
def rrr_arm_y(k_d: Value, dy: Value, k_n: Value, dx: Value) -> Value:
    """Way along y from the first outer joint of an RRR dyad to the inner one."""
    return k_d * dy + k_n * dx


@formula("link_angle_1", _DYADS)
def rrr_rate(dx_1: Value, r_x: Value, dy_1: Value, r_y: Value, S_sq: Value) -> Value:
    """Transfer function of the turning of a link of an RRR dyad, with the arm of the other link."""
    return (dx_1 * r_x + dy_1 * r_y) / S_sq


@formula("closing_x", _DYADS)
def closing_x(dx_2: Value, theta_1: Value, r_x: Value, theta_k1: Value, r_kx: Value) -> Value:
    """Second derivative of the way along x between the outer joints, less what the links of a dyad turn steadily."""
    return dx_2 + theta_1**2 * r_x - theta_k1**2 * r_kx


@formula("guide_reach", _DYADS)
def rrp_reach(s_b: Value, l_i: Value, n_g: Value) -> Value:
    """How far along its guide the link of an RRP dyad reaches."""
    return s_b * np.sqrt((l_i - n_g) * (l_i + n_g))


@formula("guide_rate", _DYADS)
def rrp_rate(n_g1: Value, h_g: Value) -> Value:
    """Rate of turning of the link of an RRP dyad against its guide."""
    return -n_g1 / h_g


@formula("guide_rate_1", _DYADS)
def rrp_rate_1(n_g2: Value, gamma_1: Value, h_g1: Value, h_g: Value) -> Value:
    """Second rate of turning of the link of an RRP dyad against its guide."""
    return -(n_g2 + gamma_1 * h_g1) / h_g


@formula("slider_displacement_2", _DYADS)
def rrp_slide_2(s_g2: Value, gamma_2: Value, n_g: Value, gamma_1: Value, n_g1: Value) -> Value:
    """Second transfer function of the slider of an RRP dyad along its guide."""
    return s_g2 + gamma_2 * n_g + gamma_1 * n_g1


@formula("link_cos", _DYADS)
def rrp_cosine(cos_th: Value, h_g: Value, sin_th: Value, n_g: Value, l_i: Value) -> Value:
    """Cosine of the direction of the link of an RRP dyad, from that of its guide."""
    return (cos_th * h_g + sin_th * n_g) / l_i


@formula("link_sin", _DYADS)
def rrp_sine(sin_th: Value, h_g: Value, cos_th: Value, n_g: Value, l_i: Value) -> Value:
    """Sine of the direction of the link of an RRP dyad, from that of its guide."""
    return (sin_th * h_g - cos_th * n_g) / l_i


def is_zero(value: Any) -> bool:  # noqa: ANN401 - a known or a number
    """Return whether a length or angle is zero: absent, or the number zero."""
    return value.is_absent if isinstance(value, TracedValue) else not value


def _moves(rate: Any) -> bool:  # noqa: ANN401 - a known or an array
    # the rate of a crank is absent too, with the value 1
    return not rate.is_absent or rate.value != 0 if isinstance(rate, TracedValue) else rate.ndim > 0


class LinkMotion(NamedTuple):
    """The frame of a link: origin [m], direction [-], first and second rate of rotation [-].

    Of a guide: a point and the direction of its line.
    """

    origin: PointMotion
    cos: Value
    sin: Value
    angle_1: Value
    angle_2: Value

    @property
    def rotates(self) -> bool:
        """Whether the frame rotates; False for a fixed guide."""
        return _moves(self.angle_1)

    @property
    def is_fixed(self) -> bool:
        """Whether the frame neither rotates nor moves."""
        return not (_moves(self.angle_1) or _moves(self.origin.x.position_1))


class Closure(NamedTuple):
    """How well a group closes.

    `value` is zero where the group is singular, negative or NaN where it does not close, shape (n,); `scale` is its
    unit of comparison; `excess` is the missing length, negative for a margin. [m2], [m2], [m]
    """

    value: Array
    scale: float
    excess: Array


def fixed_point(point: Point) -> PointMotion:
    """Return the motion of a fixed point."""
    if is_traced(*point):
        x, y = (Transfer(coordinate, absent("point_x_1"), absent("point_x_2")) for coordinate in point)
        return PointMotion(x, y)
    return PointMotion(Transfer(np.array(point[0]), _ZERO, _ZERO), Transfer(np.array(point[1]), _ZERO, _ZERO))


def fixed_guide(guide: Guide) -> LinkMotion:
    """Return the motion of a fixed guide."""
    if is_traced(guide.angle):
        cos, sin = plane.cosine_of_direction(guide.angle), plane.sine_of_direction(guide.angle)
        return LinkMotion(fixed_point(guide.point), cos, sin, absent("link_angle_1"), absent("link_angle_2"))
    cos, sin = np.array(math.cos(guide.angle)), np.array(math.sin(guide.angle))
    return LinkMotion(fixed_point(guide.point), cos, sin, _ZERO, _ZERO)


def crank_motion(crank: Crank, grid: CrankGrid) -> LinkMotion:
    """Return the motion of the crank, its frame at the pivot."""
    cos, sin = grid.cos, grid.sin if crank.direction == 1 else -grid.sin
    if not is_zero(crank.start):
        cos_start, sin_start = plane.cosine_of_direction(crank.start), plane.sine_of_direction(crank.start)
        cos_start, sin_start = named(cos_start, "line_cos.crank"), named(sin_start, "line_sin.crank")
        cos, sin = (
            plane.cosine_of_turned(cos_start, cos, sin_start, sin), plane.sine_of_turned(sin_start, cos, cos_start, sin)
        )  # fmt: skip
    if is_traced(cos):
        forward = absent("link_angle_1", 1.0) if crank.direction == 1 else given("link_angle_1", -1.0)
        return LinkMotion(fixed_point(crank.pivot), cos, sin, forward, absent("link_angle_2"))
    rate = np.full_like(cos, crank.direction)
    return LinkMotion(fixed_point(crank.pivot), cos, sin, rate, np.zeros_like(cos))


def pin_on_crank(crank: Crank, link: LinkMotion) -> PointMotion:
    """Return the motion of the crank pin, given that of the crank. [m]"""
    x, y = crank.pivot
    arm_x, arm_y = named(crank.radius * link.cos, "arm_x.crank"), named(crank.radius * link.sin, "arm_y.crank")
    x_1, y_1 = (-arm_y, arm_x) if crank.direction == 1 else (arm_y, -arm_x)
    return PointMotion(Transfer(x + arm_x, x_1, -arm_x), Transfer(y + arm_y, y_1, -arm_y))


def point_on_link(link: LinkMotion, along: Value, across: Value, name: str = "") -> PointMotion:
    """Return the motion of a point that moves with a link. [m]

    r = o + d, r' = o' + J d theta', r'' = o'' + J d theta'' - d theta'^2.
    """
    (x, x_1, x_2), (y, y_1, y_2) = link.origin
    if is_traced(along) and is_zero(along) and is_zero(across):
        return link.origin
    if is_zero(across):
        dx, dy = along * link.cos, along * link.sin
    else:
        dx = plane.arm_along_x(along, link.cos, across, link.sin)
        dy = plane.arm_along_y(along, link.sin, across, link.cos)
    dx, dy = named(dx, f"arm_x.{name}"), named(dy, f"arm_y.{name}")
    if not link.rotates:
        return PointMotion(Transfer(x + dx, x_1, x_2), Transfer(y + dy, y_1, y_2))
    return point_of_link(link, dx, dy)


def point_of_link(link: LinkMotion, dx: Value, dy: Value) -> PointMotion:
    """Return the motion of the point of a turning link at the end of an arm from its origin. [m]"""
    (x, x_1, x_2), (y, y_1, y_2) = link.origin
    rate, rate_1 = link.angle_1, link.angle_2
    return PointMotion(
        Transfer(x + dx, plane.carried_x_1(x_1, rate, dy), plane.carried_x_2(x_2, rate_1, dy, rate, dx)),
        Transfer(y + dy, plane.carried_y_1(y_1, rate, dx), plane.carried_y_2(y_2, rate_1, dx, rate, dy)),
    )


def rotated_frame(link: LinkMotion, angle: float, name: str = "line") -> LinkMotion:
    """Return a frame with the same origin, its x axis at an angle to that of the link. [rad]"""
    if is_zero(angle):
        return link
    if not is_traced(angle) and abs(angle) == math.pi:
        return link._replace(cos=-link.cos, sin=-link.sin)
    cos, sin = plane.cosine_of_direction(angle), plane.sine_of_direction(angle)
    cos, sin = named(cos, f"line_cos.{name}"), named(sin, f"line_sin.{name}")
    return link._replace(
        cos=plane.cosine_of_turned(cos, link.cos, sin, link.sin), sin=plane.sine_of_turned(sin, link.cos, cos, link.sin)
    )


def guide_on_link(link: LinkMotion, guide: Guide) -> LinkMotion:
    """Return the motion of a guide that a link carries."""
    return rotated_frame(link, guide.angle)._replace(origin=point_on_link(link, *guide.point))


def in_link_frame(link: LinkMotion, point: PointMotion) -> PointMotion:
    """Return the motion of a point in the frame of a link: its coordinates along and across it. [m]

    Their derivatives are relative ones: guiding and Coriolis parts are removed.
    """
    cos, sin = link.cos, link.sin
    (x, x_1, x_2), (y, y_1, y_2) = point
    base_x, base_y = link.origin
    x, y = x - base_x.position, y - base_y.position
    if not link.is_fixed:
        x_1, y_1 = x_1 - base_x.position_1, y_1 - base_y.position_1
        x_2, y_2 = x_2 - base_x.position_2, y_2 - base_y.position_2
    along, across = plane.along_guide(x, cos, y, sin), plane.across_guide(y, cos, x, sin)
    if link.rotates:
        rate, rate_1 = link.angle_1, link.angle_2
        along_1 = plane.along_turning_1(x_1, cos, y_1, sin, rate, across)
        across_1 = plane.across_turning_1(y_1, cos, x_1, sin, rate, along)
        along_2 = plane.along_turning_2(x_2, cos, y_2, sin, rate, across_1, rate_1, across, along)
        across_2 = plane.across_turning_2(y_2, cos, x_2, sin, rate, along_1, rate_1, along, across)
    else:
        along_1, across_1 = plane.along_guide(x_1, cos, y_1, sin), plane.across_guide(y_1, cos, x_1, sin)
        along_2, across_2 = plane.along_guide(x_2, cos, y_2, sin), plane.across_guide(y_2, cos, x_2, sin)
    return PointMotion(Transfer(along, along_1, along_2), Transfer(across, across_1, across_2))


def point_on_guide(guide: LinkMotion, slide: Transfer) -> PointMotion:
    """Return the motion of a point that slides along a guide, with its Coriolis part where the guide turns."""
    s, s_1, s_2 = slide
    cos, sin = guide.cos, guide.sin
    (x, x_1, x_2), (y, y_1, y_2) = guide.origin
    place_x, place_y = plane.slid_x(x, cos, s), plane.slid_y(y, sin, s)
    if guide.is_fixed:
        return PointMotion(Transfer(place_x, cos * s_1, cos * s_2), Transfer(place_y, sin * s_1, sin * s_2))
    if not guide.rotates:
        return PointMotion(
            Transfer(place_x, plane.slid_x(x_1, cos, s_1), plane.slid_x(x_2, cos, s_2)),
            Transfer(place_y, plane.slid_y(y_1, sin, s_1), plane.slid_y(y_2, sin, s_2)),
        )
    rate, rate_1 = guide.angle_1, guide.angle_2
    return PointMotion(
        Transfer(
            place_x,
            plane.slid_x_1(x_1, cos, s_1, sin, s, rate),
            plane.slid_x_2(x_2, cos, s_2, s, rate, sin, s_1, rate_1),
        ),
        Transfer(
            place_y,
            plane.slid_y_1(y_1, sin, s_1, cos, s, rate),
            plane.slid_y_2(y_2, sin, s_2, s, rate, cos, s_1, rate_1),
        ),
    )


Through = Callable[[str, Any], Any]


def unchanged(key: str, value: Any) -> Any:  # noqa: ANN401, ARG001 - a known or a number stays what it is
    """Return a quantity of a dyad without change points."""
    return value


class DrivenAngle(NamedTuple):
    """Area and rates of an RRR dyad whose inner angle is the driver's coordinate."""

    area: Value  # Twice the area of the triangle, h of the dyad [m2]
    rate_a: Value
    rate_b: Value
    rate_1: Value  # Second rate of both links


class GroupMotion(NamedTuple):
    """Points, frames of links and distances of sliders that a group places, and how well it closes.

    A link between two joints has its line from the known joint to the other one as a frame.
    """

    points: dict[str, PointMotion]
    links: dict[str, LinkMotion]
    sliders: dict[str, Transfer]
    closure: Closure | None


_CONSTANT: Mapping[str, Transfer] = MappingProxyType({})


def rrr_motion(
    dyad: RRR,
    a: PointMotion,
    b: PointMotion,
    lengths: Mapping[str, Transfer] = _CONSTANT,
    through: Through = unchanged,
    opened: DrivenAngle | None = None,
) -> GroupMotion:
    """Return the motion of the joint and the links of an RRR dyad (artobolevsky_1988, ch. 4).

    Joint [m], frames of the links, closure; NaN where the links do not meet. `through` replaces quantities that are 0/0
    at a change point.

    With d from a to b, u and v from a and b to the joint, and c = (p^2 - q^2 + d^2) / 2:
    h = u x v = branch sqrt(((p + q)^2 - d^2)(d^2 - (p - q)^2)) / 2, twice the area of the triangle, and
    u = (c d + h J d) / d^2. The loop a' + theta_a' J u = b' + theta_b' J v gives theta_a' = (b' - a') v / h and
    theta_b' = (b' - a') u / h, its derivative the same with b'' - a'' + theta_a'^2 u - theta_b'^2 v. `lengths`: of
    links whose length changes; its effect on their ends is subtracted from b' - a' and b'' - a''. `opened`: from a
    motor between the two links.
    """
    name, changing = dyad.point, [lengths.get(link) for link in (dyad.link_a, dyad.link_b)]
    p, q = (
        length if change is None else change.position
        for change, length in zip(changing, (dyad.length_a, dyad.length_b), strict=True)
    )
    (ax, ax_1, ax_2), (ay, ay_1, ay_2) = a
    (bx, bx_1, bx_2), (by, by_1, by_2) = b
    dx, dy = named(bx - ax, f"distance_x.{name}"), named(by - ay, f"distance_y.{name}")
    square = named(joint_distance_square(dx, dy), f"joint_distance_square.{name}")
    h = doubled_area(dyad.branch, p, q, square) if opened is None else opened.area
    h = named(h, f"doubled_area.{name}")
    c, k = named(foot_ratio(p, q, square), f"foot_ratio.{name}"), named(h / square, f"height_ratio.{name}")
    ux, uy = rrr_arm_x(c, dx, k, dy), rrr_arm_y(c, dy, k, dx)
    ux, uy = through("arm_x", ux), through("arm_y", uy)
    ux, uy = named(ux, f"arm_x.{dyad.link_a}"), named(uy, f"arm_y.{dyad.link_a}")
    vx, vy = named(ux - dx, f"arm_x.{dyad.link_b}"), named(uy - dy, f"arm_y.{dyad.link_b}")

    cos_a, sin_a, cos_b, sin_b = ux / p, uy / p, vx / q, vy / q
    ex, ey = bx_1 - ax_1, by_1 - ay_1
    for changing_length, cos, sin, sign in zip(changing, (cos_a, cos_b), (sin_a, sin_b), (-1.0, 1.0), strict=True):
        if changing_length is not None:
            ex, ey = ex + sign * (changing_length.position_1 * cos), ey + sign * (changing_length.position_1 * sin)
    ex, ey = named(ex, f"distance_x_1.{name}"), named(ey, f"distance_y_1.{name}")
    if opened is None:
        rate_a, rate_b = rrr_rate(ex, vx, ey, vy, h), rrr_rate(ex, ux, ey, uy, h)
    else:
        rate_a, rate_b = opened.rate_a, opened.rate_b
    rate_a, rate_b = through("rate_a", rate_a), through("rate_b", rate_b)
    rate_a, rate_b = named(rate_a, f"link_angle_1.{dyad.link_a}"), named(rate_b, f"link_angle_1.{dyad.link_b}")
    ex, ey = bx_2 - ax_2, by_2 - ay_2
    turning = ((rate_a, cos_a, sin_a, -1.0), (rate_b, cos_b, sin_b, 1.0))
    for changing_length, (rate, cos, sin, sign) in zip(changing, turning, strict=True):
        if changing_length is not None:
            stretch = stretch_of(changing_length, rate, cos, sin, name)
            ex, ey = ex + sign * stretch[0], ey + sign * stretch[1]
    ex = named(closing_x(ex, rate_a, ux, rate_b, vx), f"closing_x.{name}")
    ey = named(closing_x(ey, rate_a, uy, rate_b, vy), f"closing_y.{name}")
    if opened is None:
        rate_a_1, rate_b_1 = rrr_rate(ex, vx, ey, vy, h), rrr_rate(ex, ux, ey, uy, h)
    else:
        rate_a_1 = rate_b_1 = opened.rate_1
    rate_a_1, rate_b_1 = through("rate_a_1", rate_a_1), through("rate_b_1", rate_b_1)
    rate_a_1, rate_b_1 = named(rate_a_1, f"link_angle_2.{dyad.link_a}"), named(rate_b_1, f"link_angle_2.{dyad.link_b}")

    link_a = LinkMotion(a, cos_a, sin_a, rate_a, rate_a_1)
    link_b = LinkMotion(b, cos_b, sin_b, rate_b, rate_b_1)
    point = point_of_link(link_a, ux, uy) if changing[0] is None else point_of_link(link_b, vx, vy)
    closure = _rrr_closure(p, q, square, is_opened=opened is not None)
    return GroupMotion({name: point}, {dyad.link_a: link_a, dyad.link_b: link_b}, {}, closure)


def stretch_of(length: Transfer, rate: Value, cos: Value, sin: Value, name: str) -> tuple[Value, Value]:
    """Return the terms that a changing length adds to the second derivative of the end of its link. [m]"""
    _, length_1, length_2 = length
    x = plane.stretched_x(length_2, cos, length_1, rate, sin)
    y = plane.stretched_y(length_2, sin, length_1, rate, cos)
    return named(x, f"stretch_x.{name}"), named(y, f"stretch_y.{name}")


def _largest(value: Any) -> float:  # noqa: ANN401 - a float, a column or a complex step
    return value if np.ndim(value) == 0 else float(np.max(value))


def _rrr_closure(p: Value, q: Value, square: Value, *, is_opened: bool) -> Closure | None:
    if is_traced(square):
        return None
    if is_opened:
        # singular only where the outer joints coincide
        return Closure(square, _largest((p + q) ** 2), square)
    return Closure(((p + q) ** 2 - square) * (square - (p - q) ** 2), _largest((2 * p * q) ** 2), square)


def rrp_motion(
    dyad: RRP,
    joint: PointMotion,
    guide: LinkMotion,
    lengths: Mapping[str, Transfer] = _CONSTANT,
    through: Through = unchanged,
) -> GroupMotion:
    """Return the motion of the slider and the link of an RRP dyad (artobolevsky_1988, ch. 4).

    Slider point, distance along the guide [m], frames, closure; NaN where the link does not reach the guide.

    Seen from the guide the joint has the coordinates s_joint and u; the link gives u^2 + h^2 = l^2 and
    s = s_joint + h with the sign of h the branch. Its angle to the guide has the derivative g' = -u' / h, so that
    h' = g' u. Coriolis enters through u' and u'', which are those seen from the guide. `lengths`: of links whose
    length changes; what it adds along and across the guide is added there.
    """
    link_, piece, changing = dyad.link, dyad.piece, lengths.get(dyad.link)
    length = dyad.length if changing is None else changing.position
    (along, along_1, along_2), (u, u_1, u_2) = named_coordinates(in_link_frame(guide, joint), dyad.joint)
    h = named(through("reach", rrp_reach(dyad.branch, length, u)), f"guide_reach.{piece}")
    if changing is not None:
        along_1, u_1 = along_1 + changing.position_1 * (h / length), u_1 - changing.position_1 * (u / length)
    rate = named(through("rate", rrp_rate(u_1, h)), f"guide_rate.{link_}")
    h_1 = named(rate * u, f"guide_reach_1.{piece}")
    if changing is not None:
        stretch = stretch_of(changing, rate, h / length, -u / length, link_)
        along_2, u_2 = along_2 + stretch[0], u_2 + stretch[1]
    rate_1 = named(through("rate_1", rrp_rate_1(u_2, rate, h_1, h)), f"guide_rate_1.{link_}")
    slide = named_slide(Transfer(along + h, along_1 + h_1, rrp_slide_2(along_2, rate_1, u, rate, u_1)), piece)
    cos, sin = guide.cos, guide.sin
    cos, sin = rrp_cosine(cos, h, sin, u, length), rrp_sine(sin, h, cos, u, length)
    if guide.rotates:
        rate, rate_1 = rate + guide.angle_1, rate_1 + guide.angle_2
    point = point_on_guide(guide, slide)
    link = LinkMotion(joint, cos, sin, rate, rate_1)
    closure = None if is_traced(u) else Closure((length - u) * (length + u), _largest(length**2), u)
    links = {link_: link, piece: guide._replace(origin=point)}
    return GroupMotion({dyad.slider: point}, links, {piece: slide}, closure)


def named_coordinates(seen: PointMotion, name: str) -> PointMotion:
    """Return coordinates along and across a guide under the name of their point."""
    if not is_traced(*seen.x):
        return seen
    sides = zip(("guide_along", "guide_across"), seen, strict=True)
    return PointMotion(*(Transfer(*_ordered(side, key, name)) for key, side in sides))


def named_slide(slide: Transfer, piece: str) -> Transfer:
    """Return the distance of a sliding piece under its name."""
    return Transfer(*_ordered(slide, "slider_displacement", piece)) if is_traced(*slide) else slide


def _ordered(transfer: Transfer, key: str, name: str) -> list[Any]:
    return [named(value, f"{key}{order}.{name}") for value, order in zip(transfer, ("", "_1", "_2"), strict=True)]


def named_point(point: PointMotion, name: str) -> PointMotion:
    """Return the motion of a point under its name."""
    if not is_traced(*point.x, *point.y):
        return point
    x, y = (Transfer(*_ordered(side, f"point_{axis}", name)) for axis, side in zip("xy", point, strict=True))
    return PointMotion(x, y)


def named_link(link: LinkMotion, name: str) -> LinkMotion:
    """Return a frame under the name of its link."""
    if not is_traced(*link[1:]):
        return link
    keys = ("link_cos", "link_sin", "link_angle_1", "link_angle_2")
    return LinkMotion(link.origin, *(named(value, f"{key}.{name}") for key, value in zip(keys, link[1:], strict=True)))


# beyond every angle, and a multiple of a turn so that no column has a breakpoint there
BEYOND = 360e3
_OFFSET = 1e-3


def branch_sign(passage: ChangePointPassage, branch: Any, grid: CrankGrid) -> Any:  # noqa: ANN401 - a known or a number
    """Return the branch of a dyad at crank angles; it changes at each change point."""
    if not is_traced(branch):
        return branch * passage.signs(grid.degrees)
    ends = np.array([*passage.changes, BEYOND])
    # the sign of each interval is sampled inside it
    signs = passage.signs(np.array([*(change - _OFFSET for change in passage.changes), passage.changes[-1] + _OFFSET]))
    signs = signs * branch.value
    laws = [absent("branch", 1.0) if sign > 0 else given("branch", -1.0) for sign in signs]
    return TracedValue(Piecewise(ends.tolist(), tuple(laws)), "branch")


def change_point_replacement(passage: ChangePointPassage, grid: CrankGrid) -> Through:
    """Return the function that replaces quantities of a dyad near its change points by polynomials."""

    def through(key: str, value: Any) -> Any:  # noqa: ANN401 - a known or a number
        if is_traced(value):
            return _traced(passage, key, value)
        value, local = np.array(value + np.zeros_like(grid.degrees)), passage.within(grid.degrees)
        for bridge in passage.bridges:
            near = np.abs(local - bridge.degrees) <= bridge.width
            value[near] = bridge.columns[key](local[near])
        return value

    return through


def _traced(passage: ChangePointPassage, key: str, known: TracedValue) -> TracedValue:
    """Return a traced quantity: polynomials near change points, the formula elsewhere."""
    ends, laws = [], []
    for bridge in passage.bridges:
        ends += [bridge.degrees - bridge.width, bridge.degrees + bridge.width]
        laws += [known, TracedValue(Tabulated(bridge.columns[key], "change_point"), known.key)]
    return TracedValue(Piecewise([*ends, BEYOND], (*laws, known)), known.key)
