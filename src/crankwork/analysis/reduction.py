"""A crank gear as one turning mass: its reduced moment of inertia."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.dynamics.reduction import reduced_inertia_1_of_body, reduced_inertia_of_body
from crankwork.formula.traced_value import TracedValue, absent, total
from crankwork.preparation.piston_kinematics import CylinderKinematics

REDUCTION = ("reduced_inertia", "reduced_inertia_1")
MOVING = ("of_piston", "of_rod", "knuckle_pins")


def cylinder_reduction(moving: CylinderKinematics) -> Iterator[TracedValue]:
    """Yield the reduced moment of inertia of a crank gear and its derivative, part by part (artobolevsky_1988, ch. 15).

    The rod is the two masses that the forces take it for, with its excess of inertia where they take that.
    """
    trace, none = moving.trace, absent("")
    (_, x_1, x_2), (_, beta_1, beta_2), *_ = moving.motion
    bodies = {"of_piston": (trace["reciprocating_mass"], x_1, x_2, none, none, none, none, none)}
    if "correction_couple" in trace:
        bodies["of_rod"] = (none, none, none, none, none, trace["rod_inertia_excess"], beta_1, beta_2)
    if moving.articulated_rod is not None:
        (_, x_A1, x_A2), (_, y_A1, y_A2) = moving.articulated_rod.knuckle
        bodies["knuckle_pins"] = (trace["knuckle_mass"], x_A1, x_A2, y_A1, y_A2, none, none, none)
    parts, parts_1 = [], []
    for name, (m, u_1, u_2, v_1, v_2, J, turn_1, turn_2) in bodies.items():
        parts.append(reduced_inertia_of_body(m, u_1, v_1, J, turn_1).named(f"reduced_inertia.{name}"))
        part_1 = reduced_inertia_1_of_body(m, u_1, u_2, v_1, v_2, J, turn_1, turn_2)
        parts_1.append(part_1.named(f"reduced_inertia_1.{name}"))
    if "rotating_mass" in trace:
        r = trace["crank_radius"]
        parts.append((trace["rotating_mass"] * r * r).named("reduced_inertia.rotating"))
    yield from (*parts, *parts_1, total("reduced_inertia", parts), total("reduced_inertia_1", parts_1))
