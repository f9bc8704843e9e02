"""Every kind of load, and the forces and torques that a list of them makes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol, runtime_checkable

from crankwork.formula.expression import Value
from crankwork.kinematics.motion import Motion
from crankwork.loads.applied_loads import AppliedLoads, combine_loads, force_at
from crankwork.loads.damper import Damper, SliderDamper, point_damper, slider_damper
from crankwork.loads.process import ForceOnPoint, ProcessForce, TorqueOnLink, constant_force, link_torque, process_force
from crankwork.loads.spring import SliderSpring, Spring, point_spring, slider_spring
from crankwork.loads.weight import Weight, weight
from crankwork.mechanism.mechanism import Mechanism

__all__ = [
    "Damper",
    "ForceOnPoint",
    "Load",
    "LoadLaw",
    "ProcessForce",
    "SliderDamper",
    "SliderSpring",
    "Spring",
    "TorqueOnLink",
    "Weight",
    "applied_loads",
    "force_at",
]


@runtime_checkable
class LoadLaw(Protocol):
    """A load of one's own: what it puts on the links, wherever they are.

    Examples
    --------
    A pull on point C that grows with its distance from the origin:

    >>> class Tether:
    ...     def forces(self, mechanism, motion, speed):
    ...         at = motion.points["C"]
    ...         return force_at(mechanism, motion, "C", (-50.0 * at.x.position, -50.0 * at.y.position))
    >>> isinstance(Tether(), LoadLaw)
    True
    """

    def forces(self, mechanism: Mechanism, motion: Motion, speed: Value) -> AppliedLoads:
        """Return forces at moving points [N] and torques on links [N m]; `speed`: of the driver [rad/s] or [m/s]."""


Load = (
    ProcessForce | ForceOnPoint | TorqueOnLink | Spring | SliderSpring | Damper | SliderDamper
    | Weight | LoadLaw
)  # fmt: skip


def applied_loads(mechanism: Mechanism, motion: Motion, loads: Iterable[Load], speed: Value = 0.0) -> AppliedLoads:
    """Return the forces at moving points [N] and the torques on links [N m] that act on a mechanism.

    `speed`: rate of the driver's coordinate, which dampers follow [rad/s] or [m/s].
    """
    return combine_loads(
        _applied(load, mechanism, motion, speed, f"loads[{number}]") for number, load in enumerate(loads, start=1)
    )


def _applied(load: Load, mechanism: Mechanism, motion: Motion, speed: Value, path: str) -> AppliedLoads:
    match load:
        case ProcessForce():
            return process_force(load, motion, path)
        case ForceOnPoint():
            return constant_force(load, mechanism, motion, path)
        case TorqueOnLink():
            return link_torque(load, motion, path)
        case Spring():
            return point_spring(load, mechanism, motion, path)
        case SliderSpring():
            return slider_spring(load, mechanism, motion, path)
        case Damper():
            return point_damper(load, mechanism, motion, speed, path)
        case SliderDamper():
            return slider_damper(load, mechanism, motion, speed, path)
        case Weight():
            return weight(load, mechanism, motion)
    return load.forces(mechanism, motion, speed)
