"""The equation of motion of a machine with one degree of freedom, J w dw/dphi + w^2/2 J' = M, and its solutions."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple, Self

import numpy as np

from crankwork.dynamics.reduction import kinetic_energy
from crankwork.kinematics.crank_grid import Array
from crankwork.shaft.collocation import WEIGHTS, Panels, integrate_periodic
from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import speed_of_energy
from crankwork.shaft.motor import Motor

_WIDEST = math.pi / 18


@dataclass(frozen=True)
class ReducedMachine:
    """A machine reduced to its crank."""

    inertia: Callable[[Array], Array]  # Reduced moment of inertia at crank angles [kg m2]
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
        total = inertia + flywheel

        def torque(angle: Array, speed: Array) -> Array:
            return load(angle) if motor is None else load(angle) + motor.torque(speed)

        corners = np.unique(np.concatenate([inertia.angle, load.angle]) % load.cycle)
        return cls(total, torque, load.cycle, corners)

    def edges(self) -> Array:
        """Return panels over one cycle that meet at the corners."""
        gap = 1e-12 * self.cycle
        inside = np.sort(self.corners[(self.corners > gap) & (self.corners < self.cycle - gap)])
        inside = inside[np.diff(inside, prepend=-np.inf) > gap]
        breaks = np.concatenate([[0.0], inside, [self.cycle]])
        parts = np.maximum(1, np.ceil(np.diff(breaks) / _WIDEST - 1e-9)).astype(int)
        within = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
        pieces = np.repeat(breaks[:-1], parts) + within * np.repeat(np.diff(breaks) / parts, parts)
        return np.concatenate([pieces, breaks[-1:]])

    def speed(self, angle: Array, energy: Array) -> Array:
        """Return the speed at crank angles and kinetic energies."""
        return np.asarray(speed_of_energy(energy, self.inertia(angle)))

    def power(self) -> Callable[[Array, Array], Array]:
        """Return dT/dphi over crank angle and kinetic energy: the torque, without a derivative of J.

        The moment of inertia is kept for as long as the crank angles stay the same ones.
        """
        known, inertia = np.empty(0), np.empty(0)

        def torque(angle: Array, energy: Array) -> Array:
            nonlocal known, inertia
            if angle is not known:
                known, inertia = angle, self.inertia(angle)
            return self.torque(angle, np.asarray(speed_of_energy(np.maximum(energy, 0.0), inertia)))

        return torque


class SteadyRun(NamedTuple):
    """Steady motion over one cycle, at ascending crank angles."""

    # Crank angles, speeds and times there, shape (n,) [rad], [rad/s], [s]
    angle: Array
    speed: Array
    time: Array
    # Extreme speeds [rad/s]
    least: float
    largest: float

    @property
    def fluctuation(self) -> float:
        """Largest less least speed, over the mean of the two. [-]"""
        return 2 * (self.largest - self.least) / (self.largest + self.least)

    @property
    def mean_speed(self) -> float:
        """Mean over time. [rad/s]"""
        return float((self.angle[-1] - self.angle[0]) / (self.time[-1] - self.time[0]))


def steady_speed(machine: ReducedMachine, speed: float) -> SteadyRun | None:
    """Return steady motion: the speed over one cycle that repeats itself (artobolevsky_1988, ch. 15).

    None where the search found no steady motion near that speed. `machine`: its torque must depend on the speed; where
    it does not, `fluctuation.true_speed` gives the motion.

    The unknown is T = J w^2 / 2 with dT/dphi = M(phi, w), shot over all panels at once with T(cycle) = T(0).
    """
    edges = machine.edges()
    guess = np.asarray(kinetic_energy(machine.inertia(edges), speed))
    solved = integrate_periodic(machine.power(), edges, guess)
    if not solved.converged or not abs(solved.multiplier - 1) > 1e-13:
        return None
    pace = 1 / machine.speed(solved.points, solved.inside)
    time = np.concatenate([[0.0], np.cumsum(np.diff(solved.edges) * (pace @ WEIGHTS))])
    least, largest = (_extreme(machine, solved, sign) for sign in (-1, 1))
    return SteadyRun(solved.edges, machine.speed(solved.edges, solved.values), time, least, largest)


def _extreme(machine: ReducedMachine, solved: Panels, sign: int) -> float:
    """Return the greatest (1) or least (-1) speed: at an edge, or where the acceleration is zero."""
    angles = np.concatenate([solved.edges, solved.points.ravel()])
    speeds = machine.speed(angles, np.concatenate([solved.values, solved.inside.ravel()]))
    order = np.argsort(angles, kind="stable")
    angles, speeds = angles[order], speeds[order]
    best = int(np.argmax(sign * speeds))
    low, high = angles[max(best - 1, 0)], angles[min(best + 1, angles.size - 1)]
    for _ in range(4):
        grid = np.linspace(low, high, 33)
        speeds_there = machine.speed(grid, solved(grid))
        index = int(np.argmax(sign * speeds_there))
        low, high = grid[max(index - 1, 0)], grid[min(index + 1, 32)]
    return float(speeds_there[index])
