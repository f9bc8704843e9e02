"""The operating state of a mechanism, the input of this package."""

from __future__ import annotations

from dataclasses import dataclass

from crankwork.formula.expression import Value
from crankwork.kinematics.motion import Motion
from crankwork.loads.applied_loads import NO_LOADS, AppliedLoads
from crankwork.mechanism.mechanism import Mechanism


@dataclass(frozen=True)
class OperatingState:
    """A mechanism in operation: links, motion, speed and loads."""

    mechanism: Mechanism  # Links, joints and bodies
    motion: Motion
    speed: Value = 0.0  # Angular speed of the crank, shape (n,) [rad/s]
    loads: AppliedLoads = NO_LOADS  # Forces and torques
    angular_acceleration: Value = 0.0  # Angular acceleration of the crank, shape (n,) [rad/s2]
