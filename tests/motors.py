"""A motor that tests know in closed form, and how exactly steady motion follows its equation."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

_STEPS = 16
# beside an edge of a panel, where a torque may jump [rad]
_INSIDE = 1e-12


class LinearMotor(NamedTuple):
    """The working branch of a motor as a straight line: torque per speed below that without load."""

    stiffness: float
    no_load_speed: float

    def torque(self, speed):
        """Return the torque on its own shaft."""
        return self.stiffness * (self.no_load_speed - np.asarray(speed))


def missed(machine, found):
    """Return by what share the speed at the end of a panel is not that of a Runge-Kutta method from its start."""
    start, end, speed = found.angle[:-1], found.angle[1:], found.speed[:-1]
    energy, h = machine.inertia(start) * speed**2 / 2, (end - start) / _STEPS

    def torque(angle, energy):
        angle = np.clip(angle, start + _INSIDE, end - _INSIDE)
        return machine.torque(angle, np.sqrt(2 * energy / machine.inertia(angle)))

    for at in range(_STEPS):
        angle = start + at * h
        one = torque(angle, energy)
        two = torque(angle + h / 2, energy + h / 2 * one)
        three = torque(angle + h / 2, energy + h / 2 * two)
        four = torque(angle + h, energy + h * three)
        energy = energy + h / 6 * (one + 2 * two + 2 * three + four)
    reached = np.sqrt(2 * energy / machine.inertia(end))
    return float(np.max(np.abs(reached / found.speed[1:] - 1)))
