"""Which motor a machine needs: power from the mean torque, heating from its rms, overload from its greatest."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from crankwork.errors import MethodError
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


@dataclass(frozen=True)
class CatalogueMotor:
    """A line of a catalogue."""

    name: str  # Its designation
    # Rated power and speed [W], [rad/s]
    power: float
    speed: float
    overload: float  # Greatest torque over rated torque [-]
    inertia: float = 0.0  # Moment of inertia of the rotor [kg m2]

    @property
    def rated_torque(self) -> float:
        """Torque at rated power. [N m]"""
        return self.power / self.speed


@dataclass(frozen=True)
class MotorCheck:
    """Whether a motor does for a machine, and why not."""

    motor: CatalogueMotor
    ratio: float  # Speed of the motor over that of the crank [-]
    load_share: float  # Power that is needed over rated power; at most one [-]
    overload_share: float  # Greatest torque on the shaft of the motor over its greatest; at most one [-]
    message: str  # Empty if it does; else what is too weak, by how much, and where

    @property
    def ok(self) -> bool:
        """Whether it does."""
        return not self.message


def check_motor(need: MotorNeed, motor: CatalogueMotor, *, efficiency: float = 1.0, heating: bool = True) -> MotorCheck:
    """Return whether a motor bears the load: its power, its heating, its greatest torque.

    The efficiency is that from motor to crank. Heating is by the rms torque, as without a flywheel, or by the mean.
    """
    ratio = motor.speed / need.speed
    power = max(need.mean_power, need.rms_power) if heating else need.mean_power
    share = power / motor.power
    overload = need.largest_torque / (ratio * efficiency) / (motor.overload * motor.rated_torque)
    faults = []
    if share > 1:
        faults.append(f"it has {motor.power / 1e3:.4g} kW, the load needs {power / 1e3:.4g} kW")
    if overload > 1:
        faults.append(
            f"its greatest torque at the crank is {need.largest_torque / overload:.4g} N m, and at "
            f"{math.degrees(need.at_largest):.1f} deg the load needs {need.largest_torque:.4g} N m, where it stalls "
            "unless a flywheel helps"
        )
    message = f"{motor.name} is too weak: {'; '.join(faults)}" if faults else ""
    return MotorCheck(motor, ratio, share, overload, message)


def choose_motor(
    need: MotorNeed, catalogue: Iterable[CatalogueMotor], *, efficiency: float = 1.0, heating: bool = True
) -> MotorCheck:
    """Return the smallest motor of a catalogue that does; the efficiency is that from motor to crank."""
    checks = [check_motor(need, one, efficiency=efficiency, heating=heating) for one in catalogue]
    if not checks:
        raise MethodError("the catalogue of motors is empty")
    strong = [one for one in checks if one.ok]
    if strong:
        return min(strong, key=lambda one: (one.motor.power, one.motor.speed))
    best = min(checks, key=lambda one: max(one.load_share, one.overload_share))
    raise MethodError(f"no motor of the catalogue does; {best.message}")


def first_angle_beyond(load: Curve, torque: float) -> float | None:
    """Return the first angle of the cycle where the load exceeds a torque, or None if it never does. [rad]"""
    over = load - torque
    edges = np.unique(np.concatenate([over.angle[:-1], over.zeros()]))
    middles = (edges + np.append(edges[1:], over.angle[-1])) / 2
    beyond = np.flatnonzero(over(middles) > 0)
    return float(edges[beyond[0]]) if beyond.size else None
