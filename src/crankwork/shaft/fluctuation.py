"""How much the speed of a turning machine fluctuates: formulas, excess work, and the true speed over the cycle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from crankwork.dynamics.reduction import kinetic_energy
from crankwork.errors import MethodError
from crankwork.formula.expression import Value, formula
from crankwork.formula.known import Known
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Refusal
from crankwork.shaft.curve import Curve, Extremes

# of the mean speed, where rounding begins
_SETTLED = 3e-16
_STEPS = 60


@formula("speed", "artobolevsky_1988, ch. 16")
def speed_of_energy(E_k: Value, J: Value) -> Value:
    """Speed of the crank, from the kinetic energy of the machine."""
    return np.sqrt(2 * E_k / J)


@formula("angular_acceleration", "artobolevsky_1988, ch. 16")
def acceleration_of_crank(M_sum: Value, w: Value, J: Value, J_1: Value) -> Value:
    """Angular acceleration of the crank: the equation of motion of a machine with one degree of freedom."""
    return (M_sum - w**2 * J_1 / 2) / J


@formula("speed_fluctuation", "khurmi_gupta_2005, ch. 16")
def fluctuation_of_inertia(L_exc: Value, J: Value, w: Value) -> Value:
    """Fluctuation of the speed of a constant moment of inertia."""
    return L_exc / (J * w**2)


@formula("energy_fluctuation", "khurmi_gupta_2005, ch. 16")
def fluctuation_of_energy(L_exc: Value, W_c: Value) -> Value:
    """Coefficient of fluctuation of energy."""
    return L_exc / W_c


def share_of_work(excess: Known, work: Known) -> Known:
    """Return what part of the work of a cycle, done or taken, the kinetic energy takes and gives."""
    share: Known = fluctuation_of_energy(excess, work if work.value > 0 else -work)
    return share


@dataclass(frozen=True)
class ExcessWork:
    """What the torque does beyond its mean."""

    curve: Curve  # Integral of torque less mean torque, zero at the start of the cycle [J]
    # Where the speed is least and greatest if the moment of inertia is constant [J], [rad]
    extremes: Extremes
    # Mean of the torque, and what it does in a cycle [N m], [J]
    mean_torque: float
    work_per_cycle: float

    @property
    def work(self) -> float:
        """Difference of the extremes. [J]"""
        return self.extremes.largest - self.extremes.least

    @property
    def coefficient(self) -> float:
        """Coefficient of fluctuation of energy; infinite if the torque does no work in a cycle. [-]"""
        if self.work_per_cycle == 0:
            return float("inf")
        return float(fluctuation_of_energy(self.work, abs(self.work_per_cycle)))


def excess_work(torque: Curve) -> ExcessWork:
    """Return the excess work of a torque that a constant one balances.

    Global extremes over all crossings of the mean, exact across the corners of the torque. `torque`: torque of engine
    or load over the crank angle; a load is negative [N m]. Source: khurmi_gupta_2005, ch. 16; artobolevsky_1988, ch.
    16.

    Examples
    --------
    A torque that is 3 N m for a third of the turn and 0 for the rest has 2 N m too much over a third of it.

    >>> third = 2 * np.pi / 3
    >>> excess = excess_work(Curve.linear([0, third, third, 3 * third], [3.0, 3.0, 0.0, 0.0]))
    >>> round(excess.work / third, 12)
    2.0
    """
    mean = torque.mean
    curve = (torque - mean).integral
    closed = Curve(curve.angle, curve.coefficients)
    return ExcessWork(closed, closed.extremes(), mean, mean * torque.cycle)


@dataclass(frozen=True)
class TrueSpeed:
    """Speed over one cycle of steady motion, from the energy."""

    # Moment of inertia with the flywheel, its derivative, excess work, torque less its mean [kg
    # m2], [kg m2/rad], [J], [N m]
    inertia: Curve
    inertia_1: Curve
    excess: Curve
    torque: Curve
    energy: float  # Kinetic energy where the excess work is zero [J]
    extremes: Extremes  # Least and greatest speed, and where [rad/s], [rad]

    @property
    def mean_speed(self) -> float:
        """Mean of the extreme speeds. [rad/s]"""
        return (self.extremes.largest + self.extremes.least) / 2

    @property
    def fluctuation(self) -> float:
        """Largest less least speed, over the mean of the two. [-]"""
        return (self.extremes.largest - self.extremes.least) / self.mean_speed

    def speed(self, angle: ArrayLike) -> Array:
        """Return the speed at crank angles. [rad/s]"""
        return np.asarray(speed_of_energy(self.energy + self.excess(angle), self.inertia(angle)))

    def acceleration(self, angle: ArrayLike) -> Array:
        """Return the angular acceleration at crank angles. [rad/s2]"""
        J, J_1 = self.inertia(angle), self.inertia_1(angle)
        return np.asarray(acceleration_of_crank(self.torque(angle), self.speed(angle), J, J_1))


def true_speed(inertia: Curve, torque: Curve, mean_speed: float, excess_of: ExcessWork | None = None) -> TrueSpeed:
    """Return the speed over one cycle of steady motion, where all torques depend on the angle alone.

    w = sqrt(2 (T_0 + A) / J), with T_0 found from the mean speed. `inertia`: moment of inertia reduced to the crank,
    flywheel included [kg m2]; `torque`: torque over the angle, balanced by a constant one [N m]; `excess_of`: its
    excess work, where that is known already. Source: artobolevsky_1988, ch. 16.
    """
    found = excess_of or excess_work(torque)
    excess, reach, balanced = found.curve, found.extremes, torque - found.mean_torque
    inertia_1 = inertia.derivative
    if not inertia.mean > 0:
        raise MethodError(Refusal("masses_missing"))
    floor = -reach.least
    # what it is with a constant moment of inertia, where the extremes of speed are those of the excess work
    greatest = mean_speed + (reach.largest - reach.least) / (2 * inertia.mean * mean_speed)
    energy = max(float(kinetic_energy(inertia.mean, greatest)) - reach.largest, floor * (1 + 1e-6))
    for _ in range(_STEPS):
        if np.any(inertia_1.coefficients):
            extremes = _speed_extremes(inertia, inertia_1, excess, balanced, energy)
        else:
            low, high = (float(speed_of_energy(energy + one, inertia.mean)) for one in (reach.least, reach.largest))
            extremes = Extremes(low, reach.at_least, high, reach.at_largest)
        miss = (extremes.largest + extremes.least) / 2 - mean_speed
        # the derivative of each extreme speed by the energy is 1 / (J w)
        slope = sum(
            1 / max(float(inertia(at)) * w, 1e-300)
            for w, at in ((extremes.least, extremes.at_least), (extremes.largest, extremes.at_largest))
        )
        following = max(energy - 2 * miss / slope, floor + (energy - floor) / 16)
        if abs(miss) <= _SETTLED * mean_speed or abs(following - energy) <= 4e-16 * energy:
            break
        energy = following
    if abs(miss) <= 1e-12 * mean_speed:
        return TrueSpeed(inertia, inertia_1, excess, balanced, energy, extremes)
    raise MethodError(Refusal("machine_stops", speed=mean_speed, angle=float(np.degrees(extremes.at_least))))


def _speed_extremes(inertia: Curve, inertia_1: Curve, excess: Curve, torque: Curve, energy: float) -> Extremes:
    """Return the extremes of w^2 = 2 (T_0 + A) / J as those of w; its slope has the sign of M J - (T_0 + A) J'."""
    total = excess + energy
    angles = np.sort(np.concatenate([inertia.angle, torque.angle, (torque * inertia - total * inertia_1).zeros()]))
    w = np.sqrt(np.maximum(2 * total(angles) / inertia(angles), 0.0))
    low, high = int(np.argmin(w)), int(np.argmax(w))
    return Extremes(float(w[low]), float(angles[low]), float(w[high]), float(angles[high]))
