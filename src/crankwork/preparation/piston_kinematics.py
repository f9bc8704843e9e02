"""The motion of piston and rod of one cylinder, traced from the lengths on."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from crankwork.cylinders.articulated import ArticulatedMotion, ArticulatedRod, articulated_motion
from crankwork.dynamics.piston_forces import piston_acceleration, piston_velocity
from crankwork.formula.expression import Value
from crankwork.formula.traced_value import TracedAngle, TracedValue, absent, given
from crankwork.kinematics.kinematic_coefficients import Transfer
from crankwork.kinematics.piston import PistonMotion, piston_motion, textbook_piston
from crankwork.kinematics.series import acceleration_harmonics, order_terms, traced_order
from crankwork.kinematics.slider_crank import SliderCrank, pin_distance, rod_angular_acceleration, rod_angular_velocity
from crankwork.machine import Machine
from crankwork.method import Method
from crankwork.preparation import traced_inputs

if TYPE_CHECKING:
    from crankwork.preparation.prepared import PreparedCylinder

KINEMATICS = (
    "piston_displacement", "piston_velocity", "piston_acceleration",
    "rod_angle", "rod_angular_velocity", "rod_angular_acceleration",
)  # fmt: skip
HARMONICS = tuple(
    f"piston_{noun}_{order}_order"
    for noun in ("displacement", "velocity", "acceleration")
    for order in ("first", "second")
)


class CylinderKinematics(NamedTuple):
    """A cylinder in motion: inputs, motion, and all traced values by key so far."""

    angle: Value
    lengths: SliderCrank
    speed: TracedValue
    angular_acceleration: TracedValue
    motion: PistonMotion
    trace: dict[str, TracedValue]
    articulated_rod: ArticulatedMotion | None = None


def moving_cylinder(
    machine: Machine, method: Method, sizes: SliderCrank, rod: ArticulatedRod | None = None
) -> CylinderKinematics:
    """Return the motion of a cylinder by a method, traced; `rod` is its own where that hangs on the master rod."""
    angle: Value = TracedAngle()
    lengths, speed = traced_inputs.lengths(machine, sizes), traced_inputs.speed(machine, method)
    eps = traced_inputs.acceleration(machine)
    if rod is None:
        articulated_rod, motion = None, piston_motion(lengths, angle, method)
    else:
        articulated_rod = articulated_motion(lengths, rod, angle)
        motion = PistonMotion(articulated_rod.piston, articulated_rod.rod, articulated_rod.swing)
    trace = {item.key: item for item in (lengths.crank_radius, lengths.rod_length, lengths.offset, speed)}
    return CylinderKinematics(
        angle, lengths, speed, eps, motion, trace | _motion(motion, speed, eps, angle, lengths), articulated_rod
    )


def _motion(
    motion: PistonMotion, w: TracedValue, eps: TracedValue, angle: Value, lengths: SliderCrank
) -> dict[str, TracedValue]:
    (x, x_1, x_2), (beta, beta_1, beta_2), swing = motion
    values = [
        angle.angle.named("crank_angle"),
        *(item.named(key) for item, key in zip(swing, _SWING, strict=True)),
        *(item.named(key) for item, key in zip((x, x_1, x_2), _PISTON, strict=True)),
        beta.named("rod_angle"), beta_1.named("rod_transfer_1"), beta_2.named("rod_transfer_2"),
        piston_velocity(x_1, w), piston_acceleration(x_2, w, x_1, eps),
        rod_angular_velocity(beta_1, w), rod_angular_acceleration(beta_2, w, beta_1, eps),
        pin_distance(lengths.crank_radius, angle.cos, lengths.rod_length, swing.cos),
    ]  # fmt: skip
    return {item.key: item for item in values}


_SWING = ("rod_sine", "rod_cosine", "crank_rod_sine", "crank_rod_cosine")
_PISTON = ("piston_displacement", "piston_transfer_1", "piston_transfer_2")


def inertia_acceleration(solved: PreparedCylinder) -> TracedValue:
    """Return the acceleration behind the inertia force, with its own rod ratio where a document has one."""
    moving = solved.moving
    ratio = solved.method.inertia_rod_ratio
    if ratio is None or ratio == solved.lengths.rod_ratio or solved.method.is_exact:
        return moving.trace["piston_acceleration"]
    (r, _, e), lam = moving.lengths, given("rod_ratio.inertia", ratio, "method.inertia_rod_ratio")
    own = SliderCrank(r, (r / lam).named("rod_length.inertia"), e)
    if solved.method.kinematics == "textbook":
        result = textbook_piston(own, moving.angle, lam)
    else:
        result = piston_motion(own, moving.angle, solved.method).piston
    _, x_1, x_2 = (item.named(f"{key}.inertia") for item, key in zip(result, _PISTON, strict=True))
    acceleration: TracedValue = piston_acceleration(x_2, moving.speed, x_1, moving.angular_acceleration)
    return acceleration.named("inertia_acceleration")


def harmonic_trace(solved: PreparedCylinder) -> dict[str, TracedValue]:
    """Return the first- and second-order parts of displacement, velocity and acceleration: of the textbook its own two.

    Source: kolchin_demidov_2008, ch. 6; taylor_1985, vol. 2, ch. 8.
    """
    moving = solved.moving
    lengths, values = moving.lengths, dict[str, TracedValue]()
    for order, word in ((1, "first_order"), (2, "second_order")):
        x, x_1, x_2 = _order(solved, lengths, moving.angle, order)
        x_1, x_2 = x_1.named(f"piston_transfer_1_{word}"), x_2.named(f"piston_transfer_2_{word}")
        values |= {
            x_1.key: x_1,
            x_2.key: x_2,
            f"piston_displacement_{word}": x.named(f"piston_displacement_{word}"),
            f"piston_velocity_{word}": piston_velocity(x_1, moving.speed).named(f"piston_velocity_{word}"),
            f"piston_acceleration_{word}": piston_acceleration(
                x_2, moving.speed, x_1, moving.angular_acceleration
            ).named(f"piston_acceleration_{word}"),
        }
    return values


def _order(solved: PreparedCylinder, lengths: SliderCrank, angle: Value, order: int) -> Transfer:
    if solved.method.kinematics == "textbook" and lengths.offset.is_absent:
        first = lengths.crank_radius
        coefficient = first if order == 1 else first * lengths.rod_ratio
        return order_terms(angle, order, coefficient, absent(""), (absent("", 1.0), absent("")))
    cosine, sine = acceleration_harmonics(solved.lengths, order)
    a_k, b_k, start = traced_order(lengths, order, (float(cosine[-1]), float(sine[-1])), (1.0, 0.0))
    return order_terms(angle, order, a_k, b_k, start)
