"""The weight of the bodies."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from crankwork.kinematics.bodies import centre_of_mass
from crankwork.kinematics.motion import Motion
from crankwork.loads.applied import AppliedForce, AppliedLoads
from crankwork.mechanism.mechanism import Mechanism
from crankwork.method import STANDARD_GRAVITY


@dataclass(frozen=True)
class Weight:
    """Gravity on every body.

    Parameters
    ----------
    gravity : float
        Acceleration of free fall. [m/s2]
    direction : float
        Where it pulls, from the x axis. [rad]
    """

    gravity: float = STANDARD_GRAVITY
    direction: float = -math.pi / 2


def weight(load: Weight, mechanism: Mechanism, motion: Motion) -> AppliedLoads:
    """Return the weights of the bodies of a mechanism.

    Parameters
    ----------
    load : Weight
        Gravity.
    mechanism : Mechanism
        Whose bodies they are.
    motion : Motion
        Where they are.
    """
    still = np.zeros_like(motion.grid.angle)
    cos, sin = math.cos(load.direction), math.sin(load.direction)
    return AppliedLoads(
        tuple(
            AppliedForce(
                body.link,
                centre_of_mass(body, motion),
                still + body.mass * load.gravity * cos,
                still + body.mass * load.gravity * sin,
            )
            for body in mechanism.bodies
        )
    )
