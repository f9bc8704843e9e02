"""What a machine needs of its motor: power from the mean torque, heating from its rms, overload from its greatest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from crankwork.formula.expression import Value, formula
from crankwork.shaft.curve import Curve


@formula("motor_power", "artobolevsky_1988, ch. 14")
def needed_power(k_s: Value, M_d: Value, w: Value, eta: Value) -> Value:
    """Power of the motor for a torque at the crank."""
    return k_s * M_d * w / eta


@dataclass(frozen=True)
class MotorNeed:
    """What a machine asks of its motor."""

    # Mean and root mean square of the torque at the crank over the cycle [N m]
    mean_torque: float
    rms_torque: float
    # Greatest torque at the crank, and its angle [N m], [rad]
    largest_torque: float
    at_largest: float
    speed: float  # Speed of the crank [rad/s]
    # Power of the motor by the mean and by the rms torque, safety and efficiency included [W]
    mean_power: float
    rms_power: float


def motor_need(load: Curve, speed: float, *, efficiency: float = 1.0, safety: float = 1.0) -> MotorNeed:
    """Return what a load asks of its motor: torques at the crank, powers at the motor (chilikin_sandler_1981, ch. 5).

    The load is the torque that drives the crank against it at constant speed, positive; the method of mean losses is
    taken as rms torque.
    """
    extremes, mean, rms = load.extremes(), load.mean, load.rms
    return MotorNeed(
        mean,
        rms,
        extremes.largest,
        extremes.at_largest,
        speed,
        float(needed_power(safety, mean, speed, efficiency)),
        float(needed_power(safety, rms, speed, efficiency)),
    )


def first_angle_beyond(load: Curve, torque: float) -> float | None:
    """Return the first angle of the cycle where the load exceeds a torque, or None if it never does. [rad]"""
    over = load - torque
    edges = np.unique(np.concatenate([over.angle[:-1], over.zeros()]))
    middles = (edges + np.append(edges[1:], over.angle[-1])) / 2
    beyond = np.flatnonzero(over(middles) > 0)
    return float(edges[beyond[0]]) if beyond.size else None
