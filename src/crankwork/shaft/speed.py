"""The equation of motion of a machine with one degree of freedom, J w dw/dphi + w^2/2 J' = M, and its solutions."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal, Self

import numpy as np

from crankwork.dynamics.reduction import kinetic_energy
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Refusal
from crankwork.shaft.collocation import WEIGHTS, Panels, integrate_periodic, panel_points
from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import acceleration_of_crank, speed_of_energy
from crankwork.shaft.motor import Motor

Status = Literal["steady", "turning", "stopped", "stalled", "not started", "not solved"]
_WIDEST = math.pi / 18


@dataclass(frozen=True)
class ReducedMachine:
    """A machine reduced to its crank."""

    # Reduced moment of inertia and its derivative at crank angles [kg m2], [kg m2/rad]
    inertia: Callable[[Array], tuple[Array, Array]]
    # Sum of all reduced torques at crank angles and speeds, positive with the rotation [N m]
    torque: Callable[[Array, Array], Array]
    cycle: float = 2 * math.pi  # Crank angle after which both repeat [rad]
    # Angles within one cycle from zero where they are not smooth, shape (k,) [rad]
    corners: Array = field(default_factory=lambda: np.empty(0))

    @classmethod
    def of_curves(cls, inertia: Curve, load: Curve, motor: Motor | None = None, *, flywheel: float = 0.0) -> Self:
        """Return the machine of a moment of inertia and a torque over the angle, with a motor and a flywheel.

        The inertia is that without flywheel, the load the reduced torque of all but the motor, negative where it
        brakes. The motor is its torque on the crank over the speed of the crank; the flywheel is all that is added, the
        motor's own inertia times the square of its ratio included.
        """
        whole, derivative = inertia + flywheel, inertia.derivative

        def torque(angle: Array, speed: Array) -> Array:
            return load(angle) if motor is None else load(angle) + motor.torque(speed)

        corners = np.unique(np.concatenate([inertia.angle, load.angle]) % load.cycle)
        return cls(lambda angle: (whole(angle), derivative(angle)), torque, load.cycle, corners)

    def edges(self, start: float, end: float) -> Array:
        """Return panels from one crank angle to another that meet at the corners."""
        first, last = math.floor(start / self.cycle), math.ceil(end / self.cycle)
        corners = (self.corners + self.cycle * np.arange(first, last + 1)[:, None]).ravel()
        gap = 1e-12 * max(self.cycle, abs(end))
        inside = np.sort(corners[(corners > start + gap) & (corners < end - gap)])
        inside = inside[np.diff(inside, prepend=-np.inf) > gap]
        breaks = np.concatenate([[start], inside, [end]])
        parts = np.maximum(1, np.ceil(np.diff(breaks) / _WIDEST - 1e-9)).astype(int)
        within = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
        pieces = np.repeat(breaks[:-1], parts) + within * np.repeat(np.diff(breaks) / parts, parts)
        return np.concatenate([pieces, breaks[-1:]])

    def speed(self, angle: Array, energy: Array) -> Array:
        """Return the speed at crank angles and kinetic energies."""
        return np.asarray(speed_of_energy(energy, self.inertia(angle)[0]))

    def power(self) -> Callable[[Array, Array], Array]:
        """Return dT/dphi over crank angle and kinetic energy: the torque, without a derivative of J.

        The moment of inertia is kept for as long as the crank angles stay the same ones.
        """
        known, inertia = np.empty(0), np.empty(0)

        def torque(angle: Array, energy: Array) -> Array:
            nonlocal known, inertia
            if angle is not known:
                known, inertia = angle, self.inertia(angle)[0]
            return self.torque(angle, np.asarray(speed_of_energy(np.maximum(energy, 0.0), inertia)))

        return torque

    def acceleration(self, angle: Array, speed: Array) -> Array:
        """Return the angular acceleration at crank angles and speeds."""
        J, J_1 = self.inertia(angle)
        return np.asarray(acceleration_of_crank(self.torque(angle, speed), speed, J, J_1))


@dataclass(frozen=True)
class SpeedRun:
    """How a machine turns, from one crank angle to another."""

    # Crank angles, and what is there, shape (n,) [rad], [rad/s], [rad/s2], [s]
    angle: Array
    speed: Array
    acceleration: Array
    time: Array
    status: Status  # `steady`, `turning`, `stopped`, `stalled`, `not started` or `not solved`
    message: str = ""  # Where and why it ended otherwise than asked; empty if it did not
    # Kinetic energy gained less work done, by another quadrature, over the largest energy [-]
    energy_drift: float = 0.0
    # What is left after a cycle of a small disturbance of steady motion; stable below one. NaN otherwise [-]
    multiplier: float = math.nan
    # Extreme speeds and their angles [rad/s], [rad], [rad/s], [rad]
    least: float = math.nan
    at_least: float = math.nan
    largest: float = math.nan
    at_largest: float = math.nan

    @property
    def fluctuation(self) -> float:
        """Largest less least speed, over the mean of the two. [-]"""
        return 2 * (self.largest - self.least) / (self.largest + self.least)

    @property
    def mean_speed(self) -> float:
        """Mean over time. [rad/s]"""
        return float((self.angle[-1] - self.angle[0]) / (self.time[-1] - self.time[0]))


def steady_speed(machine: ReducedMachine, speed: float) -> SpeedRun:
    """Return steady motion: the speed over one cycle that repeats itself (artobolevsky_1988, ch. 15).

    Status `steady`; or `not solved`, where the search found no steady motion near that speed. `machine`: its torque
    must depend on the speed; where it does not, `fluctuation.true_speed` gives the motion.

    The unknown is T = J w^2 / 2 with dT/dphi = M(phi, w), shot over all panels at once with T(cycle) = T(0).
    """
    edges = machine.edges(0.0, machine.cycle)
    guess = np.asarray(kinetic_energy(machine.inertia(edges)[0], speed))
    solved = integrate_periodic(machine.power(), edges, guess, positive=True)
    if not solved.converged or not abs(solved.multiplier - 1) > 1e-13:
        angle = np.empty(0)
        return SpeedRun(angle, angle, angle, angle, "not solved", Refusal("steady_unfound", speed=speed))
    return described(machine, solved, "steady")


def described(machine: ReducedMachine, solved: Panels, status: Status) -> SpeedRun:
    """Return speed, acceleration, time and extremes of a solution for the energy."""
    angle = solved.edges
    speed = machine.speed(angle, solved.values)
    h = np.diff(angle)
    pace = 1 / machine.speed(solved.points, solved.inside)
    time = np.concatenate([[0.0], np.cumsum(h * (pace @ WEIGHTS))])
    low, at_low = _extreme(machine, solved, -1)
    high, at_high = _extreme(machine, solved, 1)
    return SpeedRun(
        angle,
        speed,
        machine.acceleration(angle, speed),
        time,
        status,
        energy_drift=energy_drift(machine, solved),
        multiplier=solved.multiplier,
        least=low,
        at_least=at_low,
        largest=high,
        at_largest=at_high,
    )


def energy_drift(machine: ReducedMachine, solved: Panels) -> float:
    """Return kinetic energy gained less work done, over the largest energy, on halved panels. [-]"""
    edges = np.sort(np.concatenate([solved.edges, (solved.edges[1:] + solved.edges[:-1]) / 2]))
    points = panel_points(edges)
    work = np.diff(edges) * (machine.power()(points, solved(points.ravel()).reshape(points.shape)) @ WEIGHTS)
    missing = np.cumsum(work)[1::2] - (solved.values[1:] - solved.values[0])
    return float(np.max(np.abs(missing)) / np.max(solved.values))


def _extreme(machine: ReducedMachine, solved: Panels, sign: int) -> tuple[float, float]:
    """Return the greatest (1) or least (-1) speed and its angle: at an edge, or where the acceleration is zero."""
    angles = np.concatenate([solved.edges, solved.points.ravel()])
    speeds = machine.speed(angles, np.concatenate([solved.values, solved.inside.ravel()]))
    order = np.argsort(angles, kind="stable")
    angles, speeds = angles[order], speeds[order]
    best = int(np.argmax(sign * speeds))
    low, high = angles[max(best - 1, 0)], angles[min(best + 1, angles.size - 1)]
    for _ in range(4):
        grid = np.linspace(low, high, 33)
        there = machine.speed(grid, solved(grid))
        at = int(np.argmax(sign * there))
        low, high = grid[max(at - 1, 0)], grid[min(at + 1, 32)]
    return float(there[at]), float(grid[at])
