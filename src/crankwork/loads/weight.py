"""The weight of the bodies."""

from __future__ import annotations

import math
from dataclasses import dataclass

from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import given, is_traced, named
from crankwork.kinematics.bodies import broadcast, centre_of_mass
from crankwork.kinematics.motion import Motion
from crankwork.loads.applied_loads import AppliedForce, AppliedLoads
from crankwork.mechanism.mechanism import Mechanism
from crankwork.method import STANDARD_GRAVITY


@dataclass(frozen=True)
class Weight:
    """Gravity on every body."""

    gravity: float = STANDARD_GRAVITY  # Acceleration of free fall [m/s2]
    direction: float = -math.pi / 2  # Where it pulls, from the x axis [rad]


@formula("load_x", "artobolevsky_1988, ch. 12")
def weight_along(m_i: Value, g: Value, cos_ga: Value) -> Value:
    """Component of a weight along a fixed axis."""
    return m_i * g * cos_ga


def weight(load: Weight, mechanism: Mechanism, motion: Motion) -> AppliedLoads:
    """Return the weights of the bodies of a mechanism."""
    gravity: Value = load.gravity
    if is_traced(motion.grid.angle):
        gravity = given("gravity", load.gravity, "method.gravity")
    forces = []
    for body in mechanism.bodies:
        x, y = (weight_along(body.mass, gravity, part) for part in (math.cos(load.direction), math.sin(load.direction)))
        x, y = named(x, f"load_x.{body.link}.weight"), named(y, f"load_y.{body.link}.weight")
        forces.append(
            AppliedForce(body.link, centre_of_mass(body, motion), broadcast(x, motion.grid), broadcast(y, motion.grid))
        )
    return AppliedLoads(tuple(forces))
