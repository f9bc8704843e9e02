"""Joint forces of the five dyads in closed form.

Each takes the wrenches on its two links, with moments about the origins of their frames, and gives the force in its
inner joint and in the two outer ones, on the first link of each joint (see `mechanism.joints`).
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from crankwork.dynamics.link_loads import Wrench, moment_about
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import named
from crankwork.kinematics.plane_motion import across_guide, along_guide
from crankwork.kinematics.sliding_dyads import sine_between

Vector = tuple[Value, Value]
_STATICS = "artobolevsky_1988, ch. 13"


@formula("doubled_area", _STATICS)
def area_of_arms(r_x: Value, r_ky: Value, r_y: Value, r_kx: Value) -> Value:
    """Twice the area between the arms of two links, signed."""
    return r_x * r_ky - r_y * r_kx


@formula("joint_force_x", _STATICS)
def rrr_inner_force(M_1: Value, r_kx: Value, M_2: Value, r_x: Value, S_sq: Value) -> Value:
    """Component of the force in the inner joint of an RRR dyad, from the moments about its outer joints."""
    return (M_1 * r_kx + M_2 * r_x) / S_sq


@formula("force_along", _STATICS)
def force_along(F_x: Value, cos_th: Value, F_y: Value, sin_th: Value) -> Value:
    """Component of a force along a guide."""
    return F_x * cos_th + F_y * sin_th


@formula("force_across", _STATICS)
def force_across(F_y: Value, cos_th: Value, F_x: Value, sin_th: Value) -> Value:
    """Component of a force across a guide."""
    return F_y * cos_th - F_x * sin_th


@formula("force_across", _STATICS)
def rrp_inner_force(M_1: Value, n_g: Value, R_t: Value, s_g: Value) -> Value:
    """Component across the guide of the force in the inner joint of an RRP dyad, from the moment on its link."""
    return (M_1 + n_g * R_t) / s_g


@formula("joint_force_x", _STATICS)
def force_along_x(R_t: Value, cos_th: Value, R_n: Value, sin_th: Value) -> Value:
    """Component along x of a force given along and across a guide."""
    return R_t * cos_th - R_n * sin_th


@formula("joint_force_y", _STATICS)
def force_along_y(R_t: Value, sin_th: Value, R_n: Value, cos_th: Value) -> Value:
    """Component along y of a force given along and across a guide."""
    return R_t * sin_th + R_n * cos_th


@formula("normal_force", _STATICS)
def rpr_normal_force(M_1: Value, M_2: Value, s_g: Value) -> Value:
    """Normal force between the slotted lever of an RPR dyad and its block."""
    return (M_1 + M_2) / s_g


@formula("joint_force_x", _STATICS)
def prp_inner_force(R_t: Value, cos_di: Value, R_k: Value, cos_th: Value, sin_gg: Value) -> Value:
    """Component of the force in the pin of a PRP dyad, from the forces along its guides."""
    return (R_t * cos_di - R_k * cos_th) / sin_gg


class OnGuide(NamedTuple):
    """Normal force on a sliding piece [N] and its moment about the origin of the piece [N m], arrays of shape (n,)."""

    normal: Value
    moment: Value


def rrr_forces(a: Wrench, b: Wrench, u: Vector, v: Vector, name: str = "") -> tuple[Vector, Vector, Vector]:
    """Return the forces on the first link from outside, on the second from the first, on the second from outside. [N]

    Moments of `a` and `b` are about the outer pins, from which `u` and `v` lead to the inner one [m]:
    u x R = M_a and v x R = -M_b give R = (M_a v + M_b u) / (u x v) (artobolevsky_1988, ch. 13).
    """
    area = named(area_of_arms(u[0], v[1], u[1], v[0]), f"doubled_area.{name}.arms")
    inner = _vector(
        name, (rrr_inner_force(a.moment, second, b.moment, first, area) for second, first in zip(v, u, strict=True))
    )
    return _minus(inner, a), inner, _balance(b, inner)


def rrp_forces(link: Wrench, piece: Wrench, u: Vector, t: Vector, name: str = "") -> tuple[Vector, Vector, OnGuide]:
    """Return forces on a link from outside, on its sliding piece from the link, and on the piece from the guide. [N]

    Moments are about the outer and the inner pin, `u` leads from one to the other [m], `t` is the direction of the
    guide. Along the guide the piece gives R_t = -F_t; about the outer pin the link gives u x R = M, hence R_n = (M +
    u_n R_t) / u_t (artobolevsky_1988, ch. 13).
    """
    load = named(force_along(piece.x, t[0], piece.y, t[1]), f"force_along.{name}.piece")
    along, across = named(-load, f"force_along.{name}"), force_across(piece.y, t[0], piece.x, t[1])
    across = named(across, f"force_across.{name}.piece")
    arm_along, arm_across = along_guide(u[0], t[0], u[1], t[1]), across_guide(u[1], t[0], u[0], t[1])
    arm_along, arm_across = named(arm_along, f"guide_along.{name}.arm"), named(arm_across, f"guide_across.{name}.arm")
    pressed = named(rrp_inner_force(link.moment, arm_across, along, arm_along), f"force_across.{name}")
    inner = _vector(name, (force_along_x(along, t[0], pressed, t[1]), force_along_y(along, t[1], pressed, t[0])))
    return _minus(inner, link), inner, OnGuide(-across - pressed, -piece.moment)


def rpr_forces(lever: Wrench, block: Wrench, u: Vector, t: Vector, name: str = "") -> tuple[Vector, OnGuide, Vector]:
    """Return the forces on a block from its pin and from its slot, and on the slotted lever from its pivot. [N]

    Moments are about the pivot of the lever and the pin of the block, `u` leads from one to the other [m], `t` is the
    direction of the slot. The block gives R_t = -F_t and takes its moment from the slot; the lever gives
    N = (M + M_block) / u_t (artobolevsky_1988, ch. 13).
    """
    reach = named(along_guide(u[0], t[0], u[1], t[1]), f"guide_along.{name}.arm")
    normal = named(rpr_normal_force(lever.moment, block.moment, reach), f"normal_force.{name}")
    pressed = -normal * t[1], normal * t[0]
    return _balance(block, pressed), OnGuide(normal, -block.moment), _minus(pressed, lever)


def prp_forces(a: Wrench, b: Wrench, t_a: Vector, t_b: Vector, name: str = "") -> tuple[OnGuide, Vector, OnGuide]:
    """Return forces on the first block from its guide, on the second from the first, on the second from its guide. [N]

    Moments are about the pin. Along the guides R t_a = F_a t_a and R t_b = -F_b t_b (artobolevsky_1988, ch. 13).
    """
    sine = named(sine_between(t_a[0], t_b[1], t_a[1], t_b[0]), f"guide_sine.{name}")
    along_a = named(force_along(a.x, t_a[0], a.y, t_a[1]), f"force_along.{name}")
    along_b = named(-named(force_along(b.x, t_b[0], b.y, t_b[1]), f"force_along.{name}.piece"), f"force_along.{name}.2")
    x = prp_inner_force(along_a, t_b[1], along_b, t_a[1], sine)
    y = prp_inner_force(along_b, t_a[0], along_a, t_b[0], sine)
    x, y = inner = _vector(name, (x, y))
    on_a = OnGuide(force_across(y - a.y, t_a[0], x - a.x, t_a[1]), -a.moment)
    on_b = OnGuide(-force_across(y + b.y, t_b[0], x + b.x, t_b[1]), -b.moment)
    return on_a, inner, on_b


def rpp_forces(
    yoke: Wrench, block: Wrench, u: Vector, slot: Vector, guide: Vector, name: str = ""
) -> tuple[Vector, OnGuide, OnGuide]:
    """Return the forces on a block from its pin and from the slot of its yoke, and on the yoke from its guide. [N]

    Moments are about the origin of the yoke and the pin of the block, `u` leads from one to the other [m]. Along the
    guide the yoke gives N n t = F t with the normal n of the slot; across it and about its origin the rest
    (artobolevsky_1988, ch. 13).
    """
    along = named(force_along(yoke.x, guide[0], yoke.y, guide[1]), f"force_along.{name}")
    sine = named(sine_between(slot[0], guide[1], slot[1], guide[0]), f"guide_sine.{name}")
    normal = named(along / sine, f"normal_force.{name}")
    pressed = -normal * slot[1], normal * slot[0]
    on_yoke = force_across(pressed[1] - yoke.y, guide[0], pressed[0] - yoke.x, guide[1])
    turning = named(moment_about(u[0], pressed[1], u[1], pressed[0]), f"link_moment.{name}.normal")
    moment = -yoke.moment - block.moment + turning
    return _balance(block, pressed), OnGuide(normal, -block.moment), OnGuide(on_yoke, moment)


def _vector(name: str, parts: Iterable[Value]) -> Vector:
    x, y = parts
    return named(x, f"joint_force_x.{name}"), named(y, f"joint_force_y.{name}")


def _minus(reaction: Vector, force: Wrench) -> Vector:
    return reaction[0] - force.x, reaction[1] - force.y


def _balance(force: Wrench, reaction: Vector) -> Vector:
    return -force.x - reaction[0], -force.y - reaction[1]
