"""Selection of a motor: power from the mean torque, and angles where the load is too large for it."""

from __future__ import annotations

import numpy as np

from crankwork.formula.expression import Value, formula
from crankwork.shaft.curve import Curve


@formula("motor_power", "artobolevsky_1988, ch. 14")
def needed_power(k_s: Value, M_d: Value, w: Value, eta: Value) -> Value:
    """Power of the motor for a torque at the crank."""
    return k_s * M_d * w / eta


def first_angle_beyond(load: Curve, torque: float) -> float | None:
    """Return the first angle of the cycle where the load exceeds a torque, or None if it never does. [rad]"""
    over = load - torque
    edges = np.unique(np.concatenate([over.angle[:-1], over.zeros()]))
    middles = (edges + np.append(edges[1:], over.angle[-1])) / 2
    beyond = np.flatnonzero(over(middles) > 0)
    return float(edges[beyond[0]]) if beyond.size else None
