"""Motion by energy quadrature: where the crank is after a time, if all torques depend on the angle alone."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from crankwork.errors import MethodError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Refusal
from crankwork.shaft.collocation import gauss
from crankwork.shaft.fluctuation import speed_of_energy

_NODES, _WEIGHTS, _TO_SERIES, _TO_INTEGRAL, _INTEGRATION = gauss(14)
_LARGEST, _SMALLEST, _SHORT = 1024, 12, 6
_TOLERANCE = 1e-12
_MOST_CYCLES = 1_000_000


@dataclass(frozen=True)
class EnergyMachine:
    """A machine whose torques are a constant one and those of a potential: springs, weights."""

    # Reduced moment of inertia, potential energy and its derivative at crank angles, all periodic [kg m2], [J], [J/rad]
    state: Callable[[Array], tuple[Array, Array, Array]]
    drive: float = 0.0  # Constant torque on the crank [N m]
    cycle: float = 2 * math.pi  # Their period [rad]


@dataclass(frozen=True)
class Moment:
    """Where a machine is at a time."""

    # Time from the start, crank angle, speed [s], [rad], [rad/s]
    time: float
    angle: float
    speed: float
    energy: float  # Kinetic energy [J]
    # Size of the last Legendre coefficients that were kept, over the whole time: the error to be expected [-]
    tail: float


def moment_after(
    machine: EnergyMachine, time: float, *, angle: float = 0.0, speed: float = 0.0, panels: int = _SMALLEST
) -> Moment:
    """Return crank angle and speed after a time (artobolevsky_1988, ch. 15). [rad], [rad/s]

    From rest the torque must be positive. The speed is that of the energy, so that energy does not drift. Panels of 14
    Gauss points are doubled until they are enough.

    With T(phi) = T_0 + M (phi - phi_0) - V(phi) + V(phi_0) the time is t(phi) = integral of sqrt(J / (2 T)). Where
    it starts from rest the integrand is infinite, and phi = phi_0 + h s^2 makes it smooth on the first panels,
    where T is the integral of the torque, because a difference of potentials would be all rounding.
    """
    if time < 0 or speed < 0:
        raise MethodError("time and speed must not be negative")
    if time == 0:
        J = machine.state(np.array([angle]))[0]
        return Moment(0.0, angle, speed, float(J[0]) * speed**2 / 2, 0.0)
    while True:
        found = _Quadrature(machine, angle, speed, panels).after(time)
        if found.tail <= _TOLERANCE or panels >= _LARGEST:
            return found
        panels *= 2


class _Quadrature:
    """Short panels at the start, then those of one cycle, which later differ by the work of the drive alone."""

    def __init__(self, machine: EnergyMachine, angle: float, speed: float, panels: int) -> None:
        self.machine, self.start, self.from_rest = machine, angle, speed == 0
        self.h = machine.cycle / panels
        self.long = self.h * np.arange(1, panels + 2)
        # from rest the speed is smooth over s, the angle being h s^2
        s = (np.arange(_SHORT)[:, None] + _NODES) / _SHORT
        short = self.h * (s**2 if self.from_rest else s)
        self.stretch = self.h / _SHORT * (2 * s if self.from_rest else np.ones_like(s))
        long = self.h * (np.arange(1, panels + 1)[:, None] + _NODES)
        J, V, V_1 = machine.state(angle + np.concatenate([[0.0], short.ravel(), long.ravel()]))
        self.at_rest, self.potential = float(J[0]) * speed**2 / 2, float(V[0])
        cut = 1 + short.size
        work = self.stretch * (machine.drive - V_1[1:cut].reshape(short.shape))
        before = np.concatenate([[0.0], np.cumsum(work @ _WEIGHTS)[:-1]])
        self.begun = (J[1:cut].reshape(short.shape), self.at_rest + before[:, None] + work @ _INTEGRATION.T, short)
        self.inertia, self.offset = J[cut:].reshape(long.shape), long
        self.energy = self.at_rest + machine.drive * long + (self.potential - V[cut:].reshape(long.shape))

    def after(self, time: float) -> Moment:
        """Go through the cycles until the time is reached."""
        pace = self.stretch * self._pace(*self.begun)
        until, coarse = np.cumsum(pace @ _WEIGHTS), _tail(pace)
        if until[-1] >= time:
            s, own = _found(time, pace, until)
            s /= _SHORT
            return self._moment(time, self.h * (s * s if self.from_rest else s), max(own, coarse**2 / time) / time)
        cycle, gain = self.machine.cycle, self.machine.drive * self.machine.cycle
        for done in range(_MOST_CYCLES):
            passed = float(until[-1])
            pace = self.h * self._pace(self.inertia, self.energy + done * gain, self.offset + done * cycle)
            until, coarse = passed + np.cumsum(pace @ _WEIGHTS), max(coarse, _tail(pace))
            if until[-1] >= time:
                s, own = _found(time, pace, until)
                return self._moment(time, self.h * (1 + s) + done * cycle, max(own, coarse**2 / time) / time)
        raise MethodError(Refusal("motion_long", time=time, most=_MOST_CYCLES))

    def _pace(self, inertia: Array, energy: Array, offset: Array) -> Array:
        """Return the time per angle."""
        self._check(energy, offset)
        return np.asarray(np.sqrt(inertia / (2 * energy)))

    def _check(self, energy: Array, offset: Array) -> None:
        lost = ~(energy > 0)
        if lost.any():
            at = math.degrees(self.start + float(offset.ravel()[int(np.argmax(lost.ravel()))]))
            raise MethodError(Refusal("motion_stuck", angle=at))

    def _moment(self, time: float, offset: float, tail: float) -> Moment:
        angle = self.start + offset
        J, V, _ = self.machine.state(np.array([angle]))
        energy = self.at_rest + self.machine.drive * offset + (self.potential - float(V[0]))
        return Moment(time, angle, float(speed_of_energy(energy, float(J[0]))), energy, tail)


def _tail(pace: Array) -> float:
    return float(np.max(np.abs(pace @ _TO_SERIES[-2:].T)))


def _found(time: float, pace: Array, until: Array) -> tuple[float, float]:
    """Return where in a row of panels a time is reached, in panels, and the tail of that panel."""
    panel = int(np.searchsorted(until, time))
    one = pace[panel]
    return panel + _place(one, time - float(until[panel] - one @ _WEIGHTS)), _tail(one)


def _place(pace: Array, time: float) -> float:
    """Return the part of a panel that takes a time, the time being the integral of a polynomial."""
    series = _TO_INTEGRAL @ (_TO_SERIES @ pace)
    slope = _TO_SERIES @ pace
    s = time / float(pace @ _WEIGHTS)
    for _ in range(30):
        miss = float(legendre.legval(2 * s - 1, series)) - time
        step = miss / float(legendre.legval(2 * s - 1, slope))
        s -= step
        if abs(step) < 1e-15:
            break
    return min(max(s, 0.0), 1.0)
