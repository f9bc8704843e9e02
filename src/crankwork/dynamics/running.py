"""A mechanism at work, as everything in this room takes it."""

from __future__ import annotations

from dataclasses import dataclass

from crankwork.formula.expression import Value
from crankwork.kinematics.motion import Motion
from crankwork.loads.applied import NO_LOADS, AppliedLoads
from crankwork.mechanism.mechanism import Mechanism


@dataclass(frozen=True)
class Running:
    """A mechanism at work: what it is, how it moves, how fast it runs and what pushes it.

    Parameters
    ----------
    mechanism : Mechanism
        Links, joints and bodies.
    motion : Motion
        Its motion.
    speed : float or array, shape (n,)
        Angular speed of the crank. [rad/s]
    loads : AppliedLoads
        Forces and torques.
    angular_acceleration : float or array, shape (n,)
        Angular acceleration of the crank. [rad/s2]
    """

    mechanism: Mechanism
    motion: Motion
    speed: Value = 0.0
    loads: AppliedLoads = NO_LOADS
    angular_acceleration: Value = 0.0
