"""How much the speed of a turning machine fluctuates: formulas, excess work, and the true speed over the cycle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from crankwork.dynamics.reduction import kinetic_energy
from crankwork.errors import MethodError
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import TracedValue
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage
from crankwork.shaft.curve import Curve, Extremes

# the speed that a file states is the mean over the time, or that of the extremes
Mean = Literal["time", "extremes"]

# of the mean speed, where rounding begins
_SETTLED, _EQUAL = 1e-14, 1e-11
_STEPS = 60
# how far the energy may be from that of half the panels, and how often they are halved
_RESOLVED = 1e-14
_HALVINGS = 8
_GAUSS, _WEIGHTS = np.polynomial.legendre.leggauss(8)


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


def share_of_work(excess: TracedValue, work: TracedValue) -> TracedValue:
    """Return the ratio of the excess work to the work of a cycle."""
    share: TracedValue = fluctuation_of_energy(excess, work if work.value > 0 else -work)
    return share


@dataclass(frozen=True)
class ExcessWork:
    """Work of a torque beyond that of its mean."""

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
    fluctuation: float  # Of the books: that at which the mean of the extreme speeds is the mean speed [-]

    def speed(self, angle: ArrayLike) -> Array:
        """Return the speed at crank angles. [rad/s]"""
        return np.asarray(speed_of_energy(self.energy + self.excess(angle), self.inertia(angle)))

    def acceleration(self, angle: ArrayLike) -> Array:
        """Return the angular acceleration at crank angles. [rad/s2]"""
        J, J_1 = self.inertia(angle), self.inertia_1(angle)
        return np.asarray(acceleration_of_crank(self.torque(angle), self.speed(angle), J, J_1))


def true_speed(
    inertia: Curve, torque: Curve, mean_speed: float, excess_of: ExcessWork | None = None, *, mean: Mean = "time"
) -> TrueSpeed:
    """Return the speed over one cycle of steady motion, where all torques depend on the angle alone.

    w = sqrt(2 (T_0 + A) / J), with T_0 found from the mean speed: that over the time, 2 pi over the time of a turn, or
    that of the extremes, which books take. The fluctuation is that of the books in both cases. `inertia`: moment of
    inertia reduced to the crank, flywheel included [kg m2]; `torque`: torque over the angle, balanced by a constant one
    [N m]; `excess_of`: its excess work, where that is known already. Source: artobolevsky_1988, ch. 16.
    """
    work = excess_of or excess_work(torque)
    excess, reach, balanced = work.curve, work.extremes, torque - work.mean_torque
    inertia_1, mean_inertia = inertia.derivative, inertia.mean
    if not mean_inertia > 0:
        raise MethodError(ErrorMessage("masses_missing"))
    floor = -reach.least
    slope_0 = balanced * inertia - excess * inertia_1 if np.any(inertia_1.coefficients) else None

    def extremes_at(energy: float) -> Extremes:
        if slope_0 is not None:
            return _speed_extremes(inertia, excess + energy, slope_0 - inertia_1 * energy)
        low, high = (float(speed_of_energy(energy + change, mean_inertia)) for change in (reach.least, reach.largest))
        return Extremes(low, reach.at_least, high, reach.at_largest)

    # what it is with a constant moment of inertia, where the extremes of speed are those of the excess work
    greatest = mean_speed + (reach.largest - reach.least) / (2 * mean_inertia * mean_speed)
    energy = max(float(kinetic_energy(mean_inertia, greatest)) - reach.largest, floor * (1 + 1e-6))
    of_time = None
    if mean == "time":
        energy = _energy_of_time(inertia, excess, energy, floor, mean_speed)
        of_time = energy, extremes_at(energy)
    extremes = of_time[1] if of_time is not None else extremes_at(energy)
    for _ in range(_STEPS):
        miss = (extremes.largest + extremes.least) / 2 - mean_speed
        # the derivative of each extreme speed by the energy is 1 / (J w)
        slope = sum(
            1 / max(float(inertia(angle)) * w, 1e-300)
            for w, angle in ((extremes.least, extremes.at_least), (extremes.largest, extremes.at_largest))
        )
        following = max(energy - 2 * miss / slope, floor + (energy - floor) / 16)
        if abs(miss) <= _SETTLED * mean_speed or abs(following - energy) <= 4e-16 * energy:
            break
        energy, extremes = following, extremes_at(following)
    if abs(miss) > 1e-12 * mean_speed:
        raise MethodError(ErrorMessage("machine_stops", speed=mean_speed, angle=float(np.degrees(extremes.at_least))))
    fluctuation = (extremes.largest - extremes.least) / mean_speed
    energy, extremes = of_time or (energy, extremes)
    return TrueSpeed(inertia, inertia_1, excess, balanced, energy, extremes, fluctuation)


def _energy_of_time(inertia: Curve, excess: Curve, energy: float, floor: float, mean_speed: float) -> float:
    """Return the energy with which a cycle takes the time of its mean speed; the search begins at an energy. [J]"""
    (inertia, excess), before = inertia.on_common_intervals(excess), energy
    for halving in range(_HALVINGS):
        count = 2**halving
        parts = (np.arange(count)[:, None] + (_GAUSS + 1) / 2).ravel() / count
        weights = np.outer(np.tile(_WEIGHTS / 2, count) / count, np.diff(inertia.angle) / inertia.cycle).ravel()
        J, A = inertia.within(parts).ravel(), excess.within(parts).ravel()
        for _ in range(_STEPS):
            slowness = 1 / speed_of_energy(energy + A, J)
            miss, slope = weights @ slowness - 1 / mean_speed, weights @ (slowness / (energy + A)) / 2
            # the time falls ever slower with the energy, so that steps from below never go too far
            following = max(energy + float(miss / slope), floor + (energy - floor) / 16)
            is_settled = abs(following - energy) <= 4e-16 * energy
            energy = following
            if is_settled:
                break
        if abs(energy - before) <= _RESOLVED * energy:
            break
        before = energy
    return energy


def _speed_extremes(inertia: Curve, total: Curve, slope: Curve) -> Extremes:
    """Return the extremes of w^2 = 2 (T_0 + A) / J as those of w; `slope` has its sign: M J - (T_0 + A) J'."""
    (slope, inertia), (_, total) = slope.on_common_intervals(inertia), slope.on_common_intervals(total)
    angles, *zeros = slope.at_zeros(total, inertia)
    starts = total.coefficients[0], inertia.coefficients[0]
    energy, J = (np.concatenate(ends) for ends in zip(starts, zeros, strict=True))
    w = speed_of_energy(np.maximum(energy, 0.0), J)
    return Extremes.among(np.concatenate([slope.angle[:-1], angles]), np.asarray(w), _EQUAL)


@dataclass(frozen=True)
class SpeedOfPolynomials:
    """Fluctuation and extremes of the speed from polynomials over one cycle, as the function of a `Procedure`."""

    sign: float = 1.0  # Of the torque that is given: -1 for one that brakes
    mean: Mean = "time"

    def __call__(self, edges: Array, series: Array) -> tuple[float, ...]:
        """Return fluctuation, greatest and least speed and where; `series`: of torque, moment of inertia, mean speed.

        No numbers where the machine would stop.
        """
        torque, inertia = (Curve.legendre(edges, column) for column in series[:2])
        try:
            speed = true_speed(inertia, torque * self.sign, float(series[2, 0, 0]), mean=self.mean)
        except MethodError:
            return (np.nan,) * 5
        least, at_least, largest, at_largest = speed.extremes
        return speed.fluctuation, largest, at_largest, least, at_least
