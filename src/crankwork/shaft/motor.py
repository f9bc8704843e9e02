"""Motors: the torque that each kind gives at a speed, and their selection."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike

from crankwork.errors import MethodError
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import select
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage
from crankwork.resources import read_resource
from crankwork.shaft.curve import Curve
from crankwork.shaft.flywheel import inertia_on_other_shaft


@formula("synchronous_speed", "chilikin_sandler_1981, ch. 2")
def synchronous_speed(f_m: Value, p_pairs: Value, pi: Value) -> Value:
    """Synchronous speed of an alternating-current motor, 60 f / p in revolutions per minute."""
    return 2 * pi * f_m / p_pairs


@formula("breakdown_slip", "chilikin_sandler_1981, ch. 2")
def breakdown_slip(s_n: Value, lam_m: Value) -> Value:
    """Slip of the greatest torque, from rated slip and overload capacity, stator resistance left out."""
    return s_n * (lam_m + np.sqrt(lam_m**2 - 1))


@formula("motor_torque", "chilikin_sandler_1981, ch. 2")
def kloss_torque(M_k: Value, s_k: Value, slip: Value) -> Value:
    """Torque of an asynchronous motor by the simplified formula of Kloss."""
    return 2 * M_k * slip * s_k / (slip**2 + s_k**2)


class Motor(Protocol):
    """Anything that gives a torque at a speed."""

    def torque(self, speed: ArrayLike) -> Array:
        """Return the torque on its own shaft. [N m]"""
        ...


@dataclass(frozen=True)
class AsynchronousMotor:
    """An induction motor by the formula of Kloss."""

    breakdown_torque: float  # Greatest torque as a motor [N m]
    breakdown_slip: float  # Slip at which it occurs [-]
    synchronous_speed: float  # Speed without load [rad/s]

    @classmethod
    def of_catalogue(
        cls,
        rated_power: float,
        rated_speed: float,
        overload: float,
        *,
        frequency: float = 50.0,
        pole_pairs: int = 2,
    ) -> Self:
        """Return the motor of a line of a catalogue."""
        w_0 = float(synchronous_speed(frequency, pole_pairs, math.pi))
        if not 0 < rated_speed < w_0 or overload <= 1:
            raise MethodError(
                ErrorMessage(
                    "motor_speed",
                    pairs=pole_pairs,
                    idle=w_0 * 30 / math.pi,
                    rated=rated_speed * 30 / math.pi,
                    overload=overload,
                )
            )
        s_n = 1 - rated_speed / w_0
        rated = rated_power / rated_speed
        return cls(overload * rated, float(breakdown_slip(s_n, overload)), w_0)

    def torque(self, speed: ArrayLike) -> Array:
        """Return the torque on its own shaft.

        `speed`: speed of its shaft [rad/s], shape (..., n).
        """
        slip = 1 - np.asarray(speed) / self.synchronous_speed
        return np.asarray(kloss_torque(self.breakdown_torque, self.breakdown_slip, slip))


@dataclass(frozen=True)
class GearedMotor:
    """A motor behind a gear, as the crank feels it."""

    motor: Motor
    ratio: float = 1.0  # Speed of the motor over speed of the crank [-]
    inertia: float = 0.0  # Moment of inertia on the shaft of the motor [kg m2]
    efficiency: float = 1.0  # Of the gear; a braking torque is divided by it [-]

    @property
    def reduced_inertia(self) -> float:
        """Moment of inertia on the crank, J i^2. [kg m2]"""
        return float(inertia_on_other_shaft(self.inertia, self.ratio))

    def torque(self, speed: ArrayLike) -> Array:
        """Return the torque on the crank.

        `speed`: speed of the crank [rad/s], shape (..., n).
        """
        torque = self.ratio * self.motor.torque(self.ratio * np.asarray(speed))
        return np.where(torque > 0, torque * self.efficiency, torque / self.efficiency)


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
def needed_power(k_P: Value, M_d: Value, w: Value, eta: Value) -> Value:
    """Power of the motor for a torque at the crank."""
    return k_P * M_d * w / eta


@formula("motor_ratio", "chilikin_sandler_1981, ch. 2")
def gear_ratio_of_motor(w_s: Value, s_n: Value, w: Value) -> Value:
    """Gear ratio between an asynchronous motor at its rated speed and the crank."""
    return w_s * (1 - s_n) / w


def standard_power(needed: Any) -> Any:  # noqa: ANN401 - a number, or a traced value
    """Return the least power of the standard series that is not below the needed one, infinity beyond it. [W]"""
    size: Any = math.inf
    for power in reversed(_SERIES["powers"]):
        size = select(power * 1e3 * (1 + _ROUNDING) - needed, power * 1e3, size)
    return size


def first_angle_beyond(load: Curve, torque: float) -> float | None:
    """Return the first angle of the cycle where the load exceeds a torque, or None if it never does. [rad]"""
    over = load - torque
    edges = np.unique(np.concatenate([over.angle[:-1], over.zeros()]))
    middles = (edges + np.append(edges[1:], over.angle[-1])) / 2
    beyond = np.flatnonzero(over(middles) > 0)
    return float(edges[beyond[0]]) if beyond.size else None
