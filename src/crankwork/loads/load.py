"""Every kind of load, and the forces and torques that a list of them makes."""

from __future__ import annotations

from collections.abc import Iterable

from crankwork.kinematics.motion import Motion
from crankwork.loads.applied import AppliedLoads, together
from crankwork.loads.process import (
    ForceOnPoint,
    ProcessForce,
    ProcessForceAtPoint,
    TorqueOnLink,
    constant_force,
    link_torque,
    process_force,
    process_force_at_point,
)
from crankwork.loads.spring import SliderSpring, Spring, point_spring, slider_spring
from crankwork.loads.weight import Weight, weight
from crankwork.mechanism.mechanism import Mechanism

__all__ = [
    "ForceOnPoint",
    "Load",
    "ProcessForce",
    "ProcessForceAtPoint",
    "SliderSpring",
    "Spring",
    "TorqueOnLink",
    "Weight",
    "applied_loads",
]

Load = ProcessForce | ProcessForceAtPoint | ForceOnPoint | TorqueOnLink | Spring | SliderSpring | Weight


def applied_loads(mechanism: Mechanism, motion: Motion, loads: Iterable[Load]) -> AppliedLoads:
    """Return the forces at moving points [N] and the torques on links [N m] that act on a mechanism."""
    return together(_applied(load, mechanism, motion, f"loads[{number}]") for number, load in enumerate(loads, start=1))


def _applied(load: Load, mechanism: Mechanism, motion: Motion, path: str) -> AppliedLoads:
    match load:
        case ProcessForce():
            return process_force(load, motion, path)
        case ProcessForceAtPoint():
            return process_force_at_point(load, mechanism, motion, path)
        case ForceOnPoint():
            return constant_force(load, mechanism, motion, path)
        case TorqueOnLink():
            return link_torque(load, motion, path)
        case Spring():
            return point_spring(load, mechanism, motion, path)
        case SliderSpring():
            return slider_spring(load, mechanism, motion, path)
        case Weight():
            return weight(load, mechanism, motion)
