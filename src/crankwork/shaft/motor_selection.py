"""Selection of a motor: power, standard size, gear ratio, and angles where the load is too large."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from crankwork.formula.expression import Value, formula
from crankwork.resources import read_resource
from crankwork.shaft.curve import Curve

_SERIES: Mapping[str, Any] = tomllib.loads(read_resource("shaft", "motor_powers.toml"))
POWERS_SOURCE: str = _SERIES["source"]
_ROUNDING = 1e-9
# pairs of poles of the motors that gear ratios are given for
POLE_PAIRS = (1, 2, 3, 4)


class MotorSelection(NamedTuple):
    """What a motor is selected with."""

    reserve: float = 1.0  # Rated power over the power that is needed [-]
    slip: float = 0.04  # At rated power [-]
    frequency: float = 50.0  # Of the mains [Hz]


@formula("motor_power", "artobolevsky_1988, ch. 14")
def needed_power(k_s: Value, M_d: Value, w: Value, eta: Value) -> Value:
    """Power of the motor for a torque at the crank."""
    return k_s * M_d * w / eta


@formula("motor_ratio", "chilikin_sandler_1981, ch. 2")
def gear_ratio_of_motor(w_s: Value, s_n: Value, w: Value) -> Value:
    """Gear ratio between an asynchronous motor at its rated speed and the crank."""
    return w_s * (1 - s_n) / w


def standard_power(needed: float) -> float | None:
    """Return the least power of the standard series that is not below the needed one, None beyond the series. [W]"""
    return next((power * 1e3 for power in _SERIES["powers"] if power * 1e3 >= needed * (1 - _ROUNDING)), None)


def first_angle_beyond(load: Curve, torque: float) -> float | None:
    """Return the first angle of the cycle where the load exceeds a torque, or None if it never does. [rad]"""
    over = load - torque
    edges = np.unique(np.concatenate([over.angle[:-1], over.zeros()]))
    middles = (edges + np.append(edges[1:], over.angle[-1])) / 2
    beyond = np.flatnonzero(over(middles) > 0)
    return float(edges[beyond[0]]) if beyond.size else None
