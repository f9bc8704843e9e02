"""Reactions of joints: a force in a pin, a normal force and its moment on a guide."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from crankwork.dynamics.link_loads import Wrench, arm, moment_of
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import TracedValue, is_traced, named
from crankwork.kinematics.kinematic_coefficients import PointMotion
from crankwork.kinematics.motion import Motion, zero_column
from crankwork.mechanism.joints import Joint, Pin, SlidingJoint


@formula("joint_force", "artobolevsky_1988, ch. 13")
def joint_force(R_x: Value, R_y: Value) -> Value:
    """Magnitude of the force in a joint."""
    return np.sqrt(R_x**2 + R_y**2)


@formula("shaking_force", "den_hartog_1956, ch. 5")
def shaking_force(F_sx: Value, F_sy: Value) -> Value:
    """Magnitude of the sum of the inertia forces of all moving masses."""
    return np.sqrt(F_sx**2 + F_sy**2)


class PinForce(NamedTuple):
    """Force of a pin on the link it holds, along the fixed axes, arrays of shape (n,). [N]"""

    joint: Pin
    x: Value
    y: Value

    @property
    def resultant(self) -> Value:
        """Magnitude of the force. [N]"""
        return joint_force(self.x, self.y)


def pin_columns(
    name: str, x: TracedValue, y: TracedValue, size: TracedValue | None = None, kind: str = "joint_force"
) -> dict[str, TracedValue]:
    """Return the force in a joint by key: along the fixed axes, and its size, where that is not taken of these."""
    size = joint_force(x, y) if size is None else size
    values = {f"{kind}_x.{name}": x, f"{kind}_y.{name}": y, f"{kind}.{name}": size}
    return {key: value.named(key) for key, value in values.items()}


class GuideForce(NamedTuple):
    """Normal force of a guide on its piece, to the left of the guide direction [N], and its moment there [N m].

    Both are arrays of shape (n,); the moment is about the origin of the piece, positive anticlockwise.
    """

    joint: SlidingJoint
    normal: Value
    moment: Value


Reaction = PinForce | GuideForce


def joint_place(joint: Joint, motion: Motion) -> PointMotion:
    """Return the position of a joint: its pin, or the origin of its sliding piece."""
    if isinstance(joint, Pin) and joint.point:
        return motion.points[joint.point]
    return motion.frames[joint.link].origin


def reaction_wrench(reaction: Reaction, motion: Motion, link: str) -> Wrench:
    """Return the wrench of a joint on one of its two links.

    Force [N] and moment about the origin of the frame of `link` [N m].
    """
    joint = reaction.joint
    match reaction:
        case PinForce(_, x, y):
            couple = zero_column(motion.grid)
        case GuideForce(_, normal, couple):
            guide = motion.frames[joint.link]
            x, y = -guide.sin * normal, guide.cos * normal
    x, y = named(x, f"joint_force_x.{joint.name}"), named(y, f"joint_force_y.{joint.name}")
    moment = moment_of(arm(motion.frames[link].origin, joint_place(joint, motion)), (x, y), f"{link}.{joint.name}")
    if not (is_traced(couple) and couple.is_absent):
        moment = named(moment + couple, f"link_moment.{link}.{joint.name}.both")
    if link == joint.link:
        return Wrench(x, y, moment)
    x, y, moment = (
        named(-value, f"{key}.{link}.from.{joint.name}")
        for key, value in zip(("link_force_x", "link_force_y", "link_moment"), (x, y, moment), strict=True)
    )
    return Wrench(x, y, moment)


@dataclass(frozen=True)
class JointForces:
    """Reactions in all joints, and the torque or force that the driver needs."""

    pins: Mapping[str, PinForce]  # Forces in the revolute joints by name, arrays of shape (n,) [N]
    # Normal forces and moments of the guides by sliding piece, arrays of shape (n,) [N], [N m]
    guides: Mapping[str, GuideForce]
    balancing_torque: Value  # Torque or force of the driver, positive with its motion, shape (n,) [N m] or [N]
    # Forces across and along the line of centres between teeth, by geared crank, arrays of shape (n,) [N]
    teeth: Mapping[str, tuple[Value, Value]] = field(default_factory=dict)


def collect_reactions(reactions: Mapping[Joint, Reaction], order: tuple[Joint, ...], torque: Value) -> JointForces:
    """Return reactions in the order of the joints."""
    ordered = [reactions[joint] for joint in order]
    pins = {reaction.joint.name: reaction for reaction in ordered if isinstance(reaction, PinForce)}
    guides = {reaction.joint.name: reaction for reaction in ordered if isinstance(reaction, GuideForce)}
    return JointForces(pins, guides, torque)
